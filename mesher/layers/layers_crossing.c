// SPDX-License-Identifier: AGPL-3.0-or-later
// Pairs of triangles of layer top, wall and open patches that cross. The first search looks at everything, the later
// ones at what moved since the last alone. Most pairs of neighbouring boxes are told apart by a plane along one of the
// triangles; what is left is judged exactly.
#include "mesher/layers/layers_crossing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/box_tree.h"
#include "mesher/common/intersect.h"
#include "mesher/common/vec.h"
#include "mesher/layers/layers_normal.h"
#include "mesher/parallel/schedule.h"

enum { BLOCK = 2048, GROUP = 16 };      // triangles of a task; neighbours that are looked for together
static const double LEAST_SHARE = 0.01; // of its target: a column this thin that still crosses will not get clear
static const double CLEAR = 1e-9;       // way between plane and triangle, over the longest edge, beyond any rounding

// A triangle of the kind: 0 layer top, 1 wall, 2 open patches. Points are numbered through: layer top, wall, open
// patches. Where a column has no height the layer top has the wall's point.
typedef struct {
  int32_t corner[3];
  const double *x[3];
} Triangle;

static Triangle triangle_of(const CwLayerCrossing *crossing, int kind, int32_t f) {
  Triangle triangle;
  const CwLayerInput *in = crossing->work->in;
  const int32_t *given = kind == 2 ? in->obstacle_triangle[f] : in->triangle[f];
  const double(*x)[3] = kind == 0 ? crossing->moved_to : kind == 1 ? in->x : in->obstacle_x;
  for (int i = 0; i < 3; i++) {
    int on_wall = kind == 1 || (kind == 0 && cw_layer_pinched(in, given[i]));
    triangle.corner[i] = given[i] + (on_wall ? 1 : kind) * in->point_count;
    triangle.x[i] = x[given[i]];
  }
  return triangle;
}

// Whether a plane normal to m leaves a on one side and b on the other, strictly but for the point they may share.
static int parts(const double m[3], const double *const a[3], const double *const b[3], int shared_a, int shared_b,
                 double clear) {
  double low_a = INFINITY, high_a = -INFINITY, low_b = INFINITY, high_b = -INFINITY;
  const double *o = shared_a >= 0 ? a[shared_a] : a[0];
  for (int i = 0; i < 3; i++) {
    double d[3], s;
    if (i != shared_a) {
      cw_sub(a[i], o, d);
      s = cw_dot(m, d);
      low_a = s < low_a ? s : low_a, high_a = s > high_a ? s : high_a;
    }
    if (i != shared_b) {
      cw_sub(b[i], o, d);
      s = cw_dot(m, d);
      low_b = s < low_b ? s : low_b, high_b = s > high_b ? s : high_b;
    }
  }
  if (shared_a < 0) return low_b - high_a > clear || low_a - high_b > clear;
  double none = 1e-3 * clear; // what is zero but for rounding
  return (high_a <= none && low_b > clear) || (low_a >= -none && high_b < -clear) ||
         (high_b <= none && low_a > clear) || (low_b >= -none && high_a < -clear);
}

static int kept_apart(const double *const a[3], const double *const b[3], int shared_a, int shared_b) {
  const double *const *side[2] = {a, b};
  for (int s = 0; s < 2; s++) {
    const double *const *t = side[s];
    double e[3][3], n[3], longest = 0;
    for (int i = 0; i < 3; i++) {
      cw_sub(t[(i + 1) % 3], t[i], e[i]);
      longest = fmax(longest, cw_dot(e[i], e[i]));
    }
    cw_cross(e[0], e[1], n);
    longest = sqrt(longest);
    if (cw_unit(n) == 0) return 0;
    if (parts(n, a, b, shared_a, shared_b, CLEAR * longest)) return 1;
    for (int i = 0; i < 3; i++) {
      double m[3];
      cw_cross(e[i], n, m);
      cw_unit(m);
      if (parts(m, a, b, shared_a, shared_b, CLEAR * longest)) return 1;
    }
  }
  return 0;
}

