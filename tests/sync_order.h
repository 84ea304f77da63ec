// SPDX-License-Identifier: AGPL-3.0-or-later
// In a program that includes this, fsync and rename come here first: it is known whether a file, or each file of a
// folder, was on the disk as it is when it took its name, and the folder with the name after that.
#pragma once

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { SYNCED_MOST = 4096 };

static struct stat synced[SYNCED_MOST]; // what was brought to the disk, as it was then
static int synced_count;
static void (*tell_sync)(const struct stat *file); // may be NULL
static void (*tell_rename)(const char *to, int was_synced);

int fsync(int file) {
  struct stat now;
  int result = (int)syscall(SYS_fsync, file), cause = errno;
  if (!fstat(file, &now) && synced_count < SYNCED_MOST) {
    synced[synced_count++] = now;
    if (tell_sync) tell_sync(&now);
  }
  errno = cause;
  return result;
}

static int was_synced(const struct stat *now) {
  for (int i = synced_count - 1; i >= 0; --i) {
    const struct stat *then = &synced[i];
    if (then->st_dev == now->st_dev && then->st_ino == now->st_ino)
      return then->st_size == now->st_size && then->st_mtim.tv_sec == now->st_mtim.tv_sec &&
             then->st_mtim.tv_nsec == now->st_mtim.tv_nsec;
  }
  return 0;
}

static int is_not_synced(const char *path, const struct stat *now, int kind, struct FTW *place) {
  return (S_ISREG(now->st_mode) || S_ISDIR(now->st_mode)) && !was_synced(now);
}

int rename(const char *from, const char *to) {
  int is_on_disk = nftw(from, is_not_synced, 16, FTW_PHYS) == 0;
  int result = renameat(AT_FDCWD, from, AT_FDCWD, to), cause = errno;
  if (!result && tell_rename) tell_rename(to, is_on_disk);
  errno = cause;
  return result;
}
