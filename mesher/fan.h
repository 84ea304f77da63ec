// SPDX-License-Identifier: AGPL-3.0-or-later
// The fan: half-planes that hold the z axis divide the flow around it into wedges. The decomposition of a domain with
// rotational symmetry: one plane across the axis cuts off the side where fluid lies on the axis (pipe and nose of the
// nut), planes parallel to it divide that side into slices, and a fan with the symmetry of the domain divides the other.
//
//   node 0                the plane across the axis; its negative side is that of the pipe
//   1 .. fan_first - 1    planes between slices
//   fan_first ...         the half-planes by ascending angle; wedge j lies between half-plane j and the next
#ifndef CUTWATER_MESHER_FAN_H
#define CUTWATER_MESHER_FAN_H

#include "mesher/plan.h"

#ifdef __cplusplus
extern "C" {
#endif

// True where `node` is a half-plane. Its plane acts only where cw_fan_reach is not negative.
int cw_fan_holds(const CwPlan *plan, int32_t node);
// Where it ends: the plane that holds the axis and stands across it; the distance to it is the way from the axis along
// the half-plane.
CwPlane cw_fan_end(const CwPlan *plan, int32_t node);
double cw_fan_reach(const CwPlan *plan, int32_t node, const double x[3]);
// The region of a point on the fan's side of node 0 (a point on a half-plane belongs to the wedge before it).
int32_t cw_fan_locate(const CwPlan *plan, const double x[3]);
// True where x lies in the closed wedge of `region`, which is one of the fan, within `tolerance` (m).
int cw_fan_in_wedge(const CwPlan *plan, int32_t region, const double x[3], double tolerance);

// Where `turns` turns of a symmetry of `count` turns take a node or region of the plan.
int32_t cw_fan_turned_node(const CwPlan *plan, int32_t count, int32_t turns, int32_t node);
int32_t cw_fan_turned_region(const CwPlan *plan, int32_t count, int32_t turns, int32_t region);
// The region that this one is a turned copy of, or itself.
int32_t cw_fan_first_region(const CwPlan *plan, int32_t count, int32_t region);

// Plans a domain that `count` turns bring to itself. CW_RETRY where it has no fluid on the axis on one side only, or no
// plane fits.
CwStatus cw_fan_plan_make(const CwCad *cad, const CwBackground *background, const CwInside *inside, const CwSize *size,
                          const CwPlanOptions *options, int32_t count, CwPlan *plan);

#ifdef __cplusplus
}
#endif
#endif
