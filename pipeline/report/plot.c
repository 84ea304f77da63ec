// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/plot.h"

#include <math.h>

#include "pipeline/report/html.h"

static const double key_height = 26, tick_gap = 6;

double cw_plot_step(double most) {
  if (!(most > 0) || !isfinite(most)) return 1;
  double power = pow(10, floor(log10(most)));
  double first = most / power; // 1 to 10
  return first < 2 ? 0.2 * power : first < 5 ? 0.5 * power : power;
}

static void text(FILE *page, double x, double y, const char *anchor, const char *class, const char *words) {
  fprintf(page, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" class=\"%s\">", x, y, anchor, class);
  cw_html_text(page, "", words, "</text>\n");
}

static void line(FILE *page, double x0, double y0, double x1, double y1, const char *class) {
  fprintf(page, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" class=\"%s\"/>\n", x0, y0, x1, y1, class);
}

static void box(FILE *page, double x, double y, double width, double height, uint32_t colour) {
  fprintf(page, "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" fill=\"#%06x\"/>\n", x, y, width, height,
          (unsigned)colour);
}

static void tick_text(double value, double step, char *words, size_t size) {
  int decimals = (int)fmax(0, -floor(log10(step) + 1e-9));
  snprintf(words, size, "%.*f", decimals, value);
}

static double letters(const char *words) { // width in letters: UTF-8 continuation bytes are none
  double count = 0;
  for (; *words; words++) count += (*words & 0xC0) != 0x80;
  return count;
}

static double begin(FILE *page, const CwPlot *plot, double height) {
  double x = 0;
  int named = 0;
  for (int s = 0; s < plot->series_count; s++) named |= plot->series[s].name != NULL;
  fprintf(page,
          "<figure><svg class=\"plot\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %.0f\" width=\"%d\" "
          "height=\"%.0f\" role=\"img\">\n",
          plot->width, height + (named ? key_height : 0), plot->width, height + (named ? key_height : 0));
  for (int s = 0; s < plot->series_count; s++) {
    if (!plot->series[s].name) continue;
    box(page, x, 4, 12, 12, plot->series[s].colour);
    text(page, x + 18, 14.5, "start", "k", plot->series[s].name);
    x += 18 + 7.2 * letters(plot->series[s].name) + 22;
  }
  return named ? key_height : 0;
}

static void end(FILE *page, const char *caption) {
  fprintf(page, "</svg>\n<figcaption>%s</figcaption></figure>\n", caption);
}

// What the values are, from below to the top at the left, in the middle of so many px.
static void upright(FILE *page, double middle, const char *words) {
  fprintf(page, "<text transform=\"translate(12 %.1f) rotate(-90)\" text-anchor=\"middle\" class=\"x\">", middle);
  cw_html_text(page, "", words, "</text>\n");
}

static double largest(const CwPlot *plot, int stacked) {
  double most = plot->mark;
  for (int c = 0; c < plot->count; c++) {
    double sum = 0;
    for (int s = 0; s < plot->series_count; s++) {
      double value = plot->series[s].value[c];
      if (isnan(value)) continue;
      sum = stacked ? sum + value : fmax(sum, value);
    }
    most = fmax(most, sum);
  }
  return most;
}

// End of the axis of the values, from 0, and the step of its ticks.
static double limit_of(const CwPlot *plot, int stacked, double *step) {
  const double most = plot->limit > 0 ? plot->limit : largest(plot, stacked);
  *step = cw_plot_step(most);
  return plot->limit > 0 ? plot->limit : fmax(ceil(most / *step - 1e-9), 1) * *step;
}

