// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/hash.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

// The prime of FNV-1a, and that of multiplicative hashing (the golden ratio).
static const uint64_t FACTOR[2] = {UINT64_C(1099511628211), UINT64_C(11400714819323198485)};

CwHash cw_hash_start(void) {
  return (CwHash){{UINT64_C(14695981039346656037), UINT64_C(1469598103934665603)}};
}

// One to one in `sum` and in `word`.
static inline uint64_t step(uint64_t sum, uint64_t word, uint64_t factor) {
  sum = (sum ^ word) * factor;
  return sum ^ sum >> 32; // else the upper bits of a word would reach upper bits alone
}

static inline uint64_t word_at(const char *at) {
  uint64_t word;
  memcpy(&word, at, sizeof word);
  return word;
}

void cw_hash_bytes(CwHash *hash, const void *data, size_t size) {
  enum { WORD = sizeof(uint64_t) };
  const char *at = data;
  uint64_t a = hash->sum[0], b = hash->sum[1];
  size_t left = size;
  for (; left >= 2 * WORD; left -= 2 * WORD, at += 2 * WORD) { // two chains, which need not wait for each other
    a = step(a, word_at(at), FACTOR[0]);
    b = step(b, word_at(at + WORD), FACTOR[1]);
  }
  for (; left >= WORD; left -= WORD, at += WORD) a = step(a, word_at(at), FACTOR[0]);
  if (left > 0) {
    uint64_t word = (uint64_t)left << 56; // of a short one also its length
    memcpy(&word, at, left);
    b = step(b, word, FACTOR[1]);
  }
  hash->sum[0] = a;
  hash->sum[1] = step(b, a, FACTOR[1]); // short pieces reach both sums
}

void cw_hash_hex(const CwHash *hash, char text[CW_HASH_TEXT]) {
  snprintf(text, CW_HASH_TEXT, "%016" PRIx64 "%016" PRIx64, hash->sum[0], hash->sum[1]);
}
