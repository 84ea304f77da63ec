// SPDX-License-Identifier: AGPL-3.0-or-later
// What the numbers of a case become in the OpenFOAM and CFX files.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "export/cfx_case.h"
#include "export/fluent_case.h"
#include "export/foam_case.h"
#include "export/saturne_case.h"
#include "pipeline/atomic_file.h"
#include "tests/export/stage_run.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

static char output[STAGE_OUTPUT_SIZE];

static int make_run(void **state) {
  SyntheticPump pump = synthetic_pump();
  return make_test_folder(state) || stage_run_make(test_folder, &pump);
}

// Exports with the paper's case after a sed command.
static void export_with(const char *edit) {
  int code = stage_shell(output,
                         "cd '%s' && sed '%s' '%s/cases/paper/case.yaml' > case.yaml && "
                         "'%s/cutwater-export' --case case.yaml --run run",
                         test_folder, edit, CUTWATER_SOURCE_DIR, CUTWATER_BIN_DIR);
  if (code) fail_msg("%s", output);
}

static void expect(const char *name, const char *words) {
  assert_int_equal(stage_shell(output, "cat '%s/run/export/%s'", test_folder, name), 0);
  if (!strstr(output, words)) fail_msg("no '%s' in %s:\n%s", words, name, output);
}

// Where the flow along all walls is laminar no solver has a model of turbulence, a field of one or a wall function, and
// there are no eddies to be simulated.
static void laminar_walls_have_no_turbulence(void **state) {
  char run[STAGE_PATH_SIZE + 10];
  snprintf(run, sizeof run, "%s/run", test_folder);
  assert_int_equal(stage_walls_set(run, NULL, "null", output), 0);
  export_with("s/treatment: smooth/treatment: rough/; $ a export: {formats: [openfoam, code_saturne, fluent]}");
  assert_int_equal(stage_walls_set(run, NULL, "30.0", output), 0);
  expect("openfoam/constant/turbulenceProperties", "\nsimulationType  laminar;\n");
  assert_null(strstr(output, "RAS"));
  expect("openfoam/system/functions", "    fields          (U p);\n}\nleastPressure");
  expect("openfoam/README.md", "- Turbulence: none, the flow along all walls is laminar.\n");
  assert_null(strstr(output, "les/"));
  assert_int_not_equal(stage_shell(output, "test -e '%s/export/openfoam/les'", run), 0);
  stage_shell(output, "cd '%s/export/openfoam' && LC_ALL=C ls 0 transient/0 points/q0800/0", run);
  assert_string_equal(output, "0:\nU\np\n\npoints/q0800/0:\nU\np\n\ntransient/0:\nU\np\n");
  expect("code_saturne/SRC/pump.h", "#define PUMP_TURBULENCE CS_TURB_NONE\n");
  expect("code_saturne/SRC/pump.h", "#define PUMP_ROUGHNESS 0 ");
  expect("fluent/README.md", "- Turbulence: none, the flow is laminar.");
}

// The block of `file` that begins with `head` and ends with `end`, in `output`.
static void find_block(const char *file, const char *head, const char *end) {
  assert_int_equal(stage_shell(output, "cat '%s/run/export/%s'", test_folder, file), 0);
  char *from = strstr(output, head), *to = from ? strstr(from, end) : NULL;
  if (!to) fail_msg("no '%s' in %s:\n%s", head, file, output);
  to[strlen(end)] = '\0';
  memmove(output, from, strlen(from) + 1);
}

static void expect_in_block(const char *words) {
  if (!strstr(output, words)) fail_msg("no '%s' in:\n%s", words, output);
}

