// SPDX-License-Identifier: AGPL-3.0-or-later
// The start fields and folders of an OpenFOAM case, of a pump of four zones.
#include "export/foam_case.h"

#include <sys/stat.h>

#include "tests/export/pump_by_hand.h"

static PumpByHand pump;

// Into an empty folder: links are not made twice.
static void write_case(void) {
  if (access(in_test_folder("foam"), F_OK) == 0) assert_int_equal(remove_folder(in_test_folder("foam")), 0);
  assert_int_equal(cw_foam_case_write(in_test_folder("foam"), &pump.table, &pump.assembly), CW_OK);
}

// A file of the case; the caller frees it.
static char *text_of(const char *name) {
  char path[100];
  snprintf(path, sizeof path, "foam/%s", name);
  return read_whole(in_test_folder(path), NULL);
}

static int is_there(const char *name) {
  char path[100];
  snprintf(path, sizeof path, "foam/%s", name);
  return access(in_test_folder(path), F_OK) == 0;
}

// What a field says of a patch; NULL: nothing.
static const char *entry(const char *text, const char *patch) {
  char head[60];
  snprintf(head, sizeof head, "\n    %s\n    {\n", patch);
  return block_of(text, head, "    }\n");
}

// Of a field of the case: that the patch has the words.
static void assert_entry(const char *name, int patch, const char *words) {
  char *text = text_of(name);
  const char *of = entry(text, pump.patches[patch].name);
  if (!of || !strstr(of, words))
    fail_msg("%s: no '%s' of %s: %s", name, words, pump.patches[patch].name, of ? of : "-");
  free(text);
}

// The number behind the words in an entry, or NAN.
static double number_in(const char *name, int patch, const char *words) {
  char *text = text_of(name);
  const char *of = entry(text, pump.patches[patch].name), *at = of ? strstr(of, words) : NULL;
  const double value = at ? atof(at + strlen(words)) : NAN;
  free(text);
  return value;
}

static double inside(const char *name) {
  char *text = text_of(name);
  const char *words = "\ninternalField   uniform ", *at = strstr(text, words);
  const double value = at ? atof(at + strlen(words)) : NAN;
  free(text);
  return value;
}

// Every field that is there has an entry for each patch with faces, once, and none for the lid.
static void fields_have_all_patches(void **state) {
  static const char *const names[] = {"0/U",     "0/p",           "0/k",           "0/epsilon",       "0/omega",
                                      "0/nut",   "transient/0/U", "transient/0/p", "transient/0/nut", "les/0/U",
                                      "les/0/p", "les/0/nut",     "transient/0/k", "points/q0600/0/U"};
  pump_by_hand(&pump);
  write_case();
  for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
    char *text = text_of(names[i]), head[60];
    for (int p = 0; p < PATCHES; ++p) {
      snprintf(head, sizeof head, "\n    %s\n    {\n", pump.patches[p].name);
      assert_int_equal(count_of(text, head), p != LID);
    }
    assert_int_equal(count_of(text, "    {\n"), PATCHES - 1);
    assert_int_equal(count_of(text, "cyclicAMI;"), 2 * INTERFACES);
    assert_int_equal(count_of(text, " symmetry;"), 1);
    free(text);
  }
  assert_entry("0/U", MIDDLE, " symmetry;");
  assert_entry("0/nut", MIDDLE, " symmetry;");
  // Large eddies transport nothing.
  assert_false(is_there("les/0/k") || is_there("les/0/epsilon") || is_there("les/0/omega"));
}

