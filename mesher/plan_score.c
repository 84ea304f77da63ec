// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/plan_score.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/plan_profile.h"
#include "mesher/schedule.h"
#include "mesher/vec.h"

enum {
  DIRECTIONS = 120,  // planes parallel to the axis, every 1.5 degrees
  TILTS = 2,         // planes that lean, for parts that no upright one divides well
  LEANING = 36 * TILTS,
  PIECES_LARGE = 8000, // parts of more pieces leave room enough for every other direction
  SPLITS_MOST = 5,   // numbers of regions tried below the plane
  SHIFTS = 8,        // places tried on either side of the even one, wider and wider apart
  SHARED_LEAST = 6000, // pieces and samples of a part whose directions are worth sharing among the ranks
  LINES_JUDGED = 200 // candidates whose lines are looked at, best first
};
static const double SHIFT[3] = {0.015, 0.006, 0.003}; // of the smaller side's work: two or three regions, few, many
static const double WIDER = 6;                       // shifts until they are twice as wide
static const double TILT[TILTS] = {0.35, 0.8};         // rad
static const double WELL = 4;                        // score of a plane that will do
static const double BALANCE_MOST = 0.1;              // share of a region's work past which a plane is hardly wanted
static const double SHARP = 0.643, FAIR = 0.766;     // sines of 40 and 50 degrees

typedef struct {
  double score, offset, worst;
  int32_t direction, below; // regions below
} Candidate;

static int by_score(const void *a, const void *b) {
  const Candidate *p = a, *q = b;
  if (p->score != q->score) return p->score < q->score ? -1 : 1;
  if (p->direction != q->direction) return p->direction < q->direction ? -1 : 1;
  if (p->offset != q->offset) return p->offset < q->offset ? -1 : 1;
  return (p->below > q->below) - (p->below < q->below);
}

static void direction_of(int32_t d, double direction[3]) {
  // A small odd turn keeps the fan of planes off the symmetry planes of the CAD.
  double angle = M_PI * (d + 0.37) / DIRECTIONS, tilt = 0;
  if (d > DIRECTIONS) {
    int32_t leaning = d - DIRECTIONS - 1;
    angle = 2 * M_PI * (leaning / TILTS + 0.37) / (LEANING / TILTS);
    tilt = TILT[leaning % TILTS];
  }
  direction[0] = d == DIRECTIONS ? 0 : cos(tilt) * cos(angle);
  direction[1] = d == DIRECTIONS ? 0 : cos(tilt) * sin(angle);
  direction[2] = d == DIRECTIONS ? 1 : sin(tilt);
}

// What an angle of this sine to a wall or another plane costs.
static double sharpness(double sine) {
  return (1 - sine) + (sine < FAIR ? 1 : 0) + (sine < SHARP ? 2 + 30 * (SHARP - sine) : 0);
}

double cw_plan_place_cost(double worst, double grazed) {
  return sharpness(worst) + fmin(0.5 * grazed, 3) + 0.02 * grazed;
}

double cw_plan_line_cost(const CwPlanLines *lines) {
  return lines->impossible ? INFINITY : 2 * lines->cramped + 2 * lines->blocked + sharpness(lines->sharp);
}

// All but the lines.
static double score_of(const CwPlanModel *model, const CwPlanPart *part, const CwPlanProfile *profile, int32_t regions,
                       int32_t below, double offset, double *worst) {
  int bin = cw_profile_bin(profile, offset);
  double cells = cw_profile_below(profile, offset), all = profile->below[CW_PROFILE_BINS];
  // Against the mean of the whole domain: what one plane leaves uneven the next ones do not hide.
  double load = fmax(fabs(cells / (below * model->mean_work) - 1),
                     fabs((all - cells) / ((regions - below) * model->mean_work) - 1));
  *worst = profile->worst[bin];
  return 6 * load + 30 * fmax(0, load - BALANCE_MOST) + 0.5 * fabs(2.0 * below / regions - 1) +
         0.5 * profile->area[bin] / pow(part->volume, 2.0 / 3) + cw_plan_place_cost(*worst, profile->grazed[bin]);
}

