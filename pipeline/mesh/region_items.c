// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/mesh/region_items.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { OPEN_MEMORY = 8 << 20 }; // bytes: more than HDF5 takes to open a file
typedef enum { REAL, INDEX, WIDE } Kind;

// The arrays, in the order of the file. Those of one column have one dimension.
#define ARRAY(name, part, kind, columns, count)                                                                        \
  { #name, part, kind, columns, offsetof(CwRegionData, count), offsetof(CwRegionData, name) }
static const struct {
  const char *name;
  CwRegionPart part; // the least that has it
  Kind kind;
  int columns;
  size_t count, member; // places in CwRegionData
} arrays[] = {
    ARRAY(points, CW_REGION_SURFACE, REAL, 3, point_count),
    ARRAY(shared_id, CW_REGION_WHOLE, WIDE, 1, shared_count),
    ARRAY(tetrahedra, CW_REGION_WHOLE, INDEX, 4, tetrahedron_count),
    ARRAY(pyramids, CW_REGION_WHOLE, INDEX, 5, pyramid_count),
    ARRAY(prisms, CW_REGION_WHOLE, INDEX, 6, prism_count),
    ARRAY(triangles, CW_REGION_SURFACE, INDEX, 3, triangle_count),
    ARRAY(triangle_patch, CW_REGION_SURFACE, INDEX, 1, triangle_count),
    ARRAY(triangle_cell, CW_REGION_WHOLE, INDEX, 1, triangle_count),
    ARRAY(quads, CW_REGION_SURFACE, INDEX, 4, quad_count),
    ARRAY(quad_patch, CW_REGION_SURFACE, INDEX, 1, quad_count),
    ARRAY(quad_cell, CW_REGION_WHOLE, INDEX, 1, quad_count),
};
#undef ARRAY
_Static_assert(sizeof arrays / sizeof *arrays == CW_REGION_ARRAYS, "an array without a digest");

void cw_mesh_region_free(CwRegionData *data) {
  for (int k = 0; k < CW_REGION_ARRAYS; ++k) free(*(void *const *)((const char *)data + arrays[k].member));
  memset(data, 0, sizeof *data);
}

void cw_region_items_scale(CwRegionData *data, double by) {
  for (int32_t p = 0; p < data->point_count; p++) {
    for (int k = 0; k < 3; k++) data->points[p][k] *= by;
  }
}

// Little-endian in the file.
static hid_t type_of(Kind kind) {
  return kind == REAL ? H5T_IEEE_F64LE : kind == INDEX ? H5T_STD_I32LE : H5T_STD_I64LE;
}

static hid_t type_here(Kind kind) {
  return kind == REAL ? H5T_NATIVE_DOUBLE : kind == INDEX ? H5T_NATIVE_INT32 : H5T_NATIVE_INT64;
}

hid_t cw_region_items_create(const char *path) {
  hid_t access = H5Pcreate(H5P_FILE_ACCESS), creation = H5Pcreate(H5P_FILE_CREATE);
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL); // ours is the one line that a person sees
  // Object headers with checksums, all attributes and links in them, and no blocks kept free between.
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
  H5Pset_meta_block_size(access, 0);
  H5Pset_small_data_block_size(access, 0);
  H5Pset_link_phase_change(creation, 2 * CW_REGION_ARRAYS, CW_REGION_ARRAYS);
  H5Pset_attr_phase_change(creation, 2 * CW_REGION_ARRAYS, CW_REGION_ARRAYS);
  H5Pset_obj_track_times(creation, 0);
  hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, creation, access);
  H5Pclose(creation);
  H5Pclose(access);
  return file;
}

// Adds an attribute to the digest: its name, and its bytes as they stand in the file. The digest itself is left out.
static herr_t add_attribute(hid_t file, const char *name, const H5A_info_t *info, void *hash) {
  char value[CW_REGION_ARRAYS * sizeof(CwHash)]; // the longest
  if (!strcmp(name, "digest")) return 0;
  if (info->data_size > sizeof value) return -1;
  hid_t attribute = H5Aopen(file, name, H5P_DEFAULT), type = H5Aget_type(attribute);
  int fixed = H5Tis_variable_str(type) == 0;
  herr_t read = fixed ? H5Aread(attribute, type, value) : -1;
  cw_hash_bytes(hash, name, strlen(name));
  cw_hash_bytes(hash, value, read >= 0 ? (size_t)info->data_size : 0);
  H5Tclose(type);
  H5Aclose(attribute);
  return read;
}

