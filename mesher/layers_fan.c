// SPDX-License-Identifier: AGPL-3.0-or-later
// Beside a concave crease the column of the crease leans along both walls by about t cot(alpha/2); where the
// mesh is finer than
// that its neighbours would be overrun. The lean is spread over them as the solution of a screened Poisson
// problem
//   U - L^2 laplace U = 0 on the wall, U = column of the crease on the crease, U tangential elsewhere,
// which leaves the normal height as asked. Columns that a guide tilts (an oblique dividing plane) are
// treated alike.
// A column on an edge, concave or convex, leans along the edge only: so the fan of a corner runs down its
// edges too.
#include <stdlib.h>

#include "mesher/layers_inner.h"

enum { SWEEPS = 60, MORE_SWEEPS = 30, WIDENINGS = 6 };
static const double REACH = 6;         // the fan ends at this many heights from its crease
static const double FADE = 6;          // the opening of the crease is forgotten at this many
static const double LEAST_COSINE = 0.3;
static const double POOR = 0.2;       // prism quality under which a fan is widened
static const double WIDEST = 5;
static const double SETTLED = 1e-3;   // change in one sweep, in heights, that is none

typedef struct {
  double distance, opening, height; // to the nearest source, its cot(alpha/2) and height
  double widen;                     // factor on L where the usual one leaves prisms overrun
  int32_t source;                   // -1: out of reach
  double u[3];                      // displacement relative to an undisturbed neighbour on the wall, m
  double given[3], line[3];         // of a source: what is fixed of it, and the direction of the rest
} Fan;

// Displacement of v without any fan, m.
static void plain(const CwLayerWork *work, int32_t v, const double direction[3], double cosine, double d[3]) {
  double c = fmax(cosine, cw_layers_floor(work, v));
  for (int k = 0; k < 3; k++) d[k] = work->t[v] * direction[k] / c;
}

// Whether the column of v is given, and then its displacement relative to an undisturbed neighbour.
static int is_source(const CwLayerWork *work, int32_t v, Fan *fan) {
  int guided = work->in->guide_count && work->in->guide_count[v] > 0;
  double cosine;
  if (work->crease[v] == CW_CREASE_CONCAVE) {
    plain(work, v, work->base[v], work->base_cos[v], fan->u);
    cosine = work->base_cos[v];
  } else if (guided && dot3(work->base[v], work->normal[v]) < 0.985) {
    double undisturbed[3];
    plain(work, v, work->base[v], work->base_cos[v], fan->u);
    plain(work, v, work->normal[v], work->normal_cos[v], undisturbed);
    sub3(fan->u, undisturbed, fan->u);
    cosine = dot3(work->base[v], work->normal[v]);
  } else {
    return 0;
  }
  cosine = fmin(fmax(cosine, LEAST_COSINE), 1);
  fan->opening = sqrt(1 - cosine * cosine) / cosine;
  fan->height = work->t[v];
  fan->source = v;
  fan->distance = 0;
  return 1;
}

// The one direction in which the column of a source may still lean: along its concave edge, or along the
// line that wall and
// guide share; zero where its column is wholly given.
static void sliding_direction(const CwLayerWork *work, int32_t v, double line[3]) {
  int guides = work->in->guide_count ? work->in->guide_count[v] : 0;
  memset(line, 0, 3 * sizeof *line);
  if (work->crease[v] == CW_CREASE_CONCAVE && guides == 0) memcpy(line, work->along[v], 3 * sizeof *line);
  if (work->crease[v] == CW_CREASE_NONE && guides == 1) cross3(work->normal[v], work->in->guide_normal[v][0], line);
  unit3(line);
}

// Projects u onto the directions in which the column of v may lean without changing its normal height or
// leaving its guides.
static void allow(const CwLayerWork *work, int32_t v, double u[3]) {
  const CwLayerInput *in = work->in;
  int guides = in->guide_count ? in->guide_count[v] : 0;
  double line[3];
  if (guides == 2) {
    memset(u, 0, 3 * sizeof *u);
    return;
  }
  if (work->crease[v] == CW_CREASE_NONE && guides == 0) {
    flatten3(u, work->normal[v]);
    return;
  }
  if (work->crease[v] == CW_CREASE_NONE) {
    cross3(work->normal[v], in->guide_normal[v][0], line);
  } else {
    memcpy(line, work->along[v], sizeof line);
    if (guides && fabs(dot3(line, in->guide_normal[v][0])) > 0.1) memset(line, 0, sizeof line);
    if (guides) flatten3(line, in->guide_normal[v][0]);
  }
  unit3(line);
  double h = dot3(u, line);
  for (int k = 0; k < 3; k++) u[k] = h * line[k];
}

