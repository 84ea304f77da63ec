// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>

#include "filleted_step.h"

extern "C" {
#include "mesher/run/cell_count.h"
#include "pipeline/case_schema.h"
}

#include "planned_solid.h"

// A run of one domain of 5 layers, with 2,000 wall triangles and an integral of 20,000 over the volume.
static CwMeshRun run_of(const PlannedSolid &solid, const CwCase *table, double tets) {
  CwMeshRun run = {};
  run.table = table;
  run.tets.factor = tets;
  run.prisms.factor = 2.4;
  run.model.domain_count = 1;
  run.domain[0].size = solid.size;
  run.domain[0].volume_integral = 20000;
  run.domain[0].layer_count = 5;
  run.domain[0].surface.triangle_count = 2000;
  return run;
}

// 2,000 wall triangles under 5 layers are 10,000 prisms; of 40,000 cells 30,000 are left to tetrahedra, 12 for each
// unit of the integral, which is 20,000 over the cube of the scale: that is 2. With 1,000 triangles more there are
// 5,000 less.
static void tetrahedra_make_up_for_walls(void **) {
  PlannedSolid solid(filleted_step(false));
  CwCase table = {};
  table.mesh.cells = 40000;
  CwMeshRun run = run_of(solid, &table, 12);
  for (int triangles : {2000, 3000}) {
    run.domain[0].surface.triangle_count = triangles;
    run.scale = 1.9;
    cw_mesh_fit_volume(&run);
    assert_near(run.scale, std::cbrt(12.0 * 20000 / (40000 - 5 * triangles)), 1e-9);
    assert_near(cw_size_scale(solid.size), run.scale, 0);
  }
}

// 30,000 tetrahedra at a scale of 2 are 12 for each unit of an integral of 20,000 over the cube of it, as long as there
// are as many layers. With others as many as in any pump are expected, 6.6 + 1.33 ln(1/10) for 30,000 cells and no
// walls, and what is counted then tells no slope until it is counted twice.
static void counts_hold_for_their_layers(void **) {
  PlannedSolid solid(filleted_step(false));
  CwCase table = {};
  table.mesh.cells = 30000;
  CwMeshRun run = run_of(solid, &table, 20);
  CwDomain &domain = run.domain[0];
  const auto learn = [&](double scale, double tetrahedra) {
    run.scale = scale;
    run.cells = (int64_t)(tetrahedra + domain.layer_count * 2000);
    cw_learn_tets(&run);
  };
  learn(2, 30000);
  assert_near(run.tets.factor, 12, 1e-12);
  assert_near(cw_predicted_cells(&run, 0), 30000, 1e-6);
  domain.layer_count = 4;
  assert_near(cw_predicted_cells(&run, 0), (6.6 - 1.33 * std::log(10)) * 20000 / 8, 1e-6);
  learn(2.5, 20000);
  assert_near(run.tets.exponent, 0, 0);
  assert_near(cw_predicted_cells(&run, 0), 20000, 1e-6);
  learn(2.25, 24000); // 13.7 a unit where there were 15.6
  assert_near(run.tets.exponent, std::log(24 * std::pow(2.25, 3) / (20 * std::pow(2.5, 3))) / std::log(0.9), 1e-9);
}

// With 2.4 prisms a layer for each unit of a million on the walls, and hardly a tetrahedron, 480,000 cells have the
// square of the scale at five times the number of layers. Triangles over narrow faces have 20 degrees at the scale of
// 6.87, with 9 layers; 240,000 cells have room for 4. Not more than 3 are kept, and none that the case does not give.
static void layers_go_where_walls_would_be_flat(void **) {
  PlannedSolid solid(filleted_step(false));
  struct {
    int given, made;
    int64_t cells;
  } const rows[] = {{40, 9, 480000}, {9, 9, 480000}, {40, 4, 240000}, {4, 4, 240000}, {15, 4, 240000},
                    {40, 3, 50000},  {7, 3, 50000},  {3, 3, 50000},   {2, 2, 50000},  {5, 5, 960000}};
  for (const auto &row : rows) {
    CwMeshRun run = {};
    CwCase table;
    CwPatchTarget target[CW_PATCHES_MOST] = {};
    CwLayerTarget layers[CW_PATCHES_MOST] = {};
    cw_case_defaults(&table);
    table.mesh.cells = row.cells;
    table.walls.layer_count = row.given;
    table.walls.blade.y_plus = 30;
    run.table = &table;
    run.tets.factor = 1e-9;
    run.prisms.factor = 2.4;
    run.model.domain_count = 1;
    CwDomain &domain = run.domain[0];
    domain.cad = solid.cad;
    domain.size = solid.size;
    domain.volume_integral = 1;
    domain.prism_integral = 1e6;
    domain.patch_target = target;
    domain.patch_layers = layers;
    target[0].walls = table.walls.blade;
    target[0].flow = {1, 0.1, 0.1, 0.02, 0};
    cw_mesh_solve_layers(&run);
    assert_int_equal(domain.layer_count, row.made);
    assert_near(run.scale, std::sqrt(2.4e6 * row.made / (double)row.cells), 1e-6);
    double cells = cw_cells_crowded(&run);
    if (run.scale <= 5 && row.made == row.given)
      assert_near(cells, 0, 0);
    else
      assert_near(cells, 2.4e6 * row.given / 25, 1);
    assert_int_equal(domain.layer_count, row.made);
    const int32_t most[CW_DOMAINS_MOST] = {row.made - 1};
    cw_mesh_leave_room(&run, most);
    const int left = row.made - 1 > 0 ? row.made - 1 : row.made;
    assert_int_equal(domain.layer_count, left);
    assert_near(run.scale, std::sqrt(2.4e6 * left / (double)row.cells), 1e-6);
  }
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(tetrahedra_make_up_for_walls),
                              cmocka_unit_test(counts_hold_for_their_layers),
                              cmocka_unit_test(layers_go_where_walls_would_be_flat)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
