// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/file_digest.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

CwStatus cw_file_size(const char *path, int64_t *size) {
  CwStatus status = CW_OK;
  struct stat about;
  CW_REQUIRE(!stat(path, &about), CW_ERR_IO, "%s: cannot be read: %s", path, strerror(errno));
  CW_REQUIRE(S_ISREG(about.st_mode), CW_ERR_IO, "%s: cannot be read: it is no plain file", path);
  *size = about.st_size;
done:
  return status;
}

int64_t cw_file_block_count(int64_t size) {
  return (size + CW_FILE_BLOCK - 1) / CW_FILE_BLOCK;
}

// `size` bytes from `place` on.
static CwStatus read_block(int file, const char *path, int64_t place, size_t size, char *block) {
  CwStatus status = CW_OK;
  for (size_t done = 0; done < size;) {
    ssize_t got = pread(file, block + done, size - done, place + (int64_t)done);
    CW_REQUIRE(got > 0, CW_ERR_IO, "%s: cannot be read: %s", path, got < 0 ? strerror(errno) : "it has become shorter");
    done += (size_t)got;
  }
done:
  return status;
}

CwStatus cw_file_digest_blocks(const char *path, int64_t size, int64_t first, int64_t stride, CwHash *blocks) {
  CwStatus status = CW_OK;
  char *block = NULL;
  int file = open(path, O_RDONLY | O_CLOEXEC);
  CW_REQUIRE(file >= 0, CW_ERR_IO, "%s: cannot be read: %s", path, strerror(errno));
  CW_NEW_UNSET(block, size < CW_FILE_BLOCK ? size : CW_FILE_BLOCK);
  for (int64_t b = first; b < cw_file_block_count(size); b += stride) {
    int64_t place = b * CW_FILE_BLOCK, left = size - place;
    size_t length = (size_t)(left < CW_FILE_BLOCK ? left : CW_FILE_BLOCK);
    CW_TRY(read_block(file, path, place, length, block));
    blocks[b] = cw_hash_start();
    cw_hash_bytes(&blocks[b], block, length);
  }
done:
  if (file >= 0) close(file);
  free(block);
  return status;
}

void cw_file_digest_join(const CwHash *blocks, int64_t size, char digest[CW_HASH_TEXT]) {
  CwHash all = cw_hash_start();
  cw_hash_bytes(&all, &size, sizeof size);
  cw_hash_bytes(&all, blocks, (size_t)cw_file_block_count(size) * sizeof *blocks);
  cw_hash_hex(&all, digest);
}

CwStatus cw_file_digest(const char *path, char digest[CW_HASH_TEXT]) {
  CwStatus status = CW_OK;
  CwHash *blocks = NULL;
  int64_t size = 0;
  CW_TRY(cw_file_size(path, &size));
  CW_NEW(blocks, cw_file_block_count(size));
  CW_TRY(cw_file_digest_blocks(path, size, 0, 1, blocks));
  cw_file_digest_join(blocks, size, digest);
done:
  free(blocks);
  return status;
}