CwStatus cw_region_items_digest(hid_t file, const char *path, char digest[CW_HASH_TEXT]) {
  CwStatus status = CW_OK;
  CwHash hash = cw_hash_start();
  hsize_t first = 0;
  CW_REQUIRE(H5Aiterate2(file, H5_INDEX_NAME, H5_ITER_INC, &first, add_attribute, &hash) >= 0, CW_ERR_IO,
             "%s: attributes: the file is damaged", path);
  cw_hash_hex(&hash, digest);
done:
  return status;
}

CwStatus cw_region_items_open(const char *path, hid_t *file, char digest[CW_HASH_TEXT]) {
  CwStatus status = CW_OK;
  int32_t format = 0;
  hsize_t size = 0;
  haddr_t end = HADDR_UNDEF;
  char found[CW_HASH_TEXT], wanted[CW_HASH_TEXT];
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL); // ours is the one line that a person sees
  // HDF5 1.10 crashes where memory ends while it opens a file.
  void *volatile room = malloc(OPEN_MEMORY);
  CW_REQUIRE(room, CW_ERR_MEMORY, "out of memory: %d MiB to open %s", OPEN_MEMORY >> 20, path);
  free(room);
  *file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  CW_REQUIRE(*file >= 0, CW_ERR_IO, "%s: is missing, damaged or cut short: cannot be opened as HDF5", path);
  CW_REQUIRE(cw_region_items_integer(*file, path, "format", &format) == CW_OK, CW_ERR_IO,
             "%s: attributes cannot be read; the file is damaged", path);
  CW_REQUIRE(format == CW_REGION_FORMAT, CW_ERR_INPUT, "%s: attribute 'format' is %d; it must be %d", path, format,
             CW_REGION_FORMAT);
  CW_REQUIRE(cw_region_items_text(*file, path, "digest", wanted, sizeof wanted) == CW_OK, CW_ERR_IO,
             "%s: has no digest of its attributes; the file is damaged", path);
  CW_TRY(cw_region_items_digest(*file, path, found));
  CW_REQUIRE(!strcmp(found, wanted), CW_ERR_IO, "%s: attributes: not as they were written; the file is damaged", path);
  CW_REQUIRE(H5Fget_filesize(*file, &size) >= 0 && H5Fget_eoa(*file, &end) >= 0 && size == end, CW_ERR_IO,
             "%s: has bytes after its end; the file is damaged", path);
  if (digest) memcpy(digest, found, sizeof found);
done:
  if (status != CW_OK && *file >= 0) {
    H5Fclose(*file);
    *file = -1;
  }
  return status;
}

// One value of a type, `kind`.
static CwStatus read_value(hid_t file, const char *path, const char *name, hid_t type, const char *kind, void *value) {
  CwStatus status = CW_OK;
  hid_t attribute = H5Aopen(file, name, H5P_DEFAULT);
  hid_t space = attribute >= 0 ? H5Aget_space(attribute) : -1;
  CW_REQUIRE(attribute >= 0, CW_ERR_INPUT, "%s: attribute '%s' is missing", path, name);
  CW_REQUIRE(H5Sget_simple_extent_npoints(space) == 1 && H5Aread(attribute, type, value) >= 0, CW_ERR_INPUT,
             "%s: attribute '%s' must be one %s", path, name, kind);
done:
  if (space >= 0) H5Sclose(space);
  if (attribute >= 0) H5Aclose(attribute);
  return status;
}

CwStatus cw_region_items_integer(hid_t file, const char *path, const char *name, int32_t *value) {
  return read_value(file, path, name, H5T_NATIVE_INT32, "integer", value);
}

