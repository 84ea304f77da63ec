// SPDX-License-Identifier: AGPL-3.0-or-later
// One region file of a mesh in memory.
#pragma once

#include "pipeline/mesh/manifest.h"
#include "pipeline/mesh/region_items.h"

// Reads one region file, or a part of it, and checks it against its line of the manifest: digest, counts, and that
// every index is in range and every coordinate finite. CW_ERR_IO or CW_ERR_INPUT. Zeroed `data` on entry;
// free it with cw_mesh_region_free, also after a failure.
CwStatus cw_mesh_region_read(const CwMesh *mesh, int region, CwRegionPart part, CwRegionData *data);

// Has the system read the file of a region that is wanted soon, while this one is worked on.
void cw_mesh_region_ahead(const CwMesh *mesh, int region);
