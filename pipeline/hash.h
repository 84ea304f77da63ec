// SPDX-License-Identifier: AGPL-3.0-or-later
// Digests of what is in memory: against chance, not against malice. Two 64-bit sums as in FNV-1a (Fowler, Noll, Vo
// 1991), but of words of eight bytes in turn, each mixed. A step can be undone, so damage within one word always shows;
// any other goes unseen once in 2^64.
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_HASH_TEXT = 33 }; // characters of a digest in hex, with the end

typedef struct {
  uint64_t sum[2];
} CwHash;

CwHash cw_hash_start(void);
// The same bytes in other pieces give another digest.
void cw_hash_bytes(CwHash *hash, const void *data, size_t size);
void cw_hash_hex(const CwHash *hash, char text[CW_HASH_TEXT]);

#ifdef __cplusplus
}
#endif
