// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/run_lock.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/test_folder.h"
#include "tests/unit_test.h"

static CwRunLock lock;

// Another process takes the folder for the mesher and waits for its end; returns when it has it.
static pid_t start_holder(int *end) {
  int ready[2], go[2];
  char taken = 0;
  assert_true(!pipe(ready) && !pipe(go));
  pid_t child = fork();
  if (child == 0) {
    close(go[1]); // so that the end of the test ends it
    taken = cw_run_lock(test_folder, "mesh", NULL, &lock) == CW_OK;
    _exit(write(ready[1], &taken, 1) != 1 || read(go[0], &taken, 1) < 0);
  }
  assert_int_equal(read(ready[0], &taken, 1), 1);
  assert_true(taken);
  close(ready[0]);
  close(ready[1]);
  close(go[0]);
  *end = go[1];
  return child;
}

static void the_second_is_told_who_has_it(void **state) {
  char host[200] = "", wanted[600];
  int end;
  pid_t child = start_holder(&end);
  gethostname(host, sizeof host - 1);
  snprintf(wanted, sizeof wanted, "%s: cutwater-mesh on host %s, process %d works in this folder; ", test_folder, host,
           (int)child);
  assert_int_equal(cw_run_lock(test_folder, "export", NULL, &lock), CW_ERR_IO);
  if (!strstr(cw_fail_message(), wanted)) fail_msg("%s", cw_fail_message());
  close(end);
  assert_int_equal(waitpid(child, NULL, 0), child);
  assert_int_equal(cw_run_lock(test_folder, "export", NULL, &lock), CW_OK);
  cw_run_unlock(&lock);
}

static void it_dies_with_its_process(void **state) {
  int end;
  pid_t child = start_holder(&end);
  assert_int_equal(cw_run_lock(test_folder, "export", NULL, &lock), CW_ERR_IO);
  kill(child, SIGKILL);
  assert_int_equal(waitpid(child, NULL, 0), child);
  assert_int_equal(cw_run_lock(test_folder, "export", NULL, &lock), CW_OK);
  cw_run_unlock(&lock);
  close(end);
}

// As the mesher starts one for TetGen: such a process may outlive it.
static void a_child_does_not_inherit_it(void **state) {
  int go[2];
  char byte;
  assert_int_equal(pipe(go), 0);
  assert_int_equal(cw_run_lock(test_folder, "mesh", NULL, &lock), CW_OK);
  pid_t child = fork();
  if (child == 0) {
    close(go[1]);
    _exit(read(go[0], &byte, 1) < 0);
  }
  cw_run_unlock(&lock);
  pid_t other = fork();
  if (other == 0) _exit(cw_run_lock(test_folder, "export", NULL, &lock) != CW_OK);
  int how = 0;
  assert_int_equal(waitpid(other, &how, 0), other);
  assert_int_equal(how, 0);
  close(go[1]);
  assert_int_equal(waitpid(child, NULL, 0), child);
}

static void a_folder_that_cannot_be_made_is_told(void **state) {
  const char *path = in_test_folder("log/run.lock");
  assert_int_equal(cw_run_lock(path, "mesh", NULL, &lock), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), path));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_second_is_told_who_has_it),
      cmocka_unit_test(it_dies_with_its_process),
      cmocka_unit_test(a_child_does_not_inherit_it),
      cmocka_unit_test(a_folder_that_cannot_be_made_is_told),
  };
  return cmocka_run_group_tests(tests, make_test_folder, clear_test_folder);
}
