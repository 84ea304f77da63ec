// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/boundary/concave_edges.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/boundary/periodic_boundary.h"
#include "mesher/boundary/wall_part.h"
#include "mesher/common/incident.h"
#include "mesher/common/quality.h"
#include "mesher/common/triangle_bound.h"
#include "mesher/common/vec.h"
#include "mesher/layers/layers.h"
#include "mesher/layers/layers_crossing.h"
#include "mesher/layers/layers_normal.h"
#include "mesher/layers/layers_topology.h"
#include "mesher/layers/layers_turn.h"
#include "mesher/parallel/parallel_for.h"
#include "mesher/policy.h"
#include "pipeline/log.h"

enum { PASSES = 8, THICKNESSES = 2 };
static const double FACTOR[THICKNESSES] = {1.1, 0.9}; // of the present one, tried
static const double MUCH = 200;                       // more than any bound or quality

// How good the column of v is: until its prisms are good by them, and then by the least bound of the triangles that its
// end is a corner or an apex of.
static double judge(const CwLayerWork *work, int32_t v, const double (*top)[3], double floor, int32_t *first) {
  double quality = cw_layers_around(work, v, top, -INFINITY, first), least = asin(cw_policy.improve_below) / CW_DEGREE;
  if (quality < cw_policy.prism_good) return quality - MUCH;
  const CwBoundSurface surface = {work->in->triangle, top, work->face_start, work->face};
  for (int32_t i = work->face_start[v]; i < work->face_start[v + 1] && least > floor; i++) {
    int32_t t = work->face[i], apex;
    least = fmin(least, cw_bound_on(&surface, t, least));
    for (int k = 0; k < 3; k++) {
      int32_t a = work->in->triangle[t][k], b = work->in->triangle[t][(k + 1) % 3];
      int32_t other = a == v || b == v ? -1 : cw_bound_neighbour(&surface, t, a, b, &apex);
      if (other >= 0) least = fmin(least, cw_bound_on(&surface, other, least));
    }
  }
  return least;
}

// Tries thicknesses of the column of v; keeps the best.
static void stretch(CwLayerWork *work, int32_t v, double (*top)[3]) {
  int32_t first = 0;
  double best = judge(work, v, (const double(*)[3])top, -INFINITY, &first), start = work->t[v], thickness = start;
  double least = cw_layer_least(work->in, v), kept[3];
  memcpy(kept, top[v], sizeof kept);
  for (int i = 0; i < THICKNESSES; i++) {
    work->t[v] = FACTOR[i] * start;
    if (FACTOR[i] < 1 && work->t[v] < least) continue;
    cw_layers_place(work, v, top[v]);
    double quality = judge(work, v, (const double(*)[3])top, best, &first);
    if (quality <= best) continue;
    best = quality;
    thickness = work->t[v];
    memcpy(kept, top[v], sizeof kept);
  }
  work->t[v] = thickness;
  memcpy(top[v], kept, sizeof kept);
}

// A wall and its columns.
typedef struct {
  const CwPeriodicImages *images;
  const CwSurfaceMesh *surface;
  const CwLayerInput *wall;
  CwLayers *layers;
  CwIncident around; // of the whole wall
  uint8_t *is_first; // of each vertex: on a triangle that is no periodic image
  uint8_t *turning;  // of each vertex: the column to try, once for all its copies
  CwWallPart part;   // what stands about these
  CwLayerWork work;  // of the part
  double (*top)[3];
} ConcaveEdges;

static CwBoundSurface layer_top(const ConcaveEdges *concave) {
  return (CwBoundSurface){concave->wall->triangle, (const double(*)[3])concave->layers->top, concave->around.start,
                          concave->around.triangle};
}

static CwStatus find_narrow(void *context, int32_t t, void *out) {
  const ConcaveEdges *concave = context;
  const CwSurfaceMesh *surface = concave->surface;
  if (surface->source[t] != t) return CW_OK;
  const CwBoundSurface top = layer_top(concave);
  *(uint8_t *)out = cw_bound_on(&top, t, cw_policy.wanted_angle) < cw_policy.wanted_angle;
  return CW_OK;
}

