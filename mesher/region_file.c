// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region_file.h"

#include <hdf5.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FORMAT = 1 };

// HDF5 prints its own error stack by default; ours is the one line that a person sees.
typedef struct {
  H5E_auto2_t print;
  void *data;
} Quiet;

static Quiet quiet_start(void) {
  Quiet quiet = {0};
  H5Eget_auto2(H5E_DEFAULT, &quiet.print, &quiet.data);
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  return quiet;
}

static void quiet_end(Quiet quiet) {
  H5Eset_auto2(H5E_DEFAULT, quiet.print, quiet.data);
}

static CwStatus write_data(hid_t file, hid_t properties, const char *name, hid_t type, hsize_t rows,
                           hsize_t columns, const void *data) {
  CwStatus status = CW_OK;
  hsize_t shape[2] = {rows, columns};
  hid_t space = H5Screate_simple(columns > 1 ? 2 : 1, shape, NULL);
  hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT);
  CW_REQUIRE(space >= 0 && set >= 0, CW_ERR_IO, "%s: cannot be made", name);
  if (rows) {
    CW_REQUIRE(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0, CW_ERR_IO,
               "%s: cannot be written", name);
  }
done:
  if (set >= 0)
    H5Dclose(set);
  if (space >= 0)
    H5Sclose(space);
  return status;
}

static CwStatus write_attribute(hid_t file, const char *name, hid_t type, const void *data) {
  CwStatus status = CW_OK;
  hid_t space = H5Screate(H5S_SCALAR);
  hid_t attribute = H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  CW_REQUIRE(attribute >= 0 && H5Awrite(attribute, type, data) >= 0, CW_ERR_IO,
             "attribute %s: cannot be written", name);
done:
  if (attribute >= 0)
    H5Aclose(attribute);
  if (space >= 0)
    H5Sclose(space);
  return status;
}

static CwStatus write_text(hid_t file, const char *name, const char *text) {
  hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, strlen(text) + 1);
  CwStatus status = write_attribute(file, name, type, text);
  H5Tclose(type);
  return status;
}

static CwStatus write_items(hid_t file, hid_t properties, const CwRegionMesh *r) {
  CwStatus status = CW_OK;
  const int32_t format = FORMAT;
  const hid_t real = H5T_IEEE_F64LE, index = H5T_STD_I32LE, wide = H5T_STD_I64LE;
  CW_TRY(write_attribute(file, "format", index, &format));
  CW_TRY(write_text(file, "domain", r->domain));
  CW_TRY(write_attribute(file, "region", index, &r->region));
  CW_TRY(write_attribute(file, "number", index, &r->number));
  CW_TRY(write_text(file, "fingerprint", r->fingerprint));
  CW_TRY(write_attribute(file, "recovered_triangles", index, &r->way.missing));
  CW_TRY(write_attribute(file, "recovery_flips", index, &r->way.flips));
  CW_TRY(write_attribute(file, "recovery_hollows", index, &r->way.cleared));
  CW_TRY(write_attribute(file, "recovery_points", index, &r->way.divided));
  CW_TRY(write_attribute(file, "tetgen", index, &r->way.tetgen));
  CW_TRY(write_data(file, properties, "points", real, r->point_count, 3, r->x));
  CW_TRY(write_data(file, properties, "shared_id", wide, r->shared_count, 1, r->shared_id));
  CW_TRY(write_data(file, properties, "tetrahedra", index, r->tetrahedron_count, 4, r->tetrahedron));
  CW_TRY(write_data(file, properties, "pyramids", index, r->pyramid_count, 5, r->pyramid));
  CW_TRY(write_data(file, properties, "prisms", index, r->prism_count, 6, r->prism));
  CW_TRY(write_data(file, properties, "triangles", index, r->triangle_count, 3, r->triangle));
  CW_TRY(write_data(file, properties, "triangle_patch", index, r->triangle_count, 1, r->triangle_patch));
  CW_TRY(write_data(file, properties, "triangle_cell", index, r->triangle_count, 1, r->triangle_cell));
  CW_TRY(write_data(file, properties, "quads", index, r->quad_count, 4, r->quad));
  CW_TRY(write_data(file, properties, "quad_patch", index, r->quad_count, 1, r->quad_patch));
  CW_TRY(write_data(file, properties, "quad_cell", index, r->quad_count, 1, r->quad_cell));
done:
  return status;
}

