// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/hash.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

// The prime of FNV-1a, and that of multiplicative hashing (the golden ratio).
static const uint64_t FACTOR[2] = {UINT64_C(1099511628211), UINT64_C(11400714819323198485)};

CwHash cw_hash_start(void) {
  return (CwHash){{UINT64_C(14695981039346656037), UINT64_C(1469598103934665603)}};
}

void cw_hash_bytes(CwHash *hash, const void *data, size_t size) {
  const char *at = data;
  for (size_t left = size; left > 0;) {
    size_t taken = left < sizeof(uint64_t) ? left : sizeof(uint64_t);
    uint64_t word = taken < sizeof word ? (uint64_t)taken << 56 : 0; // of a short one also its length
    memcpy(&word, at, taken);
    for (int i = 0; i < 2; i++) {
      hash->sum[i] = (hash->sum[i] ^ word) * FACTOR[i];
      hash->sum[i] ^= hash->sum[i] >> 32; // else the upper bits of a word would reach upper bits alone
    }
    at += taken;
    left -= taken;
  }
}

void cw_hash_hex(const CwHash *hash, char text[33]) {
  snprintf(text, 33, "%016" PRIx64 "%016" PRIx64, hash->sum[0], hash->sum[1]);
}