static void the_paper_in_cfx(void **state) {
  export_with("");
  expect("cfx/steady.ccl", "Angular Velocity = 1450 [rev min^-1]");
  expect("cfx/steady.ccl", "Mass Flow Rate = 6.93194444 [kg s^-1]"); // 25/3600 * 998.2
  expect("cfx/steady.ccl", "Sand Grain Roughness Height = 25 [micron]");
  expect("cfx/steady.ccl", "Reference Pressure = 101325 [Pa]");
  expect("cfx/steady.ccl", "Option = Frozen Rotor");
  expect("cfx/steady.ccl", "Location = suction_pipe\n");
  expect("cfx/transient.ccl", "Timesteps = 0.000114942529 [s]");      // 60/1450/360
  expect("cfx/transient.ccl", "      Start Iteration List = 1801\n"); // of 3600: behind five turns
  static const char each_turn[] = "      OUTPUT FREQUENCY:\n        Option = Timestep Interval\n"
                                  "        Timestep Interval = 360\n";
  find_block("cfx/transient.ccl", "    BACKUP RESULTS: ", "\n    END\n");
  expect_in_block("      Option = Standard\n");
  expect_in_block(each_turn);
  find_block("cfx/transient.ccl", "    TRANSIENT RESULTS: ", "\n    END\n");
  expect_in_block("      Output Variables List = Pressure,Velocity\n");
  expect_in_block(each_turn);
}

static void the_paper_in_code_saturne(void **state) {
  const char *const numbers = "code_saturne/SRC/pump.h";
  export_with("$ a export: {formats: code_saturne}");
  expect(numbers, "#define PUMP_TURBULENCE CS_TURB_K_EPSILON\n");
  expect(numbers, "#define PUMP_SPEED 151.843645 ");
  expect(numbers, "#define PUMP_FLOW 0.00694444444\n"); // 25/3600
  expect(numbers, "#define PUMP_ROUGHNESS 0 ");
  expect(numbers, "#define PUMP_ROTOR \"ROTOR\"\n");
  expect(numbers, "#define PUMP_STANDING_WALLS \"suction_pipe\" ");
  expect(numbers, "#define PUMP_SHAFTS \"no_group[]\" ");
  expect(numbers, " = {{\"outlet\", 1}};");
  expect(numbers, " = {\"rotor_interface or stator_interface\"};");
  assert_int_equal(stage_shell(output, "test -x '%s/run/export/code_saturne/run'", test_folder), 0);
  export_with("s/treatment: smooth/treatment: rough/; $ a export: {formats: code_saturne}");
  expect(numbers, "#define PUMP_ROUGHNESS 1.2755102e-06 "); // 25e-6 * 0.5/9.8
}

static void log_layer_meshes_take_k_epsilon(void **state) {
  export_with("");
  expect("openfoam/constant/turbulenceProperties", "RASModel        kEpsilon;");
  expect("openfoam/system/controlDict", "turbulenceFields;"); // omega for transient/
  expect("openfoam/transient/constant/turbulenceProperties", "RASModel        kOmegaSST;");
  expect("openfoam/0/nut", "nutkWallFunction");
  assert_null(strstr(output, "Rough"));
  assert_null(strstr(output, "Spalding"));
  expect("openfoam/constant/MRFProperties", "omega               151.843645;");
  expect("openfoam/0/U", "volumetricFlowRate constant 0.00694444444;");
  expect("openfoam/transient/0/U", "movingWallVelocity");
}

// One degree a step, six blades: a phase comes again after 60 steps. Larger steps become one degree.
static void eddies_are_sampled_by_phase(void **state) {
  export_with("");
  expect("openfoam/les/constant/turbulenceProperties", "delta           cubeRootVol;");
  const char *coefficients = strstr(output, "SmagorinskyCoeffs");
  double k = 0, e = 0;
  assert_non_null(coefficients);
  assert_int_equal(sscanf(strchr(coefficients, '{'), "{ Ck %lf; Ce %lf;", &k, &e), 2);
  assert_near(sqrt(k * sqrt(k / e)), 0.168, 5e-4); // nut = Ck delta^2 sqrt(2 Ck / Ce) |D| = (Cs delta)^2 |S|
  expect("openfoam/les/system/controlDict", "deltaT          0.000114942529;");
  expect("openfoam/les/system/les_functions", "executeInterval 60;");
  expect("openfoam/les/0/nut", "nutUSpaldingWallFunction");
  assert_int_not_equal(stage_shell(output, "test -e '%s/run/export/openfoam/les/0/k'", test_folder), 0);
  export_with("s/time_step_deg: 1 /time_step_deg: 7 /");
  expect("openfoam/les/system/controlDict", "deltaT          0.000114942529;");
  export_with("s/time_step_deg: 1 /time_step_deg: 0.35 /"); // 1029 steps a turn: no whole number a pitch
  expect("openfoam/les/system/les_functions", "executeInterval 1029;");
}

