// SPDX-License-Identifier: AGPL-3.0-or-later
#include <unistd.h>

#include "export/cgns_node.h"
#include "tests/refused_write.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

static const char *path;
static const double values[4] = {1, 2, 3, 4};

// Two nodes, of a text and of values, in a file of their own; whether all of it went well.
static int make_file(void) {
  hid_t file = -1, node = -1;
  path = in_test_folder("node.cgns");
  int well = cw_cgns_create(path, &file) == CW_OK &&
             cw_cgns_text(file, "Descriptor", "Descriptor_t", "rotor", &node) == CW_OK &&
             cw_cgns_list(node, "Values", "DataArray_t", "R8", 4, values, NULL) == CW_OK;
  if (node >= 0 && H5Gclose(node) < 0) well = 0;
  if (file >= 0 && H5Fclose(file) < 0) well = 0;
  return well;
}

static void a_node_holds_its_values(void **state) {
  double found[4];
  assert_true(make_file());
  hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT), set = H5Dopen2(file, "Descriptor/Values/ data", H5P_DEFAULT);
  assert_true(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, found) >= 0);
  assert_memory_equal(found, values, sizeof values);
  H5Dclose(set);
  H5Fclose(file);
  unlink(path);
}

// Whichever write it was, even if all later ones succeed.
static void no_write_is_lost_unseen(void **state) {
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  for (refused_write = 1;; refused_write++) {
    writes = 0;
    int well = make_file();
    if (writes < refused_write) {
      assert_true(well);
      break;
    }
    if (well) fail_msg("write %d of %d was lost unseen", refused_write, writes);
  }
  assert_true(refused_write > 5);
  refused_write = 0;
  unlink(path);
}

int main(void) {
  H5dont_atexit(); // HDF5 stumbles there over files that could not be closed
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_node_holds_its_values),
      cmocka_unit_test(no_write_is_lost_unseen),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
