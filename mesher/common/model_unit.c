// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/model_unit.h"

#include <math.h>

#include "pipeline/significant.h"

// One a process: messages tell places in mm wherever they are made.
static double unit = 1;

void cw_model_unit_fit(double solid_unit, double extent) {
  int power;
  frexp(cw_significant(extent / solid_unit), &power); // over 2^power it is at least a half, and less than 1
  unit = ldexp(solid_unit, power + 1);
}

void cw_model_unit_set(double metres) {
  unit = metres;
}

double cw_model_unit(void) {
  return unit;
}

double cw_in_model_unit(double length) {
  return cw_significant(length / unit);
}

double cw_mm(double length) {
  return 1e3 * (length * unit);
}

double cw_mm3(double volume) {
  return 1e9 * (volume * unit * unit * unit);
}