// The points of the curve: at 0.8 times the flow k at the inlet is 0.64 of what it is at the flow.
static void each_point_of_the_curve_has_its_flow(void **state) {
  export_with("$ a operating_points: {flow_shares: [0.8, 1]}");
  expect("cfx/points/q0800.ccl", "Mass Flow Rate = 5.54555556 [kg s^-1]"); // 0.8 * 25/3600 * 998.2
  expect("cfx/points/q0800.pre", "importccl filename=points/q0800.ccl,");
  expect("openfoam/points/q0800/0/U", "volumetricFlowRate constant 0.00555555556;");
  expect("openfoam/points/q0800/system/controlDict", "simpleFoam");
  assert_int_equal(stage_shell(output,
                               "cd '%s/run/export/openfoam' && cmp 0/U points/q1000/0/U && cmp 0/nut "
                               "points/q0800/0/nut && test points/q0800/constant -ef constant",
                               test_folder),
                   0);
  double k[2];
  for (int i = 0; i < 2; ++i) {
    expect(i ? "openfoam/points/q0800/0/k" : "openfoam/0/k", "inletValue");
    assert_int_equal(sscanf(strstr(output, "inletValue"), "inletValue uniform %lf", &k[i]), 1);
  }
  assert_near(k[1] / k[0], 0.64, 1e-6);
}

static void rough_walls_take_the_roughness(void **state) {
  export_with("s/treatment: smooth/treatment: rough/");
  expect("openfoam/0/nut", "nutkRoughWallFunction;\n        Ks              uniform 2.5e-05;");
}

// By the y+ that the mesh was made for, whatever the case asks.
static void resolved_walls_take_k_omega(void **state) {
  char run[STAGE_PATH_SIZE + 10];
  snprintf(run, sizeof run, "%s/run", test_folder);
  assert_int_equal(stage_walls_set(run, "blade_pressure", "1.0", output), 0);
  export_with("");
  assert_int_equal(stage_walls_set(run, NULL, "30.0", output), 0);
  expect("openfoam/constant/turbulenceProperties", "RASModel        kOmegaSST;");
  expect("openfoam/system/controlDict", "    #include \"functions\"\n}");
  expect("openfoam/0/nut", "blade_pressure\n    {\n        type            nutUSpaldingWallFunction;");
  expect("openfoam/0/nut", "volute\n    {\n        type            nutkWallFunction;");
  expect("openfoam/les/constant/turbulenceProperties", "delta           vanDriest;");
  expect("record.json", "\"turbulence_model\": \"k-omega SST\"");
  expect("record.json", "\"resolved_walls\": [\n      \"blade_pressure\"\n    ]");
}

// A ring-shaped suction zone stands still; of its walls the shaft turns with the impeller, the pipe does not.
enum { ROTOR, STATOR, SUCTION };
static CwModelPatch patches[] = {{.name = "hub", .kind = CW_PATCH_WALL, .domain = ROTOR, .turns = 1},
                                 {.name = "hub_shaft", .kind = CW_PATCH_WALL, .domain = ROTOR, .turns = 1},
                                 {.name = "suction_pipe", .kind = CW_PATCH_WALL, .domain = ROTOR},
                                 {.name = "rotor_interface", .kind = CW_PATCH_INTERFACE, .domain = ROTOR},
                                 {.name = "rotor_to_suction", .kind = CW_PATCH_INTERFACE, .domain = ROTOR},
                                 {.name = "rotor_gap", .kind = CW_PATCH_INTERFACE, .domain = ROTOR},
                                 {.name = "stator_interface", .kind = CW_PATCH_INTERFACE, .domain = STATOR},
                                 {.name = "stator_gap", .kind = CW_PATCH_INTERFACE, .domain = STATOR},
                                 {.name = "volute", .kind = CW_PATCH_WALL, .domain = STATOR},
                                 {.name = "outlet", .kind = CW_PATCH_OUTLET, .domain = STATOR, .flow_share = 0.25},
                                 {.name = "suction_to_rotor", .kind = CW_PATCH_INTERFACE, .domain = SUCTION},
                                 {.name = "inlet_pipe", .kind = CW_PATCH_WALL, .domain = SUCTION},
                                 {.name = "hub_shaft_pipe", .kind = CW_PATCH_WALL, .domain = SUCTION, .turns = 1},
                                 {.name = "inlet", .kind = CW_PATCH_INLET, .domain = SUCTION}};
