// SPDX-License-Identifier: AGPL-3.0-or-later
// The division of the wall curves into mesh edges, and what holds the columns along them.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/boundary/boundary_curves.h"
#include "mesher/boundary/curve_division.h"
#include "mesher/boundary/nose_division.h"
#include "mesher/common/model_unit.h"
#include "mesher/common/vec.h"
#include "mesher/parallel/schedule.h"

enum { MOST_FOR_BENDS = 12 };
// Of the length of an edge, how far its curve may lie beside it: a circle's edges turn by 62 degrees.
static const double MOST_BESIDE = 0.14;

// What holds the columns along a wall curve: the partition plane of a cut, the open patch at an open edge, nothing
// else.
static CwConstraint curve_constraint(const CwBoundaryInput *in, const CwCurve *curve) {
  if (curve->kind == CW_CURVE_CUT) return (CwConstraint){CW_CONSTRAINT_PLANE, curve->plane[0]};
  for (int k = 0; k < 2; k++) {
    if (!cw_cad_face_is_wall(in->cad, curve->face[k])) return (CwConstraint){CW_CONSTRAINT_PATCH, curve->face[k]};
  }
  return (CwConstraint){CW_CONSTRAINT_NONE, -1};
}

// What holds the column at a wall corner: the free curve that starts there; else the one open patch or plane of its
// curves.
static CwConstraint corner_constraint(const CwBoundaryInput *in, int32_t corner) {
  CwConstraint constraint = {CW_CONSTRAINT_NONE, -1};
  for (int32_t i = 0; i < in->network->curve_count; i++) {
    const CwCurve *curve = &in->network->curve[i];
    if (curve->corner[0] != corner && curve->corner[1] != corner) continue;
    if (!curve->wall) return (CwConstraint){CW_CONSTRAINT_CURVE, i};
    CwConstraint along = curve_constraint(in, curve);
    if (along.kind != CW_CONSTRAINT_NONE) constraint = along;
  }
  return constraint;
}

// The open edge that a curve is a piece of, NULL where it is of none.
static const CwDividedEdge *open_edge_of(const CwOpenEdges *edges, const CwCurve *curve) {
  for (int32_t i = 0; i < edges->count && curve->kind == CW_CURVE_EDGE; i++) {
    if (edges->edge[i].edge == curve->edge) return &edges->edge[i];
  }
  return NULL;
}

// Division of a piece of an open edge: arc lengths by the fine polyline, whose steps are even in the parameter. NULL
// where the division is not given.
static CwStatus divide_open_edge(const CwOpenEdges *edges, const CwCurve *curve, int32_t *count, double **place) {
  CwStatus status = CW_OK;
  const CwDividedEdge *open_edge = open_edge_of(edges, curve);
  *count = 0;
  int32_t last = curve->fine_count - 1;
  double from = curve->fine_parameter[0][0], to = curve->fine_parameter[last][0];
  if (!open_edge) goto done;
  CW_NEW(*place, open_edge->count + 2);
  *count = 1;
  for (int32_t i = 0; i < open_edge->count; i++) {
    double steps = (open_edge->t[i] - from) / (to - from) * last;
    if (steps <= 0 || steps >= last) continue;
    int32_t step = (int32_t)fmin(floor(steps), last - 1);
    (*place)[(*count)++] =
        curve->fine_length[step] + (steps - step) * (curve->fine_length[step + 1] - curve->fine_length[step]);
  }
  (*place)[(*count)++] = curve->fine_length[last];
done:
  return status;
}

typedef struct {
  const CwBoundaryInput *in;
  const CwOpenEdges *edges;
  int32_t count, *curve; // wall curves to divide: the first of each image set
} Curves;

// Whether some edge between the points of a division cuts off a bend of the curve. Ends beside left-out faces are none.
static int cuts_bend(const CwNetwork *network, const CwCurve *curve, int32_t count, const CwCurvePoint *point) {
  int32_t i = 1;
  for (int32_t k = 0; k + 1 < count; k++) {
    double along[3], from[3], beside[3], gap = 0;
    if (k == 0) gap += cw_curve_end_gap(network, curve, 0);
    if (k + 2 == count) gap += cw_curve_end_gap(network, curve, 1);
    cw_sub(point[k + 1].x, point[k].x, along);
    double length = cw_unit(along);
    for (; i + 1 < curve->fine_count && curve->fine_length[i] < point[k + 1].place; i++) {
      cw_sub(curve->fine_x[i], point[k].x, from);
      cw_cross(along, from, beside);
      if (cw_norm(beside) > MOST_BESIDE * length + gap) return 1;
    }
  }
  return 0;
}

