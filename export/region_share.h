// SPDX-License-Identifier: AGPL-3.0-or-later
// Which rank has which regions. Regions of one domain with the same counts may be copies of one another, turned about
// the axis, as the passages of a wheel are: one rank has all of them, so that what is known of one need not be found
// again for the others (region_check.h).
#pragma once

#include "pipeline/mesh/manifest.h"
#include "pipeline/parallel/ranks.h"

typedef struct {
  int *alike; // by region: the first region with the same counts, itself where it is that
  int *owner; // by region: its rank
  int *own;   // the regions of this rank, those that are alike one after another
  int own_count;
} CwRegionShare;

// Follows from mesh and number of ranks alone: sets of regions that are alike, largest first, to the rank that has
// least. CW_ERR_MEMORY; the caller frees the share then too.
CwStatus cw_region_share(const CwMesh *mesh, const CwRanks *ranks, CwRegionShare *share);
void cw_region_share_free(CwRegionShare *share);
