// SPDX-License-Identifier: AGPL-3.0-or-later
#include <jansson.h>

#include "mesher/run/manifest.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

// A mesh of three regions where one of more regions and of another domain lay, and files of other names.
static void files_of_other_regions_are_removed(void **state) {
  static const char *const STAYS[] = {"rotor-0001.h5",    "rotor-0002.h5", "stator-10000.h5",   "manifest.json",
                                      "rotor-layers.vtk", "rotor-003.h5",  "rotor-0003.h5.old", "my rotor-0003.h5",
                                      "failed-rotor.vtk", "-0003.h5",      "rotor-0003-a.h5"};
  static const char *const GOES[] = {"rotor-0003.h5",      "stator-0001.h5",        "stator-10001.h5",
                                     "inlet_pipe-0001.h5", "failed-rotor-0001.vtk", "failed-rotor-0003.vtk"};
  json_t *manifest = json_pack("{s:[{s:[{s:s}, {s:s}]}, {s:[{s:s}]}]}", "domains", "regions", "file", "rotor-0001.h5",
                               "file", "rotor-0002.h5", "regions", "file", "stator-10000.h5");
  assert_non_null(manifest);
  for (size_t i = 0; i < sizeof STAYS / sizeof *STAYS; i++) write_text(in_test_folder(STAYS[i]), "a");
  for (size_t i = 0; i < sizeof GOES / sizeof *GOES; i++) write_text(in_test_folder(GOES[i]), "a");
  cw_mesh_remove_others(manifest, test_folder);
  for (size_t i = 0; i < sizeof GOES / sizeof *GOES; i++) assert_int_equal(access(in_test_folder(GOES[i]), F_OK), -1);
  for (size_t i = 0; i < sizeof STAYS / sizeof *STAYS; i++) assert_int_equal(unlink(in_test_folder(STAYS[i])), 0);
  json_decref(manifest);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(files_of_other_regions_are_removed),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