static CwModelInterface interfaces[] = {
    {{3, 6}, CW_SURFACE_CYLINDER, 0.1}, {{4, 10}, CW_SURFACE_PLANE, 0}, {{7, 5}, CW_SURFACE_PLANE, 0}};
enum { PATCHES = sizeof patches / sizeof *patches };
static CwMesh mesh = {.domain_count = 3,
                      .domains = {{.name = "rotor", .zone = "ROTOR", .rotating = 1, .first_patch = 0, .patch_count = 6},
                                  {.name = "stator", .zone = "STATOR", .first_patch = 6, .patch_count = 4},
                                  {.name = "suction", .zone = "SUCTION", .first_patch = 10, .patch_count = 4}},
                      .interface_count = 3,
                      .interfaces = interfaces,
                      .patch_count = PATCHES,
                      .patches = patches,
                      .flow = {2, 0.07, 9, 0.01, 0.2, 6}};
static CwPatchPart parts[PATCHES];
static const CwAssembly assembly = {.mesh = &mesh, .patches = parts};
static const CwCase table = {
    .name = "shaft", .operating_point = {.speed = 100, .flow_rate = 0.01, .head = 10}, .fluid = {.density = 800}};

// The path of a format's folder, which `make` has filled.
static const char *written(const char *format, CwStatus (*make)(const char *, const CwCase *, const CwAssembly *)) {
  static char path[STAGE_PATH_SIZE + 60];
  for (int p = 0; p < PATCHES; ++p) parts[p] = (CwPatchPart){.faces.triangles = 1, .area = 1, .vector = {0, 0, 1}};
  snprintf(path, sizeof path, "%s/run/export/%s", test_folder, format);
  assert_int_equal(stage_shell(output, "rm -rf '%s'", path), 0);
  assert_int_equal(cw_make_directory(path), CW_OK);
  assert_int_equal(make(path, &table, &assembly), CW_OK);
  return path;
}

static void the_shaft_in_a_suction_zone_turns(void **state) {
  const char *path = written("cfx", cw_cfx_case_write);
  find_block("cfx/steady.ccl", "BOUNDARY: suction walls", "\n    END\n");
  expect_in_block("Location = inlet_pipe\n");
  assert_null(strstr(output, "Rotating Wall"));
  find_block("cfx/steady.ccl", "BOUNDARY: shaft", "\n    END\n");
  expect_in_block("Location = hub_shaft_pipe\n");
  expect_in_block("Option = Rotating Wall\n");
  expect_in_block("Angular Velocity = 954.929659 [rev min^-1]\n"); // 100 rad/s
  expect_in_block("Rotation Axis = Coord 0.3\n");
  // The frame of the rotor turns already: there a shaft is one of the walls at rest in it.
  assert_int_equal(stage_shell(output, "grep -c 'Option = Rotating Wall' '%s/steady.ccl'", path), 0);
  assert_string_equal(output, "1\n");
  // CFX finds a boundary and an interface by its name, also where two zones meet twice.
  assert_int_equal(stage_shell(output, "grep -E 'BOUNDARY:|INTERFACE:' '%s/steady.ccl' | sort | uniq -d", path), 0);
  assert_string_equal(output, "");
  find_block("cfx/steady.ccl", "DOMAIN INTERFACE: STATOR ROTOR 2", "\n  END\n");
  expect_in_block("Boundary List1 = STATOR ROTOR 2 Side 1\n");
  expect_in_block("Interface Region List2 = rotor_gap\n");

  written("openfoam", cw_foam_case_write);
  static const char *const fields[] = {"openfoam/0/U", "openfoam/transient/0/U"};
  for (int i = 0; i < 2; ++i) {
    find_block(fields[i], "hub_shaft_pipe\n", "}\n");
    expect_in_block("rotatingWallVelocity;");
    expect_in_block("omega           100;");
    find_block(fields[i], "    hub_shaft\n", "}\n");
    expect_in_block(i ? "movingWallVelocity;" : "fixedValue;");
    find_block(fields[i], "inlet_pipe\n", "}\n");
    expect_in_block("noSlip;");
  }
}

