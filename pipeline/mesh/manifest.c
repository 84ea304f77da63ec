// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/mesh/manifest.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/json_read.h"

void cw_mesh_free(CwMesh *mesh) {
  for (int i = 0; mesh->regions && i < mesh->region_count; ++i) free(mesh->regions[i].path);
  free(mesh->regions);
  free(mesh->patches);
  free(mesh->interfaces);
  memset(mesh, 0, sizeof *mesh);
}

int cw_mesh_patch_find(const CwMesh *mesh, const char *name) {
  for (int i = 0; i < mesh->patch_count; ++i)
    if (strcmp(mesh->patches[i].name, name) == 0) return i;
  return -1;
}

// Reads a count. `where` says which object of the manifest it stands in.
static CwStatus read_count(const json_t *object, const char *key, int64_t most, const char *file, const char *where,
                           int64_t *value) {
  CwStatus status = CW_OK;
  const json_t *item = json_object_get(object, key);
  CW_REQUIRE(json_is_integer(item), CW_ERR_INPUT, "%s: %s: '%s' must be a whole number", file, where, key);
  *value = json_integer_value(item);
  CW_REQUIRE(*value >= 0 && *value <= most, CW_ERR_INPUT, "%s: %s: '%s' is %lld; allowed 0 to %lld", file, where, key,
             (long long)*value, (long long)most);
done:
  return status;
}

static CwStatus read_region_line(CwMesh *mesh, int domain, const json_t *item, const char *run, const char *file) {
  CwStatus status = CW_OK;
  CwMeshDomain *d = &mesh->domains[domain];
  CwMeshRegion *region = &mesh->regions[mesh->region_count];
  const char *name = json_string_value(json_object_get(item, "file"));
  const char *digest = json_string_value(json_object_get(item, "digest"));
  char where[80];
  int64_t index = 0, number = 0;
  snprintf(where, sizeof where, "domain %s, region %d", d->name, d->region_count + 1);
  CW_REQUIRE(name && name[0] && !strchr(name, '/'), CW_ERR_INPUT, "%s: %s: 'file' must be a file name", file, where);
  CW_TRY(read_count(item, "region", INT32_MAX, file, where, &index));
  CW_REQUIRE(index == d->region_count + 1, CW_ERR_INPUT,
             "%s: %s: 'region' is %lld; regions must stand in order 1, 2, 3, ...", file, where, (long long)index);
  region->domain = domain;
  region->region = (int)index;
  CW_REQUIRE(digest && strlen(digest) < sizeof region->digest, CW_ERR_INPUT, "%s: %s: 'digest' must have %d digits",
             file, where, CW_HASH_TEXT - 1);
  strcpy(region->digest, digest);
  CW_TRY(read_count(item, "number", INT32_MAX, file, where, &number));
  region->number = (int)number;
  CW_TRY(read_count(item, "points", INT32_MAX, file, where, &region->points));
  CW_TRY(read_count(item, "own_points", region->points, file, where, &region->own_points));
  // A cell has at most five faces, and a face of a region is numbered with 31 bits.
  CW_TRY(read_count(item, "tetrahedra", INT32_MAX / 16, file, where, &region->tetrahedra));
  CW_TRY(read_count(item, "pyramids", INT32_MAX / 16, file, where, &region->pyramids));
  CW_TRY(read_count(item, "prisms", INT32_MAX / 16, file, where, &region->prisms));
  CW_TRY(read_count(item, "triangles", INT32_MAX / 16, file, where, &region->triangles));
  CW_TRY(read_count(item, "quads", INT32_MAX / 16, file, where, &region->quads));
  CW_REQUIRE(region->points - region->own_points <= d->shared_points, CW_ERR_INPUT,
             "%s: %s: %lld points less %lld own ones leave more than the %lld 'shared_points' of the domain", file,
             where, (long long)region->points, (long long)region->own_points, (long long)d->shared_points);
  CW_REQUIRE(asprintf(&region->path, "%s/mesh/%s", run, name) >= 0, CW_ERR_MEMORY, "out of memory: a path of %s/mesh",
             run);
  ++mesh->region_count;
  ++d->region_count;
done:
  return status;
}

static CwStatus read_domain(CwMesh *mesh, int domain, const json_t *item, const char *run, const char *file) {
  CwStatus status = CW_OK;
  CwMeshDomain *d = &mesh->domains[domain];
  const json_t *volume = json_object_get(item, "solid_volume_m3");
  const json_t *regions = json_object_get(item, "regions");
  const json_t *line;
  size_t i;
  CW_REQUIRE(json_is_number(volume) && json_number_value(volume) > 0, CW_ERR_INPUT,
             "%s: domain %s: 'solid_volume_m3' must be a number above 0", file, d->name);
  d->solid_volume = json_number_value(volume);
  CW_TRY(read_count(item, "shared_points", INT32_MAX / 3, file, d->name, &d->shared_points));
  CW_REQUIRE(d->patch_count > 0 && json_array_size(regions) > 0, CW_ERR_INPUT,
             "%s: domain %s: 'patches' and 'regions' must be lists with at least one entry", file, d->name);
  d->first_region = mesh->region_count;
  json_array_foreach(regions, i, line) {
    CW_TRY(read_region_line(mesh, domain, line, run, file));
  }
done:
  return status;
}

// Takes over domains, patches and interfaces.
static void take_model(CwModel *model, CwMesh *mesh) {
  mesh->domain_count = model->domain_count;
  mesh->patch_count = model->patch_count;
  mesh->interface_count = model->interface_count;
  mesh->patches = model->patch;
  mesh->interfaces = model->interface;
  mesh->flow = model->flow;
  model->patch = NULL;
  model->interface = NULL;
  for (int d = 0; d < mesh->domain_count; ++d) {
    const CwModelDomain *of = &model->domain[d];
    CwMeshDomain *made = &mesh->domains[d];
    made->rotating = of->rotating;
    made->first_patch = of->first_patch;
    made->patch_count = of->patch_count;
    strcpy(made->name, of->name);
    cw_domain_zone_name(of->name, made->zone);
  }
}

CwStatus cw_mesh_manifest_read(const char *run, CwMesh *mesh) {
  CwStatus status = CW_OK;
  char *file = NULL;
  json_t *root = NULL;
  CwModel model = {0};
  size_t regions = 0;
  CW_REQUIRE(asprintf(&file, "%s/mesh/manifest.json", run) >= 0, CW_ERR_MEMORY, "out of memory: a path of %s/mesh",
             run);
  CW_TRY(cw_json_read(file, &root));
  CW_REQUIRE(json_integer_value(json_object_get(root, "format")) == CW_MANIFEST_FORMAT, CW_ERR_INPUT,
             "%s: 'format' must be %d: the mesh was written by another version", file, CW_MANIFEST_FORMAT);
  CW_TRY(cw_model_unpack(root, file, &model));
  take_model(&model, mesh);
  const json_t *domains = json_object_get(root, "domains");
  for (int d = 0; d < mesh->domain_count; ++d)
    regions += json_array_size(json_object_get(json_array_get(domains, (size_t)d), "regions"));
  CW_NEW(mesh->regions, regions);
  for (int d = 0; d < mesh->domain_count; ++d)
    CW_TRY(read_domain(mesh, d, json_array_get(domains, (size_t)d), run, file));
done:
  cw_model_free(&model);
  json_decref(root);
  free(file);
  return status;
}
