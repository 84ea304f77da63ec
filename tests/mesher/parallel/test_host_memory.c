// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/host_memory.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "launch.h"
#include "mesher/parallel/ranks.h"
#include "mesher/parallel/team.h"
#include "tests/unit_test.h"

enum { SIZE = 128 << 20 };

static char value_at(int64_t i) {
  return (char)(i % 251);
}

// Whether a write ends the process that tries it.
static int is_sealed(char *at) {
  int ended = 0;
  pid_t child = fork();
  if (child == 0) {
    signal(SIGSEGV, SIG_DFL);
    *(volatile char *)at = 1;
    _exit(0);
  }
  return waitpid(child, &ended, 0) == child && WIFSIGNALED(ended);
}

// The first rank writes, all read.
static int be_a_rank(int argc, char **argv) {
  int wrong = 0;
  CwTeam *all;
  CwHostMemory *memory;
  begin_as_rank(&argc, &argv, &all);
  const CwTeam *host = all->host;
  wrong += cw_team_ranks(host) != cw_team_ranks(all); // all run on one host here
  wrong += cw_host_memory_make(host, SIZE, &memory) != CW_OK;
  wrong += cw_host_memory_is_shared(memory) != (cw_team_ranks(all) > 1);
  char *at = cw_host_memory_at(memory);
  for (int64_t i = 0; cw_team_rank(all) == 0 && i < SIZE; i++) at[i] = value_at(i);
  cw_host_memory_spread(host, memory, 0, SIZE, 0);
  for (int64_t i = 0; i < SIZE; i++) wrong += at[i] != value_at(i);
  cw_host_memory_seal(memory);
  if (cw_host_memory_is_shared(memory)) wrong += !is_sealed(at);
  double peak = (double)cw_host_memory_peak(all) / SIZE;
  cw_host_memory_free(&memory);
  wrong += memory != NULL || (double)cw_host_memory_peak(all) / SIZE < peak;
  double without = cw_team_rank(all) || cw_team_ranks(all) == 1 ? 0 : peak - 1; // the first counts what all share
  wrong += cw_team_ranks(all) > 1 && !((cw_team_rank(all) ? peak : without) < 0.9);
  wrong += cw_team_rank(all) == 0 && !(peak >= 1);
  wrong += cw_host_memory_make(host, 0, &memory) != CW_OK;
  cw_host_memory_free(&memory);
  printf("RANK %d WRONG %d\n", cw_team_rank(all), wrong);
  return end_as_rank(all, wrong != 0);
}

static void what_one_writes_all_have_once(void **state) {
  for (int ranks = 1; ranks <= 4; ranks++) {
    launch_and_find_right(ranks, "share", 1);
  }
}

int main(int argc, char **argv) {
  if (launched(argc)) return be_a_rank(argc, argv);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_one_writes_all_have_once),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
