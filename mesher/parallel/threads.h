// SPDX-License-Identifier: AGPL-3.0-or-later
// Threads of a rank, which work in the place of ranks of its host that wait meanwhile: they have one copy of the data.
// For the files of this room.
#pragma once

#include <sched.h>
#include <stdint.h>

#include "pipeline/status.h"

typedef struct CwThreads CwThreads;

// So many threads, the caller among them; they sleep while there is no work. cores: where the others may run; NULL: as
// the caller. Fewer are made where the system has no more. CW_ERR_MEMORY.
CwStatus cw_threads_make(int count, const cpu_set_t *cores, CwThreads **threads);
// Calls body for the items 0 .. count - 1, each by the thread that is free. What the first failing item says is
// returned.
CwStatus cw_threads_run(CwThreads *threads, int32_t count, CwStatus (*body)(void *given, int32_t item), void *given);
int cw_threads_count(const CwThreads *threads); // that were made, and the caller
void cw_threads_free(CwThreads **threads);      // NULL is fine
