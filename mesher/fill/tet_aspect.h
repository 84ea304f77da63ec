// SPDX-License-Identifier: AGPL-3.0-or-later
// Longest over shortest edge of tetrahedra: which are slender, and what changes for the aspect go by.
#pragma once

#include <math.h>

#include "mesher/common/branchless.h"
#include "mesher/common/tet.h"
#include "mesher/fill/tet_work.h"
#include "mesher/policy.h"

// The shortest and the longest edge of a tetrahedron: squares, and the ends of the longest.
typedef struct {
  double shortest, longest;
  int32_t far[2];
} CwTetEnds;

static inline CwTetEnds cw_tet_ends(const CwTetWork *w, const int32_t corner[4]) {
  CwTetEnds ends;
  double square[6];
  int far = 0;
  for (int e = 0; e < 6; e++) square[e] = cw_tet_square_of(w, corner[cw_tet_edge[e][0]], corner[cw_tet_edge[e][1]]);
  ends.shortest = ends.longest = square[0];
  for (int e = 1; e < 6; e++) { // which one is as good as random, and takes no branch
    far += (int)cw_branchless(square[e] > ends.longest) * (e - far);
    ends.shortest = cw_lesser(square[e], ends.shortest);
    ends.longest = cw_greater(square[e], ends.longest);
  }
  for (int i = 0; i < 2; i++) ends.far[i] = corner[cw_tet_edge[far][i]];
  return ends;
}

// Longest over shortest edge, less the usual.
static inline double cw_tet_excess(const CwTetWork *w, const int32_t corner[4]) {
  double shortest = INFINITY, longest = 0.0;
  for (int e = 0; e < 6; e++) {
    double square = cw_tet_square_of(w, corner[cw_tet_edge[e][0]], corner[cw_tet_edge[e][1]]);
    shortest = cw_lesser(shortest, square);
    longest = cw_greater(longest, square);
  }
  return sqrt(longest / shortest) - cw_policy.usual_aspect;
}
