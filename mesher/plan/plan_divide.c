// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/plan/plan_divide.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/parallel/schedule.h"
#include "mesher/plan/plan_cost.h"
#include "mesher/plan/plan_directions.h"
#include "mesher/plan/plan_improve.h"
#include "mesher/plan/plan_lines.h"
#include "mesher/policy.h"

enum {
  COARSE = 3, // of so many upright directions one is looked along at first
  COARSE_TURN = 13,
  COARSE_TILT = 4,
  LEANING = 2,          // of leaning ones: every 13th turn at tilts of 4 and 8 to either side
  STEP = 4,             // turns and half as many tilts: first steps from the best plane where it does not do well
  SPLITS_MOST = 5,      // numbers of regions tried below the plane
  SHIFTS = 8,           // places tried on either side of the even one, wider and wider apart
  SAMPLES_MOST = 16000, // a section is seen well enough with these; smaller parts use all they have
  SHARED_LEAST = 40000, // pieces and samples, over all directions looked along, that are worth sharing among the ranks
  LINES_JUDGED = 200,   // candidates whose lines are looked at, best first
  SMALL_PART = 16,      // regions to come of a part for which other planes are tried
  TRIES = 4,
  TRIES_MOST = 6,
  MANY = 150,        // of them; more, and for so many regions, which find less room
  TRIES_FURTHER = 10 // for each region to come, of a part and all parts of it together
};
static const double SHIFT[3] = {0.015, 0.006, 0.003}; // of the smaller side's work: two or three regions, few, many
static const double WIDER = 6;                        // shifts until they are twice as wide
static const double LIKE = 0.97;                      // cosine between planes that are tried in vain alike

typedef struct {
  double score, offset;     // without what follows; m
  double further;           // what its lines and edges that it touches cost at least
  int32_t direction, below; // regions below
  int32_t judged;           // 1: they cost just so
} Candidate;

static int by_score(const void *a, const void *b) {
  const Candidate *p = a, *q = b;
  if (p->score != q->score) return p->score < q->score ? -1 : 1;
  if (p->direction != q->direction) return p->direction < q->direction ? -1 : 1;
  if (p->offset != q->offset) return p->offset < q->offset ? -1 : 1;
  return (p->below > q->below) - (p->below < q->below);
}

// All but the lines and the edges that it touches, for which a bin of the profile is too wide.
static double score_of(const CwPlanModel *model, const CwPlanPart *part, const CwPlanProfile *profile, int32_t regions,
                       int32_t below, double offset) {
  int bin = cw_profile_bin(profile, offset);
  double cells = cw_profile_below(profile, offset), all = profile->below[CW_PROFILE_BINS];
  // Against the mean of the whole domain: what one plane leaves uneven the next ones do not hide.
  double uneven = fmax(cw_plan_unevenness(cells, below * model->mean_work, below),
                       cw_plan_unevenness(all - cells, (regions - below) * model->mean_work, regions - below));
  return uneven + cw_policy.plan_area * profile->area[bin] / pow(part->volume, 2.0 / 3) +
         cw_plan_place_cost(cw_profile_at(profile, bin));
}

// Numbers of regions to try below the plane: about half of them, and of three one or two.
static int32_t splits_of(int32_t regions, int32_t *split) {
  int32_t least = regions == 3 ? 1 : (int32_t)fmax(1, ceil(0.34 * regions)), most = regions - least;
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
  cw_direction(d, direction);
  cw_plan_profile(model, part, direction, SAMPLES_MOST, &profile);
  double all = profile.below[CW_PROFILE_BINS], shift = SHIFT[regions <= 3 ? 0 : regions <= 8 ? 1 : 2];
  if (!(profile.width > 0) || !(all > 0)) return 0;
  for (int32_t i = 0; i < splits; i++) {
    double smaller = fmin(split[i], regions - split[i]) / regions;
    for (int j = -SHIFTS; j <= SHIFTS; j++) {
      Candidate *made = &candidate[count++];
      *made = (Candidate){.direction = d, .below = split[i]};
      double aside = j * (1 + abs(j) / WIDER) * shift * smaller;
      made->offset = cw_profile_place(&profile, all * ((double)split[i] / regions + aside));
      made->score = score_of(model, part, &profile, regions, made->below, made->offset);
    }
    // Through the axis a plane is normal to hub and shroud.
    double share = cw_profile_below(&profile, 0) / all;
    if (!cw_direction_is_upright(d) || fabs(share * regions - split[i]) > 0.2 * smaller * regions) continue;
    Candidate *made = &candidate[count++];
    *made = (Candidate){.direction = d, .below = split[i]};
    made->score = score_of(model, part, &profile, regions, made->below, made->offset);
  }
  return count;
}