CwStatus cw_region_items_number(hid_t file, const char *path, const char *name, double *value) {
  return read_value(file, path, name, H5T_NATIVE_DOUBLE, "number", value);
}

CwStatus cw_region_items_text(hid_t file, const char *path, const char *name, char *text, size_t size) {
  CwStatus status = CW_OK;
  hid_t attribute = H5Aopen(file, name, H5P_DEFAULT), type = attribute >= 0 ? H5Aget_type(attribute) : -1;
  char *found = NULL;
  CW_REQUIRE(attribute >= 0, CW_ERR_INPUT, "%s: attribute '%s' is missing", path, name);
  CW_REQUIRE(H5Tget_class(type) == H5T_STRING, CW_ERR_INPUT, "%s: attribute '%s' must be a string", path, name);
  int fixed = H5Tis_variable_str(type) <= 0;
  if (fixed) CW_NEW(found, H5Tget_size(type) + 1);
  CW_REQUIRE(H5Aread(attribute, type, fixed ? (void *)found : (void *)&found) >= 0 && found, CW_ERR_IO,
             "%s: attribute '%s' cannot be read", path, name);
  CW_REQUIRE(strlen(found) < size, CW_ERR_INPUT, "%s: attribute '%s' has %zu characters; at most %zu are allowed", path,
             name, strlen(found), size - 1);
  memcpy(text, found, strlen(found) + 1);
done:
  free(found);
  if (type >= 0) H5Tclose(type);
  if (attribute >= 0) H5Aclose(attribute);
  return status;
}

static CwHash digest_of(const void *data, size_t size) {
  CwHash hash = cw_hash_start();
  cw_hash_bytes(&hash, data, size);
  return hash;
}

// Reads one array. One without rows may be left out of the file where none are wanted.
static CwStatus read_array(hid_t file, const char *path, int which, const CwHash *wanted, int32_t *rows, void **into) {
  CwStatus status = CW_OK;
  const char *name = arrays[which].name;
  int columns = arrays[which].columns, dimensions = columns > 1 ? 2 : 1;
  hsize_t size[2] = {0, 1};
  hid_t set = -1, space = -1, type = type_here(arrays[which].kind);
  if (*rows != 0 || H5Lexists(file, name, H5P_DEFAULT) > 0) {
    set = H5Dopen2(file, name, H5P_DEFAULT);
    CW_REQUIRE(set >= 0, CW_ERR_INPUT, "%s: dataset '%s' is missing", path, name);
    space = H5Dget_space(set);
    int found = H5Sget_simple_extent_ndims(space);
    CW_REQUIRE(found == dimensions, CW_ERR_INPUT, "%s: dataset '%s' has %d dimensions; it must have %d", path, name,
               found, dimensions);
    H5Sget_simple_extent_dims(space, size, NULL);
  }
  CW_REQUIRE(*rows < 0 ? size[0] <= INT32_MAX : size[0] == (hsize_t)*rows, CW_ERR_INPUT,
             "%s: dataset '%s' has %llu rows; it must have %s%d", path, name, (unsigned long long)size[0],
             *rows < 0 ? "at most " : "", *rows < 0 ? INT32_MAX : *rows);
  CW_REQUIRE(set < 0 || columns == 1 || size[1] == (hsize_t)columns, CW_ERR_INPUT,
             "%s: dataset '%s' has %llu columns; it must have %d", path, name, (unsigned long long)size[1], columns);
  *rows = (int32_t)size[0];
  size_t bytes = (size_t)*rows * (size_t)columns * H5Tget_size(type);
  *into = malloc(bytes ? bytes : 1);
  CW_REQUIRE(*into, CW_ERR_MEMORY, "out of memory: %s of %s", name, path);
  if (*rows)
    CW_REQUIRE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, *into) >= 0, CW_ERR_IO,
               "%s: dataset '%s' cannot be read: the file is damaged or cut short", path, name);
  CwHash made = digest_of(*into, bytes);
  CW_REQUIRE(!memcmp(&made, wanted, sizeof made), CW_ERR_IO,
             "%s: dataset '%s': not as it was written; the file is damaged", path, name);
