// SPDX-License-Identifier: AGPL-3.0-or-later
// Orders for qsort: ascending numbers, or items that begin with one.
#ifndef CUTWATER_PIPELINE_ORDER_H
#define CUTWATER_PIPELINE_ORDER_H

#include <stdint.h>

static inline int cw_order_doubles(const void *left, const void *right) {
  double a = *(const double *)left, b = *(const double *)right;
  return (a > b) - (a < b);
}

static inline int cw_order_int32s(const void *left, const void *right) {
  int32_t a = *(const int32_t *)left, b = *(const int32_t *)right;
  return (a > b) - (a < b);
}

#endif
