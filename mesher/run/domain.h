// SPDX-License-Identifier: AGPL-3.0-or-later
// One domain on its way from exact geometry to regions: everything a rank holds of it.
#pragma once

#include "mesher/cad/background.h"
#include "mesher/cad/face_radius.h"
#include "mesher/cad/sharp_edge.h"
#include "mesher/cad/symmetry.h"
#include "mesher/layers/pinched.h"
#include "mesher/parallel/context.h"
#include "mesher/region/interface_rule.h"
#include "mesher/region/region_build.h"
#include "mesher/size/size.h"
#include "mesher/thickness/column_targets.h"
#include "mesher/thickness/wall_targets.h"
#include "pipeline/log.h"

// Before the walls are known; 0.95 to 1 in the domains of the paper's pump.
#define CW_LAYER_SHARE 0.98

// The layers over a piece of wall on which h hardly changes.
typedef struct {
  double density; // area / h^3 for h over the scale, m-1
  double size;    // h over the scale, m
  int32_t patch;
} CwLayerSample;

// The fields are what the case asks of the domain, what the passes have settled, and its products, in the order in
// which stages make them.
typedef struct {
  const char *name;
  const CwModelPatch *patch; // of the model
  CwCad *cad;
  struct CwTessellation *tessellation; // while the background is made
  CwBackground background;
  double solid_volume; // m3, exact
  CwVerticals *inside;
  CwPinched pinched;    // where columns have no height
  CwSymmetry *symmetry; // of solid and plan; NULL: the domain is meshed whole
  int32_t whole;        // 1: it had a symmetry, which was given up
  CwSizeSeeds *seeds;   // while the seeds of the faces are made
  CwSize *size;
  double base_size;                // edge length at relative size 1 and scale 1; the same for all domains
  CwPatchTarget *patch_target;     // of each patch
  double (*face_radius)[CW_BENDS]; // of each face (face_radius.h)
  CwSharpEdge sharp;               // the sharpest of the walls
  double *relative_size;           // of each patch
  CwLayerTarget *patch_layers;     // of each patch, for so many layers
  int layer_count;
  double prism_integral;       // sum over walls of area / h^2, for h over the scale
  double *face_triangles;      // area / h^2 of each face, likewise
  double volume_integral;      // integral of h^-3 over the domain, likewise
  CwLayerSample *layer_sample; // what the layers take of it
  int32_t layer_sample_count;
  double layer_share;   // of that, what graded columns take; known with the walls
  int32_t more_regions; // than its cells ask for, of each passage where there are equal ones; CW_UNDIVIDED: one region
  CwPlan plan;
  CwNetwork network;
  CwPeriodicImages images;
  CwBoundaryInput input; // the products so far
  CwOpenEdges open_edges;
  CwWallCurves wall_curves;
  CwSurfaceMesh surface;
  CwColumnTargets targets;
  CwLayers layers;
  CwFreeCurves free_curves;
  CwInterfaces interfaces;
  CwSharedNodes shared;
  CwRegionContext context;
  int32_t *number, colours;       // region numbers
  int32_t pair_count, (*pair)[2]; // adjacent regions
  CwInterfaceRuleCounts rule;
} CwDomain;

enum { CW_UNDIVIDED = -1 };

// Opens the exact geometry of domain `number` of the model, which it keeps; then, once it has the unit of the model,
// notes what the case asks of its patches. CW_ERR_INPUT where the patches of faces.csv are not those of the model, in
// their order and of their kinds.
CwStatus cw_domain_open(CwDomain *domain, const CwModel *model, int number, const char *geometry_dir);
CwStatus cw_domain_ask(CwDomain *domain, const CwCase *table);

// Takes the widths of the passages from the solid where the model's are more, and the radii and the sharpest edge of
// the walls. Collective.
CwStatus cw_domain_measure_walls(const CwContext *context, CwDomain *domain);

// Sets the number of layers and the first heights, of this y+ where the case leaves it open, and what patches ask of so
// many.
void cw_domain_set_layers(CwDomain *domain, const CwCase *table, int layer_count, double y_plus_auto);
// Starts the tessellation of the background, with this deflection of its chords, and takes its faces up.
CwStatus cw_domain_start_background(CwDomain *domain, double deflection);
CwStatus cw_domain_take_background(const CwContext *context, CwDomain *domain, void *const *bytes);

// First height asked on a face, in the model's unit: that of its patch, or the greatest that its bend has room for.
double cw_domain_first_height(const CwDomain *domain, int face);

// Longest edge on walls of a patch, m: longer edges make prisms of small determinant.
double cw_domain_longest_edge(const CwDomain *domain, int patch);

// Cells of a region: what the case asks for; else region_cells, or more where that were more than regions_most regions,
// and never more than region_cells_most. So regions are as few as the planes find good places for, until the memory of
// the rank that fills one asks for more.
double cw_domain_region_cells(const CwMeshTable *mesh);

// What `least_regions` of the case comes to in a domain of so many predicted cells.
int cw_domain_least_regions(const CwCase *table, double cells);

// Divides the domain into regions: their number follows from `cells`, the predicted cells of this domain. Collective:
// the ranks look along some of the directions each, and have the same plan. With a symmetry it is a sector
// decomposition; outcome: CW_OUTCOME_ASYMMETRIC where none can be had.
CwStatus cw_domain_plan(const CwContext *context, CwDomain *domain, const CwCase *table, double cells,
                        double prism_factor, CwOutcome *outcome);

// Starts the surfaces anew at the present scale of the size field: curve network. Then cw_couple_open_edges and
// cw_wall_curves_make. Outcome: that of cw_network_make and cw_periodic_images_make.
CwStatus cw_domain_start(const CwContext *context, CwDomain *domain, CwOutcome *outcome);

// First heights and targets of all wall vertices, once the walls are merged, and what they take of the volume.
// Collective.
CwStatus cw_domain_targets(const CwContext *context, CwDomain *domain);

// Region numbers, once the interfaces are merged.
CwStatus cw_domain_number(CwDomain *domain);

// What the regions share, once their interfaces are final.
CwStatus cw_domain_share(CwLog *log, CwDomain *domain, const CwCase *table);

// The surfaces, for regions whose fill says what it does to `log`.
CwRegionInput cw_domain_region_input(const CwDomain *domain, CwLog *log);

void cw_domain_clear(CwDomain *domain); // the curve network and what follows from it
void cw_domain_close(CwDomain *domain);