// Directions to look along.
typedef struct {
  const CwPlanModel *model;
  const CwPlanPart *part;
  int32_t regions, count, direction[CW_DIRECTIONS];
} Directions;

static CwStatus look_along(void *context, int32_t task, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  const Directions *look = context;
  Candidate *made = NULL;
  CW_NEW(made, OF_DIRECTION);
  int32_t count = add_candidates(look->model, look->part, look->regions, look->direction[task], made);
  *bytes = made;
  *size = count * (int64_t)sizeof *made;
done:
  return status;
}

// The candidates of all directions, in their order; where there is much to look at it is shared among the ranks.
static CwStatus look(Directions *look, Candidate *candidate, int32_t *count) {
  CwStatus status = CW_OK;
  CwTaskResults results = {0};
  *count = 0;
  if ((int64_t)look->count * (look->part->pieces.count + look->part->sample_count) < SHARED_LEAST) {
    for (int32_t i = 0; i < look->count; i++) {
      *count += add_candidates(look->model, look->part, look->regions, look->direction[i], candidate + *count);
    }
    goto done;
  }
  CwSchedule schedule = {.step = "decomposition", .count = look->count, .run = look_along, .context = look};
  CW_TRY(cw_schedule_gather(look->model->context, &schedule, &results));
  *count = (int32_t)(cw_task_results_join(&results, candidate) / (int64_t)sizeof *candidate);
done:
  cw_task_results_free(&results);
  return status;
}

typedef struct {
  CwPlane plane;
  int32_t direction, below; // regions on its negative side; 0: no plane will do
  double score;
} Best;

// The planes that could divide a part into so many regions. The ancestors of `node`, which it is to become, are in the
// plan.
typedef struct {
  const CwPlanModel *model;
  const CwPlan *plan;
  const CwPlanPart *part;
  int32_t node, regions, count, capacity;
  Candidate *candidate; // best first
  uint8_t looked[CW_DIRECTIONS];
  int32_t tried_count;
  Best tried[TRIES_MOST];
} Choice;

static int like_one_tried(const Choice *choice, const CwPlane *plane, int32_t below) {
  for (int32_t i = 0; i < choice->tried_count; i++) {
    if (choice->tried[i].below == below && fabs(cw_dot(choice->tried[i].plane.normal, plane->normal)) > LIKE) return 1;
  }
  return 0;
}

// Takes the best plane unlike those tried that is better than *best, if there is one.
static CwStatus find_best(const Choice *choice, Best *best) {
  CwStatus status = CW_OK;
  int32_t judged = 0;
  // These only add to a score, so the rest cannot win once the next score alone is no less than the best.
  for (int32_t i = 0; i < choice->count && choice->candidate[i].score < best->score; i++) {
    Candidate *candidate = &choice->candidate[i];
    CwPlane plane = {{0}, candidate->offset};
    cw_direction(candidate->direction, plane.normal);
    if (candidate->score + candidate->further >= best->score || like_one_tried(choice, &plane, candidate->below))
      continue;
    if (!candidate->judged) {
      if (++judged > LINES_JUDGED && best->score < INFINITY) break;
      double most = best->score - candidate->score;
      double touch = cw_plan_touch_cost(cw_plan_touch(choice->model, choice->part, &plane, NULL));
      CwPlanLines lines;
      CW_TRY(cw_plan_lines(choice->model, choice->plan, choice->node, choice->part, &plane, most - touch, &lines));
      candidate->further = touch + lines.cost;
      candidate->judged = candidate->further < most || candidate->further == INFINITY;
    }
    double score = candidate->score + candidate->further;
    if (score < best->score) *best = (Best){plane, candidate->direction, candidate->below, score};
  }
done:
  return status;
}

static void add_direction(Choice *choice, int32_t direction, Directions *directions) {
  if (direction < 0 || choice->looked[direction]) return;
  choice->looked[direction] = 1;
  directions->direction[directions->count++] = direction;
}

