// SPDX-License-Identifier: AGPL-3.0-or-later
// Other people's programs on what the exporter writes: cgnscheck, checkMesh, simpleFoam, pimpleFoam.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/export/stage_run.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

static char output[STAGE_OUTPUT_SIZE];

static int make_export(void **state) {
  SyntheticPump pump = synthetic_pump();
  if (make_test_folder(state) || stage_run_make(test_folder, &pump)) return -1;
  const char *run = in_test_folder("run");
  return stage_export(run, 2, output);
}

static void cgnscheck_has_nothing_to_say(void **state) {
  stage_need_program("cgnscheck");
  assert_int_equal(stage_shell(output, "cgnscheck '%s/run/export/pump.cgns'", test_folder), 0);
  // It ends with 0 whatever it finds.
  if (strstr(output, "ERROR") || strstr(output, "WARNING")) fail_msg("%s", output);
  assert_non_null(strstr(output, "\"ROTOR\""));
  assert_non_null(strstr(output, "\"STATOR\""));
  assert_non_null(strstr(output, "rotor_to_stator"));
}

// The number that follows `words`, the last time they stand in the output.
static double number_after(const char *words) {
  const char *found = NULL, *at = output;
  while ((at = strstr(at, words))) found = at += strlen(words);
  if (!found) fail_msg("no '%s' in: %s", words, output);
  return strtod(found, NULL);
}

static void checkmesh_finds_a_sound_mesh(void **state) {
  stage_need_program("checkMesh");
  stage_shell(output,
              "cp -r '%s/run/export/openfoam' '%s/check' && cd '%s/check' && checkMesh -allGeometry -allTopology",
              test_folder, test_folder, test_folder);
  if (!strstr(output, "Mesh OK") || strstr(output, "***") || strstr(output, "Failed")) fail_msg("%s", output);
  assert_non_null(strstr(output, "Upper triangular ordering OK"));
}

// With pyramids: sound but for their flatness, which gives cells of small determinant.
static void checkmesh_takes_pyramids(void **state) {
  SyntheticPump pump = synthetic_pump();
  stage_need_program("checkMesh");
  const char *run = in_test_folder("pyramids");
  pump.pyramids = 1;
  assert_int_equal(synthetic_run_write(run, &pump), 0);
  assert_int_equal(stage_export(run, 2, output), 0);
  stage_shell(output, "cd '%s/export/openfoam' && checkMesh", run);
  if (!strstr(output, "Mesh OK")) fail_msg("%s", output);
  assert_near(number_after("pyramids:"), 50, 0);
}

// Weights are the area of the other side over each face, by its own area.
static void interface_weights_are_about_one(void **state) {
  stage_need_program("checkMesh");
  stage_shell(output, "cd '%s/run/export/openfoam' && checkMesh -allGeometry | grep weights", test_folder);
  for (int side = 0; side < 2; ++side) {
    char words[60];
    snprintf(words, sizeof words, "Patch %s sum(weights) min:", side ? "target" : "source");
    assert_true(number_after(words) > 0.98);
    const char *at = strstr(strstr(output, words), "max:");
    assert_true(strtod(at + 4, NULL) < 1.02);
  }
}

static void steady_run_starts_and_reports(void **state) {
  stage_need_program("simpleFoam");
  int code = stage_shell(output, "cp -r '%s/run/export/openfoam' '%s/steady' && cd '%s/steady' && simpleFoam -dry-run",
                         test_folder, test_folder, test_folder);
  if (code || strstr(output, "FOAM FATAL")) fail_msg("%s", output);
  code = stage_shell(output, "cd '%s/steady' && sed -i 's/endTime  .*/endTime 100;/' system/controlDict && ./Allrun",
                     test_folder);
  if (code) fail_msg("%s", output);
  // The toy pump has straight radial blades: it lifts the water, and takes more power than it gives.
  double head = number_after("\nhead "), torque = number_after("shaft torque"),
         efficiency = number_after("hydraulic efficiency"), in = number_after("flow                 in");
  assert_true(head > 3 && head < 30);
  assert_true(torque > 0);
  assert_true(efficiency > 5 && efficiency < 100);
  assert_near(efficiency, 100 * 998.2 * 9.80665 * 25 / 3600 * head / (torque * 1450 * M_PI / 30), 0.02);
  assert_near(in, 25.0 / 3600, 0.01 * 25 / 3600);
  assert_non_null(strstr(output, "blade_pressure"));
  assert_non_null(strstr(output, "Mesh OK"));
  // The suction pipe stands still in the turning zone.
  stage_shell(output, "cd '%s/steady' && grep nonRotatingPatches constant/MRFProperties", test_folder);
  assert_non_null(strstr(output, "(inlet suction_pipe rotor_interface)"));
}

