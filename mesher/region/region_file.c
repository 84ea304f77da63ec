// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/region_file.h"

#include <errno.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "mesher/common/model_unit.h"
#include "pipeline/atomic_file.h"

// The attributes that are integers.
static const struct {
  const char *name;
  size_t place; // in CwRegionMesh
} integers[] = {{"region", offsetof(CwRegionMesh, region)},
                {"number", offsetof(CwRegionMesh, number)},
                {"recovered_triangles", offsetof(CwRegionMesh, recovery.missing)},
                {"recovery_flips", offsetof(CwRegionMesh, recovery.flips)},
                {"tetgen", offsetof(CwRegionMesh, recovery.tetgen)}};
enum { INTEGERS = sizeof integers / sizeof *integers };

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

static CwStatus write_items(hid_t file, CwRegionMesh *r) {
  CwStatus status = CW_OK;
  CwRegionData data = cw_region_data(r);
  double(*metres)[3] = NULL;
  CW_NEW_UNSET(metres, r->point_count);
  multiply(r->point_count, (const double(*)[3])r->x, cw_model_unit(), metres);
  data.points = metres;
  CW_TRY(cw_region_items_put_integer(file, "format", CW_REGION_FORMAT));
  CW_TRY(cw_region_items_put_text(file, "domain", r->domain));
  CW_TRY(cw_region_items_put_text(file, "fingerprint", r->fingerprint));
  for (size_t k = 0; k < INTEGERS; k++)
    CW_TRY(
        cw_region_items_put_integer(file, integers[k].name, *(const int32_t *)((const char *)r + integers[k].place)));
  CW_TRY(cw_region_items_write(file, &data, r->digest));
done:
  free(metres);
  return status;
}

CwStatus cw_region_write(const char *path, CwRegionMesh *region) {
  CwStatus status = CW_OK;
  hid_t file = -1;
  CwAtomicFile temporary = {0};
  CW_TRY(cw_atomic_file_name(path, &temporary));
  errno = 0;
  file = cw_region_items_create(temporary.temporary_path);
  CW_REQUIRE(file >= 0, CW_ERR_IO, "%s: cannot be made: %s", path, errno ? strerror(errno) : "HDF5 refuses");
  status = write_items(file, region);
  if (status != CW_OK) {
    status = CW_FAIL(status, "%s: %s (is the disk full?)", path, cw_fail_message());
    goto done;
  }
  herr_t closed = H5Fclose(file);
  file = -1;
  CW_REQUIRE(closed >= 0, CW_ERR_IO, "%s: cannot be written to its end (is the disk full?)", path);
  CW_TRY(cw_atomic_file_commit(&temporary));
done:
  if (file >= 0) H5Fclose(file);
  cw_atomic_file_abandon(&temporary);
  return status;
}

// Of an open file.
static CwStatus read_items(hid_t file, const char *path, CwRegionMesh *r) {
  CwStatus status = CW_OK;
  CwRegionData data = {.point_count = -1,
                       .shared_count = -1,
                       .tetrahedron_count = -1,
                       .pyramid_count = -1,
                       .prism_count = -1,
                       .triangle_count = -1,
                       .quad_count = -1};
  for (size_t k = 0; k < INTEGERS; k++)
    CW_TRY(cw_region_items_integer(file, path, integers[k].name, (int32_t *)((char *)r + integers[k].place)));
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
  CW_TRY(cw_region_items_open(path, &file, region->digest));
  CW_TRY(read_items(file, path, region));
done:
  if (file >= 0) H5Fclose(file);
  if (status != CW_OK) cw_region_free(region);
  return status;
}

CwStatus cw_region_take_up(const char *path, const char *fingerprint, CwRegionMesh *region, CwRegionFound *found) {
  CwStatus status = CW_OK;
  char its[sizeof region->fingerprint];
  hid_t file = -1;
  memset(region, 0, sizeof *region);
  *found = CW_REGION_OTHER;
  if (access(path, F_OK) != 0) goto done;
  status = cw_region_items_open(path, &file, region->digest);
  if (status == CW_ERR_INPUT) goto done; // of another format
  if (status == CW_OK) status = cw_region_items_text(file, path, "fingerprint", its, sizeof its);
  if (status == CW_OK && strcmp(its, fingerprint)) goto done;
  if (status == CW_OK) status = read_items(file, path, region);
  *found = status == CW_OK ? CW_REGION_TAKEN : CW_REGION_DAMAGED;
done:
  if (file >= 0) H5Fclose(file);
  if (*found != CW_REGION_TAKEN) cw_region_free(region);
  return status == CW_ERR_MEMORY ? status : CW_OK;
}

CwStatus cw_region_digest_read(const char *path, char digest[CW_HASH_TEXT]) {
  hid_t file = -1;
  CwStatus status = cw_region_items_open(path, &file, digest);
  if (file >= 0) H5Fclose(file);
  return status;
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