void cw_plot_columns(FILE *page, const CwPlot *plot) {
  const double left = 52, right = 8, above = 18, below = plot->category_axis ? 44 : 26, body = 200;
  double top = begin(page, plot, above + body + below) + above, width = plot->width - left - right;
  double step, limit = limit_of(plot, 0, &step);
  char words[40];
  for (int k = 0; k * step <= limit * (1 + 1e-9); k++) {
    double y = top + body * (1 - k * step / limit);
    line(page, left, y, left + width, y, k ? "g" : "a");
    tick_text(k * step, step, words, sizeof words);
    text(page, left - tick_gap, y + 4, "end", "t", words);
  }
  double pitch = width / fmax(plot->count, 1), share = plot->series_count > 1 ? 0.8 : 0.66;
  double column = pitch * share / fmax(plot->series_count, 1);
  for (int c = 0; c < plot->count; c++) {
    double x = left + pitch * (c + 0.5 * (1 - share));
    for (int s = 0; s < plot->series_count; s++, x += column) {
      double value = plot->series[s].value[c], height = body * value / limit;
      if (!isfinite(value)) continue;
      box(page, x + 0.5, top + body - height, fmax(column - 1, 0.5), height, plot->series[s].colour);
      if (plot->decimals < 0 || value == 0) continue;
      double least = pow(10, -plot->decimals);
      snprintf(words, sizeof words, value < 0.5 * least ? "<%.*f" : "%.*f", plot->decimals,
               value < 0.5 * least ? least : value);
      if (5.6 * letters(words) <= column + 3)
        text(page, x + 0.5 * column, top + body - height - 4, "middle", "v", words);
    }
    text(page, left + pitch * (c + 0.5), top + body + 17, "middle", "t", plot->category[c].label);
  }
  if (plot->category_axis) text(page, left + 0.5 * width, top + body + 38, "middle", "x", plot->category_axis);
  upright(page, top + 0.5 * body, plot->axis);
  end(page, plot->caption);
}

void cw_plot_bars(FILE *page, const CwPlot *plot) {
  const double row = 22, thick = 14, below = 42;
  double left = 40, right = 16;
  for (int c = 0; c < plot->count; c++) {
    left = fmax(left, 7.0 * letters(plot->category[c].label) + 14);
    right = fmax(right, 6.8 * letters(plot->category[c].note) + 14);
  }
  double body = row * plot->count, top = begin(page, plot, body + below), width = plot->width - left - right;
  double step, limit = limit_of(plot, 1, &step);
  char words[40];
  for (int k = 0; k * step <= limit * (1 + 1e-9); k++) {
    double x = left + width * k * step / limit;
    line(page, x, top, x, top + body, k ? "g" : "a");
    tick_text(k * step, step, words, sizeof words);
    text(page, x, top + body + 15, "middle", "t", words);
  }
  const double mark = left + width * plot->mark / limit;
  if (plot->mark > 0) line(page, mark, top - 2, mark, top + body, "m");
  for (int c = 0; c < plot->count; c++) {
    double x = left, y = top + row * c + 0.5 * (row - thick);
    for (int s = 0; s < plot->series_count; s++) {
      double value = plot->series[s].value[c];
      if (!isfinite(value)) continue;
      box(page, x, y, width * value / limit, thick, plot->series[s].colour);
      x += width * value / limit;
    }
    text(page, left - tick_gap, y + 11, "end", "c", plot->category[c].label);
    if (mark > x - 5) x = fmax(x, mark); // so that the line does not cross the note
    if (*plot->category[c].note) text(page, x + 5, y + 11, "start", "v", plot->category[c].note);
  }
  text(page, left + 0.5 * width, top + body + 36, "middle", "x", plot->axis);
  end(page, plot->caption);
}

// Where values stand on the axis of a line plot.
typedef struct {
  double low, high, step; // of the values, or of their decimal logarithms
  int logarithmic;
} Scale;

static double on_scale(const Scale *scale, double value) {
  double at = scale->logarithmic ? (value > 0 ? log10(value) : NAN) : value;
  return (at - scale->low) / (scale->high - scale->low);
}

static const double SPAN_LEAST = 1e-9; // of the values: ticks are numbers of their own

// Where all values are one it stands in the middle, and where there are none 0.
static void widen(Scale *scale) {
  if (scale->high - scale->low > SPAN_LEAST * fmax(fabs(scale->low), fabs(scale->high))) return;
  const double middle = isfinite(scale->low) ? scale->low : 0, half = fmax(0.05 * fabs(middle), 1e-12);
  scale->low = middle - half;
  scale->high = middle + half;
}

// From the first place to the last.
static Scale across_of(const CwLinePlot *plot) {
  Scale scale = {plot->x[0], plot->x[plot->count - 1], 1, 0};
  widen(&scale);
  scale.step = cw_plot_step(scale.high - scale.low);
  return scale;
}

