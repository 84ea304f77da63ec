// SPDX-License-Identifier: AGPL-3.0-or-later
// Work on many small items (vertices, triangles) in blocks over the ranks. The blocks follow from the count alone and
// each item from itself alone, so that the bits are the same for any number of ranks.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "mesher/parallel/context.h"
#include "pipeline/status.h"

// Fills the `width` zeroed bytes of one item. given: as cw_parallel_for was. Several threads call it at a time where
// the team works by threads (groups.h).
typedef CwStatus (*CwParallelBody)(void *given, int32_t item, void *out);

// Calls body for the items 0 .. count-1; all ranks get all of `out`. step: in the profiler.
CwStatus cw_parallel_for(const CwContext *context, const char *step, int32_t count, size_t width, CwParallelBody body,
                         void *given, void *out);

// The same where item i has a list: entries start[i] .. start[i + 1] - 1 of `out`, of `width` bytes each.
CwStatus cw_parallel_for_lists(const CwContext *context, const char *step, int32_t count, const int32_t *start,
                               size_t width, CwParallelBody body, void *given, void *out);
