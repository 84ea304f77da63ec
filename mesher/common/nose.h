// SPDX-License-Identifier: AGPL-3.0-or-later
// A nose: between two points of a surface it turns so far that no triangle with both would lie on it.
#pragma once

#include "mesher/common/vec.h"
#include "mesher/policy.h"

// n and m: the normals there, of unit length. A triangle halfway between leans by upright_cosine to both at best.
static inline int cw_nose_between(const double n[3], const double m[3]) {
  return cw_dot(n, m) < 2 * cw_policy.upright_cosine * cw_policy.upright_cosine - 1;
}
