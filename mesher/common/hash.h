// SPDX-License-Identifier: AGPL-3.0-or-later
// Fingerprints: two 64-bit sums as in FNV-1a, but word by word and mixed, 128 bits against chance, not against malice.
#ifndef CUTWATER_MESHER_COMMON_HASH_H
#define CUTWATER_MESHER_COMMON_HASH_H

#include <stddef.h>
#include <stdint.h>

typedef struct {
  uint64_t sum[2];
} CwHash;

CwHash cw_hash_start(void);
// Other pieces of the same bytes give other sums.
void cw_hash_bytes(CwHash *hash, const void *data, size_t size);
void cw_hash_hex(const CwHash *hash, char text[33]);

#endif
