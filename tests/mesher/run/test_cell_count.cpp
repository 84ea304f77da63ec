// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>

#include "filleted_step.h"

extern "C" {
#include "mesher/run/cell_count.h"
}

#include "planned_solid.h"

// 2,000 wall triangles under 5 layers are 10,000 prisms; of 40,000 cells 30,000 are left to tetrahedra, 12 for each
// unit of the integral, which is 20,000 over the cube of the scale: that is 2. With 1,000 triangles more there are
// 5,000 less.
static void tetrahedra_make_up_for_walls(void **) {
  PlannedSolid solid(filleted_step(false));
  CwMeshRun run = {};
  CwCase table = {};
  table.mesh.cells = 40000;
  run.table = &table;
  run.tets.factor = 12;
  run.prisms.factor = 2.4;
  run.model.domain_count = 1;
  run.domain[0].size = solid.size;
  run.domain[0].volume_integral = 20000;
  run.domain[0].layer_count = 5;
  for (int triangles : {2000, 3000}) {
    run.domain[0].surface.triangle_count = triangles;
    run.scale = 1.9;
    cw_mesh_fit_volume(&run);
    assert_near(run.scale, std::cbrt(12.0 * 20000 / (40000 - 5 * triangles)), 1e-9);
    assert_near(cw_size_scale(solid.size), run.scale, 0);
  }
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(tetrahedra_make_up_for_walls)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
