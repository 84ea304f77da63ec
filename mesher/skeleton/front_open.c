// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/skeleton/front_open.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/incident.h"
#include "mesher/common/triangle_bound.h"
#include "mesher/common/vec.h"
#include "mesher/layers/layers_crossing.h"
#include "mesher/parallel/share.h"
#include "mesher/skeleton/orbit_skeleton.h"
#include "mesher/skeleton/wall_part.h"
#include "pipeline/log.h"

enum { PASSES = 8, HEIGHTS = 2 };
static const double OPEN = 26;                    // degrees: bound up to which more is better
static const double HEIGHT[HEIGHTS] = {1.1, 0.9}; // of the present one, tried
static const double MUCH = 200;                   // more than any bound or quality

// The triangle across the edge from v to w of t; -1 where there is none. *apex: its third corner.
static int32_t across(int32_t t, int32_t v, int32_t w, const int32_t (*triangle)[3], const int32_t *start,
                      const int32_t *around, int32_t *apex) {
  for (int32_t i = start[v]; i < start[v + 1]; i++) {
    const int32_t *corner = triangle[around[i]];
    if (around[i] == t || (corner[0] != w && corner[1] != w && corner[2] != w)) continue;
    for (int k = 0; k < 3; k++) {
      if (corner[k] != v && corner[k] != w) *apex = corner[k];
    }
    return around[i];
  }
  return -1;
}

double cw_front_bound(int32_t t, const int32_t (*triangle)[3], const double (*front)[3], const int32_t *start,
                      const int32_t *around, double least) {
  const int32_t *vertex = triangle[t];
  const double *const corner[3] = {front[vertex[0]], front[vertex[1]], front[vertex[2]]};
  CwBoundSide side[3];
  double m[3];
  cw_normal(corner[0], corner[1], corner[2], m);
  for (int k = 0; k < 3; k++) {
    int32_t apex = -1, other = across(t, vertex[k], vertex[(k + 1) % 3], triangle, start, around, &apex);
    double n[3];
    side[k] = (CwBoundSide){.angle = 90, .apex = -1};
    if (other < 0) continue;
    const int32_t *beyond = triangle[other];
    cw_normal(front[beyond[0]], front[beyond[1]], front[beyond[2]], n);
    side[k] = (CwBoundSide){cw_inner_angle(corner[k], corner[(k + 1) % 3], m, n), apex, front[apex]};
  }
  return cw_triangle_bound(corner, side, least);
}

static double bound_in(const CwLayerWork *work, int32_t t, const double (*front)[3], double least) {
  return cw_front_bound(t, work->in->triangle, front, work->face_start, work->face, least);
}

// How good the column of v is: until its prisms are good by them, and then by the least bound of the triangles that its
// end is a corner or an apex of.
static double judge(const CwLayerWork *work, int32_t v, const double (*front)[3], double floor, int32_t *first) {
  double quality = cw_layers_around(work, v, front, -INFINITY, first), least = OPEN;
  if (quality < CW_LAYER_GOOD) return quality - MUCH;
  for (int32_t i = work->face_start[v]; i < work->face_start[v + 1] && least > floor; i++) {
    int32_t t = work->face[i], apex;
    least = fmin(least, bound_in(work, t, front, least));
    for (int k = 0; k < 3; k++) {
      int32_t a = work->in->triangle[t][k], b = work->in->triangle[t][(k + 1) % 3];
      int32_t other = a == v || b == v ? -1 : across(t, a, b, work->in->triangle, work->face_start, work->face, &apex);
      if (other >= 0) least = fmin(least, bound_in(work, other, front, least));
    }
  }
  return least;
}

// Tries heights of the column of v; keeps the best.
static void stretch(CwLayerWork *work, int32_t v, double (*front)[3]) {
  int32_t first = 0;
  double best = judge(work, v, (const double(*)[3])front, -INFINITY, &first), start = work->t[v], height = start;
  double least = work->in->least ? work->in->least[v] : 0, kept[3];
  memcpy(kept, front[v], sizeof kept);
  for (int i = 0; i < HEIGHTS; i++) {
    work->t[v] = HEIGHT[i] * start;
    if (HEIGHT[i] < 1 && work->t[v] < least) continue;
    cw_layers_place(work, v, front[v]);
    double quality = judge(work, v, (const double(*)[3])front, best, &first);
    if (quality <= best) continue;
    best = quality;
    height = work->t[v];
    memcpy(kept, front[v], sizeof kept);
  }
  work->t[v] = height;
  memcpy(front[v], kept, sizeof kept);
}

// A wall and its columns.
typedef struct {
  CwSkeleton *skeleton;
  CwIncident around; // of the whole wall
  uint8_t *is_first; // of each vertex: on a triangle that is no turned copy
  uint8_t *turning;  // of each vertex: the column to try, once for all its copies
  CwWallPart part;   // what stands about these
  CwLayerWork work;  // of the part
  double (*front)[3];
} Grooves;

