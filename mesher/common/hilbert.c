// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/hilbert.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/common/box.h"
#include "mesher/common/mix.h"
#include "mesher/common/radix.h"

enum { BITS = 13, LANES = 8 };

// Two zeros before each of 21 bits.
static uint64_t spread(uint64_t a) {
  a = (a | a << 32) & 0x001f00000000ffff;
  a = (a | a << 16) & 0x001f0000ff0000ff;
  a = (a | a << 8) & 0x100f00f00f00f00f;
  a = (a | a << 4) & 0x10c30c30c30c30c3;
  return (a | a << 2) & 0x1249249249249249;
}

// J. Skilling, Programming the Hilbert curve, AIP Conf. Proc. 707 (2004): Gray code of the interleaved bits,
// each cube turned so that its part of the curve begins where the one before ends. For LANES cells side by side, in
// loops that compilers turn into instructions for several at once.
static void find_places(uint32_t c[3][LANES], int bits, uint64_t place[LANES]) {
  for (int b = bits - 1; b > 0; b--) {
    uint32_t below = (1u << b) - 1;
    for (int l = 0; l < LANES; l++) c[0][l] ^= below & -(c[0][l] >> b & 1);
    for (int i = 1; i < 3; i++) {
      // Where the bit is set the bits below it are turned over, else exchanged; without a branch, for it is random.
      for (int l = 0; l < LANES; l++) {
        uint32_t set = -(c[i][l] >> b & 1), t = (c[0][l] ^ c[i][l]) & below & ~set;
        c[0][l] ^= t | (below & set);
        c[i][l] ^= t;
      }
    }
  }
  for (int l = 0; l < LANES; l++) {
    uint32_t y = c[1][l] ^ c[0][l], z = c[2][l] ^ y, turn = z >> 1;
    for (int step = 1; step < bits; step *= 2) turn ^= turn >> step; // whether the bits of z above are odd in number
    place[l] = spread(c[0][l] ^ turn) << 2 | spread(y ^ turn) << 1 | spread(z ^ turn);
  }
}

uint64_t cw_hilbert_place(const uint32_t cell[3], int bits) {
  uint32_t c[3][LANES] = {{cell[0]}, {cell[1]}, {cell[2]}};
  uint64_t place[LANES];
  find_places(c, bits, place);
  return place[0];
}

// Every point stays with probability 7/8 for the last round, every other one for the round before, and so on.
static int round_of(uint64_t number, int rounds) {
  uint64_t z = cw_mix(number + CW_MIX_STEP);
  int round = rounds - 1;
  while (round > 0 && (z & 7) == 0) {
    round--;
    z >>= 3;
  }
  return round;
}

static CwStatus order_points(int32_t count, const double (*x)[3], int rounds, int32_t *order) {
  CwStatus status = CW_OK;
  CwRadix *record = NULL;
  CwBox box = cw_box_of_points(count, x);
  double extent = cw_box_longest(&box);
  CW_NEW_UNSET(record, count);
  double cells = extent > 0.0 ? (double)(1 << BITS) / extent : 0.0;
  for (int32_t first = 0; first < count; first += LANES) {
    int32_t lanes = count - first < LANES ? count - first : LANES;
    uint32_t cell[3][LANES] = {{0}};
    uint64_t place[LANES];
    for (int l = 0; l < lanes; l++) {
      for (int i = 0; i < 3; i++) {
        double along = (x[first + l][i] - box.low[i]) * cells;
        cell[i][l] = along < (double)((1 << BITS) - 1) ? (uint32_t)along : (1u << BITS) - 1;
      }
    }
    find_places(cell, BITS, place);
    for (int l = 0; l < lanes; l++) {
      int32_t p = first + l;
      record[p] = (CwRadix){(uint64_t)round_of((uint64_t)p, rounds) << (3 * BITS) | place[l], p, 0};
    }
  }
  CW_TRY(cw_radix_sort(count, record));
  for (int32_t k = 0; k < count; k++) order[k] = record[k].item;
done:
  free(record);
  return status;
}

CwStatus cw_hilbert_order(int32_t count, const double (*x)[3], int32_t *order) {
  return order_points(count, x, 1, order);
}

CwStatus cw_hilbert_rounds(int32_t count, const double (*x)[3], int32_t *order) {
  int rounds = 1;
  for (int32_t n = count; n > 64; n /= 8) rounds++;
  return order_points(count, x, rounds, order);
}
