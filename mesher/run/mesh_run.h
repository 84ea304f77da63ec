// SPDX-License-Identifier: AGPL-3.0-or-later
// The whole work of the mesher on a case: all domains, in step, over all ranks.
#ifndef CUTWATER_MESHER_RUN_MESH_RUN_H
#define CUTWATER_MESHER_RUN_MESH_RUN_H

#include <jansson.h>

#include "mesher/region/audit.h"
#include "mesher/region/layer_ratio.h"
#include "mesher/region/region_failure.h"
#include "mesher/run/domain.h"
#include "mesher/run/domain_table.h"
#include "pipeline/record.h"

enum { CW_PATCH_LIMIT = 32 };

// What is known of a finished region; travels between ranks as bytes.
typedef struct {
  int32_t points, own_points, tetrahedra, pyramids, prisms, triangles, quads;
  double patch_area[CW_PATCH_LIMIT];  // m2, of the region's boundary faces
  CwLayerRatio ratio[CW_PATCH_LIMIT]; // wall faces by last layer over first tetrahedron
  CwLayerCoverage coverage[CW_PATCH_LIMIT];
  CwFillRecovery recovery;
  CwQuality quality;
  double dihedral_allowed; // degrees: no filling of the region's boundary has a least angle above, see cw_tet_bound
  CwRegionFailure failure; // else nothing of the above holds
} CwRegionSummary;

typedef struct {
  const CwCase *table;
  const char *run_path;
  int rank, ranks;
  CwRecord *record;
  CwDomainTable domains;
  CwDomain domain[CW_DOMAINS_MOST]; // domains.count of them
  CwRegionSummary *summary[CW_DOMAINS_MOST];
  double *region_seconds[CW_DOMAINS_MOST];
  void **seeds[CW_DOMAINS_MOST];        // of the size field, by part, while it is made
  double prism_factor, tet_factor;      // cells per unit of the integrals
  double scale;                         // of the size field
  double gradation;                     // of the size field at scale 1
  double wall_scale;                    // at which walls limit its edges; 0: they do not
  double *most_height[CW_DOMAINS_MOST]; // of each wall vertex, m, once a region has failed; else NULL
  // With which the domains were planned.
  double planned_prism_factor, planned_tet_factor, planned_scale;
  int whole;           // 1: a symmetry was given up
  int passes, retries; // retries: of all passes
  int64_t cells;       // made
} CwMeshRun;

// Meshes the case: reads RUN/geometry, writes the region files and the manifest into RUN/mesh. Collective over all
// ranks.
CwStatus cw_mesh_run(CwMeshRun *run);
void cw_mesh_run_free(CwMeshRun *run);

// Cells of one domain as its integrals and the factors predict them at the present scale.
double cw_predicted_cells(const CwMeshRun *run, int domain);

// Sets the scale of the size fields of all domains; or that with which the predicted count is the asked one.
void cw_mesh_set_scale(CwMeshRun *run, double scale);
void cw_mesh_solve_scale(CwMeshRun *run);

// A task of one domain.
typedef struct {
  int32_t domain, index;
  double cost;
} CwMeshTask;

// The steps that run as tasks; each a CwTask body over run->domain[task.domain].
typedef CwStatus (*CwMeshStep)(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size);
CwStatus cw_step_background(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size);
CwStatus cw_step_seed(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size);
CwStatus cw_step_size(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size);
CwStatus cw_step_wall(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size);
// A cap, or after all faces an interface polygon.
CwStatus cw_step_inner(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size);
CwStatus cw_step_rule(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size);
CwStatus cw_step_region(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size);

// How many regions a region stands for: itself and its turned copies.
int32_t cw_region_copies(const CwSkeleton *skeleton, int32_t region);

// Writes RUN/mesh/manifest.json and adds the results to the record. Rank 0 only.
CwStatus cw_mesh_manifest(CwMeshRun *run);

#endif
