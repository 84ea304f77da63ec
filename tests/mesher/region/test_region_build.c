// SPDX-License-Identifier: AGPL-3.0-or-later
// Numbers of the points that regions share. Regions themselves are built in test_mesh_steps and test_boundary.
#include "mesher/region/region_build.h"
#include "tests/unit_test.h"

// Of five nodes the first three stand over wall vertices, with columns of four layers, the third pinched. Those on
// planes are shared: one with the five points of its column, two by themselves.
static void columns_on_planes_are_shared_whole(void **state) {
  uint8_t on_plane[5] = {0, 1, 1, 0, 1};
  const CwInterfaces interfaces = {.nodes = {.count = 5, .on_plane = on_plane}};
  const CwSurfaceMesh surface = {.vertex_count = 3};
  double thickness[3] = {1, 1, 0};
  const CwLayers layers = {.column_count = 3, .thickness = thickness};
  const CwRegionInput from = {.surface = &surface, .layers = &layers, .interfaces = &interfaces};
  const int64_t base[5] = {-1, 0, 5, -1, 6};
  const int32_t node[3] = {1, 2, 4};
  CwSharedNodes shared;
  assert_int_equal(cw_shared_nodes_make(&from, 4, &shared), CW_OK);
  assert_int_equal(shared.count, 7);
  assert_int_equal(shared.node_count, 5);
  assert_int_equal(shared.shared_node_count, 3);
  assert_memory_equal(shared.base, base, sizeof base);
  assert_memory_equal(shared.node, node, sizeof node);
  cw_shared_nodes_free(&shared);
  assert_null(shared.base);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(columns_on_planes_are_shared_whole),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
