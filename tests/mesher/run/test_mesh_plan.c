// SPDX-License-Identifier: AGPL-3.0-or-later
// On the paper's pump; and with how many layers it is planned (cell_count).
#include "mesher/run/mesh_plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/run/cell_count.h"
#include "mesher/thickness/layer_thickness.h"
#include "pump_domains.h"

// Planned anew, a domain has one region more, other planes and the scale of before; three times. Then it is
// not divided, unless it is too large for a region, and then the run ends.
static void plans_that_do_not_fit_give_way(void **state) {
  const double of_layer = prism_factor / domain[1].layer_count;
  CwMeshRun run = {.table = &table,
                   .model = model,
                   .prisms.factor = 2 * of_layer,
                   .tets.factor = 2 * TET_FACTOR,
                   .planned_prisms.factor = of_layer,
                   .planned_tets.factor = TET_FACTOR,
                   .planned_scale = 2};
  memcpy(run.domain, domain, sizeof domain);
  for (int d = 0; d < CW_DOMAINS_MOST; d++) run.planned_layers[d] = domain[d].layer_count;
  run.domain[1].layer_count = 1; // since then
  cw_mesh_set_scale(&run, 2);
  table.mesh.cells_per_region = (int64_t)ceil(cells_at(&domain[1], 2) / 5.5);
  cw_mesh_set_scale(&run, 1.7);
  const double x[3] = {0.05, 0.1, 0.001}, wanted = cw_size_at(domain[1].size, x);
  CwOutcome why = {.kind = CW_OUTCOME_REPLAN, .domain = 1, .reason = "partition plane 3 grazes a face"};
  check(cw_mesh_plan_again(&run, &why));
  CwPlane first = run.domain[1].plan.node[0].plane;
  assert_int_equal(run.domain[1].plan.region_count, 7);
  assert_int_equal(run.domain[1].layer_count, 1);
  check(cw_mesh_plan_again(&run, &why));
  assert_int_equal(run.domain[1].plan.region_count, 8);
  assert_memory_not_equal(&first, &run.domain[1].plan.node[0].plane, sizeof first);
  check(cw_mesh_plan_again(&run, &why));
  assert_int_equal(run.domain[1].plan.region_count, 9);
  assert_true(run.scale == 1.7 && run.prisms.factor == 2 * of_layer && run.tets.factor == 2 * TET_FACTOR);
  assert_true(cw_size_at(domain[1].size, x) == wanted);
  run.tets.factor *= 1e6;
  assert_int_equal(cw_mesh_plan_again(&run, &why), CW_ERR_MESH);
  assert_non_null(strstr(cw_fail_message(), "stator: partition plane 3 grazes a face; after 3 other plans, and one "
                                            "region cannot hold its "));
  assert_non_null(strstr(cw_fail_message(), "another mesh.cells_per_region (5000 to 4000000)"));
  cw_fail_clear();
  run.tets.factor /= 1e6;
  check(cw_mesh_plan_again(&run, &why));
  assert_int_equal(run.domain[1].plan.region_count, 1);
  assert_int_equal(cw_mesh_plan_again(&run, &why), CW_ERR_MESH);
  assert_non_null(strstr(cw_fail_message(),
                         "stator: partition plane 3 grazes a face; after 3 other plans, undivided too; allowed: "));
  cw_fail_clear();
  cw_plan_free(&run.domain[1].plan);
}