// The ring stands still in the rotor's zone, the shaft turns outside of it. 0.0075 m3/s leave through the 2 m2 of the
// outlet, along (0.6, 0, 0.8).
static void velocities_are_those_of_the_walls(void **state) {
  pump_by_hand(&pump);
  pump.parts[OUTLET] = (CwPatchPart){.faces = {2, 0}, .area = 2, .vector = {1.2, 0, 1.6}};
  write_case();
  for (int transient = 0; transient < 2; ++transient) {
    const char *u = transient ? "transient/0/U" : "0/U";
    const int turning[] = {HUB, BLADE, DISC}, standing[] = {RING, VOLUTE, TONGUE, PIPE};
    for (int i = 0; i < 3; ++i) assert_entry(u, turning[i], transient ? " movingWallVelocity;" : " fixedValue;");
    for (int i = 0; i < 4; ++i) assert_entry(u, standing[i], " noSlip;");
    assert_entry(u, SHAFT, " rotatingWallVelocity;");
    assert_entry(u, SHAFT, "        omega           100;\n");
    assert_entry(u, INLET, " pressureInletOutletVelocity;");
    assert_entry(u, FEED, " pressureInletOutletVelocity;");
    assert_entry(u, OUTLET, " flowRateOutletVelocity;");
    assert_entry(u, OUTLET, "volumetricFlowRate constant 0.0075;");
    assert_entry(u, OUTLET, "uniform (0.00225 0 0.003);");
    assert_entry(u, DRAIN, "volumetricFlowRate constant 0.0025;");
  }
  assert_entry("0/p", INLET, " totalPressure;\n        p0              uniform 0;");
  assert_entry("0/p", OUTLET, " zeroGradient;");
  assert_entry("0/p", VOLUTE, " zeroGradient;");
}

// k = 3/2 (I U)^2, epsilon = Cmu^0.75 k^1.5 / l, omega = epsilon / (Cmu k) with I = 0.05 and l = 0.07 d; of the inlet U
// is 2 m/s and d 0.07 m, inside 9 m/s and 0.01 m. At half the flow the inlet's speed is half, that inside is a guess
// and stays.
static void turbulence_is_that_of_inlet_and_passage(void **state) {
  static const char *const names[] = {"k", "epsilon", "omega"};
  static const char *const walls[] = {" kqRWallFunction;", " epsilonWallFunction;", " omegaWallFunction;"};
  char path[40];
  pump_by_hand(&pump);
  pump.table.operating_points.flow_rates = (CwList){1, {0.005}};
  write_case();
  for (int half = 0; half < 2; ++half) {
    double wanted[2][3]; // at the inlet, inside; of each field
    for (int in = 0; in < 2; ++in) {
      const double speed = in ? 9 : half ? 1 : 2, width = in ? 0.01 : 0.07;
      const double k = 1.5 * 0.05 * speed * 0.05 * speed, e = pow(0.09, 0.75) * pow(k, 1.5) / (0.07 * width);
      memcpy(wanted[in], (double[]){k, e, e / (0.09 * k)}, sizeof wanted[in]);
    }
    for (int f = 0; f < 3; ++f) {
      snprintf(path, sizeof path, "%s0/%s", half ? "points/q0500/" : "", names[f]);
      assert_near(inside(path) / wanted[1][f], 1, 1e-8);
      for (int i = 0; i < 2; ++i) {
        const int end = i ? DRAIN : FEED;
        assert_entry(path, end, " inletOutlet;");
        assert_near(number_in(path, end, "inletValue      uniform ") / wanted[0][f], 1, 1e-8);
        assert_near(number_in(path, end, "\n        value           uniform ") / wanted[0][f], 1, 1e-8);
      }
      assert_entry(path, BLADE, walls[f]);
      assert_near(number_in(path, BLADE, "value           uniform ") / wanted[1][f], 1, 1e-8);
      assert_near(number_in(path, STATOR_IN, "value           uniform ") / wanted[1][f], 1, 1e-8);
    }
  }
  assert_near(number_in("points/q0500/0/U", OUTLET, "volumetricFlowRate constant "), 0.00375, 1e-12);
}

// By the y+ of each wall, whatever that of another is; rough where the case says so; of eddies one law for all y+.
static void viscosity_has_the_wall_function(void **state) {
  pump_by_hand(&pump);
  pump.patches[BLADE].y_plus = 1;
  write_case();
  assert_entry("0/nut", BLADE, " nutUSpaldingWallFunction;");
  assert_entry("0/nut", HUB, " nutkWallFunction;");
  assert_entry("0/nut", INLET, " calculated;");
  assert_entry("0/nut", OUTLET, " calculated;");
  assert_entry("les/0/nut", HUB, " nutUSpaldingWallFunction;");
  pump.table.walls = (CwWalls){.treatment = CW_WALL_FUNCTION_ROUGH, .roughness = 40e-6};
  write_case();
  assert_entry("0/nut", BLADE, " nutUSpaldingWallFunction;");
  assert_entry("0/nut", HUB, " nutkRoughWallFunction;\n        Ks              uniform 4e-05;\n        Cs      ");
  assert_entry("transient/0/nut", HUB, " nutkRoughWallFunction;");
  assert_entry("les/0/nut", HUB, " nutUSpaldingWallFunction;");
}

