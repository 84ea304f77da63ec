// SPDX-License-Identifier: AGPL-3.0-or-later
// Layers that follow the number of cells: by hand, and that their stretching stays the same function.
#include <string.h>

#include "pipeline/case_schema.h"
#include "pipeline/case_sweep.h"
#include "tests/unit_test.h"

static CwCase pump(CwSweep sweep, int layers, double growth) {
  CwCase table;
  cw_case_defaults(&table);
  table.mesh.cells = 1000000;
  table.mesh.sweep = sweep;
  table.walls.layer_count = layers;
  table.walls.growth_ratio = growth;
  table.walls.blade.y_plus = 30;
  table.walls.hub_shroud.y_plus = 60;
  table.walls.volute.first_height = 1e-4;
  table.walls.pipe.y_plus = 30;
  return table;
}

static void layers_stay_unless_asked(void **state) {
  CwCase table = pump(CW_SWEEP_LAYERS_STAY, 5, 1.2), before = table;
  assert_int_equal(cw_case_sweep("case.yaml", 8000000, &table), CW_OK);
  assert_int_equal(table.mesh.cells, 8000000);
  assert_memory_equal(&table.walls, &before.walls, sizeof table.walls);
}

static void eight_times_the_cells_halve_each_layer(void **state) {
  // Two layers of 1 and 1.44 become four of 1/2.2, 1.2/2.2, 1.44/2.2, 1.728/2.2: in pairs 1 and 1.44.
  CwCase table = pump(CW_SWEEP_SIMILAR, 2, 1.44);
  assert_int_equal(cw_case_sweep("case.yaml", 8000000, &table), CW_OK);
  assert_int_equal(table.walls.layer_count, 4);
  assert_near(table.walls.growth_ratio, 1.2, 1e-12);
  assert_near(table.walls.blade.y_plus, 30 / 2.2, 1e-12);
  assert_near(table.walls.hub_shroud.y_plus, 60 / 2.2, 1e-12);
  assert_near(table.walls.volute.first_height, 1e-4 / 2.2, 1e-18);
  assert_true(isnan(table.walls.volute.y_plus));
  // Layers without growth are halved.
  table = pump(CW_SWEEP_SIMILAR, 3, 1);
  assert_int_equal(cw_case_sweep("case.yaml", 8000000, &table), CW_OK);
  assert_near(table.walls.blade.y_plus, 15, 1e-12);
}

static double thickness(double first, double growth, int layers) {
  double sum = 0;
  for (int k = 0; k < layers; ++k) sum += first * pow(growth, k);
  return sum;
}

static void the_whole_thickness_stays(void **state) {
  for (int64_t cells = 20000; cells < 300000000; cells *= 3) {
    CwCase table = pump(CW_SWEEP_SIMILAR, 5, 1.2);
    table.walls.hub_shroud.growth_ratio = 1.3;
    assert_int_equal(cw_case_sweep("case.yaml", cells, &table), CW_OK);
    const CwWalls *walls = &table.walls;
    assert_near(thickness(walls->blade.y_plus, walls->growth_ratio, walls->layer_count), thickness(30, 1.2, 5), 1e-9);
    assert_near(thickness(walls->hub_shroud.y_plus, walls->hub_shroud.growth_ratio, walls->layer_count),
                thickness(60, 1.3, 5), 1e-9);
  }
}

static void what_cannot_be_refined_is_told(void **state) {
  CwCase table = pump(CW_SWEEP_SIMILAR, 0, 1.2);
  assert_int_equal(cw_case_sweep("case.yaml", 8000000, &table), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "case.yaml: mesh.sweep: similar refines given layers"));
  table = pump(CW_SWEEP_SIMILAR, 5, 1.2);
  table.walls.pipe.y_plus = NAN;
  assert_int_equal(cw_case_sweep("case.yaml", 8000000, &table), CW_ERR_INPUT);
  table = pump(CW_SWEEP_SIMILAR, 20, 1.2);
  assert_int_equal(cw_case_sweep("case.yaml", 27000000, &table), CW_ERR_INPUT);
  assert_non_null(
      strstr(cw_fail_message(), "60 layers of 20 for 27000000 cells; allowed: at most 40, so at most 8e+06"));
  // At its own number of cells nothing is refined, and nothing need be.
  table = pump(CW_SWEEP_SIMILAR, 0, 1.2);
  assert_int_equal(cw_case_sweep("case.yaml", 1000000, &table), CW_OK);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(layers_stay_unless_asked), cmocka_unit_test(eight_times_the_cells_halve_each_layer),
      cmocka_unit_test(the_whole_thickness_stays), cmocka_unit_test(what_cannot_be_refined_is_told)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
