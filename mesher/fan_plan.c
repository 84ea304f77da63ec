// SPDX-License-Identifier: AGPL-3.0-or-later
// Where the planes of a fan stand.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/fan.h"
#include "mesher/plan_profile.h"
#include "mesher/plan_score.h"
#include "mesher/symmetry.h"
#include "mesher/vec.h"

enum {
  AXIS_SAMPLES = 400,
  STATIONS = 80,   // places tried for the plane across the axis
  ANGLES = 120,    // places tried for half-planes in one pitch
  WEDGES_MOST = 16 // in one pitch
};
static const double BAD = 2;       // a plane that costs so much is taken only where all do
static const double WINDOW = 0.35; // how far a half-plane may stand off its even place, in even wedges

typedef struct {
  const CwPlanModel *model;
  CwPlan *plan;
  int32_t count;
  double up;              // 1: z grows from pipe to impeller, -1: it falls
  double low, nose, high; // along up * z: ends of the domain, end of the fluid on the axis, m
  CwPlanProfile along;    // the domain along up * z
} Fan;

static CwPlane across(const Fan *fan, double place) {
  return (CwPlane){{0, 0, fan->up}, place};
}

// What a plane across the axis costs.
static double judge_across(const Fan *fan, double place, double *worst) {
  int bin = cw_profile_bin(&fan->along, place);
  *worst = fan->along.worst[bin];
  return cw_plan_place_cost(*worst, fan->along.grazed[bin]);
}

static CwPlane half_plane(double angle) {
  return (CwPlane){{-sin(angle), cos(angle), 0}, 0};
}

// What a half-plane through `wheel`, the part beyond the plane across the axis, costs.
static CwStatus judge_half_plane(const Fan *fan, const CwPlanPart *wheel, double angle, double *cost, double *worst) {
  CwStatus status = CW_OK;
  CwPlan *plan = fan->plan;
  CwPlanPart half = {0};
  CwPlanProfile profile;
  CwPlane plane = half_plane(angle);
  plan->node[plan->fan_first].plane = plane;
  CwPlane end = cw_fan_end(plan, plan->fan_first);
  CW_TRY(cw_plan_part_clip(fan->model, wheel, &end, 1, &half));
  cw_plan_profile(fan->model, &half, plane.normal, &profile);
  int bin = cw_profile_bin(&profile, 0);
  *worst = profile.worst[bin];
  *cost = cw_plan_place_cost(*worst, profile.grazed[bin]);
  if (*cost >= BAD) goto done; // the lines take most of the time
  CwPlanLines lines = cw_plan_lines(fan->model, plan, plan->fan_first, &half, &plane);
  *cost += cw_plan_line_cost(&lines);
done:
  cw_plan_part_free(&half);
  return status;
}

// Finds which side of the domain has fluid on the axis; CW_RETRY where both or none have it.
static CwStatus find_axis(Fan *fan) {
  const CwBackground *background = fan->model->background;
  double low = INFINITY, high = -INFINITY;
  for (int32_t i = 0; i < background->point_count; i++) {
    low = fmin(low, background->x[i][2]);
    high = fmax(high, background->x[i][2]);
  }
  double step = (high - low) / AXIS_SAMPLES;
  int wet[AXIS_SAMPLES], runs = 0, last = 0;
  for (int i = 0; i < AXIS_SAMPLES; i++) {
    double x[3] = {0, 0, low + step * (i + 0.5)};
    wet[i] = cw_inside_test(fan->model->inside, x);
    runs += i > 0 && wet[i] != wet[i - 1];
  }
  if (runs != 1) return CW_RETRY;
  while (wet[last] == wet[0]) last++;
  fan->up = wet[0] ? 1 : -1;
  fan->low = wet[0] ? low : -high;
  fan->high = wet[0] ? high : -low;
  fan->nose = fan->up * (low + step * last);
  return CW_OK;
}

// The plane across the axis: as little as can be before it, for that is meshed whole.
static CwStatus place_root(Fan *fan) {
  CwPlan *plan = fan->plan;
  double best = INFINITY, all = fan->along.below[CW_PROFILE_BINS];
  plan->node[0].parent = -1;
  for (int i = 1; i < STATIONS; i++) {
    double place = fan->nose + (fan->high - fan->nose) * i / STATIONS, worst;
    double before = cw_profile_below(&fan->along, place), score = before * (fan->count - 1) / all;
    if (!(before > 0 && before < all) || score >= best) continue;
    score += judge_across(fan, place, &worst);
    if (score >= best) continue;
    best = score;
    plan->node[0] = (CwPlanNode){across(fan, place), -1, {-1, 1}};
    plan->worst_angle[0] = worst;
  }
  return best < INFINITY ? CW_OK : CW_RETRY;
}

