// SPDX-License-Identifier: AGPL-3.0-or-later
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "launch.h"
#include "mesher/run/pass_state.h"
#include "pipeline/case_schema.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

static const char *const FILES[] = {"rotor.brep", "stator.brep", "faces.csv", "model.json"};
enum { FILE_COUNT = sizeof FILES / sizeof *FILES };
static const CwModel domains = {.domain_count = 2, .domain = {{.name = "rotor"}, {.name = "stator"}}};

// In place of that of the mesher's sources (source_hash.h), which does not change while a test runs.
char cw_source_hash[65] = "some sources";

enum { PATH_SIZE = 128 };

static void path_of(char path[PATH_SIZE], const char *name) {
  assert_true(snprintf(path, PATH_SIZE, "%s/%s", test_folder, name) < PATH_SIZE);
}

static void write_file(const char *name, const char *text) {
  char path[PATH_SIZE];
  path_of(path, name);
  write_text(path, text);
}

static int make_run(void **state) {
  char path[PATH_SIZE];
  if (make_test_folder(state)) return -1;
  path_of(path, "geometry");
  mkdir(path, 0777);
  path_of(path, "mesh");
  mkdir(path, 0777);
  for (int i = 0; i < FILE_COUNT; i++) {
    snprintf(path, sizeof path, "geometry/%s", FILES[i]);
    write_file(path, FILES[i]);
  }
  return 0;
}

static int remove_run(void **state) {
  char path[PATH_SIZE], name[64];
  for (int i = 0; i < FILE_COUNT; i++) {
    snprintf(name, sizeof name, "geometry/%s", FILES[i]);
    path_of(path, name);
    unlink(path);
  }
  path_of(path, "mesh/pass.json");
  unlink(path);
  path_of(path, "mesh");
  rmdir(path);
  path_of(path, "geometry");
  rmdir(path);
  return remove_test_folder(state);
}

static void check_start(const CwPassStart *read, const CwPassStart *written) {
  assert_memory_equal(&read->prisms, &written->prisms, sizeof read->prisms);
  assert_memory_equal(&read->tets, &written->tets, sizeof read->tets);
  assert_int_equal(read->places, written->places);
  assert_memory_equal(read->whole, written->whole, sizeof read->whole);
  assert_memory_equal(read->more_regions, written->more_regions, sizeof read->more_regions);
  assert_memory_equal(read->layers, written->layers, sizeof read->layers);
}

static void state_comes_back_as_written(void **unused) {
  CwCase table;
  cw_case_defaults(&table);
  char fingerprint[33];
  assert_int_equal(cw_pass_fingerprint(&table, test_folder, &domains, fingerprint), CW_OK);
  CwFinerPlace place[2] = {{0, 0, {{0.1, -0.2, 1. / 3}, 0.03}}, {1, 1, {{1, 2, 3}, 0.1 / 3}}};
  const CwPassState written = {
      .pass = 3,
      .first_pass = 2,
      .start = {{12.2450980392, 1.2, 0.1}, {10.8712345678, 1.3, -0.5, 11}, 2, {0, 1}, {0, 2}, {6, 4}},
      .finer_rounds = 1,
      .poor_rounds = 4,
      .best = {{11.5, 1.1, 0}, {10.25, 1.1, 0}, 1, {1}, {3, -1}},
      .least_deficit = 2. / 3,
      .best_round = 3,
      .best_lacks = {0, 1},
      .best_layers = {7, 0, 5},
      .plane_rounds = 2,
      .finer = {.count = 2, .place = place}};
  assert_int_equal(cw_pass_state_write(test_folder, fingerprint, &written), CW_OK);
  CwPassState read = {0};
  assert_int_equal(cw_pass_state_read(NULL, test_folder, fingerprint, &read), CW_OK);
  assert_int_equal(read.pass, 3);
  assert_int_equal(read.first_pass, 2);
  check_start(&read.start, &written.start);
  check_start(&read.best, &written.best);
  assert_int_equal(read.finer_rounds, 1);
  assert_int_equal(read.poor_rounds, 4);
  assert_near(read.least_deficit, written.least_deficit, 0);
  assert_int_equal(read.best_round, 3);
  assert_memory_equal(read.best_lacks, written.best_lacks, sizeof written.best_lacks);
  assert_memory_equal(read.best_layers, written.best_layers, sizeof written.best_layers);
  assert_int_equal(read.plane_rounds, 2);
  assert_int_equal(read.finer.count, 2);
  for (int i = 0; i < 2; i++) { // to the last bit
    assert_int_equal(read.finer.place[i].domain, place[i].domain);
    assert_int_equal(read.finer.place[i].pinched, place[i].pinched);
    assert_memory_equal(&read.finer.place[i].point, &place[i].point, sizeof place[i].point);
  }
  cw_finer_places_free(&read.finer);
}

