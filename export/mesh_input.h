// SPDX-License-Identifier: AGPL-3.0-or-later
// What the exporter reads of a mesh: the manifest and one region file at a time (docs/file-formats.md).
#ifndef CUTWATER_EXPORT_MESH_INPUT_H
#define CUTWATER_EXPORT_MESH_INPUT_H

#include <stdint.h>

#include "pipeline/status.h"

enum { CW_EXPORT_NAME_SIZE = 33, CW_EXPORT_ROTOR = 0, CW_EXPORT_STATOR = 1, CW_EXPORT_DOMAINS_MOST = 8 };

typedef enum { CW_KIND_WALL, CW_KIND_INLET, CW_KIND_OUTLET, CW_KIND_INTERFACE } CwPatchKind;

typedef struct {
  char name[CW_EXPORT_NAME_SIZE];
  CwPatchKind kind;
  int domain;
} CwMeshPatch;

// One line of the manifest: a region file and the counts it must have.
typedef struct {
  char *path; // of the region file
  int domain; // CW_EXPORT_ROTOR, CW_EXPORT_STATOR or one of the others
  int region; // 1-based in its domain
  int64_t points, own_points, tetrahedra, pyramids, prisms, triangles, quads;
} CwMeshRegion;

typedef struct {
  char name[CW_EXPORT_NAME_SIZE], zone[CW_EXPORT_NAME_SIZE]; // zone: the name in capitals, for CGNS and CFX
  int64_t shared_points;
  double solid_volume;            // m3
  int first_patch, patch_count;   // into CwMesh.patches
  int first_region, region_count; // into CwMesh.regions
} CwMeshDomain;

// One surface that two domains have in common: a patch of either.
typedef struct {
  int patch[2];
} CwMeshInterface;

// The manifest: rotor first, stator second, then the others; patches and regions of all in one list each. The
// first interface is the one between rotor and stator.
typedef struct {
  char case_name[CW_EXPORT_NAME_SIZE];
  int domain_count, interface_count;
  CwMeshDomain domains[CW_EXPORT_DOMAINS_MOST];
  CwMeshInterface interfaces[CW_EXPORT_DOMAINS_MOST];
  int patch_count, region_count;
  CwMeshPatch *patches;
  CwMeshRegion *regions;
} CwMesh;

// Reads RUN/mesh/manifest.json. CW_ERR_IO or CW_ERR_INPUT with file and place. Zeroed `mesh` on entry.
CwStatus cw_mesh_manifest_read(const char *run, CwMesh *mesh);
void cw_mesh_free(CwMesh *mesh);

// The patch called `name`, or -1.
int cw_mesh_patch_find(const CwMesh *mesh, const char *name);

// The inlet or the outlet of the pump.
int cw_mesh_end(const CwMesh *mesh, CwPatchKind kind);

// The interface that `patch` is a side of and which side it is, or -1.
int cw_mesh_interface_of(const CwMesh *mesh, int patch, int *side);

// A region in memory, as its file has it; see docs/file-formats.md for shapes and orders.
typedef struct {
  int domain, region;
  int32_t point_count, shared_count;
  int32_t tetrahedron_count, pyramid_count, prism_count, triangle_count, quad_count;
  double (*points)[3];
  int64_t *shared_id;
  int32_t (*tetrahedra)[4], (*pyramids)[5], (*prisms)[6];
  int32_t (*triangles)[3], *triangle_patch, *triangle_cell;
  int32_t (*quads)[4], *quad_patch, *quad_cell;
} CwRegionData;

// Reads one region file and checks it against its line of the manifest: counts, and that every index is in
// range and every coordinate finite. CW_ERR_IO or CW_ERR_INPUT. Zeroed `data` on entry.
CwStatus cw_region_read(const CwMesh *mesh, int region, CwRegionData *data);
void cw_region_free(CwRegionData *data);

static inline int32_t cw_region_cell_count(const CwRegionData *data) {
  return data->tetrahedron_count + data->pyramid_count + data->prism_count;
}

#endif
