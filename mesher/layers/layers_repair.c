// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/layers/layers_repair.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/box_tree.h"
#include "mesher/common/vec.h"
#include "mesher/layers/direction_smoothing.h"
#include "mesher/layers/layers_crossing.h"
#include "mesher/layers/layers_gap.h"
#include "mesher/layers/layers_judge.h"
#include "mesher/layers/layers_normal.h"
#include "mesher/layers/layers_turn.h"
#include "mesher/parallel/parallel_for.h"
#include "mesher/parallel/schedule.h"
#include "mesher/policy.h"
#include "pipeline/order.h"

enum { ROUNDS = 120, TURNS = 4, RESMOOTH = 3 };
enum { TOGETHER = 16 };                // columns at least that are turned in one task
enum { MANY = 2048 };                  // prisms that are worth handing round the ranks
enum { FOR_SHAPE = 1, FOR_SOUNDNESS }; // what a column is turned and thinned for

typedef struct {
  CwLayerWork *work;
  double (*top)[3];
  double *quality;         // of each prism
  int32_t bad_count, *bad; // prisms
  int32_t *stale;          // prisms to judge
  uint8_t *mark;           // vertices to turn or to thin, and what for
  uint8_t *moved;          // vertices that moved since prisms were judged
  int32_t moved_count, *moved_list;
  uint8_t *uncrossed; // and since crossings were looked for
  double limit;       // prism quality asked for
  double *thickness;  // as placed
  int finely;         // layers_turn.h
  CwLayerCrossing crossing;
} Repair;

static CwStatus judge(void *context, int32_t f, void *out) {
  const Repair *repair = context;
  *(double *)out = cw_layers_judge(repair->work, f, (const double(*)[3])repair->top);
  return CW_OK;
}

static CwStatus judge_stale(void *context, int32_t i, void *out) {
  return judge(context, ((const Repair *)context)->stale[i], out);
}

static void set_moved(Repair *repair, int32_t v) {
  if (!repair->moved[v]) repair->moved_list[repair->moved_count++] = v;
  repair->moved[v] = 1;
}

// Marks the columns of the bad prisms. thinned: those alone of which less helps.
static void mark_bad(Repair *repair, int thinned) {
  const CwLayerWork *work = repair->work;
  const double(*top)[3] = (const double(*)[3])repair->top;
  memset(repair->mark, 0, (size_t)work->n);
  for (int32_t i = 0; i < repair->bad_count; i++) {
    int32_t f = repair->bad[i];
    int marked[3] = {1, 1, 1}, sound = cw_layers_is_sound(work, f, top);
    if (thinned) cw_layers_helped_by(work, f, top, sound, marked);
    for (int k = 0; k < 3; k++) {
      uint8_t *mark = &repair->mark[work->in->triangle[f][k]];
      if (marked[k] && *mark != FOR_SOUNDNESS) *mark = sound ? FOR_SHAPE : FOR_SOUNDNESS;
    }
  }
}

// Brings the qualities round what moved up to date and marks the vertices of bad prisms. Collective.
static CwStatus find_bad(Repair *repair) {
  CwStatus status = CW_OK;
  const CwLayerWork *work = repair->work;
  double *many = NULL;
  int32_t stale = 0, kept = 0;
  for (int32_t i = 0; i < repair->moved_count; i++) {
    int32_t v = repair->moved_list[i];
    for (int32_t k = work->face_start[v]; k < work->face_start[v + 1]; k++) {
      int32_t f = work->face[k];
      if (repair->quality[f] == INFINITY) continue; // listed already
      repair->quality[f] = INFINITY;
      repair->stale[stale++] = f;
    }
    repair->moved[v] = 0;
    repair->uncrossed[v] = 1;
  }
  repair->moved_count = 0;
  for (int32_t i = 0; i < repair->bad_count; i++) {
    if (repair->quality[repair->bad[i]] < repair->limit) repair->bad[kept++] = repair->bad[i];
  }
  if (stale > MANY) {
    CW_NEW_UNSET(many, stale);
    CW_TRY(cw_parallel_for(work->in->context, "layers: prisms", stale, sizeof *many, judge_stale, repair, many));
  }
  for (int32_t i = 0; i < stale; i++) {
    int32_t f = repair->stale[i];
    repair->quality[f] = many ? many[i] : cw_layers_judge(work, f, (const double(*)[3])repair->top);
    if (repair->quality[f] < repair->limit) repair->bad[kept++] = f;
  }
  repair->bad_count = kept;
  mark_bad(repair, 0);
done:
  free(many);
  return status;
}

// Puts the ends of the columns whose thickness changed where they belong.
static void place_changed(Repair *repair) {
  const CwLayerWork *work = repair->work;
  for (int32_t v = 0; v < work->n; v++) {
    if (work->t[v] == repair->thickness[v]) continue;
    cw_layers_place(work, v, repair->top[v]);
    repair->thickness[v] = work->t[v];
    set_moved(repair, v);
  }
}

