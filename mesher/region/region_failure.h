// SPDX-License-Identifier: AGPL-3.0-or-later
// What is done about a region that cannot be filled: its boundary is kept for a look, the place is found, and the
// columns of the layers there are thinned, so that layer top, planes and open patches get more room between them.
#pragma once

#include "mesher/parallel/outcome.h"
#include "mesher/region/region_boundary.h"

typedef struct {
  int32_t failed;     // 1: the region could not be made
  int32_t everywhere; // no place is known: 1 means all of the region
  double at[3];       // m
  char patch[40];     // where the place is on the layer top or on an open patch; "partition plane", "the layers"
  char message[400];  // of the last attempt
} CwRegionFailure;

// Examines the boundary of `region` after an outcome that is not done, and writes it to `path` (VTK PolyData; cell data
// surface: 0 layer top, 1 open patch, 2 interface; crossing: 1 where the triangle meets another). The place is that of
// the outcome, else the first crossing.
CwStatus cw_region_failure_examine(const CwRegionInput *from, int32_t region, const CwOutcome *why, const char *path,
                                   CwRegionFailure *failure);

// Lowers the greatest thicknesses `most` (of each wall vertex, m) of the columns near the failure to column_kept
// (policy_table.h) of what they are now: those whose layer top is nearer to it than `reach` wanted lengths, or all of
// the region.
void cw_region_failure_thin(const CwRegionInput *from, int32_t region, const CwRegionFailure *failure, double reach,
                            double *most);
