// SPDX-License-Identifier: AGPL-3.0-or-later
// The whole stage through its executable: the same bytes for any number of ranks, and what bad input does.
// Modules without a test of their own that it runs: assembly, cgns_fill, cgns_tree, division, fluent_case, foam_region,
// manifest, saturne_case.
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <hdf5.h>

#include "tests/export/stage_run.h"
#include "tests/seal_run.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

static char output[STAGE_OUTPUT_SIZE];

static int make_run(void **state) {
  SyntheticPump pump = synthetic_pump();
  return make_test_folder(state) || stage_run_make(test_folder, &pump);
}

static void copy_run(const char *name, char run[STAGE_PATH_SIZE + 40]) {
  snprintf(run, STAGE_PATH_SIZE + 40, "%s/%s", test_folder, name);
  assert_int_equal(stage_shell(output, "rm -rf '%s'; cp -r '%s/run' '%s'", run, test_folder, run), 0);
}

static void any_number_of_ranks_gives_the_same_bytes(void **state) {
  char one[STAGE_PATH_SIZE + 40], more[STAGE_PATH_SIZE + 40];
  copy_run("one", one);
  assert_int_equal(stage_export(one, 1, output), 0);
  sleep(1); // a time stamp would differ
  for (int ranks = 2; ranks <= 3; ++ranks) {
    copy_run("more", more);
    assert_int_equal(stage_export(more, ranks, output), 0);
    int differs = stage_shell(output, "diff -r --exclude=record.json '%s/export' '%s/export'", one, more);
    if (differs) fail_msg("%d ranks: %s", ranks, output);
  }
  // Nothing but the results is left.
  assert_int_equal(stage_shell(output, "ls -A '%s/export'", one), 0);
  assert_string_equal(output, "cfx\nopenfoam\npump.cgns\nrecord.json\n");
}

static void a_second_export_replaces_the_first(void **state) {
  char run[STAGE_PATH_SIZE + 40];
  copy_run("again", run);
  assert_int_equal(stage_export(run, 1, output), 0);
  assert_int_equal(stage_shell(output, "touch '%s/export/openfoam/left-over'", run), 0);
  assert_int_equal(stage_export(run, 1, output), 0);
  assert_int_equal(stage_shell(output, "find '%s/export' -name left-over -o -name '*.old' -o -name '.part'", run), 0);
  assert_string_equal(output, "");
  // A failed run leaves the earlier files as they were, without a record that would call them new.
  stage_shell(output, "rm '%s/mesh/rotor-0003.h5'", run);
  assert_int_not_equal(stage_export(run, 1, output), 0);
  assert_int_equal(stage_shell(output, "ls -A '%s/export'", run), 0);
  assert_string_equal(output, "cfx\nopenfoam\npump.cgns\n");
}

// A fault that no stage has made shows as damage; the content is looked at where the files have their digests.
static void seal(const char *run) {
  assert_int_equal(seal_run(run), 0);
}

// One line that has the words, and no export folder. With one rank nothing follows that line.
static void expect_error_on(const char *run, int ranks, const char *words) {
  char left[STAGE_PATH_SIZE + 60];
  int errors = 0;
  assert_int_not_equal(stage_export(run, ranks, output), 0);
  for (const char *at = output; (at = strstr(at, "error:")); ++at) ++errors;
  const char *last = strstr(output, "cutwater-export: error:");
  if (!last || !strstr(last, words) || errors != 1 || (ranks == 1 && strchr(last, '\n') != output + strlen(output) - 1))
    fail_msg("%d ranks, wanted one line with '%s', got: %s", ranks, words, output);
  snprintf(left, sizeof left, "%s/export", run);
  assert_int_equal(access(left, F_OK), -1);
}

static void expect_error(const char *run, const char *words) {
  expect_error_on(run, 1, words);
}

// A failure of one rank, of all ranks, and of the rank that does not speak.
static void with_two_ranks_one_of_them_tells(void **state) {
  char run[STAGE_PATH_SIZE + 40];
  copy_run("bad", run);
  stage_shell(output, "rm '%s/mesh/rotor-0002.h5'", run);
  expect_error_on(run, 2, "rotor-0002.h5: is missing");
  copy_run("bad", run);
  stage_shell(output, "rm '%s/mesh/rotor-0001.h5'", run);
  expect_error_on(run, 2, "rotor-0001.h5: is missing");
  copy_run("bad", run);
  stage_shell(output, "rm '%s/mesh/manifest.json'", run);
  expect_error_on(run, 2, "mesh/manifest.json: cannot be read");
}

static void files_that_are_missing_or_cut_are_told(void **state) {
  char run[STAGE_PATH_SIZE + 40];
  copy_run("bad", run);
  assert_int_equal(stage_shell(output, "sed -i '0,/paper/s//other/' '%s/mesh/record.json'", run), 0);
  seal(run);
  expect_error(run, "mesh: made with name: other, the case file has paper; allowed: the same pump, run cutwater-mesh");
  copy_run("bad", run);
  stage_shell(output, "rm '%s/mesh/stator-0002.h5'", run);
  expect_error(run, "stator-0002.h5: is missing");
  copy_run("bad", run);
  stage_shell(output, "truncate -s 30000 '%s/mesh/rotor-0002.h5'", run);
  expect_error(run, "rotor-0002.h5: is missing, damaged or cut short");
  copy_run("bad", run);
  stage_shell(output, "rm '%s/mesh/manifest.json'", run);
  expect_error(run, "mesh/manifest.json: cannot be read");
  copy_run("bad", run);
  stage_shell(output, "rm '%s/mesh/record.json'", run);
  expect_error(run, "mesh/record.json: it is missing; cutwater-mesh writes it");
}

