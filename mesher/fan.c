// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fan.h"

#include "mesher/vec.h"

int cw_fan_holds(const CwPlan *plan, int32_t node) {
  return node >= plan->fan_first && node < plan->fan_first + plan->fan_count;
}

CwPlane cw_fan_end(const CwPlan *plan, int32_t node) {
  const double *n = plan->node[node].plane.normal;
  return (CwPlane){{n[1], -n[0], 0}, 0}; // normal x z
}

double cw_fan_reach(const CwPlan *plan, int32_t node, const double x[3]) {
  CwPlane end = cw_fan_end(plan, node);
  return cw_plane_distance(&end, x);
}

int32_t cw_fan_locate(const CwPlan *plan, const double x[3]) {
  const CwPlanNode *node = &plan->node[plan->fan_first];
  int after = cw_plane_distance(&node[plan->fan_count - 1].plane, x) > 0;
  for (int32_t j = plan->fan_count - 1; j >= 0; j--) { // the last wedge ends at half-plane 0
    int before_next = cw_plane_distance(&node[(j + 1) % plan->fan_count].plane, x) <= 0;
    if (after && before_next) return plan->fan_region + j;
    if (j > 0) after = cw_plane_distance(&node[j - 1].plane, x) > 0;
  }
  return plan->fan_region; // only on the axis
}

int cw_fan_in_wedge(const CwPlan *plan, int32_t region, const double x[3], double tolerance) {
  int32_t j = region - plan->fan_region, next = (j + 1) % plan->fan_count;
  const CwPlanNode *node = &plan->node[plan->fan_first];
  return cw_plane_distance(&plan->node[node->parent].plane, x) >= -tolerance &&
         cw_plane_distance(&node[j].plane, x) >= -tolerance && cw_plane_distance(&node[next].plane, x) <= tolerance;
}

static int32_t turned(const CwPlan *plan, int32_t count, int32_t turns, int32_t base, int32_t index) {
  if (index < base || index >= base + plan->fan_count) return index;
  return base + (index - base + turns * (plan->fan_count / count)) % plan->fan_count;
}

int32_t cw_fan_turned_node(const CwPlan *plan, int32_t count, int32_t turns, int32_t node) {
  return turned(plan, count, turns, plan->fan_first, node);
}

int32_t cw_fan_turned_region(const CwPlan *plan, int32_t count, int32_t turns, int32_t region) {
  return turned(plan, count, turns, plan->fan_region, region);
}

int32_t cw_fan_first_region(const CwPlan *plan, int32_t count, int32_t region) {
  int32_t wedge = region - plan->fan_region;
  return wedge < 0 ? region : plan->fan_region + wedge % (plan->fan_count / count);
}