// Divides the side of the pipe into slices of about equal work: planes 1 .. slices - 1 in a chain from node 0 outwards.
static void place_slices(Fan *fan, int32_t slices) {
  CwPlan *plan = fan->plan;
  double top = plan->node[0].plane.offset, all = cw_profile_below(&fan->along, top), from = top, inner = all;
  for (int32_t i = 1; i < slices; i++) {
    double best = INFINITY, chosen = from;
    plan->node[i].parent = i - 1;
    for (int s = 1; s < STATIONS; s++) {
      double place = top + (fan->low - top) * s / STATIONS, worst;
      if (place >= from) continue;
      double share = cw_profile_below(&fan->along, place) / all * slices; // in slices; wanted: slices - i
      double score = 4 * fabs(share - (slices - i));
      if (score >= best) continue;
      score += judge_across(fan, place, &worst);
      if (score >= best) continue;
      best = score;
      chosen = place;
      plan->worst_angle[i] = worst;
    }
    plan->node[i] = (CwPlanNode){across(fan, chosen), i - 1, {-1, -1 - (slices - i)}};
    plan->node[i - 1].child[0] = i;
    from = chosen;
  }
  for (int32_t i = 1; i <= slices; i++) {
    double outer = i < slices ? cw_profile_below(&fan->along, plan->node[i].plane.offset) : 0;
    plan->predicted_cells[slices - i] = inner - outer;
    inner = outer;
  }
}

static void add_share(double share[ANGLES + 1], double pitch, const double x[3], double work) {
  double folded = fmod(atan2(x[1], x[0]) + 2 * M_PI, pitch);
  int bin = (int)(folded / pitch * ANGLES);
  share[1 + (bin < ANGLES ? bin : ANGLES - 1)] += work;
}

// Share of the work of a part below each of ANGLES angles of one pitch, from 0.
static void share_by_angle(const Fan *fan, const CwPlanPart *part, double share[ANGLES + 1]) {
  const CwPieces *pieces = &part->pieces;
  double pitch = 2 * M_PI / fan->count;
  memset(share, 0, (ANGLES + 1) * sizeof *share);
  for (int32_t i = 0; i < part->sample_count; i++) {
    add_share(share, pitch, fan->model->sample_x[part->sample[i]], fan->model->sample_work[part->sample[i]]);
  }
  for (int32_t i = 0; i < pieces->count; i++) {
    double centre[3] = {0, 0, 0};
    for (int32_t c = pieces->start[i]; c < pieces->start[i + 1]; c++) {
      for (int k = 0; k < 3; k++) centre[k] += pieces->corner[c][k]; // its length does not matter
    }
    add_share(share, pitch, centre, pieces->work[i]);
  }
  for (int i = 1; i <= ANGLES; i++) share[i] = share[i - 1] + share[i] / part->work;
}

// Share from place 0 up to place `at`, which may be in a later pitch.
static double share_to(const double share[ANGLES + 1], int at) {
  return at / ANGLES + share[at % ANGLES];
}

// Best places of `wedges` half-planes in one pitch; returns the sum of costs and unbalance, INFINITY where none fit.
static double best_places(const double cost[ANGLES], const double share[ANGLES + 1], int wedges, int place[]) {
  double least = INFINITY;
  int reach = (int)(WINDOW * ANGLES / wedges), chosen[WEDGES_MOST];
  for (int start = 0; start < ANGLES; start++) {
    double sum = cost[start];
    chosen[0] = start;
    for (int w = 1; w < wedges && sum < least; w++) {
      double best = INFINITY;
      for (int at = start + ANGLES * w / wedges - reach; at <= start + ANGLES * w / wedges + reach; at++) {
        double wanted = share_to(share, start) + (double)w / wedges;
        double score = cost[at % ANGLES] + 2 * wedges * fabs(share_to(share, at) - wanted);
        if (score >= best) continue;
        best = score;
        chosen[w] = at;
      }
      sum += best;
    }
    if (sum >= least) continue;
    least = sum;
    memcpy(place, chosen, (size_t)wedges * sizeof *place);
  }
  return least;
}

