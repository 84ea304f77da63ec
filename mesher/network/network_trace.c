// SPDX-License-Identifier: AGPL-3.0-or-later
// Cut curves: the traces of a partition plane on the CAD faces, found on the background triangulation (marked edges,
// chained to loops and arcs: paper, section 2.2, steps 1 to 4) and then put exactly onto plane and surface.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/cad/cad_leave_out.h"
#include "mesher/common/vec.h"
#include "mesher/network/network.h"
#include "pipeline/order.h"

enum { EDGE_SAMPLES = 257 };
static const double FOUND = 1e-9; // of the model's unit: Newton has arrived
// Of the model's unit, over the length of a background edge: a corner found farther off is another.
static const double BESIDE = 1e-4;

// A background edge that the plane crosses, as seen from one of its two triangles.
typedef struct {
  int32_t a, b, triangle; // a < b
} Crossing;

// The crossings of one plane: key k is crossing[2k] and crossing[2k + 1], the same edge from its two triangles.
typedef struct {
  const CwBackground *background;
  const CwPlane *plane;
  int32_t key_count;
  Crossing *crossing;
  int32_t (*keys_of)[2]; // of each background triangle, -1: not crossed
} Crossings;

typedef struct {
  double x[3], uv[2];
} Point;

// One trace on one face.
typedef struct {
  int32_t face, count, capacity, closed;
  Point *point;
  CwCorner end[2]; // on the CAD edges where an open trace begins and ends
} Trace;

// Where another plane divides a trace.
typedef struct {
  double place; // segment number + fraction
  Point at;
  int32_t plane;
} Split;

static int compare_crossings(const void *p, const void *q) {
  const Crossing *a = p, *b = q;
  if (a->a != b->a) return a->a < b->a ? -1 : 1;
  if (a->b != b->b) return a->b < b->b ? -1 : 1;
  return (a->triangle > b->triangle) - (a->triangle < b->triangle);
}

static CwStatus find_crossings(Crossings *found) {
  CwStatus status = CW_OK;
  const CwBackground *background = found->background;
  uint8_t *above = NULL;
  int32_t count = 0;
  CW_NEW(above, background->point_count);
  for (int32_t i = 0; i < background->point_count; i++) {
    above[i] = cw_plane_distance(found->plane, background->x[i]) > 0;
  }
  for (int32_t t = 0; t < background->triangle_count; t++) {
    const int32_t *c = background->triangle[t];
    count += 2 * (above[c[0]] != above[c[1]] || above[c[1]] != above[c[2]]);
  }
  CW_NEW(found->crossing, count);
  CW_NEW(found->keys_of, background->triangle_count);
  count = 0;
  for (int32_t t = 0; t < background->triangle_count; t++) {
    found->keys_of[t][0] = found->keys_of[t][1] = -1;
    for (int k = 0; k < 3; k++) {
      int32_t a = background->triangle[t][k], b = background->triangle[t][(k + 1) % 3];
      if (above[a] == above[b]) continue;
      found->crossing[count++] = a < b ? (Crossing){a, b, t} : (Crossing){b, a, t};
    }
  }
  qsort(found->crossing, (size_t)count, sizeof *found->crossing, compare_crossings);
  found->key_count = count / 2;
  for (int32_t i = 0; i < count; i++) {
    int32_t *keys = found->keys_of[found->crossing[i].triangle];
    keys[keys[0] >= 0] = i / 2;
  }
done:
  free(above);
  return status;
}

static int on_face_border(const Crossings *found, int32_t key) {
  const int32_t *face = found->background->face;
  return face[found->crossing[2 * key].triangle] != face[found->crossing[2 * key + 1].triangle];
}

// (u,v) of the crossing on the face of `triangle`, linear along the background edge, and its place in space.
static void crossing_on_face(const Crossings *found, int32_t key, int32_t triangle, double uv[2], double x[3]) {
  const CwBackground *background = found->background;
  const Crossing *crossing = &found->crossing[2 * key];
  double da = cw_plane_distance(found->plane, background->x[crossing->a]);
  double db = cw_plane_distance(found->plane, background->x[crossing->b]);
  double s = da / (da - db);
  const double *uv_a = NULL, *uv_b = NULL;
  for (int k = 0; k < 3; k++) {
    if (background->triangle[triangle][k] == crossing->a) uv_a = background->uv[triangle][k];
    if (background->triangle[triangle][k] == crossing->b) uv_b = background->uv[triangle][k];
  }
  for (int k = 0; k < 2; k++) uv[k] = uv_a[k] + s * (uv_b[k] - uv_a[k]);
  cw_lerp(background->x[crossing->a], background->x[crossing->b], s, x);
}

