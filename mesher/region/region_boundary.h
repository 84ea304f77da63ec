// SPDX-License-Identifier: AGPL-3.0-or-later
// The closed inner boundary of a region: front, caps, interfaces, in this order, with nodes of its own numbering.
#ifndef CUTWATER_MESHER_REGION_REGION_BOUNDARY_H
#define CUTWATER_MESHER_REGION_REGION_BOUNDARY_H

#include "mesher/fill/fill.h"
#include "mesher/skeleton/skeleton.h"

typedef struct {
  int32_t wall_count, cap_count, interface_count; // triangles
  int32_t (*triangle)[3];                         // local nodes; normal out of the region
  int32_t *source;                                // wall, cap or interface triangle of the skeleton
  int32_t node_count;
  int32_t *node; // skeleton node of each local one
  double (*x)[3];
} CwRegionBoundary;

// `planned`: with the interfaces as they were before the rule of region numbers.
CwStatus cw_region_boundary_make(const CwSkeleton *skeleton, int32_t region, int planned, CwRegionBoundary *boundary);
void cw_region_boundary_free(CwRegionBoundary *boundary);

// Views the boundary and the size field as an input of the fill.
CwFillInput cw_region_fill_input(const CwSkeleton *skeleton, const CwRegionBoundary *boundary, const char *name);

#endif