// Looks along these directions, and takes the best plane if it is better than *best.
static CwStatus look_further(Choice *choice, Directions *directions, Best *best) {
  CwStatus status = CW_OK;
  int32_t added = 0;
  if (directions->count == 0) goto done;
  directions->model = choice->model;
  directions->part = choice->part;
  directions->regions = choice->regions;
  CW_GROW(choice->candidate, choice->capacity, choice->count + directions->count * OF_DIRECTION);
  CW_TRY(look(directions, choice->candidate + choice->count, &added));
  choice->count += added;
  qsort(choice->candidate, (size_t)choice->count, sizeof *choice->candidate, by_score);
  CW_TRY(find_best(choice, best));
done:
  return status;
}

// Goes from the best plane to better ones of the directions beside it, so many turns away and, where it leans or may
// lean, half as many tilts.
static CwStatus climb(Choice *choice, int32_t step, int lean, Best *best) {
  CwStatus status = CW_OK;
  for (int32_t from = -1; best->below > 0 && best->direction != from && best->direction != CW_ALONG_AXIS;) {
    Directions beside = {.count = 0};
    from = best->direction;
    int32_t turn = cw_direction_turn(from), tilt = cw_direction_tilt(from), up = lean ? (step + 1) / 2 : 0;
    add_direction(choice, cw_direction_at(turn + step, tilt), &beside);
    add_direction(choice, cw_direction_at(turn - step, tilt), &beside);
    add_direction(choice, cw_direction_at(turn, tilt + up), &beside);
    add_direction(choice, cw_direction_at(turn, tilt - up), &beside);
    CW_TRY(look_further(choice, &beside, best));
  }
done:
  return status;
}

// The best plane unlike those tried before that scores less than `limit`; leaning ones only where no other does well.
static CwStatus next_best(Choice *choice, double limit, Best *best) {
  CwStatus status = CW_OK;
  Directions upright = {.count = 0}, leaning = {.count = 0};
  *best = (Best){.score = limit};
  CW_TRY(find_best(choice, best));
  for (int32_t turn = 0; turn < CW_TURNS; turn += COARSE) add_direction(choice, cw_direction_at(turn, 0), &upright);
  add_direction(choice, CW_ALONG_AXIS, &upright);
  CW_TRY(look_further(choice, &upright, best));
  CW_TRY(climb(choice, 1, 0, best));
  if (best->score > CW_PLAN_FAULT) {
    for (int32_t tilt = -LEANING * COARSE_TILT; tilt <= LEANING * COARSE_TILT; tilt += COARSE_TILT) {
      for (int32_t turn = 0; turn < CW_TURNS && tilt != 0; turn += COARSE_TURN) {
        add_direction(choice, cw_direction_at(turn, tilt), &leaning);
      }
    }
    CW_TRY(look_further(choice, &leaning, best));
    for (int32_t step = STEP; step > 0 && best->score > CW_PLAN_FAULT; step /= 2) CW_TRY(climb(choice, step, 1, best));
  }
  choice->tried[choice->tried_count++] = *best;
done:
  return status;
}

// A subtree that was made, kept aside while another is tried in its place.
typedef struct {
  int32_t nodes, regions;
  CwPlanNode *node;
  double *predicted_cells;
} Kept;

static CwStatus keep(const CwPlan *plan, int32_t node, int32_t region, Kept *kept) {
  CwStatus status = CW_OK;
  kept->nodes = plan->node_count - node;
  kept->regions = plan->region_count - region;
  if (!kept->node) {
    // Room for all that any division of the part can take.
    CW_NEW(kept->node, SMALL_PART);
    CW_NEW(kept->predicted_cells, SMALL_PART);
  }
  memcpy(kept->node, plan->node + node, (size_t)kept->nodes * sizeof *kept->node);
  memcpy(kept->predicted_cells, plan->predicted_cells + region, (size_t)kept->regions * sizeof *kept->predicted_cells);
done:
  return status;
}

static void put_back(const Kept *kept, int32_t node, int32_t region, CwPlan *plan) {
  memcpy(plan->node + node, kept->node, (size_t)kept->nodes * sizeof *kept->node);
  memcpy(plan->predicted_cells + region, kept->predicted_cells, (size_t)kept->regions * sizeof *kept->predicted_cells);
  plan->node_count = node + kept->nodes;
  plan->region_count = region + kept->regions;
}

static void kept_free(Kept *kept) {
  free(kept->node);
  free(kept->predicted_cells);
}

