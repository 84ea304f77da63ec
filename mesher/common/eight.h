// SPDX-License-Identifier: AGPL-3.0-or-later
// Eight numbers side by side, of which processors with wide registers (AVX2 on x86) add and multiply all at once, and
// others four: loops over them are compiled for both, and give the same to the bit. Compilers know such vectors; here
// is what they have no sign for. All is always inline, so that it is compiled for the processor of its caller.
#ifndef CUTWATER_MESHER_COMMON_EIGHT_H
#define CUTWATER_MESHER_COMMON_EIGHT_H

#include <stdint.h>

#include "mesher/common/four.h"

#define CW_INLINE static inline __attribute__((always_inline))

// Of functions that a processor without wide registers does not run.
#if defined(__x86_64__) && defined(__GNUC__)
#define CW_WIDE __attribute__((target("avx2")))
#define CW_HAS_WIDE __builtin_cpu_supports("avx2")
#else
#define CW_WIDE
#define CW_HAS_WIDE 0
#endif

typedef float CwEight __attribute__((vector_size(32)));
typedef int32_t CwEightMask __attribute__((vector_size(32))); // of a comparison: -1 where it holds, else 0

CW_INLINE CwEight cw_eight_if(CwEightMask mask, CwEight a) { // else 0
  return (CwEight)((CwEightMask)a & mask);
}

CW_INLINE CwEight cw_eight_less(CwEight a, CwEight b) {
  CwEightMask mask = a < b;
  return (CwEight)(((CwEightMask)a & mask) | ((CwEightMask)b & ~mask));
}

CW_INLINE CwEight cw_eight_more(CwEight a, CwEight b) {
  CwEightMask mask = a > b;
  return (CwEight)(((CwEightMask)a & mask) | ((CwEightMask)b & ~mask));
}

CW_INLINE CwEight cw_eight_sqrt(CwEight a) {
  for (int k = 0; k < 8; k++) a[k] = __builtin_sqrtf(a[k]);
  return a;
}

// One half beside the other.
CW_INLINE CwEight cw_eight_of(CwFour low, CwFour high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

CW_INLINE CwFour cw_eight_low(CwEight a) {
  return __builtin_shufflevector(a, a, 0, 1, 2, 3);
}

CW_INLINE CwFour cw_eight_high(CwEight a) {
  return __builtin_shufflevector(a, a, 4, 5, 6, 7);
}

// Rows become columns, in each half by itself.
CW_INLINE void cw_eight_turn(CwEight v[4]) {
  CwEight a = __builtin_shufflevector(v[0], v[1], 0, 8, 1, 9, 4, 12, 5, 13);
  CwEight b = __builtin_shufflevector(v[0], v[1], 2, 10, 3, 11, 6, 14, 7, 15);
  CwEight c = __builtin_shufflevector(v[2], v[3], 0, 8, 1, 9, 4, 12, 5, 13);
  CwEight d = __builtin_shufflevector(v[2], v[3], 2, 10, 3, 11, 6, 14, 7, 15);
  v[0] = __builtin_shufflevector(a, c, 0, 1, 8, 9, 4, 5, 12, 13);
  v[1] = __builtin_shufflevector(a, c, 2, 3, 10, 11, 6, 7, 14, 15);
  v[2] = __builtin_shufflevector(b, d, 0, 1, 8, 9, 4, 5, 12, 13);
  v[3] = __builtin_shufflevector(b, d, 2, 3, 10, 11, 6, 7, 14, 15);
}

// Of three coordinates each.
CW_INLINE CwEight cw_eight_dot(const CwEight u[3], const CwEight v[3]) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

CW_INLINE void cw_eight_cross(const CwEight u[3], const CwEight v[3], CwEight n[3]) {
  n[0] = u[1] * v[2] - u[2] * v[1];
  n[1] = u[2] * v[0] - u[0] * v[2];
  n[2] = u[0] * v[1] - u[1] * v[0];
}

#endif
