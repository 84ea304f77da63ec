// SPDX-License-Identifier: AGPL-3.0-or-later
// Where the planes of a sector decomposition stand.
#include "mesher/plan/sector_plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/cad/symmetry.h"
#include "mesher/parallel/schedule.h"
#include "mesher/plan/plan_axis.h"
#include "mesher/plan/plan_cost.h"
#include "mesher/plan/plan_divide.h"
#include "mesher/plan/plan_lines.h"
#include "mesher/plan/plan_profile.h"
#include "mesher/plan/plan_slices.h"

enum {
  STATIONS = 80, // places tried for the plane across the axis
  REFUSED = 2,   // places to either side of one that are refused with it
  ANGLES = 120,  // places tried for half-planes in one pitch
  TOUCHES = 4096 // places along the axis where planes across it are known to touch edges
};
// Numbers of regions in a pitch that are weighed, and tried where a plan has more than a fault.
enum { NUMBERS = 10, NUMBERS_TRIED = 4 };

typedef struct {
  double cost, worst;
} Judged;

typedef struct {
  const CwPlanModel *model;
  CwPlan *plan;
  int32_t count;
  int32_t slices_most;
  CwPlanAxis axis;
  CwPlanProfile along;               // the domain along up * z
  double touch[TOUCHES], touch_step; // of planes across the axis (cw_plan_touch), from `low` to `high`
  uint8_t refused[STATIONS];         // places of the plane across the axis before which no half-planes fit
  int station;                       // that of the present one
  Judged judged[ANGLES];             // half-planes, once they were judged
  int is_judged;
} Sectors;

static CwPlane across(const Sectors *sectors, double place) {
  return (CwPlane){{0, 0, sectors->axis.up}, place};
}

// What a plane across the axis costs.
static double judge_across(const Sectors *sectors, double place, double *worst) {
  CwPlanPlace found = cw_profile_at(&sectors->along, cw_profile_bin(&sectors->along, place));
  double touch = round((place - sectors->axis.low) / sectors->touch_step);
  *worst = found.worst;
  return cw_plan_place_cost(found) + cw_plan_touch_cost(sectors->touch[(int)fmin(fmax(touch, 0), TOUCHES - 1)]);
}

static CwPlane half_plane(double angle) {
  return (CwPlane){{-sin(angle), cos(angle), 0}, 0};
}

// What a half-plane through `wheel`, the part beyond the plane across the axis, costs.
static CwStatus judge_half_plane(const Sectors *sectors, const CwPlanPart *wheel, double angle, Judged *judged) {
  CwStatus status = CW_OK;
  CwPlan *plan = sectors->plan;
  CwPlane plane = half_plane(angle);
  plan->node[plan->sector_first].plane = plane;
  CwPlane end = cw_sector_end(plan, plan->sector_first);
  CwPlanPlace place = cw_plan_place(sectors->model, wheel, &plane, &end);
  CwPlanLines lines;
  CW_TRY(cw_plan_lines(sectors->model, plan, plan->sector_first, wheel, &plane, INFINITY, &lines));
  double touch = cw_plan_touch_cost(cw_plan_touch(sectors->model, wheel, &plane, &end));
  *judged = (Judged){cw_plan_place_cost(place) + touch + lines.cost, place.worst};
done:
  return status;
}

// The side of the pipe in steps of equal work, from node 0 outwards.
static double step_place(const Sectors *sectors, int32_t slices, int32_t step) {
  double all = cw_profile_below(&sectors->along, sectors->plan->node[0].plane.offset);
  return cw_profile_place(&sectors->along, all * (1 - (double)step / (slices * CW_SLICE_STEPS)));
}

// Places of the planes between slices of `mean` work, as steps.
static CwStatus find_slices(const Sectors *sectors, int32_t slices, double mean, int32_t *step, double *cost) {
  CwStatus status = CW_OK;
  int32_t steps = slices * CW_SLICE_STEPS;
  double *place_cost = NULL, uneven[CW_SLICE_MOST + 1] = {0}, worst;
  double all = cw_profile_below(&sectors->along, sectors->plan->node[0].plane.offset);
  CW_NEW(place_cost, steps + 1);
  for (int32_t s = 1; s <= CW_SLICE_MOST; s++) uneven[s] = cw_plan_slice_cost(all * s / steps, mean);
  for (int32_t s = 1; s < steps; s++) place_cost[s] = judge_across(sectors, step_place(sectors, slices, s), &worst);
  CW_TRY(cw_slices_place(slices, uneven, place_cost, step, cost));
done:
  free(place_cost);
  return status;
}