static CwStatus divide(const CwPlanModel *model, CwPlan *plan, const CwPlanPart *part, int32_t regions, int32_t parent,
                       int side, double tries, double limit, double *bad);

// Divides the part by this plane, and both sides further, with so many tries. *bad: by how much all planes together
// score more than they should. Gives up once that is `limit` or more.
static CwStatus divide_by(const CwPlanModel *model, CwPlan *plan, const CwPlanPart *part, int32_t regions,
                          const Best *by, double tries, double limit, double *bad) {
  CwStatus status = CW_OK;
  CwPlanPart half[2] = {0};
  int32_t node = plan->node_count++, first[2] = {by->below, regions - by->below};
  *bad = fmax(by->score - CW_PLAN_FAULT, 0);
  plan->node[node].plane = by->plane;
  plan->node[node].child[0] = plan->node[node].child[1] = INT32_MIN; // not known yet
  plan->node[node].worst = cw_plan_place(model, part, &by->plane, NULL).worst;
  for (int s = 0; s < 2; s++) CW_TRY(cw_plan_part_clip(model, part, &by->plane, s, &half[s]));
  for (int s = 0; s < 2 && *bad < limit; s++) {
    double further, share = tries * first[s] / regions;
    CW_TRY(divide(model, plan, &half[s], first[s], node, s, share, limit - *bad, &further));
    cw_plan_part_free(&half[s]);
    *bad += further;
  }
done:
  for (int s = 0; s < 2; s++) cw_plan_part_free(&half[s]);
  return status;
}

// Divides the part, or leaves it whole where no plane will do. Where a small part, or what comes of it, divides badly
// by the best plane, others are tried: the best of them may leave a part that no plane divides well. `tries`: of this
// part and all parts of it, at least one each; the planes tried share them. *bad is `limit` or more, and the subtree of
// no use, where it would not be less.
static CwStatus divide(const CwPlanModel *model, CwPlan *plan, const CwPlanPart *part, int32_t regions, int32_t parent,
                       int side, double tries, double limit, double *bad) {
  CwStatus status = CW_OK;
  const int32_t node = plan->node_count, region = plan->region_count;
  Choice choice = {.model = model, .plan = plan, .part = part, .node = node, .regions = regions};
  Kept kept = {0};
  Best best;
  double least = limit;
  int32_t planes = regions > SMALL_PART ? 1 : model->region_count < MANY ? TRIES : TRIES_MOST;
  planes = planes > tries ? (int32_t)fmax(1, floor(tries)) : planes;
  int found = 0, last = 0; // whether some plane did; whether its subtree stands in the plan
  *bad = 0;
  if (parent >= 0) plan->node[parent].child[side] = node; // it tells on which side the node's cell lies
  while (regions > 1 && choice.tried_count < planes && (!found || least > 0)) {
    double further;
    plan->node_count = node;
    plan->region_count = region;
    plan->node[node].parent = parent;
    CW_TRY(next_best(&choice, CW_PLAN_FAULT + least, &best));
    last = 0;
    if (best.below == 0) break;
    CW_TRY(divide_by(model, plan, part, regions, &best, fmax(0, tries / planes - 1), least, &further));
    if (further >= least) continue;
    least = further;
    found = last = 1;
    if (choice.tried_count < planes && least > 0) CW_TRY(keep(plan, node, region, &kept));
  }
  if (found) {
    if (!last) put_back(&kept, node, region, plan);
    *bad = least;
    goto done;
  }
  if (regions > 1) *bad = cw_plan_unevenness(part->work, model->mean_work, 1);
  plan->node_count = node;
  plan->region_count = region;
  if (parent >= 0) plan->node[parent].child[side] = -1 - region;
  plan->predicted_cells[region] = part->work;
  plan->region_count++;
done:
  free(choice.candidate);
  kept_free(&kept);
  return status;
}

CwStatus cw_plan_divide(const CwPlanModel *model, CwPlan *plan, const CwPlanPart *part, int32_t regions, int32_t parent,
                        int side) {
  CwStatus status = CW_OK;
  const int32_t node = plan->node_count;
  double bad;
  CW_TRY(divide(model, plan, part, regions, parent, side, TRIES_FURTHER * regions, INFINITY, &bad));
  if (plan->node_count > node) CW_TRY(cw_plan_improve(model, plan, part, node));
done:
  return status;
}
