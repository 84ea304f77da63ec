// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/plan/plan_audit.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/common/vec.h"

static const double UNIT = 1e-12; // of a normal's length: rounding

// A node under a half-plane is a child of two: of the one that opens its wedge, which is its parent, and of the next.
static CwStatus audit_child(const CwPlan *plan, int32_t node, int side, int32_t *uses) {
  CwStatus status = CW_OK;
  int32_t child = plan->node[node].child[side], regions = plan->region_count;
  int opens = !cw_sector_holds(plan, node) || side == 1;
  CW_REQUIRE(child < plan->node_count && -1 - child < regions && child != node, CW_ERR_FAULT,
             "plan: node %d has the child %d; there are %d nodes and %d regions", node, child, plan->node_count,
             regions);
  if (child < 0) {
    uses[plan->node_count + -1 - child] += opens;
    goto done;
  }
  CW_REQUIRE(!opens || (child > node && (plan->node[child].parent == node || cw_sector_holds(plan, child))),
             CW_ERR_FAULT, "plan: node %d has the child %d, whose parent is %d", node, child, plan->node[child].parent);
  uses[child] += opens;
done:
  return status;
}

CwStatus cw_plan_audit(const CwPlan *plan) {
  CwStatus status = CW_OK;
  int32_t all = plan->node_count + plan->region_count, *uses = NULL;
  CW_REQUIRE(plan->region_count == plan->node_count + (plan->sector_count == 0), CW_ERR_FAULT,
             "plan: %d nodes divide a domain into %d regions", plan->node_count, plan->region_count);
  CW_NEW(uses, all);
  for (int32_t i = 0; i < plan->node_count; i++) {
    double length = cw_norm(plan->node[i].plane.normal);
    CW_REQUIRE(fabs(length - 1) <= UNIT, CW_ERR_FAULT, "plan: the normal of node %d is %.17g long", i, length);
    for (int side = 0; side < 2; side++) CW_TRY(audit_child(plan, i, side, uses));
  }
  for (int32_t i = 0; i < all; i++) {
    // The root is no child; of the half-planes node 0 names the first.
    int is_root = i == 0 && plan->node_count > 0, other = i < plan->node_count && cw_sector_holds(plan, i);
    int wanted = is_root || (other && i > plan->sector_first) || plan->node_count == 0 ? 0 : 1;
    CW_REQUIRE(uses[i] == wanted, CW_ERR_FAULT, "plan: %s %d is the child of %d nodes; %d is allowed",
               i < plan->node_count ? "node" : "region", i < plan->node_count ? i : i - plan->node_count, uses[i],
               wanted);
  }
done:
  free(uses);
  return status;
}

CwStatus cw_plan_vtk(const CwPlan *plan, const CwBackground *background, const char *path) {
  CwStatus status = CW_OK;
  int32_t *region = NULL;
  CW_NEW(region, background->triangle_count);
  for (int32_t t = 0; t < background->triangle_count; t++) {
    double centre[3];
    cw_background_area(background, t, centre);
    region[t] = cw_plan_locate(plan, centre);
  }
  CW_TRY(cw_background_vtk(background, "regions", &(CwVtkField){"region", region, NULL}, path));
done:
  free(region);
  return status;
}
