// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/region_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "mesher/common/model_unit.h"

static CwStatus write_attribute(hid_t file, const char *name, hid_t type, const void *data) {
  CwStatus status = CW_OK;
  hid_t space = H5Screate(H5S_SCALAR);
  hid_t attribute = H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  CW_REQUIRE(attribute >= 0 && H5Awrite(attribute, type, data) >= 0, CW_ERR_IO, "attribute %s: cannot be written",
             name);
done:
  if (attribute >= 0) H5Aclose(attribute);
  if (space >= 0) H5Sclose(space);
  return status;
}

static CwStatus write_integer(hid_t file, const char *name, int32_t value) {
  return write_attribute(file, name, H5T_STD_I32LE, &value);
}

static CwStatus write_text(hid_t file, const char *name, const char *text) {
  hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, strlen(text) + 1);
  CwStatus status = write_attribute(file, name, type, text);
  H5Tclose(type);
  return status;
}

CwRegionData cw_region_data(const CwRegionMesh *r) {
  return (CwRegionData){.point_count = r->point_count,
                        .shared_count = r->shared_count,
                        .tetrahedron_count = r->tetrahedron_count,
                        .pyramid_count = r->pyramid_count,
                        .prism_count = r->prism_count,
                        .triangle_count = r->triangle_count,
                        .quad_count = r->quad_count,
                        .points = r->x,
                        .shared_id = r->shared_id,
                        .tetrahedra = r->tetrahedron,
                        .pyramids = r->pyramid,
                        .prisms = r->prism,
                        .triangles = r->triangle,
                        .triangle_patch = r->triangle_patch,
                        .triangle_cell = r->triangle_cell,
                        .quads = r->quad,
                        .quad_patch = r->quad_patch,
                        .quad_cell = r->quad_cell};
}

// The other way round.
static void take_data(const CwRegionData *data, CwRegionMesh *r) {
  r->point_count = data->point_count;
  r->shared_count = data->shared_count;
  r->tetrahedron_count = data->tetrahedron_count;
  r->pyramid_count = data->pyramid_count;
  r->prism_count = data->prism_count;
  r->triangle_count = data->triangle_count;
  r->quad_count = data->quad_count;
  r->x = data->points;
  r->shared_id = data->shared_id;
  r->tetrahedron = data->tetrahedra;
  r->pyramid = data->pyramids;
  r->prism = data->prisms;
  r->triangle = data->triangles;
  r->triangle_patch = data->triangle_patch;
  r->triangle_cell = data->triangle_cell;
  r->quad = data->quads;
  r->quad_patch = data->quad_patch;
  r->quad_cell = data->quad_cell;
}

static void multiply(int32_t count, const double (*x)[3], double by, double (*to)[3]) {
  for (int32_t p = 0; p < count; p++) {
    for (int k = 0; k < 3; k++) to[p][k] = by * x[p][k];
  }
}

static CwStatus write_items(hid_t file, const CwRegionMesh *r) {
  CwStatus status = CW_OK;
  CwRegionData data = cw_region_data(r);
  double(*metres)[3] = NULL;
  CW_NEW_UNSET(metres, r->point_count);
  multiply(r->point_count, (const double(*)[3])r->x, cw_model_unit(), metres);
  data.points = metres;
  CW_TRY(write_integer(file, "format", CW_REGION_FORMAT));
  CW_TRY(write_text(file, "domain", r->domain));
  CW_TRY(write_integer(file, "region", r->region));
  CW_TRY(write_integer(file, "number", r->number));
  CW_TRY(write_text(file, "fingerprint", r->fingerprint));
  CW_TRY(write_integer(file, "recovered_triangles", r->recovery.missing));
  CW_TRY(write_integer(file, "recovery_flips", r->recovery.flips));
  CW_TRY(write_integer(file, "tetgen", r->recovery.tetgen));
  CW_TRY(cw_region_items_write(file, &data));
done:
  free(metres);
  return status;
}

CwStatus cw_region_write(const char *path, const CwRegionMesh *region) {
  CwStatus status = CW_OK;
  hid_t access = -1, creation = -1, file = -1;
  char *temporary = NULL;
  int made = 0;
  CW_NEW(temporary, strlen(path) + 6);
  sprintf(temporary, "%s.part", path);

  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
  creation = H5Pcreate(H5P_FILE_CREATE);
  H5Pset_obj_track_times(creation, 0); // equal regions give equal bytes
  errno = 0;
  file = H5Fcreate(temporary, H5F_ACC_TRUNC, creation, access);
  CW_REQUIRE(file >= 0, CW_ERR_IO, "%s: cannot be made: %s", path, errno ? strerror(errno) : "HDF5 refuses");
  made = 1;
  status = write_items(file, region);
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
  if (file >= 0) H5Fclose(file);
  if (made) unlink(temporary);
  if (creation >= 0) H5Pclose(creation);
  if (access >= 0) H5Pclose(access);
  free(temporary);
  return status;
}

static CwStatus read_items(hid_t file, const char *path, CwRegionMesh *r) {
  CwStatus status = CW_OK;
  CwRegionData data = {.point_count = -1,
                       .shared_count = -1,
                       .tetrahedron_count = -1,
                       .pyramid_count = -1,
                       .prism_count = -1,
                       .triangle_count = -1,
                       .quad_count = -1};
  const struct {
    const char *name;
    int32_t *value;
  } integers[] = {{"region", &r->region},
                  {"number", &r->number},
                  {"recovered_triangles", &r->recovery.missing},
                  {"recovery_flips", &r->recovery.flips},
                  {"tetgen", &r->recovery.tetgen}};
  for (size_t k = 0; k < sizeof integers / sizeof *integers; k++)
    CW_TRY(cw_region_items_integer(file, path, integers[k].name, integers[k].value));
  CW_TRY(cw_region_items_text(file, path, "domain", r->domain, sizeof r->domain));
  CW_TRY(cw_region_items_text(file, path, "fingerprint", r->fingerprint, sizeof r->fingerprint));
  status = cw_region_items_read(file, path, CW_REGION_WHOLE, &data);
  take_data(&data, r); // what was read before a failure is freed with the region
  CW_TRY(status);
  CW_TRY(cw_region_items_check(path, CW_REGION_WHOLE, INT32_MAX, INT64_MAX, &data));
  multiply(r->point_count, (const double(*)[3])r->x, 1 / cw_model_unit(), r->x);
done:
  return status;
}

CwStatus cw_region_read(const char *path, CwRegionMesh *region) {
  CwStatus status = CW_OK;
  hid_t file = -1;
  memset(region, 0, sizeof *region);
  CW_TRY(cw_region_items_open(path, &file));
  CW_TRY(read_items(file, path, region));
done:
  if (file >= 0) H5Fclose(file);
  if (status != CW_OK) cw_region_free(region);
  return status;
}

int cw_region_is_current(const char *path, const char *fingerprint) {
  int current = 0;
  char found[sizeof((CwRegionMesh *)0)->fingerprint];
  hid_t file = -1;
  if (access(path, R_OK) != 0) return 0;
  // A file cut short does not open: its superblock holds its length.
  if (cw_region_items_open(path, &file) == CW_OK) {
    current = cw_region_items_text(file, path, "fingerprint", found, sizeof found) == CW_OK &&
              strcmp(found, fingerprint) == 0;
    H5Fclose(file);
  }
  if (!current) cw_fail_clear();
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
