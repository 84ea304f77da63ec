// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/plan/plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"

CwStatus cw_plan_new(size_t room, CwPlan *plan) {
  CwStatus status = CW_OK;
  memset(plan, 0, sizeof *plan);
  CW_NEW(plan->node, room);
  CW_NEW(plan->predicted_cells, room);
done:
  return status;
}

CwStatus cw_plan_pack(const CwPlan *plan, void **bytes, int64_t *byte_count) {
  CwStatus status = CW_OK;
  size_t n = (size_t)plan->region_count, nodes = n * sizeof *plan->node, cells = n * sizeof *plan->predicted_cells;
  const int32_t count[6] = {plan->node_count,   plan->region_count,  plan->sector_first,
                            plan->sector_count, plan->sector_region, plan->sector_turns};
  char *block;
  CW_NEW(block, sizeof count + nodes + cells);
  memcpy(block, count, sizeof count);
  memcpy(block + sizeof count, plan->node, nodes);
  memcpy(block + sizeof count + nodes, plan->predicted_cells, cells);
  *bytes = block;
  *byte_count = (int64_t)(sizeof count + nodes + cells);
done:
  return status;
}

CwStatus cw_plan_unpack(const void *bytes, CwPlan *plan) {
  CwStatus status = CW_OK;
  int32_t count[6];
  const char *at = (const char *)bytes + sizeof count;
  memcpy(count, bytes, sizeof count);
  size_t n = (size_t)count[1];
  CW_TRY(cw_plan_new(n, plan));
  plan->node_count = count[0];
  plan->region_count = count[1];
  plan->sector_first = count[2];
  plan->sector_count = count[3];
  plan->sector_region = count[4];
  plan->sector_turns = count[5];
  memcpy(plan->node, at, n * sizeof *plan->node);
  memcpy(plan->predicted_cells, at + n * sizeof *plan->node, n * sizeof *plan->predicted_cells);
done:
  if (status != CW_OK) cw_plan_free(plan);
  return status;
}

void cw_plan_free(CwPlan *plan) {
  free(plan->node);
  free(plan->predicted_cells);
  memset(plan, 0, sizeof *plan);
}

int cw_sector_holds(const CwPlan *plan, int32_t node) {
  return node >= plan->sector_first && node < plan->sector_first + plan->sector_count;
}

CwPlane cw_sector_end(const CwPlan *plan, int32_t node) {
  const double *n = plan->node[node].plane.normal;
  return (CwPlane){{n[1], -n[0], 0}, 0}; // normal x z
}

// The half-plane that opens the wedge of a point on the sector side of node 0; a point on a half-plane belongs to the
// wedge before it.
static int32_t wedge_of(const CwPlan *plan, const double x[3]) {
  const CwPlanNode *node = &plan->node[plan->sector_first];
  int after = cw_plane_distance(&node[plan->sector_count - 1].plane, x) > 0;
  for (int32_t j = plan->sector_count - 1; j >= 0; j--) { // the last wedge ends at half-plane 0
    int before_next = cw_plane_distance(&node[(j + 1) % plan->sector_count].plane, x) <= 0;
    if (after && before_next) return plan->sector_first + j;
    if (j > 0) after = cw_plane_distance(&node[j - 1].plane, x) > 0;
  }
  return plan->sector_first; // only on the axis
}

// Where turns take item `index` of those from..end: as many in every pitch, pitch by pitch.
static int32_t turned(int32_t count, int32_t turns, int32_t from, int32_t end, int32_t index) {
  if (index < from || index >= end) return index;
  return from + (index - from + turns * ((end - from) / count)) % (end - from);
}

int32_t cw_sector_turned_node(const CwPlan *plan, int32_t count, int32_t turns, int32_t node) {
  int32_t end = plan->sector_first + plan->sector_count;
  return node < end ? turned(count, turns, plan->sector_first, end, node)
                    : turned(count, turns, end, plan->node_count, node);
}

int32_t cw_sector_turned_region(const CwPlan *plan, int32_t count, int32_t turns, int32_t region) {
  return turned(count, turns, plan->sector_region, plan->region_count, region);
}

int32_t cw_sector_first_region(const CwPlan *plan, int32_t count, int32_t region) {
  int32_t within = region - plan->sector_region;
  return within < 0 ? region : plan->sector_region + within % ((plan->region_count - plan->sector_region) / count);
}

