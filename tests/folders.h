// SPDX-License-Identifier: AGPL-3.0-or-later
// Folders that a test makes.
#pragma once

#include <stdio.h>
#include <stdlib.h>

// Makes an empty folder under TMPDIR or /tmp; 0, or another number where it cannot, so that a setup returns it.
static inline int make_temporary_folder(char *path, size_t size) {
  const char *place = getenv("TMPDIR");
  const int length = snprintf(path, size, "%s/cutwater-test-XXXXXX", place ? place : "/tmp");
  return length < (int)size && mkdtemp(path) ? 0 : -1;
}

// Removes a folder with all in it; 0, or another number where it cannot, so that a teardown returns it.
static inline int remove_folder(const char *folder) {
  char command[4200];
  snprintf(command, sizeof command, "rm -r '%s'", folder);
  return system(command);
}
