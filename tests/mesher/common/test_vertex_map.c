// SPDX-License-Identifier: AGPL-3.0-or-later

#include "mesher/common/vertex_map.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

enum { VERTICES = 5000, SETS = 4000 };

// Against a plain table, with numbers given anew.
static void keeps_what_was_set(void **state) {
  CwVertexMap map = {0};
  int32_t number[VERTICES] = {0}, count = 0;
  uint64_t seed = 1;
  assert_int_equal(cw_vertex_map_get(&map, 0), 0);
  for (int i = 0; i < SETS; i++) {
    int32_t v = (int32_t)(VERTICES * draw(&seed));
    count += !number[v];
    number[v] = i % 2 ? i : -1 - i;
    assert_int_equal(cw_vertex_map_set(&map, v, number[v]), CW_OK);
  }
  assert_int_equal(map.count, count);
  for (int32_t v = 0; v < VERTICES; v++) assert_int_equal(cw_vertex_map_get(&map, v), number[v]);
  cw_vertex_map_free(&map);
  assert_int_equal(cw_vertex_map_get(&map, 1), 0);
}

// However large their numbers are, the table is a few times as long as they are many.
static void takes_what_its_vertices_need(void **state) {
  CwVertexMap map = {0};
  for (int32_t i = 0; i < SETS; i++) assert_int_equal(cw_vertex_map_set(&map, INT32_MAX - 1000 * i, 1 + i), CW_OK);
  for (int32_t i = 0; i < SETS; i++) assert_int_equal(cw_vertex_map_get(&map, INT32_MAX - 1000 * i), 1 + i);
  assert_in_range(map.capacity, SETS, 4 * SETS);
  cw_vertex_map_free(&map);
  cw_vertex_map_free(&map);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(keeps_what_was_set),
      cmocka_unit_test(takes_what_its_vertices_need),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
