// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/run_lock.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "pipeline/atomic_file.h"
#include "pipeline/log.h"

// What the holder wrote; it may be about to.
static void read_holder(int file, char *text, size_t size) {
  ssize_t length = pread(file, text, size - 1, 0);
  text[length > 0 ? length : 0] = '\0';
  text[strcspn(text, "\n")] = '\0';
  if (!*text) snprintf(text, size, "another process");
}

static CwStatus write_holder(int file, const char *path, const char *stage) {
  CwStatus status = CW_OK;
  char host[HOST_NAME_MAX + 1] = "", text[HOST_NAME_MAX + 100];
  gethostname(host, sizeof host - 1);
  int length = snprintf(text, sizeof text, "cutwater-%s on host %s, process %d\n", stage, host, (int)getpid());
  CW_REQUIRE(!ftruncate(file, 0) && pwrite(file, text, (size_t)length, 0) == length, CW_ERR_IO,
             "%s: cannot be written: %s", path, strerror(errno));
done:
  return status;
}

CwStatus cw_run_lock(const char *run, const char *stage, CwLog *log, CwRunLock *lock) {
  CwStatus status = CW_OK;
  char *folder = NULL, *path = NULL, holder[HOST_NAME_MAX + 100];
  int file = -1;
  cw_run_unlock(lock);
  CW_REQUIRE(asprintf(&folder, "%s/log", run) >= 0 && asprintf(&path, "%s/run.lock", folder) >= 0, CW_ERR_MEMORY,
             "out of memory: the name %s/log/run.lock", run);
  CW_TRY(cw_make_directory(folder));
  file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  CW_REQUIRE(file >= 0, CW_ERR_IO, "%s: cannot be written: %s", path, strerror(errno));
  if (fcntl(file, F_SETLK, &(struct flock){.l_type = F_WRLCK, .l_whence = SEEK_SET})) {
    int cause = errno;
    read_holder(file, holder, sizeof holder);
    CW_REQUIRE(cause != EAGAIN && cause != EACCES, CW_ERR_IO,
               "%s: %s works in this folder; wait until it ends, or give another --run", run, holder);
    cw_log_warn(log, "%s: cannot be locked: %s; see to it that no other stage works in this folder", run,
                strerror(cause));
  }
  CW_TRY(write_holder(file, path, stage));
  *lock = (CwRunLock){.held = 1, .file = file};
  file = -1;
done:
  if (file >= 0) close(file);
  free(folder);
  free(path);
  return status;
}

void cw_run_unlock(CwRunLock *lock) {
  if (lock->held) close(lock->file);
  *lock = (CwRunLock){0};
}