// Divides one curve: a task, whose result are its points. Where the wanted edges are wider than the nose of a blade, it
// gets more of them: points inside the blade's face would else stand out beyond the edges along it.
static CwStatus divide_curve(void *context, int32_t i, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  const Curves *curves = context;
  const CwBoundaryInput *in = curves->in;
  const CwCurve *curve = &in->network->curve[curves->curve[i]];
  double *place = NULL;
  CwCurvePoint *point = NULL;
  int32_t count, least = curve->corner[0] == curve->corner[1] ? 3 : 1;
  CW_TRY(divide_open_edge(curves->edges, curve, &count, &place));
  int given = place != NULL;
  for (;;) {
    if (!given) CW_TRY(cw_curve_divide(in, curve, 0, curve->fine_length[curve->fine_count - 1], least, &count, &place));
    CW_NEW(point, count);
    for (int32_t k = 0; k < count; k++) point[k] = cw_curve_point_at(in->network, curve, place[k]);
    if (given || count > MOST_FOR_BENDS || !cuts_bend(in->network, curve, count, point)) break;
    least = count; // one edge more
    free(place);
    free(point);
    place = NULL;
    point = NULL;
  }
  if (!given) CW_TRY(cw_curve_divide_at_noses(in->network, curve, &count, &point));
  *bytes = point;
  *size = count * (int64_t)sizeof *point;
done:
  free(place);
  return status;
}

// Divides the first of each image set of wall curves; caller frees the points.
static CwStatus divide_curves(const CwContext *context, const CwBoundaryInput *in, const CwOpenEdges *edges,
                              CwCurveDivision *division) {
  CwStatus status = CW_OK;
  const CwNetwork *network = in->network;
  Curves curves = {.in = in, .edges = edges};
  CwTaskResults results = {0};
  CW_NEW(curves.curve, network->curve_count);
  for (int32_t i = 0; i < network->curve_count; i++) {
    if (network->curve[i].wall && cw_image_turns(in->images, &in->images->curve, i) == 0)
      curves.curve[curves.count++] = i;
  }
  CwSchedule schedule = {.step = "curves of the walls", .count = curves.count, .run = divide_curve, .context = &curves};
  CW_TRY(cw_schedule_gather(context, &schedule, &results));
  for (int32_t i = 0; i < curves.count; i++) {
    CwCurveDivision *of = &division[curves.curve[i]];
    of->count = (int32_t)((size_t)results.size[i] / sizeof *of->point);
    of->given = open_edge_of(edges, &network->curve[curves.curve[i]]) != NULL;
    of->point = results.bytes[i];
    results.bytes[i] = NULL;
  }
  CW_TRY(cw_curve_divisions_refine(context, in, division));
done:
  cw_task_results_free(&results);
  free(curves.curve);
  return status;
}

// The vertices of a divided curve and of its periodic images.
static CwStatus add_curve_vertices(const CwBoundaryInput *in, int32_t first, const CwCurveDivision *division,
                                   CwWallCurves *curves) {
  CwStatus status = CW_OK;
  const CwPeriodicImages *images = in->images;
  int32_t copies = cw_image_copies(images, &images->curve, first), index = first, count = division->count;
  for (int32_t turns = 0; turns < copies; turns++) {
    const CwCurve *curve = &in->network->curve[index];
    CwCurveNodes *nodes = &curves->curve[index];
    CwConstraint constraint = curve_constraint(in, curve);
    CW_TRY(cw_curve_nodes_make(count, nodes));
    for (int32_t k = 0; k < count; k++) {
      double x[3];
      memcpy(nodes->parameter[k], division->point[k].parameter, sizeof nodes->parameter[k]);
      if (k == 0 || k == count - 1) {
        nodes->node[k] = curves->corner_vertex[curve->corner[k > 0]];
        continue;
      }
      cw_image_point(images, turns, division->point[k].x, x);
      CW_TRY(cw_wall_curves_add(curves, x, constraint, &nodes->node[k]));
    }
    if (copies > 1) index = images->curve.next[index];
  }
  CW_TRY(cw_image_link_curves(images, first, curves->curve, &curves->images));
done:
  return status;
}

CwStatus cw_wall_curves_make(const CwContext *context, const CwBoundaryInput *in, const CwOpenEdges *edges,
                             CwWallCurves *curves) {
  CwStatus status = CW_OK;
  const CwNetwork *network = in->network;
  const CwPeriodicImages *images = in->images;
  CwCurveDivision *division = NULL;
  *curves = (CwWallCurves){.curve_count = network->curve_count};
  CW_NEW(curves->curve, network->curve_count);
  CW_NEW(curves->corner_vertex, network->corner_count);
  for (int32_t i = 0; i < network->corner_count; i++) {
    curves->corner_vertex[i] = -1;
    if (!network->corner[i].on_wall) continue;
    CW_TRY(cw_wall_curves_add(curves, network->corner[i].x, corner_constraint(in, i), &curves->corner_vertex[i]));
  }
  for (int32_t i = 0; images->symmetry && i < network->corner_count; i++) {
    if (!network->corner[i].on_wall) continue;
    int32_t next = images->corner.next[i];
    CW_TRY(cw_image_link(&curves->images, curves->corner_vertex[i], curves->corner_vertex[next],
                         images->corner.turns[next]));
  }
  CW_NEW(division, network->curve_count);
  CW_TRY(divide_curves(context, in, edges, division));
  for (int32_t i = 0; i < network->curve_count; i++) {
    if (division[i].count) CW_TRY(add_curve_vertices(in, i, &division[i], curves));
  }
done:
  for (int32_t i = 0; division && i < network->curve_count; i++) free(division[i].point);
  free(division);
  return status;
}
