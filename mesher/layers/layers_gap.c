// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/layers/layers_gap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/box_tree.h"
#include "mesher/common/vec.h"
#include "mesher/layers/layers_normal.h"
#include "mesher/layers/layers_topology.h"
#include "mesher/layers/thickness_gradation.h"
#include "mesher/parallel/parallel_for.h"
#include "mesher/policy.h"

enum { BISECTIONS = 20 };
static const double SAME = 1e-3;  // of a thickness: what is no thinner
static const double START = 1e-3; // of the shortest edge of the wall: what a ray meets nearer is its own wall

// Corner coordinates of triangle f of walls and obstacles together.
static void corners(const CwLayerInput *in, int32_t f, const double *corner[3]) {
  for (int i = 0; i < 3; i++)
    corner[i] = f < in->triangle_count ? in->x[in->triangle[f][i]]
                                       : in->obstacle_x[in->obstacle_triangle[f - in->triangle_count][i]];
}

static CwBox box_of(const void *context, int32_t f) {
  const double *corner[3];
  corners(context, f, corner);
  return cw_box_of_triangle(corner[0], corner[1], corner[2]);
}

static CwBox normal_of(const void *context, int32_t f) {
  const double *corner[3];
  corners(context, f, corner);
  return cw_box_of_normal(corner[0], corner[1], corner[2]);
}

CwStatus cw_gap_tree_make(CwLayerWork *work, CwBoxTree *tree) {
  CwStatus status = CW_OK;
  const CwLayerInput *in = work->in;
  int32_t total = in->triangle_count + in->obstacle_triangle_count;
  CwBox within = cw_box_empty();
  uint8_t *listed = NULL;
  CW_NEW(listed, work->n);
  CW_NEW_UNSET(work->curve, work->n);
  for (int32_t v = 0; v < work->n; v++) cw_box_add_point(&within, in->x[v]);
  for (int32_t f = 0; f < in->obstacle_triangle_count; f++) {
    for (int k = 0; k < 3; k++) cw_box_add_point(&within, in->obstacle_x[in->obstacle_triangle[f][k]]);
  }
  CW_TRY(cw_box_tree_make(work->in->context, total, &within, box_of, in, tree));
  int32_t count = 0;
  for (int32_t i = 0; i < total; i++) {
    for (int k = 0; tree->item[i] < in->triangle_count && k < 3; k++) {
      int32_t v = in->triangle[tree->item[i]][k];
      if (!listed[v]) work->curve[count++] = v;
      listed[v] = 1;
    }
  }
done:
  free(listed);
  return status;
}

// Way along the ray to the triangle, or INFINITY (Moller and Trumbore). *facing: cosine between ray and the normal that
// points out of the domain.
static double hit(const double *const corner[3], const double x[3], const double g[3], double *facing) {
  double e1[3], e2[3], p[3], q[3], s[3], normal[3];
  cw_sub(corner[1], corner[0], e1);
  cw_sub(corner[2], corner[0], e2);
  cw_cross(e1, e2, normal);
  if (cw_unit(normal) == 0) return INFINITY;
  *facing = cw_dot(normal, g);
  cw_cross(g, e2, p);
  double det = cw_dot(e1, p);
  if (det == 0) return INFINITY;
  cw_sub(x, corner[0], s);
  // Rays often aim at vertices and edges of the other side: a hair of tolerance lets none slip between two
  // triangles.
  const double hair = 1e-9;
  double u = cw_dot(s, p) / det;
  if (u < -hair || u > 1 + hair) return INFINITY;
  cw_cross(s, e1, q);
  double w = cw_dot(g, q) / det;
  if (w < -hair || u + w > 1 + hair) return INFINITY;
  return cw_dot(e2, q) / det;
}

// Walls around v, and walls at a concave crease next to v, bound no gap: the smoothing keeps columns clear of
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

// The ray along the column of v, and what it has found.
typedef struct {
  const CwLayerWork *work;
  int32_t v;
  double x[3], g[3], stretch, offset, best, far;
  double facing; // least cosine to the normal of what stands opposite: less is grazed
  double core;   // between two layer tops, that a tetrahedron fits in, m
} Ray;

// The mean length of the wall's edges at v, m.
static double mean_edge(const CwLayerWork *work, int32_t v) {
  double sum = 0;
  int32_t count = work->near_start[v + 1] - work->near_start[v];
  for (int32_t k = 0; k < count; k++)
    sum += cw_distance(work->in->x[work->near[work->near_start[v] + k]], work->in->x[v]) / count;
  return sum;
}

