// SPDX-License-Identifier: AGPL-3.0-or-later
// What must hold for every mesh of tetrahedra between two operations.
#pragma once

#include "mesher/common/predicates.h"
#include "mesher/common/quality.h"
#include "mesher/common/tet.h"
#include "mesher/fill/tet_mesh.h"
#include "tests/unit_test.h"

// All tetrahedra are positive and neighbours know and share the same face; returns six times the volume.
static inline double joined_volume6(const CwTetMesh *mesh) {
  double six = 0.0;
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    const CwTet *tet = &mesh->tet[t];
    if (tet->corner[0] < 0) continue;
    const double *x[4];
    for (int i = 0; i < 4; i++) x[i] = mesh->point[tet->corner[i]].x;
    assert_int_equal(cw_orient3d(x[0], x[1], x[2], x[3]), 1);
    six += cw_tet_volume6(x[0], x[1], x[2], x[3]);
    for (int i = 0; i < 4; i++) {
      if (tet->neighbour[i] < 0) continue;
      const CwTet *other = &mesh->tet[tet->neighbour[i] / 4];
      assert_true(other->corner[0] >= 0);
      assert_int_equal(other->neighbour[tet->neighbour[i] % 4], 4 * t + i);
      for (int k = 0; k < 3; k++) {
        int shared = 0;
        for (int m = 0; m < 4; m++)
          shared += m != tet->neighbour[i] % 4 && other->corner[m] == tet->corner[cw_tet_face[i][k]];
        assert_int_equal(shared, 1);
      }
    }
  }
  return six;
}