// Distances from the sources along edges; lists the vertices in reach in order of distance.
static CwStatus spread(const CwLayerWork *work, Fan *fan, int32_t *order, int32_t *count) {
  CwStatus status = CW_OK;
  CwHeap heap = {0};
  uint8_t *done_with = NULL;
  CW_NEW(done_with, work->n);
  *count = 0;
  for (int32_t v = 0; v < work->n; v++) {
    fan[v] = (Fan){.distance = INFINITY, .source = -1, .widen = 1};
    if (!is_source(work, v, &fan[v])) continue;
    memcpy(fan[v].given, fan[v].u, sizeof fan[v].u);
    sliding_direction(work, v, fan[v].line);
    CW_TRY(cw_heap_push(&heap, 0, v));
  }
  while (heap.count) {
    int32_t v = cw_heap_pop(&heap).v;
    if (done_with[v]) continue;
    done_with[v] = 1;
    if (fan[v].source != v || length3(fan[v].line) > 0) order[(*count)++] = v;
    for (int32_t k = work->near_start[v]; k < work->near_start[v + 1]; k++) {
      int32_t w = work->near[k];
      double distance = fan[v].distance + distance3(work->in->x[v], work->in->x[w]);
      if (distance >= fan[w].distance || distance > REACH * fan[v].height) continue;
      fan[w].distance = distance;
      fan[w].opening = fan[v].opening;
      fan[w].height = fan[v].height;
      fan[w].source = fan[v].source;
      CW_TRY(cw_heap_push(&heap, distance, w));
    }
  }
done:
  cw_heap_free(&heap);
  free(done_with);
  return status;
}

static double range(const CwLayerWork *work, int32_t v, const Fan *fan) {
  double fade = fmax(0, 1 - fan->distance / (FADE * fan->height));
  return 1.5 * work->t[v] * fmax(0.7, fan->opening * fade) * fan->widen;
}

// One step of the solution at v; returns how far its displacement moved, in heights.
static double relax(const CwLayerWork *work, Fan *fan, int32_t v) {
  double reach = range(work, v, &fan[v]), l2 = reach * reach, sum[3] = {0}, weights = 0, u[3];
  for (int32_t k = work->near_start[v]; k < work->near_start[v + 1]; k++) {
    int32_t w = work->near[k];
    memcpy(u, fan[w].u, sizeof u);
    if (work->crease[w] == CW_CREASE_CONVEX && fan[w].source != w) {
      // A convex edge may lean along itself only; across it the lean of v goes on undisturbed.
      double h = dot3(work->along[w], u) - dot3(work->along[w], fan[v].u);
      for (int c = 0; c < 3; c++) u[c] = fan[v].u[c] + h * work->along[w][c];
    }
    for (int c = 0; c < 3; c++) sum[c] += work->weight[k] * u[c];
    weights += work->weight[k];
  }
  for (int c = 0; c < 3; c++) u[c] = l2 * sum[c] / (work->area[v] + l2 * weights);
  if (fan[v].source == v) {
    double h = dot3(fan[v].line, u);
    for (int c = 0; c < 3; c++) u[c] = fan[v].given[c] + h * fan[v].line[c];
  } else {
    allow(work, v, u);
  }
  double moved = distance3(fan[v].u, u) / work->t[v];
  memcpy(fan[v].u, u, sizeof u);
  return moved;
}

// Relaxes the vertices of `order` outward and inward by turns: news of a source crosses the whole reach in
// one sweep.
static void solve(const CwLayerWork *work, Fan *fan, const int32_t *order, int32_t count, int sweeps) {
  for (int i = 0; i < sweeps; i++) {
    double most = 0;
    for (int32_t k = 0; k < count; k++) most = fmax(most, relax(work, fan, order[i % 2 ? count - 1 - k : k]));
    if (most < SETTLED) break;
  }
}

