// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/layers/layers_turn.h"

#include <math.h>

#include "mesher/common/vec.h"
#include "mesher/layers/layers_normal.h"
#include "mesher/layers/prism_quality.h"
#include "mesher/policy.h"

static const double MUCH = 100; // more than any quality
// Least cosine of the normals of a surface at the ends of an edge, and most sine of an edge to it, for the edge to lie
// in it.
static const double SAME_SURFACE = 0.9, IN_SURFACE = 0.1;

double cw_layers_prism_quality(const CwLayerWork *work, int32_t f, const double (*top)[3]) {
  const int32_t *v = work->in->triangle[f];
  const double(*x)[3] = work->in->x;
  const double *const wall[3] = {x[v[0]], x[v[1]], x[v[2]]}, *const end[3] = {top[v[0]], top[v[1]], top[v[2]]};
  return cw_prism_quality(wall, end);
}

double cw_layers_top_quality(const CwLayerWork *work, int32_t f, const double (*top)[3]) {
  const int32_t *v = work->in->triangle[f];
  const double(*x)[3] = work->in->x;
  const double *const wall[3] = {x[v[0]], x[v[1]], x[v[2]]}, *const end[3] = {top[v[0]], top[v[1]], top[v[2]]};
  return cw_policy.turn_top * cw_prism_top_quality(wall, end);
}

static double shear_quality(const CwLayerWork *work, int32_t f, const double (*top)[3]) {
  const int32_t *v = work->in->triangle[f];
  const double(*x)[3] = work->in->x;
  const double *const wall[3] = {x[v[0]], x[v[1]], x[v[2]]}, *const end[3] = {top[v[0]], top[v[1]], top[v[2]]};
  const CwLayerDivision *division = &work->in->division;
  if (division->count < 1) return cw_policy.prism_good;
  double last[3], normal[3], column[3];
  cw_normal(wall[0], wall[1], wall[2], normal);
  cw_unit(normal);
  for (int k = 0; k < 3; k++) {
    cw_sub(wall[k], end[k], column);
    last[k] =
        division->last ? division->last(division->context, v[k], fabs(cw_dot(column, normal))) : 1.0 / division->count;
  }
  return cw_policy.prism_good * cw_prism_shear_quality(wall, end, division->count, last);
}

// Normal of what holds both vertices a and b of the wall, with the edge of their ends in it; NULL where nothing does.
static const double *held_edge(const CwLayerInput *in, int32_t a, int32_t b, const double edge[3]) {
  for (int i = 0; i < in->constraint_count[a]; i++) {
    const double *normal = in->constraint_normal[a][i];
    for (int j = 0; j < in->constraint_count[b]; j++) {
      double off = fabs(cw_dot(edge, normal)), along = fabs(cw_dot(normal, in->constraint_normal[b][j]));
      if (along > SAME_SURFACE && off < IN_SURFACE * cw_norm(edge)) return normal;
    }
  }
  return NULL;
}

// By the angle, beyond the layers, between the layer top and the surface that holds one of its edges. The cells on the
// two triangles that meet there have different apexes as a rule, and so another cell between them: there is to be room
// for three.
static double wedge_quality(const CwLayerWork *work, int32_t f, const double (*top)[3]) {
  const CwLayerInput *in = work->in;
  const double wanted = 3 * asin(cw_policy.search_wanted);
  double narrowest = wanted;
  for (int k = 0; k < 3 && in->constraint_count; k++) {
    int32_t a = in->triangle[f][k], b = in->triangle[f][(k + 1) % 3], c = in->triangle[f][(k + 2) % 3];
    double edge[3], column[3], away[3], rise[3];
    if (!in->constraint_count[a] || !in->constraint_count[b]) continue;
    const int32_t of = cw_layer_pinched(in, a) ? b : a;
    if (cw_layer_pinched(in, of)) continue;
    cw_sub(top[b], top[a], edge);
    const double *normal = held_edge(in, a, b, edge);
    if (!normal) continue;
    cw_cross(normal, edge, away);
    cw_sub(top[of], in->x[of], column);
    if (cw_dot(away, column) < 0) cw_cross(edge, normal, away);
    cw_sub(top[c], top[a], rise);
    cw_unit(edge);
    cw_flatten(rise, edge);
    narrowest = fmin(narrowest, acos(fmin(1, cw_dot(rise, away) / (cw_norm(rise) * cw_norm(away)))));
  }
  return cw_policy.prism_good * (narrowest / wanted);
}

double cw_layers_lean_quality(const CwLayerWork *work, int32_t f, const double (*top)[3]) {
  return fmin(shear_quality(work, f, top), wedge_quality(work, f, top));
}