// Numbers of regions to try below the plane: about half of them.
static int32_t splits_of(int32_t regions, int32_t *split) {
  int32_t least = (int32_t)fmax(1, ceil(0.34 * regions)), most = regions - least;
  if (least > most) least = most = regions / 2;
  int32_t count = most - least + 1 < SPLITS_MOST ? most - least + 1 : SPLITS_MOST;
  for (int32_t i = 0; i < count; i++) {
    split[i] = count == 1 ? least : least + (int32_t)((int64_t)(most - least) * i / (count - 1));
  }
  return count;
}

enum { OF_DIRECTION = SPLITS_MOST * (2 * SHIFTS + 2) }; // candidates

static int32_t add_candidates(const CwPlanModel *model, const CwPlanPart *part, int32_t regions, int32_t d,
                              Candidate *candidate) {
  CwPlanProfile profile;
  double direction[3];
  int32_t split[SPLITS_MOST], splits = splits_of(regions, split), count = 0;
  direction_of(d, direction);
  cw_plan_profile(model, part, direction, &profile);
  double all = profile.below[CW_PROFILE_BINS], shift = SHIFT[regions <= 3 ? 0 : regions <= 8 ? 1 : 2];
  if (!(profile.width > 0) || !(all > 0)) return 0;
  for (int32_t i = 0; i < splits; i++) {
    double smaller = fmin(split[i], regions - split[i]) / regions;
    for (int j = -SHIFTS; j <= SHIFTS; j++) {
      Candidate *made = &candidate[count++];
      *made = (Candidate){.direction = d, .below = split[i]};
      double aside = j * (1 + abs(j) / WIDER) * shift * smaller;
      made->offset = cw_profile_place(&profile, all * ((double)split[i] / regions + aside));
      made->score = score_of(model, part, &profile, regions, made->below, made->offset, &made->worst);
    }
    // Through the axis a plane is normal to hub and shroud.
    double share = cw_profile_below(&profile, 0) / all;
    if (d >= DIRECTIONS || fabs(share * regions - split[i]) > 0.2 * smaller * regions) continue;
    Candidate *made = &candidate[count++];
    *made = (Candidate){.direction = d, .below = split[i]};
    made->score = score_of(model, part, &profile, regions, made->below, made->offset, &made->worst);
  }
  return count;
}

// Least sqrt(1 - (n.m)^2) over the wall pieces that the plane crosses, they or their layers: 1 where it stands normal to
// all of them.
static double plane_to_wall(const CwPlanModel *model, const CwPieces *pieces, const CwPlane *plane) {
  double worst = 1;
  for (int32_t i = 0; i < pieces->count; i++) {
    int32_t t = pieces->triangle[i];
    double dot = cw_dot(plane->normal, model->normal[t]), layers = CW_LAYER_ROOM * model->thickness[t] * dot;
    double low = INFINITY, high = -INFINITY;
    for (int32_t c = pieces->start[i]; c < pieces->start[i + 1]; c++) {
      double distance = cw_plane_distance(plane, pieces->corner[c]);
      low = fmin(low, distance - fmax(layers, 0));
      high = fmax(high, distance - fmin(layers, 0));
    }
    if (low <= 0 && high > 0) worst = fmin(worst, sqrt(fmax(0, 1 - dot * dot)));
  }
  return worst;
}

typedef struct {
  CwPlane plane;
  int32_t below;
  double score;
} Best;

// Directions to look along: from, from + every, ...
typedef struct {
  const CwPlanModel *model;
  const CwPlanPart *part;
  int32_t regions, from, every, count;
} Directions;

static CwStatus look_along(void *context, int32_t task, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  const Directions *look = context;
  Candidate *made = NULL;
  CW_NEW(made, OF_DIRECTION);
  int32_t count = add_candidates(look->model, look->part, look->regions, look->from + task * look->every, made);
  *bytes = made;
  *size = count * (int64_t)sizeof *made;
done:
  return status;
}

