// SPDX-License-Identifier: AGPL-3.0-or-later
// The manifest of a mesh: its domains, patches and regions (docs/file-formats.md).
#pragma once

#include <stdint.h>

#include "pipeline/hash.h"
#include "pipeline/model.h"
#include "pipeline/status.h"

enum { CW_MANIFEST_FORMAT = 3, CW_MESH_NAME_SIZE = CW_NAME_SIZE };

// One line of the manifest: a region file and the digest and the counts it must have.
typedef struct {
  char *path; // of the region file
  int domain;
  int region; // 1-based in its domain
  int number; // its region number
  char digest[CW_HASH_TEXT];
  int64_t points, own_points, tetrahedra, pyramids, prisms, triangles, quads;
} CwMeshRegion;

typedef struct {
  char name[CW_MESH_NAME_SIZE], zone[CW_MESH_NAME_SIZE]; // zone: the name in capitals, for CGNS and CFX
  int rotating; // solved in the frame of the impeller
  int64_t shared_points;
  double solid_volume;            // m3
  int first_patch, patch_count;   // into CwMesh.patches
  int first_region, region_count; // into CwMesh.regions
} CwMeshDomain;

// The model as it was meshed: patches and regions of all domains in one list each.
typedef struct {
  int domain_count, interface_count;
  CwMeshDomain domains[CW_DOMAINS_MOST];
  CwModelInterface *interfaces;
  int patch_count, region_count;
  CwModelPatch *patches;
  CwMeshRegion *regions;
  CwModelFlow flow;
} CwMesh;

static inline int64_t cw_mesh_region_cells(const CwMeshRegion *region) {
  return region->tetrahedra + region->pyramids + region->prisms;
}

// Reads RUN/mesh/manifest.json. CW_ERR_IO or CW_ERR_INPUT with file and place. Zeroed `mesh` on entry.
CwStatus cw_mesh_manifest_read(const char *run, CwMesh *mesh);
void cw_mesh_free(CwMesh *mesh);

// The patch called `name`, or -1.
int cw_mesh_patch_find(const CwMesh *mesh, const char *name);
