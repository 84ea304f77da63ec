// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/box_tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/hilbert.h"
#include "mesher/common/radix.h"
#include "mesher/common/vec.h"
#include "mesher/parallel/parallel_for.h"

enum { LEAF = 4, BITS = 13, DEPTH = 64 };

static const CwTreeBox NOTHING = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static const CwTreeBox *node_box(const CwBoxTree *tree, int32_t k) {
  return k < tree->node_count ? &tree->node[k] : &NOTHING;
}

// Rounded outward.
static CwTreeBox tree_box(const CwBox *box) {
  CwTreeBox made;
  for (int k = 0; k < 3; k++) {
    made.low[k] = (float)box->low[k];
    made.high[k] = (float)box->high[k];
    if (made.low[k] > box->low[k]) made.low[k] = nextafterf(made.low[k], -INFINITY);
    if (made.high[k] < box->high[k]) made.high[k] = nextafterf(made.high[k], INFINITY);
  }
  return made;
}

static int meets(const CwTreeBox *a, const CwBox *b) {
  for (int k = 0; k < 3; k++) {
    if (a->low[k] > b->high[k] || b->low[k] > a->high[k]) return 0;
  }
  return 1;
}

// What the tasks below read.
typedef struct {
  CwBoxOf box_of;
  const void *context;
  const CwBoxTree *tree;
  const double *low;
  double cells; // a metre
} Boxes;

static CwStatus find_key(void *context, int32_t i, void *out) {
  const Boxes *boxes = context;
  CwBox box = boxes->box_of(boxes->context, i);
  uint32_t cell[3];
  for (int k = 0; k < 3; k++) cell[k] = (uint32_t)(boxes->cells * (0.5 * (box.low[k] + box.high[k]) - boxes->low[k]));
  *(uint64_t *)out = cw_hilbert_place(cell, BITS);
  return CW_OK;
}

static CwStatus find_leaf(void *context, int32_t leaf, void *out) {
  const Boxes *boxes = context;
  CwBox sum = cw_box_empty();
  for (int32_t i = leaf * LEAF; i < leaf * LEAF + LEAF && i < boxes->tree->count; i++) {
    CwBox box = boxes->box_of(boxes->context, boxes->tree->item[i]);
    cw_box_add(&sum, &box);
  }
  *(CwTreeBox *)out = tree_box(&sum);
  return CW_OK;
}

// The boxes of all nodes but the leaves.
static void join_nodes(CwBoxTree *tree) {
  for (int32_t k = tree->leaves - 1; k > 0; k--) {
    const CwTreeBox *a = node_box(tree, 2 * k), *b = node_box(tree, 2 * k + 1);
    for (int i = 0; i < 3; i++) {
      tree->node[k].low[i] = a->low[i] < b->low[i] ? a->low[i] : b->low[i];
      tree->node[k].high[i] = a->high[i] > b->high[i] ? a->high[i] : b->high[i];
    }
  }
}

static CwStatus fit(const CwContext *context, CwBoxTree *tree, CwBoxOf box_of, const void *given) {
  CwStatus status = CW_OK;
  Boxes boxes = {.box_of = box_of, .context = given, .tree = tree};
  int32_t used = (tree->count + LEAF - 1) / LEAF;
  tree->node_count = tree->leaves + used;
  CW_NEW_UNSET(tree->node, tree->node_count);
  CW_TRY(cw_parallel_for(context, "boxes of leaves", used, sizeof *tree->node, find_leaf, &boxes,
                         tree->node + tree->leaves));
  join_nodes(tree);
done:
  return status;
}

