// SPDX-License-Identifier: AGPL-3.0-or-later
// Where vertical lines cross a closed triangulated surface: for points of a lattice, of which many stand on
// one line.
#ifndef CUTWATER_MESHER_FILL_FILL_COLUMNS_H
#define CUTWATER_MESHER_FILL_FILL_COLUMNS_H

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/fill/fill.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CwColumns CwColumns;

// Keeps the arrays of the input, which must outlive it.
CwStatus cw_columns_make(const CwFillInput *input, CwColumns **columns);
void cw_columns_free(CwColumns **columns);

// Heights z at which the line at (x, y) crosses the surface, in *z (which belongs to the columns, until the
// next call), in any order. A crossing at an edge or corner counts once: inside lie the points below an odd
// number of crossings.
CwStatus cw_columns_cut(CwColumns *columns, double x, double y, int32_t *count, const double **z);

#ifdef __cplusplus
}
#endif
#endif