// Which model the walls lead to, and that laminar flow has no field of turbulence and no eddies.
static void the_model_follows_from_the_walls(void **state) {
  static const struct {
    double y_plus;
    const char *model, *delta;
    int has_omega_function;
  } models[] = {{30, "    RASModel        kEpsilon;", "cubeRootVol", 1},
                {1, "    RASModel        kOmegaSST;", "vanDriest", 0}};
  char words[60];
  for (int m = 0; m < 2; ++m) {
    pump_by_hand(&pump);
    pump_by_hand_y_plus(&pump, models[m].y_plus);
    write_case();
    char *turbulence = text_of("constant/turbulenceProperties"), *les = text_of("les/constant/turbulenceProperties"),
         *control = text_of("system/controlDict");
    assert_non_null(strstr(turbulence, models[m].model));
    snprintf(words, sizeof words, "delta           %s;", models[m].delta);
    assert_non_null(strstr(les, words));
    assert_int_equal(strstr(control, "turbulenceFields;") != NULL, models[m].has_omega_function);
    free(control);
    free(les);
    free(turbulence);
  }
  pump_by_hand_y_plus(&pump, NAN);
  write_case();
  char *text = text_of("constant/turbulenceProperties");
  assert_non_null(strstr(text, "simulationType  laminar;"));
  free(text);
  assert_true(is_there("0/U") && is_there("0/p") && is_there("transient/0/U"));
  assert_false(is_there("0/k") || is_there("0/nut") || is_there("0/omega") || is_there("0/epsilon") || is_there("les"));
}

// Steps are of a degree at the most; a phase is a pitch where that is a whole number of steps, else a turn.
static void eddies_come_again_with_the_blades(void **state) {
  static const struct {
    double step_deg;
    int blades, steps, phase;
  } turns[] = {{1.8, 5, 360, 72}, {1.8, 7, 360, 360}, {0.5, 5, 720, 144}, {0.5, 7, 720, 720}, {0.5, 1, 720, 720}};
  char words[60];
  for (size_t i = 0; i < sizeof turns / sizeof *turns; ++i) {
    pump_by_hand(&pump);
    pump.table.operating_point.time_step_angle = turns[i].step_deg * M_PI / 180;
    pump.mesh.flow.blade_count = turns[i].blades;
    write_case();
    char *control = text_of("les/system/controlDict"), *functions = text_of("les/system/les_functions");
    const double step = atof(block_of(control, "\ndeltaT          ", ";"));
    assert_near(step * turns[i].steps, 2 * M_PI / 100, 1e-9);
    assert_near(atof(block_of(control, "\nendTime         ", ";")), 2 * M_PI / 100, 1e-9);
    snprintf(words, sizeof words, "    executeInterval %d;", turns[i].phase);
    assert_non_null(strstr(functions, words));
    assert_non_null(strstr(functions, "(blade);"));
    assert_int_equal(count_of(functions, "\npressure_tongue\n"), 1);
    assert_int_equal(count_of(functions, "\npressure_"), 2); // and that of the outlet
    free(functions);
    free(control);
  }
}

static void turning_walls_have_a_torque(void **state) {
  pump_by_hand(&pump);
  write_case();
  char *text = text_of("system/functions");
  assert_non_null(strstr(text, "    patches         (hub blade disc shaft_wall);"));
  free(text);
}

static int same_place(const char *a, const char *b) {
  struct stat of[2];
  char path[100];
  for (int k = 0; k < 2; ++k) {
    snprintf(path, sizeof path, "foam/%s", k ? b : a);
    if (stat(in_test_folder(path), &of[k]) != 0) return 0;
  }
  return of[0].st_ino == of[1].st_ino;
}

