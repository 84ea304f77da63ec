// SPDX-License-Identifier: AGPL-3.0-or-later
// One region of the mesh from the boundary: tetrahedra inside its layer top, prisms in its columns, boundary faces.
#ifndef CUTWATER_MESHER_REGION_REGION_BUILD_H
#define CUTWATER_MESHER_REGION_REGION_BUILD_H

#include "mesher/region/column_place.h"
#include "mesher/region/region_file.h"
#include "mesher/region/region_input.h"
#include "pipeline/case.h"

// What all regions of a domain share.
typedef struct {
  CwRegionInput from;
  const char *domain;
  int layer_count;
  CwFillMethod fill;
  const double *first_height; // of each wall vertex, by which its column is divided, m
  const double *growth;       // of each wall vertex, largest ratio of neighbouring layers
  // Filled by cw_region_context_make:
  int64_t *shared_base; // of each boundary node: first shared number of its column (or its own), -1: not shared
  int64_t shared_count;
  int32_t shared_node_count, *shared_node; // the shared nodes by ascending base
  CwOpenEdgePlaces open_edge_places;
  int32_t open_edge_count;
  int32_t (*open_edge)[3]; // wall edges on open patches: smaller vertex, greater vertex, open patch face; sorted
} CwRegionContext;

CwStatus cw_region_context_make(CwRegionContext *context);
void cw_region_context_free(CwRegionContext *context);

// Hex fingerprint of all that region `region` (0-based) follows from.
void cw_region_fingerprint(const CwRegionContext *context, int32_t region, char fingerprint[CW_HASH_TEXT]);

// Makes the region. Fails with CW_ERR_MESH naming domain, region and place.
CwStatus cw_region_build(const CwRegionContext *context, int32_t region, int32_t number, CwRegionMesh *mesh);

#endif