double cw_layers_around(const CwLayerWork *work, int32_t v, const double (*top)[3], double floor, int32_t *first) {
  double prism = INFINITY, end = INFINITY, quality = INFINITY;
  int32_t start = work->face_start[v], count = work->face_start[v + 1] - start, worst = *first;
  for (int32_t i = 0; i < count && quality > floor; i++) {
    int32_t at = (*first + i) % count, f = work->face[start + at];
    double q = cw_layers_prism_quality(work, f, top), before = quality;
    if (q < prism) prism = q;
    if (prism < cw_policy.prism_good) {
      quality = prism - MUCH;
    } else {
      double lean = cw_layers_lean_quality(work, f, top);
      q = cw_layers_top_quality(work, f, top);
      if (lean < cw_policy.prism_good) q = fmin(q, lean);
      if (q < end) end = q;
      quality = end < prism ? end : prism;
    }
    if (quality < before) worst = at;
  }
  *first = worst;
  return quality;
}

// A column that is turned, and the best that it has been.
typedef struct {
  CwLayerWork *work;
  int32_t v;
  double (*top)[3];
  CwLayerJudge judge;
  int32_t first; // of the judge
  double least_cosine, quality, end[3], column[3];
} Turn;

// Keeps a direction that is better than all before.
static void offer(Turn *turn, double direction[3]) {
  CwLayerWork *work = turn->work;
  int32_t v = turn->v;
  cw_unit(direction);
  double cosine = cw_layers_least_cosine(work, v, direction);
  if (!(cosine >= turn->least_cosine)) return;
  for (int k = 0; k < 3; k++) work->column[v][k] = direction[k] / fmax(cosine, cw_policy.column_least_cosine);
  cw_layers_place(work, v, turn->top[v]);
  double quality = turn->judge(work, v, (const double(*)[3])turn->top, turn->quality, &turn->first);
  if (quality <= turn->quality) return;
  turn->quality = quality;
  cw_copy(turn->top[v], turn->end);
  cw_copy(work->column[v], turn->column);
}

// The direction to the middle of the ends of the columns around.
static void offer_middle(Turn *turn) {
  const CwLayerWork *work = turn->work;
  const CwLayerInput *in = work->in;
  int32_t v = turn->v, first = work->near_start[v], count = work->near_start[v + 1] - first;
  double middle[3] = {0};
  for (int32_t i = 0; i < 3 * count; i++) middle[i % 3] += turn->top[work->near[first + i / 3]][i % 3] / count;
  cw_sub(middle, in->x[v], middle);
  if (cw_layer_constraints(in, v) == 1) cw_flatten(middle, in->constraint_normal[v][0]);
  offer(turn, middle);
}

void cw_layers_turn(CwLayerWork *work, int32_t v, double (*top)[3], CwLayerJudge judge, int finely) {
  const CwLayerInput *in = work->in;
  const double step[3] = {0.25, 0.1, 0.04};
  int constraints = cw_layer_constraints(in, v);
  if (constraints == 2 || cw_layer_pinched(in, v)) return;
  Turn turn = {.work = work, .v = v, .top = top, .judge = judge};
  turn.least_cosine = fmin(cw_policy.column_least_cosine, 0.9 * work->base_cos[v]);
  turn.quality = judge(work, v, (const double(*)[3])top, -INFINITY, &turn.first);
  cw_copy(top[v], turn.end);
  cw_copy(work->column[v], turn.column);
  if (finely) offer_middle(&turn);
  for (int s = 0; s < (finely ? 3 : 2); s++) {
    double g[3] = {turn.column[0], turn.column[1], turn.column[2]}, side[3], up[3] = {0};
    cw_unit(g);
    if (constraints == 1) {
      cw_cross(g, in->constraint_normal[v][0], side);
    } else {
      const double e[3] = {fabs(g[0]) < 0.6, fabs(g[0]) >= 0.6, 0};
      cw_cross(g, e, side);
    }
    cw_unit(side);
    if (constraints == 0) cw_cross(g, side, up);
    double slope = tan(step[s]);
    for (int i = 0; i < 8; i++) {
      if (constraints == 1 && i % 4) continue;
      double angle = i * M_PI / 4, c = cos(angle), d = sin(angle), trial[3];
      for (int k = 0; k < 3; k++) trial[k] = g[k] + slope * (c * side[k] + d * up[k]);
      offer(&turn, trial);
    }
  }
  cw_copy(turn.end, top[v]);
  cw_copy(turn.column, work->column[v]);
}
