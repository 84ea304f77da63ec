// SPDX-License-Identifier: AGPL-3.0-or-later
// The smoothing of one block of vertices.
#ifndef CUTWATER_MESHER_LAYERS_DIRECTION_SMOOTHING_BLOCK_H
#define CUTWATER_MESHER_LAYERS_DIRECTION_SMOOTHING_BLOCK_H

#include "mesher/layers/direction_smoothing_work.h"
#include "pipeline/status.h"

// Members of a block.
int32_t cw_smoothing_block_size(const CwSmoothing *smoothing, int32_t block);

// Solves one block: a task (CwTask) over CwSmoothing; gives the CwLean of its members.
CwStatus cw_smoothing_solve_block(void *smoothing, int32_t block, void **bytes, int64_t *size);

#endif
