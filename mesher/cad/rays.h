// SPDX-License-Identifier: AGPL-3.0-or-later
// Rays through the fluid: where a ray leaves the domain, by a tree of boxes over the background triangles.
#pragma once

#include <stdint.h>

#include "mesher/parallel/context.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CwRays CwRays;

// Of a closed surface with normals out of the domain, as a background is; its points and triangles must outlive the
// rays. Collective; context: NULL for one process.
CwStatus cw_rays_make(const CwContext *context, int32_t point_count, const double (*x)[3], int32_t triangle_count,
                      const int32_t (*triangle)[3], CwRays **rays);
void cw_rays_free(CwRays **rays);

// First triangle through which x + s * direction (unit vector) leaves the domain, from < s < to; -1: none.
// Hits from outside in are passed over: from a point on the wall they can only be rounding. *distance gets s, and stays
// where there is none.
int32_t cw_rays_exit(const CwRays *rays, const double x[3], const double direction[3], double from, double to,
                     double *distance);

// A place where a line enters or leaves the domain.
typedef struct {
  double place; // along the line, m
  int32_t triangle;
} CwRayHit;

// All hits of the line x + s direction (unit vector), from <= s <= to, in order; of more than `most` any so many. An
// edge between two triangles may be hit twice.
int32_t cw_rays_hits(const CwRays *rays, const double x[3], const double direction[3], double from, double to,
                     int32_t most, CwRayHit *hit);

#ifdef __cplusplus
}
#endif
