// SPDX-License-Identifier: AGPL-3.0-or-later
// The part of a body-centred lattice on an octree whose tetrahedra are known without being searched for: where
// cells of one size lie together, clear of the boundary. Each cell has a point at its corners and its centre,
// and the Delaunay tetrahedra are those of two centres beside a face and an edge of that face, 12 a cell.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// A point's place in the lattice, in half edges of the octree's finest cell.
typedef struct {
  uint64_t key;  // 21 bits an axis: y, x, z from the high end
  int32_t level; // of a cell that it is a corner or the centre of; the edge is 2 << level
  int32_t clear; // 1: the boundary has no part in the cell
} CwLatticeSite;

// Points beside the lattice have keys from here on, above those of all places, and are not clear.
#define CW_LATTICE_NO_PLACE ((uint64_t)1 << 63)

static inline uint64_t cw_lattice_key(const int32_t at[3]) { // x, y, z
  return (uint64_t)at[1] << 42 | (uint64_t)at[0] << 21 | (uint64_t)at[2];
}

static inline void cw_lattice_at(uint64_t key, int32_t at[3]) {
  at[0] = (int32_t)(key >> 21 & 0x1fffff);
  at[1] = (int32_t)(key >> 42);
  at[2] = (int32_t)(key & 0x1fffff);
}

enum { CW_LATTICE_SHELL, CW_LATTICE_SKIN, CW_LATTICE_DEEP };

// Deep points are in tetrahedra of the core alone. Each corner of the core's tetrahedra that is not deep is in
// the skin.
typedef struct {
  uint8_t *role; // of each point: CW_LATTICE_...
  int32_t deep_count, skin_count;
  int32_t tet_count;
  int32_t (*tet)[4]; // positive
  int32_t face_count;
  int32_t (*face)[3]; // between the core and the rest, normal out of the core
} CwLatticeCore;

// The core of the lattice that has these points, which ascend by their keys; points beside the lattice lie in no clear
// cell. Every tetrahedron of the core, and of the lattice round each point of its skin, has an empty sphere among all
// points and those of the boundary, with room: it is in each Delaunay mesh of them. The faces of the core's surface are
// therefore in each Delaunay mesh of all points but the deep ones. Holds where points are moved by less than a
// hundredth of their cell, too.
CwStatus cw_lattice_core_make(int32_t count, const CwLatticeSite *site, CwLatticeCore *core);
void cw_lattice_core_free(CwLatticeCore *core);

#ifdef __cplusplus
}
#endif
