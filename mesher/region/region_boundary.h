// SPDX-License-Identifier: AGPL-3.0-or-later
// The closed inner boundary of a region: layer top, walls without layers, open patches, interfaces, in this order, with
// nodes of its own numbering.
#pragma once

#include "mesher/region/region_input.h"
#include "mesher/fill/fill.h"

typedef struct {
  int32_t wall_count, bare_count, open_patch_count, interface_count; // triangles
  int32_t (*triangle)[3];                                            // local nodes; normal out of the region
  int32_t *source; // wall, open patch or interface triangle of the boundary
  int32_t node_count;
  int32_t *node; // boundary node of each local one
  double (*x)[3];
} CwRegionBoundary;

// `planned`: with the interfaces as they were before the rule of region numbers.
CwStatus cw_region_boundary_make(const CwRegionInput *from, int32_t region, int planned, CwRegionBoundary *inner);
void cw_region_boundary_free(CwRegionBoundary *inner);

// Writes it as VTK PolyData, for a look (cell data surface: 0 layer top, 1 open patch or wall without layers, 2
// interface; crossing: a number of each triangle, NULL: none).
CwStatus cw_region_boundary_vtk(const CwRegionBoundary *inner, const int32_t *crossing, const char *title,
                                const char *path);

// Views the boundary and the size field as an input of the fill, which checks that it is closed (boundary_check.h).
CwFillInput cw_region_fill_input(const CwRegionInput *from, const CwRegionBoundary *inner, const char *name);
