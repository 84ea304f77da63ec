// SPDX-License-Identifier: AGPL-3.0-or-later
// Files that several ranks write, each at places of its own.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

typedef struct {
  char *path;
  int descriptor; // 0: not open
} CwPlaceFile;

// Opens `folder`/`name` for writing: a new, empty file, or one that is there. CW_ERR_IO. Zeroed `file` on entry.
CwStatus cw_place_file_open(const char *folder, const char *name, int is_new, CwPlaceFile *file);

// Writes so many bytes at byte `at`. CW_ERR_IO.
CwStatus cw_place_file_put(const CwPlaceFile *file, const void *bytes, int64_t count, int64_t at);

// Writes values as labels of 4 or 8 bytes, little-endian, into which they fit. CW_ERR_IO.
CwStatus cw_place_file_put_labels(const CwPlaceFile *file, const int64_t *values, int64_t count, int size, int64_t at);

// Closes it; fine where it is not open. CW_ERR_IO where the disk is full.
CwStatus cw_place_file_close(CwPlaceFile *file);
