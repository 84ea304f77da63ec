// SPDX-License-Identifier: AGPL-3.0-or-later
// Places where the mesh has to be another than the case asks: where no layers stand on a wall, or tetrahedra are flat.
// Edges there are shorter, by points of the size fields (CwSizePoint), or columns have no height; all is made anew.
#pragma once

#include <stdint.h>

#include "mesher/run/domain.h"
#include "mesher/size/size.h"
#include "pipeline/status.h"

typedef struct {
  int32_t domain;
  int32_t pinched; // 1: columns within the size of the point have no height; 0: edges are shorter
  CwSizePoint point;
} CwFinerPlace;

// Zeroed: none. Those of a later round follow those of an earlier one, also where they ask at the same place again.
typedef struct {
  int32_t count, capacity;
  CwFinerPlace *place;
} CwFinerPlaces;

// Adds the place x of a domain, and its periodic images: edges there are to be half as long as now.
CwStatus cw_finer_places_add(const CwDomain *domain, int32_t number, const double x[3], CwFinerPlaces *places);
// Adds the place x and its periodic images: columns within an edge of it are to have no height, since layers do not
// stand there; within twice the radius of a place that did not do, of the first `before`.
CwStatus cw_finer_places_add_pinched(const CwDomain *domain, int32_t number, const double x[3], int32_t before,
                                     CwFinerPlaces *places);
// The points of one domain where edges are shorter; *point is allocated, caller frees.
CwStatus cw_finer_places_of(const CwFinerPlaces *places, int32_t domain, int32_t *count, CwSizePoint **point);
void cw_finer_places_free(CwFinerPlaces *places);
