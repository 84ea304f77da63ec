// SPDX-License-Identifier: AGPL-3.0-or-later
// Fills a closed triangulated boundary with tetrahedra by our own Delaunay kernel: boundary and inner points
// at once, then the few boundary triangles that are missing are recovered, the inside is kept and improved.
#pragma once

#include "mesher/fill/fill.h"
#include "mesher/fill/tet_mesh.h"

typedef enum {
  CW_KERNEL_FILLED,
  CW_KERNEL_NOT_RECOVERED // a triangle is not recovered, or bodies that touch along an edge have it missing
} CwKernelOutcome;

// Promises and errors of cw_tetgen_fill. Where the boundary is not recovered *fill is empty but for fill->recovery,
// which tells how far it got. Thread-safe if the size field is. Caller frees *fill.
CwStatus cw_kernel_fill(const CwFillInput *input, CwFill *fill, CwKernelOutcome *outcome);

// The steps of that from a Delaunay mesh on (delaunay.h), which it uses up: its sources below input->point_count are
// the boundary's points, all of them, those from there to source_count inner ones. The input's inner points are not
// read.
CwStatus cw_kernel_finish(const CwFillInput *input, CwTetMesh *mesh, int32_t source_count, CwFill *fill,
                          CwKernelOutcome *outcome);
