// SPDX-License-Identifier: AGPL-3.0-or-later
// Beside a concave crease the column of the crease leans along both walls by about t cot(alpha/2); where the mesh is
// finer than that its neighbours would be overrun. The lean is spread over them as the solution of a screened Poisson
// problem
//   U - L^2 laplace U = 0 on the wall, U = column of the crease on the crease, U tangential elsewhere,
// which leaves the normal thickness as asked. Columns that a constraint tilts (an oblique partition plane) are treated
// alike. A column on an edge, concave or convex, leans along the edge only: so the smoothing of a corner runs down its
// edges too.
#include "mesher/layers/direction_smoothing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/layers/direction_smoothing_work.h"
#include "mesher/layers/layers_normal.h"
#include "mesher/policy.h"

// Displacement of v without any smoothing, m.
static void plain(const CwLayerWork *work, int32_t v, const double direction[3], double cosine, double d[3]) {
  double c = fmax(cosine, cw_layers_floor(work, v));
  for (int k = 0; k < 3; k++) d[k] = work->t[v] * direction[k] / c;
}

static int is_source(const CwLayerWork *work, int32_t v) {
  int constrained = cw_layer_constraints(work->in, v) > 0;
  if (cw_layer_pinched(work->in, v)) return 0;
  return work->crease[v] == CW_CREASE_CONCAVE || (constrained && cw_dot(work->base[v], work->normal[v]) < 0.985);
}

// Sets the thickness of a source and its displacement relative to an undisturbed neighbour.
static void raise_source(const CwLayerWork *work, CwSmoothingSource *source) {
  int32_t v = source->vertex;
  source->thickness = work->t[v];
  plain(work, v, work->base[v], work->base_cos[v], source->u);
  if (work->crease[v] == CW_CREASE_CONCAVE) return;
  double undisturbed[3];
  plain(work, v, work->normal[v], work->normal_cos[v], undisturbed);
  cw_sub(source->u, undisturbed, source->u);
}

// The one direction in which the column of a source may still lean: along its concave edge, or along the line that wall
// and constraint share; zero where its column is wholly given.
static void sliding_direction(const CwLayerWork *work, int32_t v, double line[3]) {
  int constraints = cw_layer_constraints(work->in, v);
  memset(line, 0, 3 * sizeof *line);
  if (work->crease[v] == CW_CREASE_CONCAVE && constraints == 0) memcpy(line, work->along[v], 3 * sizeof *line);
  if (work->crease[v] == CW_CREASE_NONE && constraints == 1)
    cw_cross(work->normal[v], work->in->constraint_normal[v][0], line);
  cw_unit(line);
}

static CwStatus find_sources(CwSmoothing *smoothing) {
  CwStatus status = CW_OK;
  const CwLayerWork *work = smoothing->work;
  for (int32_t v = 0; v < work->n; v++) smoothing->source_count += is_source(work, v);
  CW_NEW(smoothing->source, smoothing->source_count);
  smoothing->source_count = 0;
  for (int32_t v = 0; v < work->n; v++) {
    if (!is_source(work, v)) continue;
    CwSmoothingSource *source = &smoothing->source[smoothing->source_count++];
    double cosine = work->crease[v] == CW_CREASE_CONCAVE ? work->base_cos[v] : cw_dot(work->base[v], work->normal[v]);
    cosine = fmin(fmax(cosine, cw_policy.column_least_cosine), 1);
    source->vertex = v;
    source->opening = sqrt(1 - cosine * cosine) / cosine;
    sliding_direction(work, v, source->line);
    raise_source(work, source);
  }
done:
  return status;
}

static CwStatus smoothing_make(CwLayerWork *work) {
  CwStatus status = CW_OK;
  CwSmoothing *smoothing = NULL;
  CW_NEW(work->smoothing, 1);
  smoothing = work->smoothing;
  smoothing->work = work;
  CW_NEW(smoothing->reach, work->n);
  CW_NEW(smoothing->member, work->n);
  CW_NEW(smoothing->place, work->n);
  CW_NEW(smoothing->lean_t, work->n);
  CW_TRY(find_sources(smoothing));
  CW_TRY(cw_smoothing_find_reach(smoothing));
  for (int32_t i = 0; i < work->n; i++) {
    int32_t v = work->curve[i], source = smoothing->reach[v].source;
    int leans = source >= 0 && (smoothing->source[source].vertex != v || cw_norm(smoothing->source[source].line) > 0);
    leans &= !cw_layer_pinched(work->in, v);
    smoothing->place[v] = leans ? smoothing->count : -1;
    if (leans) smoothing->member[smoothing->count++] = v;
  }
done:
  return status;
}

void cw_smoothing_free(CwSmoothing **smoothing) {
  if (!*smoothing) return;
  cw_task_results_free(&(*smoothing)->lean);
  free((*smoothing)->source);
  free((*smoothing)->reach);
  free((*smoothing)->member);
  free((*smoothing)->place);
  free((*smoothing)->lean_t);
  free(*smoothing);
  *smoothing = NULL;
}

CwStatus cw_smooth_directions(CwLayerWork *work) {
  CwStatus status = CW_OK;
  CwTaskResults made = {0};
  if (!work->smoothing) CW_TRY(smoothing_make(work));
  CwSmoothing *smoothing = work->smoothing;
  for (int32_t i = 0; i < smoothing->source_count; i++) raise_source(work, &smoothing->source[i]);
  CwSchedule schedule = {.step = "layers: smoothing",
                         .count = (smoothing->count + CW_SMOOTHING_BLOCK - 1) / CW_SMOOTHING_BLOCK,
                         .run = cw_smoothing_solve_block,
                         .context = smoothing};
  CW_TRY(cw_schedule_gather(work->in->context, &schedule, &made));
  for (int32_t v = 0; v < work->n; v++) smoothing->lean_t[v] = smoothing->reach[v].source >= 0 ? work->t[v] : -1;
  for (int32_t i = 0; i < smoothing->count; i++) {
    const CwLean *lean = (const CwLean *)made.bytes[i / CW_SMOOTHING_BLOCK] + i % CW_SMOOTHING_BLOCK;
    int32_t v = smoothing->member[i];
    if (!lean->changed || memcmp(work->column[v], lean->column, sizeof lean->column) == 0) continue;
    memcpy(work->column[v], lean->column, sizeof lean->column);
    if (work->stale) work->stale[v] = 1;
  }
  cw_task_results_free(&smoothing->lean);
  smoothing->lean = made;
  made = (CwTaskResults){0};
done:
  cw_task_results_free(&made);
  return status;
}