// Nearest sample of a CAD edge to x; returns the distance.
static double nearest_sample(const CwCad *cad, int32_t edge, const double x[3], double *t) {
  double range[2], best = INFINITY;
  cw_cad_edge_range(cad, edge, range);
  for (int i = 0; i < EDGE_SAMPLES; i++) {
    double at = range[0] + (range[1] - range[0]) * i / (EDGE_SAMPLES - 1), p[3];
    cw_cad_edge_point(cad, edge, at, p, NULL);
    double distance = cw_distance(p, x);
    if (distance < best) best = distance, *t = at;
  }
  return best;
}

// Moves a place along an edge onto a plane; returns the distance left.
static double edge_onto_plane(const CwCad *cad, const CwPlane *plane, int32_t edge, double *t, double x[3]) {
  double range[2], distance = INFINITY;
  cw_cad_edge_range(cad, edge, range);
  for (int step = 0; step < 50; step++) {
    double tangent[3];
    cw_cad_edge_point(cad, edge, *t, x, tangent);
    distance = cw_plane_distance(plane, x);
    double slope = cw_dot(plane->normal, tangent);
    if (fabs(distance) < 1e-13 || slope == 0) break;
    *t = fmin(fmax(*t - distance / slope, range[0]), range[1]);
  }
  return fabs(distance);
}

// The corner where the plane crosses the CAD edge that the background edge of `key` belongs to. Where that bounded a
// left-out face, it is the edge in its place, and the same corner from either side.
static CwStatus corner_on_edge(const CwNetwork *network, const Crossings *found, int32_t key, int32_t node,
                               CwCorner *corner, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  const CwCad *cad = network->cad;
  const CwBackground *background = found->background;
  int32_t f = background->face[found->crossing[2 * key].triangle];
  int32_t g = background->face[found->crossing[2 * key + 1].triangle];
  double uv[2], guess[3], best = INFINITY, beside = 0;
  crossing_on_face(found, key, found->crossing[2 * key].triangle, uv, guess);
  *corner = (CwCorner){{0}, -1, -1, 0, -1, {node, -1, -1}, 0};
  for (int32_t e = 0; e < cw_cad_edge_count(cad); e++) {
    double t = 0, gap, x[3];
    if (!cw_cad_edge_borders(cad, e, f, g)) continue;
    double distance = nearest_sample(cad, e, guess, &t);
    if (cw_cad_edge_stands_for(cad, e, &gap) >= 0) { // of several, one that the plane crosses
      if (edge_onto_plane(cad, found->plane, e, &t, x) >= FOUND) continue;
      distance = cw_distance(x, guess);
    }
    if (distance < best) best = distance, beside = gap, corner->edge = e, corner->t = t;
  }
  CW_END_UNLESS(corner->edge >= 0, outcome, CW_OUTCOME_REPLAN, guess, "no CAD edge between faces %s and %s",
                cw_cad_face_name(cad, f), cw_cad_face_name(cad, g));
  double distance = edge_onto_plane(cad, found->plane, corner->edge, &corner->t, corner->x);
  double length = cw_distance(background->x[found->crossing[2 * key].a], background->x[found->crossing[2 * key].b]);
  CW_END_UNLESS(distance < FOUND && cw_distance(corner->x, guess) < length + BESIDE + 2 * beside, outcome,
                CW_OUTCOME_REPLAN, guess, "partition plane %d grazes the edge between faces %s and %s", node,
                cw_cad_face_name(cad, f), cw_cad_face_name(cad, g));
done:
  return status;
}

// Whether a trace of `node` may be wanted at a crossing x: no piece outside of its cell is.
static int is_wanted(const CwNetwork *network, const Crossings *found, int32_t node, int32_t key, const double x[3]) {
  const Crossing *crossing = &found->crossing[2 * key];
  double length = cw_distance(found->background->x[crossing->a], found->background->x[crossing->b]);
  return cw_plan_in_cell(network->plan, node, x, length, NULL, 0);
}

// The end of a trace on the border of a face; outside of the cell one without an edge where there is no corner.
static CwStatus end_of_trace(const CwNetwork *network, const Crossings *found, int32_t key, int32_t triangle,
                             int32_t node, CwCorner *end, Point *point, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  int32_t face = found->background->face[triangle];
  crossing_on_face(found, key, triangle, point->uv, point->x);
  CW_TRY(corner_on_edge(network, found, key, node, end, outcome));
  if (outcome->kind == CW_OUTCOME_DONE) {
    cw_cad_edge_uv(network->cad, end->edge, face, end->t, point->uv);
    cw_copy(end->x, point->x);
  } else if (!is_wanted(network, found, node, key, point->x)) {
    *outcome = (CwOutcome){0};
    *end = (CwCorner){{0}, -1, -1, 0, -1, {node, -1, -1}, 0};
  }
done:
  return status;
}

