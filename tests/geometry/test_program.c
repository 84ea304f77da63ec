// SPDX-License-Identifier: AGPL-3.0-or-later
// cutwater-geometry as a user runs it.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#include "tests/test_folder.h"
#include "tests/whole_file.h"

static int run(const char *case_file, const char *name) {
  char command[800];
  snprintf(command, sizeof command, "%s/cutwater-geometry --case '%s' --run %s/%s 2> %s/messages", CUTWATER_BIN_DIR,
           case_file, test_folder, name, test_folder);
  const int code = system(command);
  return WIFEXITED(code) ? WEXITSTATUS(code) : -1;
}

static int messages_have(const char *words) {
  const char *path = in_test_folder("messages");
  char *messages = read_whole(path, NULL);
  const int found = strstr(messages, words) != NULL;
  free(messages);
  return found;
}

// Two runs give the same bytes, and nothing is left under a temporary name.
static void files_are_written_and_the_same_each_time(void **state) {
  static const char *const names[] = {"rotor.brep",
                                      "stator.brep",
                                      "faces.csv",
                                      "pump.step",
                                      "design.json",
                                      "blade_plan.svg",
                                      "meridional_section.svg",
                                      "blade_angle.svg",
                                      "velocity_triangles.svg",
                                      "volute_plan.svg",
                                      "volute_sections.svg",
                                      "model.json",
                                      "pump_faces.step"};
  char command[400];
  assert_int_equal(run(CUTWATER_SOURCE_DIR "/cases/paper/case.yaml", "a"), 0);
  assert_true(messages_have("measured: wrap 71.000 deg, D1 74.0000, D2 200.0000, b2 8.0000 mm"));
  assert_true(messages_have("predicted head"));
  assert_int_equal(run(CUTWATER_SOURCE_DIR "/cases/paper/case.yaml", "b"), 0);
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    snprintf(command, sizeof command, "cmp %s/a/geometry/%s %s/b/geometry/%s", test_folder, names[i], test_folder,
             names[i]);
    assert_int_equal(system(command), 0);
  }
  // These and record.json.
  snprintf(command, sizeof command, "test $(ls -A %s/a/geometry | wc -l) = %zu", test_folder,
           sizeof names / sizeof *names + 1);
  assert_int_equal(system(command), 0);
}

// A design without a solution ends with one line and leaves no record, not even an earlier run's.
static void failure_leaves_no_record(void **state) {
  char command[500];
  assert_int_equal(run(CUTWATER_SOURCE_DIR "/cases/paper/case.yaml", "c"), 0);
  snprintf(command, sizeof command,
           "sed 's/wrap_angle_deg: 71/wrap_angle_deg: 21/' %s/cases/paper/case.yaml > %s/case.yaml",
           CUTWATER_SOURCE_DIR, test_folder);
  assert_int_equal(system(command), 0);
  const char *path = in_test_folder("case.yaml");
  assert_int_not_equal(run(path, "c"), 0);
  assert_true(messages_have("case.yaml: a wrap of 21.00 deg"));
  snprintf(command, sizeof command, "test ! -e %s/c/geometry/record.json", test_folder);
  assert_int_equal(system(command), 0);
}

typedef struct {
  const char *key;
  double value;
} Given;

// A water pump of 54 m3/h, 20 m and 1800 rpm with some keys of its impeller given, up to one without a name.
static void write_case(const char *path, const Given *given) {
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fprintf(file, "name: given\noperating_point: {flow_rate_m3_per_h: 54, head_m: 20, speed_rpm: 1800}\nimpeller:\n");
  for (; given->key; given++) fprintf(file, "  %s: %.6g\n", given->key, given->value);
  fclose(file);
}

// Key and value behind "tried:" in the only line that says error.
static void read_remedy(char key[64], double *value) {
  char line[2000];
  int errors = 0, found = 0;
  const char *path = in_test_folder("messages");
  FILE *file = fopen(path, "r");
  assert_non_null(file);
  while (fgets(line, sizeof line, file)) {
    const char *tried = strstr(line, "tried: impeller.");
    errors += strstr(line, ": error: ") != NULL;
    if (tried) found = sscanf(tried, "tried: impeller.%63[a-z_]: %lf works", key, value);
  }
  fclose(file);
  assert_int_equal(errors, 1);
  assert_int_equal(found, 2);
}

// A wheel far too small for its head: put into the case, the value that the refusal names works.
static void what_a_refusal_names_works(void **state) {
  Given given[] = {{"outlet_blade_angle_deg", 15}, {"outlet_diameter_mm", 150}, {"outlet_width_mm", 10}, {NULL, 0}};
  char key[64];
  const char *path = in_test_folder("given.yaml");
  write_case(path, given);
  assert_int_not_equal(run(path, "given"), 0);
  read_remedy(key, &given[1].value);
  assert_string_equal(key, given[1].key);
  write_case(path, given);
  assert_int_equal(run(path, "given"), 0);
}

// A duty alone at nq 115, where no volute is wide enough: the refusal names a key that the case leaves open, or at last
// the speed, with a value that works.
static void a_refused_duty_gets_a_value(void **state) {
  static const char duty[] =
      "name: duty\noperating_point:\n  flow_rate_m3_per_h: 500\n  head_m: 4.5\n  speed_rpm: %.6g\n";
  char section[32], key[64];
  double value;
  const char *path = in_test_folder("duty.yaml");
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fprintf(file, duty, 960.0);
  fclose(file);
  assert_int_not_equal(run(path, "duty"), 0);
  char *messages = read_whole(in_test_folder("messages"), NULL);
  const char *tried = strstr(messages, "tried: ");
  assert_non_null(tried);
  assert_int_equal(sscanf(tried, "tried: %31[a-z_].%63[a-z_0-9]: %lf works", section, key, &value), 3);
  free(messages);
  const int speed = !strcmp(key, "speed_rpm");
  file = fopen(path, "w");
  assert_non_null(file);
  fprintf(file, duty, speed ? value : 960.0);
  if (!speed) fprintf(file, "%s:\n  %s: %.6g\n", section, key, value);
  fclose(file);
  assert_int_equal(run(path, "duty"), 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(files_are_written_and_the_same_each_time),
      cmocka_unit_test(failure_leaves_no_record),
      cmocka_unit_test(what_a_refusal_names_works),
      cmocka_unit_test(a_refused_duty_gets_a_value),
  };
  return cmocka_run_group_tests(tests, make_test_folder, clear_test_folder);
}
