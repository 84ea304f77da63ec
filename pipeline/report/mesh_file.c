// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/mesh_file.h"

#include <hdf5.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "pipeline/report/json_read.h"

static const char *const first_names[] = {"rotor", "stator"};

static CwStatus copy_text(const char *text, char **copy) {
  *copy = strdup(text);
  return *copy ? CW_OK : CW_FAIL(CW_ERR_MEMORY, "out of memory: a name");
}

static CwStatus region_manifest(json_t *item, const char *where, CwReportRegion *region) {
  CwStatus status = CW_OK;
  const char *file;
  int64_t index, number;
  CW_TRY(cw_json_text(item, where, "file", &file));
  CW_REQUIRE(!strchr(file, '/'), CW_ERR_INPUT, "%s: 'file' is %s; it must be a name without a folder", where,
             file);
  CW_TRY(copy_text(file, &region->file));
  CW_TRY(cw_json_count(item, where, "region", &index));
  CW_TRY(cw_json_count(item, where, "number", &number));
  region->region = (int)index;
  region->number = (int)number;
  CW_TRY(cw_json_count(item, where, "points", &region->points));
  CW_TRY(cw_json_count(item, where, "own_points", &region->own_points));
  CW_TRY(cw_json_count(item, where, "tetrahedra", &region->tetrahedra));
  CW_TRY(cw_json_count(item, where, "pyramids", &region->pyramids));
  CW_TRY(cw_json_count(item, where, "prisms", &region->prisms));
  CW_TRY(cw_json_count(item, where, "triangles", &region->triangles));
  CW_TRY(cw_json_count(item, where, "quads", &region->quads));
done:
  return status;
}

static CwStatus domain_manifest(json_t *item, const char *path, CwReportDomain *domain) {
  CwStatus status = CW_OK;
  json_t *patches, *regions;
  char where[4200];
  snprintf(where, sizeof where, "%s: domain %s", path, domain->name);
  CW_TRY(cw_json_array(item, where, "patches", &patches));
  CW_REQUIRE(json_array_size(patches) <= CW_REPORT_PATCHES, CW_ERR_INPUT,
             "%s: %zu patches; at most %d are allowed", where, json_array_size(patches), CW_REPORT_PATCHES);
  for (size_t p = 0; p < json_array_size(patches); p++) {
    const char *name;
    CW_TRY(cw_json_text(json_array_get(patches, p), where, "name", &name));
    CW_TRY(copy_text(name, &domain->patch[p]));
    domain->patch_count++;
  }
  CW_TRY(cw_json_array(item, where, "regions", &regions));
  CW_REQUIRE(json_array_size(regions) > 0, CW_ERR_INPUT, "%s: no regions", where);
  CW_NEW(domain->region, json_array_size(regions));
  domain->region_count = (int)json_array_size(regions);
  for (int r = 0; r < domain->region_count; r++) {
    snprintf(where, sizeof where, "%s: domain %s, region %d", path, domain->name, r + 1);
    CW_TRY(region_manifest(json_array_get(regions, (size_t)r), where, &domain->region[r]));
  }
done:
  return status;
}

