// SPDX-License-Identifier: AGPL-3.0-or-later
// The faces of one region: which two cells share each, which lie on a patch, which wait for a neighbour
// region.
#ifndef CUTWATER_EXPORT_REGION_FACES_H
#define CUTWATER_EXPORT_REGION_FACES_H

#include "pipeline/mesh/region_read.h"

// What lies across a face of a cell, other than a cell of the same region (0 or above).
enum { CW_ACROSS_NO_FACE = -1, CW_ACROSS_PATCH = -2, CW_ACROSS_OPEN = -3 };

// A face on a dividing plane. `loop` are the shared numbers of its nodes, the smallest first and then towards
// the smaller neighbour of it, -1 at the end of a triangle; `reversed` if the outward normal runs the other
// way.
typedef struct {
  int64_t loop[4];
  int32_t region; // into CwMesh.regions
  int32_t slot;   // place among the open faces of its region
  int32_t cell;   // of the region
  int32_t reversed;
} CwOpenFace;

typedef struct {
  int32_t *across; // CW_CELL_FACES entries a cell: the cell of this region across, or a CW_ACROSS_ value
  int32_t *triangle_face; // for each boundary triangle CW_CELL_FACES * cell + face of the cell it lies on
  int32_t *quad_face;     // the same for each boundary quadrilateral
  int32_t open_count;
  int64_t inner_triangles, inner_quads; // faces between two cells of the region
} CwRegionFaces;

// Matches the faces of all cells and boundary faces of a region by their nodes. Fails with CW_ERR_INPUT,
// naming region and place, unless every face is shared by two cells, or is one boundary face with its normal
// outward and the right cell, or has only shared points. Time and memory grow linearly with the cells.
CwStatus cw_region_faces(const CwMesh *mesh, int region, const CwRegionData *data, CwRegionFaces *faces);
void cw_region_faces_free(CwRegionFaces *faces);

// The open faces alone, in the order of cell, then face of the cell, into new memory. Only faces of shared points are
// looked at, so that it takes a small part of the time; what cw_region_faces() would find wrong elsewhere is not seen.
CwStatus cw_region_open_faces(const CwMesh *mesh, int region, const CwRegionData *data, CwOpenFace **open,
                              int32_t *count);

// The loop of CwOpenFace for any node numbers; returns `reversed`. `count` is 3 or 4.
int cw_face_loop(const int64_t *nodes, int count, int64_t loop[4]);

#endif
