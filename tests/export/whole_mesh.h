// SPDX-License-Identifier: AGPL-3.0-or-later
// A mesh read at once, as a witness of what is found region by region: points are known by their coordinates, faces by
// their points, without the numbers of the mesher.
#pragma once

#include "export/assembly.h"
#include "tests/unit_test.h"

typedef struct {
  int domain;
  double x[3];
} WholePoint;

// A face of a cell by its points, ascending; -1 for the fourth one of a triangle.
typedef struct {
  int64_t corner[4];
  int region;
  int32_t cell, slot; // of the region; slot: among the faces of its cells, in their order
} WholeFace;

typedef struct {
  CwMesh mesh;
  CwRegionData *regions;
  WholePoint *points; // each once, ascending by domain
  WholeFace *faces;   // a face of two cells stands twice, one after the other, that of the lower region first
  int64_t point_count, face_count;
} WholeMesh;

// Reads all regions of `run`; fails the test where that fails. The caller frees it.
void whole_mesh_read(const char *run, WholeMesh *whole);
void whole_mesh_free(WholeMesh *whole);

// Writes a small pump of all kinds of cells into `run`, reads it, and assembles it. Returns 0, or -1.
int whole_mesh_make(const char *run, const CwRanks *ranks, WholeMesh *whole, CwAssembly *assembly);

// The place of a node of a region in the list of points.
int64_t whole_mesh_point(const WholeMesh *whole, int region, int32_t node);

// Whether the face at a place of the list is that of two cells, the next one its other side.
static inline int whole_mesh_is_pair(const WholeMesh *whole, int64_t face) {
  if (face + 1 >= whole->face_count) return 0;
  for (int k = 0; k < 4; ++k)
    if (whole->faces[face].corner[k] != whole->faces[face + 1].corner[k]) return 0;
  return 1;
}

static inline void whole_mesh_count(CwFaceCount *count, const WholeFace *face) {
  ++*(face->corner[3] < 0 ? &count->triangles : &count->quads);
}

static inline void assert_counts_equal(CwFaceCount found, CwFaceCount wanted) {
  assert_int_equal(found.triangles, wanted.triangles);
  assert_int_equal(found.quads, wanted.quads);
}
