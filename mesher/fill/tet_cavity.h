// SPDX-License-Identifier: AGPL-3.0-or-later
// The one cavity operator: a cavity given by the faces round it, seen from a point inside, and the place in it from
// which the worst of the tetrahedra to all faces is best.
#pragma once

#include "mesher/common/tet.h"
#include "mesher/fill/tet_work.h"

// Each face makes a positive tetrahedron (face, point). The corners are the mesh's.
typedef struct {
  int count;
  const double *face[CW_STAR][3];
} CwCavity;

extern const double cw_tet_direction[14][3]; // unit vectors to the faces and corners of a cube

// Face i of a tetrahedron as seen from inside it.
static inline void cw_cavity_face(const CwTet *tet, int i, int32_t corner[3]) {
  for (int k = 0; k < 3; k++) corner[k] = tet->corner[cw_tet_face[i][(3 - k) % 3]];
}

// Least quality of the cavity's tetrahedra for the point at p; stops at `enough` and moves that face forward, so that
// the next trial finds it first.
double cw_cavity_quality(CwCavity *cavity, const double p[3], double enough);
// Pattern search (R. Hooke and T. Jeeves, J. ACM 8, 1961) for the place of best least quality from p, which it moves
// and which has the quality `start`; returns the quality found.
double cw_cavity_best(CwCavity *cavity, double p[3], double start);