// Marks the columns at a narrow triangle and at those beside it.
static void mark_columns(ConcaveEdges *concave, int32_t t) {
  const CwSurfaceMesh *surface = concave->surface;
  const CwBoundSurface top = layer_top(concave);
  const int32_t *corner = top.triangle[t];
  for (int k = 0; k < 3; k++) {
    int32_t apex = corner[k];
    cw_bound_neighbour(&top, t, corner[k], corner[(k + 1) % 3], &apex);
    int32_t v = cw_image_first_member(&surface->images, concave->is_first, corner[k]);
    concave->turning[v] = 1;
    v = cw_image_first_member(&surface->images, concave->is_first, apex);
    if (v >= 0) concave->turning[v] = 1;
  }
}

static CwStatus make_part(ConcaveEdges *concave) {
  CwStatus status = CW_OK;
  const CwLayerInput *wall = concave->wall;
  const CwLayers *layers = concave->layers;
  CwLayerWork *work = &concave->work;
  uint8_t *near = NULL;
  CW_NEW(near, wall->point_count);
  for (int32_t v = 0; v < wall->point_count; v++) {
    for (int32_t i = concave->around.start[v]; i < concave->around.start[v + 1] && concave->turning[v]; i++) {
      for (int k = 0; k < 3; k++) near[wall->triangle[concave->around.triangle[i]][k]] = 1;
    }
  }
  CW_TRY(cw_wall_part_make(wall, near, &concave->part));
  CW_TRY(cw_layers_topology(&concave->part.in, work));
  CW_NEW_UNSET(concave->top, work->n);
  for (int32_t i = 0; i < work->n; i++) {
    int32_t v = concave->part.global[i];
    memcpy(concave->top[i], layers->top[v], sizeof *concave->top);
    work->t[i] = layers->thickness[v];
    work->base_cos[i] = 1;
    if (work->t[i] == 0) continue;
    for (int k = 0; k < 3; k++) work->column[i][k] = (layers->top[v][k] - wall->x[v][k]) / work->t[i];
    work->base_cos[i] = cw_layers_least_cosine(work, i, work->column[i]) / cw_norm(work->column[i]);
  }
done:
  free(near);
  return status;
}

// Gives the columns of the part that are periodic images of v what that has become.
static void turn_copies(ConcaveEdges *concave, int32_t v) {
  const CwPeriodicImages *images = concave->images;
  const CwNodeImages *nodes = &concave->surface->images;
  int32_t turns = 1, from = concave->part.local[v];
  for (int32_t at = cw_image_after(nodes, v, v); at >= 0; at = cw_image_after(nodes, at, v), turns++) {
    int32_t local = concave->part.local[at];
    if (local >= 0) cw_image_point(images, turns, concave->top[from], concave->top[local]);
  }
}

// Whether the column of v changed.
static int open_column(ConcaveEdges *concave, int32_t v) {
  CwLayerWork *work = &concave->work;
  int32_t local = concave->part.local[v];
  double end[3], column[3], thickness = work->t[local];
  cw_copy(concave->top[local], end);
  cw_copy(work->column[local], column);
  cw_layers_turn(work, local, concave->top, judge, 0);
  stretch(work, local, concave->top);
  turn_copies(concave, v);
  return work->t[local] != thickness || memcmp(concave->top[local], end, sizeof end) != 0 ||
         memcmp(work->column[local], column, sizeof column) != 0;
}

// Until nothing changes; the first pass may also move copies, which are turned by rounding.
static void open_columns(ConcaveEdges *concave) {
  for (int pass = 0, changed = 1; pass < PASSES && changed; pass++) {
    changed = pass == 0;
    for (int32_t v = 0; v < concave->surface->vertex_count; v++) {
      if (concave->turning[v]) changed |= open_column(concave, v);
    }
  }
}

// Gives all copies of the columns that moved their new ends, thicknesses and reasons; marks them.
static void spread(ConcaveEdges *concave, uint8_t *moved, int32_t *opened) {
  const CwSurfaceMesh *surface = concave->surface;
  CwLayers *layers = concave->layers;
  for (int32_t v = 0; v < surface->vertex_count; v++) {
    const double *end = concave->turning[v] ? concave->top[concave->part.local[v]] : layers->top[v];
    if (memcmp(end, layers->top[v], sizeof *layers->top) == 0) continue;
    int32_t local = concave->part.local[v];
    double column[3];
    cw_sub(end, surface->x[v], column);
    double thickness = cw_layers_least_cosine(&concave->work, local, column);
    int same = fabs(thickness - layers->thickness[v]) < 0.01 * thickness;
    for (int32_t at = v, turns = 0; at >= 0; at = cw_image_after(&surface->images, at, v), turns++) {
      cw_image_point(concave->images, turns, end, layers->top[at]);
      layers->thickness[at] = thickness;
      if (!same) layers->reason[at] = CW_LAYER_REPAIR;
      moved[at] = 1;
    }
    ++*opened;
  }
}

