// SPDX-License-Identifier: AGPL-3.0-or-later
// A packed patch without a mesh, as those have it whose outlines cross themselves.
#pragma once

extern "C" {
#include "mesher/network/plane_map.h"
#include "mesher/surface/patch_task.h"
}

#include "solids.h"

// Its outcome is CW_OUTCOME_FINER; the caller frees it.
static inline void *bow_tie_bytes() {
  const double corner[4][3] = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  const CwPlane plane = {{0, 0, 1}, 0};
  CwPlaneMap map = cw_plane_map_of(&plane);
  CwPatchOutline outline = {};
  void *bytes = nullptr;
  int64_t size;
  int32_t previous = -1;
  check(cw_outline_start(&outline, 4));
  for (int k = 0; k < 5; k++) {
    double uv[2];
    cw_plane_uv(&map, corner[k % 4], uv);
    check(cw_outline_next(&outline, k % 4, uv, corner[k % 4], 1, &previous));
  }
  check(cw_patch_task(
      &outline, cw_plane_map, &map, [](const void *, const double *) { return 1.0; }, nullptr, 0, 0,
      [](const void *, const double *) { return 0; }, nullptr, "bow tie", &bytes, &size));
  cw_outline_free(&outline);
  CwPatchBlock block;
  cw_patch_block(bytes, &block);
  assert_int_equal(block.outcome.kind, CW_OUTCOME_FINER);
  return bytes;
}
