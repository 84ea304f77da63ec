// SPDX-License-Identifier: AGPL-3.0-or-later
// The faces of the mesh in upper-triangular order, for formats that are written by faces: those between two cells
// region by region, by the cell of the lower number and then the other, then those of each patch. A face between
// regions belongs to the region of its lower cell.
#pragma once

#include "export/assembly.h"

// Where the faces of the whole mesh stand; points and cells of all domains together.
typedef struct {
  int64_t points, cells;
  CwFaceCount inner, all;
  CwFaceCount *region; // faces before the inner ones of each region
  CwFaceCount *patch;  // faces before those of each patch
} CwFaceLayout;

CwStatus cw_face_layout_make(const CwAssembly *assembly, CwFaceLayout *layout);
void cw_face_layout_free(CwFaceLayout *layout);

// The faces before those of a region on a patch.
CwFaceCount cw_face_layout_patch(const CwFaceLayout *layout, const CwAssembly *assembly, int region, int patch);

// Faces of a region, so many at once that what is made of them stays in the processor's cache. Nodes are points of the
// region; the normal points out of `cell`.
typedef struct {
  int64_t most;            // faces that there is room for
  int64_t faces, corners;  // in the arrays
  int32_t *cell;           // of the region
  int64_t *across;         // the other cell, as CwRegionPlace.cell counts; -1 on a patch
  int64_t *open;           // on a partition plane: the face's place in CwAssembly.across; else -1
  int8_t *sides;           // 3 or 4
  int32_t *corner;         // of one face after the other
  int64_t next, next_open; // where the next ones begin: a cell or a face of the boundary, and an open face
} CwFaceStretch;

enum { CW_FACES_AT_ONCE = 1 << 12 };

// Room for `most` faces, CW_CELL_FACES at least; freed by cw_face_stretch_free().
CwStatus cw_face_stretch_new(int64_t most, CwFaceStretch *stretch);
void cw_face_stretch_free(CwFaceStretch *stretch);

// The next of the inner faces that belong to the region, or of its faces on a patch. Returns 0 after the last.
int cw_face_stretch_inner(const CwAssembly *assembly, int region, const CwRegionData *data, const CwRegionFaces *faces,
                          CwFaceStretch *stretch);
int cw_face_stretch_patch(const CwAssembly *assembly, int patch, const CwRegionData *data, const CwRegionFaces *faces,
                          CwFaceStretch *stretch);

// Before the faces of another region or patch.
static inline void cw_face_stretch_start(CwFaceStretch *stretch) {
  stretch->next = stretch->next_open = 0;
}
