// SPDX-License-Identifier: AGPL-3.0-or-later
// The parts of the picture that turns: which patches they are, their points and their shares of the scales.
#include "pipeline/report/view.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/unit_test.h"

// A rotor with a wall, an interface and a cover; a stator with a wall and an outlet. Patches are counted by domain.
enum { HUB, RIM, SHROUD, CASING, OUTLET, PATCHES };
static CwModelPatch patches[PATCHES] = {
    [HUB] = {.name = "hub", .kind = CW_PATCH_WALL},
    [RIM] = {.name = "rotor_interface", .kind = CW_PATCH_INTERFACE},
    [SHROUD] = {.name = "shroud", .kind = CW_PATCH_WALL},
    [CASING] = {.name = "casing", .kind = CW_PATCH_WALL, .domain = 1},
    [OUTLET] = {.name = "outlet", .kind = CW_PATCH_OUTLET, .domain = 1},
};
static const CwMesh mesh = {.domain_count = 2,
                            .domains = {{.name = "rotor", .rotating = 1, .patch_count = 3},
                                        {.name = "stator", .first_patch = CASING, .patch_count = 2}},
                            .patch_count = PATCHES,
                            .patches = patches};

// Two quadrilaterals beside one another and a triangle behind them.
static double x[][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}, {3, 0.5, 0}};
static int32_t quads[][4] = {{0, 1, 2, 3}, {1, 4, 5, 2}}, triangles[][3] = {{4, 6, 5}};

static CwRegionData faces_on(int domain, int32_t *triangle_patch, int32_t *quad_patch) {
  return (CwRegionData){.domain = domain,
                        .points = x,
                        .point_count = 7,
                        .triangle_count = 1,
                        .quad_count = 2,
                        .triangles = triangles,
                        .quads = quads,
                        .triangle_patch = triangle_patch,
                        .quad_patch = quad_patch};
}

static double area_of(const CwViewPart *part) {
  double area = 0;
  for (int32_t t = 0; t < part->triangle_count; t++) {
    const double *a = part->points[part->corners[t][0]], *b = part->points[part->corners[t][1]],
                 *c = part->points[part->corners[t][2]];
    area += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  }
  return area;
}

// Each patch that is no interface has its faces, as triangles with points of their own, turned as they came.
static void patches_are_parts(void **state) {
  int32_t on_hub[] = {0, 0}, on_rim[] = {1}, on_outlet[] = {1}, on_casing[] = {0, 0};
  CwRegionData rotor = faces_on(0, on_rim, on_hub), stator = faces_on(1, on_outlet, on_casing);
  static const int of[] = {HUB, SHROUD, CASING, OUTLET}, triangle_count[] = {4, 0, 4, 1}, point_count[] = {6, 0, 6, 3};
  static const double area[] = {2, 0, 2, 0.5};
  CwView view = {0};
  assert_int_equal(cw_view_start(&mesh, 3, &view), CW_OK);
  assert_int_equal(cw_view_add(&view, &mesh, &rotor, (double *[CW_VIEW_QUANTITIES]){NULL}), CW_OK);
  assert_int_equal(cw_view_add(&view, &mesh, &stator, (double *[CW_VIEW_QUANTITIES]){NULL}), CW_OK);
  assert_int_equal(cw_view_finish(&view, &mesh), CW_OK);
  assert_int_equal(view.part_count, 4);
  assert_false(view.decimated);
  for (int k = 0; k < 4; k++) {
    const CwViewPart *part = &view.part[k];
    assert_int_equal(part->patch, of[k]);
    assert_int_equal(part->triangle_count, triangle_count[k]);
    assert_int_equal(part->point_count, point_count[k]);
    assert_near(area_of(part), area[k], 1e-9);
    for (int q = 0; q < CW_VIEW_QUANTITIES; q++) assert_null(part->values[q]);
    for (int32_t p = 0; p < part->point_count; p++) {
      int known = 0;
      for (int i = 0; i < 7; i++)
        known += fabs(part->points[p][0] - x[i][0]) + fabs(part->points[p][1] - x[i][1]) < 1e-9;
      assert_int_equal(known, 1);
    }
  }
  cw_view_free(&view);
  assert_null(view.part);
}

// The value at a place of a part.
static int value_at(const CwViewPart *part, int quantity, double at_x, double at_y) {
  for (int32_t p = 0; p < part->point_count; p++)
    if (fabs(part->points[p][0] - at_x) + fabs(part->points[p][1] - at_y) < 1e-9) return part->values[quantity][p];
  fail_msg("no point at %g, %g", at_x, at_y);
  return -1;
}

