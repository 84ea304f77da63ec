// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/folder.h"

#include <errno.h>
#include <ftw.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "pipeline/atomic_file.h"

CwStatus cw_path_set(char **path, const char *format, ...) {
  CwStatus status = CW_OK;
  char *made = NULL;
  va_list arguments;
  va_start(arguments, format);
  const int length = vasprintf(&made, format, arguments);
  va_end(arguments);
  CW_REQUIRE(length >= 0, CW_ERR_MEMORY, "out of memory");
  free(*path);
  *path = made;
done:
  return status;
}

CwStatus cw_link_make(const char *path, const char *target) {
  CwStatus status = CW_OK;
  CW_REQUIRE(symlink(target, path) == 0, CW_ERR_IO, "%s: cannot be made: %s", path, strerror(errno));
done:
  return status;
}

static int remove_one(const char *path, const struct stat *info, int kind, struct FTW *place) {
  return remove(path);
}

CwStatus cw_folder_remove(const char *path) {
  CwStatus status = CW_OK;
  CW_REQUIRE(nftw(path, remove_one, 16, FTW_DEPTH | FTW_PHYS) == 0 || errno == ENOENT, CW_ERR_IO,
             "%s: cannot be removed: %s", path, strerror(errno));
done:
  return status;
}

static int sync_one(const char *path, const struct stat *info, int kind, struct FTW *place) {
  return (S_ISREG(info->st_mode) || S_ISDIR(info->st_mode)) && cw_sync(path) != CW_OK;
}

CwStatus cw_folder_sync(const char *path) {
  int failed = nftw(path, sync_one, 16, FTW_DEPTH | FTW_PHYS);
  return failed == 0  ? CW_OK
         : failed > 0 ? CW_ERR_IO // cw_sync has told
                      : CW_FAIL(CW_ERR_IO, "%s: cannot be brought to the disk: %s", path, strerror(errno));
}

static int sync_one_begin(const char *path, const struct stat *info, int kind, struct FTW *place) {
  if (S_ISREG(info->st_mode)) cw_sync_begin(path);
  return 0;
}

void cw_folder_sync_begin(const char *path) {
  nftw(path, sync_one_begin, 16, FTW_PHYS); // what fails here cw_folder_sync() tells
}

CwStatus cw_folder_replace(const char *from, const char *to) {
  CwStatus status = CW_OK;
  char *old = NULL;
  CW_TRY(cw_path_set(&old, "%s.old", to));
  CW_TRY(cw_folder_remove(old));
  CW_REQUIRE(rename(to, old) == 0 || errno == ENOENT, CW_ERR_IO, "%s: cannot be moved aside: %s", to, strerror(errno));
  if (rename(from, to)) {
    status = CW_FAIL(CW_ERR_IO, "%s: cannot be renamed to %s: %s", from, to, strerror(errno));
    rename(old, to);
    goto done;
  }
  CW_TRY(cw_sync_folder_of(to));
  CW_TRY(cw_folder_remove(old));
done:
  free(old);
  return status;
}
