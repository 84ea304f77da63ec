// SPDX-License-Identifier: AGPL-3.0-or-later
// A closed triangulated boundary that is to be filled with tetrahedra, and its filling: what fill_with_fallback,
// kernel and tetgen_fill take and give.
#pragma once

#include <stdint.h>

#include "pipeline/log.h"
#include "pipeline/status.h"

#include "mesher/common/clip.h"
#include "mesher/common/size_at.h"
#include "mesher/fill/lattice_core.h"

#ifdef __cplusplus
extern "C" {
#endif

// What lies within `reach` (m) of a plane.
typedef struct {
  CwPlane plane;
  double reach;
} CwFillSlab;

// All that the steps of a fill read, given once; 18 fields, of which those from offset_count on may be left 0.
typedef struct {
  int32_t point_count;
  const double (*x)[3];
  int32_t triangle_count;
  const int32_t (*triangle)[3]; // closed, normal out of the region
  CwSizeAt size;
  const void *size_context;
  const char *name; // for messages: "rotor region 3"
  CwLog *log;       // how the fill went; NULL: nowhere
  // The last `offset_count` triangles have offset points over them (offset_points.h), of which those over the last
  // `interface_count` are chosen first. The last `open_count` keep points of the lattice out by the distance alone, not
  // by their spheres: the caller sees to these. `inner` where given: the inner points, which are else those of
  // cw_fill_points. `inner_site`, where given too: their places in the lattice.
  int32_t offset_count, interface_count, open_count, inner_count;
  // From `bare_first` on, so many triangles have no cells behind them either: faces of the whole mesh's boundary.
  int32_t bare_first, bare_count;
  const double (*inner)[3];
  const CwLatticeSite *inner_site;
  // Where cw_fill_points is to give points: in any of these slabs, where there are some; else everywhere.
  int32_t slab_count;
  const CwFillSlab *slab;
} CwFillInput;

// How the boundary was recovered.
typedef struct {
  int32_t missing; // boundary triangles that the Delaunay mesh did not have
  int32_t flips;   // to bring them in
  int32_t tetgen;  // 1: by TetGen, after all; the others then tell of the kernel's try
} CwFillRecovery;

// What the improvement of tetrahedra has changed.
typedef struct {
  int32_t edges_removed, faces_removed, points_moved, points_added, search_tries, patches_changed;
  double least_before, least_after; // least quality, as cw_tet_quality; the limit where none is below
} CwTetChanges;

typedef struct {
  int32_t point_count; // the given points first, in their order
  double (*x)[3];
  int32_t tetrahedron_count;
  int32_t (*tetrahedron)[4]; // (x1 - x0) x (x2 - x0) points towards x3: positive volume
  CwFillRecovery recovery;
} CwFill;

// {0} is an empty one.
void cw_fill_free(CwFill *fill);

#ifdef __cplusplus
}
#endif
