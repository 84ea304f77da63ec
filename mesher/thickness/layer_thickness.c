// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/thickness/layer_thickness.h"

#include <math.h>

#include "mesher/policy.h"

double cw_first_height(double y_plus, double velocity, double length, double kinematic_viscosity, int at_centre) {
  double reynolds = velocity * length / kinematic_viscosity;
  double friction = 0.026 * pow(reynolds, -1.0 / 7.0);
  double friction_velocity = velocity * sqrt(0.5 * friction);
  double y = y_plus * kinematic_viscosity / friction_velocity;
  return at_centre ? 2.0 * y : y;
}

// 1 + g + ... + g^(count-1) by Horner, which has no 0/0 at g = 1; with the derivative by g.
static double geometric_sum(int count, double growth, double *derivative) {
  double sum = 0.0, slope = 0.0;
  for (int k = 0; k < count; k++) {
    slope = slope * growth + sum;
    sum = sum * growth + 1.0;
  }
  if (derivative) *derivative = slope;
  return sum;
}

double cw_layer_thickness(double first, int count, double growth) {
  return first * geometric_sum(count, growth, NULL);
}

// The growth ratio between `low` and `high` whose sum is `wanted`, which lies between the sums of both.
// The sum is convex and increasing, so Newton from the right end does not overshoot but by rounding.
static double solve_growth(int count, double wanted, double low, double high) {
  double growth = high;
  for (int round = 0; round < 200; round++) {
    double slope, excess = geometric_sum(count, growth, &slope) - wanted;
    if (excess > 0.0)
      high = growth;
    else
      low = growth;
    if (fabs(excess) <= 1e-14 * wanted || high - low <= 1e-15) break;
    double next = slope > 0.0 ? growth - excess / slope : low;
    growth = next > low && next < high ? next : 0.5 * (low + high);
  }
  return growth;
}

double cw_layer_growth_least(int count) {
  return pow(cw_policy.least_growth, (CW_LAYER_COUNT_USUAL - 1.0) / fmax(CW_LAYER_COUNT_USUAL - 1, count - 1));
}

double cw_layer_lowest(int count) {
  return geometric_sum(count, cw_layer_growth_least(count), NULL);
}

double cw_layer_fractions(double thickness, double first, int count, double growth_max, double *fraction) {
  double growth = fmax(growth_max, 1.0), least = cw_layer_growth_least(count);
  double most_sum = geometric_sum(count, growth, NULL), least_sum = geometric_sum(count, least, NULL);
  double start = first;
  if (thickness >= first * most_sum) {
    start = thickness / most_sum;
  } else if (thickness <= first * least_sum) {
    growth = least;
    start = thickness / least_sum;
  } else {
    growth = solve_growth(count, thickness / first, least, growth);
  }
  fraction[0] = 0.0;
  for (int k = 1; k < count; k++) fraction[k] = start * geometric_sum(k, growth, NULL) / thickness;
  fraction[count] = 1.0;
  return count == 1 ? thickness : start;
}