// Each part of a divided mesh has the start fields of its case and the mesh of the steady one, in all cases on it.
static void parts_share_mesh_and_start(void **state) {
  static const char *const cases[] = {"", "transient/", "les/", "points/q0600/", "points/q1200/"};
  pump_by_hand(&pump);
  pump.table.output.foam_processors = 3;
  write_case();
  for (int p = 0; p < 3; ++p) {
    char path[100], own[60], mesh[60];
    snprintf(mesh, sizeof mesh, "processor%d/constant", p);
    snprintf(path, sizeof path, "foam/%s", mesh);
    assert_int_equal(mkdir(in_test_folder(path), 0777), 0); // the mesh comes later
    for (int c = 0; c < 5; ++c) {
      snprintf(path, sizeof path, "%sprocessor%d/0", cases[c], p);
      snprintf(own, sizeof own, "%s0", cases[c]);
      assert_true(same_place(path, own));
      snprintf(path, sizeof path, "%sprocessor%d/constant", cases[c], p);
      assert_true(same_place(path, mesh));
    }
  }
  assert_false(is_there("processor3"));
  static const char *const groups[][2] = {{"0/U", "uniform (0 0 0);"}, {"0/p", "uniform 0;"}};
  for (int f = 0; f < 2; ++f) {
    char *text = text_of(groups[f][0]);
    const char *of = entry(text, "processor");
    assert_non_null(of);
    assert_non_null(strstr(of, groups[f][1]));
    free(text);
  }
  char *text = text_of("system/decomposeParDict");
  assert_non_null(strstr(text, "numberOfSubdomains  3;"));
  free(text);
}

// A whole mesh has no parts; the points of the curve use all but the fields of the case.
static void points_share_the_case(void **state) {
  static const char *const shared[] = {"constant", "system", "Allrun", "run_solver.sh", "Allclean", "summary"};
  pump_by_hand(&pump);
  write_case();
  for (size_t i = 0; i < sizeof shared / sizeof *shared; ++i) {
    char path[60];
    snprintf(path, sizeof path, "points/q0800/%s", shared[i]);
    assert_true(same_place(path, shared[i]));
  }
  assert_false(same_place("points/q0800/0", "0"));
  assert_false(is_there("processor0") || is_there("points/q0800/processor0"));
  char *text = text_of("0/U");
  assert_null(entry(text, "processor"));
  free(text);
}

static void releases_have_their_keywords(void **state) {
  static const struct {
    CwFoamRelease release;
    const char *version, *method;
  } releases[] = {{CW_FOAM_V1912, "v1912", "hierarchical"}, {CW_FOAM_V2406, "v2406", "scotch"}};
  for (int i = 0; i < 2; ++i) {
    pump_by_hand(&pump);
    pump.table.output.foam_release = releases[i].release;
    write_case();
    char *readme = text_of("README.md"), *division = text_of("system/decomposeParDict"), words[60];
    snprintf(words, sizeof words, "Written for OpenFOAM %s ", releases[i].version);
    assert_non_null(strstr(readme, words));
    assert_int_equal(strstr(readme, "has not been run with it") != NULL, i);
    snprintf(words, sizeof words, "\nmethod              %s;", releases[i].method);
    assert_non_null(strstr(division, words));
    assert_non_null(strstr(division, "numberOfSubdomains  2;"));
    free(division);
    free(readme);
  }
}

static void large_meshes_take_all_cores(void **state) {
  for (int large = 0; large < 2; ++large) {
    pump_by_hand(&pump);
    pump.assembly.totals[ROTOR].cells = 15000000;
    pump.assembly.totals[STATOR].cells = 5000000 + large; // together
    write_case();
    char *text = text_of("run_solver.sh");
    assert_non_null(strstr(text, large ? "\nusual_ranks=$(nproc) " : "\nusual_ranks=1 "));
    free(text);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(fields_have_all_patches),
      cmocka_unit_test(velocities_are_those_of_the_walls),
      cmocka_unit_test(turbulence_is_that_of_inlet_and_passage),
      cmocka_unit_test(viscosity_has_the_wall_function),
      cmocka_unit_test(the_model_follows_from_the_walls),
      cmocka_unit_test(eddies_come_again_with_the_blades),
      cmocka_unit_test(turning_walls_have_a_torque),
      cmocka_unit_test(parts_share_mesh_and_start),
      cmocka_unit_test(points_share_the_case),
      cmocka_unit_test(releases_have_their_keywords),
      cmocka_unit_test(large_meshes_take_all_cores),
  };
  return cmocka_run_group_tests(tests, make_test_folder, clear_test_folder);
}
