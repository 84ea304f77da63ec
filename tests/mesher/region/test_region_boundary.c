// SPDX-License-Identifier: AGPL-3.0-or-later
// Two tetrahedra that share a face, as two regions: each boundary is closed, its parts are of their kinds and sides,
// with the planned interface as with the refined one, and a boundary with a face turned or left out is told.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "mesher/fill/boundary_check.h"
#include "mesher/region/region_boundary.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

enum { NODES = 6, WALLS = 4, OPEN = 2 };

// Nodes 0, 1, 2 of the common face, which is z = 0; apexes 3 (above, region 1) and 4 (below, region 0); node 5 lies in
// the common face, where the rule of region numbers put it.
static double x[NODES][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1}, {0.3, 0.3, -1}, {0.3, 0.3, 0}};
static int32_t wall[WALLS][3] = {{0, 1, 3}, {1, 2, 3}, {1, 0, 4}, {2, 1, 4}}; // normals out
static int32_t region_start[3] = {0, 2, 4}, region_triangle[WALLS] = {2, 3, 0, 1};
static int32_t open_patch[OPEN][3] = {{2, 0, 3}, {0, 2, 4}}, open_face[OPEN] = {7, 8}, open_region[OPEN] = {1, 0};
static int32_t planned[1][3] = {{0, 1, 2}}, planned_region[1][2] = {{0, 1}};
static int32_t refined[3][3] = {{0, 1, 5}, {1, 2, 5}, {2, 0, 5}}, refined_region[3][2] = {{0, 1}, {0, 1}, {0, 1}};

static const CwSurfaceMesh surface = {
    .triangle_count = WALLS, .region_start = region_start, .region_triangle = region_triangle};
static double thickness[NODES] = {1, 1, 1, 1, 1, 1};
static const CwLayers layers = {.triangle_count = WALLS, .triangle = wall, .thickness = thickness};
static const CwInterfaces interfaces = {.nodes = {.count = NODES, .x = x},
                                        .open_patch = {OPEN, open_patch, open_face, open_region},
                                        .refined = {3, refined, refined_region},
                                        .planned = {1, planned, planned_region}};
static const CwBoundaryInput in; // without a size field
static const CwRegionInput from = {.in = &in, .surface = &surface, .layers = &layers, .interfaces = &interfaces};

static CwStatus audit(const CwRegionBoundary *inner, const char *name) {
  const CwFillInput input = cw_region_fill_input(&from, inner, name);
  return cw_boundary_check(&input);
}

static double six_volumes(const CwRegionBoundary *inner) {
  double sum = 0;
  for (int32_t t = 0; t < inner->wall_count + inner->bare_count + inner->open_patch_count + inner->interface_count;
       t++) {
    const double *a = inner->x[inner->triangle[t][0]], *b = inner->x[inner->triangle[t][1]],
                 *c = inner->x[inner->triangle[t][2]];
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum;
}

static void regions_are_closed(void **state) {
  for (int region = 0; region < 2; region++) {
    for (int as_planned = 0; as_planned < 2; as_planned++) {
      CwRegionBoundary inner;
      assert_int_equal(cw_region_boundary_make(&from, region, as_planned, &inner), CW_OK);
      assert_int_equal(inner.wall_count, 2);
      assert_int_equal(inner.open_patch_count, 1);
      assert_int_equal(inner.interface_count, as_planned ? 1 : 3);
      assert_int_equal(inner.node_count, as_planned ? 4 : 5);
      assert_true(fabs(six_volumes(&inner) - 1) < 1e-15); // of both tetrahedra, normals out
      assert_int_equal(audit(&inner, "tetrahedron"), CW_OK);
      for (int32_t i = 0; i < inner.node_count; i++) assert_memory_equal(inner.x[i], x[inner.node[i]], sizeof *x);
      for (int t = 0; t < 2; t++) assert_int_equal(inner.source[t], region_triangle[region_start[region] + t]);
      assert_int_equal(open_region[inner.source[2]], region);
      cw_region_boundary_free(&inner);
    }
  }
}

static void faults_are_told(void **state) {
  CwRegionBoundary inner;
  assert_int_equal(cw_region_boundary_make(&from, 0, 1, &inner), CW_OK);
  int32_t *corner = inner.triangle[3], first = corner[0];
  corner[0] = corner[1];
  corner[1] = first;
  assert_int_equal(audit(&inner, "turned"), CW_ERR_MESH);
  corner[1] = corner[0];
  corner[0] = first;
  assert_int_equal(audit(&inner, "as made"), CW_OK);
  inner.interface_count = 0;
  assert_int_equal(audit(&inner, "open"), CW_ERR_MESH);
  cw_region_boundary_free(&inner);
}

// Numbers after a line that begins with `word`.
static void expect(const char *path, const char *word, int count, const int *wanted) {
  FILE *file = fopen(path, "r");
  char line[200];
  assert_non_null(file);
  while (fgets(line, sizeof line, file) && strncmp(line, word, strlen(word)) != 0) continue;
  assert_non_null(fgets(line, sizeof line, file)); // the lookup table
  for (int i = 0, value; i < count; i++) {
    assert_int_equal(fscanf(file, "%d", &value), 1);
    assert_int_equal(value, wanted[i]);
  }
  fclose(file);
}

static void pictures_name_the_kinds(void **state) {
  CwRegionBoundary inner;
  const char *path = in_test_folder("boundary.vtk");
  const int kinds[4] = {0, 0, 1, 2}, crossings[4] = {0, 1, 0, 1};
  assert_int_equal(cw_region_boundary_make(&from, 0, 1, &inner), CW_OK);
  assert_int_equal(cw_region_boundary_vtk(&inner, crossings, "a tetrahedron", path), CW_OK);
  expect(path, "SCALARS surface", 4, kinds);
  expect(path, "SCALARS crossing", 4, crossings);
  remove(path);
  cw_region_boundary_free(&inner);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(regions_are_closed),
      cmocka_unit_test(faults_are_told),
      cmocka_unit_test(pictures_name_the_kinds),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