static void a_manifest_that_does_not_fit_is_told(void **state) {
  static const struct {
    const char *edit, *words;
  } cases[] = {
      {"0,/\"tetrahedra\": [0-9]*/s//\"tetrahedra\": 17/", "dataset 'tetrahedra' has 2184 rows; it must have 17"},
      {"0,/\"shared_points\": [0-9]*/s//\"shared_points\": 3/", "leave more than the 3 'shared_points'"},
      {"s/\"region\": 2/\"region\": 3/", "regions must stand in order 1, 2, 3, ..."},
      {"s/rotor-0001.h5/rotor-0002.h5/", "rotor-0002.h5: attribute 'region' is 2; it must be 1"},
      {"s/stator-0001.h5/rotor-0001.h5/", "rotor-0001.h5: attribute 'domain' is 'rotor'; it must be 'stator'"},
      {"s/\"format\": 3/\"format\": 9/", "'format' must be 3"},
      {"s/\"kind\": \"outlet\"/\"kind\": \"exit\"/", "patch 'outlet': kind 'exit'; allowed are wall, inlet"},
      {"s/\"kind\": \"outlet\"/\"kind\": \"symmetry\"/", "no patch is of kind outlet; allowed: one at least"},
      {"s/^ *\"rotor_interface\",/\"hub\",/", "interface 1: 'hub' is no patch of kind interface"},
      {"s/\"interfaces\"/\"faces\"/", "'interfaces' must be there and an array"},
      {"s/\"name\": \"tongue\"/\"name\": \"volute\"/", "patch 'volute' is named twice"},
      {"$ d", "manifest.json:"},
  };
  char run[STAGE_PATH_SIZE + 40];
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    copy_run("bad", run);
    assert_int_equal(stage_shell(output, "sed -i '%s' '%s/mesh/manifest.json'", cases[i].edit, run), 0);
    seal(run);
    expect_error(run, cases[i].words);
  }
}

// Sets one number of a dataset of doubles with three columns.
static void move_point(const char *run, const char *file_name, hsize_t point, hsize_t axis, double value) {
  char path[STAGE_PATH_SIZE + 100];
  snprintf(path, sizeof path, "%s/mesh/%s", run, file_name);
  hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT), set = H5Dopen2(file, "points", H5P_DEFAULT);
  hid_t there = H5Dget_space(set), here = H5Screate(H5S_SCALAR);
  H5Sselect_elements(there, H5S_SELECT_SET, 1, (hsize_t[]){point, axis});
  assert_true(H5Dwrite(set, H5T_NATIVE_DOUBLE, here, there, H5P_DEFAULT, &value) >= 0);
  H5Sclose(here);
  H5Sclose(there);
  H5Dclose(set);
  H5Fclose(file);
}

static void a_broken_mesh_is_told_with_its_place(void **state) {
  char run[STAGE_PATH_SIZE + 40];
  copy_run("bad", run);
  move_point(run, "rotor-0001.h5", 300, 2, 0.0 / 0.0);
  seal(run);
  expect_error(run, "rotor-0001.h5: point 300 has a coordinate that is not a number");
  copy_run("bad", run);
  move_point(run, "rotor-0001.h5", 300, 2, 0.5);
  seal(run);
  expect_error(run, "mm has a volume of -");
  // Found while the other rank writes: nothing of it stays.
  copy_run("bad", run);
  move_point(run, "rotor-0002.h5", 300, 2, 0.5);
  seal(run);
  expect_error_on(run, 2, "mm has a volume of -");
  // Point 0 is shared: moved a little in one region only.
  copy_run("bad", run);
  move_point(run, "rotor-0001.h5", 0, 2, -4.0001e-3 / 2); // in the unit of the file, 2 m
  seal(run);
  expect_error(run, "differs between regions by 0.0001 mm");
  copy_run("bad", run);
  stage_shell(output, "sed -i 's/\"radius_m\": 0.101[0-9]*/\"radius_m\": 0.102/' '%s/mesh/manifest.json'", run);
  seal(run);
  expect_error(run, "mm has the radius 101 mm; the interface has 102 mm");
}

// Two prisms of n sides and of many in one cylinder: their areas are 2 n sin(pi / n) r h.
static void sides_of_different_area_are_told(void **state) {
  SyntheticPump pump = synthetic_pump();
  char words[200];
  pump.stator.around = 8;
  const char *run = in_test_folder("other");
  assert_int_equal(synthetic_run_write(run, &pump), 0);
  assert_int_equal(stage_export(run, 1, output), 0);
  const double height = pump.top - pump.bottom;
  const int n[2] = {pump.rotor.around, pump.stator.around};
  double area[2];
  for (int i = 0; i < 2; ++i) area[i] = 1e6 * 2 * n[i] * sin(M_PI / n[i]) * pump.rotor.outer * height;
  snprintf(words, sizeof words, "the interface has %.6g mm2 on patch 'rotor_interface' and %.6g mm2 on '", area[0],
           area[1]);
  if (!strstr(output, words)) fail_msg("no '%s' in: %s", words, output);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(any_number_of_ranks_gives_the_same_bytes),
      cmocka_unit_test(a_second_export_replaces_the_first),
      cmocka_unit_test(with_two_ranks_one_of_them_tells),
      cmocka_unit_test(files_that_are_missing_or_cut_are_told),
      cmocka_unit_test(a_manifest_that_does_not_fit_is_told),
      cmocka_unit_test(sides_of_different_area_are_told),
      cmocka_unit_test(a_broken_mesh_is_told_with_its_place),
  };
  return cmocka_run_group_tests(tests, make_run, clear_test_folder);
}
