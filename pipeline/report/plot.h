// SPDX-License-Identifier: AGPL-3.0-or-later
// Charts as figures of HTML, drawn in SVG: columns side by side, stacked bars, and lines.
#pragma once

#include <stdint.h>
#include <stdio.h>

typedef struct {
  const char *name;    // for the key; NULL: none
  uint32_t colour;     // 0xRRGGBB
  const double *value; // one a category, from 0; NAN: none
} CwPlotSeries;

typedef struct {
  char label[96];
  char note[160]; // of bars: written behind it; may be ""
} CwPlotCategory;

typedef struct {
  const char *axis;          // what the values are, with unit
  const char *category_axis; // what the categories are; may be NULL
  const CwPlotCategory *category;
  int count; // categories
  const CwPlotSeries *series;
  int series_count;
  int decimals;        // of columns: digits after the point of the values over them; below 0: no values
  double limit;        // end of the axis; 0: from the values
  double mark;         // a line across at this value, in the unit of the axis; 0: none
  int width;           // px
  const char *caption; // HTML
} CwPlot;

typedef struct {
  const char *axis, *x_axis;  // what is drawn over what, with units
  const double *x;            // ascending
  int count;                  // places
  const CwPlotSeries *series; // each of `count` values; NAN: a gap
  int series_count;
  int logarithmic;     // values as powers of ten; those not above 0 are gaps
  int dots;            // each value is marked, also one between gaps
  double mark;         // a line across at this value; NAN: none
  int width;           // px
  const char *caption; // HTML
} CwLinePlot;

// Step of 1, 2 or 5 times a power of ten that gives 4 to 10 ticks up to `most`; 1 where `most` is not above
// 0.
double cw_plot_step(double most);

// Columns side by side, one group a category.
void cw_plot_columns(FILE *page, const CwPlot *plot);
// Bars from left to right, the series stacked, one bar a category.
void cw_plot_bars(FILE *page, const CwPlot *plot);
// Lines over x. The axis holds all values and the mark, but not always 0.
void cw_plot_lines(FILE *page, const CwLinePlot *plot);
