// SPDX-License-Identifier: AGPL-3.0-or-later
// Ranks that are stopped: one of them says so.
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "pipeline/stop_line.h"
#include "tests/test_folder.h"
#include "tests/whole_file.h"

enum { RANKS = 4 };

static char token[sizeof test_folder + 40];

// A rank: watches, tells so on `ready`, and waits for the signal.
static void be_rank(int rank, int told, int ready) {
  alarm(60); // where the test ends before
  dup2(told, STDERR_FILENO);
  if (cw_stop_watch(test_folder, "mesh", rank == 0) != CW_OK || write(ready, "r", 1) != 1) _exit(1);
  for (;;) pause();
}

static void start_ranks(pid_t rank[RANKS], int *told) {
  int told_pipe[2], ready_pipe[2];
  char letter;
  assert_int_equal(pipe(told_pipe), 0);
  assert_int_equal(pipe(ready_pipe), 0);
  for (int k = 0; k < RANKS; k++) {
    rank[k] = fork();
    assert_true(rank[k] >= 0);
    if (rank[k] == 0) be_rank(k, told_pipe[1], ready_pipe[1]);
    assert_int_equal(read(ready_pipe[0], &letter, 1), 1);
  }
  close(told_pipe[1]);
  close(ready_pipe[0]);
  close(ready_pipe[1]);
  *told = told_pipe[0];
}

// Ends the ranks from `first` on, `end` excluded, as mpirun does.
static void end_ranks(const pid_t rank[RANKS], int first, int end) {
  for (int k = first; k < end; k++) assert_int_equal(kill(rank[k], SIGTERM), 0);
  for (int k = first; k < end; k++) {
    int status;
    assert_int_equal(waitpid(rank[k], &status, 0), rank[k]);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 128 + SIGTERM);
  }
}

// The same for all from `first` on; gives what all ranks have said.
static void stop_ranks(const pid_t rank[RANKS], int first, int told, char said[1000]) {
  size_t length = 0;
  end_ranks(rank, first, RANKS);
  for (ssize_t got; (got = read(told, said + length, 999 - length)) > 0;) length += (size_t)got;
  said[length] = '\0';
  close(told);
}

static void one_of_all_ranks_tells(void **state) {
  pid_t rank[RANKS];
  char said[1000];
  int told;
  start_ranks(rank, &told);
  assert_int_equal(access(token, F_OK), 0);
  stop_ranks(rank, 0, told, said);
  assert_ptr_equal(strstr(said, "cutwater-mesh: error: stopped from outside"), said);
  assert_ptr_equal(strchr(said, '\n'), said + strlen(said) - 1);
  assert_int_not_equal(access(token, F_OK), 0);
}

static void one_tells_where_the_first_is_killed(void **state) {
  pid_t rank[RANKS];
  char said[1000];
  int told;
  start_ranks(rank, &told);
  kill(rank[0], SIGKILL);
  assert_int_equal(waitpid(rank[0], NULL, 0), rank[0]);
  stop_ranks(rank, 1, told, said);
  assert_ptr_equal(strchr(said, '\n'), said + strlen(said) - 1);
}

// Ranks of another host may be cut off: one of them speaks, and so does one of the first rank's host that
// ends later.
static void ranks_elsewhere_leave_the_word_to_the_first_host(void **state) {
  char host[300] = {0}, far_token[sizeof token + 4], said[1000];
  pid_t rank[RANKS];
  int told;
  snprintf(far_token, sizeof far_token, "%s.far", token);
  gethostname(host, sizeof host - 1);
  start_ranks(rank, &told);
  write_text(token, "elsewhere");
  end_ranks(rank, 1, RANKS);
  assert_int_not_equal(access(token, F_OK), 0);
  write_text(far_token, host);
  end_ranks(rank, 0, 1);
  assert_int_not_equal(access(far_token, F_OK), 0);
  ssize_t length = read(told, said, sizeof said - 1);
  close(told);
  assert_true(length > 0);
  said[length] = '\0';
  const char *second = strchr(said, '\n') + 1;
  assert_ptr_equal(strchr(second, '\n'), said + length - 1);
}

static void nobody_tells_after_an_error(void **state) {
  pid_t rank[RANKS];
  char said[1000];
  int told;
  start_ranks(rank, &told);
  assert_int_equal(cw_stop_watch(test_folder, "mesh", 0), CW_OK); // as one rank more, which fails
  assert_int_equal(cw_stop_claim(), 1);
  cw_stop_end();
  stop_ranks(rank, 0, told, said);
  assert_string_equal(said, "");
}

static void the_end_leaves_nothing(void **state) {
  struct sigaction action;
  assert_int_equal(cw_stop_watch(test_folder, "mesh", 1), CW_OK);
  assert_int_equal(access(token, F_OK), 0);
  cw_stop_end();
  assert_int_not_equal(access(token, F_OK), 0);
  sigaction(SIGTERM, NULL, &action);
  assert_true(action.sa_handler == SIG_DFL);
  assert_int_equal(cw_stop_claim(), 1); // nobody watches
}

static int make_run(void **state) {
  if (make_test_folder(state)) return -1;
  snprintf(token, sizeof token, "%s/log/mesh.running", test_folder);
  return mkdir(in_test_folder("log"), 0777);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(one_of_all_ranks_tells, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(one_tells_where_the_first_is_killed, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(ranks_elsewhere_leave_the_word_to_the_first_host, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(nobody_tells_after_an_error, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(the_end_leaves_nothing, make_run, clear_test_folder),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