static int cross(const Triangle *a, const Triangle *b) {
  const double *const *p = a->x, *const *q = b->x;
  static const int32_t of_a[3] = {0, 1, 2};
  int32_t of_b[3] = {3, 4, 5};
  double x[6][3];
  int shared = 0, in_a = -1, in_b = -1;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      if (a->corner[i] == b->corner[j]) shared++, in_a = i, in_b = j, of_b[j] = i;
  if (shared == 2) { // they overlap only where folded flat onto each other, and then their normals are opposite
    double n[3], m[3];
    cw_normal(p[0], p[1], p[2], n);
    cw_normal(q[0], q[1], q[2], m);
    if (cw_dot(n, m) > -0.9 * cw_norm(n) * cw_norm(m)) return 0;
  } else if (shared < 2 && kept_apart(p, q, in_a, in_b)) {
    return 0;
  }
  for (int i = 0; i < 3; i++) {
    cw_copy(p[i], x[i]);
    cw_copy(q[i], x[3 + i]);
  }
  return cw_triangles_cross((const double(*)[3])x, of_a, of_b);
}

static CwBox box_of(const CwLayerCrossing *crossing, int kind, int32_t f) {
  const Triangle triangle = triangle_of(crossing, kind, f);
  return cw_box_of_triangle(triangle.x[0], triangle.x[1], triangle.x[2]);
}

// The box of a triangle of the wall or of an open patch.
static CwBox box_of_fixed(const void *context, int32_t item) {
  const CwLayerCrossing *crossing = context;
  int32_t walls = crossing->work->in->triangle_count;
  return item < walls ? box_of(crossing, 1, item) : box_of(crossing, 2, item - walls);
}

// The box of a triangle of the layer top; an open patch has none.
static CwBox box_of_top(const void *context, int32_t item) {
  const CwLayerCrossing *crossing = context;
  if (item >= crossing->work->in->triangle_count) return cw_box_empty();
  return box_of(crossing, 0, item);
}

CwStatus cw_layers_crossing_make(const CwLayerWork *work, CwLayerCrossing *crossing) {
  CwStatus status = CW_OK;
  const CwLayerInput *in = work->in;
  crossing->work = work;
  crossing->item_count = in->triangle_count + in->obstacle_triangle_count;
  CW_NEW(crossing->active, in->triangle_count);
  CW_NEW(crossing->list, in->triangle_count);
done:
  return status;
}

void cw_layers_crossing_free(CwLayerCrossing *crossing) {
  free(crossing->active);
  free(crossing->list);
  free(crossing->pair);
  cw_box_tree_free(&crossing->fixed);
  cw_box_tree_free(&crossing->top);
}

// The tree of what is fixed, unless it was given, and that of the layer top in the same order: prisms, which are tall
// in fine meshes, would meet many that neither their tops nor their walls do.
static CwStatus make_trees(CwLayerCrossing *crossing) {
  CwStatus status = CW_OK;
  const CwLayerInput *in = crossing->work->in;
  const CwContext *context = in->context;
  if (crossing->fixed.count == 0) {
    CwBox within = cw_box_empty();
    for (int32_t v = 0; v < in->point_count; v++) cw_box_add_point(&within, in->x[v]);
    for (int32_t v = 0; v < in->obstacle_point_count; v++) cw_box_add_point(&within, in->obstacle_x[v]);
    CW_TRY(cw_box_tree_make(context, crossing->item_count, &within, box_of_fixed, crossing, &crossing->fixed));
  }
  CW_TRY(cw_box_tree_alike(context, &crossing->fixed, box_of_top, crossing, &crossing->top));
done:
  return status;
}

// Crossing pairs that one block of triangles has found.
typedef struct {
  const CwLayerCrossing *crossing;
  int32_t f;
  int constrained;
  CwBox top, wall;
  CwLayerPair *pair;
  size_t count, capacity;
  CwStatus status;
} Finder;

static CwStatus add_pair(Finder *finder, int kind_f, int kind_g, int32_t g) {
  CwStatus status = CW_OK;
  CW_GROW(finder->pair, finder->capacity, finder->count + 1);
  finder->pair[finder->count++] = (CwLayerPair){finder->f, g, kind_f, kind_g};
done:
  return status;
}

// Tries triangle f of one kind against g of another.
static CwStatus try_pair(Finder *finder, int kind_f, int kind_g, int32_t g) {
  CwStatus status = CW_OK;
  const Triangle b = triangle_of(finder->crossing, kind_g, g);
  const CwBox box = cw_box_of_triangle(b.x[0], b.x[1], b.x[2]);
  if (!cw_boxes_meet(kind_f ? &finder->wall : &finder->top, &box)) goto done;
  const Triangle a = triangle_of(finder->crossing, kind_f, finder->f);
  if (cross(&a, &b)) CW_TRY(add_pair(finder, kind_f, kind_g, g));
done:
  return status;
}

