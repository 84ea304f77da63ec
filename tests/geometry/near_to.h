// SPDX-License-Identifier: AGPL-3.0-or-later
// A number within a tolerance, for C and C++; the test that fails says by how much.
#ifndef CUTWATER_TESTS_GEOMETRY_NEAR_TO_H
#define CUTWATER_TESTS_GEOMETRY_NEAR_TO_H

#include <math.h>

#include "tests/unit_test.h"

static inline void near_to(double value, double expected, double tolerance) {
  if (!(fabs(value - expected) <= tolerance)) fail_msg("%.12g is not %.12g within %.3g", value, expected, tolerance);
}

#endif