// The candidates of all directions, in their order; large parts are shared among the ranks.
static CwStatus look(Directions *look, Candidate *candidate, int32_t *count) {
  CwStatus status = CW_OK;
  void **bytes = NULL;
  int64_t *size = NULL;
  *count = 0;
  if (look->part->pieces.count + look->part->sample_count < SHARED_LEAST) {
    for (int32_t i = 0; i < look->count; i++) {
      *count += add_candidates(look->model, look->part, look->regions, look->from + i * look->every, candidate + *count);
    }
    goto done;
  }
  CW_NEW(bytes, look->count);
  CW_NEW(size, look->count);
  CwSchedule schedule = {.step = "decomposition", .count = look->count, .run = look_along, .context = look, .gather = 1};
  CW_TRY(cw_schedule_run(&schedule, bytes, size, NULL));
  for (int32_t i = 0; i < look->count; i++) {
    if (size[i] > 0) memcpy(candidate + *count, bytes[i], (size_t)size[i]);
    *count += (int32_t)(size[i] / (int64_t)sizeof *candidate);
  }
done:
  for (int32_t i = 0; bytes && i < look->count; i++) free(bytes[i]);
  free(bytes);
  free(size);
  return status;
}

// Looks for a better plane among some directions.
static CwStatus search(const CwPlanModel *model, const CwPlan *plan, int32_t node, const CwPlanPart *part,
                       int32_t regions, int32_t from, int32_t to, int32_t every, Candidate *candidate, Best *best) {
  CwStatus status = CW_OK;
  int32_t count = 0, judged = 0;
  Directions directions = {model, part, regions, from, every, (to - from) / every + 1};
  CW_TRY(look(&directions, candidate, &count));
  qsort(candidate, (size_t)count, sizeof *candidate, by_score);
  // Lines only add to a score, so the rest cannot win once the next score alone is no less than the best.
  for (int32_t i = 0; i < count && candidate[i].score < best->score; i++) {
    CwPlane plane = {{0}, candidate[i].offset};
    if (++judged > LINES_JUDGED && best->score < INFINITY) break;
    direction_of(candidate[i].direction, plane.normal);
    CwPlanLines lines = cw_plan_lines(model, plan, node, part, &plane);
    double score = candidate[i].score + cw_plan_line_cost(&lines);
    if (score < best->score) *best = (Best){plane, candidate[i].below, score};
  }
done:
  return status;
}

CwStatus cw_plan_best_plane(const CwPlanModel *model, const CwPlan *plan, int32_t node, const CwPlanPart *part,
                            int32_t regions, CwPlane *plane, int32_t *first, double *worst_angle) {
  CwStatus status = CW_OK;
  Candidate *candidate = NULL;
  Best best = {.score = INFINITY};
  int32_t every = part->pieces.count > PIECES_LARGE ? 2 : 1;
  CW_NEW(candidate, (DIRECTIONS + 1) * OF_DIRECTION);
  CW_TRY(search(model, plan, node, part, regions, 0, DIRECTIONS, every, candidate, &best));
  if (best.score > WELL) {
    CW_TRY(search(model, plan, node, part, regions, DIRECTIONS + 1, DIRECTIONS + LEANING, every, candidate, &best));
  }
  *first = best.below;
  *plane = best.plane;
  if (best.below > 0) *worst_angle = plane_to_wall(model, &part->pieces, plane);
done:
  free(candidate);
  return status;
}

CwStatus cw_plan_divide(const CwPlanModel *model, CwPlan *plan, CwPlanPart *part, int32_t regions, int32_t parent,
                        int side) {
  CwStatus status = CW_OK;
  CwPlanPart half[2] = {0};
  int32_t first = 0, node = plan->node_count;
  if (regions > 1) {
    plan->node[node].parent = parent;
    if (parent >= 0) plan->node[parent].child[side] = node; // it tells on which side the node's cell lies
    CW_TRY(cw_plan_best_plane(model, plan, node, part, regions, &plan->node[node].plane, &first,
                              &plan->worst_angle[node]));
  }
  if (first == 0) {
    int32_t region = plan->region_count++;
    if (parent >= 0) plan->node[parent].child[side] = -1 - region;
    plan->predicted_cells[region] = part->work;
    goto done;
  }
  plan->node_count++;
  plan->node[node].child[0] = plan->node[node].child[1] = INT32_MIN; // not known yet
  for (int s = 0; s < 2; s++) CW_TRY(cw_plan_part_clip(model, part, &plan->node[node].plane, s, &half[s]));
  cw_plan_part_free(part); // no more needed below
  CW_TRY(cw_plan_divide(model, plan, &half[0], first, node, 0));
  CW_TRY(cw_plan_divide(model, plan, &half[1], regions - first, node, 1));
done:
  cw_plan_part_free(&half[0]);
  cw_plan_part_free(&half[1]);
  cw_plan_part_free(part);
  return status;
}
