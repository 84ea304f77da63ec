// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/mesh/manifest.h"

#include <ctype.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/json_read.h"
#include "pipeline/mesh/region_items.h"

static const char *const first_domains[] = {"rotor", "stator"};

// The longest patch name: "_triangles" is added to it, and CGNS names have at most 32 characters.
enum { LONGEST_PATCH_NAME = 22, LONGEST_DOMAIN_NAME = 14 }; // "_to_" stands between two domains

void cw_mesh_free(CwMesh *mesh) {
  for (int i = 0; mesh->regions && i < mesh->region_count; ++i) free(mesh->regions[i].path);
  free(mesh->regions);
  free(mesh->patches);
  memset(mesh, 0, sizeof *mesh);
}

int cw_mesh_patch_find(const CwMesh *mesh, const char *name) {
  for (int i = 0; i < mesh->patch_count; ++i)
    if (strcmp(mesh->patches[i].name, name) == 0) return i;
  return -1;
}

int cw_mesh_end(const CwMesh *mesh, CwPatchKind kind) {
  for (int i = 0; i < mesh->patch_count; ++i)
    if (mesh->patches[i].kind == kind) return i;
  return -1;
}

int cw_mesh_interface_of(const CwMesh *mesh, int patch, int *side) {
  for (int i = 0; i < mesh->interface_count; ++i)
    for (*side = 0; *side < 2; ++*side)
      if (mesh->interfaces[i].patch[*side] == patch) return i;
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

static CwStatus read_patch(CwMesh *mesh, int domain, const json_t *item, const char *file) {
  CwStatus status = CW_OK;
  const char *name = json_string_value(json_object_get(item, "name"));
  const char *kind = json_string_value(json_object_get(item, "kind"));
  CwMeshPatch *patch = &mesh->patches[mesh->patch_count];
  CW_REQUIRE(name && kind, CW_ERR_INPUT, "%s: domain %s: patch %d needs 'name' and 'kind'", file,
             mesh->domains[domain].name, mesh->patch_count - mesh->domains[domain].first_patch + 1);
  CW_REQUIRE(name[0] && strlen(name) <= LONGEST_PATCH_NAME &&
                 strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == strlen(name),
             CW_ERR_INPUT, "%s: domain %s: patch name '%s'; allowed are 1 to %d letters, digits and _", file,
             mesh->domains[domain].name, name, LONGEST_PATCH_NAME);
  CW_REQUIRE(cw_mesh_patch_find(mesh, name) < 0, CW_ERR_INPUT, "%s: patch '%s' is named twice", file, name);
  static const char *const kinds[] = {"wall", "inlet", "outlet", "interface"};
  int k = 0;
  while (k < 4 && strcmp(kinds[k], kind) != 0) ++k;
  CW_REQUIRE(k < 4, CW_ERR_INPUT, "%s: patch '%s': kind '%s'; allowed are wall, inlet, outlet, interface", file, name,
             kind);
  snprintf(patch->name, sizeof patch->name, "%s", name);
  patch->kind = (CwPatchKind)k;
  patch->y_plus = cw_json_real(item, "y_plus");
  patch->domain = domain;
  ++mesh->patch_count;
  ++mesh->domains[domain].patch_count;
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
  CW_REQUIRE(asprintf(&region->path, "%s/mesh/%s", run, name) >= 0, CW_ERR_MEMORY, "out of memory");
  ++mesh->region_count;
  ++d->region_count;
done:
  return status;
}

static CwStatus read_domain(CwMesh *mesh, int domain, const json_t *item, const char *run, const char *file) {
  CwStatus status = CW_OK;
  CwMeshDomain *d = &mesh->domains[domain];
  const char *name = json_string_value(json_object_get(item, "name"));
  const json_t *volume = json_object_get(item, "solid_volume_m3");
  const json_t *patches = json_object_get(item, "patches");
  const json_t *regions = json_object_get(item, "regions");
  const json_t *line;
  size_t i;
  CW_REQUIRE(name && (domain > CW_MESH_STATOR || strcmp(name, first_domains[domain]) == 0), CW_ERR_INPUT,
             "%s: domain %d must be '%s', not '%s'", file, domain + 1,
             domain > CW_MESH_STATOR ? "named" : first_domains[domain], name ? name : "");
  CW_REQUIRE(name[0] && strlen(name) <= LONGEST_DOMAIN_NAME &&
                 strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789_") == strlen(name),
             CW_ERR_INPUT, "%s: domain %d is named '%s'; allowed are 1 to %d small letters, digits and _", file,
             domain + 1, name, LONGEST_DOMAIN_NAME);
  for (int other = 0; other < domain; ++other)
    CW_REQUIRE(strcmp(name, mesh->domains[other].name) != 0, CW_ERR_INPUT, "%s: domain '%s' is named twice", file,
               name);
  for (size_t k = 0; k <= strlen(name); ++k) {
    d->name[k] = name[k];
    d->zone[k] = (char)toupper((unsigned char)name[k]);
  }
  CW_REQUIRE(json_is_number(volume) && json_number_value(volume) > 0, CW_ERR_INPUT,
             "%s: domain %s: 'solid_volume_m3' must be a number above 0", file, name);
  d->solid_volume = json_number_value(volume);
  CW_TRY(read_count(item, "shared_points", INT32_MAX / 3, file, name, &d->shared_points));
  CW_REQUIRE(json_array_size(patches) > 0 && json_array_size(regions) > 0, CW_ERR_INPUT,
             "%s: domain %s: 'patches' and 'regions' must be lists with at least one entry", file, name);
  CW_REQUIRE(json_array_size(patches) <= CW_PATCHES_MOST, CW_ERR_INPUT, "%s: domain %s: %zu patches; allowed 1 to %d",
             file, name, json_array_size(patches), CW_PATCHES_MOST);
  d->first_patch = mesh->patch_count;
  json_array_foreach(patches, i, line) {
    CW_TRY(read_patch(mesh, domain, line, file));
  }
  d->first_region = mesh->region_count;
  json_array_foreach(regions, i, line) {
    CW_TRY(read_region_line(mesh, domain, line, run, file));
  }
done:
  return status;
}

static CwStatus check_ends(const CwMesh *mesh, const char *file) {
  CwStatus status = CW_OK;
  static const CwPatchKind ends[] = {CW_KIND_INLET, CW_KIND_OUTLET};
  for (int e = 0; e < 2; ++e) {
    int count = 0;
    for (int p = 0; p < mesh->patch_count; ++p) count += mesh->patches[p].kind == ends[e];
    CW_REQUIRE(count == 1, CW_ERR_INPUT, "%s: %d patches of kind %s; there must be one", file, count,
               e ? "outlet" : "inlet");
  }
done:
  return status;
}

// Each patch of kind interface must be one side of one interface.
static CwStatus read_interfaces(CwMesh *mesh, const json_t *list, const char *file) {
  CwStatus status = CW_OK;
  const json_t *pair;
  size_t i;
  CW_REQUIRE(json_array_size(list) > 0 && json_array_size(list) <= CW_DOMAINS_MOST, CW_ERR_INPUT,
             "%s: 'interfaces' must list 1 to %d pairs of patches", file, CW_DOMAINS_MOST);
  json_array_foreach(list, i, pair) {
    CwMeshInterface found = {{-1, -1}};
    for (int s = 0; s < 2; ++s) {
      const char *name = json_string_value(json_array_get(pair, (size_t)s));
      int other_side;
      found.patch[s] = name ? cw_mesh_patch_find(mesh, name) : -1;
      CW_REQUIRE(found.patch[s] >= 0 && mesh->patches[found.patch[s]].kind == CW_KIND_INTERFACE, CW_ERR_INPUT,
                 "%s: interface %zu: '%s' is no patch of kind interface", file, i + 1, name ? name : "");
      CW_REQUIRE(cw_mesh_interface_of(mesh, found.patch[s], &other_side) < 0, CW_ERR_INPUT,
                 "%s: interface %zu: patch '%s' is a side of another one", file, i + 1, name);
    }
    int domain[2] = {mesh->patches[found.patch[0]].domain, mesh->patches[found.patch[1]].domain};
    CW_REQUIRE(domain[0] != domain[1], CW_ERR_INPUT, "%s: interface %zu has both sides in domain %s", file, i + 1,
               mesh->domains[domain[0]].name);
    CW_REQUIRE(i > 0 || (domain[0] == CW_MESH_ROTOR && domain[1] == CW_MESH_STATOR), CW_ERR_INPUT,
               "%s: interface 1 must be between rotor and stator", file);
    mesh->interfaces[mesh->interface_count++] = found;
  }
  for (int p = 0; p < mesh->patch_count; ++p) {
    int side;
    CW_REQUIRE(mesh->patches[p].kind != CW_KIND_INTERFACE || cw_mesh_interface_of(mesh, p, &side) >= 0, CW_ERR_INPUT,
               "%s: patch '%s' of kind interface has no other side in 'interfaces'", file, mesh->patches[p].name);
  }
done:
  return status;
}

CwStatus cw_mesh_manifest_read(const char *run, CwMesh *mesh) {
  CwStatus status = CW_OK;
  char *file = NULL;
  json_t *root = NULL;
  CW_REQUIRE(asprintf(&file, "%s/mesh/manifest.json", run) >= 0, CW_ERR_MEMORY, "out of memory");
  CW_TRY(cw_json_read(file, &root));
  CW_REQUIRE(json_integer_value(json_object_get(root, "format")) == CW_REGION_FORMAT, CW_ERR_INPUT,
             "%s: 'format' must be %d: the mesh was written by another version", file, CW_REGION_FORMAT);
  const json_t *domains = json_object_get(root, "domains");
  CW_REQUIRE(json_array_size(domains) >= 2 && json_array_size(domains) <= CW_DOMAINS_MOST, CW_ERR_INPUT,
             "%s: 'domains' must list rotor, stator and at most %d more", file, CW_DOMAINS_MOST - 2);
  mesh->domain_count = (int)json_array_size(domains);
  size_t patches = 0, regions = 0;
  for (int d = 0; d < mesh->domain_count; ++d) {
    patches += json_array_size(json_object_get(json_array_get(domains, d), "patches"));
    regions += json_array_size(json_object_get(json_array_get(domains, d), "regions"));
  }
  CW_NEW(mesh->patches, patches);
  CW_NEW(mesh->regions, regions);
  for (int d = 0; d < mesh->domain_count; ++d)
    CW_TRY(read_domain(mesh, d, json_array_get(domains, (size_t)d), run, file));
  CW_TRY(check_ends(mesh, file));
  CW_TRY(read_interfaces(mesh, json_object_get(root, "interfaces"), file));
done:
  json_decref(root);
  free(file);
  return status;
}
