// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/atomic_file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define PART_PREFIX ".part-"

static void forget(CwAtomicFile *file) {
  free(file->temporary_path);
  free(file->final_path);
  memset(file, 0, sizeof *file);
}

// Makes an empty file that no other process has, on this host or another one that sees the folder.
static CwStatus make_temporary(const char *path, CwAtomicFile *file, int *handle) {
  CwStatus status = CW_OK;
  const char *slash = strrchr(path, '/');
  const char *name = slash ? slash + 1 : path;
  size_t size = strlen(path) + sizeof PART_PREFIX + 2 * 3 * sizeof(int) + 2; // two numbers, each with its "-"
  CW_REQUIRE(*name, CW_ERR_IO, "\"%s\": cannot be written: no file name", path);
  CW_NEW(file->temporary_path, size);
  file->final_path = strdup(path);
  CW_REQUIRE(file->final_path, CW_ERR_MEMORY, "out of memory: the name %s", path);
  for (int attempt = 0; *handle < 0; ++attempt) {
    snprintf(file->temporary_path, size, "%.*s" PART_PREFIX "%d-%d-%s", (int)(name - path), path, (int)getpid(),
             attempt, name);
    *handle = open(file->temporary_path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    CW_REQUIRE(*handle >= 0 || errno == EEXIST, CW_ERR_IO, "%s: cannot be written: %s", path, strerror(errno));
  }
done:
  return status;
}

CwStatus cw_atomic_file_name(const char *path, CwAtomicFile *file) {
  CwStatus status = CW_OK;
  int handle = -1;
  memset(file, 0, sizeof *file);
  CW_TRY(make_temporary(path, file, &handle));
  close(handle);
done:
  if (status != CW_OK) forget(file);
  return status;
}

CwStatus cw_atomic_file_open(const char *path, CwAtomicFile *file) {
  CwStatus status = CW_OK;
  int handle = -1;
  memset(file, 0, sizeof *file);
  CW_TRY(make_temporary(path, file, &handle));
  file->stream = fdopen(handle, "w");
  if (!file->stream) {
    status = CW_FAIL(CW_ERR_IO, "%s: cannot be written: %s", path, strerror(errno));
    close(handle);
    unlink(file->temporary_path);
  }
done:
  if (status != CW_OK) forget(file);
  return status;
}

CwStatus cw_sync(const char *path) {
  CwStatus status = CW_OK;
  int handle = open(path, O_RDONLY | O_CLOEXEC);
  CW_REQUIRE(handle >= 0 && (!fsync(handle) || errno == EINVAL), CW_ERR_IO, "%s: cannot be brought to the disk: %s",
             path, strerror(errno)); // EINVAL: the file system knows nothing of it
done:
  if (handle >= 0) close(handle);
  return status;
}

void cw_sync_begin(const char *path) {
#ifdef SYNC_FILE_RANGE_WRITE
  int handle = open(path, O_RDONLY | O_CLOEXEC);
  if (handle < 0) return;
  sync_file_range(handle, 0, 0, SYNC_FILE_RANGE_WRITE);
  close(handle);
#endif
}

CwStatus cw_sync_folder_of(const char *path) {
  const char *slash = strrchr(path, '/');
  if (!slash) return cw_sync(".");
  if (slash == path) return cw_sync("/");
  char *folder = strndup(path, (size_t)(slash - path));
  CwStatus status = folder ? cw_sync(folder) : CW_FAIL(CW_ERR_MEMORY, "out of memory: the name %s", path);
  free(folder);
  return status;
}

CwStatus cw_atomic_file_commit(CwAtomicFile *file) {
  CwStatus status = CW_OK;
  struct stat about;
  if (file->stream) {
    FILE *stream = file->stream;
    file->stream = NULL;
    errno = 0;
    int broken = ferror(stream);
    if (fclose(stream)) broken = 1;
    CW_REQUIRE(!broken, CW_ERR_IO, "%s: cannot be written: %s", file->final_path,
               errno ? strerror(errno) : "a write failed (is the disk full?)");
  } else { // nothing that this program writes is empty
    CW_REQUIRE(!stat(file->temporary_path, &about) && about.st_size > 0, CW_ERR_IO,
               "%s: cannot be written: nothing came", file->final_path);
  }
  CW_TRY(cw_sync(file->temporary_path));
  CW_REQUIRE(!rename(file->temporary_path, file->final_path), CW_ERR_IO, "%s: cannot be written: %s", file->final_path,
             strerror(errno));
  CW_TRY(cw_sync_folder_of(file->final_path));
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

CwStatus cw_atomic_file_clear(const char *folder) {
  CwStatus status = CW_OK;
  struct dirent *entry;
  DIR *list = opendir(folder);
  CW_REQUIRE(list, CW_ERR_IO, "%s: cannot be read: %s", folder, strerror(errno));
  while ((entry = readdir(list))) {
    if (strncmp(entry->d_name, PART_PREFIX, strlen(PART_PREFIX))) continue;
    CW_REQUIRE(!unlinkat(dirfd(list), entry->d_name, 0) || errno == ENOENT, CW_ERR_IO, "%s/%s: cannot be removed: %s",
               folder, entry->d_name, strerror(errno));
  }
done:
  if (list) closedir(list);
  return status;
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
