// SPDX-License-Identifier: AGPL-3.0-or-later
// A tetrahedral mesh that can be changed in place: neighbours, rings, stars, and the exchange of one set of
// tetrahedra for another that fills the same cavity.
#ifndef CUTWATER_MESHER_TET_IMPROVE_MESH_H
#define CUTWATER_MESHER_TET_IMPROVE_MESH_H

#include <stdint.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_CAVITY = 96 }; // tetrahedra in one cavity

typedef struct {
  int32_t fixed_count; // the first points lie on the boundary and stay
  int32_t point_count, point_space;
  double (*x)[3];
  int32_t tet_count, tet_space; // with dead ones, whose first corner is -1
  int32_t (*corner)[4];
  int32_t (*neighbour)[4]; // 4 * tetrahedron + face at the face opposite each corner, -1 at the boundary
  double *quality;
  int32_t *tet_at; // one tetrahedron of each point, -1 for none
  int32_t *dead;   // stack of dead tetrahedra
  int32_t dead_count, dead_space;
} CwTetMesh;

// Takes over x and corner (malloc'd); on failure frees nothing of them.
CwStatus cw_tet_mesh_make(int32_t fixed_count, int32_t point_count, double (*x)[3], int32_t tet_count,
                          int32_t (*corner)[4], CwTetMesh *mesh);
// Frees all but x and corner.
void cw_tet_mesh_free(CwTetMesh *mesh);
// Squeezes dead tetrahedra and unused inner points out, in order.
CwStatus cw_tet_mesh_squeeze(CwTetMesh *mesh);
CwStatus cw_tet_mesh_add_point(CwTetMesh *mesh, const double x[3], int32_t *point);

// Shape of a tetrahedron: least sine of its dihedral angles, and not above 1.35 times shortest over longest
// edge. 0.943 for the regular one, <= 0 where it is not positive.
double cw_tet_quality(const double a[3], const double b[3], const double c[3], const double d[3]);

// Tetrahedra round the inner edge of corners i and j of t: tet[k] has the edge a-b (a = corner i, b = corner
// j) and the points ring[k], ring[k + 1]; (a, b, ring[k], ring[k + 1]) is positive. Returns their number; 0
// for an edge of the boundary or one with more than `most`.
int cw_tet_mesh_ring(const CwTetMesh *mesh, int32_t t, int i, int j, int most, int32_t *tet, int32_t *ring);
// Tetrahedra of an inner point; 0 where there are more than CW_CAVITY or the point lies on the boundary.
int cw_tet_mesh_star(const CwTetMesh *mesh, int32_t point, int32_t tet[CW_CAVITY]);

// Puts `count` tetrahedra in the place of the `old_count` ones; both must fill the same cavity.
CwStatus cw_tet_mesh_replace(CwTetMesh *mesh, int old_count, const int32_t *old, int count,
                             const int32_t (*corner)[4], const double *quality);

#ifdef __cplusplus
}
#endif
#endif
