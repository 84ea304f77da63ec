// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>

#include "mesher/common/vec.h"
#include "mesher/fill/offset_points.h"
#include "tests/unit_test.h"

static double size_at(const void *context, const double x[3]) {
  return *(const double *)context;
}

// Over an equilateral triangle in the plane z = 0 whose normal, out of the region, is +z.
static CwOffsetPoint place_for(double size, double edge) {
  const double x[3][3] = {{0, 0, 0}, {edge, 0, 0}, {0.5 * edge, edge * sqrt(0.75), 0}};
  const int32_t triangle[1][3] = {{0, 1, 2}};
  CwFillInput input = {.point_count = 3,
                       .x = x,
                       .triangle_count = 1,
                       .triangle = triangle,
                       .size = size_at,
                       .size_context = &size,
                       .offset_count = 1};
  return cw_offset_point(&input, 0);
}

static void stands_inside_over_the_middle(void **unused) {
  CwOffsetPoint place = place_for(2, 2);
  assert_near(place.spacing, 2, 1e-12);
  assert_near(place.x[0], 1, 1e-12);
  assert_near(place.x[1], sqrt(1.0 / 3.0), 1e-12);
  assert_near(place.x[2], -2 * sqrt(2.0 / 3), 1e-12);
}

// The line of the order runs along no axis: it grows with each coordinate, by different amounts.
static void line_runs_along_no_axis(void **unused) {
  double along[4], grown[3];
  for (int k = 0; k < 4; k++) {
    double x[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, size = 1.0;
    const int32_t triangle[1][3] = {{0, 1, 2}};
    for (int i = 0; i < 3 && k > 0; i++) x[i][k - 1] += 1.0;
    CwFillInput input = {.point_count = 3,
                         .x = (const double(*)[3])x,
                         .triangle_count = 1,
                         .triangle = triangle,
                         .size = size_at,
                         .size_context = &size,
                         .offset_count = 1};
    along[k] = cw_offset_point(&input, 0).along;
  }
  for (int k = 0; k < 3; k++) grown[k] = along[k + 1] - along[0];
  for (int k = 0; k < 3; k++) assert_true(grown[k] > 0.1 && fabs(grown[k] - grown[(k + 1) % 3]) > 0.1);
}

// At equal lengths its tetrahedron is regular.
static void makes_a_good_tetrahedron(void **unused) {
  CwOffsetPoint place = place_for(1, 1);
  double side = cw_norm(place.x);
  assert_near(side, 1, 1e-12);
}

static void spacing_is_between_the_wanted_length_and_the_edges(void **unused) {
  assert_near(place_for(1.21, 1).spacing, 1.1, 1e-12);
  assert_near(place_for(1, 1.331).spacing, 1.1, 1e-12); // nearer to the shorter one
  assert_near(place_for(9, 1).spacing, 3, 1e-12);
}

static void last_triangles_are_on_the_interface(void **unused) {
  const double x[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, size = 1.0;
  const int32_t triangle[3][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}};
  CwFillInput input = {.point_count = 3,
                       .x = x,
                       .triangle_count = 3,
                       .triangle = triangle,
                       .size = size_at,
                       .size_context = &size,
                       .offset_count = 3,
                       .interface_count = 2};
  for (int t = 0; t < 3; t++) assert_int_equal(cw_offset_point(&input, t).on_interface, t >= 1);
}

static void order_is_interfaces_first_then_along_a_line_then_by_triangle(void **unused) {
  enum { COUNT = 5 };
  const double x[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, size = 1.0;
  const int32_t triangle[1 + COUNT][3] = {{0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 3, 1}, {1, 2, 0}};
  CwFillInput input = {.point_count = 4,
                       .x = x,
                       .triangle_count = 1 + COUNT,
                       .triangle = triangle,
                       .size = size_at,
                       .size_context = &size,
                       .offset_count = COUNT,
                       .interface_count = 2};
  CwOffsetPoint *place = NULL;
  assert_int_equal(cw_offset_points(&input, &place), CW_OK);
  for (int k = 0; k < COUNT; k++) assert_int_equal(place[k].on_interface, k < 2);
  for (int k = 1; k < COUNT; k++) {
    if (place[k].on_interface != place[k - 1].on_interface) continue;
    assert_true(place[k - 1].along <= place[k].along);
    if (place[k - 1].along == place[k].along) assert_true(place[k - 1].triangle < place[k].triangle);
  }
  assert_true(place[2].along == place[3].along || place[3].along == place[4].along); // the same triangle twice
  free(place);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(stands_inside_over_the_middle),
      cmocka_unit_test(line_runs_along_no_axis),
      cmocka_unit_test(makes_a_good_tetrahedron),
      cmocka_unit_test(last_triangles_are_on_the_interface),
      cmocka_unit_test(order_is_interfaces_first_then_along_a_line_then_by_triangle),
      cmocka_unit_test(spacing_is_between_the_wanted_length_and_the_edges),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
