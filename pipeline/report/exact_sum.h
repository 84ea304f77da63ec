// SPDX-License-Identifier: AGPL-3.0-or-later
// Sums that are the same in any order: their terms are rounded to multiples of one power of two, the unit, so that no
// addition rounds (J. Demmel and H. D. Nguyen, Fast reproducible floating-point summation, 2013).
#pragma once

#include <math.h>

// The unit for terms and sums up to four times `size`, which is above 0: 2^-50 of it, or a little less.
static inline double cw_exact_unit(double size) {
  return ldexp(1, ilogb(size) - 50);
}

// x to the nearest multiple of the unit. |x| < 2^51 units.
static inline double cw_exact_term(double x, double unit) {
  const double shift = 0x1.8p52 * unit; // a double of this size has no digits below the unit
  return (x + shift) - shift;
}