// Whether all prisms about what moved are sound, or no worse than with the columns as they were, and cross nothing.
static CwStatus check(const double (*top)[3], const CwLayerInput *wall, const double (*before)[3], const uint8_t *moved,
                      int *fits) {
  CwStatus status = CW_OK;
  CwLayerWork work = {.in = wall, .n = wall->point_count};
  CwLayerCrossing crossing = {0};
  *fits = 1;
  for (int32_t t = 0; t < wall->triangle_count && *fits; t++) {
    const int32_t *corner = wall->triangle[t];
    if (!moved[corner[0]] && !moved[corner[1]] && !moved[corner[2]]) continue;
    double least = fmin(cw_policy.prism_good, cw_layers_prism_quality(&work, t, before));
    *fits = cw_layers_prism_quality(&work, t, top) >= least;
  }
  if (!*fits) goto done;
  CW_TRY(cw_layers_crossing_make(&work, &crossing));
  CW_TRY(cw_layers_crossing_find(&crossing, top, moved));
  for (int32_t i = 0; i < crossing.pair_count; i++) {
    if (crossing.pair[i].kind_f != 1 || crossing.pair[i].kind_g != 1) *fits = 0;
  }
done:
  cw_layers_crossing_free(&crossing);
  return status;
}

CwStatus cw_open_concave_edges(const CwPeriodicImages *images, const CwSurfaceMesh *surface, const CwLayerInput *wall,
                               CwLayers *layers, int32_t *opened) {
  CwStatus status = CW_OK;
  ConcaveEdges concave = {.images = images, .surface = surface, .wall = wall, .layers = layers};
  int32_t count = surface->triangle_count, found = 0;
  size_t n = (size_t)surface->vertex_count;
  uint8_t *narrow = NULL, *moved = NULL, *reason = NULL;
  double(*top)[3] = NULL, *thickness = NULL;
  *opened = 0;
  CW_TRY(cw_incident_make(surface->vertex_count, count, wall->triangle, &concave.around));
  CW_NEW(narrow, count);
  CW_TRY(cw_parallel_for(wall->context, "layers: narrow concave edges", count, sizeof *narrow, find_narrow, &concave,
                         narrow));
  for (int32_t t = 0; t < count; t++) found += narrow[t];
  if (!found) goto done;
  CW_NEW(concave.is_first, n);
  CW_NEW(concave.turning, n);
  for (int32_t t = 0; t < count; t++) {
    for (int k = 0; k < 3 && surface->source[t] == t; k++) concave.is_first[wall->triangle[t][k]] = 1;
  }
  for (int32_t t = 0; t < count; t++) {
    if (narrow[t]) mark_columns(&concave, t);
  }
  CW_TRY(make_part(&concave));
  open_columns(&concave);
  CW_NEW_UNSET(top, n);
  CW_NEW_UNSET(thickness, n);
  CW_NEW_UNSET(reason, n);
  CW_NEW(moved, n);
  memcpy(top, layers->top, n * sizeof *top);
  memcpy(thickness, layers->thickness, n * sizeof *thickness);
  memcpy(reason, layers->reason, n);
  spread(&concave, moved, opened);
  int fits = 1;
  if (*opened) CW_TRY(check((const double(*)[3])layers->top, wall, (const double(*)[3])top, moved, &fits));
  cw_log_debug(cw_log_of(wall->context), "%d triangles of the layer top in narrow concave edges: %d columns %s", found,
               *opened, fits ? "moved" : "go back: prisms would become worse, or the layer top cross");
  if (!fits) {
    memcpy(layers->top, top, n * sizeof *top);
    memcpy(layers->thickness, thickness, n * sizeof *thickness);
    memcpy(layers->reason, reason, n);
    *opened = 0;
  }
done:
  cw_incident_free(&concave.around);
  cw_wall_part_free(&concave.part);
  cw_layers_work_free(&concave.work);
  free(concave.is_first);
  free(concave.turning);
  free(concave.top);
  free(narrow);
  free(moved);
  free(reason);
  free(top);
  free(thickness);
  return status;
}
