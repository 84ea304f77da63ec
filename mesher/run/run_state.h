// SPDX-License-Identifier: AGPL-3.0-or-later
// What the stages of the mesher hand on: the domains, the factors that predict cells, and what was made of each region.
#pragma once

#include <jansson.h>

#include "mesher/parallel/context.h"
#include "mesher/parallel/host_memory.h"
#include "mesher/region/audit.h"
#include "mesher/region/layer_ratio.h"
#include "mesher/region/region_failure.h"
#include "mesher/run/cell_law.h"
#include "mesher/run/domain.h"
#include "mesher/run/finer_places.h"
#include "mesher/run/layer_coverage.h"
#include "pipeline/model.h"
#include "pipeline/record.h"

// Checks a product as it is made, in builds with sanitizers.
#ifdef CUTWATER_AUDIT
#define CW_AUDIT(call) CW_TRY(call)
#else
#define CW_AUDIT(call) ((void)0)
#endif

// What is known of a finished region; travels between ranks as bytes, so that all fields lie in one block.
typedef struct {
  int32_t points, own_points, tetrahedra, pyramids, prisms, triangles, quads;
  double patch_area[CW_PATCHES_MOST];  // m2, of the region's boundary faces
  CwLayerRatio ratio[CW_PATCHES_MOST]; // wall faces by last layer over first tetrahedron
  CwLayerCoverage coverage[CW_PATCHES_MOST];
  CwFillRecovery recovery;
  char digest[CW_HASH_TEXT]; // of its file
  char damage[256];          // of the file that was there before, which is made again; "": none
  CwQuality quality;
  double dihedral_allowed; // degrees: no filling of the region's boundary has a least angle above, see cw_tet_bound
  CwRegionFailure failure; // else nothing of the above holds
} CwRegionSummary;

// The stages whose product can be looked at.
typedef enum {
  CW_STAGE_NONE,
  CW_STAGE_SIZE,
  CW_STAGE_DECOMPOSITION,
  CW_STAGE_CURVES,
  CW_STAGE_SURFACE,
  CW_STAGE_LAYERS,
  CW_STAGE_INTERFACES,
  CW_STAGE_COUNT
} CwStage;

// The fields are what a run is asked, its domains, and what its passes have learnt.
typedef struct {
  CwContext context;
  const CwCase *table;
  const char *run_path;
  int rank;
  CwRecord *record;
  CwStage stop_after; // CW_STAGE_NONE: the run goes to its end
  int vtk;            // 1: what the stage made is written
  int stopped;
  json_t *headlines; // what the report begins with
  CwModel model;
  CwDomain domain[CW_DOMAINS_MOST]; // as many as the model has
  CwRegionSummary *summary[CW_DOMAINS_MOST];
  double *region_seconds[CW_DOMAINS_MOST];
  void **seeds[CW_DOMAINS_MOST];           // of the size field, by part, while it is made
  CwHostMemory *sizes[2];                  // where the size fields lie on each host: as first made, and made again
  double y_plus_auto;                      // where the case leaves it open
  CwCellLaw prisms, tets;                  // prisms of a layer, tetrahedra: as the passes learn them
  double scale;                            // of the size field
  double surface_scale;                    // with which the walls were meshed
  double gradation;                        // of the size field at scale 1
  double wall_scale;                       // at which walls limit its edges; 0: they do not
  CwFinerPlaces finer;                     // where the fields are to be finer than the case asks
  double *most_thickness[CW_DOMAINS_MOST]; // of each wall vertex, m, once layers were thinned; else NULL
  // With which the domains were planned.
  CwCellLaw planned_prisms, planned_tets;
  double planned_scale;
  int planned_layers[CW_DOMAINS_MOST];
  // Of each domain, as the headlines behind the first `headlines_before` tell: layers, and the places where these
  // taper, one more than there are.
  int layers_told[CW_DOMAINS_MOST], pinched_told[CW_DOMAINS_MOST];
  size_t headlines_before;
  int copies_told;     // 1: a warning says that each rank holds copies of what a host may share
  int passes, retries; // retries: of all passes
  int64_t cells;       // made
} CwMeshRun;