CwStatus cw_region_write(const char *path, const CwRegionMesh *region) {
  CwStatus status = CW_OK;
  Quiet quiet = quiet_start();
  hid_t access = -1, creation = -1, properties = -1, file = -1;
  char *temporary = NULL;
  int made = 0;
  CW_NEW(temporary, strlen(path) + 6);
  sprintf(temporary, "%s.part", path);

  // No time stamps and no fill: the bytes follow from the region alone.
  access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
  creation = H5Pcreate(H5P_FILE_CREATE);
  H5Pset_obj_track_times(creation, 0);
  properties = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_obj_track_times(properties, 0);
  H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER);
  file = H5Fcreate(temporary, H5F_ACC_TRUNC, creation, access);
  CW_REQUIRE(file >= 0, CW_ERR_IO, "%s: cannot be made", temporary);
  made = 1;
  status = write_items(file, properties, region);
  if (status != CW_OK) {
    status = CW_FAIL(status, "%s: %s (is the disk full?)", path, cw_fail_message());
    goto done;
  }
  herr_t closed = H5Fclose(file);
  file = -1;
  CW_REQUIRE(closed >= 0, CW_ERR_IO, "%s: cannot be written to its end (is the disk full?)", path);
  CW_REQUIRE(rename(temporary, path) == 0, CW_ERR_IO, "%s: cannot be renamed to %s", temporary, path);
  made = 0;
done:
  if (file >= 0)
    H5Fclose(file);
  if (made)
    unlink(temporary);
  if (properties >= 0)
    H5Pclose(properties);
  if (creation >= 0)
    H5Pclose(creation);
  if (access >= 0)
    H5Pclose(access);
  free(temporary);
  quiet_end(quiet);
  return status;
}

static CwStatus read_attribute(hid_t file, const char *path, const char *name, int32_t *value) {
  CwStatus status = CW_OK;
  hid_t attribute = H5Aopen(file, name, H5P_DEFAULT);
  hid_t space = attribute >= 0 ? H5Aget_space(attribute) : -1;
  CW_REQUIRE(space >= 0 && H5Sget_simple_extent_npoints(space) == 1 &&
                 H5Aread(attribute, H5T_NATIVE_INT32, value) >= 0,
             CW_ERR_INPUT, "%s: attribute %s: missing or not one integer", path, name);
done:
  if (space >= 0)
    H5Sclose(space);
  if (attribute >= 0)
    H5Aclose(attribute);
  return status;
}

static CwStatus read_text(hid_t file, const char *path, const char *name, char *text, size_t size) {
  CwStatus status = CW_OK;
  hid_t attribute = H5Aopen(file, name, H5P_DEFAULT);
  hid_t type = attribute >= 0 ? H5Aget_type(attribute) : -1;
  CW_REQUIRE(type >= 0 && H5Tget_class(type) == H5T_STRING && !H5Tis_variable_str(type), CW_ERR_INPUT,
             "%s: attribute %s: missing or not a string of fixed size", path, name);
  CW_REQUIRE(H5Tget_size(type) <= size, CW_ERR_INPUT, "%s: attribute %s: at most %zu characters are allowed",
             path, name, size - 1);
  memset(text, 0, size);
  CW_REQUIRE(H5Aread(attribute, type, text) >= 0, CW_ERR_INPUT, "%s: attribute %s: cannot be read", path,
             name);
  text[size - 1] = '\0';
done:
  if (type >= 0)
    H5Tclose(type);
  if (attribute >= 0)
    H5Aclose(attribute);
  return status;
}