// A rotor and a chamber behind it that turns with it, which have one frame; an inlet in a zone that rotates, and one in
// another.
static void frames_are_told_where_zones_rotate(void **state) {
  enum { ROTOR, CHAMBER, STATOR };
  CwModelPatch patches[] = {{.name = "inlet", .kind = CW_PATCH_INLET, .domain = ROTOR},
                            {.name = "hub", .kind = CW_PATCH_WALL, .domain = ROTOR, .turns = 1},
                            {.name = "rotor_gap", .kind = CW_PATCH_INTERFACE, .domain = ROTOR},
                            {.name = "rotor_interface", .kind = CW_PATCH_INTERFACE, .domain = ROTOR},
                            {.name = "chamber_gap", .kind = CW_PATCH_INTERFACE, .domain = CHAMBER},
                            {.name = "disc", .kind = CW_PATCH_WALL, .domain = CHAMBER, .turns = 1},
                            {.name = "stator_interface", .kind = CW_PATCH_INTERFACE, .domain = STATOR},
                            {.name = "outlet", .kind = CW_PATCH_OUTLET, .domain = STATOR, .flow_share = 1},
                            {.name = "feed", .kind = CW_PATCH_INLET, .domain = STATOR}};
  CwModelInterface interfaces[] = {{{2, 4}, CW_SURFACE_PLANE, 0}, {{3, 6}, CW_SURFACE_CYLINDER, 0.1}};
  enum { PATCHES = sizeof patches / sizeof *patches };
  CwMesh mesh = {.domain_count = 3,
                 .domains = {{.name = "rotor", .zone = "ROTOR", .rotating = 1, .first_patch = 0, .patch_count = 4},
                             {.name = "chamber", .zone = "CHAMBER", .rotating = 1, .first_patch = 4, .patch_count = 2},
                             {.name = "stator", .zone = "STATOR", .first_patch = 6, .patch_count = 3}},
                 .interface_count = 2,
                 .interfaces = interfaces,
                 .patch_count = PATCHES,
                 .patches = patches};
  CwPatchPart parts[PATCHES];
  for (int p = 0; p < PATCHES; ++p) parts[p] = (CwPatchPart){.faces.triangles = 1, .area = 1, .vector = {0, 0, 1}};
  const CwAssembly assembly = {.mesh = &mesh, .patches = parts};
  const CwCase table = {.name = "chamber",
                        .operating_point = {.speed = 100, .flow_rate = 0.01, .time_step_angle = 0.1}};
  const char *folder = in_test_folder("run/export/cfx");
  assert_int_equal(cw_make_directory(folder), CW_OK);
  assert_int_equal(cw_cfx_case_write(folder, &table, &assembly), CW_OK);
  find_block("cfx/steady.ccl", "BOUNDARY: inlet\n", "\n    END\n"); // in the rotor
  expect_in_block("      Frame Type = Stationary\n");
  expect_in_block("          Option = Stationary Frame Total Pressure\n");
  find_block("cfx/steady.ccl", "BOUNDARY: feed\n", "\n    END\n");
  expect_in_block("          Option = Total Pressure\n");
  assert_null(strstr(output, "Frame"));
  find_block("cfx/steady.ccl", "DOMAIN INTERFACE: ROTOR CHAMBER", "\n  END\n");
  expect_in_block("FRAME CHANGE:\n        Option = None\n");
  expect_in_block("PITCH CHANGE:\n        Option = None\n");
  find_block("cfx/steady.ccl", "DOMAIN INTERFACE: ROTOR STATOR", "\n  END\n");
  expect_in_block("FRAME CHANGE:\n        Option = Frozen Rotor\n");
  find_block("cfx/transient.ccl", "DOMAIN INTERFACE: ROTOR CHAMBER", "\n  END\n");
  expect_in_block("FRAME CHANGE:\n        Option = None\n");
  find_block("cfx/transient.ccl", "DOMAIN INTERFACE: ROTOR STATOR", "\n  END\n");
  expect_in_block("FRAME CHANGE:\n        Option = Transient Rotor Stator\n");
}