// Divides the side of the pipe into slices of about `mean` work: planes 1 .. slices - 1 in a chain from node 0
// outwards.
static CwStatus place_slices(Sectors *sectors, int32_t slices, double mean, double *cost) {
  CwStatus status = CW_OK;
  CwPlan *plan = sectors->plan;
  int32_t *step = NULL;
  double all = cw_profile_below(&sectors->along, plan->node[0].plane.offset);
  CW_NEW(step, slices + 1);
  CW_TRY(find_slices(sectors, slices, mean, step, cost));
  plan->node[0].child[0] = -1; // with one slice alone
  for (int32_t i = 1; i <= slices; i++) {
    plan->predicted_cells[slices - i] = all * (step[i] - step[i - 1]) / (slices * CW_SLICE_STEPS);
    if (i == slices) break;
    CwPlane plane = across(sectors, step_place(sectors, slices, step[i]));
    plan->node[i] = (CwPlanNode){plane, i - 1, {-1, -1 - (slices - i)}, 0};
    plan->node[i - 1].child[0] = i;
    judge_across(sectors, plane.offset, &plan->node[i].worst);
  }
  plan->node_count = plan->region_count = slices;
done:
  free(step);
  return status;
}

// A place tried for the plane across the axis.
static double station_place(const Sectors *sectors, int station) {
  return sectors->axis.nose + (sectors->axis.high - sectors->axis.nose) * station / STATIONS;
}

// The plane across the axis and those between slices: as little as can be before it, for that is meshed whole, and
// slices that are as large as the regions of a pitch (0: one slice as it comes).
static CwStatus place_root(Sectors *sectors, int32_t regions, int32_t *slices, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwPlan *plan = sectors->plan;
  double all = sectors->along.below[CW_PROFILE_BINS], chosen = 0, best = INFINITY, cost;
  *slices = 1;
  for (int i = 1; i < STATIONS; i++) {
    double place = station_place(sectors, i);
    double before = cw_profile_below(&sectors->along, place), alone = before * (sectors->count - 1) / all;
    if (!(before > 0 && before < all) || alone >= best || sectors->refused[i]) continue;
    plan->node[0] = (CwPlanNode){across(sectors, place), -1, {-1, 1}, 0};
    alone += judge_across(sectors, place, &plan->node[0].worst);
    if (regions == 0 && alone < best) best = alone, chosen = place, sectors->station = i;
    double pitch = (all - before) / sectors->count;
    int32_t few = (int32_t)fmax(1, floor(before / pitch * regions));
    for (int32_t count = few; count <= few + 1 && count <= sectors->slices_most && regions && alone < best; count++) {
      double mean = all / (count + sectors->count * regions);
      CW_TRY(place_slices(sectors, count, mean, &cost));
      cost += alone + cw_plan_unevenness(pitch, regions * mean, regions);
      if (cost < best) best = cost, chosen = place, *slices = count, sectors->station = i;
    }
  }
  CW_END_UNLESS(best < INFINITY, outcome, CW_OUTCOME_ASYMMETRIC, NULL, "no plane across the axis fits");
  plan->node[0] = (CwPlanNode){across(sectors, chosen), -1, {-1, 1}, 0};
  judge_across(sectors, chosen, &plan->node[0].worst);
  double before = cw_profile_below(&sectors->along, chosen);
  CW_TRY(place_slices(sectors, *slices, regions > 0 ? all / (*slices + sectors->count * regions) : before, &cost));
done:
  return status;
}

typedef struct {
  const Sectors *sectors;
  const CwPlanPart *part;
} Wheel;

static CwStatus judge_angle(void *context, int32_t i, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  const Wheel *wheel = context;
  Judged *made = NULL;
  CW_NEW(made, 1);
  CW_TRY(judge_half_plane(wheel->sectors, wheel->part, 2 * M_PI / wheel->sectors->count * (i + 0.5) / ANGLES, made));
  *bytes = made;
  *size = sizeof *made;
done:
  if (status != CW_OK) free(made);
  return status;
}

// All half-planes of one pitch, shared among the ranks.
static CwStatus judge_half_planes(Sectors *sectors, const CwPlanPart *part) {
  CwStatus status = CW_OK;
  Wheel wheel = {sectors, part};
  CwTaskResults results = {0};
  CwSchedule schedule = {.step = "decomposition", .count = ANGLES, .run = judge_angle, .context = &wheel};
  CW_TRY(cw_schedule_gather(sectors->model->context, &schedule, &results));
  for (int i = 0; i < ANGLES; i++) memcpy(&sectors->judged[i], results.bytes[i], sizeof sectors->judged[i]);
  sectors->is_judged = 1;
done:
  cw_task_results_free(&results);
  return status;
}

