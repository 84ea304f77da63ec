// SPDX-License-Identifier: AGPL-3.0-or-later
// A library for LD_PRELOAD: what a program brings to the disk and renames, as lines of the file CUTWATER_SYNC_ORDER:
//   PROCESS synced DEVICE:INODE
//   PROCESS renamed on-disk|not-on-disk DEVICE:INODE PATH     of the folder with the new name; the new name
#include "tests/sync_order.h"

#include <stdarg.h>
#include <stdlib.h>

static void put_line(const char *format, ...) {
  char line[5000];
  const char *path = getenv("CUTWATER_SYNC_ORDER");
  int file = path ? open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666) : -1;
  if (file < 0) return;
  va_list arguments;
  va_start(arguments, format);
  int length = snprintf(line, sizeof line, "%d ", (int)getpid());
  length += vsnprintf(line + length, sizeof line - (size_t)length, format, arguments);
  va_end(arguments);
  if (write(file, line, (size_t)length) != length) abort();
  close(file);
}

static void put_sync(const struct stat *file) {
  put_line("synced %llu:%llu\n", (unsigned long long)file->st_dev, (unsigned long long)file->st_ino);
}

static void put_rename(const char *to, int is_on_disk) {
  char folder[4096];
  struct stat about = {0};
  snprintf(folder, sizeof folder, "%s", to);
  char *slash = strrchr(folder, '/');
  if (slash) *slash = '\0';
  stat(slash ? folder : ".", &about);
  put_line("renamed %s %llu:%llu %s\n", is_on_disk ? "on-disk" : "not-on-disk", (unsigned long long)about.st_dev,
           (unsigned long long)about.st_ino, to);
}

__attribute__((constructor)) static void begin(void) {
  tell_sync = put_sync;
  tell_rename = put_rename;
}
