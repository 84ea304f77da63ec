// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/mpi_settings.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "pipeline/log.h"
#include "pipeline/status.h"

// Open MPI 4.1 crashes where memory ends while it starts, for which it takes about 45 MiB (measured with one rank).
static const size_t START_MEMORY = (size_t)64 << 20;

static void require_memory(void) {
  const char *rank = getenv("OMPI_COMM_WORLD_RANK");
#ifdef M_ARENA_MAX
  // Where address space is limited, MPI's threads must not take 64 MiB of it each for heaps of their own.
  struct rlimit space;
  if (!getrlimit(RLIMIT_AS, &space) && space.rlim_cur != RLIM_INFINITY) mallopt(M_ARENA_MAX, 1);
#endif
  void *room = mmap(NULL, START_MEMORY, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room != MAP_FAILED) {
    munmap(room, START_MEMORY);
    return;
  }
  CwStatus status = CW_FAIL(CW_ERR_MEMORY, "out of memory: MPI needs %zu MiB to start", START_MEMORY >> 20);
  exit(!rank || !strcmp(rank, "0") ? cw_log_error(NULL, status) : (int)status);
}

// Whether a process may read the memory of another of the same user: a child tries with this one.
static int may_read_memory(void) {
  static volatile int word;
  word = 1;
  pid_t parent = getpid(), child = fork();
  int code = 1;
  if (child < 0) return 0;
  if (child == 0) {
    int seen = word = 0;
    struct iovec here = {&seen, sizeof seen}, there = {(void *)&word, sizeof word};
    _exit(process_vm_readv(parent, &here, 1, &there, 1, 0) == sizeof seen && seen == 1 ? 0 : 1);
  }
  return waitpid(child, &code, 0) == child && code == 0;
}

void cw_mpi_settings(void) {
  require_memory();
  setenv("OMPI_MCA_sharedfp", "^lockedfile", 0);
  const char *all = getenv("OMPI_COMM_WORLD_SIZE"), *here = getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
  int alone = !all && !getenv("PMIX_NAMESPACE") && !getenv("PMI_RANK"); // other launchers set one of these
  if (alone) setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  int one_host = alone || (all && here && strcmp(all, here) == 0);
  if (one_host) setenv("OMPI_MCA_pml", "ob1", 0);
  const char *copies = "OMPI_MCA_btl_vader_single_copy_mechanism";
  if (!alone && !getenv(copies) && !may_read_memory()) setenv(copies, "none", 0);
}
