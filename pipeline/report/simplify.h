// SPDX-License-Identifier: AGPL-3.0-or-later
// A surface of bounded size from any number of triangles, taken one by one: vertex clustering with quadrics (Lindstrom,
// Out-of-core simplification of large polygonal models, SIGGRAPH 2000). Corners in one cube of a lattice become one
// point, where the squared distances from the planes of their triangles are least. The lattice coarsens as the
// triangles come, so that neither their number nor their size need be known. The result does not depend on their order:
// eight cubes become one, and sums are exact (exact_sum.h).
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

typedef struct CwSimplifier CwSimplifier;

// `most`: triangles of the result; `cell`: edge of the first cubes, m: what is finer is lost. Sums are exact as long as
// the surface in a cube is no more than four squares of 8192 such cells. Free with cw_simplify_free. CW_ERR_MEMORY.
CwStatus cw_simplify_start(int64_t most, double cell, CwSimplifier **simplifier);
void cw_simplify_free(CwSimplifier *simplifier);

enum { CW_SIMPLIFY_VALUES = 2 };

// Takes a triangle with its corners, a mark that it keeps, and values (NAN: none; NULL: none at all), of which points
// get the means by area. CW_ERR_MEMORY.
CwStatus cw_simplify_add(CwSimplifier *simplifier, const double *const corner[3], int mark, const double *value);

// Hands triangles to another simplifier, perhaps of another process, that was started alike. [out] bytes: freed by the
// caller. CW_ERR_MEMORY.
CwStatus cw_simplify_pack(const CwSimplifier *simplifier, void **bytes, int64_t *size);
// Takes those that were packed.
CwStatus cw_simplify_absorb(CwSimplifier *simplifier, const void *bytes);

// Whether the lattice has coarsened so far.
int cw_simplify_coarsened(const CwSimplifier *simplifier);

typedef struct {
  int32_t point_count, triangle_count;
  double (*points)[3], (*values)[CW_SIMPLIFY_VALUES];
  int32_t (*triangles)[3], *mark; // corners as they came
} CwSimpleSurface;

// The result of all triangles so far; no triangle stands twice. Zeroed `surface` on entry; free it with
// cw_simple_surface_free, also after a failure. CW_ERR_MEMORY.
CwStatus cw_simplify_finish(CwSimplifier *simplifier, CwSimpleSurface *surface);
void cw_simple_surface_free(CwSimpleSurface *surface);
