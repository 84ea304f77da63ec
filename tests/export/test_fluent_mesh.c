// SPDX-License-Identifier: AGPL-3.0-or-later
// pump.msh through OpenFOAM's reader of Fluent's meshes: the mesh that the OpenFOAM case has.
#include "export/fluent_mesh.h"

#include <stdlib.h>
#include <string.h>

#include "tests/export/stage_run.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

static char run[sizeof test_folder + 10];
static char output[STAGE_OUTPUT_SIZE], other[STAGE_OUTPUT_SIZE];

static int make_run(void **state) {
  SyntheticPump pump = synthetic_pump();
  pump.pyramids = 1;
  if (make_test_folder(state) || stage_run_make(test_folder, &pump)) return -1;
  snprintf(run, sizeof run, "%s/run", test_folder);
  return stage_export_with(run, 2, "export: {formats: [openfoam, fluent]}", output);
}

static void openfoam_reads_the_same_mesh(void **state) {
  stage_need_program("fluent3DMeshToFoam");
  if (stage_shell(output,
                  "cd '%s' && mkdir -p read && cp -r export/openfoam/system read && cd read && fluent3DMeshToFoam "
                  "../export/fluent/pump.msh && "
                  "{ [ ! -d constant/region0 ] || mv constant/region0/polyMesh constant; }",
                  run))
    fail_msg("%s", output);
  assert_null(strstr(output, "Warning"));
  stage_shell(output, "cd '%s/read' && checkMesh -allTopology", run);
  if (!strstr(output, "Mesh OK")) fail_msg("%s", output);
  stage_shell(other, "cd '%s/export/openfoam' && checkMesh -allTopology", run);
  static const char *const same[] = {
      "    points: ",    "    faces: ",      "    internal faces: ", "    cells: ",     "    boundary patches: ",
      "    prisms: ",    "    pyramids: ",   "    tetrahedra: ",     "Total volume = ", "Min volume = ",
      "blade_pressure ", "rotor_interface ", "stator_interface ",    "inlet ",          "outlet ",
      "volute ",         "    rotor ",       "    stator "};
  for (size_t i = 0; i < sizeof same / sizeof *same; ++i) {
    const char *x = strstr(output, same[i]), *y = strstr(other, same[i]);
    if (!x || !y) fail_msg("no '%s' in %s", same[i], x ? other : output);
    x += strlen(same[i]);
    y += strlen(same[i]);
    for (int k = 0; k < 3; ++k) { // numbers of the line, as many as there are
      char *xs, *ys;
      const double a = strtod(x, &xs), b = strtod(y, &ys);
      if (xs == x || ys == y) {
        assert_true(k > 0 && xs == x && ys == y);
        break;
      }
      assert_near(a, b, 1e-7 * (b < 0 ? -b : b));
      x = xs;
      y = ys;
    }
  }
}

static void the_file_has_its_frame(void **state) {
  if (stage_shell(output, "cd '%s/export/fluent' && grep -c '' pump.msh && grep '^(' pump.msh && cat README.md", run))
    fail_msg("%s", output);
  static const char *const words[] = {"(2 3)\n",
                                      "(45 (2 fluid rotor)())\n",
                                      "(45 (4 interior rotor_inside)())\n",
                                      "interface rotor_interface)())\n",
                                      "pressure-inlet inlet)())\n",
                                      "| inlet | pressure-inlet | total pressure 101325 Pa",
                                      "| outlet | pressure-outlet | target mass flow rate 6.93194444 kg/s |",
                                      "| suction_pipe | wall | speed 0, absolute |",
                                      "| blade_pressure | wall | at rest relative to its cell zone |",
                                      "create interface_1 rotor_interface () stator_interface ()"};
  for (size_t i = 0; i < sizeof words / sizeof *words; ++i)
    if (!strstr(output, words[i])) fail_msg("no '%s' in %s", words[i], output);
}

static void any_number_of_ranks_gives_the_same_bytes(void **state) {
  for (int ranks = 1; ranks <= 3; ranks += 2) {
    stage_shell(output, "cp '%s/export/fluent/pump.msh' '%s/two.msh'", run, run);
    assert_int_equal(stage_export_with(run, ranks, "export: {formats: [openfoam, fluent]}", output), 0);
    assert_int_equal(stage_shell(output, "cmp '%s/export/fluent/pump.msh' '%s/two.msh'", run, run), 0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(openfoam_reads_the_same_mesh),
      cmocka_unit_test(the_file_has_its_frame),
      cmocka_unit_test(any_number_of_ranks_gives_the_same_bytes),
  };
  return cmocka_run_group_tests(tests, make_run, clear_test_folder);
}
