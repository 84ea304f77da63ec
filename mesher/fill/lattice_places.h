// SPDX-License-Identifier: AGPL-3.0-or-later
// The places of a body-centred cubic lattice on an octree that follows a size field: corners and centres of its cells.
// Its tetrahedra have edges in the ratio 1.155 and dihedral angles of 60 and 90 degrees.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/common/radix.h"
#include "mesher/fill/fill.h"

// Edge of a cell over edge length: 12 tetrahedra a cell, each of the volume of a regular one with edge 1, so
// (12 / (6 sqrt 2))^(1/3) = 2^(1/6).
#define CW_LATTICE_CONSTANT 1.122462048309373

typedef struct {
  double origin[3], unit; // m: corner of the octree, edge of its finest cell
} CwLatticeFrame;

// A cell that is to be cut as fine as the field asks.
typedef struct {
  int32_t at[3], level; // corner, in units; edge: 1 << level units
  int counts;           // 1: its leaves count for the fit of the spacing
} CwLatticeCell;

// Length that the field of the input wants at x, m. Fails (CW_ERR_MESH) where it gives none.
CwStatus cw_lattice_size(const CwFillInput *input, const double x[3], double *size);

// Places in all cells that a slab of the input reaches, by ascending keys (as in CwLatticeSite), each once: `item` is
// the first cell that has it, `tag` the level there. The spacing is fitted so that the cells that count get as many
// leaves as the field asks for, whatever powers of two are near it. Caller frees *place.
CwStatus cw_lattice_places(const CwFillInput *input, const CwLatticeFrame *frame, int32_t cell_count,
                           const CwLatticeCell *cell, int64_t *count, CwRadix **place);

// Where a place is.
void cw_lattice_fixed(const CwLatticeFrame *frame, uint64_t key, double x[3]);
// Where its point is: beside it by up to a thousandth of the cell, by its key alone, since points of
// a lattice lie on common spheres.
void cw_lattice_point(const CwLatticeFrame *frame, const CwRadix *place, double x[3]);
