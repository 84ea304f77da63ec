// SPDX-License-Identifier: AGPL-3.0-or-later
// Region numbers (paper, section 2.3): a colouring of the adjacency graph of the regions, so that the longest chain
// "small number first" is as long as the number of colours.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Greedy colouring, largest degree first, ties by index. `pair` holds each adjacent pair once. Writes region numbers
// from 1: regions are ordered by (colour, index), so neighbours never share a colour and a smaller colour always has
// the smaller number. `colour` (0-based) may be NULL. Returns the number of colours through *colours.
CwStatus cw_region_numbers(int32_t region_count, int32_t pair_count, const int32_t (*pair)[2], int32_t *number,
                           int32_t *colour, int32_t *colours);

#ifdef __cplusplus
}
#endif
