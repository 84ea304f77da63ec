// SPDX-License-Identifier: AGPL-3.0-or-later
// Which part of space lies inside the domain: lines along x, one in each square of a lattice over y and z,
// cut by the background triangulation. Each line has its own place in its square, from a low-discrepancy
// sequence: a lattice of lines would count a thin passage by whole lines, up to a third off; these average
// out.
#pragma once

#include <stdint.h>

#include "mesher/cad/background.h"
#include "pipeline/status.h"

typedef struct {
  double low[2];    // y, z of the lattice's corner
  double spacing;   // a line stands for an area spacing^2
  int32_t count[2]; // squares along y and z; line (j, k) is j + count[0] * k
  int32_t variant;  // of the sequence
  int64_t *start;   // of each line in crossing; one more at the end
  double *crossing; // x, ascending in a line; inside between the first and second, the third and fourth, ...
} CwScanlines;

// Lines over y, z from low to high. Fails with CW_ERR_GEOMETRY where the triangulation is not closed.
CwStatus cw_scanlines_make(const CwBackground *background, const double low[2], const double high[2], double spacing,
                           CwScanlines *lines);
// y, z of line (j, k).
void cw_scanlines_place(const CwScanlines *lines, int32_t j, int32_t k, double place[2]);
void cw_scanlines_free(CwScanlines *lines);
