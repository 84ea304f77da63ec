// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cstring>

#include "pipeline/case_schema.h"
#include "solids.h"

extern "C" {
#include "mesher/thickness/wall_targets.h"
}

static CwCase water() {
  CwCase table;
  cw_case_defaults(&table);
  table.fluid.kinematic_viscosity = 1e-6;
  table.walls.growth_ratio = 2;
  return table;
}

static void what_a_group_gives_goes_first(void **state) {
  CwCase table = water();
  CwWallGroup *blade = &table.walls.blade;
  assert_near(cw_layer_target(&table, blade, 1e-5, 3).growth, 2, 0);
  assert_near(cw_layer_target(&table, blade, 1e-5, 3).thickness, 7e-5, 1e-18);
  assert_near(cw_layer_target(&table, blade, 1e-5, 3).last, 1, 0);
  blade->growth_ratio = 1;
  table.walls.total_thickness = 2e-5;
  assert_near(cw_layer_target(&table, blade, 1e-5, 3).first_height, 1e-5, 0);
  assert_near(cw_layer_target(&table, blade, 1e-5, 3).thickness, 2e-5, 0);
  blade->total_thickness = 2.5e-5;
  assert_near(cw_layer_target(&table, blade, 1e-5, 3).thickness, 2.5e-5, 0);
  blade->total_thickness = 1; // more than three layers of 1e-5 give
  assert_near(cw_layer_target(&table, blade, 1e-5, 3).thickness, 3e-5, 1e-18);
  blade->growth_ratio = table.walls.growth_ratio = NAN;
  assert_near(cw_layer_target(&table, blade, 1e-5, 3).growth, 1.3, 0);
  assert_near(cw_layer_target(&table, blade, 1e-5, 3).last, 1.0 / 6, 0);
}

static void each_patch_has_its_group_and_size(void **state) {
  CwCase table = water();
  table.mesh.size_blade = 0.1, table.mesh.size_hub_shroud = 0.2, table.mesh.size_volute = 0.3;
  table.mesh.size_pipe = 0.4, table.mesh.size_interface = 0.5;
  table.walls.blade.y_plus = 1, table.walls.hub_shroud.y_plus = 2, table.walls.volute.y_plus = 3;
  table.walls.pipe.y_plus = 4;
  CwModelPatch patch = {};
  patch.y_plus_asked = NAN;
  patch.flow.speed = 7;
  for (int group = 0; group < CW_GROUPS; group++) {
    patch.size = (CwPatchGroup)group;
    patch.group = (CwPatchGroup)((group + 1) % CW_GROUP_INTERFACE);
    CwPatchTarget target = cw_patch_target(&table, &patch);
    assert_near(target.relative_size, 0.1 * (group + 1), 1e-15);
    assert_near(target.walls.y_plus, 1 + (group + 1) % CW_GROUP_INTERFACE, 0);
    assert_near(target.flow.speed, 7, 0);
  }
}

// It stands in place of a first height too.
static void a_y_plus_of_its_own_goes_first(void **state) {
  CwCase table = water();
  table.walls.volute.first_height = 1e-4;
  table.walls.volute.growth_ratio = 1.5;
  CwModelPatch patch = {};
  patch.group = CW_GROUP_VOLUTE;
  patch.y_plus_asked = NAN;
  assert_near(cw_patch_target(&table, &patch).walls.first_height, 1e-4, 0);
  patch.y_plus_asked = 50;
  CwPatchTarget target = cw_patch_target(&table, &patch);
  assert_near(target.walls.y_plus, 50, 0);
  assert_true(std::isnan(target.walls.first_height));
  assert_near(target.walls.growth_ratio, 1.5, 0);
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(what_a_group_gives_goes_first),
                                     cmocka_unit_test(each_patch_has_its_group_and_size),
                                     cmocka_unit_test(a_y_plus_of_its_own_goes_first)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
