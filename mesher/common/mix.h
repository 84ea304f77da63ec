// SPDX-License-Identifier: AGPL-3.0-or-later
// Scatters numbers over 64 bits: hashes, and random numbers that follow from a place or a count alone.
#pragma once

#include <stdint.h>

static const uint64_t CW_MIX_STEP = 0x9e3779b97f4a7c15ull; // between the numbers of a sequence

// The finaliser of splitmix64: G. Steele, D. Lea and C. Flood, Fast splittable pseudorandom number generators, 2014.
static inline uint64_t cw_mix(uint64_t z) {
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ z >> 27) * 0x94d049bb133111ebull;
  return z ^ z >> 31;
}
