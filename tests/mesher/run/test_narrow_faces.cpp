// SPDX-License-Identifier: AGPL-3.0-or-later
// The fillet of a step stays where edges are as long as it is wide, and goes where they are four times as long.
#include <cstring>

#include "filleted_step.h"

extern "C" {
#include "mesher/run/narrow_faces.h"
}

#include "planned_solid.h"

static void check_scale(double scale, int faces) {
  PlannedSolid solid(filleted_step(false));
  CwMeshRun run = {};
  CwCase table = {};
  int left = -1;
  assert_int_equal(cw_log_open("mesh", nullptr, 0, 0, &run.context.log), CW_OK);
  run.table = &table;
  table.mesh.cells = 100000;
  run.headlines = json_array();
  run.model.domain_count = 1;
  run.domain[0].name = "part";
  run.domain[0].cad = solid.cad;
  run.domain[0].size = solid.size;
  cw_size_set_scale(solid.size, scale);
  assert_int_equal(cw_leave_out_narrow(&run, &left), CW_OK);
  assert_int_equal(left, faces);
  assert_int_equal(json_array_size(run.headlines), faces);
  if (faces) {
    const char *text = json_string_value(json_array_get(run.headlines, 0));
    assert_non_null(std::strstr(text, "part: 1 narrow faces of wall are left out"));
  }
  json_decref(run.headlines);
  cw_log_close(&run.context.log);
}

static void fine_meshes_show_it(void **) {
  check_scale(0.5, 0);
}

static void coarse_meshes_leave_it_out(void **) {
  check_scale(4, 1);
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(fine_meshes_show_it), cmocka_unit_test(coarse_meshes_leave_it_out)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
