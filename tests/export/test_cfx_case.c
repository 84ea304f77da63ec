// SPDX-License-Identifier: AGPL-3.0-or-later
// The command files of a pump of four zones: each patch has its boundary, and the expressions are the pump's figures.
#include "export/cfx_case.h"

#include "tests/export/pump_by_hand.h"

static PumpByHand pump;

// A file that the case has written; the caller frees it.
static char *written(const char *name) {
  assert_int_equal(cw_cfx_case_write(in_test_folder("cfx"), &pump.table, &pump.assembly), CW_OK);
  return read_whole(in_test_folder(name), NULL);
}

// Of each patch the boundary in which it lies, its zone, and words in it.
static const struct {
  int patch;
  const char *zone, *boundary, *words[2];
} wanted[] = {
    {HUB, "ROTOR", "impeller", {"Boundary Type = WALL\n", "Frame Type = Rotating\n"}},
    {BLADE, "ROTOR", "impeller", {"Boundary Type = WALL\n", "Frame Type = Rotating\n"}},
    {RING, "ROTOR", "rotor fixed walls", {"Frame Type = Rotating\n", "Option = Counter Rotating Wall\n"}},
    {ROTOR_IN, "ROTOR", "SUCTION ROTOR Side 2", {"Boundary Type = INTERFACE\n", ""}},
    {ROTOR_OUT, "ROTOR", "ROTOR STATOR Side 1", {"Boundary Type = INTERFACE\n", ""}},
    {ROTOR_GAP, "ROTOR", "ROTOR CHAMBER Side 1", {"Boundary Type = INTERFACE\n", ""}},
    {ROTOR_LEAK, "ROTOR", "ROTOR STATOR 2 Side 1", {"Boundary Type = INTERFACE\n", ""}},
    {DISC, "CHAMBER", "chamber impeller", {"Boundary Type = WALL\n", "Frame Type = Rotating\n"}},
    {CHAMBER_GAP, "CHAMBER", "ROTOR CHAMBER Side 2", {"Boundary Type = INTERFACE\n", ""}},
    {STATOR_IN, "STATOR", "ROTOR STATOR Side 2", {"Boundary Type = INTERFACE\n", ""}},
    {STATOR_LEAK, "STATOR", "ROTOR STATOR 2 Side 2", {"Boundary Type = INTERFACE\n", ""}},
    {VOLUTE, "STATOR", "casing", {"Boundary Type = WALL\n", "Option = No Slip Wall\n"}},
    {TONGUE, "STATOR", "casing", {"Boundary Type = WALL\n", "Option = No Slip Wall\n"}},
    {OUTLET, "STATOR", "outlet", {"Boundary Type = OUTLET\n", "Mass Flow Rate = 6 [kg s^-1]\n"}}, // 3/4 of 8 kg/s
    {DRAIN, "STATOR", "drain", {"Boundary Type = OUTLET\n", "Mass Flow Rate = 2 [kg s^-1]\n"}},
    {MIDDLE, "STATOR", "middle", {"Boundary Type = SYMMETRY\n", ""}},
    {SUCTION_OUT, "SUCTION", "SUCTION ROTOR Side 1", {"Boundary Type = INTERFACE\n", ""}},
    {PIPE, "SUCTION", "suction walls", {"Boundary Type = WALL\n", "Option = No Slip Wall\n"}},
    {SHAFT, "SUCTION", "shaft", {"Option = Rotating Wall\n", "Angular Velocity = 954.929659 [rev min^-1]\n"}},
    {INLET, "SUCTION", "inlet", {"Boundary Type = INLET\n", "Option = Total Pressure\n"}},
    {FEED, "SUCTION", "feed", {"Boundary Type = INLET\n", "Option = Total Pressure\n"}}};
enum { WANTED = sizeof wanted / sizeof *wanted };

// Whether a list with commas has the word.
static int is_listed(const char *list, const char *word) {
  char all[600], one[100];
  snprintf(all, sizeof all, ",%s,", list);
  snprintf(one, sizeof one, ",%s,", word);
  return strstr(all, one) != NULL;
}

