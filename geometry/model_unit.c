// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/model_unit.h"

#include <math.h>

static const double millimetre = 1e-3; // m
enum { SIZE_EXPONENT = 8 };            // D2 is less than 2^8 units

double cw_model_unit(double outlet_diameter) {
  int exponent;
  frexp(outlet_diameter / millimetre, &exponent);
  return ldexp(millimetre, exponent - SIZE_EXPONENT);
}