// As a large mesh is run where no number of ranks is asked for: checked, divided and solved on several.
static void a_large_mesh_is_checked_in_parts(void **state) {
  stage_need_program("simpleFoam");
  int code = stage_shell(output,
                         "cp -r '%s/run/export/openfoam' '%s/large' && cd '%s/large' && sed -i 's/^usual_ranks=1/"
                         "usual_ranks=$(echo 2)/' run_solver.sh && sed -i 's/endTime  .*/endTime 10;/; s/writeInterval "
                         ".*/writeInterval 10;/' system/controlDict && ./Allrun && ls -d 10/U processor1/constant && "
                         "grep -h '^nProcs' log.checkMesh log.simpleFoam && find . -name cellToRegion",
                         test_folder, test_folder, test_folder);
  if (code) fail_msg("%s", output);
  assert_non_null(strstr(output, "Mesh OK"));
  assert_non_null(strstr(output, "10/U\nprocessor1/constant\nnProcs : 2\nnProcs : 2\n"));
  assert_null(strstr(output, "cellToRegion"));
  assert_non_null(strstr(output, "openfoam.processors: 2 has it exported divided, on all ranks\n"));
}

// What a run in time takes over from the one before it, and what it has in its place, as OpenFOAM reads them.
static void runs_in_time_differ_in_few_entries(void **state) {
  static const char *const entries[][4] = {
      {"transient", "fvSchemes", "ddtSchemes/default", "Euler"},
      {"transient", "fvSchemes", "gradSchemes/grad(U)", "cellLimited Gauss linear 1"},
      {"transient", "fvSchemes", "divSchemes/div(phi,U)", "Gauss linearUpwind grad(U)"},
      {"transient", "fvSchemes", "divSchemes/div(phi,k)", "Gauss upwind"},
      {"transient", "fvSchemes", "divSchemes/div(phi,epsilon)", "Gauss upwind"},
      {"transient", "fvSchemes", "divSchemes/div(phi,omega)", "Gauss upwind"},
      {"transient", "fvSchemes", "divSchemes/div((nuEff*dev2(T(grad(U)))))", "Gauss linear"},
      {"transient", "fvSolution", "PIMPLE/nOuterCorrectors", "5"},
      {"les", "fvSchemes", "ddtSchemes/default", "backward"},
      {"les", "fvSchemes", "gradSchemes/grad(U)", "cellLimited Gauss linear 1"},
      {"les", "fvSchemes", "divSchemes/div(phi,U)", "Gauss CoBlended 1 LUST grad(U) 5 linearUpwind grad(U)"},
      {"les", "fvSchemes", "laplacianSchemes/default", "Gauss linear limited corrected 0.5"},
      {"les", "fvSolution", "solvers/p/relTol", "0.05"},
      {"les", "fvSolution", "solvers/UFinal/relTol", "0.01"},
      {"les", "fvSolution", "PIMPLE/nOuterCorrectors", "3"},
      {"les", "fvSolution", "PIMPLE/nCorrectors", "2"},
      {"les", "fvSolution", "PIMPLE/nNonOrthogonalCorrectors", "1"},
      {"les", "fvSolution", "relaxationFactors/fields/p", "0.4"},
      {"les", "fvSolution", "relaxationFactors/equations/U", "0.7"}};
  stage_need_program("foamDictionary");
  for (size_t i = 0; i < sizeof entries / sizeof *entries; ++i) {
    const char *const *of = entries[i];
    int code = stage_shell(output, "cd '%s/run/export/openfoam/%s' && foamDictionary -entry '%s' -value system/%s",
                           test_folder, of[0], of[2], of[1]);
    output[strcspn(output, "\n")] = '\0';
    if (code || strcmp(output, of[3]) != 0) fail_msg("%s of %s is '%s', not '%s'", of[2], of[0], output, of[3]);
  }
}

