// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/fan.h"
#include "mesher/plan_score.h"

// Splits `part` into `regions` leaves under node `parent` (on its side `side`), or leaves it whole where no plane
// will do. `next_region` counts leaves.
static CwStatus split(const CwPlanModel *model, CwPlan *plan, CwPlanPart *part, int32_t regions, int32_t parent,
                      int side, int32_t *next_region) {
  CwStatus status = CW_OK;
  CwPlanPart half[2] = {0};
  int32_t first = 0, node = plan->node_count;
  if (regions > 1) {
    plan->node[node].parent = parent;
    CW_TRY(cw_plan_best_plane(model, plan, node, part, regions, &plan->node[node].plane, &first,
                              &plan->worst_angle[node]));
  }
  if (first == 0) {
    int32_t region = (*next_region)++;
    if (parent >= 0) plan->node[parent].child[side] = -1 - region;
    plan->predicted_cells[region] = part->work;
    goto done;
  }
  plan->node_count++;
  if (parent >= 0) plan->node[parent].child[side] = node;
  plan->node[node].child[0] = plan->node[node].child[1] = INT32_MIN; // not known yet
  for (int s = 0; s < 2; s++) CW_TRY(cw_plan_part_clip(model, part, &plan->node[node].plane, s, &half[s]));
  cw_plan_part_free(part); // no more needed below
  CW_TRY(split(model, plan, &half[0], first, node, 0, next_region));
  CW_TRY(split(model, plan, &half[1], regions - first, node, 1, next_region));
done:
  cw_plan_part_free(&half[0]);
  cw_plan_part_free(&half[1]);
  return status;
}

CwStatus cw_plan_make(const CwCad *cad, const CwBackground *background, const CwInside *inside, const CwSize *size,
                      const CwPlanOptions *options, CwPlan *plan) {
  CwStatus status = CW_OK;
  CwPlanModel model = {0};
  CwPlanPart whole = {0};
  memset(plan, 0, sizeof *plan);
  CW_NEW(plan->node, options->region_count);
  CW_NEW(plan->worst_angle, options->region_count);
  CW_NEW(plan->predicted_cells, options->region_count);
  CW_TRY(cw_plan_model_make(cad, background, inside, size, options, &model));
  CW_TRY(cw_plan_part_whole(&model, &whole));
  model.mean_work = whole.work / options->region_count;
  plan->region_count = 0;
  CW_TRY(split(&model, plan, &whole, options->region_count, -1, 0, &plan->region_count));
done:
  cw_plan_part_free(&whole);
  cw_plan_model_free(&model);
  if (status != CW_OK) cw_plan_free(plan);
  return status;
}

CwStatus cw_plan_pack(const CwPlan *plan, void **bytes, int64_t *byte_count) {
  CwStatus status = CW_OK;
  size_t n = (size_t)plan->region_count, nodes = n * sizeof *plan->node, numbers = n * sizeof(double);
  const int32_t count[5] = {plan->node_count, plan->region_count, plan->fan_first, plan->fan_count, plan->fan_region};
  char *block;
  CW_NEW(block, sizeof count + nodes + 2 * numbers);
  memcpy(block, count, sizeof count);
  memcpy(block + sizeof count, plan->node, nodes);
  memcpy(block + sizeof count + nodes, plan->predicted_cells, numbers);
  memcpy(block + sizeof count + nodes + numbers, plan->worst_angle, numbers);
  *bytes = block;
  *byte_count = (int64_t)(sizeof count + nodes + 2 * numbers);
done:
  return status;
}

CwStatus cw_plan_unpack(const void *bytes, CwPlan *plan) {
  CwStatus status = CW_OK;
  int32_t count[5];
  const char *at = (const char *)bytes + sizeof count;
  memcpy(count, bytes, sizeof count);
  memset(plan, 0, sizeof *plan);
  plan->node_count = count[0];
  plan->region_count = count[1];
  plan->fan_first = count[2];
  plan->fan_count = count[3];
  plan->fan_region = count[4];
  size_t n = (size_t)plan->region_count;
  CW_NEW(plan->node, n);
  CW_NEW(plan->predicted_cells, n);
  CW_NEW(plan->worst_angle, n);
  memcpy(plan->node, at, n * sizeof *plan->node);
  memcpy(plan->predicted_cells, at + n * sizeof *plan->node, n * sizeof(double));
  memcpy(plan->worst_angle, at + n * (sizeof *plan->node + sizeof(double)), n * sizeof(double));
done:
  if (status != CW_OK) cw_plan_free(plan);
  return status;
}

void cw_plan_free(CwPlan *plan) {
  free(plan->node);
  free(plan->predicted_cells);
  free(plan->worst_angle);
  memset(plan, 0, sizeof *plan);
}

int32_t cw_plan_locate(const CwPlan *plan, const double x[3]) {
  if (plan->node_count == 0) return 0;
  int32_t node = 0;
  for (;;) {
    int32_t child = plan->node[node].child[cw_plane_distance(&plan->node[node].plane, x) > 0];
    if (child < 0) return -1 - child;
    if (cw_fan_holds(plan, child)) return cw_fan_locate(plan, x);
    node = child;
  }
}

int cw_plan_in_cell(const CwPlan *plan, int32_t node, const double x[3], double tolerance, const int32_t *skip,
                    int skip_count) {
  int32_t start = node;
  if (cw_fan_holds(plan, node)) {
    if (cw_fan_reach(plan, node, x) < -tolerance) return 0;
    start = plan->fan_first; // the child of the plane above
  }
  for (int32_t below = start, above = plan->node[node].parent; above >= 0; below = above, above = plan->node[above].parent) {
    int skipped = 0;
    for (int k = 0; k < skip_count; k++) skipped |= skip[k] == above;
    if (skipped) continue;
    double distance = cw_plane_distance(&plan->node[above].plane, x);
    if (plan->node[above].child[1] == below ? distance < -tolerance : distance > tolerance) return 0;
  }
  return 1;
}

int cw_plan_in_region(const CwPlan *plan, int32_t region, const double x[3], double tolerance) {
  if (cw_plan_locate(plan, x) == region) return 1; // as a rule
  if (plan->fan_count && region >= plan->fan_region) return cw_fan_in_wedge(plan, region, x, tolerance);
  for (int32_t node = 0; node < plan->node_count; node++) {
    for (int side = 0; side < 2; side++) {
      if (plan->node[node].child[side] != -1 - region) continue;
      double distance = cw_plane_distance(&plan->node[node].plane, x);
      if (side ? distance < -tolerance : distance > tolerance) return 0;
      return cw_plan_in_cell(plan, node, x, tolerance, NULL, 0);
    }
  }
  return 1; // the only region
}

int cw_plan_is_ancestor(const CwPlan *plan, int32_t ancestor, int32_t node) {
  while ((node = plan->node[node].parent) >= 0) {
    if (node == ancestor) return 1;
  }
  return 0;
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
