// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/place_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "export/folder.h"

CwStatus cw_place_file_open(const char *folder, const char *name, int is_new, CwPlaceFile *file) {
  CwStatus status = CW_OK;
  CW_TRY(cw_path_set(&file->path, "%s/%s", folder, name));
  int descriptor = open(file->path, O_WRONLY | O_CLOEXEC | (is_new ? O_CREAT | O_TRUNC : 0), 0666);
  if (descriptor == 0) { // standard input is closed; 0 means none here
    descriptor = fcntl(0, F_DUPFD_CLOEXEC, 1);
    close(0);
  }
  CW_REQUIRE(descriptor > 0, CW_ERR_IO, "%s: cannot be written: %s", file->path, strerror(errno));
  file->descriptor = descriptor;
done:
  return status;
}

CwStatus cw_place_file_put(const CwPlaceFile *file, const void *bytes, int64_t count, int64_t at) {
  CwStatus status = CW_OK;
  const char *from = bytes;
  while (count > 0) {
    ssize_t done_now = pwrite(file->descriptor, from, (size_t)(count > 1 << 30 ? 1 << 30 : count), at);
    if (done_now < 0 && errno == EINTR) continue;
    CW_REQUIRE(done_now > 0, CW_ERR_IO, "%s: cannot be written: %s", file->path, strerror(errno));
    from += done_now;
    at += done_now;
    count -= done_now;
  }
done:
  return status;
}

CwStatus cw_place_file_put_labels(const CwPlaceFile *file, const int64_t *values, int64_t count, int size, int64_t at) {
  CwStatus status = CW_OK;
  enum { AT_ONCE = 1 << 14 };
  int32_t narrow[AT_ONCE];
  if (size == 8) return cw_place_file_put(file, values, 8 * count, at);
  for (int64_t done_now = 0; done_now < count; done_now += AT_ONCE) {
    const int64_t now = count - done_now < AT_ONCE ? count - done_now : AT_ONCE;
    for (int64_t i = 0; i < now; ++i) narrow[i] = (int32_t)values[done_now + i];
    CW_TRY(cw_place_file_put(file, narrow, 4 * now, at + 4 * done_now));
  }
done:
  return status;
}

CwStatus cw_place_file_close(CwPlaceFile *file) {
  CwStatus status = CW_OK;
  int failed = file->descriptor && close(file->descriptor) != 0;
  file->descriptor = 0;
  CW_REQUIRE(!failed, CW_ERR_IO, "%s: cannot be written: %s", file->path, strerror(errno));
done:
  free(file->path);
  file->path = NULL;
  return status;
}
