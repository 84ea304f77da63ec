// SPDX-License-Identifier: AGPL-3.0-or-later
// The triangulation of a patch while it is being meshed: triangles with neighbours in the (u,v) plane, points
// with their place on the surface and its derivatives, and the local changes that keep it valid:
//
//   insert   a point goes in, triangles whose circle holds it go out (Bowyer-Watson in the metric of the surface there)
//   flip     the diagonal of two triangles is turned
//   remove   a free point is drawn into one of its neighbours
//
// Every change keeps all triangles counter-clockwise in (u,v), all given edges, and all given points.
#pragma once

#include <stdint.h>

#include "mesher/common/vec.h"
#include "mesher/surface/cdt.h"
#include "mesher/surface/patch_input.h"
#include "pipeline/status.h"

enum { CW_PATCH_RING = 48 }; // free points with more triangles than that are left alone

// Corner i of a triangle faces its edge i, which runs from corner i+1 to corner i+2. The fields are arrays over points
// and triangles, and the room of one insertion, kept from one to the next.
typedef struct {
  const CwPatchInput *input;
  int32_t given_count; // points below are given, the others free
  int32_t point_count, point_capacity;
  double (*uv)[2], (*x)[3];
  double (*xu)[3], (*xv)[3]; // derivatives of the map
  double (*metric)[3];       // first fundamental form: xu.xu, xu.xv, xv.xv
  double *size;              // wanted edge length at the point: the field, held down by nearby short given edges
  int32_t *point_triangle;   // one triangle at the point; -1: none (a removed point)
  int32_t triangle_count, triangle_capacity; // slots
  int32_t (*corner)[3];                      // corner[t][0] < 0: a free slot, the next one in neighbour[t][0]
  int32_t (*neighbour)[3];                   // across edge i; -1: outside
  uint8_t *given;                            // bit i: edge i is given
  int32_t *component;
  uint32_t *mark; // scratch: equal to `marker` where marked
  uint32_t marker;
  int32_t free_slot; // -1: none
  // The cavity of the last insertion; its new triangles after it.
  int32_t cavity_count, border_count, cavity_capacity;
  int32_t *cavity;
  int32_t (*border)[3]; // from, to, triangle outside
  uint8_t *border_given;
  int32_t *fresh;
  int32_t *point_fresh; // per point: the new triangle whose border edge starts there
} CwPatchWork;

// Takes the triangulation over (it may be freed afterwards). `input` must outlive the work.
CwStatus cw_patch_work_open(const CwPatchInput *input, const CwCdt *cdt, CwPatchWork *work);
void cw_patch_work_close(CwPatchWork *work);

// The triangle that holds uv, found by walking from triangle `from` on; -1 where a given edge is in the way.
int32_t cw_patch_find(const CwPatchWork *work, const double uv[2], int32_t from);

// Puts a point at uv, looked for from triangle `from` on without crossing a given edge. Refuses (*inserted 0) a point
// that is outside, nearer than `least` times its size to another point, or nearer than 0.4 of its size to a given edge
// of the cavity. `size_cap` bounds the size of the new point. Where *inserted is 1 the new point is the last one and
// fresh[0 .. border_count) are its triangles.
CwStatus cw_patch_insert(CwPatchWork *work, const double uv[2], int32_t from, double least, double size_cap,
                         int *inserted);

// Whether a line from point a to b leads over a nose of the surface (mesher/common/nose.h); whether it is longer than
// wanted edges may be.
int cw_patch_over_nose(const CwPatchWork *work, int32_t a, int32_t b);
int cw_patch_is_long(const CwPatchWork *work, int32_t a, int32_t b);

// Turns edge i of triangle t; refuses (returns 0) where the edge is given, a triangle would not be counter-clockwise in
// (u,v), or a new edge over a nose would not be shorter than that one or come in place of a short one over none.
int cw_patch_flip(CwPatchWork *work, int32_t t, int i);

// Triangles and neighbours around a free point, counter-clockwise: triangle k has the corners p, ring[k],
// ring[k+1]. Returns their number, 0 where there are more than CW_PATCH_RING.
int cw_patch_ring(const CwPatchWork *work, int32_t p, int32_t triangles[CW_PATCH_RING], int32_t ring[CW_PATCH_RING]);

// Draws free point p into a neighbour, the one that leaves the best worst triangle, if that is better than
// `least_quality`, no new edge is longer than `most` times the mean size of its ends and none leads over a nose.
// Returns whether it did.
int cw_patch_remove(CwPatchWork *work, int32_t p, double least_quality, double most);

// Quality of a triangle of given points in space: 1 for equilateral, 0 for flat, negative when its normal is
// against the surface's.
double cw_patch_quality(const CwPatchWork *work, int32_t a, int32_t b, int32_t c);
double cw_patch_quality_at(const double a[3], const double b[3], const double c[3], const double normal[3]);

// The metric at p, from the derivatives there.
static inline void cw_patch_set_metric(CwPatchWork *work, int32_t p) {
  work->metric[p][0] = cw_dot(work->xu[p], work->xu[p]);
  work->metric[p][1] = cw_dot(work->xu[p], work->xv[p]);
  work->metric[p][2] = cw_dot(work->xv[p], work->xv[p]);
}

// The normal of the surface at point p, not of unit length.
static inline void cw_patch_normal(const CwPatchWork *work, int32_t p, double n[3]) {
  cw_cross(work->xu[p], work->xv[p], n);
}

static inline double cw_patch_distance2(const double a[3], const double b[3]) {
  double x = b[0] - a[0], y = b[1] - a[1], z = b[2] - a[2];
  return x * x + y * y + z * z;
}

static inline int cw_patch_corner_of(const int32_t corner[3], int32_t p) {
  return corner[0] == p ? 0 : corner[1] == p ? 1 : 2;
}

// The edge of triangle t that runs from a to b.
static inline int cw_patch_edge_from(const CwPatchWork *work, int32_t t, int32_t a, int32_t b) {
  const int32_t *c = work->corner[t];
  for (int i = 0; i < 3; i++)
    if (c[(i + 1) % 3] == a && c[(i + 2) % 3] == b) return i;
  return -1;
}

static inline int cw_patch_is_free(const CwPatchWork *work, int32_t p) {
  return p >= work->given_count;
}
