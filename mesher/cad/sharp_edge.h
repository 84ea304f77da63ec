// SPDX-License-Identifier: AGPL-3.0-or-later
// The sharpest convex edge of the walls, such as a trailing edge that ends in a knife.
#pragma once

#include "mesher/cad/background.h"
#include "mesher/cad/cad.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  double angle; // through the wall, degrees; 180: no edge is convex
  int face[2];  // CAD faces that meet there
  double at[3]; // a point of it, m
} CwSharpEdge;

// Of all faces that carry layers, as the background has them; the first of equally sharp ones.
CwSharpEdge cw_sharpest_edge(const CwCad *cad, const CwBackground *background);

#ifdef __cplusplus
}
#endif