static void transient_run_starts_from_the_steady_one(void **state) {
  stage_need_program("pimpleFoam");
  int code = stage_shell(output,
                         "cd '%s/steady/transient' && sed -i 's/endTime  .*/endTime 3.5e-4;/; s/writeInterval .*/"
                         "writeInterval 3;/' system/controlDict && sed -i 's/Interval  *10;/Interval 1;/' "
                         "../system/functions && "
                         "./Allrun && grep '^Selecting RAS' log.pimpleFoam && grep -ao 'internalField *[a-z]*' 0/omega",
                         test_folder);
  if (code) fail_msg("%s", output);
  assert_non_null(strstr(output, "starts from iteration 100 of the steady run"));
  assert_non_null(strstr(output, "kOmegaSST\ninternalField   nonuniform\n")); // from a steady result of kEpsilon
  assert_near(number_after("out "), 25.0 / 3600, 1e-8);
  assert_true(number_after("\nhead ") > 3);
}

// Oil of 1000 cSt in the same pump: by the case's scripts, in time too, and by the stage `solve`.
static void laminar_flow_is_solved_without_turbulence(void **state) {
  SyntheticPump pump = synthetic_pump();
  const char *run = in_test_folder("oil");
  stage_need_program("simpleFoam");
  assert_int_equal(synthetic_run_write(run, &pump), 0);
  assert_int_equal(stage_walls_set(run, NULL, "null", output), 0);
  assert_int_equal(stage_export(run, 1, output), 0);
  int code =
      stage_shell(output,
                  "cd '%s/export/openfoam' && sed -i 's/1.004e-06/1e-3/' constant/transportProperties && "
                  "sed -i 's/endTime  .*/endTime 20;/; s/writeInterval .*/writeInterval 20;/' system/controlDict && "
                  "./Allrun && cat log.simpleFoam && ls 20",
                  run);
  if (code) fail_msg("%s", output);
  assert_non_null(strstr(output, "Selecting laminar stress model Stokes"));
  assert_null(strstr(output, "Solving for k"));
  assert_null(strstr(output, "\nnut\n"));
  assert_true(number_after("shaft torque") > 0);
  assert_near(number_after("flow                 in"), 25.0 / 3600, 0.05 * 25 / 3600);
  assert_non_null(strstr(output, "\n  blade_pressure ")); // its y+
  code =
      stage_shell(output,
                  "cd '%s/export/openfoam/transient' && sed -i 's/endTime  .*/endTime 3.5e-4;/; s/writeInterval .*/"
                  "writeInterval 3;/' system/controlDict && sed -i 's/Interval  *10;/Interval 1;/' ../system/functions "
                  "&& ./Allrun && cat log.pimpleFoam",
                  run);
  if (code) fail_msg("%s", output);
  assert_non_null(strstr(output, "starts from iteration 20 of the steady run"));
  assert_null(strstr(output, "Solving for k"));
  code = stage_shell(output,
                     "sed -i 's/Interval  *1;/Interval 10;/' '%s/export/openfoam/system/functions' && python3 -B "
                     "'%s/pipeline/solve/solve.py' --case '%s/cases/paper/case.yaml' --run '%s' --ranks 1 --most 10 && "
                     "cat '%s/solve/history.csv'",
                     run, CUTWATER_SOURCE_DIR, CUTWATER_SOURCE_DIR, run, run);
  if (code) fail_msg("%s", output);
  double head, torque, residual[2];
  const char *row = strstr(output, "\n10,");
  if (!row || sscanf(row, "\n10,%lf,%lf,%lf,%lf", &head, &torque, &residual[0], &residual[1]) != 4)
    fail_msg("%s", output);
  assert_true(torque > 0 && residual[0] > 0 && residual[1] > 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cgnscheck_has_nothing_to_say),
      cmocka_unit_test(checkmesh_finds_a_sound_mesh),
      cmocka_unit_test(checkmesh_takes_pyramids),
      cmocka_unit_test(interface_weights_are_about_one),
      cmocka_unit_test(steady_run_starts_and_reports),
      cmocka_unit_test(transient_run_starts_from_the_steady_one),
      cmocka_unit_test(a_large_mesh_is_checked_in_parts),
      cmocka_unit_test(runs_in_time_differ_in_few_entries),
      cmocka_unit_test(laminar_flow_is_solved_without_turbulence),
  };
  return cmocka_run_group_tests(tests, make_export, clear_test_folder);
}
