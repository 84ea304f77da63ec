// SPDX-License-Identifier: AGPL-3.0-or-later
// Four numbers side by side, which processors add and multiply at once. Compilers know such vectors; here is what they
// have no sign for.
#pragma once

#include <stdint.h>

typedef float Cw4f __attribute__((vector_size(16)));
typedef int32_t Cw4fMask __attribute__((vector_size(16))); // of a comparison: -1 where it holds, else 0

static inline Cw4f cw_4f_if(Cw4fMask mask, Cw4f a) { // else 0
  return (Cw4f)((Cw4fMask)a & mask);
}

// From a place to another, and 0; rounded after the difference is taken.
static inline Cw4f cw_4f_difference(const double from[3], const double to[3]) {
  typedef double Two __attribute__((vector_size(16)));
  typedef float Half __attribute__((vector_size(8)));
  Two x = (Two){to[0], to[1]} - (Two){from[0], from[1]}, z = (Two){to[2], 0.0} - (Two){from[2], 0.0};
  return __builtin_shufflevector(__builtin_convertvector(x, Half), __builtin_convertvector(z, Half), 0, 1, 2, 3);
}

// Rows become columns.
static inline void cw_4f_transpose(Cw4f v[4]) {
  Cw4f a = __builtin_shufflevector(v[0], v[1], 0, 4, 1, 5), b = __builtin_shufflevector(v[0], v[1], 2, 6, 3, 7);
  Cw4f c = __builtin_shufflevector(v[2], v[3], 0, 4, 1, 5), d = __builtin_shufflevector(v[2], v[3], 2, 6, 3, 7);
  v[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
  v[1] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
  v[2] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  v[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}
