// SPDX-License-Identifier: AGPL-3.0-or-later
// Which given points of a patch lie on one cut: the inner given edges, followed from one of their ends to the other. A
// triangle with all corners on a cut lies in the partition plane, and no column on this plane leaves it.
#pragma once

#include "mesher/surface/patch_input.h"
#include "pipeline/status.h"

typedef struct {
  int32_t point_count, *cut;    // of each given point: the cut that it lies inside of; -1: none, or the end of one
  int32_t cut_count, (*end)[2]; // points at both ends of each; -1: it is closed
} CwPatchCuts;

// Edges that input->boundary marks are outline, all others cuts. Fails with CW_ERR_MEMORY only.
CwStatus cw_patch_cuts_make(const CwPatchInput *input, CwPatchCuts *cuts);
void cw_patch_cuts_free(CwPatchCuts *cuts);

// Whether one cut has all three points, which need not be given ones.
int cw_patch_cuts_hold(const CwPatchCuts *cuts, const int32_t point[3]);
