// SPDX-License-Identifier: AGPL-3.0-or-later
// The order of a region's points and tetrahedra.
#pragma once

extern "C" {
#include "mesher/common/vec.h"
#include "mesher/region/region_file.h"
}

#include "solids.h"

// What is near in space is near in memory: steps between the region's own points are mostly short, and tetrahedra
// but those of tapered layers stand by their last point.
static inline void check_point_order(const CwRegionMesh &mesh, double size) {
  const CwRegionData &cells = mesh.cells;
  int32_t before = 0, near = 0, own = cells.point_count - cells.shared_count;
  for (int32_t p = cells.shared_count + 1; p < cells.point_count; p++)
    near += cw_distance(cells.points[p - 1], cells.points[p]) < 2 * size;
  assert_true(near > 0.9 * own);
  for (int32_t t = 0; t < cells.tetrahedron_count - mesh.layer_tetrahedra; t++) {
    int32_t last = 0;
    for (int32_t corner : cells.tetrahedra[t]) last = corner > last ? corner : last;
    assert_true(last >= before);
    before = last;
  }
}