// Points have the mean of the faces about them, by area, as 255ths of the scale; what is beyond its ends has the colour
// of the end. A part without a value at one of its points has none.
static void shares_are_bytes(void **state) {
  int32_t on_casing[] = {0, 0}, on_hub[] = {0, 0}, on_outlet[] = {1}, on_shroud[] = {2};
  CwRegionData stator = faces_on(1, on_outlet, on_casing), rotor = faces_on(0, on_shroud, on_hub);
  double first[] = {0.5, 0.2, 0.6}, second[] = {NAN, -3, NAN}, beyond[] = {7, -2, 3};
  CwView view = {0};
  assert_int_equal(cw_view_start(&mesh, 3, &view), CW_OK);
  assert_int_equal(cw_view_add(&view, &mesh, &stator, (double *[CW_VIEW_QUANTITIES]){first, second}), CW_OK);
  assert_int_equal(cw_view_add(&view, &mesh, &rotor, (double *[CW_VIEW_QUANTITIES]){NULL, beyond}), CW_OK);
  assert_int_equal(cw_view_finish(&view, &mesh), CW_OK);
  const CwViewPart *hub = &view.part[0], *shroud = &view.part[1], *casing = &view.part[2], *outlet = &view.part[3];
  assert_int_equal(casing->patch, CASING);
  assert_non_null(casing->values[0]);
  assert_int_equal(value_at(casing, 0, 0, 0), 51); // 0.2
  // Of three triangles one is of the first quadrilateral, or two: (0.2 + 2 0.6) / 3 and (2 0.2 + 0.6) / 3.
  assert_int_equal(value_at(casing, 0, 1, 0), 119);
  assert_int_equal(value_at(casing, 0, 1, 1), 85);
  assert_int_equal(value_at(outlet, 0, 3, 0.5), 128); // 0.5 is 127.5, rounded up
  assert_null(casing->values[1]);
  assert_null(outlet->values[1]);
  assert_null(hub->values[0]);
  assert_null(shroud->values[0]);
  assert_int_equal(value_at(hub, 1, 0, 0), 0);
  assert_int_equal(value_at(shroud, 1, 3, 0.5), 255);
  cw_view_free(&view);
}

// Sheets of `side` by `side` squares of two triangles, wavy, so that they cannot be told by fewer.
static void add_sheet(CwView *view, int domain, int side) {
  const int points = (side + 1) * (side + 1), count = side * side;
  CwRegionData sheet = {.domain = domain, .point_count = points, .quad_count = count};
  sheet.points = malloc((size_t)points * sizeof *sheet.points);
  sheet.quads = malloc((size_t)count * sizeof *sheet.quads);
  sheet.quad_patch = calloc((size_t)count, sizeof *sheet.quad_patch);
  assert_true(sheet.points && sheet.quads && sheet.quad_patch);
  for (int j = 0; j <= side; j++)
    for (int i = 0; i <= side; i++) {
      const double u = (double)i / side, v = (double)j / side;
      memcpy(sheet.points[j * (side + 1) + i], (double[]){u, v, 0.01 * sin(40 * u) * sin(40 * v)},
             sizeof *sheet.points);
    }
  for (int j = 0, q = 0; j < side; j++)
    for (int i = 0; i < side; i++, q++) {
      const int at = j * (side + 1) + i;
      memcpy(sheet.quads[q], (int32_t[]){at, at + 1, at + side + 2, at + side + 1}, sizeof *sheet.quads);
    }
  assert_int_equal(cw_view_add(view, &mesh, &sheet, (double *[CW_VIEW_QUANTITIES]){NULL}), CW_OK);
  free(sheet.points);
  free(sheet.quads);
  free(sheet.quad_patch);
}

// 80000 triangles are kept of what turns, 60000 of what stands still: 67712 fit there and not here.
static void large_surfaces_are_decimated(void **state) {
  enum { SIDE = 184, ALL = 2 * SIDE * SIDE };
  for (int domain = 0; domain < 2; domain++) {
    CwView view = {0};
    int32_t made = 0;
    assert_int_equal(cw_view_start(&mesh, 1, &view), CW_OK);
    add_sheet(&view, domain, SIDE);
    assert_int_equal(cw_view_finish(&view, &mesh), CW_OK);
    for (int k = 0; k < view.part_count; k++) made += view.part[k].triangle_count;
    assert_int_equal(view.decimated, domain);
    if (domain == 0) assert_int_equal(made, ALL);
    if (domain == 1) assert_in_range(made, 10000, 60000);
    cw_view_free(&view);
  }
}

// Of the rotor what the page's first picture hides, and inlets and outlets, are not to be seen at first.
static void covers_are_taken_off_at_first(void **state) {
  static const int shown[PATCHES] = {[HUB] = 1, [CASING] = 1};
  for (int p = 0; p < PATCHES; p++) {
    const CwViewPart part = {.patch = p};
    assert_int_equal(cw_view_shown(&mesh, &part), shown[p]);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(patches_are_parts),
      cmocka_unit_test(shares_are_bytes),
      cmocka_unit_test(large_surfaces_are_decimated),
      cmocka_unit_test(covers_are_taken_off_at_first),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
