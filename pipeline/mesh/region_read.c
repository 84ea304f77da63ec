// SPDX-License-Identifier: AGPL-3.0-or-later
// One region file into memory, with every check that needs this one region only.
#include <hdf5.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/mesh/region_read.h"

void cw_mesh_region_free(CwRegionData *data) {
  free(data->points);
  free(data->shared_id);
  free(data->tetrahedra);
  free(data->pyramids);
  free(data->prisms);
  free(data->triangles);
  free(data->triangle_patch);
  free(data->triangle_cell);
  free(data->quads);
  free(data->quad_patch);
  free(data->quad_cell);
  memset(data, 0, sizeof *data);
}

// Reads a whole dataset of `rows` x `columns` (columns 0: one dimension) into `into`. A dataset without rows
// may be left out of the file.
static CwStatus read_rows(hid_t file, const char *path, const char *name, hid_t type, int64_t rows,
                          int columns, void *into) {
  CwStatus status = CW_OK;
  hid_t set = -1, space = -1;
  hsize_t size[2] = {0, 0};
  if (rows == 0 && H5Lexists(file, name, H5P_DEFAULT) <= 0)
    goto done;
  set = H5Dopen2(file, name, H5P_DEFAULT);
  CW_REQUIRE(set >= 0, CW_ERR_INPUT, "%s: dataset '%s' is missing", path, name);
  space = H5Dget_space(set);
  int ranks = H5Sget_simple_extent_ndims(space);
  CW_REQUIRE(ranks == (columns ? 2 : 1), CW_ERR_INPUT, "%s: dataset '%s' has %d dimensions; it must have %d",
             path, name, ranks, columns ? 2 : 1);
  H5Sget_simple_extent_dims(space, size, NULL);
  CW_REQUIRE(size[0] == (hsize_t)rows, CW_ERR_INPUT,
             "%s: dataset '%s' has %llu rows, but the manifest says %lld", path, name,
             (unsigned long long)size[0], (long long)rows);
  CW_REQUIRE(!columns || size[1] == (hsize_t)columns, CW_ERR_INPUT,
             "%s: dataset '%s' has %llu columns; it must have %d", path, name, (unsigned long long)size[1],
             columns);
  if (rows)
    CW_REQUIRE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, into) >= 0, CW_ERR_IO,
               "%s: dataset '%s' cannot be read: the file is damaged or cut short", path, name);
done:
  if (space >= 0)
    H5Sclose(space);
  if (set >= 0)
    H5Dclose(set);
  return status;
}

static CwStatus check_attributes(hid_t file, const char *path, const char *domain, int region) {
  CwStatus status = CW_OK;
  static const char *const names[] = {"format", "region"};
  int wanted[] = {1, region};
  hid_t attribute = -1, type = -1;
  char *text = NULL;
  for (int i = 0; i < 2; ++i) {
    int value = 0;
    attribute = H5Aopen(file, names[i], H5P_DEFAULT);
    CW_REQUIRE(attribute >= 0, CW_ERR_INPUT, "%s: attribute '%s' is missing", path, names[i]);
    CW_REQUIRE(H5Aread(attribute, H5T_NATIVE_INT, &value) >= 0 && value == wanted[i], CW_ERR_INPUT,
               "%s: attribute '%s' is %d; it must be %d", path, names[i], value, wanted[i]);
    H5Aclose(attribute);
    attribute = -1;
  }
  attribute = H5Aopen(file, "domain", H5P_DEFAULT);
  CW_REQUIRE(attribute >= 0, CW_ERR_INPUT, "%s: attribute 'domain' is missing", path);
  type = H5Aget_type(attribute);
  CW_REQUIRE(H5Tget_class(type) == H5T_STRING, CW_ERR_INPUT, "%s: attribute 'domain' must be a string", path);
  if (H5Tis_variable_str(type) > 0) {
    CW_REQUIRE(H5Aread(attribute, type, &text) >= 0, CW_ERR_IO, "%s: attribute 'domain' cannot be read",
               path);
  } else {
    CW_NEW(text, H5Tget_size(type) + 1);
    CW_REQUIRE(H5Aread(attribute, type, text) >= 0, CW_ERR_IO, "%s: attribute 'domain' cannot be read", path);
  }
  CW_REQUIRE(text && strcmp(text, domain) == 0, CW_ERR_INPUT,
             "%s: attribute 'domain' is '%s'; it must be '%s'", path, text ? text : "", domain);
done:
  free(text);
  if (type >= 0)
    H5Tclose(type);
  if (attribute >= 0)
    H5Aclose(attribute);
  return status;
}

// Every one of `count` indices must lie in [0, limit).
static CwStatus check_indices(const char *path, const char *name, const int32_t *index, int64_t count,
                              int64_t limit) {
  CwStatus status = CW_OK;
  for (int64_t i = 0; i < count; ++i)
    CW_REQUIRE(index[i] >= 0 && index[i] < limit, CW_ERR_INPUT,
               "%s: dataset '%s': entry %lld is %d; allowed 0 to %lld", path, name, (long long)i, index[i],
               (long long)limit - 1);
done:
  return status;
}

