// SPDX-License-Identifier: AGPL-3.0-or-later
// The boundary of a region by itself.
#ifndef CUTWATER_PIPELINE_REPORT_SURFACE_H
#define CUTWATER_PIPELINE_REPORT_SURFACE_H

#include "pipeline/mesh/region_items.h"

// The boundary faces of a region with their patches, in their order, and the points of these faces alone, in theirs:
// what is looked at once for each picture lies close together in memory. Zeroed `surface` on entry; free it with
// cw_mesh_region_free, also after a failure. CW_ERR_MEMORY.
CwStatus cw_surface_of(const CwRegionData *cells, CwRegionData *surface);

#endif
