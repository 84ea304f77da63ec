// SPDX-License-Identifier: AGPL-3.0-or-later
// Orders for qsort: ascending numbers, or items that begin with one; the search in ascending numbers.
#pragma once

#include <stdint.h>

static inline int cw_order_doubles(const void *left, const void *right) {
  double a = *(const double *)left, b = *(const double *)right;
  return (a > b) - (a < b);
}

static inline int cw_order_int32s(const void *left, const void *right) {
  int32_t a = *(const int32_t *)left, b = *(const int32_t *)right;
  return (a > b) - (a < b);
}

// Of `count` numbers, two or more, the last but the end one that is no greater than `place`, or the first: it lies
// between that and the next.
static inline int cw_interval_of(int count, const double *bound, double place) {
  int low = 0, high = count - 1;
  while (high - low > 1) {
    int middle = (low + high) / 2;
    *(bound[middle] <= place ? &low : &high) = middle;
  }
  return low;
}