static void every_patch_has_its_boundary(void **state) {
  pump_by_hand(&pump);
  char *text = written("cfx/steady.ccl");
  int named[PATCHES] = {0}, boundaries = 0;
  for (const char *at = text; (at = strstr(at, "    BOUNDARY: ")); ++at, ++boundaries) {
    char name[100], zone[100] = "", location[500];
    const char *end = strstr(at, "\n    END\n"), *place = strstr(at, "      Location = ");
    assert_true(place && end && place < end);
    assert_int_equal(sscanf(at, "    BOUNDARY: %99[^\n]", name), 1);
    assert_int_equal(sscanf(place, "      Location = %499[^\n]", location), 1);
    for (const char *domain = text; (domain = strstr(domain, "\n  DOMAIN: ")) && domain < at; ++domain)
      assert_int_equal(sscanf(domain, "\n  DOMAIN: %99[^\n]", zone), 1);
    assert_false(is_listed(location, "lid"));
    for (int w = 0; w < WANTED; ++w) {
      if (!is_listed(location, pump.patches[wanted[w].patch].name)) continue;
      named[wanted[w].patch]++;
      assert_string_equal(name, wanted[w].boundary);
      assert_string_equal(zone, wanted[w].zone);
      for (int k = 0; k < 2; ++k) assert_block(at, "BOUNDARY: ", "\n    END\n", wanted[w].words[k]);
    }
    const char *block = block_of(at, "BOUNDARY: ", "\n    END\n"); // zones at rest have no frame
    if (!strcmp(zone, "STATOR") || !strcmp(zone, "SUCTION")) assert_null(strstr(block, "Frame Type"));
    const int moves = !strcmp(name, "shaft") || !strcmp(name, "rotor fixed walls");
    assert_int_equal(strstr(block, "WALL VELOCITY:") != NULL, moves);
  }
  for (int p = 0; p < PATCHES; ++p) assert_int_equal(named[p], p != LID);
  assert_int_equal(boundaries, WANTED - 2); // impeller and casing have two patches each
  free(text);
}

// Of the four interfaces two are between zones that turn and zones that stand, and one is the second of its zones.
static void interfaces_know_their_frames(void **state) {
  static const struct {
    const char *name, *a, *b, *patch[2];
    int turns;
  } sides[] = {{"SUCTION ROTOR", "SUCTION", "ROTOR", {"suction_out", "rotor_in"}, 1},
               {"ROTOR STATOR", "ROTOR", "STATOR", {"rotor_out", "stator_in"}, 1},
               {"ROTOR CHAMBER", "ROTOR", "CHAMBER", {"rotor_gap", "chamber_gap"}, 0},
               {"ROTOR STATOR 2", "ROTOR", "STATOR", {"rotor_leak", "stator_leak"}, 1}};
  pump_by_hand(&pump);
  for (int transient = 0; transient < 2; ++transient) {
    char *text = written(transient ? "cfx/transient.ccl" : "cfx/steady.ccl"), head[100], words[400];
    assert_int_equal(count_of(text, "DOMAIN INTERFACE: "), INTERFACES);
    for (int i = 0; i < INTERFACES; ++i) {
      snprintf(head, sizeof head, "  DOMAIN INTERFACE: %s\n", sides[i].name);
      snprintf(words, sizeof words,
               "    Boundary List1 = %s Side 1\n    Boundary List2 = %s Side 2\n    Filter Domain List1 = %s\n"
               "    Filter Domain List2 = %s\n    Interface Region List1 = %s\n    Interface Region List2 = %s\n",
               sides[i].name, sides[i].name, sides[i].a, sides[i].b, sides[i].patch[0], sides[i].patch[1]);
      assert_block(text, head, "\n  END\n", words);
      snprintf(words, sizeof words, "FRAME CHANGE:\n        Option = %s\n",
               !sides[i].turns ? "None"
               : transient     ? "Transient Rotor Stator"
                               : "Frozen Rotor");
      assert_block(text, head, "\n  END\n", words);
      assert_block(text, head, "\n  END\n",
                   sides[i].turns ? "Pitch Angle Side1 = 360 [degree]\n" : "PITCH CHANGE:\n        Option = None\n");
    }
    free(text);
  }
}

