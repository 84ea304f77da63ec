// SPDX-License-Identifier: AGPL-3.0-or-later
// Orders of points in which neighbours in memory are neighbours in space: along Hilbert's curve.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

// order[k] is the point that comes k-th. Deterministic.
CwStatus cw_hilbert_order(int32_t count, const double (*x)[3], int32_t *order);

// The same, random enough for incremental insertion: rounds of eight times as many points each, along the curve within
// a round (N. Amenta, S. Choi, G. Rote, Incremental constructions con BRIO, 2003).
CwStatus cw_hilbert_rounds(int32_t count, const double (*x)[3], int32_t *order);

// Place of cell (i, j, k) of a cube with 2^bits cells along each axis on Hilbert's curve; cells next to each
// other on the curve share a face. bits <= 21.
uint64_t cw_hilbert_place(const uint32_t cell[3], int bits);
