// SPDX-License-Identifier: AGPL-3.0-or-later
// What the numbers of a case become in the OpenFOAM and CFX files.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "export/foam_case.h"
#include "tests/export/stage_run.h"
#include "tests/export/synthetic_run.h"

static char folder[STAGE_PATH_SIZE];
static char output[STAGE_OUTPUT_SIZE];

static int make_run(void **state) {
  (void)state;
  char run[STAGE_PATH_SIZE + 10];
  SyntheticPump pump = synthetic_pump();
  if (stage_folder_make(folder))
    return -1;
  snprintf(run, sizeof run, "%s/run", folder);
  return synthetic_run_write(run, &pump);
}

static int remove_run(void **state) {
  (void)state;
  stage_folder_remove(folder);
  return 0;
}

// Exports with the paper's case after a sed command.
static void export_with(const char *edit) {
  int code = stage_shell(output,
                         "cd '%s' && sed '%s' '%s/cases/paper/case.yaml' > case.yaml && "
                         "'%s/cutwater-export' --case case.yaml --run run",
                         folder, edit, CUTWATER_SOURCE_DIR, CUTWATER_BIN_DIR);
  if (code)
    fail_msg("%s", output);
}

static void expect(const char *name, const char *words) {
  assert_int_equal(stage_shell(output, "cat '%s/run/export/%s'", folder, name), 0);
  if (!strstr(output, words))
    fail_msg("no '%s' in %s:\n%s", words, name, output);
}

static void the_paper_in_cfx(void **state) {
  (void)state;
  export_with("");
  expect("cfx/steady.ccl", "Angular Velocity = 1450 [rev min^-1]");
  expect("cfx/steady.ccl", "Mass Flow Rate = 6.93194444 [kg s^-1]"); // 25/3600 * 998.2
  expect("cfx/steady.ccl", "Sand Grain Roughness Height = 25 [micron]");
  expect("cfx/steady.ccl", "Reference Pressure = 101325 [Pa]");
  expect("cfx/steady.ccl", "Option = Frozen Rotor");
  expect("cfx/steady.ccl", "Location = suction_pipe\n");
  expect("cfx/transient.ccl", "Timesteps = 0.000114942529 [s]"); // 60/1450/360
}

static void log_layer_meshes_take_k_epsilon(void **state) {
  (void)state;
  export_with("");
  expect("openfoam/constant/turbulenceProperties", "RASModel        kEpsilon;");
  expect("openfoam/0/nut", "nutkWallFunction");
  assert_null(strstr(output, "Rough"));
  assert_null(strstr(output, "Spalding"));
  expect("openfoam/constant/MRFProperties", "omega               151.843645;");
  expect("openfoam/0/U", "volumetricFlowRate constant 0.00694444444;");
  expect("openfoam/transient/0/U", "movingWallVelocity");
}

static void rough_walls_take_the_roughness(void **state) {
  (void)state;
  export_with("s/treatment: smooth/treatment: rough/");
  expect("openfoam/0/nut", "nutkRoughWallFunction;\n        Ks              uniform 2.5e-05;");
}

static void resolved_walls_take_k_omega(void **state) {
  (void)state;
  export_with("s/y_plus_blade: 30/y_plus_blade: 1/");
  expect("openfoam/constant/turbulenceProperties", "RASModel        kOmegaSST;");
  expect("openfoam/0/nut", "blade_pressure\n    {\n        type            nutUSpaldingWallFunction;");
  expect("openfoam/0/nut", "volute\n    {\n        type            nutkWallFunction;");
}

// 5 % of 2 m/s: k = 1.5 * 0.1^2; l = 10 mm: epsilon = 0.09^0.75 * 0.015^1.5 / 0.01.
static void turbulence_follows_the_textbook(void **state) {
  (void)state;
  CwTurbulence t = cw_turbulence(2, 0.05, 0.01);
  assert_float_equal(t.k, 0.015, 1e-15);
  assert_float_equal(t.epsilon, 0.164316767 * 0.00183711731 / 0.01, 1e-9);
  assert_float_equal(t.omega, t.epsilon / (0.09 * 0.015), 1e-12);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_paper_in_cfx),
      cmocka_unit_test(log_layer_meshes_take_k_epsilon),
      cmocka_unit_test(rough_walls_take_the_roughness),
      cmocka_unit_test(resolved_walls_take_k_omega),
      cmocka_unit_test(turbulence_follows_the_textbook),
  };
  return cmocka_run_group_tests(tests, make_run, remove_run);
}
