// SPDX-License-Identifier: AGPL-3.0-or-later
#include <stdlib.h>

#include "mesher/layers_inner.h"

enum { LEAF = 4 };

typedef struct {
  double low[3], high[3];
  int32_t first, count; // leaf: items; inner: count 0, children at `first` and `first + 1`
} Node;

struct CwGapTree {
  Node *node;
  int32_t node_count;
  int32_t *item; // wall triangles first, then obstacles
  double (*middle)[3];
};

// Corner coordinates of triangle f of walls and obstacles together.
static void corners(const CwLayerInput *in, int32_t f, const double *corner[3]) {
  for (int i = 0; i < 3; i++)
    corner[i] = f < in->triangle_count ? in->x[in->triangle[f][i]]
                                       : in->obstacle_x[in->obstacle_triangle[f - in->triangle_count][i]];
}

// Puts the items with the smaller middles along `axis` before `nth` (quickselect; ties by number, so the
// same each run).
static void divide(CwGapTree *tree, int32_t low, int32_t high, int32_t nth, int axis) {
  while (low < high) {
    int32_t pivot = tree->item[(low + high) / 2], i = low, j = high;
    double key = tree->middle[pivot][axis];
    while (i <= j) {
      for (;; i++) {
        double k = tree->middle[tree->item[i]][axis];
        if (!(k < key || (k == key && tree->item[i] < pivot))) break;
      }
      for (;; j--) {
        double k = tree->middle[tree->item[j]][axis];
        if (!(k > key || (k == key && tree->item[j] > pivot))) break;
      }
      if (i <= j) {
        int32_t swap = tree->item[i];
        tree->item[i++] = tree->item[j];
        tree->item[j--] = swap;
      }
    }
    if (nth <= j)
      high = j;
    else if (nth >= i)
      low = i;
    else
      return;
  }
}

static void build(const CwLayerInput *in, CwGapTree *tree, int32_t at, int32_t first, int32_t count) {
  Node *node = &tree->node[at];
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  for (int k = 0; k < 3; k++) node->low[k] = INFINITY, node->high[k] = -INFINITY;
  for (int32_t i = first; i < first + count; i++) {
    const double *corner[3];
    corners(in, tree->item[i], corner);
    for (int k = 0; k < 3; k++) {
      for (int c = 0; c < 3; c++) {
        node->low[k] = fmin(node->low[k], corner[c][k]);
        node->high[k] = fmax(node->high[k], corner[c][k]);
      }
      low[k] = fmin(low[k], tree->middle[tree->item[i]][k]);
      high[k] = fmax(high[k], tree->middle[tree->item[i]][k]);
    }
  }
  node->first = first;
  node->count = count;
  if (count <= LEAF) return;
  int axis = 0;
  for (int k = 1; k < 3; k++)
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  divide(tree, first, first + count - 1, first + count / 2, axis);
  node->first = tree->node_count;
  node->count = 0;
  tree->node_count += 2;
  int32_t child = node->first;
  build(in, tree, child, first, count / 2);
  build(in, tree, child + 1, first + count / 2, count - count / 2);
}

CwStatus cw_gap_tree_make(const CwLayerWork *work, CwGapTree **tree) {
  CwStatus status = CW_OK;
  const CwLayerInput *in = work->in;
  int32_t total = in->triangle_count + in->obstacle_triangle_count;
  CW_NEW(*tree, 1);
  CW_NEW((*tree)->node, 2 * (size_t)total + 1);
  CW_NEW((*tree)->item, total);
  CW_NEW((*tree)->middle, total);
  for (int32_t f = 0; f < total; f++) {
    const double *corner[3];
    corners(in, f, corner);
    (*tree)->item[f] = f;
    for (int k = 0; k < 3; k++) (*tree)->middle[f][k] = (corner[0][k] + corner[1][k] + corner[2][k]) / 3;
  }
  (*tree)->node_count = 1;
  if (total > 0) build(in, *tree, 0, 0, total);
done:
  return status;
}

void cw_gap_tree_free(CwGapTree *tree) {
  if (!tree) return;
  free(tree->node);
  free(tree->item);
  free(tree->middle);
  free(tree);
}

// Way along the ray to the triangle, or INFINITY (Moller and Trumbore). *facing: cosine between ray and the
// normal that points
// out of the domain.
static double hit(const CwLayerInput *in, int32_t f, const double x[3], const double g[3], double *facing) {
  const double *corner[3];
  double e1[3], e2[3], p[3], q[3], s[3], normal[3];
  corners(in, f, corner);
  sub3(corner[1], corner[0], e1);
  sub3(corner[2], corner[0], e2);
  cross3(e1, e2, normal);
  if (unit3(normal) == 0) return INFINITY;
  *facing = dot3(normal, g);
  cross3(g, e2, p);
  double det = dot3(e1, p);
  if (det == 0) return INFINITY;
  sub3(x, corner[0], s);
  // Rays often aim at vertices and edges of the other side: a hair of tolerance lets none slip between two
  // triangles.
  const double hair = 1e-9;
  double u = dot3(s, p) / det;
  if (u < -hair || u > 1 + hair) return INFINITY;
  cross3(s, e1, q);
  double w = dot3(g, q) / det;
  if (w < -hair || u + w > 1 + hair) return INFINITY;
  return dot3(e2, q) / det;
}

