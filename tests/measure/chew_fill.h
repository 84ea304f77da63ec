// SPDX-License-Identifier: AGPL-3.0-or-later
// What the refinement of a region comes to: tetrahedra by the kernel's own last steps, as a region file.
#pragma once

#include "chew_points.h"
#include "mesher/region/region_file.h"

// The closed boundary of a region with its interfaces as they were split, and its inner points. The nodes of the
// region's own boundary come first, then those of splits.
typedef struct {
  int32_t node_count, triangle_count, inner_count;
  int32_t wall_count, fixed_count; // triangles: of the layer top, and of it and open patches, which come first
  double (*x)[3];
  int32_t (*triangle)[3];
  int64_t *shared; // of each node: its number in the domain, -1: of no partition plane
  double (*inner)[3];
} CwChewSurface;

// Numbers the sources of the region's mesh anew: nodes of the surface, then inner points.
CwStatus cw_chew_surface_make(const CwRegionInput *from, int32_t count, const CwChewInterface *interface,
                              CwChewRegion *region, CwChewSurface *surface);
void cw_chew_surface_free(CwChewSurface *surface);

// The kernel's steps from the refined mesh on, which is used up: what is missing of the boundary is recovered, the
// inside is kept and improved. Where that does not do, fill_with_fallback.h.
CwStatus cw_chew_fill(const CwRegionInput *from, const CwChewSurface *surface, const char *name, CwTetMesh *mesh,
                      CwFill *fill);

// The tetrahedra as a region without layers, whose boundary is layer top and open patches: for the audit, and for who
// measures the files of regions.
CwStatus cw_chew_region_mesh(const char *domain, int32_t region, const CwChewSurface *surface, const CwFill *fill,
                             CwRegionMesh *mesh);
