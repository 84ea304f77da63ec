// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/plan_score.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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
  LINES_JUDGED = 200, // candidates whose lines are looked at, best first
  SMALL_PART = 8,     // regions to come of a part for which other planes are tried
  TRIES = 3           // of them
};
static const double SHIFT[3] = {0.015, 0.006, 0.003}; // of the smaller side's work: two or three regions, few, many
static const double WIDER = 6;                       // shifts until they are twice as wide
static const double TILT[TILTS] = {0.35, 0.8};         // rad
static const double WELL = 4;                        // score of a plane that will do
static const double BALANCE_MOST = 0.1;              // share of a region's work past which a plane is hardly wanted
static const double CUT_LAYERS = 4;                  // what a plane through the layers along an edge costs
static const double BAD = 5;                         // score of a plane for which others are tried
static const double WHOLE = 20;                      // what a part costs that has to stay whole
static const double LIKE = 0.97;                     // cosine between planes that are tried in vain alike
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

double cw_plan_place_cost(const CwPlanProfile *profile, int bin) {
  double grazed = profile->grazed[bin];
  return sharpness(profile->worst[bin]) + fmin(0.17 * grazed, 3) + 0.007 * grazed + CUT_LAYERS * profile->cut[bin];
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
  return 6 * load + 60 * fmax(0, load - BALANCE_MOST) + 0.5 * fabs(2.0 * below / regions - 1) +
         0.5 * profile->area[bin] / pow(part->volume, 2.0 / 3) + cw_plan_place_cost(profile, bin);
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
  int32_t below; // regions on its negative side; 0: no plane will do
  double score;
} Best;

typedef struct {
  int32_t count;
  Best plane[TRIES];
} Tried;

static int like_one_tried(const Tried *tried, const CwPlane *plane) {
  for (int32_t i = 0; i < tried->count; i++) {
    if (fabs(cw_dot(tried->plane[i].plane.normal, plane->normal)) > LIKE) return 1;
  }
  return 0;
}

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
                       int32_t regions, int32_t from, int32_t to, const Tried *tried, Candidate *candidate, Best *best) {
  CwStatus status = CW_OK;
  int32_t count = 0, judged = 0, every = part->pieces.count > PIECES_LARGE ? 2 : 1;
  Directions directions = {model, part, regions, from, every, (to - from) / every + 1};
  CW_TRY(look(&directions, candidate, &count));
  qsort(candidate, (size_t)count, sizeof *candidate, by_score);
  // Lines only add to a score, so the rest cannot win once the next score alone is no less than the best.
  for (int32_t i = 0; i < count && candidate[i].score < best->score; i++) {
    CwPlane plane = {{0}, candidate[i].offset};
    direction_of(candidate[i].direction, plane.normal);
    if (like_one_tried(tried, &plane)) continue;
    if (++judged > LINES_JUDGED && best->score < INFINITY) break;
    CwPlanLines lines = cw_plan_lines(model, plan, node, part, &plane);
    double score = candidate[i].score + cw_plan_line_cost(&lines);
    if (score < best->score) *best = (Best){plane, candidate[i].below, score};
  }
done:
  return status;
}

// The best plane for `node` (its ancestors are in the plan), unlike those tried.
static CwStatus best_plane(const CwPlanModel *model, const CwPlan *plan, int32_t node, const CwPlanPart *part,
                           int32_t regions, const Tried *tried, Best *best) {
  CwStatus status = CW_OK;
  Candidate *candidate = NULL;
  *best = (Best){.score = INFINITY};
  CW_NEW(candidate, (DIRECTIONS + 1) * OF_DIRECTION);
  CW_TRY(search(model, plan, node, part, regions, 0, DIRECTIONS, tried, candidate, best));
  if (best->score > WELL) {
    CW_TRY(search(model, plan, node, part, regions, DIRECTIONS + 1, DIRECTIONS + LEANING, tried, candidate, best));
  }
done:
  free(candidate);
  return status;
}

static CwStatus divide(const CwPlanModel *model, CwPlan *plan, const CwPlanPart *part, int32_t regions, int32_t parent,
                       int side, double *worst);

// Divides the part by this plane, and both sides further. *worst: the score of the worst plane.
static CwStatus divide_by(const CwPlanModel *model, CwPlan *plan, const CwPlanPart *part, int32_t regions, const Best *by,
                          double *worst) {
  CwStatus status = CW_OK;
  CwPlanPart half[2] = {0};
  int32_t node = plan->node_count++, first[2] = {by->below, regions - by->below};
  *worst = by->score;
  plan->node[node].plane = by->plane;
  plan->node[node].child[0] = plan->node[node].child[1] = INT32_MIN; // not known yet
  plan->worst_angle[node] = plane_to_wall(model, &part->pieces, &by->plane);
  for (int s = 0; s < 2; s++) CW_TRY(cw_plan_part_clip(model, part, &by->plane, s, &half[s]));
  for (int s = 0; s < 2; s++) {
    double below;
    CW_TRY(divide(model, plan, &half[s], first[s], node, s, &below));
    cw_plan_part_free(&half[s]);
    *worst = fmax(*worst, below);
  }
done:
  for (int s = 0; s < 2; s++) cw_plan_part_free(&half[s]);
  return status;
}

// Where a small part, or what comes of it, divides badly by the best plane, others are tried: the best of them may leave
// a part that no plane divides well.
static CwStatus divide(const CwPlanModel *model, CwPlan *plan, const CwPlanPart *part, int32_t regions, int32_t parent,
                       int side, double *worst) {
  CwStatus status = CW_OK;
  const int32_t node = plan->node_count, region = plan->region_count;
  Tried tried = {0};
  double least = INFINITY;
  int32_t chosen = -1, tries = regions <= SMALL_PART ? TRIES : 1;
  *worst = 0;
  if (parent >= 0) plan->node[parent].child[side] = node; // it tells on which side the node's cell lies
  while (regions > 1 && tried.count < tries && least > BAD) {
    Best *best = &tried.plane[tried.count];
    plan->node[node].parent = parent;
    CW_TRY(best_plane(model, plan, node, part, regions, &tried, best));
    if (best->below == 0 || best->score >= least) break;
    plan->node_count = node;
    plan->region_count = region;
    CW_TRY(divide_by(model, plan, part, regions, best, worst));
    if (*worst < least) least = *worst, chosen = tried.count;
    tried.count++;
  }
  if (chosen >= 0 && chosen < tried.count - 1) { // the last one was no better
    plan->node_count = node;
    plan->region_count = region;
    CW_TRY(divide_by(model, plan, part, regions, &tried.plane[chosen], worst));
  }
  if (chosen >= 0) goto done;
  *worst = regions > 1 ? WHOLE : 0;
  if (parent >= 0) plan->node[parent].child[side] = -1 - region;
  plan->predicted_cells[region] = part->work;
  plan->region_count++;
done:
  return status;
}

CwStatus cw_plan_divide(const CwPlanModel *model, CwPlan *plan, const CwPlanPart *part, int32_t regions, int32_t parent,
                        int side) {
  double worst;
  return divide(model, plan, part, regions, parent, side, &worst);
}
