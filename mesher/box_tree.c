// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/box_tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/hilbert.h"
#include "mesher/share.h"

enum { LEAF = 4, BITS = 13, DEPTH = 64, DIGIT_BITS = 13, DIGIT = (1 << DIGIT_BITS) - 1 };

typedef struct {
  uint64_t key;
  int32_t item;
} Place;

// Sorts by key, digit by digit from the least; equal keys keep their order.
static CwStatus sort_places(int32_t count, Place *place) {
  CwStatus status = CW_OK;
  Place *other = NULL;
  CW_NEW(other, count);
  for (int shift = 0; shift < 3 * BITS; shift += DIGIT_BITS) {
    int32_t start[1 << DIGIT_BITS] = {0}, sum = 0;
    for (int32_t i = 0; i < count; i++) start[place[i].key >> shift & DIGIT]++;
    for (int32_t d = 0; d <= DIGIT; d++) {
      int32_t found = start[d];
      start[d] = sum;
      sum += found;
    }
    for (int32_t i = 0; i < count; i++) other[start[place[i].key >> shift & DIGIT]++] = place[i];
    memcpy(place, other, (size_t)count * sizeof *place);
  }
done:
  free(other);
  return status;
}

static const CwBox NOTHING = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void add_box(CwBox *sum, const CwBox *box) {
  for (int k = 0; k < 3; k++) {
    if (box->low[k] < sum->low[k]) sum->low[k] = box->low[k];
    if (box->high[k] > sum->high[k]) sum->high[k] = box->high[k];
  }
}

typedef struct {
  const CwBox *box;
  const double *low;
  double cells; // a metre
} Curve;

static CwStatus find_place(void *context, int32_t i, void *out) {
  const Curve *curve = context;
  const CwBox *box = &curve->box[i];
  uint32_t cell[3];
  for (int k = 0; k < 3; k++) cell[k] = (uint32_t)(curve->cells * (0.5 * (box->low[k] + box->high[k]) - curve->low[k]));
  *(Place *)out = (Place){cw_hilbert_place(cell, BITS), i};
  return CW_OK;
}

CwStatus cw_box_tree_make(int32_t count, const CwBox *box, CwBoxTree *tree) {
  CwStatus status = CW_OK;
  Place *place = NULL;
  CwBox all = NOTHING;
  memset(tree, 0, sizeof *tree);
  tree->count = count;
  tree->leaves = 1;
  while ((int64_t)tree->leaves * LEAF < count) tree->leaves *= 2;
  CW_NEW(place, count);
  CW_NEW(tree->item, count);
  CW_NEW(tree->node, 2 * (size_t)tree->leaves);
  double side = 0;
  for (int32_t i = 0; i < count; i++) add_box(&all, &box[i]);
  for (int k = 0; k < 3; k++) side = fmax(side, all.high[k] - all.low[k]);
  double cells = side > 0 ? (double)((1u << BITS) - 1) / side : 0;
  Curve curve = {box, all.low, cells};
  CW_TRY(cw_share("places of boxes", count, sizeof *place, find_place, &curve, place));
  CW_TRY(sort_places(count, place));
  for (int32_t i = 0; i < count; i++) tree->item[i] = place[i].item;
  cw_box_tree_fit(tree, box);
done:
  free(place);
  if (status != CW_OK) cw_box_tree_free(tree);
  return status;
}

void cw_box_tree_fit(CwBoxTree *tree, const CwBox *box) {
  for (int32_t k = 0; k < 2 * tree->leaves; k++) tree->node[k] = NOTHING;
  for (int32_t i = 0; i < tree->count; i++) add_box(&tree->node[tree->leaves + i / LEAF], &box[tree->item[i]]);
  for (int32_t k = tree->leaves - 1; k > 0; k--) {
    add_box(&tree->node[k], &tree->node[2 * k]);
    add_box(&tree->node[k], &tree->node[2 * k + 1]);
  }
}

void cw_box_tree_free(CwBoxTree *tree) {
  free(tree->item);
  free(tree->node);
  memset(tree, 0, sizeof *tree);
}

// Visits the items of leaf node k; whether the walk ends.
static int visit_leaf(const CwBoxTree *tree, int32_t k, CwBoxVisit visit, void *context) {
  int32_t first = (k - tree->leaves) * LEAF;
  for (int32_t i = first; i < first + LEAF && i < tree->count; i++) {
    if (visit(context, tree->item[i])) return 1;
  }
  return 0;
}

void cw_box_tree_overlaps(const CwBoxTree *tree, const CwBox *box, CwBoxVisit visit, void *context) {
  int32_t stack[DEPTH], depth = 0;
  if (tree->count) stack[depth++] = 1;
  while (depth) {
    int32_t k = stack[--depth];
    if (!cw_boxes_meet(&tree->node[k], box)) continue;
    if (k >= tree->leaves) {
      if (visit_leaf(tree, k, visit, context)) return;
      continue;
    }
    stack[depth++] = 2 * k + 1;
    stack[depth++] = 2 * k;
  }
}

static int ray_meets(const CwBox *box, const double x[3], const double g[3], const double inverse[3], double far) {
  double enter = 0, leave = far;
  for (int k = 0; k < 3; k++) {
    double hair = 1e-9 * (box->high[k] - box->low[k]) + 1e-15;
    if (!(box->low[k] <= box->high[k])) return 0;
    if (g[k] == 0) {
      if (x[k] < box->low[k] - hair || x[k] > box->high[k] + hair) return 0;
      continue;
    }
    double a = (box->low[k] - hair - x[k]) * inverse[k], b = (box->high[k] + hair - x[k]) * inverse[k];
    double near = a < b ? a : b, away = a < b ? b : a;
    if (near > enter) enter = near;
    if (away < leave) leave = away;
  }
  return enter <= leave * (1 + 1e-12);
}

void cw_box_tree_ray(const CwBoxTree *tree, const double x[3], const double g[3], const double *far, CwBoxVisit visit,
                     void *context) {
  int32_t stack[DEPTH], depth = 0;
  double inverse[3];
  for (int k = 0; k < 3; k++) inverse[k] = 1 / g[k];
  if (tree->count) stack[depth++] = 1;
  while (depth) {
    int32_t k = stack[--depth];
    if (!ray_meets(&tree->node[k], x, g, inverse, *far)) continue;
    if (k >= tree->leaves) {
      if (visit_leaf(tree, k, visit, context)) return;
      continue;
    }
    stack[depth++] = 2 * k + 1;
    stack[depth++] = 2 * k;
  }
}