static Scale scale_of(const CwLinePlot *plot) {
  Scale scale = {INFINITY, -INFINITY, 1, plot->logarithmic};
  for (int s = 0; s < plot->series_count; s++) {
    for (int k = 0; k < plot->count; k++) {
      double value = plot->series[s].value[k];
      if (plot->logarithmic) value = value > 0 ? log10(value) : NAN;
      if (!isfinite(value)) continue;
      scale.low = fmin(scale.low, value);
      scale.high = fmax(scale.high, value);
    }
  }
  double mark = plot->logarithmic && isfinite(plot->mark) ? log10(plot->mark) : plot->mark;
  if (isfinite(mark)) scale = (Scale){fmin(scale.low, mark), fmax(scale.high, mark), 1, plot->logarithmic};
  widen(&scale);
  scale.step = plot->logarithmic ? fmax(1, ceil((scale.high - scale.low) / 8)) : cw_plot_step(scale.high - scale.low);
  scale.low = floor(scale.low / scale.step + 1e-9) * scale.step;
  scale.high = ceil(scale.high / scale.step - 1e-9) * scale.step;
  return scale;
}

static void path_of(FILE *page, const CwLinePlot *plot, const Scale *across, const Scale *scale,
                    const CwPlotSeries *series, const double frame[4]) {
  const double *value = series->value;
  int drawing = 0;
  fprintf(page, "<path fill=\"none\" stroke=\"#%06x\" stroke-width=\"1.6\" d=\"", (unsigned)series->colour);
  for (int k = 0; k < plot->count; k++) {
    double up = on_scale(scale, value[k]);
    if (!isfinite(up)) {
      drawing = 0;
      continue;
    }
    fprintf(page, "%c%.1f %.1f", drawing ? 'L' : 'M', frame[0] + frame[2] * on_scale(across, plot->x[k]),
            frame[1] + frame[3] * (1 - up));
    drawing = 1;
  }
  fputs("\"/>\n", page);
  for (int k = 0; plot->dots && k < plot->count; k++) {
    double up = on_scale(scale, value[k]);
    if (isfinite(up))
      fprintf(page, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.2\" fill=\"#%06x\"/>\n",
              frame[0] + frame[2] * on_scale(across, plot->x[k]), frame[1] + frame[3] * (1 - up),
              (unsigned)series->colour);
  }
}

void cw_plot_lines(FILE *page, const CwLinePlot *plot) {
  const double left = 62, right = 14, above = 18, below = 44, body = 220;
  CwPlot keys = {.series = plot->series, .series_count = plot->series_count, .width = plot->width};
  double top = begin(page, &keys, above + body + below) + above, width = plot->width - left - right;
  const double frame[4] = {left, top, width, body};
  char words[40];
  if (plot->count > 0) {
    const Scale scale = scale_of(plot), across = across_of(plot);
    for (double at = scale.low; at <= scale.high + 1e-9 * scale.step; at += scale.step) {
      double y = top + body * (1 - (at - scale.low) / (scale.high - scale.low));
      line(page, left, y, left + width, y, at == scale.low ? "a" : "g");
      if (scale.logarithmic)
        snprintf(words, sizeof words, "%.0e", pow(10, at));
      else
        tick_text(at, scale.step, words, sizeof words);
      text(page, left - tick_gap, y + 4, "end", "t", words);
    }
    const double step = across.step;
    for (double at = ceil(across.low / step) * step; at <= across.high + 1e-9 * (across.high - across.low);
         at += step) {
      tick_text(at, step, words, sizeof words);
      text(page, left + width * on_scale(&across, at), top + body + 17, "middle", "t", words);
    }
    double mark = on_scale(&scale, plot->mark);
    if (isfinite(mark)) line(page, left, top + body * (1 - mark), left + width, top + body * (1 - mark), "m");
    for (int s = 0; s < plot->series_count; s++) path_of(page, plot, &across, &scale, &plot->series[s], frame);
  }
  text(page, left + 0.5 * width, top + body + 38, "middle", "x", plot->x_axis);
  upright(page, top + 0.5 * body, plot->axis);
  end(page, plot->caption);
}
