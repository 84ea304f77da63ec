// SPDX-License-Identifier: AGPL-3.0-or-later
// Two tetrahedra with the common face 0 1 2: one above it, with point 3, and one below, with point 4. The boundary that
// goes with them is that of the first alone.
#pragma once

#include "mesher/common/tet.h"
#include "mesher/fill/fill.h"
#include "tests/unit_test.h"

static const double two_x[5][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, 1}, {0.2, 0.2, -1}};
static const int32_t two_tets[2][4] = {{0, 1, 2, 3}, {0, 2, 1, 4}};

// Its triangle i lies opposite corner i. inward: 1: the normals point into it.
static inline CwFillInput two_boundary(int32_t triangle[4][3], int inward) {
  for (int i = 0; i < 4; i++) {
    for (int k = 0; k < 3; k++) triangle[i][k] = cw_tet_face[i][inward ? (3 - k) % 3 : k];
  }
  return (CwFillInput){.point_count = 4,
                       .x = two_x,
                       .triangle_count = 4,
                       .triangle = (const int32_t(*)[3])triangle,
                       .name = "two tetrahedra"};
}