// An open patch's triangle without area crosses nothing that its neighbours do not.
static int has_area(const CwLayerInput *in, int32_t g) {
  const int32_t *v = in->obstacle_triangle[g];
  double a[3], b[3], n[3];
  cw_sub(in->obstacle_x[v[1]], in->obstacle_x[v[0]], a);
  cw_sub(in->obstacle_x[v[2]], in->obstacle_x[v[0]], b);
  cw_cross(a, b, n);
  return cw_norm(n) > 1e-12 * (cw_dot(a, a) + cw_dot(b, b));
}

// Layer top against layer top.
static int visit_top(void *context, int32_t item) {
  Finder *finder = context;
  const CwLayerCrossing *crossing = finder->crossing;
  if (item >= crossing->work->in->triangle_count || item == finder->f) return 0;
  int twice = crossing->active[item] && item < finder->f;
  if (!twice) finder->status = try_pair(finder, 0, 0, item);
  return finder->status != CW_OK;
}

// Whether a triangle of the layer top is that of the wall: none of its columns has a height.
static int is_on_wall(const CwLayerInput *in, int32_t f) {
  const int32_t *v = in->triangle[f];
  return cw_layer_pinched(in, v[0]) && cw_layer_pinched(in, v[1]) && cw_layer_pinched(in, v[2]);
}

// Layer top against the wall and the open patches.
static int visit_fixed(void *context, int32_t item) {
  Finder *finder = context;
  const CwLayerInput *in = finder->crossing->work->in;
  int32_t walls = in->triangle_count;
  if (item == finder->f && is_on_wall(in, item)) return 0;
  if (item < walls)
    finder->status = try_pair(finder, 0, 1, item);
  else if (!finder->constrained && has_area(in, item - walls))
    finder->status = try_pair(finder, 0, 2, item - walls);
  return finder->status != CW_OK;
}

// Wall against wall.
static int visit_wall(void *context, int32_t item) {
  Finder *finder = context;
  if (item < finder->crossing->work->in->triangle_count && finder->f < item)
    finder->status = try_pair(finder, 1, 1, item);
  return finder->status != CW_OK;
}

// Whether a column of layer top triangle f runs in a constraint: there it touches its open patch, as it should, and the
// two triangulations of a curved open patch differ by their chords.
static int is_constrained(const CwLayerInput *in, int32_t f) {
  if (!in->constraint_count) return 0;
  for (int i = 0; i < 3; i++) {
    if (in->constraint_count[in->triangle[f][i]]) return 1;
  }
  return 0;
}

// Triangles that follow one another in the order of the trees lie together.
static CwStatus search_block(void *context, int32_t block, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  const CwLayerCrossing *crossing = context;
  int32_t first = block * BLOCK, last = crossing->list_count - first < BLOCK ? crossing->list_count : first + BLOCK;
  Finder finder = {.crossing = crossing};
  for (int32_t from = first; from < last; from += GROUP) {
    int32_t to = last - from < GROUP ? last : from + GROUP;
    CwBox top = cw_box_empty(), wall = cw_box_empty();
    for (int32_t i = from; i < to; i++) {
      CwBox one = box_of(crossing, 0, crossing->list[i]), below = box_of(crossing, 1, crossing->list[i]);
      cw_box_add(&top, &one);
      cw_box_add(&wall, &below);
    }
    const CwBoxStarts tops = cw_box_tree_starts(&crossing->top, &top);
    const CwBoxStarts fixed = cw_box_tree_starts(&crossing->fixed, &top);
    const CwBoxStarts walls = crossing->searched ? (CwBoxStarts){0} : cw_box_tree_starts(&crossing->fixed, &wall);
    for (int32_t i = from; i < to; i++) {
      int32_t f = finder.f = crossing->list[i];
      finder.constrained = is_constrained(crossing->work->in, f);
      finder.top = box_of(crossing, 0, f);
      finder.wall = box_of(crossing, 1, f);
      cw_box_tree_overlaps_from(&crossing->top, &tops, &finder.top, visit_top, &finder);
      CW_TRY(finder.status);
      cw_box_tree_overlaps_from(&crossing->fixed, &fixed, &finder.top, visit_fixed, &finder);
      CW_TRY(finder.status);
      cw_box_tree_overlaps_from(&crossing->fixed, &walls, &finder.wall, visit_wall, &finder);
      CW_TRY(finder.status);
    }
  }
  *bytes = finder.pair;
  *size = (int64_t)(finder.count * sizeof *finder.pair);
  finder.pair = NULL;
done:
  free(finder.pair);
  return status;
}

