// SPDX-License-Identifier: AGPL-3.0-or-later
// Places where the mesh has to be another than the case asks: where no layers stand on a wall, or tetrahedra are flat.
// Edges there are shorter, by points of the size fields (CwSizePoint), or the wall carries no layers; all is made anew.
#pragma once

#include <stdint.h>

#include "mesher/run/domain.h"
#include "mesher/size/size.h"
#include "pipeline/status.h"

typedef struct {
  int32_t domain;
  int32_t bare; // the face that carries no layers there; -1: edges are shorter
  CwSizePoint point;
} CwFinerPlace;

// Zeroed: none. Those of a later round follow those of an earlier one, also where they ask at the same place again.
typedef struct {
  int32_t count, capacity;
  CwFinerPlace *place;
} CwFinerPlaces;

// Adds the place x of a domain, and its periodic images: edges there are to be half as long as now.
CwStatus cw_finer_places_add(const CwDomain *domain, int32_t number, const double x[3], CwFinerPlaces *places);
// Adds the wall at x, and its periodic images, which are to carry no layers, since none stand there: of those within
// half an edge of x that still carry some the least one. None where there is no such wall.
CwStatus cw_finer_places_add_bare(const CwDomain *domain, int32_t number, const double x[3], CwFinerPlaces *places);
// The points of one domain where edges are shorter; *point is allocated, caller frees.
CwStatus cw_finer_places_of(const CwFinerPlaces *places, int32_t domain, int32_t *count, CwSizePoint **point);
void cw_finer_places_free(CwFinerPlaces *places);
