// SPDX-License-Identifier: AGPL-3.0-or-later
#include <string.h>

#include "mesher/boundary/wall_part.h"
#include "tests/unit_test.h"

static void note(const void *context, int32_t vertex, double x[3]) {
  x[0] = vertex;
}

static double last(const void *context, int32_t vertex, double thickness) {
  return *(const double *)context + 10 * vertex + thickness;
}

// A strip of four triangles over points 0 to 5, of which the last touches what is marked by one corner alone.
static void a_part_of_a_strip(void **state) {
  const double x[6][3] = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  const int32_t triangle[4][3] = {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}}, constraints[6] = {0, 0, 0, 0, 0, 1};
  const double target[6] = {1, 2, 3, 4, 5, 6}, normal[6][2][3] = {[5] = {{0, 1, 0}}};
  const uint8_t stays[6] = {0, 0, 0, 0, 0, 1}, near[6] = {0, 0, 0, 0, 1, 0};
  const CwLayerInput whole = {.point_count = 6,
                              .x = x,
                              .triangle_count = 4,
                              .triangle = triangle,
                              .target = target,
                              .constraint_count = constraints,
                              .constraint_normal = normal,
                              .constraint_stays = stays,
                              .division = {5, last, target},
                              .snap = note};
  CwWallPart part;
  assert_int_equal(cw_wall_part_make(&whole, near, &part), CW_OK);
  assert_int_equal(part.in.triangle_count, 2);
  assert_int_equal(part.in.point_count, 4);
  assert_null(part.in.least);
  assert_int_equal(part.in.division.count, 5);
  for (int t = 0; t < 2; t++) {
    for (int k = 0; k < 3; k++) assert_int_equal(part.global[part.in.triangle[t][k]], triangle[t + 2][k]);
  }
  for (int32_t v = 0; v < 6; v++) {
    int32_t i = part.local[v];
    assert_int_equal(i < 0, v < 2);
    if (i < 0) continue;
    double moved[3] = {0};
    part.in.snap(part.in.snap_context, i, moved);
    assert_true(moved[0] == v);
    assert_true(part.in.division.last(part.in.division.context, i, 0.5) == 1 + 10 * v + 0.5);
    assert_int_equal(part.global[i], v);
    assert_memory_equal(part.in.x[i], x[v], sizeof x[v]);
    assert_true(part.in.target[i] == target[v]);
    assert_int_equal(part.in.constraint_count[i], constraints[v]);
    assert_int_equal(part.in.constraint_stays[i], stays[v]);
    assert_memory_equal(part.in.constraint_normal[i], normal[v], sizeof normal[v]);
  }
  cw_wall_part_free(&part);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_part_of_a_strip)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