static CwStatus place_fan(Fan *fan, const CwPlanPart *wheel, int32_t slices, int wanted) {
  CwStatus status = CW_OK;
  CwPlan *plan = fan->plan;
  double cost[ANGLES], worst[ANGLES], share[ANGLES + 1], pitch = 2 * M_PI / fan->count;
  int place[WEDGES_MOST], wedges = wanted < WEDGES_MOST ? wanted : WEDGES_MOST;
  share_by_angle(fan, wheel, share);
  plan->node[plan->fan_first].parent = 0;
  plan->fan_count = 1; // for the judges
  for (int i = 0; i < ANGLES; i++) {
    CW_TRY(judge_half_plane(fan, wheel, pitch * (i + 0.5) / ANGLES, &cost[i], &worst[i]));
  }
  int least = fan->count == 2 ? 2 : 1; // a wedge is narrower than half a turn
  if (wedges < least) wedges = least;
  double sum = best_places(cost, share, wedges, place);
  while (wedges > least && sum >= BAD) sum = best_places(cost, share, --wedges, place);
  if (!(sum < INFINITY)) {
    status = CW_RETRY;
    goto done;
  }
  plan->fan_count = wedges * fan->count;
  plan->fan_region = slices;
  plan->node_count = plan->fan_first + plan->fan_count;
  plan->region_count = slices + plan->fan_count;
  plan->node[0].child[1] = plan->fan_first;
  for (int32_t j = 0; j < plan->fan_count; j++) {
    int w = (int)(j % wedges), next = w + 1 < wedges ? place[w + 1] : place[0] + ANGLES;
    CwPlanNode *node = &plan->node[plan->fan_first + j];
    CwPlane first = half_plane(pitch * (place[w] + 0.5) / ANGLES);
    node->plane = first;
    cw_symmetry_turn(fan->count, j / wedges, first.normal, node->plane.normal);
    node->parent = 0;
    node->child[0] = -1 - (plan->fan_region + (j + plan->fan_count - 1) % plan->fan_count);
    node->child[1] = -1 - (plan->fan_region + j);
    plan->worst_angle[plan->fan_first + j] = worst[place[w] % ANGLES];
    plan->predicted_cells[plan->fan_region + j] =
        wheel->work / fan->count * (share_to(share, next) - share_to(share, place[w]));
  }
done:
  return status;
}

CwStatus cw_fan_plan_make(const CwCad *cad, const CwBackground *background, const CwInside *inside, const CwSize *size,
                          const CwPlanOptions *options, int32_t count, CwPlan *plan) {
  CwStatus status = CW_OK;
  CwPlanModel model = {0};
  CwPlanPart whole = {0}, wheel = {0};
  Fan fan = {.model = &model, .plan = plan, .count = count};
  memset(plan, 0, sizeof *plan);
  size_t room = (size_t)options->region_count + 1 + (size_t)count * WEDGES_MOST;
  CW_NEW(plan->node, room);
  CW_NEW(plan->worst_angle, room);
  CW_NEW(plan->predicted_cells, room);
  CW_TRY(cw_plan_model_make(cad, background, inside, size, options, &model));
  CW_TRY(cw_plan_part_whole(&model, &whole));
  CW_TRY(find_axis(&fan));
  CwPlane along = across(&fan, 0);
  cw_plan_profile(&model, &whole, along.normal, &fan.along);
  CW_TRY(place_root(&fan));
  CW_TRY(cw_plan_part_clip(&model, &whole, &plan->node[0].plane, 1, &wheel));
  double region = whole.work / options->region_count;
  int32_t slices = (int32_t)fmax(1, floor((whole.work - wheel.work) / region + 0.5));
  plan->fan_first = slices;
  place_slices(&fan, slices);
  int wedges = (int)fmin(WEDGES_MOST, fmax(1, floor(wheel.work / count / region + 0.5)));
  CW_TRY(place_fan(&fan, &wheel, slices, wedges));
done:
  cw_plan_part_free(&wheel);
  cw_plan_part_free(&whole);
  cw_plan_model_free(&model);
  if (status != CW_OK) cw_plan_free(plan);
  return status;
}
