// SPDX-License-Identifier: AGPL-3.0-or-later
// Delaunay tetrahedra of points: incremental insertion (A. Bowyer, D. Watson, Comput. J. 24, 1981) in a biased
// randomised order along Hilbert's curve, with exact signs. The points lie inside one large tetrahedron, whose corners
// are points 0 to 3 of the mesh.
#ifndef CUTWATER_MESHER_FILL_DELAUNAY_H
#define CUTWATER_MESHER_FILL_DELAUNAY_H

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

#ifdef __cplusplus
}
#endif
#endif