// A quarter of 0.01 m3/s leaves by the outlet, through 1 m2 along z: 2 kg/s of 800 kg/m3.
static void outlets_have_their_shares(void **state) {
  written("cfx", cw_cfx_case_write);
  find_block("cfx/steady.ccl", "BOUNDARY: outlet\n", "\n    END\n");
  expect_in_block("Mass Flow Rate = 2 [kg s^-1]\n");
  written("openfoam", cw_foam_case_write);
  find_block("openfoam/0/U", "    outlet\n", "}\n");
  expect_in_block("volumetricFlowRate constant 0.0025;");
  expect_in_block("uniform (0 0 0.0025);");
  written("fluent", cw_fluent_case_write);
  expect("fluent/README.md", "| outlet | pressure-outlet | target mass flow rate 2 kg/s |");
  written("code_saturne", cw_saturne_case_write);
  expect("code_saturne/SRC/pump.h", " = {{\"outlet\", 0.25}};");
}

static void a_wrong_number_of_ranks_is_told(void **state) {
  static const char *const scripts[] = {"Allrun", "transient/Allrun"};
  export_with("");
  for (int i = 0; i < 2; i++) {
    assert_int_equal(stage_shell(output, "'%s/run/export/openfoam/%s' two", test_folder, scripts[i]), 1);
    assert_string_equal(output, "Allrun: RANKS is 'two'; allowed: a number from 1 on\n");
    assert_int_equal(stage_shell(output, "'%s/run/export/openfoam/%s' 0", test_folder, scripts[i]), 1);
  }
}

// A run on two ranks that was stopped as it wrote its iteration 20, with stand-ins for the programs: it goes on
// from 10.
static void a_stopped_run_goes_on_where_all_parts_are_whole(void **state) {
  static const char called[] = "reconstructPar -time 20\nreconstructPar -time 10\n"
                               "foamDictionary -entry numberOfSubdomains -set 2 system/decomposeParDict\n"
                               "foamDictionary -entry coeffs/n -set (2 1 1) system/decomposeParDict\n"
                               "decomposePar -force -latestTime\n";
  export_with("");
  stage_shell(output,
              "cd '%s/run/export/openfoam' && mkdir -p bin processor0/10 processor0/20 processor1/10 && "
              "touch processor0/10/U processor0/20/U processor1/10/U && "
              "printf '%%s\n' '#!/bin/sh' 'echo \"${0##*/} $*\" >> called' "
              "'[ \"$1\" != -time ] || cp -r processor1/$2 .' > bin/mpirun && chmod +x bin/mpirun && "
              "for name in reconstructPar foamDictionary decomposePar; do ln -s mpirun bin/$name; done && "
              "{ PATH=\"$PWD/bin:$PATH\" ./Allrun 2 > told 2>&1; cat called; }",
              test_folder);
  if (strncmp(output, called, strlen(called)) != 0) fail_msg("%s", output);
  assert_int_equal(stage_shell(output, "cd '%s/run/export/openfoam' && test -e 10/U && test ! -e 20", test_folder), 0);
}