// Reads a dataset of `columns` columns into fresh memory. Where *rows is not negative the rows must be as
// many.
static CwStatus read_data(hid_t file, const char *path, const char *name, hid_t type, size_t item,
                          hsize_t columns, int32_t *rows, void **data) {
  CwStatus status = CW_OK;
  hsize_t shape[2] = {0, 1};
  hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
  hid_t space = set >= 0 ? H5Dget_space(set) : -1;
  CW_REQUIRE(space >= 0, CW_ERR_INPUT, "%s: %s: missing", path, name);
  int rank = H5Sget_simple_extent_ndims(space);
  CW_REQUIRE(rank == (columns > 1 ? 2 : 1), CW_ERR_INPUT, "%s: %s: has %d dimensions; %d are allowed", path,
             name, rank, columns > 1 ? 2 : 1);
  H5Sget_simple_extent_dims(space, shape, NULL);
  CW_REQUIRE(columns == 1 || shape[1] == columns, CW_ERR_INPUT, "%s: %s: has %llu columns; %llu are allowed",
             path, name, (unsigned long long)shape[1], (unsigned long long)columns);
  CW_REQUIRE(shape[0] <= INT32_MAX, CW_ERR_INPUT, "%s: %s: has %llu rows; at most %d are allowed", path, name,
             (unsigned long long)shape[0], INT32_MAX);
  CW_REQUIRE(*rows < 0 || shape[0] == (hsize_t)*rows, CW_ERR_INPUT, "%s: %s: has %llu rows; %d are allowed",
             path, name, (unsigned long long)shape[0], *rows);
  *rows = (int32_t)shape[0];
  *data = malloc(shape[0] ? shape[0] * columns * item : 1);
  CW_REQUIRE(*data, CW_ERR_MEMORY, "%s: %s: out of memory", path, name);
  if (*rows) {
    CW_REQUIRE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, *data) >= 0, CW_ERR_INPUT,
               "%s: %s: cannot be read", path, name);
  }
done:
  if (space >= 0)
    H5Sclose(space);
  if (set >= 0)
    H5Dclose(set);
  return status;
}

static CwStatus check_range(const char *path, const char *name, const int32_t *value, int64_t count,
                            int columns, int64_t limit) {
  CwStatus status = CW_OK;
  for (int64_t i = 0; i < count * columns; i++) {
    CW_REQUIRE(value[i] >= 0 && value[i] < limit, CW_ERR_INPUT,
               "%s: %s: row %lld holds %d; 0 to %lld are allowed", path, name, (long long)(i / columns),
               value[i], (long long)limit - 1);
  }
done:
  return status;
}

static CwStatus check_ranges(const char *path, const CwRegionMesh *r) {
  CwStatus status = CW_OK;
  int64_t cells = (int64_t)r->tetrahedron_count + r->pyramid_count + r->prism_count;
  CW_REQUIRE(r->shared_count <= r->point_count, CW_ERR_INPUT,
             "%s: shared_id: has %d rows; points has only %d", path, r->shared_count, r->point_count);
  for (int32_t i = 0; i < r->point_count; i++) {
    const double *x = r->x[i];
    CW_REQUIRE(isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]), CW_ERR_INPUT,
               "%s: points: row %d is not finite", path, i);
  }
  for (int32_t i = 0; i < r->shared_count; i++) {
    CW_REQUIRE(r->shared_id[i] >= 0, CW_ERR_INPUT, "%s: shared_id: row %d holds %lld; 0 or more is allowed",
               path, i, (long long)r->shared_id[i]);
  }
  CW_TRY(check_range(path, "tetrahedra", *r->tetrahedron, r->tetrahedron_count, 4, r->point_count));
  CW_TRY(check_range(path, "pyramids", *r->pyramid, r->pyramid_count, 5, r->point_count));
  CW_TRY(check_range(path, "prisms", *r->prism, r->prism_count, 6, r->point_count));
  CW_TRY(check_range(path, "triangles", *r->triangle, r->triangle_count, 3, r->point_count));
  CW_TRY(check_range(path, "triangle_patch", r->triangle_patch, r->triangle_count, 1, INT32_MAX));
  CW_TRY(check_range(path, "triangle_cell", r->triangle_cell, r->triangle_count, 1, cells));
  CW_TRY(check_range(path, "quads", *r->quad, r->quad_count, 4, r->point_count));
  CW_TRY(check_range(path, "quad_patch", r->quad_patch, r->quad_count, 1, INT32_MAX));
  CW_TRY(check_range(path, "quad_cell", r->quad_cell, r->quad_count, 1, cells));
done:
  return status;
}

