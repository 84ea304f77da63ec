// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/layers/layers_normal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/model_unit.h"
#include "mesher/common/vec.h"
#include "mesher/parallel/parallel_for.h"
#include "mesher/policy.h"

static const double APART = 2; // longest edges of a triangle: places where nothing helps

// What keeps the best candidate direction.
typedef struct {
  int count;
  const double (*normal)[3];
  double best, g[3];
} Search;

static void offer(Search *search, const double candidate[3]) {
  double g[3] = {candidate[0], candidate[1], candidate[2]};
  if (!(cw_unit(g) >= 1e-12)) return; // nor where two normals are one
  double least = INFINITY;
  for (int i = 0; i < search->count; i++) {
    double c = cw_dot(search->normal[i], g);
    if (c <= search->best) return;
    if (c < least) least = c;
  }
  search->best = least;
  memcpy(search->g, g, sizeof g);
}

static void offer_both(Search *search, const double candidate[3]) {
  const double other[3] = {-candidate[0], -candidate[1], -candidate[2]};
  offer(search, candidate);
  offer(search, other);
}

static void search_free(Search *search) {
  const double(*n)[3] = search->normal;
  for (int i = 0; i < search->count; i++) offer(search, n[i]);
  for (int i = 0; i < search->count; i++)
    for (int j = i + 1; j < search->count; j++) {
      double edge[3], g[3]; // nearest to 0 on the line of both
      cw_sub(n[j], n[i], edge);
      cw_lerp(n[i], n[j], -cw_dot(n[i], edge) / cw_dot(edge, edge), g);
      offer(search, g);
    }
  for (int i = 0; i < search->count; i++)
    for (int j = i + 1; j < search->count; j++)
      for (int k = j + 1; k < search->count; k++) {
        double g[3];
        cw_normal(n[i], n[j], n[k], g);
        offer_both(search, g);
      }
}

// In the plane normal to m the cosine to n[i] is a cosine wave of the angle: the best is a crest or a
// crossing of two.
static void search_plane(Search *search, const double m[3]) {
  const double(*n)[3] = search->normal;
  for (int i = 0; i < search->count; i++) {
    double g[3] = {n[i][0], n[i][1], n[i][2]};
    cw_flatten(g, m);
    offer(search, g);
    for (int j = i + 1; j < search->count; j++) {
      cw_sub(n[i], n[j], g);
      cw_cross(m, g, g);
      offer_both(search, g);
    }
  }
}

double cw_layers_most_normal(int count, const double (*normal)[3], int constraint_count, const double (*constraint)[3],
                             double g[3]) {
  Search search = {.count = count, .normal = normal, .best = -2};
  double line[3] = {0};
  if (constraint_count == 2) cw_cross(constraint[0], constraint[1], line);
  if (constraint_count == 0)
    search_free(&search);
  else if (constraint_count == 2 && cw_norm(line) > 1e-3)
    offer_both(&search, line);
  else
    search_plane(&search, constraint[0]);
  memcpy(g, search.g, sizeof search.g);
  return search.best;
}

// The greatest share of a face's normal that a direction can have with any one other face: the cosine of half the angle
// between their normals, the least over all others. Near 0 at a knife edge.
static double best_share(int count, const double (*normal)[3], int i) {
  double least = 1;
  for (int j = 0; j < count; j++) least = fmin(least, cw_dot(normal[i], normal[j]));
  return sqrt(fmax(1 + least, 0) / 2);
}

double cw_layers_fair_normal(int count, const double (*normal)[3], int constraint_count, const double (*constraint)[3],
                             double g[3]) {
  double scaled[CW_LAYER_NORMALS][3], fair[3], least = INFINITY;
  double best = cw_layers_most_normal(count, normal, constraint_count, constraint, g);
  if (count < 3 || count > CW_LAYER_NORMALS || best <= CW_LAYERS_LEAST_COSINE) return best;
  for (int i = 0; i < count; i++) {
    double share = best_share(count, normal, i);
    for (int k = 0; k < 3; k++) scaled[i][k] = normal[i][k] / share;
  }
  cw_layers_most_normal(count, (const double(*)[3])scaled, constraint_count, constraint, fair);
  for (int i = 0; i < count; i++) least = fmin(least, cw_dot(normal[i], fair));
  if (least <= CW_LAYERS_LEAST_COSINE) return best;
  cw_copy(fair, g);
  return least;
}