static CwStatus find_narrow(void *context, int32_t t, void *out) {
  const Grooves *grooves = context;
  const CwSkeleton *skeleton = grooves->skeleton;
  if (skeleton->surface.source[t] != t) return CW_OK;
  const int32_t(*triangle)[3] = (const int32_t(*)[3])skeleton->surface.triangle;
  const double(*front)[3] = (const double(*)[3])skeleton->layers.front;
  double bound = cw_front_bound(t, triangle, front, grooves->around.start, grooves->around.triangle, CW_FRONT_NARROW);
  *(uint8_t *)out = bound < CW_FRONT_NARROW;
  return CW_OK;
}

// Marks the columns at a narrow triangle and at those beside it.
static void mark_columns(Grooves *grooves, int32_t t) {
  const CwSkeleton *skeleton = grooves->skeleton;
  const int32_t(*triangle)[3] = (const int32_t(*)[3])skeleton->surface.triangle, *corner = triangle[t];
  for (int k = 0; k < 3; k++) {
    int32_t apex = corner[k];
    across(t, corner[k], corner[(k + 1) % 3], triangle, grooves->around.start, grooves->around.triangle, &apex);
    int32_t v = cw_orbit_first_member(&skeleton->orbits, grooves->is_first, corner[k]);
    grooves->turning[v] = 1;
    v = cw_orbit_first_member(&skeleton->orbits, grooves->is_first, apex);
    if (v >= 0) grooves->turning[v] = 1;
  }
}

static CwStatus make_part(Grooves *grooves, const CwLayerInput *wall) {
  CwStatus status = CW_OK;
  const CwSkeleton *skeleton = grooves->skeleton;
  CwLayerWork *work = &grooves->work;
  uint8_t *near = NULL;
  CW_NEW(near, wall->point_count);
  for (int32_t v = 0; v < wall->point_count; v++) {
    for (int32_t i = grooves->around.start[v]; i < grooves->around.start[v + 1] && grooves->turning[v]; i++) {
      for (int k = 0; k < 3; k++) near[wall->triangle[grooves->around.triangle[i]][k]] = 1;
    }
  }
  CW_TRY(cw_wall_part_make(wall, near, &grooves->part));
  CW_TRY(cw_layers_topology(&grooves->part.in, work));
  CW_NEW_UNSET(grooves->front, work->n);
  for (int32_t i = 0; i < work->n; i++) {
    int32_t v = grooves->part.global[i];
    memcpy(grooves->front[i], skeleton->layers.front[v], sizeof *grooves->front);
    work->t[i] = skeleton->layers.height[v];
    for (int k = 0; k < 3; k++)
      work->column[i][k] = (skeleton->layers.front[v][k] - skeleton->surface.x[v][k]) / work->t[i];
    work->base_cos[i] = cw_layers_least_cosine(work, i, work->column[i]) / cw_norm(work->column[i]);
  }
done:
  free(near);
  return status;
}

// Gives the columns of the part that are turned copies of v what that has become.
static void turn_copies(Grooves *grooves, int32_t v) {
  const CwSkeletonOrbits *orbits = &grooves->skeleton->orbits;
  int32_t turns = 1, from = grooves->part.local[v];
  for (int32_t at = cw_orbit_node(orbits, v, 1); at >= 0 && at != v; at = cw_orbit_node(orbits, at, 1), turns++) {
    int32_t local = grooves->part.local[at];
    if (local >= 0) cw_orbit_point(orbits, turns, grooves->front[from], grooves->front[local]);
  }
}

// Whether the column of v changed.
static int open_column(Grooves *grooves, int32_t v) {
  CwLayerWork *work = &grooves->work;
  int32_t local = grooves->part.local[v];
  double end[3], column[3], height = work->t[local];
  cw_copy(grooves->front[local], end);
  cw_copy(work->column[local], column);
  cw_layers_turn(work, local, grooves->front, judge);
  stretch(work, local, grooves->front);
  turn_copies(grooves, v);
  return work->t[local] != height || memcmp(grooves->front[local], end, sizeof end) != 0 ||
         memcmp(work->column[local], column, sizeof column) != 0;
}

// Until nothing changes; the first pass may also move copies, which are turned by rounding.
static void open_columns(Grooves *grooves) {
  for (int pass = 0, changed = 1; pass < PASSES && changed; pass++) {
    changed = pass == 0;
    for (int32_t v = 0; v < grooves->skeleton->surface.vertex_count; v++) {
      if (grooves->turning[v]) changed |= open_column(grooves, v);
    }
  }
}

