// SPDX-License-Identifier: AGPL-3.0-or-later
// Where the planes of a fan stand.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/fan.h"
#include "mesher/plan_score.h"
#include "mesher/symmetry.h"
#include "mesher/vec.h"

enum {
  AXIS_SAMPLES = 400,
  STATIONS = 80,   // places tried for the plane across the axis
  ANGLES = 120,    // places tried for half-planes in one pitch
  WEDGES_MOST = 16 // in one pitch
};
static const double SHARP_PLANE = 0.7; // least plane-to-wall measure of a plane that is not penalised
static const double BAD = 2;           // a plane with this penalty is taken only where all have it
static const double WINDOW = 0.35;     // how far a half-plane may stand off its even place, in even wedges

typedef struct {
  const CwPlanScorer *scorer;
  CwPlan *plan;
  int32_t count;
  double up;         // 1: z grows from pipe to impeller, -1: it falls
  double low, nose, high; // along up * z: ends of the domain, end of the fluid on the axis, m
  double reach;      // greatest distance of fluid from the origin, m
} Fan;

// Least sqrt(1 - (n.m)^2) over the walls that the plane crosses on the side reach.x > 0, beyond `from` along up * z.
static double wall_angle(const Fan *fan, const CwPlane *plane, const double reach[3], double from) {
  const CwPlanScorer *scorer = fan->scorer;
  const CwBackground *background = scorer->background;
  double worst = 1;
  for (int32_t t = 0; t < background->triangle_count; t++) {
    if (scorer->density[t] == 0 || cw_dot(scorer->centre[t], reach) < 0 || fan->up * scorer->centre[t][2] < from) continue;
    int above = 0;
    for (int k = 0; k < 3; k++) above += cw_plane_distance(plane, background->x[background->triangle[t][k]]) > 0;
    if (above == 0 || above == 3) continue;
    double dot = cw_dot(plane->normal, scorer->normal[t]);
    worst = fmin(worst, sqrt(fmax(0, 1 - dot * dot)));
  }
  return worst;
}

static double penalty_of(double worst, int32_t grazed, int lines) {
  if (lines == 2) return INFINITY;
  return 1 - worst + (worst < SHARP_PLANE ? BAD : 0) + (grazed ? 3 + 0.02 * grazed : 0) + (lines ? 4 : 0);
}

static CwPlane across(const Fan *fan, double place) {
  return (CwPlane){{0, 0, fan->up}, place};
}

// Penalty of the plane of `node` across the axis.
static double judge_across(const Fan *fan, int32_t node, double place, double *worst) {
  static const double ANYWHERE[3] = {0, 0, 0};
  CwPlane plane = across(fan, place);
  *worst = wall_angle(fan, &plane, ANYWHERE, -INFINITY);
  return penalty_of(*worst, cw_plan_grazed_edges(fan->scorer, fan->plan, node, &plane), 0);
}

static CwPlane half_plane(double angle) {
  return (CwPlane){{-sin(angle), cos(angle), 0}, 0};
}

static double judge_half_plane(const Fan *fan, double angle, double *worst) {
  CwPlan *plan = fan->plan;
  CwPlane plane = half_plane(angle);
  const double reach[3] = {cos(angle), sin(angle), 0};
  plan->node[plan->fan_first].plane = plane;
  *worst = wall_angle(fan, &plane, reach, plan->node[0].plane.offset);
  int32_t grazed = cw_plan_grazed_edges(fan->scorer, plan, plan->fan_first, &plane);
  double penalty = penalty_of(*worst, grazed, 0);
  if (penalty >= BAD) return penalty; // the lines cost most of the time
  return penalty_of(*worst, grazed, cw_plan_judge_lines(fan->scorer, plan, plan->fan_first, &plane, fan->reach));
}