// What the functions of an expression give at a boundary: total pressure (Pa), mass flow (kg/s), and torque (N m) of
// the walls on the water.
static const struct {
  const char *name;
  double pressure, flow, torque;
} solved[] = {{"inlet", 1000, 5, 0},   {"feed", 3000, 3, 0},           {"outlet", 90000, -6, 0},
              {"drain", 30000, -2, 0}, {"impeller", 0, 0, -20},        {"chamber impeller", 0, 0, -3},
              {"shaft", 0, 0, -0.5},   {"rotor fixed walls", 0, 0, 7}, {"casing", 0, 0, 11}};

// The value of a function at the place that stands behind the @, up to an operator; *at goes behind it.
static double at_place(const char **at, size_t quantity) {
  const size_t length = strcspn(*at, "+-*/()\n");
  char name[60];
  snprintf(name, sizeof name, "%.*s", (int)length, *at);
  for (size_t end = strlen(name); end > 0 && name[end - 1] == ' ';) name[--end] = '\0';
  *at += length;
  for (size_t i = 0; i < sizeof solved / sizeof *solved; ++i)
    if (!strcmp(solved[i].name, name)) return (&solved[i].pressure)[quantity];
  fail_msg("an expression names '%s'", name);
  return NAN;
}

static const char *expressions; // the block of them
static double value_of(const char *name);
static double sum_at(const char **at);

static double factor_at(const char **at) {
  static const char *const functions[] = {"massFlowAve(Total Pressure in Stn Frame)@", "massFlow()@", "torque_z()@"};
  static const char *const names[] = {"shaft torque", "shaft power", "head"};
  while (**at == ' ') ++*at;
  if (**at == '-') return ++*at, -factor_at(at);
  if (**at == '(') {
    ++*at;
    const double inner = sum_at(at);
    assert_int_equal(**at, ')');
    return ++*at, inner;
  }
  for (size_t f = 0; f < sizeof functions / sizeof *functions; ++f)
    if (!strncmp(*at, functions[f], strlen(functions[f]))) return *at += strlen(functions[f]), at_place(at, f);
  for (size_t n = 0; n < sizeof names / sizeof *names; ++n)
    if (!strncmp(*at, names[n], strlen(names[n]))) return *at += strlen(names[n]), value_of(names[n]);
  if (**at == 'g') return ++*at, CW_GRAVITY;
  char *end;
  double number = strtod(*at, &end);
  assert_true(end > *at);
  while (*end == ' ') ++end;
  if (*end == '[') {
    if (!strncmp(end, "[rev min^-1]", 12)) number *= 2 * M_PI / 60;
    end = strchr(end, ']') + 1;
  }
  return *at = end, number;
}

static double product_at(const char **at) {
  double product = factor_at(at);
  for (;;) {
    while (**at == ' ') ++*at;
    if (**at != '*' && **at != '/') return product;
    const int divides = *(*at)++ == '/';
    const double factor = factor_at(at);
    product = divides ? product / factor : product * factor;
  }
}

static double sum_at(const char **at) {
  double sum = product_at(at);
  while (**at == '+' || **at == '-') {
    const int minus = *(*at)++ == '-';
    sum += (minus ? -1 : 1) * product_at(at);
  }
  return sum;
}

static double value_of(const char *name) {
  char head[60];
  snprintf(head, sizeof head, "\n      %s = ", name);
  const char *at = strstr(expressions, head);
  if (!at) fail_msg("no expression %s", name);
  at += strlen(head);
  const double value = sum_at(&at);
  assert_int_equal(*at, '\n');
  return value;
}

