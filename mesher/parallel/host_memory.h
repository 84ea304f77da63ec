// SPDX-License-Identifier: AGPL-3.0-or-later
// Memory that the ranks of a host share: what each of them needs whole and none changes lies there once (System V
// shared memory, which goes with its last user, however that ends).
#pragma once

#include <stdint.h>

#include "mesher/parallel/context.h"
#include "pipeline/status.h"

typedef struct CwHostMemory CwHostMemory;

// Shows an array of a product to `visit`: its place in the product and its bytes. pointers: 1: its items hold pointers
// to further arrays, which are shown after it, so that each rank has it for itself.
typedef void (*CwArrayVisit)(void *given, void **array, int64_t size, int pointers);
// Shows all arrays of a product; sizes follow from its numbers and from arrays shown before. One that is NULL may be
// shown with its size; arrays behind pointers that are NULL are not shown.
typedef void (*CwArrays)(void *product, CwArrayVisit visit, void *given);
// For a function of that kind: `pointer` with `count` items; the same of items that hold pointers.
#define CW_SHOW(visit, given, pointer, count)                                                                          \
  (visit)((given), (void **)&(pointer), (int64_t)(count) * (int64_t)sizeof *(pointer), 0)
#define CW_SHOW_POINTERS(visit, given, pointer, count)                                                                 \
  (visit)((given), (void **)&(pointer), (int64_t)(count) * (int64_t)sizeof *(pointer), 1)

// `size` bytes for all ranks of the host team. Where the system shares none with one of them, each has as many of its
// own. Collective over `host`. CW_ERR_MEMORY.
CwStatus cw_host_memory_make(const CwTeam *host, int64_t size, CwHostMemory **memory);
char *cw_host_memory_at(const CwHostMemory *memory);
int cw_host_memory_is_shared(const CwHostMemory *memory);
// Where it is not shared, the other ranks get what the rank `from` of the host team has in `size` bytes from `start`
// on; then all have what was written before. Collective over `host`.
void cw_host_memory_spread(const CwTeam *host, CwHostMemory *memory, int64_t start, int64_t size, int from);
// From here on it is only read: the system stops who writes.
void cw_host_memory_seal(CwHostMemory *memory);
void cw_host_memory_free(CwHostMemory **memory); // not collective; NULL is fine
// Why the system last refused to share memory on this host, as errno; 0: it never has.
int cw_host_memory_refusal(void);
// Peak memory of this rank in bytes, without what its host's ranks share; that counts on the first of them. Linux's own
// peak of the process (VmHWM, getrusage) begins anew with each piece of memory made or freed.
int64_t cw_host_memory_peak(const CwTeam *all);

// Frees a product's arrays: those of malloc, or the memory that they lie in. [in,out] memory: the product's; NULL:
// none.
void cw_arrays_free(void *product, CwArrays arrays, CwHostMemory **memory);
// Makes shared arrays this rank's own, to change them. CW_ERR_MEMORY.
CwStatus cw_arrays_own(void *product, CwArrays arrays, CwHostMemory **memory);
