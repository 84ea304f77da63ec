// SPDX-License-Identifier: AGPL-3.0-or-later
// A straight pipe, round or round a shaft, as a domain of its own: a prism over the flat end of another domain, with
// which it shares that end's outline exactly, so that both sides of the disc between them can be meshed to the same
// border.
#pragma once

#include "geometry/solid.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// What the pipe's domain and the patches are called. The far end takes over name and kind of the end that the
// neighbour had, inlet or outlet.
typedef struct {
  const char *domain;
  const char *wall;
  const char *core;           // wall inside a ring
  const char *side;           // of the disc between both, as a patch of the pipe
  const char *neighbour_side; // the same as a patch of the neighbour
} CwPipeZoneNames;

// Builds the pipe of `length` m outward from the patch `end` of `neighbour`: one disk or the sectors of a ring, flat
// and in one plane, whose outlines must be arcs of less than a turn about one axis and, between sectors, straight
// lines. These faces become the interface `neighbour_side`. Free with cw_solid_free(). Fails with CW_ERR_GEOMETRY.
CwStatus cw_pipe_zone_make(CwSolid *neighbour, const char *end, double length, const CwPipeZoneNames *names,
                           CwSolid **pipe);

#ifdef __cplusplus
}
#endif
