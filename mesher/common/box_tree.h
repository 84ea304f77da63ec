// SPDX-License-Identifier: AGPL-3.0-or-later
// A tree of axis-aligned boxes. The items are ordered along Hilbert's curve and cut into leaves, so that the tree needs
// no choice of planes, is made in one sort, and follows items that move without being made anew.
#pragma once

#include <stdint.h>

#include "mesher/common/box.h"
#include "mesher/parallel/context.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// A box in half the memory, not smaller than the box it is made from: what is visited is looked at anyway.
typedef struct {
  float low[3], high[3];
} CwTreeBox;

typedef struct {
  int32_t count;       // items
  int32_t leaves;      // slots of leaves, a power of two; node k has the children 2k and 2k + 1, the root is 1
  int32_t node_count;  // those beyond hold nothing
  const int32_t *item; // in the order of the curve
  int32_t *own_item;   // the same; NULL: another tree's
  CwTreeBox *node;
} CwBoxTree;

// What is called for an item whose leaf is met; a result other than 0 ends the walk.
typedef int (*CwBoxVisit)(void *context, int32_t item);

// The box of an item.
typedef CwBox (*CwBoxOf)(const void *context, int32_t item);

// Orders the items by the middles of their boxes, all of which lie in `within`. Deterministic. given: to box_of.
CwStatus cw_box_tree_make(const CwContext *context, int32_t count, const CwBox *within, CwBoxOf box_of,
                          const void *given, CwBoxTree *tree);
// A tree of other boxes of the same items, in the order of `like`, which must outlive it.
CwStatus cw_box_tree_alike(const CwContext *context, const CwBoxTree *like, CwBoxOf box_of, const void *given,
                           CwBoxTree *tree);
// Takes up new boxes where only some of the first `moved_count` items, those with moved[item], have new ones.
void cw_box_tree_follow(CwBoxTree *tree, const uint8_t *moved, int32_t moved_count, CwBoxOf box_of,
                        const void *context);
void cw_box_tree_free(CwBoxTree *tree);

// Visits the items of every leaf whose box meets `box`.
void cw_box_tree_overlaps(const CwBoxTree *tree, const CwBox *box, CwBoxVisit visit, void *context);

// Visits the items of every leaf whose box comes nearer to p than *reach, which the visitor may lower; of two halves of
// a node the nearer one first.
void cw_box_tree_near(const CwBoxTree *tree, const double p[3], const double *reach, CwBoxVisit visit, void *context);

// Nodes of a tree, in its order, below which all lies that meets a box: from there walks for many boxes within it go
// the shorter way.
enum { CW_BOX_STARTS = 32 };
typedef struct {
  int32_t count, node[CW_BOX_STARTS];
} CwBoxStarts;
CwBoxStarts cw_box_tree_starts(const CwBoxTree *tree, const CwBox *box);
void cw_box_tree_overlaps_from(const CwBoxTree *tree, const CwBoxStarts *starts, const CwBox *box, CwBoxVisit visit,
                               void *context);

// Visits the items of every leaf whose box the ray x + s g, 0 <= s <= *far, meets, |g| = 1; the visitor may lower *far.
// normals: a tree alike of their unit normals, for who wants those alone that the ray passes to the side of the normal;
// most of the others are left out. NULL: all.
void cw_box_tree_ray(const CwBoxTree *tree, const CwBoxTree *normals, const double x[3], const double g[3],
                     const double *far, CwBoxVisit visit, void *context);

#ifdef __cplusplus
}
#endif
