// SPDX-License-Identifier: AGPL-3.0-or-later
// The core of the lattice in a fill: its deep points stay out of the Delaunay mesh, what the mesh has in their
// place is taken away, and the core's own tetrahedra come to the finished fill.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/fill/delaunay.h"
#include "mesher/fill/fill.h"

typedef struct {
  int32_t fixed_count;   // points of the boundary and then those of the core's skin, which have to stay
  CwLatticeCore lattice; // its corners: fixed points; deep ones count on from there
  double (*deep)[3];
} CwKernelCore;

// Finds the core among the inner points with these places; with `site` NULL it is empty. *x, *count: all points
// of the mesh, the fixed ones first. Caller frees *x.
CwStatus cw_kernel_core_make(const CwFillInput *input, int32_t inner_count, const double (*inner)[3],
                             const CwLatticeSite *site, CwKernelCore *core, int32_t *count, double (**x)[3]);
// Takes the tetrahedra inside the core's surface out of the Delaunay mesh of those points. Fails (CW_ERR_FAULT)
// where a face of the surface is missing, which exact predicates exclude.
CwStatus cw_kernel_core_carve(const CwKernelCore *core, CwTetMesh *mesh);
// Adds the core to the fill that the mesh has become, whose first points are the fixed ones.
CwStatus cw_kernel_core_append(const CwKernelCore *core, CwFill *fill);
void cw_kernel_core_free(CwKernelCore *core);
