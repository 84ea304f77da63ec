// SPDX-License-Identifier: AGPL-3.0-or-later
// Digests of files: the size, and a sum over words of eight bytes, each times a factor of its place (multilinear
// hashing; Carter, Wegman 1979), of 128 bits. The parts of a file can be summed by several ranks in any order, by
// whoever writes them; zeros, so the holes of a sparse file too, add nothing. Against chance, not against malice:
// damage within one word always shows, any other goes unseen once in 2^64.
#pragma once

#include "pipeline/hash.h"
#include "pipeline/status.h"

enum { CW_FILE_BLOCK = 1 << 22, CW_SUM_PARTS = 4 };

// 32 bits a part, the lowest first, in 64: sums of up to 2^32 ranks are added part by part. Zeroed to begin with.
typedef struct {
  uint64_t part[CW_SUM_PARTS];
} CwFileSum;

// Adds `count` bytes that stand in the file from byte `at` on.
void cw_file_sum_add(CwFileSum *sum, int64_t at, const void *bytes, int64_t count);

// Adds block `first` of a file of `size` bytes and every `stride`-th after it, CW_FILE_BLOCK bytes each; holes are
// not read. CW_ERR_IO.
CwStatus cw_file_sum_blocks(const char *path, int64_t size, int64_t first, int64_t stride, CwFileSum *sum);

void cw_file_sum_digest(const CwFileSum *sum, int64_t size, char digest[CW_HASH_TEXT]);

// In bytes. CW_ERR_IO where it cannot be read.
CwStatus cw_file_size(const char *path, int64_t *size);

// Reads a plain file into new memory, with '\0' behind it. CW_ERR_IO where it cannot be read. [out] text: the caller
// frees it, also after a failure.
CwStatus cw_file_text(const char *path, char **text, size_t *size);

// Digests a whole file. CW_ERR_IO where it cannot be read.
CwStatus cw_file_digest(const char *path, char digest[CW_HASH_TEXT]);
