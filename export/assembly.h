// SPDX-License-Identifier: AGPL-3.0-or-later
// The mesh as a whole without holding it: a first look at the region files finds the numbers every region starts at,
// the shared points, and which cells meet across partition planes. Regions are then checked and written one at a time,
// in any order and from any rank (region_check.h).
#pragma once

#include "export/face_quality.h"
#include "export/region_share.h"
#include "pipeline/parallel/ranks.h"
#include "pipeline/mesh/region_faces.h"
#include "pipeline/mesh/region_read.h"

typedef struct {
  int64_t triangles, quads;
} CwFaceCount;

static inline int64_t cw_face_count(CwFaceCount count) {
  return count.triangles + count.quads;
}

static inline int64_t cw_corner_count(CwFaceCount count) {
  return 3 * count.triangles + 4 * count.quads;
}

static inline void cw_face_count_add(CwFaceCount *sum, CwFaceCount more) {
  sum->triangles += more.triangles;
  sum->quads += more.quads;
}

// Where a region begins in the numbering of its domain, all 0-based, and what it adds.
typedef struct {
  int64_t own_point;                   // its first own point
  int64_t tetrahedron, pyramid, prism; // its first cell of each type among those of the domain
  int64_t cell;                        // its first cell, cells counted region by region over all domains
  int64_t first_open, open_count;      // its open faces in CwAssembly.across
  CwFaceCount inner;                   // faces between its own cells
  CwFaceCount outer;                   // open faces whose other cell has the larger number
} CwRegionPlace;

// Counts and sums of the faces of one patch in one region.
typedef struct {
  CwFaceCount faces, before; // before: those of the regions before
  double area, vector[3];    // m2
} CwPatchPart;

// A face of an interface: nodes in m, 3 or 4, and its place in its patch, triangles first.
typedef struct {
  int64_t place;
  int32_t count;
  double nodes[4][3];
} CwInterfaceFace;

typedef struct {
  int64_t first_point; // points of the domains before
  int64_t points, tetrahedra, pyramids, prisms, cells;
  // Known when all regions have been checked; `faces` holds the faces on partition planes before.
  double volume, least_volume; // m3
  CwFaceQuality faces;
} CwDomainTotal;

typedef struct {
  const CwMesh *mesh;
  CwRegionShare share;
  CwDomainTotal totals[CW_DOMAINS_MOST];
  CwRegionPlace *places; // by region
  CwPatchPart *parts;    // by region, then patch
  CwPatchPart *patches;  // by patch: the sums over the regions
  double (*shared[CW_DOMAINS_MOST])[3];
  int64_t *across;  // by open face: number of the cell on its other side, as CwRegionPlace.cell counts
  int64_t *partner; // by open face: the same face as an open one of the region on its other side
  int64_t open_count;
  CwInterfaceFace *interface[CW_INTERFACES_MOST][2]; // by interface and side; on rank 0 only, by place
} CwAssembly;

// Reads every region once. Beyond the checks of the readers it fails with CW_ERR_INPUT where a shared point differs
// between regions, a face on a partition plane has no partner, the surface of a domain is not closed, or a patch that
// is no wall is empty. Collective.
CwStatus cw_assembly_make(const CwMesh *mesh, const CwRanks *ranks, CwAssembly *assembly);
void cw_assembly_free(CwAssembly *assembly);

// What is done with a region of this rank. `data` may be taken over, zeros left in its place.
typedef CwStatus (*CwRegionWork)(void *context, int region, CwRegionData *data);

// One pass goes forwards and the last one, that writes, backwards, after which the report goes forwards: of a mesh that
// is larger than the memory, the system still has what was read last.
typedef enum { CW_FORWARDS, CW_BACKWARDS } CwDirection;

// Reads each of this rank's regions whole, and the next one ahead, and gives it to `work`, those that are alike one
// after another; tells `title` as progress. Returns the first failure of this rank, after which it goes no further.
CwStatus cw_each_region(const CwAssembly *assembly, const CwRanks *ranks, const char *title, CwDirection direction,
                        CwRegionWork work, void *context);

// The faces of a patch in a region.
static inline CwPatchPart *cw_patch_part(const CwAssembly *assembly, int region, int patch) {
  return &assembly->parts[(size_t)region * (size_t)assembly->mesh->patch_count + (size_t)patch];
}

static inline int64_t cw_assembly_cells(const CwAssembly *assembly) {
  int64_t cells = 0;
  for (int d = 0; d < assembly->mesh->domain_count; ++d) cells += assembly->totals[d].cells;
  return cells;
}

// Number of a point of a region in its domain, 0-based.
static inline int64_t cw_point_number(const CwAssembly *assembly, int region, const CwRegionData *data, int32_t point) {
  if (point < data->shared_count) return data->shared_id[point];
  return assembly->places[region].own_point + point - data->shared_count;
}
