// SPDX-License-Identifier: AGPL-3.0-or-later
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "geometry/hydraulic_design.h"
#include "geometry/pump_files.h"
#include "geometry/rotor.h"
#include "geometry/step_file.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

static CwSolid *rotor;

static int setup(void **state) {
  const CwCase table = paper();
  const CwDesign design = design_of(&table);
  return make_test_folder(state) || cw_rotor_build(&design, &rotor);
}

static int teardown(void **state) {
  cw_solid_free(&rotor);
  return remove_test_folder(state);
}

static void assert_same_files(const char *a, const char *b) {
  size_t na, nb;
  char *ta = read_whole(a, &na), *tb = read_whole(b, &nb);
  assert_int_equal(na, nb);
  assert_memory_equal(ta, tb, na);
  free(ta);
  free(tb);
}

static void files_are_the_same_each_time(void **state) {
  const CwSolid *const solids[] = {rotor};
  const char *a = in_test_folder("a"), *b = in_test_folder("b");
  assert_int_equal(cw_step_write(solids, 1, a), CW_OK);
  assert_int_equal(cw_step_write(solids, 1, b), CW_OK);
  assert_same_files(a, b);
  assert_int_equal(cw_solid_write_brep(rotor, a), CW_OK);
  assert_int_equal(cw_solid_write_brep(rotor, b), CW_OK);
  assert_same_files(a, b);
  unlink(a);
  unlink(b);
}

static void faces_table(void **state) {
  const CwSolid *const solids[] = {rotor};
  const char *path = in_test_folder("faces.csv");
  assert_int_equal(cw_faces_table_write(solids, 1, path), CW_OK);
  size_t size;
  char *text = read_whole(path, &size);
  int lines = 0;
  for (size_t i = 0; i < size; i++) lines += text[i] == '\n';
  assert_int_equal(lines, 63);
  assert_int_equal(strncmp(text, "domain,face,patch,kind,name\nrotor,1,hub,wall,hub_1\n", 51), 0);
  assert_non_null(strstr(text, ",rotor_interface,interface,rotor_interface_6\n"));
  free(text);
  unlink(path);
}

static void unwritable_place_is_refused(void **state) {
  const CwSolid *const solids[] = {rotor};
  assert_int_equal(cw_step_write(solids, 1, "no-such-folder/pump.step"), CW_ERR_IO);
  assert_int_equal(cw_solid_write_brep(rotor, "no-such-folder/rotor.brep"), CW_ERR_IO);
  cw_fail_clear();
}

// Where files may not grow, as on a full disk, the message names the file that was asked for.
static void short_disk_names_the_file(void **state) {
  const CwSolid *const solids[] = {rotor};
  struct rlimit before, small;
  const char *path = in_test_folder("pump.step");
  assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
  small = before;
  small.rlim_cur = 4096;
  signal(SIGXFSZ, SIG_IGN);
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
  CwStatus status = cw_step_write(solids, 1, path);
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
  assert_int_equal(status, CW_ERR_IO);
  assert_int_equal(strncmp(cw_fail_message(), path, strlen(path)), 0);
  assert_int_not_equal(access(path, F_OK), 0);
  cw_fail_clear();
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(files_are_the_same_each_time),
      cmocka_unit_test(faces_table),
      cmocka_unit_test(unwritable_place_is_refused),
      cmocka_unit_test(short_disk_names_the_file),
  };
  return cmocka_run_group_tests(tests, setup, teardown);
}