done:
  if (space >= 0) H5Sclose(space);
  if (set >= 0) H5Dclose(set);
  return status;
}

CwStatus cw_region_items_read(hid_t file, const char *path, CwRegionPart part, CwRegionData *data) {
  CwStatus status = CW_OK;
  CwHash digests[CW_REGION_ARRAYS];
  hid_t attribute = H5Aopen(file, "digests", H5P_DEFAULT), space = attribute >= 0 ? H5Aget_space(attribute) : -1;
  CW_REQUIRE(space >= 0 && H5Sget_simple_extent_npoints(space) == 2 * CW_REGION_ARRAYS &&
                 H5Aread(attribute, H5T_NATIVE_UINT64, digests) >= 0,
             CW_ERR_INPUT, "%s: attribute 'digests' must hold %d numbers", path, 2 * CW_REGION_ARRAYS);
  for (int k = 0; k < CW_REGION_ARRAYS; ++k)
    if (part == CW_REGION_WHOLE || arrays[k].part == CW_REGION_SURFACE)
      CW_TRY(read_array(file, path, k, &digests[k], (int32_t *)((char *)data + arrays[k].count),
                        (void **)((char *)data + arrays[k].member)));
done:
  if (space >= 0) H5Sclose(space);
  if (attribute >= 0) H5Aclose(attribute);
  return status;
}

static CwStatus write_array(hid_t file, int which, hid_t properties, const CwRegionData *data, CwHash *digest) {
  CwStatus status = CW_OK;
  const char *name = arrays[which].name;
  int32_t rows = *(const int32_t *)((const char *)data + arrays[which].count);
  const void *values = *(void *const *)((const char *)data + arrays[which].member);
  const hsize_t size[2] = {(hsize_t)rows, (hsize_t)arrays[which].columns};
  hid_t type = type_of(arrays[which].kind);
  hid_t space = H5Screate_simple(arrays[which].columns > 1 ? 2 : 1, size, NULL);
  hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT);
  CW_REQUIRE(space >= 0 && set >= 0, CW_ERR_IO, "dataset '%s' cannot be made", name);
  if (rows)
    CW_REQUIRE(H5Dwrite(set, type_here(arrays[which].kind), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0, CW_ERR_IO,
               "dataset '%s' cannot be written", name);
  *digest = digest_of(values, (size_t)rows * (size_t)arrays[which].columns * H5Tget_size(type));
  // Small arrays are kept back until here: what the disk refuses is not told before, nor by the end of the file.
  herr_t closed = H5Dclose(set);
  set = -1;
  CW_REQUIRE(closed >= 0, CW_ERR_IO, "dataset '%s' cannot be written", name);
done:
  if (set >= 0) H5Dclose(set);
  if (space >= 0) H5Sclose(space);
  return status;
}

static CwStatus write_attribute(hid_t file, const char *name, hid_t type, hid_t space, const void *data) {
  CwStatus status = CW_OK;
  hid_t attribute = H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  CW_REQUIRE(attribute >= 0 && H5Awrite(attribute, type, data) >= 0, CW_ERR_IO, "attribute '%s' cannot be written",
             name);
done:
  if (attribute >= 0) H5Aclose(attribute);
  return status;
}

static CwStatus put_value(hid_t file, const char *name, hid_t type, const void *value) {
  hid_t space = H5Screate(H5S_SCALAR);
  CwStatus status = write_attribute(file, name, type, space, value);
  H5Sclose(space);
  return status;
}

CwStatus cw_region_items_put_integer(hid_t file, const char *name, int32_t value) {
  return put_value(file, name, H5T_STD_I32LE, &value);
}

CwStatus cw_region_items_put_number(hid_t file, const char *name, double value) {
  return put_value(file, name, H5T_IEEE_F64LE, &value);
}

CwStatus cw_region_items_put_text(hid_t file, const char *name, const char *text) {
  hid_t space = H5Screate(H5S_SCALAR), type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, strlen(text) + 1);
  CwStatus status = write_attribute(file, name, type, space, text);
  H5Tclose(type);
  H5Sclose(space);
  return status;
}

