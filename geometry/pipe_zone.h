// SPDX-License-Identifier: AGPL-3.0-or-later
// A straight pipe as a domain of its own: a prism over the flat end of another domain, with which it shares
// that end's outline exactly, so that both sides of the disc between them can be meshed to the same border.
#ifndef CUTWATER_GEOMETRY_PIPE_ZONE_H
#define CUTWATER_GEOMETRY_PIPE_ZONE_H

#include "geometry/solid.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// What the pipe's domain and the patches are called. The far end takes over name and kind of the end that the
// neighbour had, "inlet" or "outlet".
typedef struct {
  const char *domain;
  const char *wall;
  const char *side;           // of the disc between both, as a patch of the pipe
  const char *neighbour_side; // the same as a patch of the neighbour
} CwPipeZoneNames;

// Builds the pipe of `length` m outward from the single, flat face of the patch `end` of `neighbour`, whose
// outline must be arcs of one circle of less than a turn each; that face becomes the interface
// `neighbour_side`. Free with cw_solid_free(). Fails with CW_ERR_GEOMETRY.
CwStatus cw_pipe_zone_make(CwSolid *neighbour, const char *end, double length, const CwPipeZoneNames *names,
                           CwSolid **pipe);

#ifdef __cplusplus
}
#endif
#endif
