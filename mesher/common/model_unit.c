// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/model_unit.h"

#include <math.h>

// One a process: messages tell places in mm wherever they are made.
static double unit = 1;

int cw_model_unit_power(double extent) {
  int power;
  frexp(extent, &power); // extent / 2^power is at least a half, and less than 1
  return power + 1;
}

void cw_model_unit_set(int power) {
  unit = ldexp(1, power);
}

double cw_model_unit(void) {
  return unit;
}

double cw_mm(double length) {
  return 1e3 * (length * unit);
}

double cw_mm3(double volume) {
  return 1e9 * (volume * unit * unit * unit);
}
