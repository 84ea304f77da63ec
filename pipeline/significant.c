// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/significant.h"

#include <math.h>

enum { BITS = 34 };

double cw_significant(double x) {
  int exponent;
  const double mantissa = frexp(x, &exponent);
  return isfinite(x) ? ldexp(nearbyint(ldexp(mantissa, BITS)), exponent - BITS) : x;
}

double cw_multiple(double x, int power) {
  return ldexp(nearbyint(ldexp(x, -power)), power);
}
