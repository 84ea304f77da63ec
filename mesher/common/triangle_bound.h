// SPDX-License-Identifier: AGPL-3.0-or-later
// What a triangle of a closed boundary and its neighbours allow the tetrahedron that stands on it.
#pragma once

#include <stdint.h>

#define CW_TET_BOUND_MOST 45.0 // degrees; no bound above it is looked for

// What lies across an edge of a triangle.
typedef struct {
  double angle;     // inner angle at the edge, degrees; 90 where it is more or there is no neighbour
  int32_t apex;     // number of the neighbour's third corner; -1: no neighbour
  const double *at; // its place
} CwBoundSide;

// Inner angle (degrees) at the edge from - to of the triangle with the outward normal m and a neighbour with n, of any
// length; 90 where it is more.
double cw_inner_angle(const double from[3], const double to[3], const double m[3], const double n[3]);

// No filling has a tetrahedron on the triangle whose least dihedral angle is above this (degrees). At an edge with the
// inner angle A stands one tetrahedron, which is then that of the edge's two triangles, or there are more, and one of
// them has A/2 or less. So the tetrahedron on a triangle has the apex of a side as its fourth corner, is known, and the
// other edges (but those with the same apex) have two tetrahedra or more; or all three edges have. The bound is the
// best of these four, or anything not below `least`. Side k lies at the edge from corner k to the next; the normal of
// the corners points outward.
double cw_triangle_bound(const double *const corner[3], const CwBoundSide side[3], double least);

// A surface, normals outward, and the triangles at each of its points, as in CwIncident.
typedef struct {
  const int32_t (*triangle)[3];
  const double (*x)[3];
  const int32_t *start, *around;
} CwBoundSurface;

// The triangle beside t at its edge from a to b, where there is just one; else -1. *apex: its third corner.
int32_t cw_bound_neighbour(const CwBoundSurface *surface, int32_t t, int32_t a, int32_t b, int32_t *apex);
// The bound of triangle t by its neighbours.
double cw_bound_on(const CwBoundSurface *surface, int32_t t, double least);
