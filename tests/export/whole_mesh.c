// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tests/export/whole_mesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/mesh/cell.h"
#include "tests/export/synthetic_run.h"

static int compare_points(const void *left, const void *right) {
  const WholePoint *a = left, *b = right;
  if (a->domain != b->domain) return a->domain - b->domain;
  for (int k = 0; k < 3; ++k)
    if (a->x[k] != b->x[k]) return a->x[k] < b->x[k] ? -1 : 1;
  return 0;
}

static int compare_faces(const void *left, const void *right) {
  const WholeFace *a = left, *b = right;
  for (int k = 0; k < 4; ++k)
    if (a->corner[k] != b->corner[k]) return a->corner[k] < b->corner[k] ? -1 : 1;
  return a->region != b->region ? a->region - b->region : (a->slot > b->slot) - (a->slot < b->slot);
}

static int compare_numbers(const void *left, const void *right) {
  const int64_t a = *(const int64_t *)left, b = *(const int64_t *)right;
  return (a > b) - (a < b);
}

static WholePoint point_of(const CwRegionData *region, int32_t node) {
  WholePoint point = {.domain = region->domain};
  for (int k = 0; k < 3; ++k) point.x[k] = region->points[node][k] + 0.0; // -0 is 0
  return point;
}

int64_t whole_mesh_point(const WholeMesh *whole, int region, int32_t node) {
  const WholePoint wanted = point_of(&whole->regions[region], node);
  const WholePoint *found = bsearch(&wanted, whole->points, (size_t)whole->point_count, sizeof wanted, compare_points);
  assert_non_null(found);
  return found - whole->points;
}

static void list_points(WholeMesh *whole) {
  int64_t count = 0;
  for (int r = 0; r < whole->mesh.region_count; ++r) count += whole->regions[r].point_count;
  whole->points = calloc((size_t)count, sizeof *whole->points);
  assert_non_null(whole->points);
  count = 0;
  for (int r = 0; r < whole->mesh.region_count; ++r)
    for (int32_t p = 0; p < whole->regions[r].point_count; ++p)
      whole->points[count++] = point_of(&whole->regions[r], p);
  qsort(whole->points, (size_t)count, sizeof *whole->points, compare_points);
  for (int64_t p = 0; p < count; ++p)
    if (p == 0 || compare_points(&whole->points[p], &whole->points[whole->point_count - 1]) != 0)
      whole->points[whole->point_count++] = whole->points[p];
}

static void list_faces(WholeMesh *whole) {
  int64_t cells = 0;
  for (int r = 0; r < whole->mesh.region_count; ++r) cells += cw_region_cell_count(&whole->regions[r]);
  whole->faces = calloc((size_t)(CW_CELL_FACES * cells), sizeof *whole->faces);
  assert_non_null(whole->faces);
  for (int r = 0; r < whole->mesh.region_count; ++r) {
    int32_t slot = 0;
    for (int32_t c = 0; c < cw_region_cell_count(&whole->regions[r]); ++c) {
      int corners;
      cw_cell_nodes(&whole->regions[r], c, &corners);
      for (int f = 0; f < (corners == 4 ? 4 : 5); ++f) {
        int32_t nodes[4];
        WholeFace *face = &whole->faces[whole->face_count++];
        *face = (WholeFace){.corner = {-1, -1, -1, -1}, .region = r, .cell = c, .slot = slot++};
        const int count = cw_cell_face(&whole->regions[r], c, f, nodes);
        for (int k = 0; k < count; ++k) face->corner[k] = whole_mesh_point(whole, r, nodes[k]);
        qsort(face->corner, (size_t)count, sizeof *face->corner, compare_numbers);
      }
    }
  }
  qsort(whole->faces, (size_t)whole->face_count, sizeof *whole->faces, compare_faces);
}

void whole_mesh_read(const char *run, WholeMesh *whole) {
  memset(whole, 0, sizeof *whole);
  if (cw_mesh_manifest_read(run, &whole->mesh) != CW_OK) fail_msg("%s", cw_fail_message());
  whole->regions = calloc((size_t)whole->mesh.region_count, sizeof *whole->regions);
  assert_non_null(whole->regions);
  for (int r = 0; r < whole->mesh.region_count; ++r)
    if (cw_mesh_region_read(&whole->mesh, r, CW_REGION_WHOLE, &whole->regions[r]) != CW_OK)
      fail_msg("%s", cw_fail_message());
  list_points(whole);
  list_faces(whole);
}

int whole_mesh_make(const char *run, const CwRanks *ranks, WholeMesh *whole, CwAssembly *assembly) {
  const SyntheticPump pump = synthetic_pump_of_all_cells();
  if (synthetic_run_write(run, &pump)) return -1;
  whole_mesh_read(run, whole);
  if (cw_assembly_make(&whole->mesh, ranks, assembly) == CW_OK) return 0;
  fprintf(stderr, "%s\n", cw_fail_message());
  return -1;
}

void whole_mesh_free(WholeMesh *whole) {
  for (int r = 0; r < whole->mesh.region_count; ++r) cw_mesh_region_free(&whole->regions[r]);
  free(whole->regions);
  free(whole->points);
  free(whole->faces);
  cw_mesh_free(&whole->mesh);
}