CwStatus cw_report_mesh_read(const char *run, CwReportMesh *mesh) {
  CwStatus status = CW_OK;
  char path[4096];
  const char *name;
  json_t *root = NULL, *domains;
  *mesh = (CwReportMesh){0};
  snprintf(path, sizeof path, "%s/mesh", run);
  CW_TRY(copy_text(path, &mesh->folder));
  snprintf(path, sizeof path, "%s/mesh/manifest.json", run);
  CW_TRY(cw_json_read(path, &root));
  int64_t format;
  CW_TRY(cw_json_count(root, path, "format", &format));
  CW_REQUIRE(format == 1, CW_ERR_INPUT, "%s: format %lld; this program reads format 1", path,
             (long long)format);
  CW_TRY(cw_json_text(root, path, "case", &name));
  CW_TRY(copy_text(name, &mesh->case_name));
  CW_TRY(cw_json_array(root, path, "domains", &domains));
  CW_REQUIRE(json_array_size(domains) >= 2 && json_array_size(domains) <= CW_REPORT_DOMAINS_MOST, CW_ERR_INPUT,
             "%s: %zu domains; there must be 2 to %d", path, json_array_size(domains), CW_REPORT_DOMAINS_MOST);
  mesh->domain_count = (int)json_array_size(domains);
  for (int d = 0; d < mesh->domain_count; d++) {
    json_t *item = json_array_get(domains, (size_t)d);
    CW_TRY(cw_json_text(item, path, "name", &name));
    CW_REQUIRE(d > CW_REPORT_STATOR || !strcmp(name, first_names[d]), CW_ERR_INPUT,
               "%s: domain %d is %s; it must be %s", path, d + 1, name, first_names[d]);
    CW_TRY(copy_text(name, &mesh->domain[d].name));
    CW_TRY(domain_manifest(item, path, &mesh->domain[d]));
  }
done:
  json_decref(root);
  return status;
}

void cw_report_mesh_free(CwReportMesh *mesh) {
  for (int d = 0; d < CW_REPORT_DOMAINS_MOST; d++) {
    CwReportDomain *domain = &mesh->domain[d];
    for (int p = 0; p < domain->patch_count; p++)
      free(domain->patch[p]);
    for (int r = 0; r < domain->region_count; r++)
      free(domain->region[r].file);
    free(domain->region);
    free(domain->name);
  }
  free(mesh->folder);
  free(mesh->case_name);
  *mesh = (CwReportMesh){0};
}

int cw_report_patch(const CwReportDomain *domain, const char *name) {
  for (int p = 0; p < domain->patch_count; p++) {
    if (!strcmp(domain->patch[p], name))
      return p;
  }
  return -1;
}

// Reads the whole dataset `name` of `rows` x `columns` (1: one dimension). Without rows it may be missing.
static CwStatus read_rows(hid_t file, const char *path, const char *name, hid_t type, int64_t rows,
                          int columns, void *into) {
  CwStatus status = CW_OK;
  hid_t set = -1, space = -1;
  hsize_t size[2] = {0, 1};
  if (rows == 0 && H5Lexists(file, name, H5P_DEFAULT) <= 0)
    goto done;
  CW_REQUIRE(H5Lexists(file, name, H5P_DEFAULT) > 0, CW_ERR_INPUT, "%s: dataset '%s' is missing", path, name);
  set = H5Dopen2(file, name, H5P_DEFAULT);
  CW_REQUIRE(set >= 0, CW_ERR_INPUT, "%s: '%s' is no dataset", path, name);
  space = H5Dget_space(set);
  CW_REQUIRE(H5Sget_simple_extent_ndims(space) == (columns > 1 ? 2 : 1), CW_ERR_INPUT,
             "%s: dataset '%s' must have %d dimensions", path, name, columns > 1 ? 2 : 1);
  H5Sget_simple_extent_dims(space, size, NULL);
  CW_REQUIRE(size[0] == (hsize_t)rows && size[1] == (hsize_t)columns, CW_ERR_INPUT,
             "%s: dataset '%s' has %llu x %llu values, but %lld x %d follow from the manifest", path, name,
             (unsigned long long)size[0], (unsigned long long)size[1], (long long)rows, columns);
  if (rows) {
    CW_REQUIRE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, into) >= 0, CW_ERR_IO,
               "%s: dataset '%s' cannot be read: the file is damaged or cut short", path, name);
  }
done:
  if (space >= 0)
    H5Sclose(space);
  if (set >= 0)
    H5Dclose(set);
  return status;
}