static CwStatus find_end(void *context, int32_t v, void *out) {
  cw_layers_place(context, v, out);
  return CW_OK;
}

static CwStatus thin_marked(Repair *repair) {
  CwStatus status = CW_OK;
  CwLayerWork *work = repair->work;
  for (int32_t v = 0; v < work->n; v++) {
    double least = repair->mark[v] == FOR_SHAPE ? cw_layer_least(work->in, v) : 0;
    if (!repair->mark[v] || work->t[v] <= least) continue;
    work->t[v] = fmax(cw_policy.column_kept * work->t[v], least);
    work->reason[v] = CW_LAYER_REPAIR;
  }
  CW_TRY(cw_layers_grade(work, repair->mark));
  place_changed(repair);
done:
  return status;
}

// Finds the pairs of triangles that cross and marks their columns.
static CwStatus find_crossings(Repair *repair) {
  CwStatus status = CW_OK;
  const CwLayerWork *work = repair->work;
  memset(repair->mark, 0, work->n);
  CW_TRY(cw_layers_crossing_find(&repair->crossing, (const double(*)[3])repair->top, repair->uncrossed));
  memset(repair->uncrossed, 0, work->n);
  for (int32_t i = 0; i < repair->crossing.pair_count; i++) {
    const CwLayerPair *pair = &repair->crossing.pair[i];
    for (int k = 0; k < 3; k++) {
      repair->mark[work->in->triangle[pair->f][k]] = FOR_SOUNDNESS;
      if (pair->kind_g == 0) repair->mark[work->in->triangle[pair->g][k]] = FOR_SOUNDNESS;
    }
  }
done:
  return status;
}

// Thins the columns whose ends come too near to others. Collective.
static CwStatus part_tops(Repair *repair, int *any) {
  CwStatus status = CW_OK;
  CwLayerWork *work = repair->work;
  CW_TRY(cw_layers_limit_by_top(work, &repair->crossing.top, (const double(*)[3])repair->top, repair->mark, any));
  if (!*any) goto done;
  CW_TRY(cw_layers_grade(work, repair->mark));
  place_changed(repair);
done:
  return status;
}

// Marked columns by groups: neighbours, of which each sees what the last one did, are in one. Groups do not see one
// another.
typedef struct {
  Repair *repair;
  int32_t count, *start, *vertex; // vertices of group g: start[g] .. start[g + 1] - 1
} Groups;

// What one column has become.
typedef struct {
  double top[3], column[3];
  int32_t changed;
} Turned;

// Lists the marked vertices that hang together with v by edges, in ascending order from place `first` on; returns where
// they end.
static int32_t list_group(const Repair *repair, int32_t v, uint8_t *listed, int32_t first, int32_t *vertex) {
  const CwLayerWork *work = repair->work;
  int32_t end = first;
  vertex[end++] = v;
  listed[v] = 1;
  for (int32_t i = first; i < end; i++) {
    for (int32_t k = work->near_start[vertex[i]]; k < work->near_start[vertex[i] + 1]; k++) {
      int32_t w = work->near[k];
      if (!repair->mark[w] || listed[w]) continue;
      listed[w] = 1;
      vertex[end++] = w;
    }
  }
  qsort(vertex + first, (size_t)(end - first), sizeof *vertex, cw_order_int32s);
  return end;
}

static CwStatus group_marked(Repair *repair, Groups *groups) {
  CwStatus status = CW_OK;
  const CwLayerWork *work = repair->work;
  uint8_t *listed = NULL;
  int32_t end = 0;
  CW_NEW(listed, work->n);
  CW_NEW_UNSET(groups->vertex, work->n);
  CW_NEW_UNSET(groups->start, work->n + 1);
  groups->start[0] = 0;
  for (int32_t v = 0; v < work->n; v++) {
    if (!repair->mark[v] || listed[v]) continue;
    end = list_group(repair, v, listed, end, groups->vertex);
    if (end - groups->start[groups->count] >= TOGETHER) groups->start[++groups->count] = end;
  }
  if (end > groups->start[groups->count]) groups->start[++groups->count] = end;
done:
  free(listed);
  return status;
}

static CwStatus turn_group(void *context, int32_t group, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  const Groups *groups = context;
  CwLayerWork *work = groups->repair->work;
  double(*top)[3] = groups->repair->top;
  int32_t first = groups->start[group], count = groups->start[group + 1] - first;
  Turned *made = NULL;
  CW_NEW(made, count);
  for (int32_t i = 0; i < count; i++) {
    int32_t v = groups->vertex[first + i];
    memcpy(made[i].top, top[v], sizeof *top);
    cw_layers_turn(work, v, top, cw_layers_around, groups->repair->finely);
    made[i].changed = memcmp(made[i].top, top[v], sizeof *top) != 0;
    memcpy(made[i].top, top[v], sizeof *top);
    memcpy(made[i].column, work->column[v], sizeof made[i].column);
  }
  *bytes = made;
  *size = count * (int64_t)sizeof *made;
done:
  return status;
}

