// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/patch_improve.h"

#include <string.h>

// Edges longer or shorter than these shares of the wanted length are split or drawn together.
static const double long_edge = 1.45, short_edge = 0.62;

static double edge_size(const CwPatchWork *work, int32_t a, int32_t b) {
  return 0.5 * (work->size[a] + work->size[b]);
}

// The free point's ring and what it allows.
typedef struct {
  int count;
  int32_t triangle[CW_PATCH_RING], ring[CW_PATCH_RING];
} Ring;

// The worst quality of the ring with p at uv, x. Negative where a triangle would be turned in (u,v) or p would come
// nearer to a given edge than 0.4 of its size and nearer than `height` (the least one now).
static double ring_quality(const CwPatchWork *work, const Ring *r, int32_t p, const double uv[2], const double x[3],
                           const double normal[3]) {
  double worst = 1;
  for (int k = 0; k < r->count; k++) {
    int32_t a = r->ring[k], b = r->ring[(k + 1) % r->count], t = r->triangle[k];
    if (!(cw_patch_cross(work->uv[a], work->uv[b], uv) > 0))
      return -1;
    double quality = cw_patch_quality_at(x, work->x[a], work->x[b], normal);
    if (quality < worst)
      worst = quality;
    if (work->given[t] >> cw_patch_corner_of(work->corner[t], p) & 1) {
      // Height over the edge from the area, which the quality holds.
      double l = cw_patch_distance2(work->x[a], work->x[b]);
      double sum = l + cw_patch_distance2(x, work->x[a]) + cw_patch_distance2(x, work->x[b]);
      double height = quality * sum / (2 * sqrt(3) * sqrt(l)), limit = 0.4 * work->size[p];
      if (height < limit && quality > 0)
        worst = fmin(worst, 0.5 * height / limit);
    }
  }
  return worst;
}

// Tries p moved by `step` (in space, tangential); keeps the move if the worst triangle of the ring stays above `least`.
static int try_move(CwPatchWork *work, const Ring *r, int32_t p, const double step[3], double least) {
  const double *m = work->metric[p];
  double det = m[0] * m[2] - m[1] * m[1], f[2] = {0, 0}, uv[2], x[3], xu[3], xv[3], n[3];
  if (!(det > 1e-12 * m[0] * m[2]))
    return 0;
  for (int k = 0; k < 3; k++) {
    f[0] += step[k] * work->xu[p][k];
    f[1] += step[k] * work->xv[p][k];
  }
  uv[0] = work->uv[p][0] + (m[2] * f[0] - m[1] * f[1]) / det;
  uv[1] = work->uv[p][1] + (m[0] * f[1] - m[1] * f[0]) / det;
  for (int k = 0; k < r->count; k++)
    if (!(cw_patch_cross(work->uv[r->ring[k]], work->uv[r->ring[(k + 1) % r->count]], uv) > 0))
      return 0;
  work->input->surface(work->input->surface_context, uv, x, xu, xv);
  n[0] = xu[1] * xv[2] - xu[2] * xv[1];
  n[1] = xu[2] * xv[0] - xu[0] * xv[2];
  n[2] = xu[0] * xv[1] - xu[1] * xv[0];
  if (ring_quality(work, r, p, uv, x, n) <= least)
    return 0;
  memcpy(work->uv[p], uv, sizeof uv);
  memcpy(work->x[p], x, sizeof x);
  memcpy(work->xu[p], xu, sizeof xu);
  memcpy(work->xv[p], xv, sizeof xv);
  double *g = work->metric[p];
  g[0] = xu[0] * xu[0] + xu[1] * xu[1] + xu[2] * xu[2];
  g[1] = xu[0] * xv[0] + xu[1] * xv[1] + xu[2] * xv[2];
  g[2] = xv[0] * xv[0] + xv[1] * xv[1] + xv[2] * xv[2];
  double size = work->input->size(work->input->size_context, x);
  for (int k = 0; k < r->count; k++)
    size = fmin(size, work->size[r->ring[k]] + 0.3 * sqrt(cw_patch_distance2(x, work->x[r->ring[k]])));
  work->size[p] = size;
  return 1;
}