// Distinct normals around vertex v, at most CW_LAYER_NORMALS; returns the count.
static int distinct_normals(const CwLayerWork *work, int32_t v, double (*normal)[3]) {
  // Vertices with very many faces lie on smooth surfaces; a coarser distinction is enough there.
  for (double same = 1e-9;; same *= 30) {
    int count = 0;
    int32_t k = work->face_start[v];
    for (; k < work->face_start[v + 1]; k++) {
      const double *n = work->face_normal[work->face[k]];
      int known = 0;
      for (int i = 0; i < count && !known; i++) known = cw_dot(n, normal[i]) > 1 - same;
      if (known) continue;
      if (count == CW_LAYER_NORMALS) break;
      memcpy(normal[count++], n, sizeof normal[0]);
    }
    if (k == work->face_start[v + 1]) return count;
  }
}

double cw_layers_least_cosine(const CwLayerWork *work, int32_t v, const double direction[3]) {
  double least = INFINITY;
  for (int32_t k = work->face_start[v]; k < work->face_start[v + 1]; k++) {
    double c = cw_dot(work->face_normal[work->face[k]], direction);
    if (c < least) least = c;
  }
  return least;
}

double cw_layers_floor(const CwLayerWork *work, int32_t v) {
  return work->crease[v] == CW_CREASE_CONCAVE ? cw_policy.column_least_cosine : cw_policy.upright_cosine;
}

void cw_layers_upright(const CwLayerWork *work, int32_t v, double column[3]) {
  double c = fmax(work->base_cos[v], cw_layers_floor(work, v));
  for (int k = 0; k < 3; k++) column[k] = work->base[v][k] / c;
}

void cw_layers_place(const CwLayerWork *work, int32_t v, double end[3]) {
  const CwLayerInput *in = work->in;
  for (int k = 0; k < 3; k++) end[k] = in->x[v][k] + work->t[v] * work->column[v][k];
  if (work->t[v] > 0 && in->snap && cw_layer_constraints(in, v) > 0) in->snap(in->snap_context, v, end);
}

// Direction of the edge of a crease: normal to its two most different faces, if the other faces share it.
static void edge_direction(int count, double (*normal)[3], double along[3]) {
  double largest = 0;
  const double crease = cw_policy.crease_cosine, most = sqrt(1 - crease * crease); // more off is a corner
  for (int i = 0; i < count; i++)
    for (int j = i + 1; j < count; j++) {
      double c[3];
      cw_cross(normal[i], normal[j], c);
      if (cw_norm(c) > largest) {
        largest = cw_norm(c);
        memcpy(along, c, sizeof c);
      }
    }
  cw_unit(along);
  for (int i = 0; i < count; i++)
    if (fabs(cw_dot(normal[i], along)) > most) memset(along, 0, 3 * sizeof *along);
}

typedef struct {
  double normal[3], normal_cos;
  int32_t crease;
} Direction;

static CwStatus find_direction(void *context, int32_t v, void *out) {
  const CwLayerWork *work = context;
  const CwLayerInput *in = work->in;
  const double none[2][3] = {{0}}, *x = in->x[v];
  Direction *made = out;
  double normal[CW_LAYER_NORMALS][3], *g = made->normal;
  if (cw_layer_pinched(in, v)) { // no direction: its neighbours do not lean from it
    made->normal_cos = 1;
    return CW_OK;
  }
  int count = distinct_normals(work, v, normal);
  double c = cw_layers_most_normal(count, (const double(*)[3])normal, 0, none, g), most = -1;
  made->normal_cos = c;
  if (c >= sqrt((1 + cw_policy.crease_cosine) / 2)) return CW_OK; // half the angle of a crease to either side
  for (int32_t k = work->near_start[v]; k < work->near_start[v + 1]; k++) {
    double e[3];
    cw_sub(in->x[work->near[k]], x, e);
    most = fmax(most, cw_dot(e, g) / cw_norm(e));
  }
  // At the fold of two planes the edges of the wall rise by the sine of what its normals lean by where they lie
  // straight across; some lie within 45 degrees of that.
  const double least = fmin(cw_policy.concave_rise, M_SQRT1_2 * sqrt(1 - c * c));
  made->crease = most > least ? CW_CREASE_CONCAVE : c < cw_policy.convex_cosine ? CW_CREASE_CONVEX : CW_CREASE_NONE;
  if (made->crease == CW_CREASE_CONCAVE)
    made->normal_cos = cw_layers_fair_normal(count, (const double(*)[3])normal, 0, none, g);
  return CW_OK;
}

// What the few vertices on creases and in constraints have besides.
typedef struct {
  const CwLayerWork *work;
  int32_t count, *vertex;
} Special;

typedef struct {
  double base[3], base_cos, along[3];
} Held;