// Finds which side of the domain has fluid on the axis; CW_RETRY where both or none have it.
static CwStatus find_axis(Fan *fan) {
  const CwBackground *background = fan->scorer->background;
  double low = INFINITY, high = -INFINITY;
  for (int32_t i = 0; i < background->point_count; i++) {
    low = fmin(low, background->x[i][2]);
    high = fmax(high, background->x[i][2]);
    fan->reach = fmax(fan->reach, cw_norm(background->x[i]));
  }
  double step = (high - low) / AXIS_SAMPLES;
  int wet[AXIS_SAMPLES], runs = 0, last = 0;
  for (int i = 0; i < AXIS_SAMPLES; i++) {
    double x[3] = {0, 0, low + step * (i + 0.5)};
    wet[i] = cw_inside_test(fan->scorer->inside, x);
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

// Work (predicted cells) of samples and wall triangles beyond and before `place` along the axis.
static double work_before(const Fan *fan, double place, double *beyond) {
  const CwPlanScorer *scorer = fan->scorer;
  const CwBackground *background = scorer->background;
  double before = 0;
  *beyond = 0;
  for (int32_t i = 0; i < scorer->sample_count; i++) {
    *(fan->up * scorer->sample_x[i][2] > place ? beyond : &before) += scorer->sample_work[i];
  }
  for (int32_t t = 0; t < background->triangle_count; t++) {
    double u[3], v[3], n[3];
    cw_sub(background->x[background->triangle[t][1]], background->x[background->triangle[t][0]], u);
    cw_sub(background->x[background->triangle[t][2]], background->x[background->triangle[t][0]], v);
    cw_cross(u, v, n);
    *(fan->up * scorer->centre[t][2] > place ? beyond : &before) += scorer->density[t] * cw_norm(n) / 2;
  }
  return before;
}

// The plane across the axis: as little as can be before it, for that is meshed whole.
static CwStatus place_root(Fan *fan) {
  CwPlan *plan = fan->plan;
  double best = INFINITY;
  plan->node[0].parent = -1;
  for (int i = 1; i < STATIONS; i++) {
    double place = fan->nose + (fan->high - fan->nose) * i / STATIONS, worst, beyond;
    double before = work_before(fan, place, &beyond);
    double score = (before * fan->count + beyond) / (before + beyond) - 1;
    if (!(before > 0 && beyond > 0) || score >= best) continue;
    score += judge_across(fan, 0, place, &worst);
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
  double top = plan->node[0].plane.offset, beyond, all = work_before(fan, top, &beyond), from = top;
  for (int32_t i = 1; i < slices; i++) {
    double best = INFINITY, chosen = from;
    plan->node[i].parent = i - 1;
    for (int s = 1; s < STATIONS; s++) {
      double place = top + (fan->low - top) * s / STATIONS, worst;
      if (place >= from) continue;
      double share = work_before(fan, place, &beyond) / all * slices; // in slices; wanted: slices - i
      double score = 4 * fabs(share - (slices - i));
      if (score >= best) continue;
      score += judge_across(fan, i, place, &worst);
      if (score >= best) continue;
      best = score;
      chosen = place;
      plan->worst_angle[i] = worst;
    }
    plan->node[i] = (CwPlanNode){across(fan, chosen), i - 1, {-1, -1 - (slices - i)}};
    plan->node[i - 1].child[0] = i;
    from = chosen;
  }
  double inner = all;
  for (int32_t i = 1; i <= slices; i++) {
    double outer = i < slices ? work_before(fan, plan->node[i].plane.offset, &beyond) : 0;
    plan->predicted_cells[slices - i] = inner - outer;
    inner = outer;
  }
}

// Share of the work of the fan's side below each of ANGLES angles of one pitch, from 0.
static void share_by_angle(const Fan *fan, double share[ANGLES + 1]) {
  const CwPlanScorer *scorer = fan->scorer;
  const CwBackground *background = scorer->background;
  double pitch = 2 * M_PI / fan->count, place = fan->plan->node[0].plane.offset, sum = 0;
  memset(share, 0, (ANGLES + 1) * sizeof *share);
  for (int32_t i = 0; i < scorer->sample_count + background->triangle_count; i++) {
    int32_t t = i - scorer->sample_count;
    const double *x = t < 0 ? scorer->sample_x[i] : scorer->centre[t];
    double work = t < 0 ? scorer->sample_work[i] : scorer->density[t];
    if (fan->up * x[2] <= place) continue;
    if (t >= 0) {
      double u[3], v[3], n[3];
      cw_sub(background->x[background->triangle[t][1]], background->x[background->triangle[t][0]], u);
      cw_sub(background->x[background->triangle[t][2]], background->x[background->triangle[t][0]], v);
      cw_cross(u, v, n);
      work *= cw_norm(n) / 2;
    }
    double folded = fmod(atan2(x[1], x[0]) + 2 * M_PI, pitch);
    int bin = (int)(folded / pitch * ANGLES);
    share[1 + (bin < ANGLES ? bin : ANGLES - 1)] += work;
  }
  for (int i = 1; i <= ANGLES; i++) sum += share[i];
  for (int i = 1; i <= ANGLES; i++) share[i] = share[i - 1] + share[i] / sum;
}

// Share from place 0 up to place `at`, which may be in a later pitch.
static double share_to(const double share[ANGLES + 1], int at) {
  return at / ANGLES + share[at % ANGLES];
}

// Best places of `wedges` half-planes in one pitch; returns the sum of penalties and unbalance, INFINITY where none fit.
static double best_places(const double penalty[ANGLES], const double share[ANGLES + 1], int wedges, int place[]) {
  double least = INFINITY;
  int reach = (int)(WINDOW * ANGLES / wedges), chosen[WEDGES_MOST];
  for (int start = 0; start < ANGLES; start++) {
    double sum = penalty[start];
    chosen[0] = start;
    for (int w = 1; w < wedges && sum < least; w++) {
      double best = INFINITY;
      for (int at = start + ANGLES * w / wedges - reach; at <= start + ANGLES * w / wedges + reach; at++) {
        double wanted = share_to(share, start) + (double)w / wedges;
        double score = penalty[at % ANGLES] + 2 * wedges * fabs(share_to(share, at) - wanted);
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

static CwStatus place_fan(Fan *fan, int32_t slices, int wanted) {
  CwPlan *plan = fan->plan;
  double penalty[ANGLES], worst[ANGLES], share[ANGLES + 1], pitch = 2 * M_PI / fan->count, beyond;
  int place[WEDGES_MOST], wedges = wanted < WEDGES_MOST ? wanted : WEDGES_MOST;
  share_by_angle(fan, share);
  plan->node[plan->fan_first].parent = 0;
  plan->fan_count = 1; // for the judges
  for (int i = 0; i < ANGLES; i++) penalty[i] = judge_half_plane(fan, pitch * (i + 0.5) / ANGLES, &worst[i]);
  int least = fan->count == 2 ? 2 : 1; // a wedge is narrower than half a turn
  if (wedges < least) wedges = least;
  double sum = best_places(penalty, share, wedges, place);
  while (wedges > least && sum >= BAD) sum = best_places(penalty, share, --wedges, place);
  if (!(sum < INFINITY)) return CW_RETRY;
  plan->fan_count = wedges * fan->count;
  plan->fan_region = slices;
  plan->node_count = plan->fan_first + plan->fan_count;
  plan->region_count = slices + plan->fan_count;
  work_before(fan, plan->node[0].plane.offset, &beyond);
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
        beyond / fan->count * (share_to(share, next) - share_to(share, place[w]));
  }
  return CW_OK;
}

CwStatus cw_fan_plan_make(const CwCad *cad, const CwBackground *background, const CwInside *inside, const CwSize *size,
                          const CwPlanOptions *options, int32_t count, CwPlan *plan) {
  CwStatus status = CW_OK;
  CwPlanScorer scorer = {0};
  Fan fan = {.scorer = &scorer, .plan = plan, .count = count};
  memset(plan, 0, sizeof *plan);
  size_t room = (size_t)options->region_count + 1 + (size_t)count * WEDGES_MOST;
  CW_NEW(plan->node, room);
  CW_NEW(plan->worst_angle, room);
  CW_NEW(plan->predicted_cells, room);
  CW_TRY(cw_plan_scorer_make(cad, background, inside, size, options, &scorer));
  status = find_axis(&fan);
  if (status == CW_OK) status = place_root(&fan);
  if (status != CW_OK) goto done;
  double beyond, before = work_before(&fan, plan->node[0].plane.offset, &beyond);
  double region = (before + beyond) / options->region_count;
  int32_t slices = (int32_t)fmax(1, floor(before / region + 0.5));
  plan->fan_first = slices;
  place_slices(&fan, slices);
  status = place_fan(&fan, slices, (int)fmin(WEDGES_MOST, fmax(1, floor(beyond / count / region + 0.5))));
done:
  cw_plan_scorer_free(&scorer);
  if (status != CW_OK) cw_plan_free(plan);
  return status;
}
