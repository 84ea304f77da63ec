// SPDX-License-Identifier: AGPL-3.0-or-later
// One region of the finished mesh and its file (docs/file-formats.md). The file is also the checkpoint of a
// run.
#ifndef CUTWATER_MESHER_REGION_REGION_FILE_H
#define CUTWATER_MESHER_REGION_REGION_FILE_H

#include <stdint.h>

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
  char fingerprint[33];    // hex of all that the region follows from
  CwFillRecovery recovery; // how its boundary was recovered
  int32_t point_count, shared_count;
  double (*x)[3]; // shared points first
  int64_t *shared_id;
  int32_t tetrahedron_count, pyramid_count, prism_count;
  int32_t (*tetrahedron)[4], (*pyramid)[5], (*prism)[6];
  int32_t triangle_count, quad_count;
  int32_t (*triangle)[3], *triangle_patch, *triangle_cell;
  int32_t (*quad)[4], *quad_patch, *quad_cell;
} CwRegionMesh;

// Writes under a temporary name and renames. Equal regions give equal bytes.
CwStatus cw_region_write(const char *path, const CwRegionMesh *region);
// Reads and checks ranges; CW_ERR_INPUT with file and item where something does not fit, CW_ERR_IO where the file is
// cut short.
CwStatus cw_region_read(const char *path, CwRegionMesh *region);
// True where `path` is a whole region file with this fingerprint. Never fails.
int cw_region_is_current(const char *path, const char *fingerprint);
// The arrays of a region as its file has them, in the same memory.
CwRegionData cw_region_data(const CwRegionMesh *region);
void cw_region_free(CwRegionMesh *region);

#ifdef __cplusplus
}
#endif
#endif
