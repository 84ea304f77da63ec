// SPDX-License-Identifier: AGPL-3.0-or-later
// The planner: recursive bisection of a domain by planes, on its background triangulation (paper, section 2.1).
// A binary tree; inner nodes hold planes, leaves are the regions. Balances predicted cells, keeps interfaces small,
// keeps plane-to-wall angles away from sharp, keeps planes away from edges of the model and from one another's
// crossings with them.
#ifndef CUTWATER_MESHER_PLAN_PLAN_H
#define CUTWATER_MESHER_PLAN_PLAN_H

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/cad/background.h"
#include "mesher/cad/inside.h"
#include "mesher/common/clip.h"
#include "mesher/size/size.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  CwPlane plane;    // child[0] lies on the negative side
  int32_t parent;   // -1 for the root; of a half-plane the plane above the fan
  int32_t child[2]; // node, or -1 - region for a leaf
} CwPlanNode;

typedef struct {
  int32_t node_count; // region_count - 1, of a fan region_count
  int32_t region_count;
  CwPlanNode *node;        // node 0 is the root; parents before children
  double *predicted_cells; // of each region
  double *worst_angle;     // of each node: least sqrt(1 - (n.m)^2) over walls crossed, they or their layers; 1: normal
  int32_t fan_first, fan_count, fan_region; // half-planes and the first region of a wedge (fan.h); fan_count 0: none
  int32_t fan_turns;                        // that bring the plan's wedges to themselves
} CwPlan;

// A plane that bounds a cell, and the side on which the cell lies.
typedef struct {
  int32_t node; // -1: no more
  int positive;
} CwPlanBound;

// The planes that bound the cell which the plane of `node` divides, from the innermost to the root: the
// ancestors, and for cells within a wedge the half-plane that ends it too.
CwPlanBound cw_plan_bound(const CwPlan *plan, int32_t node);
CwPlanBound cw_plan_next_bound(const CwPlan *plan, CwPlanBound bound);

typedef struct {
  int32_t region_count;    // at least 1; the plan has fewer where no plane divides a part of the domain any more
  const double *thickness; // of the layers on each patch of the CAD, m (0 on caps): planes and lines keep room for it
  const double *least_thickness; // may be NULL; else the layers are at most max(least_thickness[patch], tallest * h)
  double tallest;
  double base_size;    // at which the model is looked at: a wanted edge length of a mesh of about a million cells
  double prism_factor; // predicted prisms = prism_factor * sum over wall triangles(area / h^2)
} CwPlanOptions;

// True where x lies in the closed cell of `region`, within `tolerance` (m).
int cw_plan_in_region(const CwPlan *plan, int32_t region, const double x[3], double tolerance);

// True where the plane of `ancestor` bounds the cell of `node` or a cell around it (a node is not its own ancestor).
int cw_plan_is_ancestor(const CwPlan *plan, int32_t ancestor, int32_t node);

// The part of the line plane(a) . x, plane(b) . x as point and unit direction; 0 where the planes are nearly parallel.
int cw_plane_line(const CwPlane *a, const CwPlane *b, double point[3], double direction[3]);

CwStatus cw_plan_make(const CwCad *cad, const CwBackground *background, const CwInside *inside, const CwSize *size,
                      const CwPlanOptions *options, CwPlan *plan);
void cw_plan_free(CwPlan *plan);

// The plan in one block of bytes (malloc'd), to travel between ranks, and back.
CwStatus cw_plan_pack(const CwPlan *plan, void **bytes, int64_t *byte_count);
CwStatus cw_plan_unpack(const void *bytes, CwPlan *plan);

// Region of a point (a point on a plane belongs to the negative side).
int32_t cw_plan_locate(const CwPlan *plan, const double x[3]);

// True where x lies in the closed cell of `node`: within `tolerance` (m) of the half-spaces of all its bounds but
// those in `skip[0..skip_count)` (nodes).
int cw_plan_in_cell(const CwPlan *plan, int32_t node, const double x[3], double tolerance, const int32_t *skip,
                    int skip_count);

#ifdef __cplusplus
}
#endif
#endif
