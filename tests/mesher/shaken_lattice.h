// SPDX-License-Identifier: AGPL-3.0-or-later
// Points of a body-centred lattice, shaken and connected, for tests of what improves tetrahedra.
#pragma once

#include <stdint.h>
#include <stdlib.h>

#include "mesher/fill/delaunay.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

// A body-centred lattice of n cubes along each edge, shaken by so much of a cube, those on the outside first, and its
// Delaunay mesh; the caller frees both. Returns how many points there are.
static inline int32_t shaken_lattice(int n, double shake, int32_t *outside, double (**x)[3], CwTetMesh *mesh) {
  uint64_t state = 7;
  *outside = 0;
  int32_t count = 0;
  *x = malloc((size_t)(2 * (n + 1) * (n + 1) * (n + 1)) * sizeof **x);
  for (int pass = 0; pass < 2; pass++) {
    for (int k = 0; k < 2 * (n + 1) * (n + 1) * (n + 1); k++) {
      int m = k / 2, i[3] = {m % (n + 1), m / (n + 1) % (n + 1), m / (n + 1) / (n + 1)}, skin = 0, within = 1;
      for (int a = 0; a < 3; a++) {
        skin |= k % 2 == 0 ? i[a] == 0 || i[a] == n : i[a] == 0 || i[a] == n - 1;
        within &= k % 2 == 0 || i[a] < n;
      }
      if (!within || skin != (pass == 0)) continue;
      for (int a = 0; a < 3; a++) {
        (*x)[count][a] = i[a] + 0.5 * (k % 2) + (skin ? 1e-3 : shake) * (2.0 * draw(&state) - 1.0);
      }
      count++;
    }
    if (pass == 0) *outside = count;
  }
  assert_int_equal(cw_delaunay_make(count, (const double(*)[3])(*x), mesh), CW_OK);
  return count;
}