CwStatus cw_region_items_write(hid_t file, const CwRegionData *data, char digest[CW_HASH_TEXT]) {
  CwStatus status = CW_OK;
  CwHash digests[CW_REGION_ARRAYS];
  hid_t space = H5Screate_simple(2, (hsize_t[]){CW_REGION_ARRAYS, 2}, NULL);
  hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
  // No time stamps and no fill: the bytes follow from the region alone.
  H5Pset_obj_track_times(properties, 0);
  H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER);
  for (int k = 0; k < CW_REGION_ARRAYS; ++k) CW_TRY(write_array(file, k, properties, data, &digests[k]));
  CW_TRY(write_attribute(file, "digests", H5T_STD_U64LE, space, digests));
  CW_TRY(cw_region_items_digest(file, "what was written", digest));
  CW_TRY(cw_region_items_put_text(file, "digest", digest));
done:
  H5Pclose(properties);
  H5Sclose(space);
  return status;
}

// Every one of `count` indices must lie in [0, limit).
static CwStatus check_indices(const char *path, const char *name, const int32_t *index, int64_t count, int64_t limit) {
  CwStatus status = CW_OK;
  // All at once first: the highest bit tells whether one is negative or beyond the last.
  uint32_t outside = 0, last = (uint32_t)limit - 1;
  for (int64_t i = 0; i < count && limit > 0; ++i) outside |= (uint32_t)index[i] | (last - (uint32_t)index[i]);
  if (count == 0 || (limit > 0 && outside >> 31 == 0)) return CW_OK;
  for (int64_t i = 0; i < count; ++i)
    CW_REQUIRE(index[i] >= 0 && index[i] < limit, CW_ERR_INPUT, "%s: dataset '%s': entry %lld is %d; allowed 0 to %lld",
               path, name, (long long)i, index[i], (long long)limit - 1);
done:
  return status;
}

CwStatus cw_region_items_check(const char *path, CwRegionPart part, int64_t patches, int64_t shared_points,
                               const CwRegionData *r) {
  CwStatus status = CW_OK;
  int64_t cells = cw_region_cell_count(r);
  for (int32_t i = 0; i < r->point_count; ++i)
    CW_REQUIRE(isfinite(r->points[i][0]) && isfinite(r->points[i][1]) && isfinite(r->points[i][2]), CW_ERR_INPUT,
               "%s: point %d has a coordinate that is not a number", path, i);
  CW_TRY(check_indices(path, "triangles", *r->triangles, 3 * (int64_t)r->triangle_count, r->point_count));
  CW_TRY(check_indices(path, "triangle_patch", r->triangle_patch, r->triangle_count, patches));
  CW_TRY(check_indices(path, "quads", *r->quads, 4 * (int64_t)r->quad_count, r->point_count));
  CW_TRY(check_indices(path, "quad_patch", r->quad_patch, r->quad_count, patches));
  if (part == CW_REGION_SURFACE) goto done;
  CW_REQUIRE(r->shared_count <= r->point_count, CW_ERR_INPUT, "%s: dataset 'shared_id' has %d rows, 'points' only %d",
             path, r->shared_count, r->point_count);
  for (int32_t i = 0; i < r->shared_count; ++i)
    CW_REQUIRE(r->shared_id[i] >= 0 && r->shared_id[i] < shared_points, CW_ERR_INPUT,
               "%s: dataset 'shared_id': entry %d is %lld; allowed 0 to %lld", path, i, (long long)r->shared_id[i],
               (long long)shared_points - 1);
  CW_TRY(check_indices(path, "tetrahedra", *r->tetrahedra, 4 * (int64_t)r->tetrahedron_count, r->point_count));
  CW_TRY(check_indices(path, "pyramids", *r->pyramids, 5 * (int64_t)r->pyramid_count, r->point_count));
  CW_TRY(check_indices(path, "prisms", *r->prisms, 6 * (int64_t)r->prism_count, r->point_count));
  CW_TRY(check_indices(path, "triangle_cell", r->triangle_cell, r->triangle_count, cells));
  CW_TRY(check_indices(path, "quad_cell", r->quad_cell, r->quad_count, cells));
done:
  return status;
}