static CwStatus check_region(const CwMesh *mesh, const CwMeshRegion *line, const CwRegionData *r,
                             CwRegionPart part) {
  CwStatus status = CW_OK;
  const char *path = line->path;
  const CwMeshDomain *domain = &mesh->domains[line->domain];
  int64_t cells = cw_region_cell_count(r);
  for (int32_t i = 0; i < r->point_count; ++i)
    CW_REQUIRE(isfinite(r->points[i][0]) && isfinite(r->points[i][1]) && isfinite(r->points[i][2]),
               CW_ERR_INPUT, "%s: point %d has a coordinate that is not a number", path, i);
  CW_TRY(check_indices(path, "triangles", *r->triangles, 3 * line->triangles, r->point_count));
  CW_TRY(check_indices(path, "triangle_patch", r->triangle_patch, line->triangles, domain->patch_count));
  CW_TRY(check_indices(path, "quads", *r->quads, 4 * line->quads, r->point_count));
  CW_TRY(check_indices(path, "quad_patch", r->quad_patch, line->quads, domain->patch_count));
  if (part == CW_REGION_SURFACE)
    goto done;
  for (int32_t i = 0; i < r->shared_count; ++i)
    CW_REQUIRE(r->shared_id[i] >= 0 && r->shared_id[i] < domain->shared_points, CW_ERR_INPUT,
               "%s: dataset 'shared_id': entry %d is %lld; allowed 0 to %lld", path, i,
               (long long)r->shared_id[i], (long long)domain->shared_points - 1);
  CW_TRY(check_indices(path, "tetrahedra", *r->tetrahedra, 4 * line->tetrahedra, r->point_count));
  CW_TRY(check_indices(path, "pyramids", *r->pyramids, 5 * line->pyramids, r->point_count));
  CW_TRY(check_indices(path, "prisms", *r->prisms, 6 * line->prisms, r->point_count));
  CW_TRY(check_indices(path, "triangle_cell", r->triangle_cell, line->triangles, cells));
  CW_TRY(check_indices(path, "quad_cell", r->quad_cell, line->quads, cells));
done:
  return status;
}

CwStatus cw_mesh_region_read(const CwMesh *mesh, int region, CwRegionPart part, CwRegionData *r) {
  CwStatus status = CW_OK;
  const CwMeshRegion *line = &mesh->regions[region];
  const char *path = line->path;
  hid_t file = -1;
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  CW_REQUIRE(file >= 0, CW_ERR_IO, "%s: is missing, damaged or cut short: cannot be opened as HDF5", path);
  CW_TRY(check_attributes(file, path, mesh->domains[line->domain].name, line->region));
  r->domain = line->domain;
  r->region = line->region;
  r->point_count = (int32_t)line->points;
  r->triangle_count = (int32_t)line->triangles;
  r->quad_count = (int32_t)line->quads;
  if (part == CW_REGION_WHOLE) {
    r->shared_count = (int32_t)(line->points - line->own_points);
    r->tetrahedron_count = (int32_t)line->tetrahedra;
    r->pyramid_count = (int32_t)line->pyramids;
    r->prism_count = (int32_t)line->prisms;
  }
  struct {
    const char *name;
    CwRegionPart part; // the least that has it
    hid_t type;
    size_t size;
    int64_t rows;
    int columns;
    void **into;
  } sets[] = {
#define SET(name, part, type, rows, columns, member)                                                         \
  {name, part, type, sizeof *r->member, rows, columns, (void **)&r->member}
      SET("points", CW_REGION_SURFACE, H5T_NATIVE_DOUBLE, line->points, 3, points),
      SET("triangles", CW_REGION_SURFACE, H5T_NATIVE_INT32, line->triangles, 3, triangles),
      SET("triangle_patch", CW_REGION_SURFACE, H5T_NATIVE_INT32, line->triangles, 0, triangle_patch),
      SET("quads", CW_REGION_SURFACE, H5T_NATIVE_INT32, line->quads, 4, quads),
      SET("quad_patch", CW_REGION_SURFACE, H5T_NATIVE_INT32, line->quads, 0, quad_patch),
      SET("shared_id", CW_REGION_WHOLE, H5T_NATIVE_INT64, r->shared_count, 0, shared_id),
      SET("tetrahedra", CW_REGION_WHOLE, H5T_NATIVE_INT32, line->tetrahedra, 4, tetrahedra),
      SET("pyramids", CW_REGION_WHOLE, H5T_NATIVE_INT32, line->pyramids, 5, pyramids),
      SET("prisms", CW_REGION_WHOLE, H5T_NATIVE_INT32, line->prisms, 6, prisms),
      SET("triangle_cell", CW_REGION_WHOLE, H5T_NATIVE_INT32, line->triangles, 0, triangle_cell),
      SET("quad_cell", CW_REGION_WHOLE, H5T_NATIVE_INT32, line->quads, 0, quad_cell),
#undef SET
  };
  for (size_t i = 0; i < sizeof sets / sizeof *sets; ++i) {
    if (part == CW_REGION_SURFACE && sets[i].part == CW_REGION_WHOLE)
      continue;
    *sets[i].into = malloc(((size_t)sets[i].rows + !sets[i].rows) * sets[i].size);
    CW_REQUIRE(*sets[i].into, CW_ERR_MEMORY, "out of memory: %s of %s", sets[i].name, path);
    CW_TRY(read_rows(file, path, sets[i].name, sets[i].type, sets[i].rows, sets[i].columns, *sets[i].into));
  }
  CW_TRY(check_region(mesh, line, r, part));
done:
  if (file >= 0)
    H5Fclose(file);
  return status;
}
