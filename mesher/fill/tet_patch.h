// SPDX-License-Identifier: AGPL-3.0-or-later
// A few hundred tetrahedra of a mesh by themselves, to be changed at leisure and put back.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/fill/delaunay.h"

// Points of the patch that may move have source 1, those on its hull and those of the boundary source 0.
typedef struct {
  CwTetMesh mesh;
  int32_t tet_count, *tet;     // of the whole mesh, as they were taken: nearest first
  int32_t point_count, *point; // of the whole mesh: the patch's first ones; those after them are new
} CwTetPatch;

// Up to `count` tetrahedra round t, by steps over faces. Points of the whole mesh with a source below `fixed_count`
// stay.
CwStatus cw_tet_patch_take(const CwTetMesh *whole, int32_t t, int32_t count, int32_t fixed_count, CwTetPatch *patch);
// Puts patch->mesh, which has the hull it was taken with, in its old place. New points have sources from *source_count
// on, which is counted up. (*place)[k] is where tetrahedron k of the patch is now, -1 for its free places; the caller
// frees it.
CwStatus cw_tet_patch_put(const CwTetPatch *patch, CwTetMesh *whole, int32_t *source_count, int32_t **place);
void cw_tet_patch_free(CwTetPatch *patch);

// Overwrites *to, whose memory is used again.
CwStatus cw_tet_patch_copy_mesh(const CwTetMesh *from, CwTetMesh *to);
