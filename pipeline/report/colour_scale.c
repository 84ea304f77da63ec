// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/colour_scale.h"

#include <math.h>

#include "pipeline/report/format.h"
#include "pipeline/report/plot.h"

enum { BAR_WIDTH = 320, BAR_HEIGHT = 12, BAR_MARGIN = 24, BAR_STEPS = 64 };

uint32_t cw_colour_scale(double share) {
  // Of the scale's 256 colours every 32nd, and the last.
  static const unsigned char stop[][3] = {{68, 1, 84},    {71, 44, 122},  {59, 81, 139},
                                          {44, 113, 142}, {33, 144, 141}, {39, 173, 129},
                                          {92, 200, 99},  {170, 220, 50}, {253, 231, 37}};
  enum { LAST = sizeof stop / sizeof *stop - 1 };
  double at = fmin(fmax(share, 0), 1) * LAST;
  int below = at < LAST ? (int)at : LAST - 1;
  uint32_t colour = 0;
  for (int c = 0; c < 3; c++)
    colour = colour << 8 |
             (uint32_t)(stop[below][c] + (at - below) * (stop[below + 1][c] - (double)stop[below][c]) + 0.5);
  return colour;
}

double cw_colour_share(const CwColourSpan *span, double value) {
  double least = span->logarithmic ? log(span->least) : span->least;
  double most = span->logarithmic ? log(span->most) : span->most;
  double at = span->logarithmic ? log(fmax(value, span->least)) : value;
  return most > least ? fmin(fmax((at - least) / (most - least), 0), 1) : 0;
}

static void tick(FILE *page, const CwColourSpan *span, double value) {
  char text[CW_FORMAT_SIZE];
  double x = BAR_MARGIN + BAR_WIDTH * cw_colour_share(span, value);
  fprintf(page, "<line class=\"a\" x1=\"%.1f\" y1=\"%d\" x2=\"%.1f\" y2=\"%d\"/>", x, BAR_HEIGHT, x, BAR_HEIGHT + 4);
  fprintf(page, "<text class=\"t\" x=\"%.1f\" y=\"%d\" text-anchor=\"middle\">%s</text>", x, BAR_HEIGHT + 17,
          cw_format_number(value, 3, text));
}

void cw_colour_bar(FILE *page, const CwColourSpan *span, const char *label) {
  fprintf(page,
          "<div class=\"bar\"><span>%s</span><svg class=\"plot\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\">",
          label, BAR_WIDTH + 2 * BAR_MARGIN, BAR_HEIGHT + 20, BAR_WIDTH + 2 * BAR_MARGIN, BAR_HEIGHT + 20);
  for (int k = 0; k < BAR_STEPS; k++)
    fprintf(page, "<rect x=\"%d\" y=\"0\" width=\"%d\" height=\"%d\" fill=\"#%06x\"/>",
            BAR_MARGIN + k * BAR_WIDTH / BAR_STEPS, BAR_WIDTH / BAR_STEPS, BAR_HEIGHT,
            (unsigned)cw_colour_scale((k + 0.5) / BAR_STEPS));
  if (span->logarithmic) {
    for (double power = pow(10, floor(log10(span->least))); power <= span->most * 1.0001; power *= 10)
      for (int digit = 1; digit <= 5; digit += digit == 1 ? 1 : 3)
        if (digit * power >= span->least * 0.9999 && digit * power <= span->most * 1.0001)
          tick(page, span, digit * power);
  } else {
    double step = 2 * cw_plot_step(span->most - span->least);
    for (double k = ceil(span->least / step - 1e-9); k * step <= span->most + 1e-9 * step; k++)
      tick(page, span, k * step);
  }
  fputs("</svg></div>\n", page);
}
