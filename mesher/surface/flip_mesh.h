// SPDX-License-Identifier: AGPL-3.0-or-later
// Triangles that know their neighbours while edges are flipped.
#pragma once

#include <stdint.h>

#include "mesher/parallel/context.h"
#include "pipeline/status.h"

// near[t][k] lies across the side from corner k to the next, or is -1.
typedef struct {
  int32_t (*triangle)[3], (*near)[3];
} CwFlipMesh;

// Makes `near`, or brings a given one up to date (the caller frees it). Sides that run the same way twice, or that
// three triangles share, have none; nor have those with no vertex of a triangle whose group is not below 0. group: may
// be NULL. Collective.
CwStatus cw_flip_neighbours(const CwContext *context, int32_t point_count, int32_t triangle_count, const int64_t *group,
                            CwFlipMesh *mesh);
// Place of a vertex in triangle t, or -1.
int cw_flip_corner(const CwFlipMesh *mesh, int32_t t, int32_t vertex);
// Whether c, a corner of t, and d share an edge: looks at all triangles around c, from t both ways.
int cw_flip_joined(const CwFlipMesh *mesh, int32_t t, int32_t c, int32_t d);
// Turns side k of t, between t and u: with corners c of t and d of u across from it, t becomes c, d and the end of the
// side, u becomes d, c and its start.
void cw_flip(CwFlipMesh *mesh, int32_t t, int k, int32_t u);
