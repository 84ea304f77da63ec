// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/region_faces.h"

#include <stdlib.h>
#include <string.h>

#include "export/cell.h"

// One side of a face: seen from a cell (ref = CW_CELL_FACES * cell + face) or from a boundary face (ref below
// zero: -1 - place, triangles first, then quadrilaterals). The smallest node is known from the bucket; `rest`
// is the loop after it.
typedef struct {
  int32_t rest[3];
  int32_t ref;
} Side;

int cw_face_loop(const int64_t *nodes, int count, int64_t loop[4]) {
  int first = 0;
  for (int i = 1; i < count; ++i)
    if (nodes[i] < nodes[first])
      first = i;
  int64_t next = nodes[(first + 1) % count], last = nodes[(first + count - 1) % count];
  int reversed = last < next;
  for (int i = 0; i < count; ++i)
    loop[i] = nodes[(first + (reversed ? count - i : i)) % count];
  if (count == 3)
    loop[3] = -1;
  return reversed;
}

void cw_region_faces_free(CwRegionFaces *faces) {
  free(faces->across);
  free(faces->triangle_face);
  free(faces->quad_face);
  free(faces->open);
  memset(faces, 0, sizeof *faces);
}

// The nodes of a side; returns 3 or 4.
static int side_nodes(const CwRegionData *data, int32_t ref, int32_t nodes[4]) {
  if (ref >= 0)
    return cw_cell_face(data, ref / CW_CELL_FACES, ref % CW_CELL_FACES, nodes);
  int32_t place = -1 - ref;
  int count = place < data->triangle_count ? 3 : 4;
  memcpy(nodes, count == 3 ? data->triangles[place] : data->quads[place - data->triangle_count],
         (size_t)count * sizeof *nodes);
  return count;
}

static int side_loop(const CwRegionData *data, int32_t ref, int64_t loop[4]) {
  int32_t nodes[4];
  int64_t wide[4];
  int count = side_nodes(data, ref, nodes);
  for (int i = 0; i < count; ++i)
    wide[i] = nodes[i];
  return cw_face_loop(wide, count, loop);
}

static int compare_sides(const void *left, const void *right) {
  const Side *a = left, *b = right;
  for (int i = 0; i < 3; ++i)
    if (a->rest[i] != b->rest[i])
      return a->rest[i] < b->rest[i] ? -1 : 1;
  return (a->ref > b->ref) - (a->ref < b->ref);
}

// Buckets hold a few dozen sides: insertion beats qsort there.
static void sort_sides(Side *sides, int64_t count) {
  if (count > 64) {
    qsort(sides, (size_t)count, sizeof *sides, compare_sides);
    return;
  }
  for (int64_t i = 1; i < count; ++i) {
    Side side = sides[i];
    int64_t j = i;
    for (; j > 0 && compare_sides(&side, &sides[j - 1]) < 0; --j)
      sides[j] = sides[j - 1];
    sides[j] = side;
  }
}

static CwStatus fail_at_face(const CwMesh *mesh, int region, const CwRegionData *data, int32_t ref,
                             const char *what) {
  int32_t nodes[4];
  int count = side_nodes(data, ref, nodes);
  double centre[3] = {0};
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < count; ++i)
      centre[k] += 1e3 * data->points[nodes[i]][k] / count;
  return CW_FAIL(CW_ERR_INPUT, "%s: face at (%.6g, %.6g, %.6g) mm %s", mesh->regions[region].path, centre[0],
                 centre[1], centre[2], what);
}

// Calls for every side of the region: counts it (sides NULL) or puts it into its bucket.
static void for_all_sides(const CwRegionData *data, int64_t *start, Side *sides) {
  int32_t cells = cw_region_cell_count(data), bounds = data->triangle_count + data->quad_count;
  for (int64_t i = -(int64_t)bounds; i < (int64_t)CW_CELL_FACES * cells; ++i) {
    int count;
    if (i >= 0) {
      cw_cell_nodes(data, (int32_t)(i / CW_CELL_FACES), &count);
      if (i % CW_CELL_FACES >= cw_cell_face_count(count))
        continue;
    }
    int64_t loop[4];
    side_loop(data, (int32_t)i, loop);
    if (sides)
      sides[start[loop[0]]++] = (Side){{(int32_t)loop[1], (int32_t)loop[2], (int32_t)loop[3]}, (int32_t)i};
    else
      ++start[loop[0] + 1];
  }
}

static CwStatus take_boundary_face(const CwMesh *mesh, int region, const CwRegionData *data, int32_t bound,
                                   int32_t cell_face, CwRegionFaces *faces) {
  CwStatus status = CW_OK;
  int64_t loop[4];
  int32_t place = -1 - bound;
  int is_quad = place >= data->triangle_count;
  if (is_quad)
    place -= data->triangle_count;
  int32_t said = is_quad ? data->quad_cell[place] : data->triangle_cell[place];
  if (side_loop(data, bound, loop) != side_loop(data, cell_face, loop))
    CW_TRY(fail_at_face(mesh, region, data, bound, "on a patch has its normal into the domain"));
  if (said != cell_face / CW_CELL_FACES)
    CW_TRY(fail_at_face(mesh, region, data, bound, "on a patch names a cell it does not belong to"));
  faces->across[cell_face] = CW_ACROSS_PATCH;
  (is_quad ? faces->quad_face : faces->triangle_face)[place] = cell_face;
done:
  return status;
}