// A steady run, one in time from it by the case's own script, with a stand-in for the solver, and what another would
// leave: nothing of them stays, in a mesh that is whole and in a divided one.
static void a_clean_case_is_as_it_was_exported(void **state) {
  static const char *const edits[] = {"", "$ a openfoam: {processors: 2}"};
  for (int divided = 0; divided < 2; ++divided) {
    export_with(edits[divided]);
    int code = stage_shell(
        output,
        "rm -rf '%s/before' '%s/bin' && mkdir '%s/bin' && cd '%s/run/export/openfoam' && cp -a . '%s/before' && "
        "printf '#!/bin/sh\\nmkdir -p postProcessing/head processor0/0.01 0.01 && touch 0.01/U\\n' > "
        "'%s/bin/pimpleFoam' "
        "&& chmod +x '%s/bin/pimpleFoam' && ln -s pimpleFoam '%s/bin/mpirun' && mkdir -p 100 processor0/100 "
        "processor1/100 "
        "postProcessing les/0.02 && touch log.simpleFoam les/log.pimpleFoam && "
        "for at in . processor0 processor1; do printf 'internalField nonuniform\\nboundaryField\\n' > $at/100/U; done "
        "&& "
        "{ %s || ln -s ../../constant/polyMesh les/constant/polyMesh; } && { PATH='%s/bin':$PATH transient/Allrun; "
        "grep -q nonuniform transient/%s0/U; } && ./Allclean && diff -r --no-dereference '%s/before' .",
        test_folder, test_folder, test_folder, test_folder, test_folder, test_folder, test_folder, test_folder,
        divided ? "true" : "false", test_folder, divided ? "processor1/" : "", test_folder);
    if (code) fail_msg("%s", output);
  }
}

// A second run from iteration 0, whose reports OpenFOAM writes beside those of the first, and a third, without any yet.
static void the_summary_is_of_the_last_report(void **state) {
  static const char *const told[] = {"time or iteration    20\n", "head                 5.0000 m",
                                     "torque         7.0000 N m",
                                     "  hub                             2          4          8\n"};
  export_with("");
  assert_int_equal(
      stage_shell(output,
                  "cd '%s/run/export/openfoam' && for of in head/fieldValueDelta torque/moment yPlus/yPlus "
                  "flowInlet/surfaceFieldValue flowOutlet/surfaceFieldValue flowRotorInterface/surfaceFieldValue "
                  "flowStatorInterface/surfaceFieldValue; do at=postProcessing/${of%%/*} && mkdir -p $at/0 $at/20 && "
                  "printf '# Time\\n10 (1 2 -3)\\n' > $at/0/${of#*/}.dat && touch -d '2 minutes ago' $at/0/*.dat && "
                  "printf '# Time\\n20 (5 6 -7)\\n' > $at/0/${of#*/}_0.dat && touch -d '1 minute ago' $at/0/*_0.dat && "
                  "echo '# Time' > $at/20/${of#*/}.dat || exit 1; done; "
                  "printf '# Time\\n20 hub 2 8 4\\n' > postProcessing/yPlus/0/yPlus_0.dat && ./summary",
                  test_folder),
      0);
  for (size_t i = 0; i < sizeof told / sizeof *told; ++i)
    if (!strstr(output, told[i])) fail_msg("no '%s' in:\n%s", told[i], output);
}

static void large_meshes_take_all_cores(void **state) {
  assert_string_equal(cw_foam_usual_ranks(20000000), "1");
  assert_string_equal(cw_foam_usual_ranks(20000001), "$(nproc)");
  export_with("");
  expect("openfoam/run_solver.sh", "\nusual_ranks=1 #");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_paper_in_cfx),
      cmocka_unit_test(the_paper_in_code_saturne),
      cmocka_unit_test(log_layer_meshes_take_k_epsilon),
      cmocka_unit_test(eddies_are_sampled_by_phase),
      cmocka_unit_test(each_point_of_the_curve_has_its_flow),
      cmocka_unit_test(rough_walls_take_the_roughness),
      cmocka_unit_test(resolved_walls_take_k_omega),
      cmocka_unit_test(laminar_walls_have_no_turbulence),
      cmocka_unit_test(the_shaft_in_a_suction_zone_turns),
      cmocka_unit_test(frames_are_told_where_zones_rotate),
      cmocka_unit_test(outlets_have_their_shares),
      cmocka_unit_test(a_wrong_number_of_ranks_is_told),
      cmocka_unit_test(a_stopped_run_goes_on_where_all_parts_are_whole),
      cmocka_unit_test(a_clean_case_is_as_it_was_exported),
      cmocka_unit_test(the_summary_is_of_the_last_report),
      cmocka_unit_test(large_meshes_take_all_cores),
  };
  return cmocka_run_group_tests(tests, make_run, clear_test_folder);
}
