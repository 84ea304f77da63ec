// SPDX-License-Identifier: AGPL-3.0-or-later
// Which tetrahedra lie inside of a boundary, and which lie side by side: two tetrahedra, by hand.
#include <string.h>

#include "mesher/fill/fill_shape.h"
#include "two_tets.h"

typedef struct {
  double x[5][3];
  int32_t tet[2][4], triangle[4][3];
  CwFillInput input;
  CwFill fill; // of the arrays above
} Two;

static void make(Two *two, int inward) {
  memcpy(two->x, two_x, sizeof two_x);
  memcpy(two->tet, two_tets, sizeof two_tets);
  two->input = two_boundary(two->triangle, inward);
  two->fill = (CwFill){.point_count = 5, .x = two->x, .tetrahedron_count = 2, .tetrahedron = two->tet};
}

// The second tetrahedron goes, and the point that it alone has.
static void what_lies_outside_goes(void **state) {
  Two two;
  make(&two, 0);
  assert_int_equal(cw_fill_keep_inside(&two.input, &two.fill), CW_OK);
  assert_int_equal(two.fill.tetrahedron_count, 1);
  assert_memory_equal(two.tet[0], two_tets[0], sizeof two_tets[0]);
  assert_int_equal(two.fill.point_count, 4);
}

// With normals inward the second one is inside. Points of the boundary stay, also those that nothing has.
static void normals_tell_the_inside(void **state) {
  Two two;
  make(&two, 1);
  assert_int_equal(cw_fill_keep_inside(&two.input, &two.fill), CW_OK);
  assert_int_equal(two.fill.tetrahedron_count, 1);
  assert_memory_equal(two.tet[0], two_tets[1], sizeof two_tets[1]);
  assert_int_equal(two.fill.point_count, 5);
  assert_memory_equal(two.x, two_x, sizeof two_x);
}

static void fails(Two *two, const char *told) {
  assert_int_equal(cw_fill_keep_inside(&two->input, &two->fill), CW_ERR_MESH);
  if (!strstr(cw_fail_message(), told)) fail_msg("%s", cw_fail_message());
}

static void what_is_no_boundary_is_told(void **state) {
  Two two;
  make(&two, 0);
  two.triangle[1][1] = cw_tet_face[1][2], two.triangle[1][2] = cw_tet_face[1][1];
  fails(&two, "has its normal turned against its neighbours");
  make(&two, 0);
  memcpy(two.triangle[2], two.triangle[0], sizeof two.triangle[0]);
  fails(&two, "is listed twice");
  make(&two, 0);
  two.input.point_count = 5;
  two.triangle[0][0] = 4; // 4 2 3 is no face
  fails(&two, "was lost by TetGen");
}

static void neighbours_by_hand(void **state) {
  int32_t neighbour[2][4];
  assert_int_equal(cw_tet_neighbours(2, two_tets, neighbour), CW_OK);
  for (int i = 0; i < 3; i++) {
    assert_int_equal(neighbour[0][i], -1);
    assert_int_equal(neighbour[1][i], -1);
  }
  assert_int_equal(neighbour[0][3], 4 * 1 + 3);
  assert_int_equal(neighbour[1][3], 4 * 0 + 3);
  const int32_t three[3][4] = {{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 1, 2, 5}};
  int32_t of_three[3][4];
  assert_int_equal(cw_tet_neighbours(3, three, of_three), CW_ERR_FAULT);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_lies_outside_goes),
      cmocka_unit_test(normals_tell_the_inside),
      cmocka_unit_test(what_is_no_boundary_is_told),
      cmocka_unit_test(neighbours_by_hand),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
