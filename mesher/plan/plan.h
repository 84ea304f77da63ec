// SPDX-License-Identifier: AGPL-3.0-or-later
// The decomposition of a domain by partition planes (paper, section 2.1): a binary tree; inner nodes hold planes,
// leaves are the regions. Immutable once made (plan_make.h, sector_plan.h).
//
// In the sector decomposition of a domain with rotational symmetry half-planes that hold the z axis divide the flow
// around it into wedges:
//
//   node 0                    the plane across the axis; its negative side is that of the pipe
//   1 .. sector_first - 1     planes between slices
//   sector_first ...          sector_count half-planes by ascending angle; wedge j lies between half-plane j and the
//                             next: child[1] of half-plane j (child[0] is that of the one before)
//   the rest                  planes within wedges, pitch by pitch
//   regions                   slices, then from sector_region those of the wedges, pitch by pitch
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/common/clip.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  CwPlane plane;    // child[0] lies on the negative side
  int32_t parent;   // -1 for the root; of a half-plane the plane above the sectors
  int32_t child[2]; // node, or -1 - region for a leaf
  double worst;     // sine of the sharpest angle with the walls crossed or their layers; 1: normal
} CwPlanNode;

typedef struct {
  int32_t node_count; // region_count - 1, of a sector decomposition region_count
  int32_t region_count;
  CwPlanNode *node;        // node 0 is the root; parents before children
  double *predicted_cells; // of each region
  int32_t sector_first, sector_count,
      sector_region;    // half-planes and the first region of a wedge; sector_count 0: none
  int32_t sector_turns; // that bring the plan's wedges to themselves
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

// True where x lies in the closed cell of `region`, within `tolerance` (m).
int cw_plan_in_region(const CwPlan *plan, int32_t region, const double x[3], double tolerance);

// True where the plane of `ancestor` bounds the cell of `node` or a cell around it (a node is not its own ancestor).
int cw_plan_is_ancestor(const CwPlan *plan, int32_t ancestor, int32_t node);

// The line in which two planes meet: its point nearest to the origin, and its unit direction, normal(a) x normal(b). 0,
// and no line, where the sine of the angle between the planes is below 0.01.
int cw_plane_line(const CwPlane *a, const CwPlane *b, double point[3], double direction[3]);

// Begins a plan, with room for so many nodes and regions.
CwStatus cw_plan_new(size_t room, CwPlan *plan);
void cw_plan_free(CwPlan *plan);

// The plan in one block of bytes (malloc'd), to travel between ranks, and back into a new plan. CW_ERR_MEMORY.
CwStatus cw_plan_pack(const CwPlan *plan, void **bytes, int64_t *byte_count);
CwStatus cw_plan_unpack(const void *bytes, CwPlan *plan);

// Region of a point (a point on a plane belongs to the negative side).
int32_t cw_plan_locate(const CwPlan *plan, const double x[3]);

// True where x lies in the closed cell of `node`: within `tolerance` (m) of the half-spaces of all its bounds but
// those in `skip[0..skip_count)` (nodes).
int cw_plan_in_cell(const CwPlan *plan, int32_t node, const double x[3], double tolerance, const int32_t *skip,
                    int skip_count);

// True where `node` is a half-plane. Its plane acts only on the positive side of cw_sector_end.
int cw_sector_holds(const CwPlan *plan, int32_t node);
// Where it ends: the plane that holds the axis and stands across it; the distance to it is the way from the axis along
// the half-plane.
CwPlane cw_sector_end(const CwPlan *plan, int32_t node);

// Where `turns` turns of a symmetry of `count` turns take a node or region of the plan.
int32_t cw_sector_turned_node(const CwPlan *plan, int32_t count, int32_t turns, int32_t node);
int32_t cw_sector_turned_region(const CwPlan *plan, int32_t count, int32_t turns, int32_t region);
// The region that this one is a periodic image of, or itself.
int32_t cw_sector_first_region(const CwPlan *plan, int32_t count, int32_t region);

#ifdef __cplusplus
}
#endif
