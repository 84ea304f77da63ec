// SPDX-License-Identifier: AGPL-3.0-or-later
// One domain (rotor or stator) on its way from exact geometry to regions: everything a rank holds of it.
#ifndef CUTWATER_MESHER_DOMAIN_H
#define CUTWATER_MESHER_DOMAIN_H

#include "mesher/background.h"
#include "mesher/region_build.h"
#include "mesher/size.h"
#include "mesher/symmetry.h"
#include "mesher/wall_targets.h"

// The layers over a piece of wall.
typedef struct CwLayerSample {
  double density;          // area / h^3 at scale 1, m-1
  double size;             // h at scale 1, m
  double thickness, least; // asked height of the columns, and that below which they never give way to h, m
} CwLayerSample;

typedef struct {
  const char *name;
  CwCad *cad;
  CwBackground background;
  CwInside *inside;
  CwSymmetry *symmetry;                       // of solid and plan; NULL: the domain is meshed whole
  CwSize *size;
  double *relative_size, *patch_first_height; // of each patch; m
  double prism_integral;                      // sum over walls of area / h^2, at scale 1
  double volume_integral;                     // integral of h^-3 over the domain, at scale 1
  struct CwLayerSample *layer_sample;         // what the layers take of it: one for each background triangle of a wall
  int32_t layer_sample_count;
  CwPlan plan;
  CwSkeleton skeleton;
  double *first_height, *target;              // of each wall vertex, m
  CwRegionContext context;
  int32_t *number, colours;                   // region numbers
  int32_t pair_count, (*pair)[2];             // adjacent regions
} CwDomain;

// Opens geometry and makes the background triangulation.
CwStatus cw_domain_open(CwDomain *domain, const char *name, const char *geometry_dir, const CwCase *table,
                        const CwFlowScales *scales);

// Makes the size field, packed: a task of one rank. All ranks take it up with cw_domain_take_size.
CwStatus cw_domain_make_size(const CwDomain *domain, const CwCase *table, void **bytes, int64_t *byte_count);
CwStatus cw_domain_take_size(CwDomain *domain, const CwCase *table, const void *bytes);

// Target thickness of the layers of a patch, m: as asked, or from first height, count and growth.
double cw_domain_thickness(const CwDomain *domain, const CwCase *table, int patch);

// Integral of h^-3 over the domain less its layers at a scale of the size field, for h at scale 1: what the number of
// tetrahedra follows from.
double cw_domain_tet_integral(const CwDomain *domain, double scale);

// Divides the domain into regions: their number follows from `cells`, the predicted cells of this domain. The plan comes
// packed (cw_plan_unpack): a task of one rank. With a symmetry it is a fan, where one can be had.
CwStatus cw_domain_plan(const CwDomain *domain, const CwCase *table, double cells, double prism_factor,
                        double tet_factor, void **bytes, int64_t *byte_count);

// Takes up a plan. CW_RETRY, and nothing taken, where the domain has a symmetry and the plan or the curves that it cuts
// have not.
CwStatus cw_domain_take_plan(CwDomain *domain, const void *bytes);

// Starts the skeleton anew at the present scale of the size field: curve network and wall curves.
CwStatus cw_domain_start(CwDomain *domain);

// First heights and targets of all wall vertices, once the walls are merged.
CwStatus cw_domain_targets(CwDomain *domain, const CwCase *table);

// Region numbers and what the regions share, once the inner surfaces are merged.
CwStatus cw_domain_number(CwDomain *domain, const CwCase *table);

void cw_domain_clear(CwDomain *domain); // the skeleton and what follows from it
void cw_domain_close(CwDomain *domain);

#endif
