// SPDX-License-Identifier: AGPL-3.0-or-later
// Offset points: the first layer of inner points over triangles of a region's boundary (layer top, non-wall patches,
// both sides of interfaces).
// Lattice points that are merely kept at a distance stand at any height between half a length and more than one over
// them; offset points stand where well shaped tetrahedra on the triangles have their fourth corners, one for about two
// triangles, as each plane of a close packing does over the one below.
#pragma once

#include <stdint.h>

#include "mesher/fill/fill.h"

typedef struct {
  double x[3], spacing; // m
  double along;         // a line, in whose order places are taken
  int32_t triangle;
  int on_interface;
} CwOffsetPoint;

// The place over the middle of triangle t, inward, whatever is there. The spacing is the mean of what is wanted there
// and of the triangle's edges, which it exceeds by little; where less is wanted than the edges are long, that counts
// twice.
CwOffsetPoint cw_offset_point(const CwFillInput *input, int32_t t);
// The places of the last `offset_count` triangles of the input in the order in which they are best taken: those over
// interfaces first, since they are continued on the other side, and along a line; equal ones as their triangles. What
// is taken so is as regular as the triangles are; in any other order, gaps are left between beginnings. Caller frees
// *places.
CwStatus cw_offset_points(const CwFillInput *input, CwOffsetPoint **places);
