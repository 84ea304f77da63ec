// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "mesher/policy.h"
#include "mesher/region/region_failure.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

// Interfaces of region 0: a triangle in z = 0, one that stands through it, and one far away; of region 1 only the last.
static double x[9][3] = {{0, 0, 0},   {1, 0, 0},    {0, 1, 0},    {0.2, 0.2, -1}, {0.2, 0.2, 1},
                         {3, 3, 0.1}, {10, 10, 10}, {11, 10, 10}, {10, 11, 10}};
static int32_t plane[3][3] = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}, sides[3][2] = {{0, -1}, {0, -1}, {0, 1}};
static int32_t region_start[3] = {0, 0, 0};
static const CwSurfaceMesh no_walls = {.region_start = region_start};
static const CwInterfaces interfaces = {.nodes = {.count = 9, .x = x}, .refined = {3, plane, sides}};
static const CwLayers no_layers;
static const CwBoundaryInput in;
static const CwRegionInput from = {.in = &in, .surface = &no_walls, .layers = &no_layers, .interfaces = &interfaces};

// Crossings that the file of the boundary tells, in the order of its triangles.
static void expect_crossings(const char *path, int count, const int *wanted) {
  char *text = read_whole(path, NULL), *at = strstr(text, "SCALARS crossing");
  assert_non_null(at);
  at = strchr(strchr(at, '\n') + 1, '\n');
  for (int i = 0; i < count; i++) assert_int_equal(strtol(at, &at, 10), wanted[i]);
  free(text);
  assert_int_equal(unlink(path), 0);
}

static void the_first_crossing_is_the_place(void **state) {
  static const int crossings[] = {1, 1, 0};
  const char *path = in_test_folder("boundary.vtk");
  const CwOutcome why = {.kind = CW_OUTCOME_THIN, .reason = "no room"};
  CwRegionFailure failure;
  assert_int_equal(cw_region_failure_examine(&from, 0, &why, path, &failure), CW_OK);
  assert_int_equal(failure.failed, 1);
  assert_int_equal(failure.everywhere, 0);
  assert_string_equal(failure.patch, "partition plane");
  assert_string_equal(failure.message, "no room");
  // The middle of either triangle.
  const double middle[2][3] = {{1.0 / 3, 1.0 / 3, 0}, {3.4 / 3, 3.4 / 3, 0.1 / 3}};
  const int which = fabs(failure.at[0] - middle[0][0]) > 0.1;
  for (int k = 0; k < 3; k++) assert_near(failure.at[k], middle[which][k], 1e-15);
  expect_crossings(path, 3, crossings);
}

// A place that is told counts, whatever crosses; where none is told and nothing crosses it may be anywhere.
static void a_place_that_is_told_counts(void **state) {
  static const int crossings[] = {1, 1, 0};
  const char *path = in_test_folder("boundary.vtk");
  CwOutcome why = {.kind = CW_OUTCOME_THIN, .places = 1, .place = {{4, 5, 6}}};
  CwRegionFailure failure;
  memset(why.reason, 'a', sizeof why.reason - 1);
  assert_int_equal(cw_region_failure_examine(&from, 0, &why, path, &failure), CW_OK);
  assert_int_equal(failure.everywhere, 0);
  assert_string_equal(failure.patch, "the layers");
  assert_memory_equal(failure.at, why.place[0], sizeof failure.at);
  assert_int_equal(strlen(failure.message), sizeof failure.message - 1); // cut
  expect_crossings(path, 3, crossings);
  why.places = 0;
  assert_int_equal(cw_region_failure_examine(&from, 1, &why, path, &failure), CW_OK);
  assert_int_equal(failure.failed, 1);
  assert_int_equal(failure.everywhere, 1);
  expect_crossings(path, 1, &(int){0});
}

static double size_of(const void *context, const double at[3]) {
  return *(const double *)context * (1 + at[0]);
}

// Two wall triangles of region 0 and one of region 1, which has a vertex of the others.
static void columns_near_the_place_are_thinned(void **state) {
  enum { COLUMNS = 6 };
  static double top[COLUMNS][3] = {{0, 0, 0}, {0.19, 0, 0}, {0, 0.21, 0}, {1, 0, 0}, {1, 0.1, 0}, {1, 0, 0.19}};
  static double thickness[COLUMNS] = {1, 2, 3, 4, 5, 6};
  static int32_t triangle[3][3] = {{0, 1, 2}, {1, 2, 3}, {3, 4, 5}}, region[3] = {0, 0, 1};
  const double h = 0.1, kept = cw_policy.column_kept;
  const CwBoundaryInput sized = {.size_at = size_of, .size = &h};
  const CwSurfaceMesh walls = {.triangle_count = 3, .region = region};
  const CwLayers layers = {.triangle_count = 3, .triangle = triangle, .top = top, .thickness = thickness};
  const CwRegionInput given = {.in = &sized, .surface = &walls, .layers = &layers, .interfaces = &interfaces};
  static const struct {
    CwRegionFailure failure;
    int region;
    double reach;
    int thinned[COLUMNS];
  } wanted[] = {// Within 2 h = 0.2 of the origin; where x is 1, h is twice as much. A place holds across regions.
                {{.failed = 1, .at = {0, 0, 0}}, 0, 2, {1, 1, 0, 0, 0, 0}},
                {{.failed = 1, .at = {0, 0, 0}}, 1, 2, {1, 1, 0, 0, 0, 0}},
                {{.failed = 1, .at = {0, 0, 0}}, 0, 2.2, {1, 1, 1, 0, 0, 0}},
                {{.failed = 1, .at = {1, 0, 0}}, 0, 0.9, {0, 0, 0, 1, 1, 0}},
                {{.failed = 1, .at = {1, 0, 0}}, 0, 1, {0, 0, 0, 1, 1, 1}},
                {{.failed = 1, .everywhere = 1}, 0, 2, {1, 1, 1, 1, 0, 0}},
                {{.failed = 1, .everywhere = 1}, 1, 2, {0, 0, 0, 1, 1, 1}}};
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
    double most[COLUMNS] = {INFINITY, 0.5, INFINITY, INFINITY, INFINITY, INFINITY};
    cw_region_failure_thin(&given, wanted[i].region, &wanted[i].failure, wanted[i].reach, most);
    for (int v = 0; v < COLUMNS; v++) {
      const double bound = v == 1 ? 0.5 : INFINITY; // a lower one stays
      if (wanted[i].thinned[v])
        assert_near(most[v], fmin(bound, kept * thickness[v]), 1e-15);
      else
        assert_true(most[v] == bound);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_first_crossing_is_the_place),
      cmocka_unit_test(a_place_that_is_told_counts),
      cmocka_unit_test(columns_near_the_place_are_thinned),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
