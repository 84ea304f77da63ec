// SPDX-License-Identifier: AGPL-3.0-or-later
// Delaunay tetrahedra of points: incremental insertion (A. Bowyer, D. Watson, Comput. J. 24, 1981) in a biased
// randomised order along Hilbert's curve, with exact signs. The points lie inside one large tetrahedron, whose corners
// are points 0 to 3 of the mesh.
#pragma once

#include "mesher/fill/tet_mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

// Empty sphere of every tetrahedron, exactly; ties are broken by the order of insertion. Deterministic.
// Memory: 48 bytes a tetrahedron and 36 a point.
CwStatus cw_delaunay_make(int32_t count, const double (*x)[3], CwTetMesh *mesh);
// The same in two steps: after the first the mesh has its own copy of the points, and x may be freed before
// the tetrahedra take their memory. Each leaves the mesh empty where it fails.
CwStatus cw_delaunay_order(int32_t count, const double (*x)[3], CwTetMesh *mesh);
CwStatus cw_delaunay_connect(CwTetMesh *mesh);

// Points one by one into a mesh so made, which nothing else changes meanwhile and which outlives the insertion.
typedef struct CwDelaunayInsertion CwDelaunayInsertion;
CwStatus cw_delaunay_open(CwTetMesh *mesh, CwDelaunayInsertion **insertion);
// A point with the given source. `near`: the tetrahedron from which its place is looked for; -1: one of the last point.
// [out] point: its number in the mesh, -1 where another stands at its place.
CwStatus cw_delaunay_insert(CwDelaunayInsertion *insertion, const double x[3], int32_t source, int32_t near,
                            int32_t *point);
void cw_delaunay_close(CwDelaunayInsertion **insertion);

#ifdef __cplusplus
}
#endif