// Turns marked columns, the groups over the ranks. Collective.
static CwStatus turn_marked(Repair *repair) {
  CwStatus status = CW_OK;
  CwLayerWork *work = repair->work;
  Groups groups = {.repair = repair};
  double *cost = NULL;
  CwTaskResults results = {0};
  CW_TRY(group_marked(repair, &groups));
  CW_NEW(cost, groups.count);
  for (int32_t g = 0; g < groups.count; g++) cost[g] = groups.start[g + 1] - groups.start[g];
  CwSchedule schedule = {
      .step = "layers: turns", .count = groups.count, .cost = cost, .run = turn_group, .context = &groups};
  CW_TRY(cw_schedule_gather(work->in->context, &schedule, &results));
  for (int32_t g = 0; g < groups.count; g++) {
    const Turned *made = results.bytes[g];
    for (int32_t i = groups.start[g]; i < groups.start[g + 1]; i++, made++) {
      int32_t v = groups.vertex[i];
      if (!made->changed) continue;
      memcpy(repair->top[v], made->top, sizeof made->top);
      memcpy(work->column[v], made->column, sizeof made->column);
      set_moved(repair, v);
    }
  }
done:
  cw_task_results_free(&results);
  free(cost);
  free(groups.vertex);
  free(groups.start);
  return status;
}

// Smoothing the columns anew for the thicknesses as they are now.
static CwStatus smoothing_again(Repair *repair) {
  CwStatus status = CW_OK;
  CwLayerWork *work = repair->work;
  CW_TRY(cw_smooth_directions(work));
  for (int32_t v = 0; v < work->n; v++) {
    double before[3];
    memcpy(before, repair->top[v], sizeof before);
    cw_layers_place(work, v, repair->top[v]);
    if (memcmp(before, repair->top[v], sizeof before) != 0) set_moved(repair, v);
  }
done:
  return status;
}

// Columns before they were turned.
typedef struct {
  uint8_t *noted; // of each vertex
  int64_t count, capacity;
  struct {
    int32_t v;
    double column[3];
  } * column;
} Before;

static CwStatus note_marked(const Repair *repair, Before *before) {
  CwStatus status = CW_OK;
  for (int32_t v = 0; v < repair->work->n; v++) {
    if (!repair->mark[v] || before->noted[v]) continue;
    CW_GROW(before->column, before->capacity, before->count + 1);
    before->column[before->count].v = v;
    cw_copy(repair->work->column[v], before->column[before->count++].column);
    before->noted[v] = 1;
  }
done:
  return status;
}

// Turns marked columns back that were turned. Returns how many.
static int32_t turn_back(Repair *repair, const Before *before) {
  CwLayerWork *work = repair->work;
  int32_t count = 0;
  for (int64_t i = 0; i < before->count; i++) {
    int32_t v = before->column[i].v;
    if (!repair->mark[v] || !memcmp(work->column[v], before->column[i].column, sizeof work->column[v])) continue;
    cw_copy(before->column[i].column, work->column[v]);
    cw_layers_place(work, v, repair->top[v]);
    set_moved(repair, v);
    count++;
  }
  return count;
}

// Turns once more the columns that keep their first height although prism or layer top could be better (those were
// turned last while they were taller), and those that lean so much that determinants are small or that little room is
// left beside them. What crosses or is worse than allowed then is turned back: it is not to cost thickness. Collective.
static CwStatus turn_kept(Repair *repair) {
  CwStatus status = CW_OK;
  const CwLayerWork *work = repair->work;
  const double(*top)[3] = (const double(*)[3])repair->top;
  Before before = {0};
  CW_NEW(before.noted, work->n);
  repair->finely = 1;
  for (int pass = 0; pass < TURNS; pass++) {
    int marked = 0;
    memset(repair->mark, 0, (size_t)work->n);
    for (int32_t f = 0; f < work->in->triangle_count; f++) {
      if (repair->quality[f] != cw_policy.prism_good) continue;
      double prism = cw_layers_prism_quality(work, f, top);
      double shape = fmin(prism, cw_layers_top_quality(work, f, top));
      if (fmin(shape, cw_layers_lean_quality(work, f, top)) >= cw_policy.prism_good) continue;
      for (int k = 0; k < 3; k++) repair->mark[work->in->triangle[f][k]] = FOR_SHAPE;
      marked = 1;
    }
    if (!marked) break;
    CW_TRY(note_marked(repair, &before));
    CW_TRY(turn_marked(repair));
    if (!repair->moved_count) break;
    CW_TRY(find_bad(repair));
  }
  for (int32_t back = before.count > 0; back;) {
    if (!repair->bad_count) CW_TRY(find_crossings(repair));
    back = turn_back(repair, &before);
    CW_TRY(find_bad(repair));
  }
done:
  free(before.column);
  free(before.noted);
  return status;
}