// Walks from `key` through `triangle` to the end of the trace; marks triangles. Fills the trace.
static CwStatus walk(const CwNetwork *network, const Crossings *found, int32_t node, int32_t key, int32_t triangle,
                     uint8_t *seen, Trace *trace, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  const CwCad *cad = network->cad;
  int32_t face = found->background->face[triangle], first = key;
  *trace = (Trace){.face = face, .closed = !on_face_border(found, key)};
  for (;;) {
    CW_GROW(trace->point, trace->capacity, trace->count + 1);
    Point *point = &trace->point[trace->count];
    if (on_face_border(found, key)) {
      CwCorner *end = &trace->end[trace->count > 0];
      CW_TRY_STAGE(end_of_trace(network, found, key, triangle, node, end, point, outcome), outcome);
    } else {
      crossing_on_face(found, key, triangle, point->uv, point->x);
      double left = cw_face_onto_plane(cad, face, found->plane, point->uv, point->x);
      CW_END_UNLESS(left < FOUND || !is_wanted(network, found, node, key, point->x), outcome, CW_OUTCOME_REPLAN,
                    point->x, "partition plane %d grazes face %s", node, cw_cad_face_name(cad, face));
    }
    trace->count++;
    if (trace->count > 1 && (on_face_border(found, key) || key == first)) break;
    seen[triangle] = 1;
    key = found->keys_of[triangle][found->keys_of[triangle][0] == key];
    if (!on_face_border(found, key) && key != first) {
      const Crossing *pair = &found->crossing[2 * key];
      triangle = pair[0].triangle == triangle ? pair[1].triangle : pair[0].triangle;
    }
  }
done:
  return status;
}

// All places where planes that belong together with `node` divide the trace.
static CwStatus find_splits(const CwNetwork *network, int32_t node, const Trace *trace, int32_t *count, Split **splits,
                            CwOutcome *outcome) {
  CwStatus status = CW_OK;
  const CwPlan *plan = network->plan;
  int32_t capacity = 16;
  *count = 0;
  CW_NEW(*splits, capacity);
  for (int32_t q = 0; q < plan->node_count; q++) {
    int below = q != node && cw_plan_is_ancestor(plan, node, q);
    if (!below && !cw_plan_is_ancestor(plan, q, node)) continue;
    const CwPlane *other = &plan->node[q].plane;
    for (int32_t i = 0; i + 1 < trace->count; i++) {
      const Point *from = &trace->point[i], *to = from + 1;
      double d0 = cw_plane_distance(other, from->x), d1 = cw_plane_distance(other, to->x);
      if ((d0 > 0) == (d1 > 0)) continue;
      double s = d0 / (d0 - d1), guess[3];
      int32_t skip[1] = {node};
      cw_lerp(from->x, to->x, s, guess);
      if (below && !cw_plan_in_cell(plan, q, guess, cw_distance(from->x, to->x), skip, 1)) continue;
      Split split = {.place = i + s, .plane = q};
      for (int k = 0; k < 2; k++) split.at.uv[k] = from->uv[k] + s * (to->uv[k] - from->uv[k]);
      double left =
          cw_face_onto_planes(network->cad, trace->face, &plan->node[node].plane, other, split.at.uv, split.at.x);
      CW_END_UNLESS(left < FOUND, outcome, CW_OUTCOME_REPLAN, from->x,
                    "partition planes %d and %d meet too flatly on face %s", node, q,
                    cw_cad_face_name(network->cad, trace->face));
      if (below && !cw_plan_in_cell(plan, q, split.at.x, 1e-9, skip, 1)) continue;
      CW_END_UNLESS(trace->closed || (split.place > 0 && split.place < trace->count - 1), outcome, CW_OUTCOME_REPLAN,
                    split.at.x, "partition planes %d and %d meet on the border of face %s", node, q,
                    cw_cad_face_name(network->cad, trace->face));
      CW_GROW(*splits, capacity, *count + 1);
      (*splits)[(*count)++] = split;
    }
  }
  qsort(*splits, (size_t)*count, sizeof **splits, cw_order_doubles);
done:
  return status;
}

static CwCorner split_corner(int32_t face, int32_t node, const Split *split) {
  CwCorner corner = {{split->at.x[0], split->at.x[1], split->at.x[2]}, face, -1, 0, -1, {node, -1, -1}, 0};
  corner.plane[0] = node < split->plane ? node : split->plane;
  corner.plane[1] = node < split->plane ? split->plane : node;
  return corner;
}

