// SPDX-License-Identifier: AGPL-3.0-or-later
// Digests of files. A file is digested by blocks of CW_FILE_BLOCK bytes and these together, so that ranks can share the
// blocks of a large one.
#ifndef CUTWATER_PIPELINE_FILE_DIGEST_H
#define CUTWATER_PIPELINE_FILE_DIGEST_H

#include "pipeline/hash.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_FILE_BLOCK = 1 << 22 };

// Digests a whole file. CW_ERR_IO where it cannot be read.
CwStatus cw_file_digest(const char *path, char digest[CW_HASH_TEXT]);

// The same in parts: the size of a file, by which it has blocks; the digests of block `first` and every `stride`-th
// after it, put into blocks[first], ...; and those of all blocks joined.
CwStatus cw_file_size(const char *path, int64_t *size);
int64_t cw_file_block_count(int64_t size);
CwStatus cw_file_digest_blocks(const char *path, int64_t size, int64_t first, int64_t stride, CwHash *blocks);
void cw_file_digest_join(const CwHash *blocks, int64_t size, char digest[CW_HASH_TEXT]);

#ifdef __cplusplus
}
#endif
#endif
