// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/plan/fan.h"

#include "mesher/common/vec.h"

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

int32_t cw_fan_wedge(const CwPlan *plan, const double x[3]) {
  const CwPlanNode *node = &plan->node[plan->fan_first];
  int after = cw_plane_distance(&node[plan->fan_count - 1].plane, x) > 0;
  for (int32_t j = plan->fan_count - 1; j >= 0; j--) { // the last wedge ends at half-plane 0
    int before_next = cw_plane_distance(&node[(j + 1) % plan->fan_count].plane, x) <= 0;
    if (after && before_next) return plan->fan_first + j;
    if (j > 0) after = cw_plane_distance(&node[j - 1].plane, x) > 0;
  }
  return plan->fan_first; // only on the axis
}

// Where turns take item `index` of those from..end: as many in every pitch, pitch by pitch.
static int32_t turned(int32_t count, int32_t turns, int32_t from, int32_t end, int32_t index) {
  if (index < from || index >= end) return index;
  return from + (index - from + turns * ((end - from) / count)) % (end - from);
}

int32_t cw_fan_turned_node(const CwPlan *plan, int32_t count, int32_t turns, int32_t node) {
  int32_t end = plan->fan_first + plan->fan_count;
  return node < end ? turned(count, turns, plan->fan_first, end, node)
                    : turned(count, turns, end, plan->node_count, node);
}

int32_t cw_fan_turned_region(const CwPlan *plan, int32_t count, int32_t turns, int32_t region) {
  return turned(count, turns, plan->fan_region, plan->region_count, region);
}

int32_t cw_fan_first_region(const CwPlan *plan, int32_t count, int32_t region) {
  int32_t within = region - plan->fan_region;
  return within < 0 ? region : plan->fan_region + within % ((plan->region_count - plan->fan_region) / count);
}
