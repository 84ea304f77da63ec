// SPDX-License-Identifier: AGPL-3.0-or-later
// One region of the mesh from the boundary: tetrahedra inside its layer top, prisms in its columns, boundary faces.
#pragma once

#include "mesher/parallel/outcome.h"
#include "mesher/region/column_place.h"
#include "mesher/region/region_file.h"
#include "mesher/region/region_input.h"
#include "pipeline/case.h"

// The points of a domain's mesh that its regions share: those of nodes on partition planes, with their columns.
typedef struct {
  int32_t node_count;               // of all nodes of the boundary
  int64_t *base;                    // of each node: first shared number of its column (or its own), -1: not shared
  int64_t count;                    // of the points
  int32_t shared_node_count, *node; // the shared nodes by ascending base
  CwHostMemory *memory;             // where its arrays lie; NULL: they are this rank's
} CwSharedNodes;

CwStatus cw_shared_nodes_make(const CwRegionInput *from, int layer_count, CwSharedNodes *shared);
// Shows its arrays (CwArrays).
void cw_shared_nodes_arrays(void *shared, CwArrayVisit visit, void *given);
void cw_shared_nodes_free(CwSharedNodes *shared);

// What the regions of a domain are made from.
typedef struct {
  CwRegionInput from;
  const char *domain;
  int layer_count;
  CwFillMethod fill;
  const double *first_height; // of each wall vertex, by which its column is divided, m
  const double *growth;       // of each wall vertex, largest ratio of neighbouring layers
  const CwSharedNodes *shared;
  CwOpenEdgePlaces open_edge_places;
} CwRegionContext;

// Hex fingerprint of all that region `region` (0-based) follows from.
void cw_region_fingerprint(const CwRegionContext *context, int32_t region, char fingerprint[CW_HASH_TEXT]);

// Makes the region. [out] mesh: freed by cw_region_free; empty unless the outcome is done. Outcome: CW_OUTCOME_THIN
// where the boundary cannot be filled or a node lies off its interface of domains; the reason names domain and region.
// CW_ERR_FAULT where what was filled does not fit the boundary. Its cells are not looked at (cw_audit_region).
CwStatus cw_region_build(const CwRegionContext *context, int32_t region, int32_t number, CwRegionMesh *mesh,
                         CwOutcome *outcome);
