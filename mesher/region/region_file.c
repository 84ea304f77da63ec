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
                {"tetgen", offsetof(CwRegionMesh, recovery.tetgen)},
                {"layer_tetrahedra", offsetof(CwRegionMesh, layer_tetrahedra)}};
enum { INTEGERS = sizeof integers / sizeof *integers };

static CwStatus write_items(hid_t file, CwRegionMesh *r) {
  CwStatus status = CW_OK;
  CW_TRY(cw_region_items_put_integer(file, "format", CW_REGION_FORMAT));
  CW_TRY(cw_region_items_put_text(file, "domain", r->domain));
  CW_TRY(cw_region_items_put_text(file, "fingerprint", r->fingerprint));
  for (size_t k = 0; k < INTEGERS; k++)
    CW_TRY(
        cw_region_items_put_integer(file, integers[k].name, *(const int32_t *)((const char *)r + integers[k].place)));
  CW_TRY(cw_region_items_put_number(file, "unit_m", cw_model_unit()));
  CW_TRY(cw_region_items_write(file, &r->cells, r->digest));
done:
  return status;
}

CwStatus cw_region_write_begin(const char *path, CwRegionMesh *region, CwAtomicFile *temporary) {
  CwStatus status = CW_OK;
  hid_t file = -1;
  CW_TRY(cw_atomic_file_name(path, temporary));
  errno = 0;
  file = cw_region_items_create(temporary->temporary_path);
  CW_REQUIRE(file >= 0, CW_ERR_IO, "%s: cannot be made: %s", path, errno ? strerror(errno) : "HDF5 refuses");
  status = write_items(file, region);
  if (status != CW_OK) {
    status = CW_FAIL(status, "%s: %s (is the disk full?)", path, cw_fail_message());
    goto done;
  }
  herr_t closed = H5Fclose(file);
  file = -1;
  CW_REQUIRE(closed >= 0, CW_ERR_IO, "%s: cannot be written to its end (is the disk full?)", path);
  cw_sync_begin(temporary->temporary_path);
done:
  if (file >= 0) H5Fclose(file);
  if (status != CW_OK) cw_atomic_file_abandon(temporary);
  return status;
}

CwStatus cw_region_write(const char *path, CwRegionMesh *region) {
  CwAtomicFile file = {0};
  CwStatus status = cw_region_write_begin(path, region, &file);
  return status == CW_OK ? cw_atomic_file_commit(&file) : status;
}

// Of an open file.
static CwStatus read_items(hid_t file, const char *path, CwRegionMesh *r) {
  CwStatus status = CW_OK;
  CwRegionData *cells = &r->cells;
  double unit;
  cells->point_count = cells->shared_count = cells->tetrahedron_count = cells->pyramid_count = -1;
  cells->prism_count = cells->triangle_count = cells->quad_count = -1; // not known before
  for (size_t k = 0; k < INTEGERS; k++)
    CW_TRY(cw_region_items_integer(file, path, integers[k].name, (int32_t *)((char *)r + integers[k].place)));
  CW_TRY(cw_region_items_text(file, path, "domain", r->domain, sizeof r->domain));
  CW_TRY(cw_region_items_text(file, path, "fingerprint", r->fingerprint, sizeof r->fingerprint));
  CW_TRY(cw_region_items_read(file, path, CW_REGION_WHOLE, cells));
  CW_TRY(cw_region_items_check(path, CW_REGION_WHOLE, INT32_MAX, INT64_MAX, cells));
  CW_TRY(cw_region_items_number(file, path, "unit_m", &unit));
  cw_region_items_scale(cells, unit / cw_model_unit());
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
  cw_mesh_region_free(&region->cells);
  memset(region, 0, sizeof *region);
}
