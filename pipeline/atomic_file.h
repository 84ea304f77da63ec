// SPDX-License-Identifier: AGPL-3.0-or-later
// Files that appear whole or not at all: written under a temporary name in the same folder, then renamed.
//
//   CwAtomicFile file = {0};
//   CW_TRY(cw_atomic_file_open("run/mesh/manifest.json", &file));
//   fprintf(file.stream, ...);
//   CW_TRY(cw_atomic_file_commit(&file));
// done:
//   cw_atomic_file_abandon(&file); // nothing after a commit
//
// The temporary name is ".part-NAME": the same each time, so a killed run leaves no heap of them, and with
// the ending of the final name, which some libraries look at.
#ifndef CUTWATER_PIPELINE_ATOMIC_FILE_H
#define CUTWATER_PIPELINE_ATOMIC_FILE_H

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

// Chooses the temporary name only (and removes what an earlier run left there), for a library that opens
// `temporary_path` by itself and closes it before the commit.
CwStatus cw_atomic_file_name(const char *path, CwAtomicFile *file);

// Closes the stream, checks that everything was written, gives the file its final name. Without fsync: it
// guards against a killed run, not against a power cut. On failure (CW_ERR_IO) the temporary file is gone.
CwStatus cw_atomic_file_commit(CwAtomicFile *file);

// Closes and removes the temporary file. Does nothing on a zeroed or committed file. Keeps the last failure.
void cw_atomic_file_abandon(CwAtomicFile *file);

// Makes the folder `path` and its parents where they are missing. Fine when other ranks do the same.
// CW_ERR_IO.
CwStatus cw_make_directory(const char *path);

#ifdef __cplusplus
}
#endif
#endif