// All columns as they come, and their prisms judged. Takes the tree over. Collective.
static CwStatus start(Repair *repair, CwBoxTree *tree) {
  CwStatus status = CW_OK;
  CwLayerWork *work = repair->work;
  int32_t n = work->n, triangles = work->in->triangle_count;
  CW_NEW_UNSET(repair->quality, triangles);
  CW_NEW(repair->mark, n);
  CW_NEW(repair->moved, n);
  CW_NEW(repair->moved_list, n);
  CW_NEW_UNSET(repair->bad, triangles);
  CW_NEW_UNSET(repair->stale, triangles);
  CW_NEW(repair->uncrossed, n);
  memset(repair->uncrossed, 1, (size_t)n);
  CW_NEW_UNSET(repair->thickness, n);
  CW_TRY(cw_layers_crossing_make(work, &repair->crossing));
  repair->crossing.fixed = *tree;
  memset(tree, 0, sizeof *tree);
  CW_TRY(cw_parallel_for(work->in->context, "layers: ends", n, sizeof *repair->top, find_end, work, repair->top));
  memcpy(repair->thickness, work->t, (size_t)n * sizeof *repair->thickness);
  CW_TRY(cw_parallel_for(work->in->context, "layers: prisms", triangles, sizeof *repair->quality, judge, repair,
                         repair->quality));
  for (int32_t f = 0; f < triangles; f++) {
    if (repair->quality[f] < cw_policy.prism_good) repair->bad[repair->bad_count++] = f;
  }
done:
  return status;
}

// Turns the columns of bad prisms, some times or until none is bad. Collective.
static CwStatus turn_bad(Repair *repair) {
  CwStatus status = CW_OK;
  for (int pass = 0; pass < TURNS && repair->bad_count; pass++) {
    CW_TRY(turn_marked(repair));
    CW_TRY(find_bad(repair));
  }
done:
  return status;
}

// What was found last, bad or crossing, is marked.
static void not_repaired(const Repair *repair, CwOutcome *outcome) {
  const CwLayerWork *work = repair->work;
  char why[160];
  snprintf(why, sizeof why, "no valid layer top after %d rounds: %d prisms of a quality below %g, %d pairs crossing",
           ROUNDS, repair->bad_count, repair->limit, repair->crossing.pair_count);
  for (int32_t f = 0; f < work->in->triangle_count; f++)
    for (int k = 0; k < 3; k++)
      if (repair->mark[work->in->triangle[f][k]]) cw_layers_add_place(work, f, k, outcome, why);
}

static void repair_free(Repair *repair) {
  free(repair->quality);
  free(repair->mark);
  free(repair->moved);
  free(repair->moved_list);
  free(repair->bad);
  free(repair->stale);
  free(repair->uncrossed);
  free(repair->thickness);
  cw_layers_crossing_free(&repair->crossing);
}

CwStatus cw_layers_repair(CwLayerWork *work, CwBoxTree *tree, double (*top)[3], int32_t *rounds, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  Repair repair = {.work = work, .top = top};
  CW_TRY(start(&repair, tree));
  for (*rounds = 0;; (*rounds)++) {
    // Round prisms where they can be had; where half the rounds did not bring them, sound ones.
    repair.limit = *rounds < ROUNDS / 2 ? cw_policy.prism_good : cw_policy.sound_quality;
    CW_TRY(find_bad(&repair));
    if (repair.bad_count) {
      if (*rounds >= ROUNDS) break;
      CW_TRY(turn_bad(&repair));
      if (!repair.bad_count) continue;
      mark_bad(&repair, 1);
    } else {
      CW_TRY(find_crossings(&repair));
      if (repair.crossing.pair_count == 0) {
        int any = 0;
        if (*rounds < ROUNDS / 2) CW_TRY(part_tops(&repair, &any));
        if (any) continue;
        CW_TRY(turn_kept(&repair));
        goto done;
      }
      cw_layers_crossing_judge(&repair.crossing, outcome);
      if (outcome->kind != CW_OUTCOME_DONE) goto done;
      if (*rounds >= ROUNDS) break;
    }
    CW_TRY(thin_marked(&repair));
    // What is bad still leans as the old thicknesses asked; less thickness needs less lean. Once only: the turned
    // columns are lost by it, and only thinning is sure to come to an end.
    if (*rounds == RESMOOTH) CW_TRY(smoothing_again(&repair));
  }
  not_repaired(&repair, outcome);
done:
  repair_free(&repair);
  return status;
}