static CwStatus read_items(hid_t file, const char *path, CwRegionMesh *r) {
  CwStatus status = CW_OK;
  int32_t format = 0;
  void *data = NULL;
  CW_TRY(read_attribute(file, path, "format", &format));
  CW_REQUIRE(format == FORMAT, CW_ERR_INPUT, "%s: attribute format: is %d; %d is allowed", path, format,
             FORMAT);
  CW_TRY(read_text(file, path, "domain", r->domain, sizeof r->domain));
  CW_TRY(read_attribute(file, path, "region", &r->region));
  CW_TRY(read_attribute(file, path, "number", &r->number));
  CW_TRY(read_text(file, path, "fingerprint", r->fingerprint, sizeof r->fingerprint));
  CW_TRY(read_attribute(file, path, "recovered_triangles", &r->way.missing));
  CW_TRY(read_attribute(file, path, "recovery_flips", &r->way.flips));
  CW_TRY(read_attribute(file, path, "recovery_hollows", &r->way.cleared));
  CW_TRY(read_attribute(file, path, "recovery_points", &r->way.divided));
  CW_TRY(read_attribute(file, path, "tetgen", &r->way.tetgen));
  r->point_count = r->shared_count = r->tetrahedron_count = r->pyramid_count = r->prism_count = -1;
  r->triangle_count = r->quad_count = -1;
// Takes the memory over even where reading failed half-way, so that the caller frees it.
#define READ(name, type, columns, rows, field)                                                               \
  do {                                                                                                       \
    data = NULL;                                                                                             \
    status = read_data(file, path, name, type, sizeof *(field) / (columns), columns, &(rows), &data);        \
    (field) = data;                                                                                          \
    if (status != CW_OK)                                                                                     \
      goto done;                                                                                             \
  } while (0)
  READ("points", H5T_NATIVE_DOUBLE, 3, r->point_count, r->x);
  READ("shared_id", H5T_NATIVE_INT64, 1, r->shared_count, r->shared_id);
  READ("tetrahedra", H5T_NATIVE_INT32, 4, r->tetrahedron_count, r->tetrahedron);
  READ("pyramids", H5T_NATIVE_INT32, 5, r->pyramid_count, r->pyramid);
  READ("prisms", H5T_NATIVE_INT32, 6, r->prism_count, r->prism);
  READ("triangles", H5T_NATIVE_INT32, 3, r->triangle_count, r->triangle);
  READ("triangle_patch", H5T_NATIVE_INT32, 1, r->triangle_count, r->triangle_patch);
  READ("triangle_cell", H5T_NATIVE_INT32, 1, r->triangle_count, r->triangle_cell);
  READ("quads", H5T_NATIVE_INT32, 4, r->quad_count, r->quad);
  READ("quad_patch", H5T_NATIVE_INT32, 1, r->quad_count, r->quad_patch);
  READ("quad_cell", H5T_NATIVE_INT32, 1, r->quad_count, r->quad_cell);
#undef READ
done:
  return status;
}

CwStatus cw_region_read(const char *path, CwRegionMesh *region) {
  CwStatus status = CW_OK;
  Quiet quiet = quiet_start();
  memset(region, 0, sizeof *region);
  hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  CW_REQUIRE(file >= 0, CW_ERR_INPUT, "%s: is not a whole region file", path);
  CW_TRY(read_items(file, path, region));
  CW_TRY(check_ranges(path, region));
done:
  if (file >= 0)
    H5Fclose(file);
  if (status != CW_OK)
    cw_region_free(region);
  quiet_end(quiet);
  return status;
}

int cw_region_is_current(const char *path, const char *fingerprint) {
  if (access(path, R_OK) != 0)
    return 0;
  Quiet quiet = quiet_start();
  int current = 0;
  char found[sizeof((CwRegionMesh *)0)->fingerprint];
  int32_t format = 0;
  // A file cut short does not open: its superblock holds its length.
  hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file >= 0) {
    current = read_attribute(file, path, "format", &format) == CW_OK && format == FORMAT &&
              read_text(file, path, "fingerprint", found, sizeof found) == CW_OK &&
              strcmp(found, fingerprint) == 0;
    H5Fclose(file);
  }
  if (!current)
    cw_fail_clear();
  quiet_end(quiet);
  return current;
}

void cw_region_free(CwRegionMesh *region) {
  free(region->x);
  free(region->shared_id);
  free(region->tetrahedron);
  free(region->pyramid);
  free(region->prism);
  free(region->triangle);
  free(region->triangle_patch);
  free(region->triangle_cell);
  free(region->quad);
  free(region->quad_patch);
  free(region->quad_cell);
  memset(region, 0, sizeof *region);
}