CwStatus cw_box_tree_make(const CwContext *context, int32_t count, const CwBox *within, CwBoxOf box_of,
                          const void *given, CwBoxTree *tree) {
  CwStatus status = CW_OK;
  uint64_t *key = NULL;
  CwRadix *place = NULL;
  memset(tree, 0, sizeof *tree);
  tree->count = count;
  tree->leaves = 1;
  while ((int64_t)tree->leaves * LEAF < count) tree->leaves *= 2;
  CW_NEW_UNSET(key, count);
  CW_NEW_UNSET(place, count);
  CW_NEW_UNSET(tree->own_item, count);
  tree->item = tree->own_item;
  double side = cw_box_longest(within);
  Boxes boxes = {box_of, given, tree, within->low, side > 0 ? (double)((1u << BITS) - 1) / side : 0};
  CW_TRY(cw_parallel_for(context, "places of boxes", count, sizeof *key, find_key, &boxes, key));
  for (int32_t i = 0; i < count; i++) place[i] = (CwRadix){key[i], i, 0};
  free(key);
  key = NULL;
  CW_TRY(cw_radix_sort(count, place));
  for (int32_t i = 0; i < count; i++) tree->own_item[i] = place[i].item;
  free(place);
  place = NULL;
  CW_TRY(fit(context, tree, box_of, given));
done:
  free(key);
  free(place);
  if (status != CW_OK) cw_box_tree_free(tree);
  return status;
}

CwStatus cw_box_tree_alike(const CwContext *context, const CwBoxTree *like, CwBoxOf box_of, const void *given,
                           CwBoxTree *tree) {
  CwStatus status = CW_OK;
  *tree = (CwBoxTree){.count = like->count, .leaves = like->leaves, .item = like->item};
  CW_TRY(fit(context, tree, box_of, given));
done:
  if (status != CW_OK) cw_box_tree_free(tree);
  return status;
}

void cw_box_tree_follow(CwBoxTree *tree, const uint8_t *moved, int32_t moved_count, CwBoxOf box_of,
                        const void *context) {
  Boxes boxes = {.box_of = box_of, .context = context, .tree = tree};
  for (int32_t i = 0; i < tree->count; i++) {
    int32_t leaf = i / LEAF;
    if (tree->item[i] >= moved_count || !moved[tree->item[i]]) continue;
    find_leaf(&boxes, leaf, &tree->node[tree->leaves + leaf]);
    i = leaf * LEAF + LEAF - 1; // on to the next
  }
  join_nodes(tree);
}

