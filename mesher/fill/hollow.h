// SPDX-License-Identifier: AGPL-3.0-or-later
// A hollow in a mesh, given by the faces round it, and the best place for a point that is to see all of them.
#ifndef CUTWATER_MESHER_FILL_HOLLOW_H
#define CUTWATER_MESHER_FILL_HOLLOW_H

#include "mesher/fill/delaunay.h"

#ifdef __cplusplus
extern "C" {
#endif

// {0} is an empty one.
typedef struct {
  int32_t (*face)[3]; // with a point inside each is a positive tetrahedron
  double (*normal)[3];
  int32_t count, space;
} CwHollow;

CwStatus cw_hollow_add(CwHollow *hollow, const CwDelaunay *mesh, const int32_t face[3]);
void cw_hollow_free(CwHollow *hollow);

// Least six-fold volume over the cube of the longest edge, of the tetrahedra from p to all faces; *worst is its
// face. Not above 0 where one is not positive.
double cw_hollow_worth(const CwHollow *hollow, const CwDelaunay *mesh, const double p[3], int32_t *worst);

// Searches the place of most worth: from the middle of the faces, and where `start` is given, which sees all
// faces or nearly, also from there, at first into the direction `inward`. Returns its worth; where that is not above 0,
// p is the middle.
double cw_hollow_place(const CwHollow *hollow, const CwDelaunay *mesh, const double start[3], const double inward[3],
                       double p[3]);

#ifdef __cplusplus
}
#endif
#endif