// Forgets the pairs of what moved, which is looked at anew; the wall's own stay.
static void drop_active(CwLayerCrossing *crossing) {
  int32_t kept = 0;
  for (int32_t i = 0; i < crossing->pair_count; i++) {
    const CwLayerPair *pair = &crossing->pair[i];
    int moved = crossing->active[pair->f] || (pair->kind_g == 0 && crossing->active[pair->g]);
    if (pair->kind_f != 0 || !moved) crossing->pair[kept++] = *pair;
  }
  crossing->pair_count = kept;
}

CwStatus cw_layers_crossing_find(CwLayerCrossing *crossing, const double (*top)[3], const uint8_t *moved) {
  CwStatus status = CW_OK;
  const CwLayerInput *in = crossing->work->in;
  CwTaskResults results = {0};
  int32_t blocks = 0;
  crossing->moved_to = top;
  crossing->list_count = 0;
  for (int32_t f = 0; f < in->triangle_count; f++) {
    const int32_t *v = in->triangle[f];
    crossing->active[f] = moved[v[0]] || moved[v[1]] || moved[v[2]];
  }
  if (crossing->searched)
    cw_box_tree_follow(&crossing->top, crossing->active, in->triangle_count, box_of_top, crossing);
  else
    CW_TRY(make_trees(crossing));
  for (int32_t i = 0; i < crossing->item_count; i++) {
    int32_t f = crossing->fixed.item[i];
    if (f < in->triangle_count && crossing->active[f]) crossing->list[crossing->list_count++] = f;
  }
  drop_active(crossing);
  blocks = (crossing->list_count + BLOCK - 1) / BLOCK;
  CwSchedule schedule = {.step = "layers: crossings", .count = blocks, .run = search_block, .context = crossing};
  CW_TRY(cw_schedule_gather(crossing->work->in->context, &schedule, &results));
  size_t found = (size_t)cw_task_results_join(&results, NULL) / sizeof *crossing->pair;
  CW_GROW(crossing->pair, crossing->pair_capacity, (size_t)crossing->pair_count + found);
  cw_task_results_join(&results, crossing->pair + crossing->pair_count);
  crossing->pair_count += (int32_t)found;
  crossing->searched = 1;
done:
  cw_task_results_free(&results);
  return status;
}

// Why thinner columns cannot get clear of a pair with a layer top; NULL: they can.
static const char *stuck(const CwLayerWork *work, const CwLayerPair *pair) {
  const CwLayerInput *in = work->in;
  const int32_t *f = in->triangle[pair->f], *g = pair->kind_g == 0 ? in->triangle[pair->g] : f;
  double share = 0;
  for (int k = 0; k < 3; k++)
    share = fmax(share, fmax(work->t[f[k]] / in->target[f[k]], work->t[g[k]] / in->target[g[k]]));
  if (share > LEAST_SHARE) return NULL;
  return pair->kind_g == 0   ? "the layer top crosses itself however thin the layers are made"
         : pair->kind_g == 1 ? "the layer top crosses the wall however thin the layers are made"
                             : "the layer top crosses an open patch however thin the layers are made";
}

void cw_layers_crossing_judge(const CwLayerCrossing *crossing, CwOutcome *outcome) {
  const CwLayerWork *work = crossing->work;
  for (int32_t i = 0; i < crossing->pair_count; i++) {
    const CwLayerPair *pair = &crossing->pair[i];
    if (pair->kind_f != 0) { // which no want of layers mends
      const int32_t v = work->in->triangle[pair->f][0];
      const CwOutcomeKind kind = cw_layers_kind_at(work, v);
      cw_outcome_set(outcome, kind == CW_OUTCOME_PINCH ? CW_OUTCOME_FINER : kind, work->in->x[v],
                     "the wall crosses or touches itself");
      return;
    }
    const char *why = stuck(work, pair);
    if (why) cw_layers_add_place(work, pair->f, 0, outcome, why);
  }
}
