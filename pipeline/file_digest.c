// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/file_digest.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

__extension__ typedef unsigned __int128 Wide;

enum { WORD = 8 };

// The factor of a word: its number, mixed one to one by a round of splitmix64 (Steele, Lea, Flood 2014).
static inline uint64_t factor_of(uint64_t number) {
  uint64_t mixed = (number + 1) * UINT64_C(0x9e3779b97f4a7c15);
  mixed = (mixed ^ mixed >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
  return mixed ^ mixed >> 27;
}

// Some bytes of a word, from its byte `from` on; the others 0.
static uint64_t part_of_word(const char *bytes, int64_t from, int64_t count) {
  uint64_t word = 0;
  memcpy((char *)&word + from, bytes, (size_t)count);
  return word;
}

void cw_file_sum_add(CwFileSum *sum, int64_t at, const void *bytes, int64_t count) {
  const char *from = bytes;
  uint64_t number = (uint64_t)at / WORD, word;
  const int64_t within = at % WORD, head = within ? (count < WORD - within ? count : WORD - within) : 0;
  Wide total = 0;
  if (head) {
    total += (Wide)part_of_word(from, within, head) * factor_of(number);
    number++;
    from += head;
    count -= head;
  }
  for (; count >= WORD; count -= WORD, from += WORD, number++) {
    memcpy(&word, from, WORD);
    total += (Wide)word * factor_of(number);
  }
  if (count) total += (Wide)part_of_word(from, 0, count) * factor_of(number);
  for (int k = 0; k < CW_SUM_PARTS; k++) {
    sum->part[k] += (uint32_t)(total >> 32 * k);
    if (k + 1 < CW_SUM_PARTS) sum->part[k + 1] += sum->part[k] >> 32;
    sum->part[k] &= UINT32_MAX;
  }
}

void cw_file_sum_digest(const CwFileSum *sum, int64_t size, char digest[CW_HASH_TEXT]) {
  CwHash all = cw_hash_start();
  Wide total = 0;
  for (int k = 0; k < CW_SUM_PARTS; k++) total += (Wide)sum->part[k] << 32 * k;
  const uint64_t half[2] = {(uint64_t)total, (uint64_t)(total >> 64)};
  cw_hash_bytes(&all, &size, sizeof size);
  cw_hash_bytes(&all, half, sizeof half);
  cw_hash_hex(&all, digest);
}

CwStatus cw_file_size(const char *path, int64_t *size) {
  CwStatus status = CW_OK;
  struct stat about;
  CW_REQUIRE(!stat(path, &about), CW_ERR_IO, "%s: cannot be read: %s", path, strerror(errno));
  CW_REQUIRE(S_ISREG(about.st_mode), CW_ERR_IO, "%s: cannot be read: it is no plain file", path);
  *size = about.st_size;
done:
  return status;
}

CwStatus cw_file_text(const char *path, char **text, size_t *size) {
  CwStatus status = CW_OK;
  int64_t length = 0;
  FILE *file = NULL;
  CW_TRY(cw_file_size(path, &length));
  file = fopen(path, "rb");
  CW_REQUIRE(file, CW_ERR_IO, "%s: cannot be read: %s", path, strerror(errno));
  CW_NEW_UNSET(*text, length + 1);
  *size = fread(*text, 1, (size_t)length, file);
  CW_REQUIRE(!ferror(file), CW_ERR_IO, "%s: cannot be read: %s", path, strerror(errno));
  (*text)[*size] = '\0';
done:
  if (file) fclose(file);
  return status;
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

// Whether nothing was ever written there; 0 where the file system cannot tell.
static int is_hole(int file, int64_t place, int64_t length) {
  const off_t data = lseek(file, place, SEEK_DATA);
  return data < 0 ? errno == ENXIO : data >= place + length;
}

CwStatus cw_file_sum_blocks(const char *path, int64_t size, int64_t first, int64_t stride, CwFileSum *sum) {
  CwStatus status = CW_OK;
  char *block = NULL;
  struct stat about;
  int file = open(path, O_RDONLY | O_CLOEXEC);
  CW_REQUIRE(file >= 0, CW_ERR_IO, "%s: cannot be read: %s", path, strerror(errno));
  CW_REQUIRE(fstat(file, &about) == 0 && about.st_size >= size, CW_ERR_IO, "%s: cannot be read: it has become shorter",
             path);
  CW_NEW_UNSET(block, size < CW_FILE_BLOCK ? size : CW_FILE_BLOCK);
  for (int64_t place = first * CW_FILE_BLOCK; place < size; place += stride * CW_FILE_BLOCK) {
    const int64_t left = size - place, length = left < CW_FILE_BLOCK ? left : CW_FILE_BLOCK;
    if (is_hole(file, place, length)) continue;
    CW_TRY(read_block(file, path, place, (size_t)length, block));
    cw_file_sum_add(sum, place, block, length);
  }
done:
  if (file >= 0) close(file);
  free(block);
  return status;
}

CwStatus cw_file_digest(const char *path, char digest[CW_HASH_TEXT]) {
  CwStatus status = CW_OK;
  CwFileSum sum = {0};
  int64_t size = 0;
  CW_TRY(cw_file_size(path, &size));
  CW_TRY(cw_file_sum_blocks(path, size, 0, 1, &sum));
  cw_file_sum_digest(&sum, size, digest);
done:
  return status;
}