static void add_point(const Point *point, int32_t i, CwCurve *curve) {
  cw_copy(point->x, curve->fine_x[i]);
  memcpy(curve->fine_parameter[i], point->uv, sizeof point->uv);
}

// Adds the piece of the trace between two places as a curve, where it lies in the cell of `node`. NULL splits: the
// ends of the trace. On a closed trace `to` may lie before `from`.
static CwStatus add_piece(CwNetwork *network, int32_t node, const Trace *trace, const Split *from, const Split *to,
                          CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwCurve curve = {.kind = CW_CURVE_CUT,
                   .edge = -1,
                   .face = {trace->face, -1},
                   .plane = {node, -1},
                   .wall = cw_cad_face_is_wall(network->cad, trace->face)};
  int32_t segments = trace->count - 1; // a closed trace repeats its first point at its end
  int32_t first = from ? (int32_t)floor(from->place) + 1 : 0;
  int32_t last = to ? (int32_t)floor(to->place) : segments;
  if (trace->closed && from && to && to->place <= from->place) last += segments;
  CW_TRY(cw_curve_fine_make(last - first + 1 + (from != NULL) + (to != NULL), &curve));
  int32_t count = 0;
  if (from) add_point(&from->at, count++, &curve);
  for (int32_t i = first; i <= last; i++) {
    add_point(&trace->point[i >= segments && trace->closed && from ? i - segments : i], count++, &curve);
  }
  if (to) add_point(&to->at, count++, &curve);
  double middle[3];
  int32_t half = curve.fine_count / 2;
  cw_lerp(curve.fine_x[half - 1], curve.fine_x[half], 0.5, middle);
  if (!cw_plan_in_cell(network->plan, node, middle, 0, NULL, 0)) goto done;

  CwCorner ends[2] = {trace->end[0], trace->end[1]};
  if (trace->closed && !from) {
    ends[0] = (CwCorner){{0}, trace->face, -1, 0, -1, {node, -1, -1}, 0};
    cw_copy(trace->point[0].x, ends[0].x);
    ends[1] = ends[0];
  }
  if (from) ends[0] = split_corner(trace->face, node, from);
  if (to) ends[1] = split_corner(trace->face, node, to);
  for (int k = 0; k < 2; k++) {
    CW_END_UNLESS(ends[k].face >= 0 || ends[k].edge >= 0, outcome, CW_OUTCOME_REPLAN, middle,
                  "partition plane %d grazes an edge of face %s", node, cw_cad_face_name(network->cad, trace->face));
    CW_TRY(cw_network_corner(network, &ends[k], cw_same_corner, &curve.corner[k]));
  }
  return cw_network_add_curve(network, &curve);
done:
  cw_curve_fine_free(&curve);
  return status;
}

static CwStatus add_trace(CwNetwork *network, int32_t node, const Trace *trace, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  Split *split = NULL;
  int32_t count = 0;
  CW_TRY_STAGE(find_splits(network, node, trace, &count, &split, outcome), outcome);
  if (trace->closed && count) {
    for (int32_t i = 0; i < count; i++)
      CW_TRY_STAGE(add_piece(network, node, trace, &split[i], &split[(i + 1) % count], outcome), outcome);
  } else {
    for (int32_t i = 0; i <= count; i++) {
      const Split *from = i > 0 ? &split[i - 1] : NULL, *to = i < count ? &split[i] : NULL;
      CW_TRY_STAGE(add_piece(network, node, trace, from, to, outcome), outcome);
    }
  }
done:
  free(split);
  return status;
}

CwStatus cw_network_trace(CwNetwork *network, const CwBackground *background, int32_t node, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  Crossings found = {.background = background, .plane = &network->plan->node[node].plane};
  uint8_t *seen = NULL;
  Trace trace = {0};
  CW_TRY(find_crossings(&found));
  CW_NEW(seen, background->triangle_count);
  for (int32_t t = 0; t < background->triangle_count; t++)
    seen[t] = (uint8_t)cw_cad_face_is_left_out(network->cad, background->face[t]);
  // Open traces first, from their ends on the borders of faces; what is left are closed loops inside one face.
  for (int pass = 0; pass < 2; pass++) {
    for (int32_t i = 0; i < 2 * found.key_count; i++) {
      int32_t triangle = found.crossing[i].triangle;
      if (seen[triangle] || (pass == 0 && !on_face_border(&found, i / 2))) continue;
      CW_TRY_STAGE(walk(network, &found, node, i / 2, triangle, seen, &trace, outcome), outcome);
      CW_TRY_STAGE(add_trace(network, node, &trace, outcome), outcome);
      free(trace.point);
      trace = (Trace){0};
    }
  }
done:
  free(trace.point);
  free(found.crossing);
  free(found.keys_of);
  free(seen);
  return status;
}
