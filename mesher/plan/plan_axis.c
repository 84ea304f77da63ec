// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/plan/plan_axis.h"

#include <math.h>

enum { SAMPLES = 400 };
static const double END = 0.02; // of the domain's length: what counts as its end

// Whether the domain is wider at its end above than below.
static int widens(const CwBackground *background, double low, double high) {
  double widest[2] = {0, 0};
  for (int32_t i = 0; i < background->point_count; i++) {
    const double *x = background->x[i];
    int end = x[2] > (low + high) / 2;
    if (fabs(x[2] - (end ? high : low)) < END * (high - low)) widest[end] = fmax(widest[end], hypot(x[0], x[1]));
  }
  return widest[1] >= widest[0];
}

int cw_plan_axis_find(const CwBackground *background, const CwVerticals *inside, CwPlanAxis *axis) {
  double low = INFINITY, high = -INFINITY;
  for (int32_t i = 0; i < background->point_count; i++) {
    low = fmin(low, background->x[i][2]);
    high = fmax(high, background->x[i][2]);
  }
  double step = (high - low) / SAMPLES;
  int wet[SAMPLES], runs = 0, last = 0;
  for (int i = 0; i < SAMPLES; i++) {
    double x[3] = {0, 0, low + step * (i + 0.5)};
    wet[i] = cw_verticals_inside(inside, x);
    runs += i > 0 && wet[i] != wet[i - 1];
  }
  int dry = runs == 0 && !wet[0];
  if (runs != 1 && !dry) return 0;
  while (!dry && wet[last] == wet[0]) last++;
  int rises = dry ? widens(background, low, high) : wet[0];
  axis->up = rises ? 1 : -1;
  axis->low = rises ? low : -high;
  axis->high = rises ? high : -low;
  axis->nose = dry ? axis->low : axis->up * (low + step * last);
  return 1;
}
