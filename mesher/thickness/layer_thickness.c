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

// The growth ratio, `high` at most, whose sum is `wanted`. By Newton for the logarithm of the sum over that of the
// ratio: convex, so the next steps come from above, and not far from a parabola, from which they begin.
static double solve_growth(int count, double wanted, double high) {
  double mean = 0.5 * (count - 1), bend = (count * count - 1) / 12.0; // of the exponents and, squared, about it
  double log_growth = (sqrt(fmax(0.0, mean * mean + 2 * bend * log(wanted / count))) - mean) / bend;
  double growth = fmin(exp(log_growth), high), step = 1.0;
  for (int round = 0; round < 50 && fabs(step) > 1e-8; round++) { // the square of that is rounding
    double slope, sum = geometric_sum(count, growth, &slope);
    step = log(wanted / sum) * sum / (slope * growth);
    growth = fmin(growth * exp(step), high);
  }
  return growth;
}

double cw_layer_growth_least(int count) {
  return pow(cw_policy.least_growth, (CW_LAYER_COUNT_USUAL - 1.0) / fmax(CW_LAYER_COUNT_USUAL - 1, count - 1));
}

double cw_layer_lowest(int count) {
  return geometric_sum(count, cw_layer_growth_least(count), NULL);
}

// The height of the first layer of a column, m, and the growth of those above.
static double divide(double thickness, double first, int count, double growth_max, double *growth) {
  *growth = fmax(growth_max, 1.0);
  double most_sum = geometric_sum(count, *growth, NULL);
  if (thickness >= first * most_sum) return thickness / most_sum;
  double least = cw_layer_growth_least(count), least_sum = geometric_sum(count, least, NULL);
  if (thickness <= first * least_sum) {
    *growth = least;
    return thickness / least_sum;
  }
  *growth = solve_growth(count, thickness / first, *growth);
  return first;
}

double cw_layer_fractions(double thickness, double first, int count, double growth_max, double *fraction) {
  double growth, start = divide(thickness, first, count, growth_max, &growth), sum = 0.0;
  fraction[0] = 0.0;
  for (int k = 1; k < count; k++) {
    sum = sum * growth + 1.0;
    fraction[k] = start * sum / thickness;
  }
  fraction[count] = 1.0;
  return count == 1 ? thickness : start;
}

double cw_layer_last(double thickness, double first, int count, double growth_max) {
  double growth, start = divide(thickness, first, count, growth_max, &growth);
  return 1 - start * geometric_sum(count - 1, growth, NULL) / thickness;
}
