// SPDX-License-Identifier: AGPL-3.0-or-later
// The numbers and groups of faces that code_saturne reads, of a pump of four zones.
#include "export/saturne_case.h"

#include "tests/export/pump_by_hand.h"

static PumpByHand pump;

static char *written(void) {
  assert_int_equal(cw_saturne_case_write(in_test_folder("code_saturne"), &pump.table, &pump.assembly), CW_OK);
  return read_whole(in_test_folder("code_saturne/SRC/pump.h"), NULL);
}

// What a macro stands for, up to the end of the line or the comment behind it.
static const char *macro(const char *text, const char *name) {
  static char value[500];
  char head[60];
  snprintf(head, sizeof head, "\n#define %s ", name);
  const char *from = strstr(text, head);
  if (!from) fail_msg("no macro %s in:\n%s", name, text);
  from += strlen(head);
  snprintf(value, sizeof value, "%.*s", (int)strcspn(from, "\n"), from);
  char *comment = strstr(value, " //");
  for (char *end = comment ? comment : value + strlen(value); end > value; --end) {
    *end = '\0';
    if (end[-1] != ' ') break;
  }
  return value;
}

static void patches_are_grouped_by_what_they_are(void **state) {
  static const char *const groups[][2] = {{"PUMP_ROTOR", "\"ROTOR or CHAMBER\""},
                                          {"PUMP_TURNING_WALLS", "\"hub or blade or disc or shaft_wall\""},
                                          {"PUMP_STANDING_WALLS", "\"ring\""},
                                          {"PUMP_SHAFTS", "\"shaft_wall\""},
                                          {"PUMP_SYMMETRIES", "\"middle\""},
                                          {"PUMP_INLETS", "\"inlet or feed\""},
                                          {"PUMP_OUTLET_GROUPS", "\"outlet or drain\""}};
  pump_by_hand(&pump);
  char *text = written();
  for (size_t i = 0; i < sizeof groups / sizeof *groups; ++i)
    assert_string_equal(macro(text, groups[i][0]), groups[i][1]);
  assert_non_null(strstr(text, " = {{\"outlet\", 0.75}, {\"drain\", 0.25}};"));
  assert_non_null(strstr(text, " = {\"suction_out or rotor_in\", \"rotor_out or stator_in\", \"rotor_gap or "
                               "chamber_gap\", \"rotor_leak or stator_leak\"};"));
  free(text);
}

// A group that no face has selects nothing: of a pump without zones and walls that turn, and without symmetry. The ring
// stands in no rotor then.
static void what_is_not_there_selects_nothing(void **state) {
  static const char *const groups[] = {"PUMP_ROTOR", "PUMP_TURNING_WALLS", "PUMP_STANDING_WALLS", "PUMP_SHAFTS",
                                       "PUMP_SYMMETRIES"};
  pump_by_hand(&pump);
  for (int d = 0; d < ZONES; ++d) pump.mesh.domains[d].rotating = 0;
  for (int p = 0; p < PATCHES; ++p) pump.patches[p].turns = 0;
  pump.parts[MIDDLE].faces = (CwFaceCount){0, 0};
  pump.parts[DRAIN].faces = (CwFaceCount){0, 0};
  char *text = written();
  for (size_t i = 0; i < sizeof groups / sizeof *groups; ++i)
    assert_string_equal(macro(text, groups[i]), "\"no_group[]\"");
  assert_non_null(strstr(text, " = {{\"outlet\", 0.75}};"));
  free(text);
}

// Patch p has an area of p + 1 m2, and an interface has two sides.
static void all_sides_of_interfaces_have_their_area(void **state) {
  pump_by_hand(&pump);
  double area = 0;
  for (int p = 0; p < PATCHES; ++p) area += pump.patches[p].kind == CW_PATCH_INTERFACE ? p + 1 : 0;
  char *text = written();
  assert_near(atof(macro(text, "PUMP_INTERFACE_AREA")), area, 1e-6);
  free(text);
}

// k = 3/2 (5 % of 2 m/s)^2; epsilon with a mixing length of 7 % of 0.07 m.
static void numbers_are_those_of_the_case(void **state) {
  const double k = 1.5 * 0.1 * 0.1, epsilon = pow(0.09, 0.75) * pow(k, 1.5) / (0.07 * 0.07);
  static const struct {
    const char *name;
    double value;
  } numbers[] = {{"PUMP_SPEED", 100},         {"PUMP_FLOW", 0.01},
                 {"PUMP_DENSITY", 800},       {"PUMP_KINEMATIC_VISCOSITY", 2e-6},
                 {"PUMP_PRESSURE", 90000},    {"PUMP_PASSAGE_SPEED", 9},
                 {"PUMP_PASSAGE_WIDTH", 0.01}};
  pump_by_hand(&pump);
  char *text = written();
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; ++i)
    assert_near(atof(macro(text, numbers[i].name)) / numbers[i].value, 1, 1e-8);
  assert_near(atof(macro(text, "PUMP_INLET_K")) / k, 1, 1e-8);
  assert_near(atof(macro(text, "PUMP_INLET_EPSILON")) / epsilon, 1, 1e-8);
  free(text);
}

// On rough walls OpenFOAM's law is u+ = ln(E y+ / (1 + Cs k+)) / kappa, which for large k+ is ln(E y / (Cs k)) / kappa;
// code_saturne's is ln((y + z) / z) / kappa, for y far above z ln(y / z) / kappa: one law where z = k Cs / E.
static void roughness_is_a_length_of_the_log_law(void **state) {
  const double e = 9.8, cs = 0.5, height = 49e-6;
  pump_by_hand(&pump);
  pump.table.walls = (CwWalls){.treatment = CW_WALL_FUNCTION_ROUGH, .roughness = height};
  char *text = written();
  const double z = atof(macro(text, "PUMP_ROUGHNESS"));
  for (double y = 1e-3; y < 1; y *= 10) assert_near(log(y / z), log(e * y / (cs * height)), 1e-8);
  free(text);
  pump.table.walls.treatment = CW_WALL_FUNCTION_SMOOTH;
  text = written();
  assert_string_equal(macro(text, "PUMP_ROUGHNESS"), "0");
  free(text);
  pump.table.walls.treatment = CW_WALL_FUNCTION_ROUGH; // laminar flow has no log law
  pump_by_hand_y_plus(&pump, NAN);
  text = written();
  assert_string_equal(macro(text, "PUMP_ROUGHNESS"), "0");
  free(text);
}

static void turbulence_follows_from_the_walls(void **state) {
  static const struct {
    double y_plus;
    const char *model;
  } models[] = {{30, "CS_TURB_K_EPSILON"}, {1, "CS_TURB_K_OMEGA"}, {NAN, "CS_TURB_NONE"}};
  pump_by_hand(&pump);
  for (int m = 0; m < 3; ++m) {
    pump_by_hand_y_plus(&pump, models[m].y_plus);
    char *text = written();
    assert_string_equal(macro(text, "PUMP_TURBULENCE"), models[m].model);
    free(text);
  }
  assert_int_equal(access(in_test_folder("code_saturne/run"), X_OK), 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(patches_are_grouped_by_what_they_are),    cmocka_unit_test(what_is_not_there_selects_nothing),
      cmocka_unit_test(all_sides_of_interfaces_have_their_area), cmocka_unit_test(numbers_are_those_of_the_case),
      cmocka_unit_test(roughness_is_a_length_of_the_log_law),    cmocka_unit_test(turbulence_follows_from_the_walls),
  };
  return cmocka_run_group_tests(tests, make_test_folder, clear_test_folder);
}