// Total pressures are means weighed by the flow of all inlets and of all outlets; the torque on the water turns all
// three walls that turn, and no other.
static void expressions_are_the_figures_of_the_pump(void **state) {
  const double outlet = (90000 * 6 + 30000 * 2) / 8., inlet = (1000 * 5 + 3000 * 3) / 8., torque = 20 + 3 + 0.5;
  const double head = (outlet - inlet) / (800 * CW_GRAVITY);
  pump_by_hand(&pump);
  char *text = written("cfx/steady.ccl");
  expressions = text;
  assert_near(value_of("head"), head, 1e-9);
  assert_near(value_of("shaft torque"), torque, 1e-12);
  assert_near(value_of("shaft power"), torque * 100, 1e-5); // to the digits of the speed
  assert_near(value_of("hydraulic efficiency"), head * CW_GRAVITY * 8 / (torque * 100), 1e-7);
  free(text);
  // One inlet and one outlet; no wall turns.
  pump.patches[FEED].kind = pump.patches[DRAIN].kind = CW_PATCH_WALL;
  for (int p = 0; p < PATCHES; ++p) pump.patches[p].turns = 0;
  text = written("cfx/steady.ccl");
  expressions = text;
  assert_near(value_of("head"), 89000 / (800 * CW_GRAVITY), 1e-9);
  assert_near(value_of("shaft torque"), 0, 0);
  free(text);
}

// Mean and greatest y+ of each of the six boundaries of walls, each with its monitor.
static void each_boundary_of_walls_has_its_y_plus(void **state) {
  static const char *const walls[] = {"impeller", "rotor fixed walls", "chamber impeller", "casing",
                                      "shaft",    "suction walls"};
  static const char *const kinds[][2] = {{"mean", "areaAve"}, {"greatest", "maxVal"}};
  pump_by_hand(&pump);
  char *text = written("cfx/steady.ccl"), line[200];
  for (int w = 0; w < 6; ++w)
    for (int k = 0; k < 2; ++k) {
      snprintf(line, sizeof line, "\n      %s y plus of %s = %s(Yplus)@%s\n", kinds[k][0], walls[w], kinds[k][1],
               walls[w]);
      assert_int_equal(count_of(text, line), 1);
      snprintf(line, sizeof line,
               "\n      MONITOR POINT: %s y plus of %s\n        Expression Value = %s y plus of %s\n", kinds[k][0],
               walls[w], kinds[k][0], walls[w]);
      assert_int_equal(count_of(text, line), 1);
    }
  assert_int_equal(count_of(text, "(Yplus)@"), 12);
  free(text);
  pump_by_hand_y_plus(&pump, NAN);
  text = written("cfx/steady.ccl");
  assert_int_equal(count_of(text, "plus"), 0);
  free(text);
}

// A turn of 200 steps takes 2 pi / 100 s; means are taken from the first step behind five turns.
static void time_follows_from_the_speed(void **state) {
  pump_by_hand(&pump);
  char *text = written("cfx/transient.ccl"), line[100];
  double step = 0;
  assert_int_equal(count_of(text, "        Timestep Interval = 200\n"), 2);
  assert_int_equal(count_of(text, "      Start Iteration List = 1001\n"), 1);
  assert_int_equal(sscanf(strstr(text, "Timesteps = "), "Timesteps = %lf [s]", &step), 1);
  assert_near(step * 200 * 100 / (2 * M_PI), 1, 1e-8);
  assert_null(strstr(text, "Physical Timescale"));
  free(text);
  text = written("cfx/steady.ccl");
  snprintf(line, sizeof line, "      Physical Timescale = %g [s]\n", 1 / 100.);
  assert_int_equal(count_of(text, line), 1);
  assert_null(strstr(text, "Timestep"));
  free(text);
}