static CwStatus find_held(void *context, int32_t i, void *out) {
  const Special *special = context;
  const CwLayerWork *work = special->work;
  int32_t v = special->vertex[i];
  Held *made = out;
  double normal[CW_LAYER_NORMALS][3];
  int count = distinct_normals(work, v, normal), constraints = cw_layer_constraints(work->in, v);
  if (work->crease[v] != CW_CREASE_NONE) edge_direction(count, normal, made->along);
  memcpy(made->base, work->normal[v], sizeof made->base);
  made->base_cos = work->normal_cos[v];
  if (constraints == 0) return CW_OK;
  made->base_cos = (work->crease[v] == CW_CREASE_CONCAVE ? cw_layers_fair_normal : cw_layers_most_normal)(
      count, (const double(*)[3])normal, constraints, work->in->constraint_normal[v], made->base);
  return CW_OK;
}

CwOutcomeKind cw_layers_kind_at(const CwLayerWork *work, int32_t v) {
  return cw_layer_constraints(work->in, v) > 0 && !cw_layer_stays(work->in, v) ? CW_OUTCOME_REPLAN : CW_OUTCOME_PINCH;
}

void cw_layers_add_place(const CwLayerWork *work, int32_t f, int corner, CwOutcome *outcome, const char *why) {
  const int32_t *t = work->in->triangle[f], v = t[corner];
  const CwOutcomeKind kind = cw_layers_kind_at(work, v);
  double longest = 0;
  for (int k = 0; k < 3; k++) longest = fmax(longest, cw_distance(work->in->x[t[k]], work->in->x[t[(k + 1) % 3]]));
  if (outcome->kind == CW_OUTCOME_DONE) cw_outcome_set(outcome, kind, NULL, "%s", why);
  if (outcome->kind == kind) cw_outcome_add_place(outcome, work->in->x[v], APART * longest);
}

// Whether a column of this cosine leaves the wall inside what holds it at vertex v. Not in a block: all ranks fail
// alike, and may go on with other planes, or without layers there.
static void judge_column(const CwLayerWork *work, int32_t v, double cosine, CwOutcome *outcome) {
  if (cosine > CW_LAYERS_LEAST_COSINE) return;
  cw_outcome_set(outcome, cw_layers_kind_at(work, v), work->in->x[v],
                 "no column inside %s leaves the wall (best cosine %.3f, at least %.2f needed)",
                 cw_layer_stays(work->in, v) ? "the open patch" : "a partition plane", cosine, CW_LAYERS_LEAST_COSINE);
}

CwStatus cw_layers_normals(CwLayerWork *work, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  Direction *made = NULL;
  Special special = {.work = work};
  Held *held = NULL;
  CW_NEW_UNSET(made, work->n);
  CW_NEW_UNSET(special.vertex, work->n);
  CW_TRY(cw_parallel_for(work->in->context, "layers: directions", work->n, sizeof *made, find_direction, work, made));
  for (int32_t v = 0; v < work->n; v++) {
    CW_END_UNLESS(made[v].normal_cos > CW_LAYERS_LEAST_COSINE, outcome, cw_layers_kind_at(work, v), work->in->x[v],
                  "the wall faces see no common direction (best cosine %.3f, at least %.2f needed): the wall is "
                  "folded or has an edge too sharp there",
                  made[v].normal_cos, CW_LAYERS_LEAST_COSINE);
    memcpy(work->normal[v], made[v].normal, sizeof made[v].normal);
    memcpy(work->base[v], made[v].normal, sizeof made[v].normal);
    work->normal_cos[v] = work->base_cos[v] = made[v].normal_cos;
    work->crease[v] = (uint8_t)made[v].crease;
    if (cw_layer_pinched(work->in, v)) continue;
    if (made[v].crease != CW_CREASE_NONE || cw_layer_constraints(work->in, v) > 0) special.vertex[special.count++] = v;
  }
  CW_NEW_UNSET(held, special.count);
  CW_TRY(
      cw_parallel_for(work->in->context, "layers: directions", special.count, sizeof *held, find_held, &special, held));
  for (int32_t i = 0; i < special.count; i++) {
    int32_t v = special.vertex[i];
    judge_column(work, v, held[i].base_cos, outcome);
    if (outcome->kind != CW_OUTCOME_DONE) goto done;
    memcpy(work->base[v], held[i].base, sizeof held[i].base);
    memcpy(work->along[v], held[i].along, sizeof held[i].along);
    work->base_cos[v] = held[i].base_cos;
  }
  for (int32_t v = 0; v < work->n; v++) cw_layers_upright(work, v, work->column[v]);
done:
  free(made);
  free(special.vertex);
  free(held);
  return status;
}
