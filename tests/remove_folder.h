// SPDX-License-Identifier: AGPL-3.0-or-later
// Folders that a test has made.
#ifndef CUTWATER_TESTS_REMOVE_FOLDER_H
#define CUTWATER_TESTS_REMOVE_FOLDER_H

#include <stdio.h>
#include <stdlib.h>

// Removes a folder with all in it; 0, or another number where it cannot, so that a teardown returns it.
static inline int remove_folder(const char *folder) {
  char command[4200];
  snprintf(command, sizeof command, "rm -r '%s'", folder);
  return system(command);
}

#endif
