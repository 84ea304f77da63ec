// SPDX-License-Identifier: AGPL-3.0-or-later
// Files that appear whole or not at all, through killed runs and power cuts: written under a temporary name in the same
// folder, brought to the disk, then renamed.
//
//   CwAtomicFile file = {0};
//   CW_TRY(cw_atomic_file_open("run/mesh/manifest.json", &file));
//   fprintf(file.stream, ...);
//   CW_TRY(cw_atomic_file_commit(&file));
// done:
//   cw_atomic_file_abandon(&file); // nothing after a commit
//
// The temporary name is ".part-PROCESS-COUNT-NAME", made so that no two processes share one, on whatever host. Its
// ending is that of the final name, which some libraries look at.
#pragma once

#include <stdio.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Zeroed: nothing open.
typedef struct {
  FILE *stream;         // NULL when a library writes the file by its name
  char *temporary_path; // where to write
  char *final_path;
} CwAtomicFile;

// Opens the temporary file for writing. Fails with CW_ERR_IO.
CwStatus cw_atomic_file_open(const char *path, CwAtomicFile *file);

// Makes an empty temporary file, for a library that opens `temporary_path` by itself and closes it before the commit,
// which fails where the file is still empty. CW_ERR_IO.
CwStatus cw_atomic_file_name(const char *path, CwAtomicFile *file);

// Closes the stream, checks that everything was written, brings the file to the disk (fsync), gives it its final name,
// and brings the folder to the disk. On failure (CW_ERR_IO) the temporary file is gone.
CwStatus cw_atomic_file_commit(CwAtomicFile *file);

// Closes and removes the temporary file. Does nothing on a zeroed or committed file. Keeps the last failure.
void cw_atomic_file_abandon(CwAtomicFile *file);

// Removes the temporary files that killed runs have left in `folder`. Only for who holds the lock of the run
// (run_lock.h). CW_ERR_IO.
CwStatus cw_atomic_file_clear(const char *folder);

// Brings a closed file or a folder to the disk, or the folder that `path` lies in. CW_ERR_IO.
CwStatus cw_sync(const char *path);
CwStatus cw_sync_folder_of(const char *path);

// Begins to bring a file that is being written to the disk and does not wait for it, so that cw_sync() has little left
// to do. Does nothing where the system cannot.
void cw_sync_begin(const char *path);

// Makes the folder `path` and its parents where they are missing. Fine when other ranks do the same.
// CW_ERR_IO.
CwStatus cw_make_directory(const char *path);

#ifdef __cplusplus
}
#endif
