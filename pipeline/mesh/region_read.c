// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/mesh/region_read.h"

#include <fcntl.h>
#include <string.h>
#include <unistd.h>

void cw_mesh_region_ahead(const CwMesh *mesh, int region) {
  const int handle = open(mesh->regions[region].path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (handle < 0) return; // reading it tells
  posix_fadvise(handle, 0, 0, POSIX_FADV_WILLNEED);
  close(handle);
}

CwStatus cw_mesh_region_read(const CwMesh *mesh, int region, CwRegionPart part, CwRegionData *r) {
  CwStatus status = CW_OK;
  const CwMeshRegion *line = &mesh->regions[region];
  const CwMeshDomain *domain = &mesh->domains[line->domain];
  const char *path = line->path;
  hid_t file = -1;
  int32_t number = 0;
  double unit;
  char name[CW_MESH_NAME_SIZE], digest[CW_HASH_TEXT];
  CW_TRY(cw_region_items_open(path, &file, digest));
  CW_TRY(cw_region_items_integer(file, path, "region", &number));
  CW_REQUIRE(number == line->region, CW_ERR_INPUT, "%s: attribute 'region' is %d; it must be %d", path, number,
             line->region);
  CW_TRY(cw_region_items_text(file, path, "domain", name, sizeof name));
  CW_REQUIRE(strcmp(name, domain->name) == 0, CW_ERR_INPUT, "%s: attribute 'domain' is '%s'; it must be '%s'", path,
             name, domain->name);
  CW_REQUIRE(!strcmp(digest, line->digest), CW_ERR_INPUT,
             "%s: is not the file that the manifest tells of; run cutwater-mesh again", path);
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
  CW_TRY(cw_region_items_read(file, path, part, r));
  CW_TRY(cw_region_items_check(path, part, domain->patch_count, domain->shared_points, r));
  CW_TRY(cw_region_items_number(file, path, "unit_m", &unit));
  cw_region_items_scale(r, unit);
done:
  if (file >= 0) H5Fclose(file);
  return status;
}
