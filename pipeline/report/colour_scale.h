// SPDX-License-Identifier: AGPL-3.0-or-later
// Colours for the values of a field, even to the eye from least to greatest: viridis (van der Walt and Smith, 2015).
#pragma once

#include <stdint.h>
#include <stdio.h>

// 0xRRGGBB of a share from 0 to 1; what lies outside gets the colour of the end.
uint32_t cw_colour_scale(double share);

// What a field spans on the scale.
typedef struct {
  double least, most;
  int logarithmic; // then least is above 0
} CwColourSpan;

double cw_colour_share(const CwColourSpan *span, double value);

// The scale with round numbers below it, in SVG. `label`: quantity and unit, HTML.
void cw_colour_bar(FILE *page, const CwColourSpan *span, const char *label);
