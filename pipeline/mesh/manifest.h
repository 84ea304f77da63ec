// SPDX-License-Identifier: AGPL-3.0-or-later
// The manifest of a mesh: its domains, patches and regions (docs/file-formats.md).
#ifndef CUTWATER_PIPELINE_MESH_MANIFEST_H
#define CUTWATER_PIPELINE_MESH_MANIFEST_H

#include <stdint.h>

#include "pipeline/hash.h"
#include "pipeline/status.h"

enum { CW_MESH_NAME_SIZE = 33, CW_MESH_ROTOR = 0, CW_MESH_STATOR = 1, CW_DOMAINS_MOST = 8, CW_PATCHES_MOST = 64 };

typedef enum { CW_KIND_WALL, CW_KIND_INLET, CW_KIND_OUTLET, CW_KIND_INTERFACE } CwPatchKind;

typedef struct {
  char name[CW_MESH_NAME_SIZE];
  CwPatchKind kind;
  int domain;
  double y_plus; // of a wall, that its layers were made for; NAN: the flow along it is laminar
} CwMeshPatch;

// One line of the manifest: a region file and the digest and the counts it must have.
typedef struct {
  char *path; // of the region file
  int domain; // CW_MESH_ROTOR, CW_MESH_STATOR or one of the others
  int region; // 1-based in its domain
  int number; // its region number
  char digest[CW_HASH_TEXT];
  int64_t points, own_points, tetrahedra, pyramids, prisms, triangles, quads;
} CwMeshRegion;

typedef struct {
  char name[CW_MESH_NAME_SIZE], zone[CW_MESH_NAME_SIZE]; // zone: the name in capitals, for CGNS and CFX
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
  int domain_count, interface_count;
  CwMeshDomain domains[CW_DOMAINS_MOST];
  CwMeshInterface interfaces[CW_DOMAINS_MOST];
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

#endif
