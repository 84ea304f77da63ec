// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/region_faces.h"

#include <stdlib.h>
#include <string.h>

#include "export/cell.h"

// One side of a face: seen from a cell (ref = CW_CELL_FACES * cell + face) or from a boundary face (ref below
// zero: -1 - place, triangles first, then quadrilaterals). The smallest node is known from the bucket; `key`
// holds its two neighbours, the smaller one first, and in the lowest bit whether the side runs to the larger
// one first; `opposite` is the fourth node, -1 in a triangle.
typedef struct {
  uint64_t key;
  int32_t opposite, ref;
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

// The smallest node of a side; what else is to be known of it in `side`.
static inline int32_t side_make(const int32_t *nodes, int count, int32_t ref, Side *side) {
  int first = nodes[1] < nodes[0];
  if (nodes[2] < nodes[first])
    first = 2;
  if (count == 4 && nodes[3] < nodes[first])
    first = 3;
  uint32_t next = (uint32_t)nodes[first + 1 == count ? 0 : first + 1];
  uint32_t last = (uint32_t)nodes[first == 0 ? count - 1 : first - 1];
  int reversed = last < next;
  side->key = ((uint64_t)(reversed ? last : next) << 31 | (reversed ? next : last)) << 1 | (unsigned)reversed;
  side->opposite = count == 4 ? nodes[first ^ 2] : -1;
  side->ref = ref;
  return nodes[first];
}

static inline int same_face(const Side *a, const Side *b) {
  return a->key >> 1 == b->key >> 1 && a->opposite == b->opposite;
}

static inline int side_before(const Side *a, const Side *b) {
  if (a->key >> 1 != b->key >> 1)
    return a->key < b->key;
  return a->opposite != b->opposite ? a->opposite < b->opposite : a->ref < b->ref;
}

static int compare_sides(const void *left, const void *right) {
  return side_before(left, right) ? -1 : side_before(right, left);
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
    for (; j > 0 && side_before(&side, &sides[j - 1]); --j)
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

// Counts a side (sides NULL) or puts it into its bucket.
static inline void add_side(const int32_t *nodes, int count, int32_t ref, int64_t *start, Side *sides) {
  Side side;
  int32_t least = side_make(nodes, count, ref, &side);
  if (sides)
    sides[start[least]++] = side;
  else
    ++start[least + 1];
}

// Every side of the region, in the order of their refs but for the boundary faces.
static void for_all_sides(const CwRegionData *data, int64_t *start, Side *sides) {
  int32_t cells = cw_region_cell_count(data);
  for (int32_t i = 0; i < data->triangle_count; ++i)
    add_side(data->triangles[i], 3, -1 - i, start, sides);
  for (int32_t i = 0; i < data->quad_count; ++i)
    add_side(data->quads[i], 4, -1 - data->triangle_count - i, start, sides);
  for (int32_t cell = 0; cell < cells; ++cell) {
    int corners;
    const int32_t *of_cell = cw_cell_nodes(data, cell, &corners);
    const signed char(*face)[4] = cw_cell_face_table(corners);
    for (int f = 0; f < cw_cell_face_count(corners); ++f) {
      int count = face[f][3] < 0 ? 3 : 4;
      const int32_t nodes[4] = {of_cell[face[f][0]], of_cell[face[f][1]], of_cell[face[f][2]],
                                of_cell[face[f][count - 1]]};
      add_side(nodes, count, CW_CELL_FACES * cell + f, start, sides);
    }
  }
}

static CwStatus take_boundary_face(const CwMesh *mesh, int region, const CwRegionData *data,
                                   const Side side[2], CwRegionFaces *faces) {
  CwStatus status = CW_OK;
  int32_t bound = side[0].ref, cell_face = side[1].ref, place = -1 - bound;
  int is_quad = place >= data->triangle_count;
  if (is_quad)
    place -= data->triangle_count;
  int32_t said = is_quad ? data->quad_cell[place] : data->triangle_cell[place];
  if (side[0].key != side[1].key)
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
  if (count > 2)
    CW_TRY(
        fail_at_face(mesh, region, data, side[0].ref, "is shared by more than two cells or boundary faces"));
  if (count == 2 && side[1].ref < 0)
    CW_TRY(fail_at_face(mesh, region, data, side[0].ref, "is listed twice as a boundary face"));
  if (count == 1 && side[0].ref < 0)
    CW_TRY(fail_at_face(mesh, region, data, side[0].ref, "on a patch is not the face of any cell"));
  if (count == 2 && side[0].ref < 0) {
    CW_TRY(take_boundary_face(mesh, region, data, side, faces));
  } else if (count == 2) {
    if (side[0].key == side[1].key)
      CW_TRY(fail_at_face(mesh, region, data, side[0].ref, "has both of its cells on the same side"));
    faces->across[side[0].ref] = side[1].ref / CW_CELL_FACES;
    faces->across[side[1].ref] = side[0].ref / CW_CELL_FACES;
    ++*(side[0].opposite < 0 ? &faces->inner_triangles : &faces->inner_quads);
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
      for (j = i + 1; j < start[p] && same_face(&sides[i], &sides[j]);)
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
