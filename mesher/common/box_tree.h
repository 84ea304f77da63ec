// SPDX-License-Identifier: AGPL-3.0-or-later
// A tree of axis-aligned boxes. The items are ordered along Hilbert's curve and cut into leaves, so that the tree needs
// no choice of planes, is made in one sort, and follows items that move without being made anew.
#ifndef CUTWATER_MESHER_COMMON_BOX_TREE_H
#define CUTWATER_MESHER_COMMON_BOX_TREE_H

#include <math.h>
#include <stdint.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  double low[3], high[3];
} CwBox;

typedef struct {
  int32_t count;  // items
  int32_t leaves; // slots of leaves, a power of two; node k has the children 2k and 2k + 1, the root is 1
  int32_t *item;  // in the order of the curve
  CwBox *node;    // 2 * leaves; those without items hold nothing
} CwBoxTree;

// What is called for an item whose leaf is met; a result other than 0 ends the walk.
typedef int (*CwBoxVisit)(void *context, int32_t item);

// The box of an item.
typedef CwBox (*CwBoxOf)(const void *context, int32_t item);

// Orders the items by the middles of their boxes, all of which lie in `within`. Deterministic. Collective.
CwStatus cw_box_tree_make(int32_t count, const CwBox *within, CwBoxOf box_of, const void *context, CwBoxTree *tree);
// Takes up new boxes of the same items. Collective.
CwStatus cw_box_tree_fit(CwBoxTree *tree, CwBoxOf box_of, const void *context);
// The same where only some of the first `moved_count` items, those with moved[item], have new ones.
void cw_box_tree_follow(CwBoxTree *tree, const uint8_t *moved, int32_t moved_count, CwBoxOf box_of,
                        const void *context);
void cw_box_tree_free(CwBoxTree *tree);

// Visits the items of every leaf whose box meets `box`.
void cw_box_tree_overlaps(const CwBoxTree *tree, const CwBox *box, CwBoxVisit visit, void *context);
// Visits the items of every leaf whose box the ray x + s g, 0 <= s <= *far, meets; the visitor may lower *far.
void cw_box_tree_ray(const CwBoxTree *tree, const double x[3], const double g[3], const double *far, CwBoxVisit visit,
                     void *context);

// Widens a box by another one, or by a point.
void cw_box_add(CwBox *sum, const CwBox *box);

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

// Holds nothing: what to begin with.
static inline CwBox cw_box_empty(void) {
  return (CwBox){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

static inline int cw_boxes_meet(const CwBox *a, const CwBox *b) {
  for (int k = 0; k < 3; k++) {
    if (a->low[k] > b->high[k] || b->low[k] > a->high[k]) return 0;
  }
  return 1;
}

#ifdef __cplusplus
}
#endif
#endif
