// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/beside.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

// Seen by both processes.
struct CwBeside {
  pid_t process; // -1: the work was done at once
  CwStatus status;
  CwFailure failure;
};

static void run_here(CwBeside *beside, CwStatus (*run)(const void *given), const void *given) {
  beside->status = run(given);
  if (beside->status != CW_OK) beside->failure = *cw_failure();
}

CwStatus cw_beside_start(CwStatus (*run)(const void *given), const void *given, CwBeside **beside) {
  CwStatus status = CW_OK;
  const pid_t caller = getpid();
  CwBeside *made = mmap(NULL, sizeof *made, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  CW_REQUIRE(made != MAP_FAILED, CW_ERR_MEMORY, "out of memory for a process");
  *beside = made;
  fflush(NULL); // or the child might print it again
  const pid_t process = fork();
  if (process != 0) made->process = process; // the child's 0 would be seen here
  if (process < 0) {
    run_here(made, run, given);
  } else if (process == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() == caller) run_here(made, run, given);
    _exit(0);
  }
done:
  return status;
}

CwStatus cw_beside_end(CwBeside **beside, const char *what) {
  CwStatus status = CW_OK;
  CwBeside *made = *beside;
  int how = 0;
  if (!made) return CW_OK;
  while (made->process > 0 && waitpid(made->process, &how, 0) < 0 && errno == EINTR) continue;
  CW_REQUIRE(!WIFSIGNALED(how), CW_ERR_LIBRARY, "%s: the process that makes it was ended by signal %d", what,
             WTERMSIG(how));
  status = made->status;
  if (status != CW_OK) *cw_failure() = made->failure;
done:
  munmap(made, sizeof *made);
  *beside = NULL;
  return status;
}

void cw_beside_drop(CwBeside **beside) {
  const CwFailure own = *cw_failure();
  cw_beside_end(beside, "");
  *cw_failure() = own;
}