// The sides first, first+1, ... (at most `count`) of one face.
static CwStatus take_face(const CwMesh *mesh, int region, const CwRegionData *data, const Side *side,
                          int64_t count, CwRegionFaces *faces) {
  CwStatus status = CW_OK;
  int64_t loop[4];
  if (count > 2)
    CW_TRY(
        fail_at_face(mesh, region, data, side[0].ref, "is shared by more than two cells or boundary faces"));
  if (count == 2 && side[1].ref < 0)
    CW_TRY(fail_at_face(mesh, region, data, side[0].ref, "is listed twice as a boundary face"));
  if (count == 1 && side[0].ref < 0)
    CW_TRY(fail_at_face(mesh, region, data, side[0].ref, "on a patch is not the face of any cell"));
  if (count == 2 && side[0].ref < 0) {
    CW_TRY(take_boundary_face(mesh, region, data, side[0].ref, side[1].ref, faces));
  } else if (count == 2) {
    if (side_loop(data, side[0].ref, loop) == side_loop(data, side[1].ref, loop))
      CW_TRY(fail_at_face(mesh, region, data, side[0].ref, "has both of its cells on the same side"));
    faces->across[side[0].ref] = side[1].ref / CW_CELL_FACES;
    faces->across[side[1].ref] = side[0].ref / CW_CELL_FACES;
    ++*(side[0].rest[2] < 0 ? &faces->inner_triangles : &faces->inner_quads);
  } else {
    int32_t nodes[4];
    int n = side_nodes(data, side[0].ref, nodes);
    for (int i = 0; i < n; ++i)
      if (nodes[i] >= data->shared_count)
        CW_TRY(fail_at_face(mesh, region, data, side[0].ref,
                            "has one cell only and lies neither on a patch nor on a dividing plane"));
    faces->across[side[0].ref] = CW_ACROSS_OPEN;
    ++faces->open_count;
  }
done:
  return status;
}

static CwStatus list_open_faces(int region, const CwRegionData *data, CwRegionFaces *faces) {
  CwStatus status = CW_OK;
  int32_t slot = 0, cells = cw_region_cell_count(data);
  CW_NEW(faces->open, faces->open_count);
  for (int32_t cell = 0; cell < cells; ++cell)
    for (int f = 0; f < CW_CELL_FACES; ++f) {
      if (faces->across[CW_CELL_FACES * cell + f] != CW_ACROSS_OPEN)
        continue;
      int32_t nodes[4];
      int64_t wide[4];
      int n = cw_cell_face(data, cell, f, nodes);
      for (int i = 0; i < n; ++i)
        wide[i] = data->shared_id[nodes[i]];
      CwOpenFace *open = &faces->open[slot];
      open->reversed = cw_face_loop(wide, n, open->loop);
      open->region = region;
      open->cell = cell;
      open->slot = slot++;
    }
done:
  return status;
}

CwStatus cw_region_faces(const CwMesh *mesh, int region, const CwRegionData *data, CwRegionFaces *faces) {
  CwStatus status = CW_OK;
  int64_t *start = NULL;
  Side *sides = NULL;
  int64_t cell_faces = (int64_t)CW_CELL_FACES * cw_region_cell_count(data);
  CW_REQUIRE(cell_faces <= INT32_MAX, CW_ERR_INPUT, "%s: %d cells; a region may have %d",
             mesh->regions[region].path, cw_region_cell_count(data), INT32_MAX / CW_CELL_FACES);
  CW_NEW(faces->across, cell_faces);
  CW_NEW(faces->triangle_face, data->triangle_count);
  CW_NEW(faces->quad_face, data->quad_count);
  for (int64_t i = 0; i < cell_faces; ++i)
    faces->across[i] = CW_ACROSS_NO_FACE;

  // A counting sort by smallest node, then a small sort within each bucket.
  CW_NEW(start, (size_t)data->point_count + 2);
  for_all_sides(data, start, NULL);
  for (int32_t p = 0; p < data->point_count; ++p)
    start[p + 1] += start[p];
  CW_NEW(sides, start[data->point_count]);
  for_all_sides(data, start, sides); // leaves start[p] at the end of bucket p
  for (int64_t first = 0, p = 0; p < data->point_count; first = start[p++]) {
    sort_sides(sides + first, start[p] - first);
    for (int64_t i = first, j; i < start[p]; i = j) {
      for (j = i + 1; j < start[p] && memcmp(sides[i].rest, sides[j].rest, sizeof sides[i].rest) == 0;)
        ++j;
      CW_TRY(take_face(mesh, region, data, sides + i, j - i, faces));
    }
  }
  CW_TRY(list_open_faces(region, data, faces));
done:
  free(start);
  free(sides);
  return status;
}