// Moves p to the mean of the places its neighbours want it at: each at the wanted length along the edge, blended with
// the apex of the equilateral triangle on the opposite edge.
static void smooth_point(CwPatchWork *work, int32_t p) {
  Ring r;
  r.count = cw_patch_ring(work, p, r.triangle, r.ring);
  if (!r.count)
    return;
  double step[3] = {0, 0, 0}, weight = 0, n[3];
  for (int k = 0; k < r.count; k++) {
    int32_t a = r.ring[k];
    double length = sqrt(cw_patch_distance2(work->x[p], work->x[a])), size = edge_size(work, p, a);
    double w = length / size;
    for (int c = 0; c < 3; c++)
      step[c] += w * (work->x[a][c] - work->x[p][c]);
    weight += w;
  }
  if (!(weight > 0))
    return;
  for (int c = 0; c < 3; c++)
    step[c] /= weight;
  cw_patch_normal(work, p, n);
  double now = ring_quality(work, &r, p, work->uv[p], work->x[p], n);
  // A small loss of the worst triangle is allowed where it is good anyway.
  double least = fmin(now, 0.7);
  if (try_move(work, &r, p, step, least))
    return;
  for (int c = 0; c < 3; c++)
    step[c] *= 0.4;
  try_move(work, &r, p, step, least);
}

static void smooth(CwPatchWork *work) {
  for (int32_t p = work->given_count; p < work->point_count; p++)
    if (work->point_triangle[p] >= 0)
      smooth_point(work, p);
}

static CwStatus split_long(CwPatchWork *work, int64_t *changes) {
  CwStatus status = CW_OK;
  int32_t count = work->triangle_count;
  for (int32_t t = 0; t < count; t++) {
    if (work->corner[t][0] < 0)
      continue;
    // The longest edge only: splitting the others would make needles.
    int longest = -1;
    double most = 0;
    for (int i = 0; i < 3; i++) {
      double d = cw_patch_distance2(work->x[work->corner[t][(i + 1) % 3]], work->x[work->corner[t][(i + 2) % 3]]);
      if (d > most) {
        most = d;
        longest = i;
      }
    }
    if (longest < 0 || work->given[t] >> longest & 1)
      continue;
    int32_t a = work->corner[t][(longest + 1) % 3], b = work->corner[t][(longest + 2) % 3];
    double size = edge_size(work, a, b);
    if (most < long_edge * long_edge * size * size)
      continue;
    double uv[2] = {0.5 * (work->uv[a][0] + work->uv[b][0]), 0.5 * (work->uv[a][1] + work->uv[b][1])};
    status = cw_patch_insert(work, uv, t, 0.55, size * 1.1);
    if (status == CW_RETRY)
      status = CW_OK;
    else if (status == CW_OK)
      ++*changes;
    CW_TRY(status);
  }
done:
  return status;
}

static void remove_crowded(CwPatchWork *work, int64_t *changes) {
  for (int32_t p = work->given_count; p < work->point_count; p++) {
    if (work->point_triangle[p] < 0)
      continue;
    Ring r;
    r.count = cw_patch_ring(work, p, r.triangle, r.ring);
    if (!r.count)
      continue;
    int crowded = r.count <= 4;
    for (int k = 0; k < r.count && !crowded; k++) {
      double limit = short_edge * edge_size(work, p, r.ring[k]);
      crowded = cw_patch_distance2(work->x[p], work->x[r.ring[k]]) < limit * limit;
    }
    if (crowded)
      *changes += cw_patch_remove(work, p, 0.45, 1.5);
  }
}

CwStatus cw_patch_improve(CwPatchWork *work) {
  CwStatus status = CW_OK;
  for (int sweep = 0; sweep < 4; sweep++) {
    int64_t changes = 0;
    cw_patch_delaunay(work, 1);
    remove_crowded(work, &changes);
    CW_TRY(split_long(work, &changes));
    cw_patch_delaunay(work, 1);
    smooth(work);
    smooth(work);
  }
  cw_patch_delaunay(work, 1);
done:
  return status;
}
