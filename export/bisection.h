// SPDX-License-Identifier: AGPL-3.0-or-later
// Recursive coordinate bisection: points into groups of given sizes, by planes across the longest extent.
#pragma once

#include <stdint.h>

// The group of each of `count` points, from 0; `sizes` (all above 0) sum to `count`. The list of groups is halved, then
// the points at a plane so that either half has its share, and so on; points at one plane go by their index. `order`:
// room for `count` numbers.
void cw_bisection(const double (*points)[3], int32_t count, const int64_t *sizes, int groups, int32_t *order,
                  int32_t *group);
