// SPDX-License-Identifier: AGPL-3.0-or-later
// The constrained Delaunay triangulation of the given points and edges of a patch: where its mesh starts. The
// one bridge of the surface mesher to CGAL (exact predicates). No point is added.
#pragma once

#include <stdint.h>

#include "mesher/parallel/outcome.h"
#include "mesher/surface/patch_input.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  int32_t triangle_count;
  int32_t (*triangle)[3];  // counter-clockwise; the smallest point first, sorted by points
  int32_t (*neighbour)[3]; // triangle opposite to each corner; -1 outside the patch
  uint8_t *given;          // bit i: the edge opposite to corner i is a given edge
  int32_t *component;      // of each triangle, numbered in the order of the triangles
  int32_t component_count;
} CwCdt;

// Triangulates the plane of (scale[0] u, scale[1] v) (both scales above 0) and keeps the triangles that lie
// inside by parity through the boundary edges, cut into components by all given edges. Fails with
// CW_ERR_MESH and the place where an index or a number is wrong, the boundary is open, or nothing is inside. Outcome:
// CW_OUTCOME_FINER with the place where points coincide, an edge is given twice, edges cross or a point lies on an
// edge: shorter edges may keep apart what they go round.
CwStatus cw_cdt_make(const CwPatchInput *input, const double scale[2], CwCdt *cdt, CwOutcome *outcome);
void cw_cdt_free(CwCdt *cdt);

#ifdef __cplusplus
}
#endif
