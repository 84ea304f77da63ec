// SPDX-License-Identifier: AGPL-3.0-or-later
// Sorting by whole numbers, digit by digit from the lowest: in a time that grows as the count, and stable.
#pragma once

#include <stdint.h>
#include <string.h>

#include "pipeline/status.h"

typedef struct {
  uint64_t key;
  int32_t item, tag; // go with it
} CwRadix;

// By ascending keys; equal ones stay in their order. Takes as much memory again meanwhile. Bits that all keys have in
// common cost nothing.
CwStatus cw_radix_sort(int64_t count, CwRadix *record);

// A key that ascends as the number does; -0 comes before 0. Not for NaN.
static inline uint64_t cw_radix_key(double number) {
  uint64_t bits;
  memcpy(&bits, &number, sizeof bits);
  return bits >> 63 ? ~bits : bits | (uint64_t)1 << 63;
}