// Half the flow: 4 kg/s, of which the outlet takes 3; a steady set-up.
static void a_point_of_the_curve_has_its_flow(void **state) {
  pump_by_hand(&pump);
  pump.table.operating_points.flow_shares = (CwList){1, {0.5}};
  char *text = written("cfx/points/q0500.ccl");
  assert_block(text, "BOUNDARY: outlet\n", "\n    END\n", "Mass Flow Rate = 3 [kg s^-1]\n");
  assert_block(text, "BOUNDARY: drain\n", "\n    END\n", "Mass Flow Rate = 1 [kg s^-1]\n");
  assert_non_null(strstr(text, "Option = Frozen Rotor\n"));
  free(text);
  text = written("cfx/points/q0500.pre");
  assert_non_null(strstr(text, "importccl filename=points/q0500.ccl,"));
  free(text);
}

static void walls_are_rough_where_the_case_has_a_roughness(void **state) {
  pump_by_hand(&pump);
  char *text = written("cfx/steady.ccl");
  assert_int_equal(count_of(text, "Option = Smooth Wall\n"), 6);
  assert_int_equal(count_of(text, "Option = Rough Wall\n"), 0);
  assert_int_equal(count_of(text, "Fluid Temperature = 20 [C]\n"), ZONES); // where the case gives none
  free(text);
  pump.table.walls.roughness = 40e-6;
  pump.table.fluid.temperature = 45;
  text = written("cfx/steady.ccl");
  assert_int_equal(count_of(text, "Option = Rough Wall\n          Sand Grain Roughness Height = 40 [micron]\n"), 6);
  assert_int_equal(count_of(text, "Option = Smooth Wall\n"), 0);
  assert_int_equal(count_of(text, "Fluid Temperature = 45 [C]\n"), ZONES);
  free(text);
}

// y+ 30: k-epsilon; 1: SST; none: laminar. Large eddies in time, but of laminar flow. Four sides of interfaces less
// than there are patches have values of what is transported, and so have both inlets.
static void turbulence_follows_from_the_walls(void **state) {
  static const struct {
    double y_plus;
    const char *steady, *transient, *advection;
  } models[] = {{30, "k epsilon", "LES Smagorinsky", "Central Difference"},
                {1, "SST", "LES Smagorinsky", "Central Difference"},
                {NAN, "Laminar", "Laminar", "High Resolution"}};
  char line[100];
  pump_by_hand(&pump);
  for (int m = 0; m < 3; ++m)
    for (int transient = 0; transient < 2; ++transient) {
      pump_by_hand_y_plus(&pump, models[m].y_plus);
      char *text = written(transient ? "cfx/transient.ccl" : "cfx/steady.ccl");
      snprintf(line, sizeof line, "TURBULENCE MODEL:\n        Option = %s\n",
               transient ? models[m].transient : models[m].steady);
      assert_int_equal(count_of(text, line), ZONES);
      assert_int_equal(count_of(text, "        TURBULENCE:\n"), m < 2 && !transient ? 2 + 2 * INTERFACES : 0);
      assert_int_equal(count_of(text, "Turbulence Numerics"), m < 2 && !transient);
      assert_int_equal(count_of(text, "WALL ROUGHNESS:"), m < 2 ? 6 : 0);
      snprintf(line, sizeof line, "ADVECTION SCHEME:\n      Option = %s\n",
               transient ? models[m].advection : "High Resolution");
      assert_int_equal(count_of(text, line), 1);
      free(text);
    }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_patch_has_its_boundary),
      cmocka_unit_test(interfaces_know_their_frames),
      cmocka_unit_test(expressions_are_the_figures_of_the_pump),
      cmocka_unit_test(each_boundary_of_walls_has_its_y_plus),
      cmocka_unit_test(time_follows_from_the_speed),
      cmocka_unit_test(a_point_of_the_curve_has_its_flow),
      cmocka_unit_test(walls_are_rough_where_the_case_has_a_roughness),
      cmocka_unit_test(turbulence_follows_from_the_walls),
  };
  return cmocka_run_group_tests(tests, make_test_folder, clear_test_folder);
}
