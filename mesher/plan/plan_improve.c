// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/plan/plan_improve.h"

#include <math.h>

#include "mesher/common/vec.h"
#include "mesher/plan/plan_cost.h"
#include "mesher/plan/plan_lines.h"
#include "mesher/policy.h"

enum {
  REGIONS_MOST = 12, // of a subtree whose plane is moved: all below it is weighed for each move
  MOVES = 27         // each of shift and two turns forth, not at all and back; the first is no move
};
static const double FIRST_STEP = 0.08, LAST_STEP = 0.01; // of a plane, over the cube root of its cell's volume
static const double WORTH = 0.01;                        // least gain of a step

// What a subtree of the plan is worth.
typedef struct {
  double cost; // of its planes, their lines and the unevenness of its regions
  int slant;   // whether a line leans to a wall's normal, or a plane stands slantwise on a wall
} Worth;

static int32_t regions_of(const CwPlan *plan, int32_t node) {
  if (node < 0) return 1;
  return regions_of(plan, plan->node[node].child[0]) + regions_of(plan, plan->node[node].child[1]);
}

// What a region is worth. Notes its work in the plan.
static Worth weigh_region(const CwPlanModel *model, CwPlan *plan, const CwPlanPart *part, int32_t region) {
  plan->predicted_cells[region] = part->work;
  return (Worth){cw_plan_unevenness(part->work, model->mean_work, 1), 0};
}

// What the plane of a node alone is worth in this cell. Notes its angle in the plan. May stop at any cost of `most` or
// more.
static CwStatus weigh_plane(const CwPlanModel *model, CwPlan *plan, const CwPlanPart *part, int32_t node, double most,
                            Worth *worth) {
  CwStatus status = CW_OK;
  CwPlanLines lines = {0, 1};
  const CwPlane *plane = &plan->node[node].plane;
  CwPlanPlace place = cw_plan_place(model, part, plane, NULL);
  plan->node[node].worst = place.worst;
  double cost = cw_plan_place_cost(place) + cw_plan_touch_cost(cw_plan_touch(model, part, plane, NULL));
  if (cost < most) CW_TRY(cw_plan_lines(model, plan, node, part, plane, most - cost, &lines));
  *worth = (Worth){cost + lines.cost, lines.cosine <= cw_policy.upright_cosine || cw_plan_is_sharp(place.worst)};
done:
  return status;
}

static void add_worth(const Worth *further, Worth *worth) {
  worth->cost += further->cost;
  worth->slant |= further->slant;
}

// Weighs the planes and regions of a subtree with this cell. May stop at any cost of `most` or more.
static CwStatus weigh(const CwPlanModel *model, CwPlan *plan, const CwPlanPart *part, int32_t node, double most,
                      Worth *worth) {
  CwStatus status = CW_OK;
  CwPlanPart half = {0};
  if (node < 0) {
    *worth = weigh_region(model, plan, part, -1 - node);
    return CW_OK;
  }
  CW_TRY(weigh_plane(model, plan, part, node, most, worth));
  for (int s = 0; s < 2 && worth->cost < most; s++) {
    Worth further;
    CW_TRY(cw_plan_part_clip(model, part, &plan->node[node].plane, s, &half));
    CW_TRY(weigh(model, plan, &half, plan->node[node].child[s], most - worth->cost, &further));
    cw_plan_part_free(&half);
    add_worth(&further, worth);
  }
done:
  cw_plan_part_free(&half);
  return status;
}

// Where a plane cuts its cell: the middle, and how far the cut reaches from there.
static void find_cut(const CwPlanModel *model, const CwPlanPart *part, const CwPlane *plane, double centre[3],
                     double *reach) {
  double sum[3] = {0, 0, 0}, square = 0, all = 0;
  for (int pass = 0; pass < 2; pass++) {
    for (int32_t i = 0; i < part->sample_count; i++) {
      const double *x = model->sample[part->sample[i]].x;
      if (fabs(cw_plane_distance(plane, x)) > model->sample_spacing) continue;
      double volume = model->sample[part->sample[i]].volume, d[3];
      if (pass == 0) {
        for (int k = 0; k < 3; k++) sum[k] += volume * x[k];
        all += volume;
      } else {
        cw_sub(x, centre, d);
        square += volume * cw_dot(d, d);
      }
    }
    for (int k = 0; k < 3 && pass == 0; k++)
      centre[k] = all > 0 ? sum[k] / all : (part->box.low[k] + part->box.high[k]) / 2;
  }
  *reach = all > 0 ? sqrt(square / all) : cw_distance(part->box.low, part->box.high) / 4;
}