// Leans the column of v as the fan asks, but no further than LEAST_COSINE allows, and keeps its normal
// height.
static void lean(CwLayerWork *work, int32_t v, const Fan *fan) {
  double least = fmin(LEAST_COSINE, 0.6 * work->base_cos[v]), scale = 1;
  double height = cw_layers_least_cosine(work, v, work->column[v]);
  for (int halving = 0; halving < 6; halving++, scale *= 0.5) {
    double column[3];
    for (int k = 0; k < 3; k++) {
      double u = fan->u[k] - (fan->source == v ? fan->given[k] : 0);
      column[k] = work->column[v][k] + scale * u / work->t[v];
    }
    double now = cw_layers_least_cosine(work, v, column);
    if (now < least * length3(column)) continue;
    for (int k = 0; k < 3; k++) work->column[v][k] = column[k] * fmin(height / now, 1.5);
    return;
  }
}

// Widens the fan around poor prisms; returns how many there are. At a corner that juts into the wall (a
// blade's bevel on the
// hub) the solution falls off faster than beside a straight crease, and more so the finer the mesh.
static int32_t widen(const CwLayerWork *work, Fan *fan, const int32_t *order, int32_t count, double (*front)[3]) {
  const CwLayerInput *in = work->in;
  int32_t poor = 0;
  for (int32_t v = 0; v < work->n; v++) // the snap changes too little to matter here
    for (int k = 0; k < 3; k++) front[v][k] = in->x[v][k] + work->t[v] * work->column[v][k];
  for (int32_t f = 0; f < in->triangle_count; f++) {
    const int32_t *v = in->triangle[f];
    if (fan[v[0]].source < 0 && fan[v[1]].source < 0 && fan[v[2]].source < 0) continue;
    if (cw_layers_prism_quality(work, f, (const double (*)[3])front) >= POOR) continue;
    poor++;
    for (int i = 0; i < 3; i++) fan[v[i]].widen = fmin(fan[v[i]].widen * 1.4, WIDEST);
  }
  // Over about a height around, so that the lean stays smooth.
  for (int pass = 0; pass < 2; pass++)
    for (int32_t i = 0; i < count && poor; i++) {
      int32_t v = order[pass ? count - 1 - i : i];
      for (int32_t k = work->near_start[v]; k < work->near_start[v + 1]; k++) {
        double away = distance3(in->x[v], in->x[work->near[k]]) / work->t[v];
        fan[v].widen = fmax(fan[v].widen, fan[work->near[k]].widen * exp(-0.5 * away));
      }
    }
  return poor;
}

CwStatus cw_layers_fan(CwLayerWork *work) {
  CwStatus status = CW_OK;
  Fan *fan = NULL;
  int32_t *order = NULL, *wide = NULL, count = 0;
  double (*front)[3] = NULL;
  CW_NEW(fan, work->n);
  CW_NEW(order, work->n);
  CW_NEW(wide, work->n);
  CW_NEW(front, work->n);
  CW_TRY(spread(work, fan, order, &count));
  for (int32_t i = 0; i < count; i++) {
    Fan *at = &fan[order[i]];
    if (at->source == order[i]) continue;
    double fall = exp(-at->distance / range(work, order[i], at));
    for (int k = 0; k < 3; k++) at->u[k] = fall * fan[at->source].u[k];
    allow(work, order[i], at->u);
  }
  for (int round = 0; round <= WIDENINGS; round++) {
    if (round == 0) {
      solve(work, fan, order, count, SWEEPS);
    } else { // where nothing was widened the solution stands
      int32_t active = 0;
      for (int32_t i = 0; i < count; i++)
        if (fan[order[i]].widen > 1.05) wide[active++] = order[i];
      solve(work, fan, wide, active, MORE_SWEEPS);
    }
    for (int32_t v = 0; v < work->n; v++) cw_layers_set_column(work, v, work->base[v], cw_layers_floor(work, v));
    for (int32_t i = 0; i < count; i++) lean(work, order[i], &fan[order[i]]);
    if (round == WIDENINGS || widen(work, fan, order, count, front) == 0) break;
  }
done:
  free(fan);
  free(order);
  free(wide);
  free(front);
  return status;
}
