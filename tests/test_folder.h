// SPDX-License-Identifier: AGPL-3.0-or-later
// The folder of a test program, under TMPDIR or /tmp, made before its tests and removed after them, by
// cmocka_run_group_tests; or one for each of its tests, by cmocka_unit_test_setup_teardown.
#pragma once

#include <unistd.h>

#include "tests/folders.h"

static char test_folder[100];

static inline int make_test_folder(void **state) {
  return make_temporary_folder(test_folder, sizeof test_folder);
}

// The path of a file in it, until the eighth call after.
static inline const char *in_test_folder(const char *name) {
  static char path[8][sizeof test_folder + 100];
  static int next;
  next = (next + 1) % 8;
  if (snprintf(path[next], sizeof *path, "%s/%s", test_folder, name) >= (int)sizeof *path) abort();
  return path[next];
}

// Ends the program as failed where a test has left a file in it, a temporary one too: cmocka prints that a teardown has
// failed, and ends with 0.
static inline int remove_test_folder(void **state) {
  if (rmdir(test_folder) == 0) return 0;
  perror(test_folder);
  exit(EXIT_FAILURE);
}

static inline int clear_test_folder(void **state) {
  return remove_folder(test_folder);
}
