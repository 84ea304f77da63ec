// SPDX-License-Identifier: AGPL-3.0-or-later
// Whole files of a test, which fails where one cannot be read or written.
#pragma once

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/unit_test.h"

// The bytes of a file with a 0 behind them, to be freed; how many in `size`, which may be NULL.
static inline char *read_whole(const char *path, size_t *size) {
  FILE *file = fopen(path, "rb");
  if (!file) fail_msg("%s cannot be read", path);
  fseek(file, 0, SEEK_END);
  const size_t count = (size_t)ftell(file);
  rewind(file);
  char *bytes = malloc(count + 1);
  assert_non_null(bytes);
  assert_int_equal(fread(bytes, 1, count, file), count);
  fclose(file);
  bytes[count] = '\0';
  if (size) *size = count;
  return bytes;
}

// Into a new file: one that is cut to nothing first is brought to the disk by some file systems, which takes long.
static inline void write_whole(const char *path, const char *bytes, size_t size) {
  unlink(path);
  FILE *file = fopen(path, "wb");
  if (!file) fail_msg("%s cannot be written", path);
  assert_int_equal(fwrite(bytes, 1, size, file), size);
  assert_int_equal(fclose(file), 0);
}

static inline void write_text(const char *path, const char *text) {
  write_whole(path, text, strlen(text));
}
