// SPDX-License-Identifier: AGPL-3.0-or-later

#include "mesher/common/ring.h"
#include "tests/unit_test.h"

// A ring of four corners 10..13 round the edge 1-2, cut from corner 0 to 2: triangles (0,1,2) and (0,2,3).
static void ring_of_four_gives_four_tetrahedra(void **state) {
  int8_t cut[4][4] = {{0}};
  const int32_t ring[4] = {10, 11, 12, 13};
  int32_t tet[4][4];
  cut[0][3] = 2;
  cut[0][2] = 1;
  assert_int_equal(cw_ring_tets(&cut[0][0], 4, ring, 1, 2, 0, 3, tet, 0), 4);
  const int32_t wanted[4][4] = {{10, 11, 12, 2}, {10, 12, 11, 1}, {10, 12, 13, 2}, {10, 13, 12, 1}};
  assert_memory_equal(tet, wanted, sizeof wanted);
}

static void side_of_the_ring_gives_none(void **state) {
  const int8_t cut[4] = {0};
  const int32_t ring[2] = {10, 11};
  int32_t tet[1][4];
  assert_int_equal(cw_ring_tets(cut, 2, ring, 1, 2, 0, 1, tet, 3), 3);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(ring_of_four_gives_four_tetrahedra),
      cmocka_unit_test(side_of_the_ring_gives_none),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
