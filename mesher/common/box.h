// SPDX-License-Identifier: AGPL-3.0-or-later
// Boxes along the axes: of points, of triangles, of other boxes.
#pragma once

#include <math.h>
#include <stdint.h>

#include "mesher/common/vec.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  double low[3], high[3];
} CwBox;

// Holds nothing: what to begin with.
static inline CwBox cw_box_empty(void) {
  return (CwBox){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

// Widens a box by a point.
static inline void cw_box_add_point(CwBox *box, const double x[3]) {
  for (int k = 0; k < 3; k++) {
    box->low[k] = x[k] < box->low[k] ? x[k] : box->low[k];
    box->high[k] = x[k] > box->high[k] ? x[k] : box->high[k];
  }
}

static inline CwBox cw_box_of_point(const double x[3]) {
  return (CwBox){{x[0], x[1], x[2]}, {x[0], x[1], x[2]}};
}

static inline CwBox cw_box_of_triangle(const double a[3], const double b[3], const double c[3]) {
  CwBox box = cw_box_of_point(a);
  cw_box_add_point(&box, b);
  cw_box_add_point(&box, c);
  return box;
}

// The unit normal of a triangle, as a box that nothing else is in (cw_box_tree_ray).
static inline CwBox cw_box_of_normal(const double a[3], const double b[3], const double c[3]) {
  double normal[3];
  cw_normal(a, b, c, normal);
  cw_unit(normal);
  return cw_box_of_point(normal);
}

static inline int cw_boxes_meet(const CwBox *a, const CwBox *b) {
  for (int k = 0; k < 3; k++) {
    if (a->low[k] > b->high[k] || b->low[k] > a->high[k]) return 0;
  }
  return 1;
}

// Widens a box by another one.
void cw_box_add(CwBox *sum, const CwBox *box);

// The box of all points; the empty one where there are none.
CwBox cw_box_of_points(int32_t count, const double (*x)[3]);

// The longest side; 0 of the empty box.
double cw_box_longest(const CwBox *box);

#ifdef __cplusplus
}
#endif
