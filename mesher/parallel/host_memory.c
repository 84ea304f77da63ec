// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/host_memory.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <sys/shm.h>
#include <sys/stat.h>
#include <unistd.h>

#include "mesher/parallel/ranks.h"
#include "mesher/parallel/team.h"
#include "pipeline/log.h"

struct CwHostMemory {
  char *at;
  int64_t size;
  int shared;
};

// As all ranks of a host know it: its number, and what stands at its end. Where ranks of one host do not share the
// numbers, another's segment may have this one.
typedef struct {
  int number; // -1: none
  uint64_t sign;
} Segment;

// Why the system last shared none with this process, as errno; 0: it always has.
static int refusal;

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
  int64_t most = kibibytes(text, "VmHWM:");
  int64_t own = most > 0 ? 1024 * (most - kibibytes(text, "RssShmem:")) : cw_peak_memory_bytes();
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

// A segment of `size` bytes and its sign, which goes with the last process that has it, however that ends: Linux lets
// others attach to one that is marked to go.
static Segment make_segment(int64_t size, char **at) {
  Segment made = {.number = shmget(IPC_PRIVATE, (size_t)size + sizeof made.sign, IPC_CREAT | S_IRUSR | S_IWUSR)};
  *at = attach(made.number);
  if (made.number >= 0) shmctl(made.number, IPC_RMID, NULL);
  if (!*at) return (Segment){.number = -1};
  if (getrandom(&made.sign, sizeof made.sign, GRND_NONBLOCK) < 0) made.sign = (uint64_t)getpid();
  memcpy(*at + size, &made.sign, sizeof made.sign);
  return made;
}

// NULL where the number is not this host's, or is another's.
static char *find_segment(const Segment *segment, int64_t size) {
  struct shmid_ds about;
  char *at = NULL;
  if (segment->number < 0 || shmctl(segment->number, IPC_STAT, &about)) return NULL;
  if (about.shm_segsz == (size_t)size + sizeof segment->sign) at = attach(segment->number);
  if (at && memcmp(at + size, &segment->sign, sizeof segment->sign)) {
    shmdt(at);
    at = NULL;
  }
  if (!at && !errno) errno = EIDRM;
  return at;
}

// [out] at: NULL where not all ranks can have it. Collective.
static void share(const CwTeam *host, int64_t size, char **at) {
  int owner = cw_team_rank(host) == 0;
  Segment segment = {0};
  errno = 0;
  if (owner) segment = make_segment(size, at);
  double why = owner && !*at ? errno : 0;
  cw_team_broadcast(host, &segment, sizeof segment, 0);
  errno = 0;
  if (!owner) *at = find_segment(&segment, size);
  if (!owner && !*at && segment.number >= 0) why = errno;
  cw_team_most(host, 1, &why);
  if (why > 0) refusal = (int)why;
  if (why > 0 && *at) {
    shmdt(*at);
    *at = NULL;
  }
  errno = 0;
}

int cw_host_memory_refusal(void) {
  return refusal;
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
