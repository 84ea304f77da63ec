// SPDX-License-Identifier: AGPL-3.0-or-later
#include <stdlib.h>
#include <string.h>
#include <errno.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "pipeline/mpi_settings.h"
#include "tests/unit_test.h"

static const char *const names[] = {"OMPI_COMM_WORLD_SIZE",
                                    "OMPI_COMM_WORLD_LOCAL_SIZE",
                                    "PMIX_NAMESPACE",
                                    "PMI_RANK",
                                    "OMPI_MCA_ess_singleton_isolated",
                                    "OMPI_MCA_pml",
                                    "OMPI_MCA_sharedfp",
                                    "OMPI_MCA_btl_vader_single_copy_mechanism"};

static int forget_all(void **state) {
  for (size_t k = 0; k < sizeof names / sizeof *names; k++) unsetenv(names[k]);
  return 0;
}

static void a_rank_without_mpirun_starts_no_daemon(void **state) {
  cw_mpi_settings();
  assert_string_equal(getenv("OMPI_MCA_ess_singleton_isolated"), "1");
  assert_string_equal(getenv("OMPI_MCA_pml"), "ob1");
}

static void ranks_of_one_machine_share_memory(void **state) {
  setenv("OMPI_COMM_WORLD_SIZE", "4", 1);
  setenv("OMPI_COMM_WORLD_LOCAL_SIZE", "4", 1);
  cw_mpi_settings();
  assert_null(getenv("OMPI_MCA_ess_singleton_isolated"));
  assert_string_equal(getenv("OMPI_MCA_pml"), "ob1");
}

static void ranks_of_several_machines_take_what_there_is(void **state) {
  setenv("OMPI_COMM_WORLD_SIZE", "8", 1);
  setenv("OMPI_COMM_WORLD_LOCAL_SIZE", "4", 1);
  cw_mpi_settings();
  assert_null(getenv("OMPI_MCA_ess_singleton_isolated"));
  assert_null(getenv("OMPI_MCA_pml"));
}

static void other_launchers_are_left_alone(void **state) {
  for (int k = 2; k < 4; k++) {
    forget_all(NULL);
    setenv(names[k], "1", 1);
    cw_mpi_settings();
    assert_null(getenv("OMPI_MCA_ess_singleton_isolated"));
    assert_null(getenv("OMPI_MCA_pml"));
  }
}

static void the_component_that_fails_at_long_paths_is_left_out(void **state) {
  setenv("PMI_RANK", "1", 1);
  cw_mpi_settings();
  assert_string_equal(getenv("OMPI_MCA_sharedfp"), "^lockedfile");
}

static void what_the_user_chose_stays(void **state) {
  setenv("OMPI_MCA_pml", "ucx", 1);
  setenv("OMPI_MCA_sharedfp", "sm", 1);
  cw_mpi_settings();
  assert_string_equal(getenv("OMPI_MCA_pml"), "ucx");
  assert_string_equal(getenv("OMPI_MCA_sharedfp"), "sm");
}

// From here on this process may read no memory of another, as in a container that forbids it. 0: the kernel has no such
// filters.
static int forbid_reading(void) {
  struct sock_filter lines[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, 0), // the number of the system call
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_process_vm_readv, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  struct sock_fprog filter = {sizeof lines / sizeof *lines, lines};
  return !prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) && !prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter);
}

static void messages_are_copied_once_where_that_is_allowed(void **state) {
  static const char *const copies = "OMPI_MCA_btl_vader_single_copy_mechanism";
  int code;
  setenv("OMPI_COMM_WORLD_SIZE", "4", 1);
  pid_t child = fork();
  if (child == 0) {
    if (!forbid_reading()) _exit(77);
    cw_mpi_settings();
    const char *chosen = getenv(copies);
    _exit(chosen && !strcmp(chosen, "none") ? 0 : 1);
  }
  assert_int_equal(waitpid(child, &code, 0), child);
  if (WEXITSTATUS(code) == 77) skip();
  assert_int_equal(code, 0);
  setenv(copies, "knem", 1);
  cw_mpi_settings();
  assert_string_equal(getenv(copies), "knem");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup(a_rank_without_mpirun_starts_no_daemon, forget_all),
      cmocka_unit_test_setup(ranks_of_one_machine_share_memory, forget_all),
      cmocka_unit_test_setup(ranks_of_several_machines_take_what_there_is, forget_all),
      cmocka_unit_test_setup(other_launchers_are_left_alone, forget_all),
      cmocka_unit_test_setup(the_component_that_fails_at_long_paths_is_left_out, forget_all),
      cmocka_unit_test_setup(what_the_user_chose_stays, forget_all),
      cmocka_unit_test_setup(messages_are_copied_once_where_that_is_allowed, forget_all),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
