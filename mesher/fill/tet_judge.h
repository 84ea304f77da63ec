// SPDX-License-Identifier: AGPL-3.0-or-later
// Judges tetrahedra, all or some: their qualities, which are slender, and round which points all is regular. Eight at
// once in single precision (tet_group.h), and in double precision what is near the limit.
#pragma once

#include "mesher/common/simd_4f.h"
#include "mesher/fill/tet_work.h"

// The shapes that relaxing and the changes for the aspect go by.
typedef struct {
  double floor;       // quality below which none becomes worse for the sake of the aspect
  CwTetList slender;  // of those judged last
  uint8_t *irregular; // by point, where relaxing is to follow: 1 where one round it is not as in a lattice; or NULL
  int32_t irregular_capacity;
  Cw4f *place; // of each point when they were last judged or moved together, from `middle`
  int32_t place_capacity;
  double middle[3], blurred; // square of an edge that is too short for such places
} CwTetShapes;

enum { CW_TET_PAD = 7 }; // room behind a list of tetrahedra that are judged by groups

void cw_tet_shapes_free(CwTetShapes *shapes);

// Longest over shortest edge, squared, above which a tetrahedron is slender.
double cw_tet_slender_square(void);

// Places of all points for single precision; cw_tet_goal gives what a place has become in double precision.
CwStatus cw_tet_set_places(CwTetWork *w, CwTetShapes *shapes);
void cw_tet_goal(const CwTetWork *w, const CwTetShapes *shapes, int32_t p, double goal[3]);

// A list of tetrahedra is taken by groups: the last one stands for those that lack.
void cw_tet_pad_list(int32_t *list, int32_t count);

// Sets the quality of some tetrahedra as it is to be at the places, in a list with CW_TET_PAD more, and puts them into
// the list where they are below the limit, into that of the slender ones and, where given, into that of the spoilt
// ones.
CwStatus cw_tet_judge(CwTetWork *w, CwTetShapes *shapes, const int32_t *list, int32_t count, CwTetList *spoilt);

// Whether moves make a tetrahedron worse than it may be.
int cw_tet_is_spoilt(const CwTetWork *w, const CwTetShapes *shapes, int32_t t);

// Sets all qualities, finds the slender tetrahedra, and puts those below the limit into the list.
CwStatus cw_tet_judge_all(CwTetWork *w, CwTetShapes *shapes);