// The half-planes: `wedges` in each pitch, evenly, where they cost least. *fits: 0 where there are none.
static CwStatus place_sectors(Sectors *sectors, const CwPlanPart *wheel, int wedges, int *fits) {
  CwStatus status = CW_OK;
  CwPlan *plan = sectors->plan;
  const Judged *judged = sectors->judged;
  double pitch = 2 * M_PI / sectors->count, best = INFINITY;
  int apart = ANGLES / wedges, chosen = 0;
  plan->sector_first = plan->sector_region = plan->node_count;
  plan->node[0].child[1] = plan->sector_first;
  plan->node[plan->sector_first].parent = 0;
  plan->sector_count = 1; // for the judges
  if (!sectors->is_judged) CW_TRY(judge_half_planes(sectors, wheel));
  for (int start = 0; start < apart; start++) {
    double sum = 0;
    for (int w = 0; w < wedges; w++) sum += judged[start + w * apart].cost;
    if (sum < best) best = sum, chosen = start;
  }
  *fits = best < INFINITY;
  if (!*fits) goto done;
  plan->sector_count = wedges * sectors->count;
  plan->sector_turns = sectors->count;
  plan->node_count += plan->sector_count;
  for (int32_t j = 0; j < plan->sector_count; j++) {
    int at = chosen + j % wedges * apart;
    CwPlanNode *node = &plan->node[plan->sector_first + j];
    CwPlane first = half_plane(pitch * (at + 0.5) / ANGLES);
    *node = (CwPlanNode){first, 0, {INT32_MIN, INT32_MIN}, judged[at].worst}; // children not known yet
    cw_symmetry_turn(sectors->count, j / wedges, first.normal, node->plane.normal);
  }
done:
  return status;
}

// Divides the wedges of the first pitch into regions of about so much work.
static CwStatus divide_wedges(const Sectors *sectors, const CwPlanPart *wheel, int wedges, double region) {
  CwStatus status = CW_OK;
  CwPlan *plan = sectors->plan;
  CwPlanPart after = {0}, wedge = {0};
  for (int32_t w = plan->sector_first; w < plan->sector_first + wedges; w++) {
    int32_t next = plan->sector_first + (w - plan->sector_first + 1) % plan->sector_count;
    CW_TRY(cw_plan_part_clip(sectors->model, wheel, &plan->node[w].plane, 1, &after));
    CW_TRY(cw_plan_part_clip(sectors->model, &after, &plan->node[next].plane, 0, &wedge));
    cw_plan_part_free(&after);
    CW_TRY(cw_plan_divide(sectors->model, plan, &wedge, (int32_t)fmax(1, floor(wedge.work / region + 0.5)), w, 1));
  }
done:
  cw_plan_part_free(&after);
  cw_plan_part_free(&wedge);
  return status;
}

static int32_t turned_child(int32_t child, int32_t nodes, int32_t regions) {
  return child >= 0 ? child + nodes : child - regions;
}

// The wedges of the other pitches, as periodic images.
static void turn_wedges(const Sectors *sectors, int wedges) {
  CwPlan *plan = sectors->plan;
  int32_t first = plan->sector_first + plan->sector_count, nodes = plan->node_count - first;
  int32_t regions = plan->region_count - plan->sector_region;
  for (int32_t turns = 1; turns < sectors->count; turns++) {
    for (int32_t i = 0; i < nodes; i++) {
      const CwPlanNode *source = &plan->node[first + i];
      CwPlanNode *copy = &plan->node[plan->node_count++];
      int32_t parent = source->parent + turns * (source->parent < first ? wedges : nodes);
      *copy = (CwPlanNode){.plane.offset = source->plane.offset, .parent = parent, .worst = source->worst};
      cw_symmetry_turn(sectors->count, turns, source->plane.normal, copy->plane.normal);
      for (int s = 0; s < 2; s++) copy->child[s] = turned_child(source->child[s], turns * nodes, turns * regions);
    }
    for (int w = 0; w < wedges; w++) {
      int32_t source = plan->sector_first + w;
      plan->node[source + turns * wedges].child[1] =
          turned_child(plan->node[source].child[1], turns * nodes, turns * regions);
    }
    for (int32_t r = 0; r < regions; r++) {
      plan->predicted_cells[plan->region_count++] = plan->predicted_cells[plan->sector_region + r];
    }
  }
  for (int32_t j = 0; j < plan->sector_count; j++) {
    plan->node[plan->sector_first + (j + 1) % plan->sector_count].child[0] =
        plan->node[plan->sector_first + j].child[1];
  }
}

