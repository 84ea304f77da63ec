// SPDX-License-Identifier: AGPL-3.0-or-later
// What stands about the vertices of a wall, by hand.
#include <string.h>

#include "hexagon.h"
#include "mesher/layers/layers_topology.h"

static void check_list(const int32_t *start, const int32_t *list, int32_t v, int32_t count, const int32_t *wanted) {
  assert_int_equal(start[v + 1] - start[v], count);
  assert_memory_equal(list + start[v], wanted, (size_t)count * sizeof *wanted);
}

// The input's normals point out of the domain, those of the work into it.
static void normals_point_into_the_fluid(void **state) {
  Hexagon wall;
  CwLayerWork work = {0};
  hexagon_make(&wall);
  assert_int_equal(cw_layers_topology(&wall.in, &work), CW_OK);
  for (int f = 0; f < 6; f++) {
    assert_near(work.face_normal[f][0], 0, 0);
    assert_near(work.face_normal[f][1], 0, 0);
    assert_near(work.face_normal[f][2], 1, 1e-15);
  }
  cw_layers_work_free(&work);
}

static void lists_ascend(void **state) {
  Hexagon wall;
  CwLayerWork work = {0};
  hexagon_make(&wall);
  assert_int_equal(cw_layers_topology(&wall.in, &work), CW_OK);
  check_list(work.near_start, work.near, 0, 6, (const int32_t[]){1, 2, 3, 4, 5, 6});
  check_list(work.near_start, work.near, 1, 3, (const int32_t[]){0, 2, 6});
  check_list(work.near_start, work.near, 4, 3, (const int32_t[]){0, 3, 5});
  check_list(work.face_start, work.face, 0, 6, (const int32_t[]){0, 1, 2, 3, 4, 5});
  check_list(work.face_start, work.face, 1, 2, (const int32_t[]){0, 5});
  for (int v = 0; v < 7; v++) assert_near(cw_layers_shortest_edge(&work, v), 2, 1e-15);
  cw_layers_work_free(&work);
}

// Half the cotangent of 60 degrees for each triangle at an edge; a third of the area of the triangles, sqrt(3) each.
static void weights_are_cotangents(void **state) {
  Hexagon wall;
  CwLayerWork work = {0};
  double weight[6], area;
  hexagon_make(&wall);
  assert_int_equal(cw_layers_topology(&wall.in, &work), CW_OK);
  cw_layers_weights(&work, 0, weight, &area);
  for (int k = 0; k < 6; k++) assert_near(weight[k], 1 / sqrt(3), 1e-14);
  assert_near(area, 2 * sqrt(3), 1e-14);
  cw_layers_weights(&work, 1, weight, &area); // on the border: 0, then 2 and 6
  assert_near(weight[0], 1 / sqrt(3), 1e-14);
  assert_near(weight[1], 1 / sqrt(12), 1e-14);
  assert_near(weight[2], 1 / sqrt(12), 1e-14);
  assert_near(area, 2 / sqrt(3), 1e-14);
  cw_layers_work_free(&work);
}

// Across from an obtuse corner a cotangent is below 0: no weight is.
static void obtuse_corners_keep_weights_positive(void **state) {
  const double x[3][3] = {{0, 0, 0}, {1, 0, 0}, {0.5, 0.1, 0}}, target[3] = {1, 1, 1};
  const int32_t triangle[1][3] = {{0, 2, 1}};
  const CwLayerInput in = {.point_count = 3, .x = x, .triangle_count = 1, .triangle = triangle, .target = target};
  CwLayerWork work = {0};
  double weight[2], area;
  assert_int_equal(cw_layers_topology(&in, &work), CW_OK);
  cw_layers_weights(&work, 0, weight, &area);
  assert_near(weight[0], 0.5 * 0.05, 1e-15); // to point 1, past the corner at 2
  assert_near(weight[1], 0.5 * 5, 1e-15);    // to point 2, past one of 11 degrees, whose cotangent of 5 is the most
  assert_near(area, 0.05 / 3, 1e-15);
  cw_layers_work_free(&work);
}

static void fails(const CwLayerInput *in, const char *told) {
  CwLayerWork work = {0};
  assert_int_equal(cw_layers_topology(in, &work), CW_ERR_INPUT);
  if (!strstr(cw_fail_message(), told)) fail_msg("%s", cw_fail_message());
  cw_layers_work_free(&work);
}

static void wrong_input_is_told(void **state) {
  const double slanted[7][2][3] = {{{0, 0, 1.1}}};
  const int32_t one[7] = {1}, three[7] = {0, 3};
  Hexagon wall;
  hexagon_make(&wall);
  wall.triangle[3][1] = 7;
  fails(&wall.in, "wall triangle 3 names point 7 of 7");
  hexagon_make(&wall);
  wall.target[2] = 0;
  fails(&wall.in, "thickness 0 mm asked");
  hexagon_make(&wall);
  wall.x[4][1] = NAN;
  fails(&wall.in, "wall vertex 4 has a coordinate that is not a number");
  hexagon_make(&wall);
  wall.in.point_count = 6; // of the last one no triangle
  wall.in.triangle_count = 3;
  fails(&wall.in, "belongs to no wall triangle");
  hexagon_make(&wall);
  for (int k = 0; k < 3; k++) wall.x[1][k] = 0.5 * wall.x[2][k];
  fails(&wall.in, "wall triangle without area");
  hexagon_make(&wall);
  wall.in.constraint_count = one;
  wall.in.constraint_normal = slanted;
  fails(&wall.in, "is not a unit vector");
  wall.in.constraint_count = three;
  fails(&wall.in, "3 constraints");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(normals_point_into_the_fluid), cmocka_unit_test(lists_ascend),
      cmocka_unit_test(weights_are_cotangents),       cmocka_unit_test(obtuse_corners_keep_weights_positive),
      cmocka_unit_test(wrong_input_is_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