static int in_box(const Node *node, const double x[3], const double g[3], double far) {
  double enter = 0, leave = far;
  for (int k = 0; k < 3; k++) {
    double hair = 1e-9 * (node->high[k] - node->low[k]) + 1e-15;
    if (g[k] == 0) {
      if (x[k] < node->low[k] - hair || x[k] > node->high[k] + hair) return 0;
      continue;
    }
    double a = (node->low[k] - hair - x[k]) / g[k], b = (node->high[k] + hair - x[k]) / g[k];
    enter = fmax(enter, fmin(a, b));
    leave = fmin(leave, fmax(a, b));
  }
  return enter <= leave * (1 + 1e-12);
}

// Walls around v, and walls at a concave crease next to v, bound no gap: the fan keeps columns clear of
// those.
static int belongs_to_crease(const CwLayerWork *work, int32_t v, int32_t f) {
  for (int i = 0; i < 3; i++) {
    int32_t w = work->in->triangle[f][i];
    if (w == v) return 1;
    if (work->crease[w] != CW_CREASE_CONCAVE) continue;
    for (int32_t k = work->near_start[v]; k < work->near_start[v + 1]; k++)
      if (work->near[k] == w) return 1;
  }
  return 0;
}

// Largest height that the gap along the column of v allows; INFINITY where nothing stands within reach.
static double free_height(const CwLayerWork *work, const CwGapTree *tree, int32_t v) {
  const CwLayerInput *in = work->in;
  int32_t stack[128], depth = 0;
  double g[3] = {work->column[v][0], work->column[v][1], work->column[v][2]};
  double stretch = unit3(g), offset = 1e-3 * work->edge_min[v], best = INFINITY;
  double far = in->target[v] * stretch / 0.35;
  int guided = in->guide_count && in->guide_count[v] > 0;
  if (tree->node_count && in->triangle_count + in->obstacle_triangle_count) stack[depth++] = 0;
  while (depth) {
    const Node *node = &tree->node[stack[--depth]];
    if (!in_box(node, in->x[v], g, far)) continue;
    if (node->count == 0) {
      stack[depth++] = node->first;
      stack[depth++] = node->first + 1;
      continue;
    }
    for (int32_t i = node->first; i < node->first + node->count; i++) {
      int32_t f = tree->item[i];
      int wall = f < in->triangle_count;
      double facing = 0, way = hit(in, f, in->x[v], g, &facing);
      if (way <= offset || way > far) continue;
      if (wall) {
        if (facing < 0.05 || belongs_to_crease(work, v, f)) continue;
        best = fmin(best, 0.35 * way / stretch);
      } else {
        // A column on a rim runs inside its own cap and must not take that for an obstacle.
        if (facing < (guided ? 0.3 : 0.05)) continue;
        best = fmin(best, 0.6 * way / stretch);
      }
    }
  }
  return best;
}

void cw_layers_limit_by_gap(CwLayerWork *work, const CwGapTree *tree) {
  for (int32_t v = 0; v < work->n; v++) {
    double most = free_height(work, tree, v);
    work->t[v] = fmin(work->in->target[v], most);
    work->reason[v] = work->t[v] < work->in->target[v] ? CW_LAYER_GAP : CW_LAYER_FULL;
  }
}

CwStatus cw_layers_grade(CwLayerWork *work) {
  CwStatus status = CW_OK;
  const double slope = 0.3;
  CwHeap heap = {0};
  for (int32_t v = 0; v < work->n; v++) {
    int low = 0;
    for (int32_t k = work->near_start[v]; k < work->near_start[v + 1] && !low; k++) {
      int32_t w = work->near[k];
      low = work->t[w] > work->t[v] + slope * distance3(work->in->x[v], work->in->x[w]);
    }
    if (low) CW_TRY(cw_heap_push(&heap, work->t[v], v));
  }
  while (heap.count) {
    CwHeapItem top = cw_heap_pop(&heap);
    int32_t v = top.v;
    if (top.key > work->t[v]) continue;
    for (int32_t k = work->near_start[v]; k < work->near_start[v + 1]; k++) {
      int32_t w = work->near[k];
      double most = work->t[v] + slope * distance3(work->in->x[v], work->in->x[w]);
      if (work->t[w] <= most) continue;
      work->t[w] = most;
      work->reason[w] = CW_LAYER_GRADATION;
      CW_TRY(cw_heap_push(&heap, most, w));
    }
  }
done:
  cw_heap_free(&heap);
  return status;
}