// The plane after a move of this length: shifted, turned about two directions through the middle of its cut, or several
// of these at once. Where one of them alone leaves a line no room, another may give it back.
static CwPlane moved(const CwPlane *plane, const double centre[3], double reach, int move, double length) {
  static const double way[3] = {0, 1, -1};
  const double *n = plane->normal, turn = length / reach;
  double across[3] = {n[1], -n[0], 0}, other[3]; // n x z
  CwPlane made = *plane;
  if (cw_norm(across) < 0.1) across[0] = 0, across[1] = n[2], across[2] = -n[1]; // n x x
  cw_unit(across);
  cw_cross(n, across, other);
  for (int k = 0; k < 3; k++) made.normal[k] += turn * (way[move / 3 % 3] * across[k] + way[move / 9] * other[k]);
  cw_unit(made.normal);
  made.offset = cw_dot(made.normal, centre) + cw_plane_distance(plane, centre) + way[move % 3] * length;
  return made;
}

// Moves the plane of `node` step by step to where its subtree, of which *worth is given and kept true, costs less,
// where something in it is slant; then *moves becomes 1.
static CwStatus improve_plane(const CwPlanModel *model, CwPlan *plan, const CwPlanPart *part, int32_t node,
                              Worth *worth, int *moves) {
  CwStatus status = CW_OK;
  CwPlane *plane = &plan->node[node].plane;
  double centre[3], reach, size = cbrt(part->volume);
  Worth least = *worth, tried;
  if (!least.slant) goto done;
  *moves = 1;
  for (double step = FIRST_STEP * size; step > LAST_STEP * size;) {
    CwPlane best = *plane;
    const CwPlane from = best;
    double before = least.cost;
    find_cut(model, part, plane, centre, &reach);
    for (int move = 1; move < MOVES; move++) {
      *plane = moved(&from, centre, reach, move, step);
      CW_TRY(weigh(model, plan, part, node, least.cost, &tried));
      if (tried.cost < least.cost - WORTH) {
        least = tried;
        best = *plane;
      }
    }
    *plane = best;
    if (!(least.cost < before)) step /= 2;
  }
  CW_TRY(weigh(model, plan, part, node, INFINITY, worth)); // notes what came of it
done:
  return status;
}

// Improves a subtree from its leaves up. *worth: of what came of it, where it has no more than REGIONS_MOST regions.
// *moves: whether planes may have moved.
static CwStatus improve(const CwPlanModel *model, CwPlan *plan, const CwPlanPart *part, int32_t node, Worth *worth,
                        int *moves) {
  CwStatus status = CW_OK;
  CwPlanPart half = {0};
  Worth below[2];
  *moves = 0;
  if (node < 0) {
    *worth = weigh_region(model, plan, part, -1 - node);
    goto done;
  }
  for (int s = 0; s < 2; s++) {
    CW_TRY(cw_plan_part_clip(model, part, &plan->node[node].plane, s, &half));
    int moved_below;
    CW_TRY(improve(model, plan, &half, plan->node[node].child[s], &below[s], &moved_below));
    cw_plan_part_free(&half);
    *moves |= moved_below;
  }
  if (regions_of(plan, node) > REGIONS_MOST) goto done;
  if (*moves) { // what one side was worth beside the planes of the other as they were
    CW_TRY(weigh(model, plan, part, node, INFINITY, worth));
  } else {
    CW_TRY(weigh_plane(model, plan, part, node, INFINITY, worth));
    for (int s = 0; s < 2; s++) add_worth(&below[s], worth);
  }
  CW_TRY(improve_plane(model, plan, part, node, worth, moves));
done:
  cw_plan_part_free(&half);
  return status;
}

CwStatus cw_plan_improve(const CwPlanModel *model, CwPlan *plan, const CwPlanPart *part, int32_t node) {
  Worth worth;
  int moves;
  return improve(model, plan, part, node, &worth, &moves);
}