// A domain whose symmetry is given up leaves the others theirs.
static void each_symmetry_is_given_up_alone(void **state) {
  const double of_layer = prism_factor / domain[0].layer_count;
  CwMeshRun run = {.table = &table,
                   .model = model,
                   .prisms.factor = of_layer,
                   .tets.factor = TET_FACTOR,
                   .planned_prisms.factor = of_layer,
                   .planned_tets.factor = TET_FACTOR,
                   .planned_scale = 2};
  memcpy(run.domain, domain, sizeof domain);
  for (int d = 0; d < CW_DOMAINS_MOST; d++) run.planned_layers[d] = domain[d].layer_count;
  check(cw_symmetry_find(domain[0].cad, &domain[0].background, &run.domain[0].symmetry));
  assert_non_null(run.domain[0].symmetry);
  cw_mesh_set_scale(&run, 2);
  const int32_t none[CW_DOMAINS_MOST] = {0}, stator[CW_DOMAINS_MOST] = {0, 1}, both[CW_DOMAINS_MOST] = {1, 1};
  check(cw_mesh_plan_whole(&run, none, "as asked"));
  check(cw_mesh_plan_whole(&run, stator, "as asked")); // which has none
  assert_non_null(run.domain[0].symmetry);
  assert_int_equal(run.domain[0].whole + run.domain[1].whole, 0);
  check(cw_mesh_plan_whole(&run, both, "as asked"));
  assert_null(run.domain[0].symmetry);
  assert_int_equal(run.domain[0].whole, 1);
  assert_int_equal(run.domain[1].whole, 0);
  assert_int_equal(run.domain[0].plan.sector_count, 0);
  assert_true(run.domain[0].plan.region_count > 0);
  assert_int_equal(run.domain[1].plan.region_count, 0);
  cw_plan_free(&run.domain[0].plan);
}

// The number of layers that enough faces of a domain need at the scale of a run.
static int layers_needed(const CwMeshRun *run, int d) {
  double needing[CW_LAYERS_MOST + 1] = {0};
  cw_domain_layers_needed(&run->domain[d], run->scale, needing);
  return cw_layer_count_for(needing);
}

// Where y+ is given the number of layers is what the faces of a domain need; with too few cells for that, as many as
// leave narrow faces their edges, but no fewer than usual, and cells are told that have room. Where y+ is left open
// that is so up to the usual number; then that is kept, and y+ grows until it is enough.
static void layers_grow_in_number_before_y_plus(void **state) {
  static const double cells[] = {1e4, 1e5, 3e5, 2e6};
  const CwCase paper = table;
  int most = 0; // where y+ is given
  for (int i = 0; i < 8; i++) {
    CwMeshRun run = {.table = &table, .model = model};
    CwWalls *walls = &table.walls;
    walls->layer_count = 0;
    table.mesh.cells = (int64_t)cells[i / 2];
    if (i % 2) walls->blade.y_plus = walls->hub_shroud.y_plus = walls->volute.y_plus = walls->pipe.y_plus = NAN;
    memcpy(run.domain, domain, sizeof domain);
    for (int d = 0; d < model.domain_count; d++) check(cw_domain_ask(&run.domain[d], &table));
    cw_mesh_solve_layers(&run);
    assert_int_equal(run.y_plus_auto > CW_LOG_LAYER_Y_PLUS, i % 2 && most > CW_LAYER_COUNT_USUAL);
    assert_true(fabs(cw_predicted_off(&run)) < 1e-9);
    if (i % 2 == 0) most = 0;
    int needed[CW_DOMAINS_MOST], few = run.scale >= cw_size_scale_fine();
    double room = cw_layers_short(&run, needed);
    assert_true(room == 0 || (few && room > cells[i / 2]));
    for (int d = 0; d < model.domain_count; d++) {
      int count = run.domain[d].layer_count, need = layers_needed(&run, d);
      if (room > 0) assert_int_equal(needed[d], need);
      assert_true(run.scale <= cw_size_scale_flat() || count == CW_LAYERS_LEAST);
      // One layer more takes that share of the cells at most.
      double with_more = run.scale * sqrt((count + 1.0) / count);
      if (few && need > count)
        assert_true(room > 0 && (count >= CW_LAYER_COUNT_USUAL || with_more > cw_size_scale_flat()));
      if (!few) assert_in_range(need, i % 2 ? 1 : count, count);
      if (i % 2) assert_true(count <= CW_LAYER_COUNT_USUAL);
      if (i % 2 == 0 && need > most) most = need;
      free(run.domain[d].patch_target);
      free(run.domain[d].relative_size);
      free(run.domain[d].patch_layers);
    }
    table = paper;
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(plans_that_do_not_fit_give_way),
      cmocka_unit_test(each_symmetry_is_given_up_alone),
      cmocka_unit_test(layers_grow_in_number_before_y_plus),
  };
  return cmocka_run_group_tests(tests, open_pump, close_pump);
}
