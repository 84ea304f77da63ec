// SPDX-License-Identifier: AGPL-3.0-or-later
// Large arrays that a task needs for a while: as many are made as tasks run at a time.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

typedef struct CwScratch CwScratch;

// size: bytes of an array. CW_ERR_MEMORY.
CwStatus cw_scratch_make(int64_t size, CwScratch **scratch);
// An array of zeros, or one that another task has given back, as that has left it; the caller's until it gives it back.
// Any thread. CW_ERR_MEMORY.
CwStatus cw_scratch_take(CwScratch *scratch, void **array);
void cw_scratch_give(CwScratch *scratch, void *array); // NULL is fine
void cw_scratch_free(CwScratch **scratch);             // NULL is fine
