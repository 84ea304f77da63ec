// SPDX-License-Identifier: AGPL-3.0-or-later
// New points near an interface (paper, section 2.3): which of a region's candidates fall into the sphere of an
// interface triangle, and the interface with the centres of such triangles' circles inserted. The sphere of a triangle
// is the smallest one through its corners; its centre lies in the plane. Plane coordinates: u, v and the height over
// the plane.
#pragma once

#include <stdint.h>

#include "mesher/surface/patch_mesh.h"

// Candidates of a region that stand beside a plane, ascending in u.
typedef struct {
  int32_t count;
  double (*at)[3];    // u, v, height
  int32_t *candidate; // number among those that were given
} CwBeside;

// Those of `count` candidates that are no further than `reach` (m) from the plane through `origin` with the orthonormal
// axes u, v and the normal.
CwStatus cw_beside_make(const double origin[3], const double axis[3][3], double reach, int32_t count,
                        const double (*x)[3], CwBeside *beside);
void cw_beside_free(CwBeside *beside);

// Centre and radius of the circle that stands for the triangle's sphere: the circumscribed one times the policy's
// interface_sphere; that of a needle reaches no further than its longest edge. Returns 0 for a triangle without area.
int cw_encroach_circle(const double a[2], const double b[2], const double c[2], double centre[2], double *radius);

// Calls candidates in the sphere over a circle: sets mark[candidate] where `mark` is given. Returns how many there are.
int32_t cw_beside_in_sphere(const CwBeside *beside, const double centre[2], double radius, uint8_t *mark);

typedef struct {
  int32_t point_count; // inserted
  double (*uv)[2];
  int32_t triangle_count;
  int32_t (*triangle)[3]; // the patch's points, then the inserted ones; counter-clockwise
  int32_t encroached;     // triangles of the first triangulation with a candidate in their spheres
  int32_t left;           // of the last one: no point can be had there
  int32_t rounds;
} CwEncroachRefined;

// Constrained Delaunay triangulation of the patch (points without edges are free), with the centre of the circumscribed
// circle of each triangle inserted that holds a candidate in its sphere, again and again until no more can be. A centre
// is refused where the size field asks for no point: nearer to another point than the policy's
// surface_least_distance times the wanted length, or than boundary_distance times it to an edge of the outline, or
// outside. The patch's map must be an isometry.
// Deterministic.
CwStatus cw_encroach_refine(const CwPatchInput *patch, const CwBeside *beside, CwEncroachRefined *refined);
void cw_encroach_refined_free(CwEncroachRefined *refined);