// Makes the predicted cells of some regions sum up to what they are together.
static void make_sum(CwPlan *plan, int32_t first, int32_t end, double wanted) {
  double sum = 0;
  for (int32_t r = first; r < end; r++) sum += plan->predicted_cells[r];
  for (int32_t r = first; r < end; r++) plan->predicted_cells[r] *= wanted / sum;
}

static double station_cut(const Sectors *sectors, int station) {
  return sectors->along.cut[cw_profile_bin(&sectors->along, station_place(sectors, station))];
}

// Refuses the place of the plane across the axis, those beside it, and those where the plane would cut more of the
// layers along edges: then the domain had better be meshed whole.
static void refuse_station(Sectors *sectors) {
  double cut = station_cut(sectors, sectors->station);
  for (int i = 0; i < STATIONS; i++)
    sectors->refused[i] |= abs(i - sectors->station) <= REFUSED || station_cut(sectors, i) > cut;
  sectors->is_judged = 0;
}

// The plane across the axis, and half-planes that fit the part beyond it, `wheel`.
static CwStatus place_planes(Sectors *sectors, const CwPlanPart *whole, int32_t regions, int wedges, int32_t *slices,
                             CwPlanPart *wheel, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  for (int fits = 0; !fits;) {
    CW_TRY_STAGE(place_root(sectors, regions, slices, outcome), outcome);
    cw_plan_part_free(wheel);
    CW_TRY(cw_plan_part_clip(sectors->model, whole, &sectors->plan->node[0].plane, 1, wheel));
    CW_TRY(place_sectors(sectors, wheel, wedges, &fits));
    if (!fits) refuse_station(sectors);
  }
done:
  return status;
}

// The plan with so many regions in one pitch.
static CwStatus divide(Sectors *sectors, CwPlanModel *model, const CwPlanPart *whole, int32_t regions,
                       CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwPlanPart wheel = {0};
  int32_t slices;
  int wedges = sectors->count == 2 ? 2 : 1; // a wedge is narrower than half a turn
  CW_TRY_STAGE(place_planes(sectors, whole, regions, wedges, &slices, &wheel, outcome), outcome);
  model->mean_work = whole->work / (slices + sectors->count * regions);
  CW_TRY(divide_wedges(sectors, &wheel, wedges, wheel.work / sectors->count / regions));
  // The samples of all pitches together tell the work of one better than its own.
  make_sum(sectors->plan, 0, slices, whole->work - wheel.work);
  make_sum(sectors->plan, slices, sectors->plan->region_count, wheel.work / sectors->count);
  turn_wedges(sectors, wedges);
done:
  cw_plan_part_free(&wheel);
  return status;
}

// The worst fault of a plan: of its regions' work, and of the angles between planes within the wedges and walls.
static double worst_fault(const CwPlan *plan) {
  double sum = 0, most = 0, worst = 1;
  for (int32_t r = 0; r < plan->region_count; r++) sum += plan->predicted_cells[r];
  for (int32_t r = 0; r < plan->region_count; r++) {
    double work = plan->predicted_cells[r], mean = sum / plan->region_count;
    most = fmax(most, r < plan->sector_region ? cw_plan_slice_cost(work, mean) : cw_plan_unevenness(work, mean, 1));
  }
  for (int32_t n = plan->sector_first; n < plan->node_count; n++) worst = fmin(worst, plan->node[n].worst);
  return fmax(most, cw_plan_sharpness(worst));
}

// A number of regions in one pitch, and what it costs.
typedef struct {
  int32_t regions;
  double cost;
} Number;

static int by_cost(const void *a, const void *b) {
  const Number *p = a, *q = b;
  return p->cost != q->cost ? (p->cost < q->cost ? -1 : 1) : (p->regions > q->regions) - (p->regions < q->regions);
}

// What the slices and the planes across the axis that are in the plan cost.
static double pipe_cost(const Sectors *sectors, int32_t slices, double mean) {
  const CwPlan *plan = sectors->plan;
  double off = 0, worst = 1;
  for (int32_t i = 0; i < slices; i++) {
    off = fmax(off, cw_plan_slice_cost(plan->predicted_cells[i], mean));
    worst = fmin(worst, plan->node[i].worst);
  }
  return off + cw_plan_sharpness(worst);
}