int32_t cw_plan_locate(const CwPlan *plan, const double x[3]) {
  if (plan->node_count == 0) return 0;
  int32_t node = 0;
  while (node >= 0) {
    int32_t child = plan->node[node].child[cw_plane_distance(&plan->node[node].plane, x) > 0];
    node = child >= 0 && cw_sector_holds(plan, child) ? plan->node[wedge_of(plan, x)].child[1] : child;
  }
  return -1 - node;
}

CwPlanBound cw_plan_bound(const CwPlan *plan, int32_t node) {
  int32_t above = plan->node[node].parent;
  if (above < 0) return (CwPlanBound){-1, 0};
  // Of the half-planes the one above knows the first alone.
  return (CwPlanBound){above, plan->node[above].child[1] == (cw_sector_holds(plan, node) ? plan->sector_first : node)};
}

// The innermost plane that bounds a region.
static CwPlanBound region_bound(const CwPlan *plan, int32_t region) {
  for (int32_t node = 0; node < plan->node_count; node++) {
    if (plan->node[node].child[1] == -1 - region) return (CwPlanBound){node, 1};
    // A wedge is found by the half-plane that opens it.
    if (plan->node[node].child[0] == -1 - region && !cw_sector_holds(plan, node)) return (CwPlanBound){node, 0};
  }
  return (CwPlanBound){-1, 0}; // the only region
}

CwPlanBound cw_plan_next_bound(const CwPlan *plan, CwPlanBound bound) {
  if (!cw_sector_holds(plan, bound.node) || !bound.positive) return cw_plan_bound(plan, bound.node);
  return (CwPlanBound){plan->sector_first + (bound.node - plan->sector_first + 1) % plan->sector_count, 0};
}

// True where x is within `tolerance` of the half-spaces of the bound and of all further ones.
static int within(const CwPlan *plan, CwPlanBound bound, const double x[3], double tolerance, const int32_t *skip,
                  int skip_count) {
  for (; bound.node >= 0; bound = cw_plan_next_bound(plan, bound)) {
    int skipped = 0;
    for (int k = 0; k < skip_count; k++) skipped |= skip[k] == bound.node;
    if (skipped) continue;
    double distance = cw_plane_distance(&plan->node[bound.node].plane, x);
    if (bound.positive ? distance < -tolerance : distance > tolerance) return 0;
  }
  return 1;
}

int cw_plan_in_cell(const CwPlan *plan, int32_t node, const double x[3], double tolerance, const int32_t *skip,
                    int skip_count) {
  CwPlane end = cw_sector_end(plan, node);
  if (cw_sector_holds(plan, node) && cw_plane_distance(&end, x) < -tolerance) return 0;
  return within(plan, cw_plan_bound(plan, node), x, tolerance, skip, skip_count);
}

int cw_plan_in_region(const CwPlan *plan, int32_t region, const double x[3], double tolerance) {
  if (cw_plan_locate(plan, x) == region) return 1; // as a rule
  return within(plan, region_bound(plan, region), x, tolerance, NULL, 0);
}

int cw_plan_is_ancestor(const CwPlan *plan, int32_t ancestor, int32_t node) {
  CwPlanBound bound = cw_plan_bound(plan, node);
  while (bound.node >= 0 && bound.node != ancestor) bound = cw_plan_next_bound(plan, bound);
  return bound.node >= 0;
}

int cw_plane_line(const CwPlane *a, const CwPlane *b, double point[3], double direction[3]) {
  const double *n = a->normal, *m = b->normal;
  double length = 0, dot = 0;
  for (int k = 0; k < 3; k++) {
    direction[k] = n[(k + 1) % 3] * m[(k + 2) % 3] - n[(k + 2) % 3] * m[(k + 1) % 3];
    length += direction[k] * direction[k];
    dot += n[k] * m[k];
  }
  if (length < 1e-4) return 0;
  // The point of the line nearest to the origin is s n + t m.
  double s = (a->offset - b->offset * dot) / length, t = (b->offset - a->offset * dot) / length;
  for (int k = 0; k < 3; k++) {
    point[k] = s * n[k] + t * m[k];
    direction[k] /= sqrt(length);
  }
  return 1;
}
