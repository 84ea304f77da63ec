// SPDX-License-Identifier: AGPL-3.0-or-later
// Random numbers of a fixed start, the same on every machine (Knuth's linear congruential generator).
#pragma once

#include <stdint.h>

// Draws from [0, 1).
static inline double draw(uint64_t *state) {
  *state = *state * 6364136223846793005u + 1442695040888963407u;
  return (double)(*state >> 11) * 0x1p-53;
}

// Draws from 0 to below - 1.
static inline int draw_below(uint64_t *state, int below) {
  return (int)(draw(state) * below);
}
