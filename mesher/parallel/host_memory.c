// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/host_memory.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/shm.h>
#include <sys/stat.h>

#include "mesher/parallel/ranks.h"
#include "mesher/parallel/team.h"
#include "pipeline/log.h"

struct CwHostMemory {
  char *at;
  int64_t size;
  int shared;
};

// Of this process, as its memory is: bytes that it shares, now and at most; at most without them.
static int64_t shared_now, shared_peak, own_peak;

static int64_t kibibytes(const char *text, const char *name) {
  const char *at = strstr(text, name);
  return at ? strtoll(at + strlen(name), NULL, 10) : 0;
}

// Since the last call the shared memory was the same: what the process had at most, less what it shares now, was its
// own.
static void note_peak(void) {
  char text[4096] = "";
  FILE *file = fopen("/proc/self/status", "r");
  if (file) {
    size_t length = fread(text, 1, sizeof text - 1, file);
    text[length] = 0;
    fclose(file);
  }
  int64_t own = 1024 * (kibibytes(text, "VmHWM:") - kibibytes(text, "RssShmem:"));
  if (own > own_peak) own_peak = own;
  errno = 0;
}

// Lets the most that the process had begin anew (proc(5)).
static void restart_peak(void) {
  FILE *file = fopen("/proc/self/clear_refs", "w");
  if (file) {
    fputs("5", file);
    fclose(file);
  }
  errno = 0;
}

int64_t cw_host_memory_peak(const CwTeam *all) {
  if (shared_peak == 0) return cw_peak_memory_bytes();
  note_peak();
  return own_peak + (all->host_of[all->rank] == all->rank ? shared_peak : 0);
}

static char *attach(int number) {
  void *at = number < 0 ? (void *)-1 : shmat(number, NULL, 0);
  return at == (void *)-1 ? NULL : at;
}

// [out] at: NULL where not all ranks can have it. Collective.
static void share(const CwTeam *host, int64_t size, char **at) {
  int number = -1, owner = cw_team_rank(host) == 0;
  if (owner) number = shmget(IPC_PRIVATE, (size_t)size, IPC_CREAT | S_IRUSR | S_IWUSR);
  cw_team_broadcast(host, &number, sizeof number, 0);
  *at = attach(number);
  double missing = *at == NULL;
  cw_team_most(host, 1, &missing);
  if (owner && number >= 0) shmctl(number, IPC_RMID, NULL); // goes with the last that has it
  if (missing > 0 && *at) {
    shmdt(*at);
    *at = NULL;
  }
  errno = 0;
}

CwStatus cw_host_memory_make(const CwTeam *host, int64_t size, CwHostMemory **memory) {
  CwStatus status = CW_OK;
  CW_NEW(*memory, 1);
  CwHostMemory *made = *memory;
  made->size = size;
  if (cw_team_ranks(host) > 1 && size > 0) share(host, size, &made->at);
  made->shared = made->at != NULL;
  if (made->shared) {
    note_peak();
    restart_peak();
    shared_now += size;
    if (shared_now > shared_peak) shared_peak = shared_now;
  }
  if (!made->shared) CW_NEW_UNSET(made->at, size);
done:
  if (status != CW_OK) cw_host_memory_free(memory);
  return status;
}

char *cw_host_memory_at(const CwHostMemory *memory) {
  return memory->at;
}

int cw_host_memory_is_shared(const CwHostMemory *memory) {
  return memory->shared;
}

void cw_host_memory_spread(const CwTeam *host, CwHostMemory *memory, int64_t start, int64_t size, int from) {
  if (!memory->shared) cw_team_broadcast(host, memory->at + start, size, from);
  cw_team_barrier(host);
}

void cw_host_memory_seal(CwHostMemory *memory) {
  if (memory->shared) mprotect(memory->at, (size_t)memory->size, PROT_READ);
}

void cw_host_memory_free(CwHostMemory **memory) {
  CwHostMemory *old = *memory;
  if (!old) return;
  if (old->shared) {
    note_peak();
    shmdt(old->at);
    restart_peak();
    shared_now -= old->size;
  } else {
    free(old->at);
  }
  free(old);
  *memory = NULL;
}

typedef struct {
  int pointers; // frees arrays of pointers, or the others
  int shared;   // the others lie in shared memory
} Freeing;

static void free_array(void *given, void **array, int64_t size, int pointers) {
  const Freeing *freeing = given;
  if (pointers != freeing->pointers) return;
  if (pointers || !freeing->shared) free(*array);
  *array = NULL;
}

void cw_arrays_free(void *product, CwArrays arrays, CwHostMemory **memory) {
  Freeing freeing = {.shared = *memory != NULL};
  arrays(product, free_array, &freeing);
  freeing.pointers = 1; // last: they show the way to the others
  arrays(product, free_array, &freeing);
  cw_host_memory_free(memory);
}

static void own_array(void *given, void **array, int64_t size, int pointers) {
  CwStatus *status = given;
  if (pointers || !*array) return;
  void *own = malloc(size > 0 ? (size_t)size : 1);
  if (own)
    memcpy(own, *array, (size_t)size);
  else
    *status = CW_FAIL(CW_ERR_MEMORY, "out of memory: %lld bytes", (long long)size);
  *array = own;
}

CwStatus cw_arrays_own(void *product, CwArrays arrays, CwHostMemory **memory) {
  CwStatus status = CW_OK;
  if (!*memory) return CW_OK;
  arrays(product, own_array, &status);
  cw_host_memory_free(memory);
  return status;
}