// What is left between two layer tops, or one and an open patch, for a tetrahedron to fit in before v, m.
static double core_of(const CwLayerWork *work, int32_t v) {
  return cw_policy.least_distance * mean_edge(work, v);
}

// By how much a tetrahedron across what columns of the thickness t on so many sides leave of the way has more volume
// than it may have on their last prism: a prism of its base and a third of its height is as large.
static double excess(const CwLayerWork *work, int32_t v, int sides, double way, double t) {
  const CwLayerDivision *division = &work->in->division;
  double last = division->last ? division->last(division->context, v, t) : 1.0 / fmax(division->count, 1);
  return way - sides * t - 3 * cw_policy.core_ratio * last * t;
}

double cw_layers_room(const CwLayerWork *work, int32_t v, int sides, double way, double core) {
  double share = (sides > 1 ? cw_policy.gap_share : cw_policy.free_share) * way, left = (way - core) / sides;
  double low = fmin(share, fmax(left, cw_layer_least(work->in, v))), high = share;
  if (left >= share || excess(work, v, sides, way, low) <= 0) return low;
  if (excess(work, v, sides, way, high) >= 0) return high;
  for (int i = 0; i < BISECTIONS; i++) {
    double middle = (low + high) / 2;
    if (excess(work, v, sides, way, middle) > 0) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return high;
}

static int meet(void *context, int32_t f) {
  Ray *ray = context;
  const CwLayerInput *in = ray->work->in;
  const double *corner[3];
  corners(in, f, corner);
  double facing = 0, way = hit(corner, ray->x, ray->g, &facing);
  if (way <= ray->offset || way > ray->far || facing < ray->facing) return 0;
  int wall = f < in->triangle_count;
  if (wall && belongs_to_crease(ray->work, ray->v, f)) return 0;
  double core = ray->core * fmax(0, 2 * facing - 1); // in a wedge there is room beside the column
  double room = cw_layers_room(ray->work, ray->v, 1 + wall, way / ray->stretch, core / ray->stretch);
  ray->best = fmin(ray->best, room);
  return 0;
}

// Where the ray of v begins. Beside an open patch it is the middle of its neighbours: on a bent patch the chords of the
// edge opposite lie within it, and a ray along it would miss the wall behind them.
static void ray_start(const CwLayerWork *work, int32_t v, double x[3]) {
  const CwLayerInput *in = work->in;
  cw_copy(in->x[v], x);
  if (!cw_layer_stays(in, v)) return;
  double count = work->near_start[v + 1] - work->near_start[v];
  for (int32_t k = work->near_start[v]; k < work->near_start[v + 1]; k++) {
    for (int i = 0; i < 3; i++) x[i] += (in->x[work->near[k]][i] - in->x[v][i]) / count;
  }
}

// Columns to look along.
typedef struct {
  const CwLayerWork *work;
  const CwBoxTree *tree, *normals;
  int32_t count, *vertex;
} Gaps;

// Largest thickness that the gap along the column allows; INFINITY where nothing stands within reach.
static CwStatus free_thickness(void *context, int32_t i, void *out) {
  const Gaps *gaps = context;
  const CwLayerWork *work = gaps->work;
  const CwLayerInput *in = work->in;
  int32_t v = gaps->vertex[i];
  Ray ray = {.work = work, .v = v, .best = INFINITY};
  // A column on an open edge runs inside its own open patch and must not take that for an obstacle.
  ray.facing = cw_layer_constraints(in, v) > 0 ? cw_policy.column_least_cosine : CW_LAYERS_LEAST_COSINE;
  ray_start(work, v, ray.x);
  memcpy(ray.g, work->column[v], sizeof ray.g);
  ray.stretch = cw_unit(ray.g);
  ray.offset = START * cw_layers_shortest_edge(work, v);
  ray.core = core_of(work, v);
  ray.far = in->target[v] * ray.stretch;
  ray.far = fmax(ray.far / cw_policy.gap_share, 2 * ray.far + ray.core);
  cw_box_tree_ray(gaps->tree, gaps->normals, ray.x, ray.g, &ray.far, meet, &ray);
  *(double *)out = ray.best;
  return CW_OK;
}

CwStatus cw_layers_limit_by_gap(CwLayerWork *work, CwBoxTree *tree) {
  CwStatus status = CW_OK;
  double *most = NULL;
  CwBoxTree normals = {0};
  Gaps gaps = {.work = work, .tree = tree, .normals = &normals};
  if (!work->gap) {
    CW_NEW_UNSET(work->gap, work->n);
    CW_NEW_UNSET(work->stale, work->n);
    memset(work->stale, 1, (size_t)work->n);
  }
  CW_NEW_UNSET(gaps.vertex, work->n);
  for (int32_t v = 0; v < work->n; v++) {
    if (cw_layer_pinched(work->in, v))
      work->gap[v] = INFINITY;
    else if (work->stale[v])
      gaps.vertex[gaps.count++] = v;
  }
  memset(work->stale, 0, (size_t)work->n);
  CW_NEW_UNSET(most, gaps.count);
  CW_TRY(cw_box_tree_alike(work->in->context, tree, normal_of, work->in, &normals));
  CW_TRY(cw_parallel_for(work->in->context, "layers: gaps", gaps.count, sizeof *most, free_thickness, &gaps, most));
  for (int32_t i = 0; i < gaps.count; i++) work->gap[gaps.vertex[i]] = most[i];
  for (int32_t v = 0; v < work->n; v++) {
    work->t[v] = fmin(work->most[v], work->gap[v]);
    work->reason[v] = work->t[v] == 0                    ? CW_LAYER_TAPER
                      : work->t[v] < work->in->target[v] ? CW_LAYER_GAP
                                                         : CW_LAYER_FULL;
  }
done:
  cw_box_tree_free(&normals);
  free(gaps.vertex);
  free(most);
  return status;
}

// The layer top, in which the ends of columns look for another part of it.
typedef struct {
  const CwLayerWork *work;
  const CwBoxTree *tree;
  const double (*top)[3];
} Tops;

// The part of the layer top that the end of a column comes too near to, none: -1; and the way to it, m.
typedef struct {
  double way;
  int64_t triangle;
} Near;

typedef struct {
  const Tops *tops;
  int32_t v;
  double x[3], g[3], offset, core;
  Near near; // the way: the core before there is one
} TopRay;

static int meet_top(void *context, int32_t f) {
  TopRay *ray = context;
  const CwLayerWork *work = ray->tops->work;
  if (f >= work->in->triangle_count || belongs_to_crease(work, ray->v, f)) return 0;
  const int32_t *p = work->in->triangle[f];
  const double *const corner[3] = {ray->tops->top[p[0]], ray->tops->top[p[1]], ray->tops->top[p[2]]};
  double facing = 0, way = hit(corner, ray->x, ray->g, &facing);
  if (way > ray->offset && way <= fmin(ray->near.way, ray->core * (2 * facing - 1))) ray->near = (Near){way, f};
  return 0;
}

static CwStatus find_near(void *context, int32_t v, void *out) {
  const Tops *tops = context;
  const CwLayerWork *work = tops->work;
  TopRay ray = {.tops = tops, .v = v, .core = core_of(work, v)};
  ray.near = (Near){ray.core, -1};
  if (work->t[v] == 0) goto done;
  memcpy(ray.x, tops->top[v], sizeof ray.x);
  memcpy(ray.g, work->column[v], sizeof ray.g);
  cw_unit(ray.g);
  ray.offset = START * cw_layers_shortest_edge(work, v);
  cw_box_tree_ray(tops->tree, NULL, ray.x, ray.g, &ray.near.way, meet_top, &ray);
done:
  *(Near *)out = ray.near;
  return CW_OK;
}

CwStatus cw_layers_limit_by_top(CwLayerWork *work, const CwBoxTree *tree, const double (*top)[3], uint8_t *lowered,
                                int *any) {
  CwStatus status = CW_OK;
  const Tops tops = {work, tree, top};
  Near *near = NULL;
  double *most = NULL;
  *any = 0;
  CW_NEW_UNSET(near, work->n);
  CW_NEW_UNSET(most, work->n);
  CW_TRY(
      cw_parallel_for(work->in->context, "layers: near tops", work->n, sizeof *near, find_near, (void *)&tops, near));
  for (int32_t v = 0; v < work->n; v++) most[v] = INFINITY;
  for (int32_t v = 0; v < work->n; v++) {
    if (near[v].triangle < 0) continue;
    const int32_t *p = work->in->triangle[near[v].triangle], column[4] = {v, p[0], p[1], p[2]};
    double opposite = fmax(work->t[p[0]], fmax(work->t[p[1]], work->t[p[2]]));
    double way = work->t[v] * cw_norm(work->column[v]) + near[v].way + opposite;
    double core = core_of(work, v);
    for (int i = 0; i < 4; i++) {
      double stretch = cw_norm(work->column[column[i]]);
      if (stretch == 0) continue;
      double room = cw_layers_room(work, column[i], 2, way / stretch, core / stretch);
      most[column[i]] = fmin(most[column[i]], room);
    }
  }
  for (int32_t v = 0; v < work->n; v++) {
    lowered[v] = work->t[v] > (1 + SAME) * most[v];
    if (!lowered[v]) continue;
    work->t[v] = most[v];
    work->reason[v] = CW_LAYER_GAP;
    *any = 1;
  }
done:
  free(near);
  free(most);
  return status;
}

// Whether the smoothing sees to the columns at both ends of this edge: it lies along a crease or runs into one.
static int smoothing_parts(const CwLayerWork *work, int32_t v, int32_t w, const double e[3]) {
  int at_v = work->crease[v] == CW_CREASE_CONCAVE, at_w = work->crease[w] == CW_CREASE_CONCAVE;
  if (!at_v || !at_w) return at_v || at_w;
  double along_v = cw_dot(work->along[v], e), along_w = cw_dot(work->along[w], e);
  double least = 0.7 * cw_norm(e); // by 45 degrees, as the diagonals of squares do, and a little more
  int corner = cw_norm(work->along[v]) == 0 || cw_norm(work->along[w]) == 0;
  return corner || fabs(along_v) > least || fabs(along_w) > least;
}

static CwStatus find_most(void *context, int32_t v, void *out) {
  const CwLayerWork *work = context;
  const CwLayerInput *in = work->in;
  double most = cw_layer_pinched(in, v) ? 0 : in->target[v];
  for (int32_t k = work->near_start[v]; k < work->near_start[v + 1]; k++) {
    int32_t w = work->near[k];
    double e[3];
    cw_sub(in->x[w], in->x[v], e);
    if (smoothing_parts(work, v, w, e)) continue;
    // Without constraints: the smoothing sees to what those tilt. Of the edge's length squared, by the thickness:
    double closing = cw_dot(e, work->normal[v]) / fmax(work->normal_cos[v], cw_layers_floor(work, v)) -
                     cw_dot(e, work->normal[w]) / fmax(work->normal_cos[w], cw_layers_floor(work, w));
    if (closing > 0) most = fmin(most, cw_policy.free_share * cw_dot(e, e) / closing);
  }
  *(double *)out = most;
  return CW_OK;
}

CwStatus cw_layers_limit_by_concavity(CwLayerWork *work) {
  return cw_parallel_for(work->in->context, "layers: concave places", work->n, sizeof *work->most, find_most, work,
                         work->most);
}

// Thickness of w at most, beside v: by the distance of their columns on the wall or at the thickness of the lower one,
// whichever is less. Beside a concave crease columns lean away from it by less and less, so that they stand closer on
// the layer top than on the wall, and thicknesses that rose by their distance there would fold the layer top along the
// crease.
static double most_beside(const void *context, int32_t v, int32_t w) {
  const CwLayerWork *work = context;
  double e[3], d[3], t = fmin(work->t[v], work->t[w]);
  cw_sub(work->in->x[w], work->in->x[v], e);
  for (int k = 0; k < 3; k++) d[k] = e[k] + t * (work->column[w][k] - work->column[v][k]);
  return work->t[v] + cw_policy.slope * fmin(cw_norm(e), cw_norm(d));
}

CwStatus cw_layers_grade(CwLayerWork *work, const uint8_t *lowered) {
  CwStatus status = CW_OK;
  uint8_t *graded = NULL;
  CW_NEW(graded, work->n);
  CW_TRY(cw_grade_thickness(&(CwGradation){.step = "layers: steep",
                                           .count = work->n,
                                           .start = work->face_start,
                                           .triangle = work->face,
                                           .corner = work->in->triangle,
                                           .most = most_beside,
                                           .context = work->in->context,
                                           .given = work,
                                           .thickness = work->t,
                                           .graded = graded},
                            lowered));
  for (int32_t v = 0; v < work->n; v++) {
    if (graded[v]) work->reason[v] = CW_LAYER_GRADATION;
  }
done:
  free(graded);
  return status;
}

int32_t cw_layers_slope_foot(const CwLayerWork *work, int32_t v) {
  while (work->reason[v] == CW_LAYER_GRADATION) {
    double least = INFINITY;
    int32_t lower = -1;
    for (int32_t k = work->near_start[v]; k < work->near_start[v + 1]; k++) {
      int32_t w = work->near[k];
      double most = work->t[w] < work->t[v] ? most_beside(work, w, v) : INFINITY;
      if (most < least) least = most, lower = w;
    }
    if (lower < 0) break;
    v = lower;
  }
  return v;
}
