// SPDX-License-Identifier: AGPL-3.0-or-later
// One region of the finished mesh and its file (docs/file-formats.md). The file is also the checkpoint of a
// run.
#pragma once

#include <stdint.h>

#include "pipeline/atomic_file.h"
#include "pipeline/status.h"

#include "mesher/fill/fill.h"
#include "pipeline/mesh/region_items.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  char domain[16];
  int32_t region; // 1-based
  int32_t number;
  char fingerprint[CW_HASH_TEXT]; // hex of all that the region follows from
  char digest[CW_HASH_TEXT];      // of its file; "" before there is one
  CwFillRecovery recovery;        // how its boundary was recovered
  int32_t layer_tetrahedra;       // the last ones, of tapered columns
  CwRegionData cells;             // as the file has them, but in the unit of the model; shared points first
} CwRegionMesh;

// Writes under a temporary name and renames. Equal regions give equal bytes. Sets the digest.
CwStatus cw_region_write(const char *path, CwRegionMesh *region);

// The same up to the commit of `file`, which has less to wait for the longer after it comes. On failure nothing is
// left.
CwStatus cw_region_write_begin(const char *path, CwRegionMesh *region, CwAtomicFile *file);
// Reads and checks digests and ranges; CW_ERR_INPUT with file and item where something does not fit, CW_ERR_IO where
// the file is damaged or cut short.
CwStatus cw_region_read(const char *path, CwRegionMesh *region);

typedef enum {
  CW_REGION_TAKEN,  // whole and of the fingerprint: `region` holds it
  CW_REGION_OTHER,  // no file, or one of something else
  CW_REGION_DAMAGED // cw_fail_message() says how
} CwRegionFound;

// Takes up what an earlier run has left. CW_ERR_MEMORY.
CwStatus cw_region_take_up(const char *path, const char *fingerprint, CwRegionMesh *region, CwRegionFound *found);
// Reads the digest, by which files are told apart, and holds the attributes against it, not the arrays. CW_ERR_IO,
// CW_ERR_INPUT.
CwStatus cw_region_digest_read(const char *path, char digest[CW_HASH_TEXT]);
void cw_region_free(CwRegionMesh *region);

#ifdef __cplusplus
}
#endif