// What another number of regions than the asked one costs: a fault where it is twice or half as many.
static double other_number(double regions, int32_t asked) {
  return fabs(log(regions / asked)) / M_LN2;
}

// The numbers of regions in one pitch that bring the plan near the asked number, best first: those with which regions
// and slices would be about as large if `pipe` were the work of the slices, and of these, those with the best slices.
static CwStatus weigh_numbers(Sectors *sectors, double pipe, double pitch, int32_t asked, Number number[NUMBERS],
                              int32_t *count, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  Number *all = NULL;
  double whole = pipe + sectors->count * pitch, wanted = pitch / whole * asked;
  int32_t least = (int32_t)fmax(1, 0.85 * wanted), found = 0;
  int32_t most = (int32_t)fmax(1, fmin(2 * wanted, ceil(1.15 * wanted) + 1));
  CW_NEW(all, most - least + 1);
  for (int32_t n = least; n <= most; n++) {
    double slices = fmax(1, round(pipe / pitch * n)), regions = slices + sectors->count * n, mean = whole / regions;
    double off = fmax(fabs(pipe / slices / mean - 1), fabs(pitch / n / mean - 1));
    all[found++] = (Number){n, cw_plan_unevenness(off + 1, 1, 1) + other_number(regions, asked)};
  }
  qsort(all, (size_t)found, sizeof *all, by_cost);
  *count = found < NUMBERS ? found : NUMBERS;
  int32_t weighed = *count > 1 ? *count : 0; // one alone is taken
  for (int32_t i = 0; i < weighed; i++) {
    int32_t slices;
    CW_TRY_STAGE(place_root(sectors, all[i].regions, &slices, outcome), outcome);
    int32_t regions = slices + sectors->count * all[i].regions;
    all[i].cost = pipe_cost(sectors, slices, whole / regions) + other_number(regions, asked);
  }
  qsort(all, (size_t)*count, sizeof *all, by_cost);
  memcpy(number, all, (size_t)*count * sizeof *number);
done:
  free(all);
  return status;
}

CwStatus cw_sector_plan_make(const CwContext *context, const CwCad *cad, const CwBackground *background,
                             const CwVerticals *inside, const CwSize *size, const CwPlanOptions *options, int32_t count,
                             CwPlan *plan, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwPlanModel model = {0};
  CwPlanPart whole = {0};
  CwPlan tried = {0};
  Sectors sectors = {.model = &model, .plan = &tried, .count = count, .slices_most = options->region_count};
  Number number[NUMBERS];
  size_t room = 3 * (size_t)options->region_count + 4 * (size_t)count;
  double least = INFINITY;
  int32_t slices, numbers = 0;
  CW_TRY(cw_plan_new(room, plan));
  CW_TRY(cw_plan_new(room, &tried));
  CW_TRY(cw_plan_model_make(context, cad, background, inside, size, options, &model));
  CW_TRY(cw_plan_part_whole(&model, &whole));
  CW_END_UNLESS(cw_plan_axis_find(background, inside, &sectors.axis), outcome, CW_OUTCOME_ASYMMETRIC, NULL,
                "fluid on the axis at both ends");
  CwPlane along = across(&sectors, 0);
  cw_plan_profile(&model, &whole, along.normal, INT32_MAX, &sectors.along);
  sectors.touch_step = (sectors.axis.high - sectors.axis.low) / (TOUCHES - 1);
  cw_plan_touches(&model, &whole, along.normal, sectors.axis.low, sectors.touch_step, TOUCHES, sectors.touch);
  CW_TRY_STAGE(place_root(&sectors, 0, &slices, outcome), outcome);
  double pipe = cw_profile_below(&sectors.along, tried.node[0].plane.offset), pitch = (whole.work - pipe) / count;
  CW_TRY_STAGE(weigh_numbers(&sectors, pipe, pitch, options->region_count, number, &numbers, outcome), outcome);
  for (int k = 0; k < numbers && k < NUMBERS_TRIED && least > CW_PLAN_FAULT; k++) {
    CW_TRY_STAGE(divide(&sectors, &model, &whole, number[k].regions, outcome), outcome);
    double bad = worst_fault(&tried);
    if (bad >= least) continue;
    CwPlan better = tried;
    tried = *plan;
    *plan = better;
    least = bad;
  }
done:
  cw_plan_part_free(&whole);
  cw_plan_model_free(&model);
  cw_plan_free(&tried);
  if (status != CW_OK || outcome->kind != CW_OUTCOME_DONE) cw_plan_free(plan);
  return status;
}