static void another_case_or_geometry_starts_anew(void **unused) {
  CwCase table;
  cw_case_defaults(&table);
  char before[33], after[33];
  assert_int_equal(cw_pass_fingerprint(&table, test_folder, &domains, before), CW_OK);
  table.mesh.cells++;
  assert_int_equal(cw_pass_fingerprint(&table, test_folder, &domains, after), CW_OK);
  assert_string_not_equal(before, after);
  CwPassState read = {0};
  assert_int_equal(cw_pass_state_read(NULL, test_folder, after, &read), CW_OK);
  assert_int_equal(read.pass, 0);
  table.mesh.cells--;
  write_file("geometry/faces.csv", "changed");
  assert_int_equal(cw_pass_fingerprint(&table, test_folder, &domains, after), CW_OK);
  assert_string_not_equal(before, after);
}

// What another version has learnt is not what this one would learn.
static void other_sources_start_anew(void **unused) {
  CwCase table;
  cw_case_defaults(&table);
  char before[33], after[33];
  assert_int_equal(cw_pass_fingerprint(&table, test_folder, &domains, before), CW_OK);
  strcpy(cw_source_hash, "other sources");
  assert_int_equal(cw_pass_fingerprint(&table, test_folder, &domains, after), CW_OK);
  assert_string_not_equal(before, after);
}

static void broken_state_is_left_aside(void **unused) {
  write_file("mesh/pass.json", "{\"fingerprint\": \"x\", \"pass\": 2");
  CwPassState read = {0};
  assert_int_equal(cw_pass_state_read(NULL, test_folder, "x", &read), CW_OK);
  assert_int_equal(read.pass, 0);
}

// One rank has read the file, the others none.
static int be_a_rank(int argc, char **argv) {
  CwTeam *all;
  begin_as_rank(&argc, &argv, &all);
  CwFinerPlace place[2] = {{0, 0, {{0.1, 0.2, 0.3}, 0.4}}, {1, 1, {{1, 2, 3}, 4}}};
  CwPassState state = {0};
  const int rank = cw_team_rank(all);
  if (rank == 0)
    state = (CwPassState){.pass = 3, .best_round = 2, .start.more_regions = {0, 7}, .finer = {2, 2, place}};
  int wrong = cw_pass_state_share(all, &state) != CW_OK;
  wrong += state.pass != 3 || state.best_round != 2 || state.start.more_regions[1] != 7 || state.finer.count != 2;
  for (int i = 0; wrong == 0 && i < 2; i++) {
    wrong += state.finer.place[i].domain != place[i].domain || state.finer.place[i].pinched != place[i].pinched;
    wrong += memcmp(&state.finer.place[i].point, &place[i].point, sizeof place[i].point) != 0;
  }
  if (rank > 0) cw_finer_places_free(&state.finer);
  printf("RANK %d WRONG %d\n", rank, wrong);
  return end_as_rank(all, wrong != 0);
}

static void all_ranks_go_on_alike(void **unused) {
  char run[sizeof test_folder]; // a launch has a folder of its own
  memcpy(run, test_folder, sizeof run);
  for (int ranks = 1; ranks <= 3; ranks++) launch_and_find_right(ranks, "share", 1);
  memcpy(test_folder, run, sizeof run);
}

static void missing_geometry_is_named(void **unused) {
  CwCase table;
  cw_case_defaults(&table);
  char fingerprint[33];
  assert_int_equal(cw_pass_fingerprint(&table, "nowhere", &domains, fingerprint), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "nowhere/geometry/faces.csv"));
}

int main(int argc, char **argv) {
  if (launched(argc)) return be_a_rank(argc, argv);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(state_comes_back_as_written), cmocka_unit_test(another_case_or_geometry_starts_anew),
      cmocka_unit_test(other_sources_start_anew),    cmocka_unit_test(broken_state_is_left_aside),
      cmocka_unit_test(all_ranks_go_on_alike),       cmocka_unit_test(missing_geometry_is_named),
  };
  return cmocka_run_group_tests(tests, make_run, remove_run);
}
