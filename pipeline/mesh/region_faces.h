// SPDX-License-Identifier: AGPL-3.0-or-later
// The faces of one region: which two cells share each, which lie on a patch, which wait for a neighbour region. For the
// mesher, which audits what it has made, and for the exporter.
#pragma once

#include "pipeline/mesh/region_items.h"

// What lies across a face of a cell, other than a cell of the same region (0 or above).
enum { CW_ACROSS_NO_FACE = -1, CW_ACROSS_PATCH = -2, CW_ACROSS_OPEN = -3 };

typedef struct {
  int32_t *across;        // CW_CELL_FACES entries a cell: the cell of this region across, or a CW_ACROSS_ value
  int32_t *triangle_face; // for each boundary triangle CW_CELL_FACES * cell + face of the cell it lies on
  int32_t *quad_face;     // the same for each boundary quadrilateral
  int32_t open_count;
  int64_t inner_triangles, inner_quads; // faces between two cells of the region
} CwRegionFaces;

// Matches the faces of all cells and boundary faces of a region by their nodes. Fails with the code `fault`, the text
// beginning with `name` and naming cell and place, unless every face is shared by two cells, or is one boundary face
// with its normal outward and the right cell, or has only shared points. Indices are in range. A face of two cells on
// either side, none of them listed as boundary, is told of where all its points are shared alone: elsewhere cells of
// positive volume cannot have it unless the boundary overlaps itself. Time and memory grow linearly with the cells.
CwStatus cw_region_faces(const char *name, CwStatus fault, const CwRegionData *data, CwRegionFaces *faces);
void cw_region_faces_free(CwRegionFaces *faces);

// The open faces alone, each as CW_CELL_FACES * cell + face, ascending, into new memory. Fails alike; where
// `only_shared`, faces of shared points alone are looked at, so that it takes a small part of the time and what others
// have wrong is not seen. Two cells that share a face are shown to `pair`, unless it is NULL.
CwStatus cw_region_open_faces(const char *name, CwStatus fault, const CwRegionData *data, int only_shared,
                              void (*pair)(void *given, int32_t cell, int32_t other), void *given, int32_t **open,
                              int32_t *count);

// The nodes of a face in a form that does not depend on who names it: the smallest first and then towards the smaller
// of its two neighbours; `order` are their places in `nodes`. True where that runs against the order of `nodes`.
int cw_face_loop(const int64_t *nodes, int count, int order[4]);
