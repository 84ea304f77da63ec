// SPDX-License-Identifier: AGPL-3.0-or-later
// The fan: half-planes that hold the z axis divide the flow around it into wedges. The decomposition of a domain with
// rotational symmetry: one plane across the axis cuts off the side where fluid lies on the axis (pipe and nose of the
// nut), planes parallel to it divide that side into slices, and a fan with the symmetry of the domain divides the
// other. The wedges of one pitch are divided by any planes, and those of the other pitches by the same planes, turned.
//
//   node 0                the plane across the axis; its negative side is that of the pipe
//   1 .. fan_first - 1    planes between slices
//   fan_first ...         fan_count half-planes by ascending angle; wedge j lies between half-plane j and the next:
//                         child[1] of half-plane j (child[0] is that of the one before)
//   the rest              planes within wedges, pitch by pitch
//   regions               slices, then from fan_region those of the wedges, pitch by pitch
#ifndef CUTWATER_MESHER_PLAN_FAN_H
#define CUTWATER_MESHER_PLAN_FAN_H

#include "mesher/parallel/outcome.h"
#include "mesher/plan/plan.h"

#ifdef __cplusplus
extern "C" {
#endif

// True where `node` is a half-plane. Its plane acts only where cw_fan_reach is not negative.
int cw_fan_holds(const CwPlan *plan, int32_t node);
// Where it ends: the plane that holds the axis and stands across it; the distance to it is the way from the axis along
// the half-plane.
CwPlane cw_fan_end(const CwPlan *plan, int32_t node);
double cw_fan_reach(const CwPlan *plan, int32_t node, const double x[3]);
// The half-plane that opens the wedge of a point on the fan's side of node 0 (a point on a half-plane belongs to the
// wedge before it).
int32_t cw_fan_wedge(const CwPlan *plan, const double x[3]);

// Where `turns` turns of a symmetry of `count` turns take a node or region of the plan.
int32_t cw_fan_turned_node(const CwPlan *plan, int32_t count, int32_t turns, int32_t node);
int32_t cw_fan_turned_region(const CwPlan *plan, int32_t count, int32_t turns, int32_t region);
// The region that this one is a turned copy of, or itself.
int32_t cw_fan_first_region(const CwPlan *plan, int32_t count, int32_t region);

// Plans a domain that `count` turns bring to itself. Outcome: CW_OUTCOME_ASYMMETRIC where it has no fluid on the axis
// on one side only, or no plane fits.
CwStatus cw_fan_plan_make(const CwCad *cad, const CwBackground *background, const CwInside *inside, const CwSize *size,
                          const CwPlanOptions *options, int32_t count, CwPlan *plan, CwOutcome *outcome);

#ifdef __cplusplus
}
#endif
#endif
