// SPDX-License-Identifier: AGPL-3.0-or-later
// HDF5's own writes come here in a program that includes this: one of them may find the disk full for a moment.
#pragma once

#include <errno.h>
#include <sys/syscall.h>
#include <unistd.h>

// Made so far; the one that is refused, counted from 1 (0: none).
static int writes, refused_write;

ssize_t pwrite(int file, const void *bytes, size_t size, off_t place) {
  if (++writes == refused_write) {
    errno = ENOSPC;
    return -1;
  }
  return syscall(SYS_pwrite64, file, bytes, size, place);
}