void cw_box_tree_free(CwBoxTree *tree) {
  free(tree->own_item);
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

static double squared_distance(const CwTreeBox *box, const double p[3]) {
  double sum = 0;
  for (int k = 0; k < 3; k++) {
    double d = cw_greater(0, cw_greater(box->low[k] - p[k], p[k] - box->high[k]));
    sum += d * d;
  }
  return sum;
}

void cw_box_tree_near(const CwBoxTree *tree, const double p[3], const double *reach, CwBoxVisit visit, void *context) {
  struct {
    int32_t node;
    double square; // of its distance
  } stack[DEPTH];
  int32_t depth = 0;
  if (tree->count) stack[depth].node = 1, stack[depth++].square = squared_distance(node_box(tree, 1), p);
  while (depth) {
    int32_t k = stack[--depth].node;
    if (!(stack[depth].square < *reach * *reach)) continue;
    if (k >= tree->leaves) {
      if (visit_leaf(tree, k, visit, context)) return;
      continue;
    }
    double left = squared_distance(node_box(tree, 2 * k), p), right = squared_distance(node_box(tree, 2 * k + 1), p);
    int far = left <= right; // the nearer one comes first
    stack[depth].node = 2 * k + far, stack[depth++].square = far ? right : left;
    stack[depth].node = 2 * k + 1 - far, stack[depth++].square = far ? left : right;
  }
}

CwBoxStarts cw_box_tree_starts(const CwBoxTree *tree, const CwBox *box) {
  CwBoxStarts starts = {.count = tree->count > 0, .node = {1}};
  for (int end = 0; !end;) {
    CwBoxStarts next = {0};
    end = 1;
    for (int32_t i = 0; i < starts.count; i++) {
      const int32_t k = starts.node[i], is_leaf = k >= tree->leaves;
      for (int32_t below = is_leaf ? k : 2 * k; below <= (is_leaf ? k : 2 * k + 1); below++) {
        if (!meets(node_box(tree, below), box)) continue;
        if (next.count == CW_BOX_STARTS) return starts;
        next.node[next.count++] = below;
      }
      end &= is_leaf;
    }
    starts = next;
  }
  return starts;
}

void cw_box_tree_overlaps_from(const CwBoxTree *tree, const CwBoxStarts *starts, const CwBox *box, CwBoxVisit visit,
                               void *context) {
  int32_t stack[CW_BOX_STARTS + DEPTH], depth = 0;
  while (depth < starts->count) stack[depth] = starts->node[starts->count - 1 - depth], depth++;
  while (depth) {
    int32_t k = stack[--depth];
    if (!meets(node_box(tree, k), box)) continue;
    if (k >= tree->leaves) {
      if (visit_leaf(tree, k, visit, context)) return;
      continue;
    }
    stack[depth++] = 2 * k + 1;
    stack[depth++] = 2 * k;
  }
}

void cw_box_tree_overlaps(const CwBoxTree *tree, const CwBox *box, CwBoxVisit visit, void *context) {
  const CwBoxStarts root = {.count = tree->count > 0, .node = {1}};
  cw_box_tree_overlaps_from(tree, &root, box, visit, context);
}

// A ray, ready to be held against boxes: along axis k the near side of any is its low[k] or high[k], and so the far
// one; both are looked at from a hair off x, so that rounding lets no ray slip between two boxes.
typedef struct {
  double inverse[3], near_x[3], far_x[3];
  int near_is_high[3];
} BoxRay;

static BoxRay ready(const CwBoxTree *tree, const double x[3], const double g[3]) {
  BoxRay ray;
  const CwTreeBox *all = node_box(tree, 1);
  double longest = 0;
  for (int k = 0; k < 3; k++) longest = fmax(longest, all->high[k] - all->low[k]);
  double hair = 1e-12 * longest;
  for (int k = 0; k < 3; k++) {
    // Large and not infinite where the ray is parallel to a side, so that no 0 * infinity comes up.
    ray.inverse[k] = fabs(g[k]) > 1e-30 ? 1 / g[k] : 1e30;
    ray.near_is_high[k] = ray.inverse[k] < 0;
    ray.near_x[k] = x[k] + (ray.near_is_high[k] ? -hair : hair);
    ray.far_x[k] = x[k] - (ray.near_is_high[k] ? -hair : hair);
  }
  return ray;
}

// Straight on, as rays are many; an empty box is as far off as one can be.
static int ray_meets(const CwTreeBox *box, const BoxRay *ray, double far) {
  double enter = 0, leave = far;
  for (int k = 0; k < 3; k++) {
    const double side[2] = {box->low[k], box->high[k]};
    int high = ray->near_is_high[k];
    enter = cw_greater(enter, (side[high] - ray->near_x[k]) * ray->inverse[k]);
    leave = cw_lesser(leave, (side[1 - high] - ray->far_x[k]) * ray->inverse[k]);
  }
  return enter <= leave;
}

// Whether some vector of a box of unit vectors may point along the unit vector g.
static int some_along(const CwTreeBox *box, const double g[3]) {
  static const double rounding = -1e-12;
  double most = 0;
  for (int k = 0; k < 3; k++) most += (g[k] > 0 ? box->high[k] : box->low[k]) * g[k];
  return most > rounding;
}

void cw_box_tree_ray(const CwBoxTree *tree, const CwBoxTree *normals, const double x[3], const double g[3],
                     const double *far, CwBoxVisit visit, void *context) {
  int32_t stack[DEPTH], depth = 0;
  if (!tree->count) return;
  BoxRay ray = ready(tree, x, g);
  stack[depth++] = 1;
  while (depth) {
    int32_t k = stack[--depth];
    if (!ray_meets(node_box(tree, k), &ray, *far) || (normals && !some_along(node_box(normals, k), g))) continue;
    if (k >= tree->leaves) {
      if (visit_leaf(tree, k, visit, context)) return;
      continue;
    }
    stack[depth++] = 2 * k + 1;
    stack[depth++] = 2 * k;
  }
}
