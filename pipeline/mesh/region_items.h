// SPDX-License-Identifier: AGPL-3.0-or-later
// The items of a region file (docs/file-formats.md): one definition for the mesher, which writes them, and for all who
// read them. Each array has a digest, and one digest covers these and all attributes: what is read is what was written.
#pragma once

#include <hdf5.h>
#include <stdint.h>

#include "pipeline/hash.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_REGION_FORMAT = 4, CW_REGION_ARRAYS = 11 };

// A region in memory, as its file has it: the fields are its arrays and their counts; see docs/file-formats.md for
// shapes and orders.
typedef struct {
  int domain, region; // domain: of the manifest
  int32_t point_count, shared_count;
  int32_t tetrahedron_count, pyramid_count, prism_count, triangle_count, quad_count;
  double (*points)[3];
  int64_t *shared_id;
  int32_t (*tetrahedra)[4], (*pyramids)[5], (*prisms)[6];
  int32_t (*triangles)[3], *triangle_patch, *triangle_cell;
  int32_t (*quads)[4], *quad_patch, *quad_cell;
} CwRegionData;

void cw_mesh_region_free(CwRegionData *data);
// Brings the points from one unit to another, of which `by` are one.
void cw_region_items_scale(CwRegionData *data, double by);

typedef enum {
  CW_REGION_WHOLE,
  CW_REGION_SURFACE // points and boundary faces with their patches; the other counts stay 0
} CwRegionPart;

// Opens a region file of this format for reading and holds its attributes against their digest, which goes to `digest`
// (NULL: not wanted). CW_ERR_IO where it is missing, no whole HDF5 file, or damaged; CW_ERR_INPUT where it is
// of another format.
CwStatus cw_region_items_open(const char *path, hid_t *file, char digest[CW_HASH_TEXT]);

// The digest of all attributes but itself, as they are. CW_ERR_IO.
CwStatus cw_region_items_digest(hid_t file, const char *path, char digest[CW_HASH_TEXT]);

// An attribute; CW_ERR_INPUT where it is missing, or no integer or number, or a text of `size` or more characters.
CwStatus cw_region_items_integer(hid_t file, const char *path, const char *name, int32_t *value);
CwStatus cw_region_items_number(hid_t file, const char *path, const char *name, double *value);
CwStatus cw_region_items_text(hid_t file, const char *path, const char *name, char *text, size_t size);

// Writes an attribute. CW_ERR_IO.
CwStatus cw_region_items_put_integer(hid_t file, const char *name, int32_t value);
CwStatus cw_region_items_put_number(hid_t file, const char *name, double value);
CwStatus cw_region_items_put_text(hid_t file, const char *name, const char *text);

// Reads the arrays of a part into new memory and holds each against its digest. Counts that are not negative on entry
// must be met; the others are those of the file. CW_ERR_INPUT or CW_ERR_IO, naming the item; the caller frees `data`
// then too.
CwStatus cw_region_items_read(hid_t file, const char *path, CwRegionPart part, CwRegionData *data);

// Checks that coordinates are finite and that every index is in range: of points and cells, of so many patches and of
// so many shared points of the domain. CW_ERR_INPUT, naming item and place.
CwStatus cw_region_items_check(const char *path, CwRegionPart part, int64_t patches, int64_t shared_points,
                               const CwRegionData *data);

// Makes a file in which every byte is covered by a digest, ours or that of HDF5, and in which equal regions give equal
// bytes. -1 where it cannot be made.
hid_t cw_region_items_create(const char *path);

// Writes all arrays, and then the digests: after them no attribute may follow. CW_ERR_IO.
CwStatus cw_region_items_write(hid_t file, const CwRegionData *data, char digest[CW_HASH_TEXT]);

static inline int32_t cw_region_cell_count(const CwRegionData *data) {
  return data->tetrahedron_count + data->pyramid_count + data->prism_count;
}

#ifdef __cplusplus
}
#endif
