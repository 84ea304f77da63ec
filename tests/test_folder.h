// SPDX-License-Identifier: AGPL-3.0-or-later
// The folder of a test program, made before its tests and removed after them, by cmocka_run_group_tests; or one for
// each of its tests, by cmocka_unit_test_setup_teardown.
#ifndef CUTWATER_TESTS_TEST_FOLDER_H
#define CUTWATER_TESTS_TEST_FOLDER_H

#include <string.h>
#include <unistd.h>

#include "tests/remove_folder.h"

static char test_folder[] = "/tmp/cutwater-test-XXXXXX";

static inline int make_test_folder(void **state) {
  strcpy(test_folder + sizeof test_folder - 7, "XXXXXX"); // of the test before
  return mkdtemp(test_folder) ? 0 : -1;
}

// Fails where a test has left a file in it, a temporary one too.
static inline int remove_test_folder(void **state) {
  return rmdir(test_folder);
}

static inline int clear_test_folder(void **state) {
  return remove_folder(test_folder);
}

#endif