static CwStatus read_indices(hid_t file, const char *path, const char *name, int64_t rows, int columns,
                             int64_t limit, int32_t *into) {
  CwStatus status = CW_OK;
  CW_TRY(read_rows(file, path, name, H5T_NATIVE_INT32, rows, columns, into));
  for (int64_t i = 0; i < rows * columns; i++) {
    CW_REQUIRE(into[i] >= 0 && into[i] < limit, CW_ERR_INPUT,
               "%s: dataset '%s', row %lld holds %d; allowed: 0 to %lld", path, name,
               (long long)(i / columns), into[i], (long long)limit - 1);
  }
done:
  return status;
}

CwStatus cw_report_cells_read(const CwReportMesh *mesh, int d, int r, int with_cells, CwReportCells *cells) {
  CwStatus status = CW_OK;
  const CwReportDomain *domain = &mesh->domain[d];
  const CwReportRegion *region = &domain->region[r];
  const int64_t sizes[] = {region->points, region->tetrahedra, region->pyramids,
                           region->prisms, region->triangles,  region->quads};
  char path[4200];
  hid_t file = -1;
  *cells = (CwReportCells){0};
  snprintf(path, sizeof path, "%s/%s", mesh->folder, region->file);
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
    CW_REQUIRE(sizes[i] <= INT_MAX, CW_ERR_INPUT, "%s: %lld items; at most %d are allowed in a region", path,
               (long long)sizes[i], INT_MAX);
  }
  CW_REQUIRE(access(path, R_OK) == 0, CW_ERR_IO, "%s: cannot be read, but the manifest names it", path);
  file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  CW_REQUIRE(file >= 0, CW_ERR_INPUT, "%s: not a whole HDF5 file", path);
  cells->points = (int32_t)region->points;
  cells->triangles = (int32_t)region->triangles;
  cells->quads = (int32_t)region->quads;
  CW_NEW(cells->x, cells->points);
  CW_NEW(cells->triangle, cells->triangles);
  CW_NEW(cells->triangle_patch, cells->triangles);
  CW_NEW(cells->quad, cells->quads);
  CW_NEW(cells->quad_patch, cells->quads);
  CW_TRY(read_rows(file, path, "points", H5T_NATIVE_DOUBLE, cells->points, 3, cells->x));
  CW_TRY(read_indices(file, path, "triangles", cells->triangles, 3, cells->points, &cells->triangle[0][0]));
  CW_TRY(read_indices(file, path, "triangle_patch", cells->triangles, 1, domain->patch_count,
                      cells->triangle_patch));
  CW_TRY(read_indices(file, path, "quads", cells->quads, 4, cells->points, &cells->quad[0][0]));
  CW_TRY(read_indices(file, path, "quad_patch", cells->quads, 1, domain->patch_count, cells->quad_patch));
  if (!with_cells)
    goto done;
  cells->tetrahedra = (int32_t)region->tetrahedra;
  cells->pyramids = (int32_t)region->pyramids;
  cells->prisms = (int32_t)region->prisms;
  CW_NEW(cells->tetrahedron, cells->tetrahedra);
  CW_NEW(cells->pyramid, cells->pyramids);
  CW_NEW(cells->prism, cells->prisms);
  CW_TRY(
      read_indices(file, path, "tetrahedra", cells->tetrahedra, 4, cells->points, &cells->tetrahedron[0][0]));
  CW_TRY(read_indices(file, path, "pyramids", cells->pyramids, 5, cells->points, &cells->pyramid[0][0]));
  CW_TRY(read_indices(file, path, "prisms", cells->prisms, 6, cells->points, &cells->prism[0][0]));
done:
  if (file >= 0)
    H5Fclose(file);
  return status;
}

void cw_report_cells_free(CwReportCells *cells) {
  free(cells->x);
  free(cells->tetrahedron);
  free(cells->pyramid);
  free(cells->prism);
  free(cells->triangle);
  free(cells->triangle_patch);
  free(cells->quad);
  free(cells->quad_patch);
  *cells = (CwReportCells){0};
}
