// SPDX-License-Identifier: AGPL-3.0-or-later
// Eight numbers side by side, of which processors with wide registers (AVX2 on x86) add and multiply all at once, and
// others four: loops over them are compiled for both, and give the same to the bit. Compilers know such vectors; here
// is what they have no sign for. All is always inline, so that it is compiled for the processor of its caller.
#pragma once

#include <stdint.h>

#include "mesher/common/simd_4f.h"

#define CW_INLINE static inline __attribute__((always_inline))

// Of functions that a processor without wide registers does not run.
#if defined(__x86_64__) && defined(__GNUC__)
#define CW_AVX2 __attribute__((target("avx2")))
#define CW_HAS_AVX2 __builtin_cpu_supports("avx2")
#else
#define CW_AVX2
#define CW_HAS_AVX2 0
#endif

typedef float Cw8f __attribute__((vector_size(32)));
typedef int32_t Cw8fMask __attribute__((vector_size(32))); // of a comparison: -1 where it holds, else 0

CW_INLINE Cw8f cw_8f_if(Cw8fMask mask, Cw8f a) { // else 0
  return (Cw8f)((Cw8fMask)a & mask);
}

CW_INLINE Cw8f cw_8f_min(Cw8f a, Cw8f b) {
  Cw8fMask mask = a < b;
  return (Cw8f)(((Cw8fMask)a & mask) | ((Cw8fMask)b & ~mask));
}

CW_INLINE Cw8f cw_8f_max(Cw8f a, Cw8f b) {
  Cw8fMask mask = a > b;
  return (Cw8f)(((Cw8fMask)a & mask) | ((Cw8fMask)b & ~mask));
}

CW_INLINE Cw8f cw_8f_sqrt(Cw8f a) {
  for (int k = 0; k < 8; k++) a[k] = __builtin_sqrtf(a[k]);
  return a;
}

// One half beside the other.
CW_INLINE Cw8f cw_8f_join(Cw4f low, Cw4f high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

CW_INLINE Cw4f cw_8f_low(Cw8f a) {
  return __builtin_shufflevector(a, a, 0, 1, 2, 3);
}

CW_INLINE Cw4f cw_8f_high(Cw8f a) {
  return __builtin_shufflevector(a, a, 4, 5, 6, 7);
}

// Rows become columns, in each half by itself.
CW_INLINE void cw_8f_transpose(Cw8f v[4]) {
  Cw8f a = __builtin_shufflevector(v[0], v[1], 0, 8, 1, 9, 4, 12, 5, 13);
  Cw8f b = __builtin_shufflevector(v[0], v[1], 2, 10, 3, 11, 6, 14, 7, 15);
  Cw8f c = __builtin_shufflevector(v[2], v[3], 0, 8, 1, 9, 4, 12, 5, 13);
  Cw8f d = __builtin_shufflevector(v[2], v[3], 2, 10, 3, 11, 6, 14, 7, 15);
  v[0] = __builtin_shufflevector(a, c, 0, 1, 8, 9, 4, 5, 12, 13);
  v[1] = __builtin_shufflevector(a, c, 2, 3, 10, 11, 6, 7, 14, 15);
  v[2] = __builtin_shufflevector(b, d, 0, 1, 8, 9, 4, 5, 12, 13);
  v[3] = __builtin_shufflevector(b, d, 2, 3, 10, 11, 6, 7, 14, 15);
}

// Of three coordinates each.
CW_INLINE Cw8f cw_8f_dot(const Cw8f u[3], const Cw8f v[3]) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

CW_INLINE void cw_8f_cross(const Cw8f u[3], const Cw8f v[3], Cw8f n[3]) {
  n[0] = u[1] * v[2] - u[2] * v[1];
  n[1] = u[2] * v[0] - u[0] * v[2];
  n[2] = u[0] * v[1] - u[1] * v[0];
}
