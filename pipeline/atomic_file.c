// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/atomic_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static void forget(CwAtomicFile *file) {
  free(file->temporary_path);
  free(file->final_path);
  memset(file, 0, sizeof *file);
}

CwStatus cw_atomic_file_name(const char *path, CwAtomicFile *file) {
  CwStatus status = CW_OK;
  memset(file, 0, sizeof *file);
  const char *slash = strrchr(path, '/');
  const char *name = slash ? slash + 1 : path;
  CW_REQUIRE(*name, CW_ERR_IO, "\"%s\": cannot be written: no file name", path);
  size_t size = strlen(path) + sizeof ".part-";
  CW_NEW(file->temporary_path, size);
  snprintf(file->temporary_path, size, "%.*s.part-%s", (int)(name - path), path, name);
  file->final_path = strdup(path);
  CW_REQUIRE(file->final_path, CW_ERR_MEMORY, "out of memory: the name %s", path);
  CW_REQUIRE(!unlink(file->temporary_path) || errno == ENOENT || errno == ENOTDIR, CW_ERR_IO,
             "%s: cannot be removed: %s", file->temporary_path, strerror(errno));
done:
  if (status != CW_OK) forget(file);
  return status;
}

CwStatus cw_atomic_file_open(const char *path, CwAtomicFile *file) {
  CwStatus status = CW_OK;
  CW_TRY(cw_atomic_file_name(path, file));
  file->stream = fopen(file->temporary_path, "w");
  CW_REQUIRE(file->stream, CW_ERR_IO, "%s: cannot be written: %s", path, strerror(errno));
done:
  if (status != CW_OK) forget(file);
  return status;
}

CwStatus cw_atomic_file_commit(CwAtomicFile *file) {
  CwStatus status = CW_OK;
  if (file->stream) {
    FILE *stream = file->stream;
    file->stream = NULL;
    errno = 0;
    int broken = ferror(stream);
    if (fclose(stream)) broken = 1;
    CW_REQUIRE(!broken, CW_ERR_IO, "%s: cannot be written: %s", file->final_path,
               errno ? strerror(errno) : "a write failed");
  }
  CW_REQUIRE(!rename(file->temporary_path, file->final_path), CW_ERR_IO, "%s: cannot be written: %s", file->final_path,
             strerror(errno));
  forget(file);
done:
  if (status != CW_OK) cw_atomic_file_abandon(file);
  return status;
}

void cw_atomic_file_abandon(CwAtomicFile *file) {
  if (!file->temporary_path) return;
  if (file->stream) fclose(file->stream);
  unlink(file->temporary_path);
  forget(file);
}

CwStatus cw_make_directory(const char *path) {
  CwStatus status = CW_OK;
  struct stat found;
  char *parent = strdup(path);
  CW_REQUIRE(parent, CW_ERR_MEMORY, "out of memory: the name %s", path);
  for (char *c = parent; *c; ++c) {
    if (c == parent || *c != '/') continue;
    *c = '\0';
    if (mkdir(parent, 0777) && errno != EEXIST) {
      // A parent that stands but may not be written to (EROFS, EACCES) matters only where a child is missing.
      int cause = errno;
      CW_REQUIRE(!stat(parent, &found), CW_ERR_IO, "%s: the folder cannot be made: %s", parent, strerror(cause));
    }
    *c = '/';
  }
  if (mkdir(path, 0777)) {
    int cause = errno;
    CW_REQUIRE(!stat(path, &found), CW_ERR_IO, "%s: the folder cannot be made: %s", path, strerror(cause));
    CW_REQUIRE(S_ISDIR(found.st_mode), CW_ERR_IO, "%s: is not a folder", path);
  }
done:
  free(parent);
  return status;
}