// Gives all copies of the columns that moved their new ends, heights and reasons; marks them.
static void spread(Grooves *grooves, uint8_t *moved, int32_t *opened) {
  CwSkeleton *skeleton = grooves->skeleton;
  for (int32_t v = 0; v < skeleton->surface.vertex_count; v++) {
    const double *end = grooves->turning[v] ? grooves->front[grooves->part.local[v]] : skeleton->layers.front[v];
    if (memcmp(end, skeleton->layers.front[v], sizeof *skeleton->layers.front) == 0) continue;
    int32_t local = grooves->part.local[v], at = v, turns = 0;
    double column[3];
    cw_sub(end, skeleton->surface.x[v], column);
    double height = cw_layers_least_cosine(&grooves->work, local, column);
    int same = fabs(height - skeleton->layers.height[v]) < 0.01 * height;
    do {
      cw_orbit_point(&skeleton->orbits, turns++, end, skeleton->layers.front[at]);
      skeleton->layers.height[at] = height;
      if (!same) skeleton->layers.reason[at] = CW_LAYER_REPAIR;
      moved[at] = 1;
      at = cw_orbit_node(&skeleton->orbits, at, 1);
    } while (at >= 0 && at != v);
    ++*opened;
  }
}

// Whether all prisms about what moved are sound, or no worse than with the columns as they were, and cross nothing.
static CwStatus check(const CwSkeleton *skeleton, const CwLayerInput *wall, const double (*before)[3],
                      const uint8_t *moved, int *fits) {
  CwStatus status = CW_OK;
  CwLayerWork work = {.in = wall, .n = wall->point_count};
  CwLayerCrossing crossing = {0};
  const double(*front)[3] = (const double(*)[3])skeleton->layers.front;
  *fits = 1;
  for (int32_t t = 0; t < wall->triangle_count && *fits; t++) {
    const int32_t *corner = wall->triangle[t];
    if (!moved[corner[0]] && !moved[corner[1]] && !moved[corner[2]]) continue;
    double least = fmin(CW_LAYER_GOOD, cw_layers_prism_quality(&work, t, before));
    *fits = cw_layers_prism_quality(&work, t, front) >= least;
  }
  if (!*fits) goto done;
  CW_TRY(cw_layers_crossing_make(&work, &crossing));
  CW_TRY(cw_layers_crossing_find(&crossing, front, moved));
  for (int32_t i = 0; i < crossing.pair_count; i++) {
    if (crossing.pair[i].kind_f != 1 || crossing.pair[i].kind_g != 1) *fits = 0;
  }
done:
  cw_layers_crossing_free(&crossing);
  return status;
}

CwStatus cw_front_open(CwSkeleton *skeleton, const CwLayerInput *wall, int32_t *opened) {
  CwStatus status = CW_OK;
  Grooves grooves = {.skeleton = skeleton};
  int32_t count = skeleton->surface.triangle_count, found = 0;
  size_t n = (size_t)skeleton->surface.vertex_count;
  uint8_t *narrow = NULL, *moved = NULL, *reason = NULL;
  double(*front)[3] = NULL, *height = NULL;
  *opened = 0;
  CW_TRY(cw_incident_make(skeleton->surface.vertex_count, count, wall->triangle, &grooves.around));
  CW_NEW(narrow, count);
  CW_TRY(cw_share("layers: grooves", count, sizeof *narrow, find_narrow, &grooves, narrow));
  for (int32_t t = 0; t < count; t++) found += narrow[t];
  if (!found) goto done;
  CW_NEW(grooves.is_first, n);
  CW_NEW(grooves.turning, n);
  for (int32_t t = 0; t < count; t++) {
    for (int k = 0; k < 3 && skeleton->surface.source[t] == t; k++) grooves.is_first[wall->triangle[t][k]] = 1;
  }
  for (int32_t t = 0; t < count; t++) {
    if (narrow[t]) mark_columns(&grooves, t);
  }
  CW_TRY(make_part(&grooves, wall));
  open_columns(&grooves);
  CW_NEW_UNSET(front, n);
  CW_NEW_UNSET(height, n);
  CW_NEW_UNSET(reason, n);
  CW_NEW(moved, n);
  memcpy(front, skeleton->layers.front, n * sizeof *front);
  memcpy(height, skeleton->layers.height, n * sizeof *height);
  memcpy(reason, skeleton->layers.reason, n);
  spread(&grooves, moved, opened);
  int fits = 1;
  if (*opened) CW_TRY(check(skeleton, wall, (const double(*)[3])front, moved, &fits));
  if (!fits) {
    memcpy(skeleton->layers.front, front, n * sizeof *front);
    memcpy(skeleton->layers.height, height, n * sizeof *height);
    memcpy(skeleton->layers.reason, reason, n);
    *opened = 0;
  }
  cw_log_debug("%d triangles of the front in narrow grooves: %d columns %s", found, *opened,
               fits ? "moved" : "stay, the front would cross");
done:
  cw_incident_free(&grooves.around);
  cw_wall_part_free(&grooves.part);
  cw_layers_work_free(&grooves.work);
  free(grooves.is_first);
  free(grooves.turning);
  free(grooves.front);
  free(narrow);
  free(moved);
  free(reason);
  free(front);
  free(height);
  return status;
}
