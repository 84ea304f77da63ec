// SPDX-License-Identifier: AGPL-3.0-or-later
// A test that starts itself under mpirun: alone it is the test, there it is one rank of the run that a test asks for.
#pragma once

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "mesher/parallel/ranks.h"
#include "pipeline/stop_line.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

// All that the ranks of the last launch printed.
static char output[100000];

// Whether this process is such a rank.
static inline int launched(int argc) {
  return getenv("OMPI_COMM_WORLD_SIZE") && argc > 1;
}

// What such a rank begins with: MPI, and the file by which one of those that fail says so.
static inline CwStatus begin_as_rank(int *argc, char ***argv, CwTeam **all) {
  CwStatus status = cw_mpi_start(argc, argv, all);
  if (status != CW_OK) return status;
  return cw_team_agree(*all, cw_stop_watch(getenv("CUTWATER_LAUNCHED"), "test", cw_team_rank(*all) == 0));
}

static inline int end_as_rank(CwTeam *all, int code) {
  cw_stop_end();
  cw_mpi_end(&all);
  return code;
}

// Starts ranks of this program; gives mpirun's exit status, -1 where it has none.
static inline int launch(int ranks, const char *mode) {
  char command[4300], self[4000] = {0};
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  if (make_test_folder(NULL) || mkdir(in_test_folder("log"), 0777)) return -1;
  setenv("CUTWATER_LAUNCHED", test_folder, 1);
  if (readlink("/proc/self/exe", self, sizeof self - 1) <= 0) return -1;
  snprintf(command, sizeof command, "mpirun -q --oversubscribe -n %d '%s' %s 2>&1", ranks, self, mode);
  FILE *pipe = popen(command, "r");
  if (!pipe) return -1;
  size_t used = 0, got;
  while ((got = fread(output + used, 1, sizeof output - 1 - used, pipe)) > 0) used += got;
  output[used] = '\0';
  int status = pclose(pipe);
  clear_test_folder(NULL); // with the file of ranks that were killed
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// The sum of the numbers that follow `key`, and how often it stands there.
static inline int sum_of(const char *key, int *lines) {
  int sum = 0;
  *lines = 0;
  for (const char *at = strstr(output, key); at; at = strstr(at + 1, key)) {
    sum += atoi(at + strlen(key));
    ++*lines;
  }
  return sum;
}

static inline int count_lines_with(const char *key) {
  int lines;
  sum_of(key, &lines);
  return lines;
}

static inline void launch_well(int ranks, const char *mode) {
  const int code = launch(ranks, mode);
  if (code) fail_msg("%d ranks, exit status %d: %s", ranks, code, output);
}

// Each rank tells so many times that nothing is wrong.
static inline void launch_and_find_right(int ranks, const char *mode, int times) {
  int lines;
  launch_well(ranks, mode);
  assert_int_equal(sum_of(" WRONG ", &lines), 0);
  assert_int_equal(lines, times * ranks);
}
