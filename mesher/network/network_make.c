// SPDX-License-Identifier: AGPL-3.0-or-later
// The curve network: CAD edges cut at the planes, traces of the planes, and the lines where two planes meet.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/cad/cad_leave_out.h"
#include "mesher/common/vec.h"
#include "mesher/network/network.h"

enum { EDGE_FINE = 129, LINE_FINE = 65 };

typedef struct {
  int32_t corner;
  double t;
} Place;

static int compare_places(const void *p, const void *q) {
  const Place *a = p, *b = q;
  if (a->t != b->t) return a->t < b->t ? -1 : 1;
  return (a->corner > b->corner) - (a->corner < b->corner);
}

// The pieces of one CAD edge between its ends and the planes that cross it.
static CwStatus add_edge(CwNetwork *network, int32_t edge, Place *place) {
  CwStatus status = CW_OK;
  const CwCad *cad = network->cad;
  double range[2];
  int vertex[2], face[2];
  cw_cad_edge_range(cad, edge, range);
  cw_cad_edge_vertices(cad, edge, vertex);
  cw_cad_edge_faces(cad, edge, face);
  int32_t count = 0;
  place[count++] = (Place){vertex[0], range[0]}; // the corners of CAD vertices come first, in their order
  for (int32_t i = 0; i < network->corner_count; i++) {
    if (network->corner[i].edge == edge) place[count++] = (Place){i, network->corner[i].t};
  }
  place[count++] = (Place){vertex[1], range[1]};
  qsort(place + 1, (size_t)count - 2, sizeof *place, compare_places);
  for (int32_t p = 0; p + 1 < count; p++) {
    CwCurve curve = {.kind = CW_CURVE_EDGE,
                     .corner = {place[p].corner, place[p + 1].corner},
                     .edge = edge,
                     .face = {face[0], face[1]},
                     .plane = {-1, -1},
                     .wall = cw_cad_face_is_wall(cad, face[0]) || cw_cad_face_is_wall(cad, face[1])};
    CW_TRY(cw_curve_fine_make(EDGE_FINE, &curve));
    for (int i = 0; i < EDGE_FINE; i++) {
      double t = place[p].t + (place[p + 1].t - place[p].t) * i / (EDGE_FINE - 1);
      curve.fine_parameter[i][0] = t;
      cw_cad_edge_point(cad, edge, t, curve.fine_x[i], NULL);
    }
    CW_TRY(cw_network_add_curve(network, &curve));
  }
done:
  return status;
}

// The point where three planes meet, where it lies in the domain and in the cells of all three.
static int triple_point(const CwNetwork *network, const CwVerticals *inside, const int32_t node[3], double x[3]) {
  const CwPlan *plan = network->plan;
  double point[3], direction[3];
  const CwPlane *a = &plan->node[node[0]].plane, *b = &plan->node[node[1]].plane, *c = &plan->node[node[2]].plane;
  if (!cw_plane_line(a, b, point, direction)) return 0;
  double slope = cw_dot(c->normal, direction);
  if (fabs(slope) < 1e-3) return 0;
  double s = -cw_plane_distance(c, point) / slope;
  for (int k = 0; k < 3; k++) x[k] = point[k] + s * direction[k];
  for (int k = 0; k < 3; k++) {
    if (!cw_plan_in_cell(plan, node[k], x, 1e-9, node, 3)) return 0;
  }
  return cw_verticals_inside(inside, x);
}

static int has_planes(const CwCorner *corner, int32_t a, int32_t b) {
  int found = 0;
  for (int k = 0; k < 3; k++) found += corner->plane[k] == a || corner->plane[k] == b;
  return found == 2;
}

// The pieces of the line of two planes that lie in the domain and in the cell of the lower plane.
static CwStatus add_line(CwNetwork *network, const CwVerticals *inside, int32_t above, int32_t below, Place *place) {
  CwStatus status = CW_OK;
  double point[3], direction[3];
  if (!cw_plane_line(&network->plan->node[above].plane, &network->plan->node[below].plane, point, direction)) goto done;
  int32_t count = 0;
  for (int32_t i = 0; i < network->corner_count; i++) {
    if (!has_planes(&network->corner[i], above, below)) continue;
    double from_point[3];
    cw_sub(network->corner[i].x, point, from_point);
    place[count++] = (Place){i, cw_dot(from_point, direction)};
  }
  qsort(place, (size_t)count, sizeof *place, compare_places);
  for (int32_t p = 0; p + 1 < count; p++) {
    const double *a = network->corner[place[p].corner].x, *b = network->corner[place[p + 1].corner].x;
    double middle[3];
    int32_t skip[1] = {above};
    cw_lerp(a, b, 0.5, middle);
    if (!cw_verticals_inside(inside, middle) || !cw_plan_in_cell(network->plan, below, middle, 0, skip, 1)) continue;
    CwCurve curve = {.kind = CW_CURVE_LINE,
                     .corner = {place[p].corner, place[p + 1].corner},
                     .edge = -1,
                     .face = {-1, -1},
                     .plane = {above, below}};
    CW_TRY(cw_curve_fine_make(LINE_FINE, &curve));
    for (int i = 0; i < LINE_FINE; i++) cw_lerp(a, b, (double)i / (LINE_FINE - 1), curve.fine_x[i]);
    CW_TRY(cw_network_add_curve(network, &curve));
  }
done:
  return status;
}

// Beside a left-out face, traces on the faces of an edge must meet in the same corners. A plane that leaves the strip
// between them through an end, or touches it, has a trace on one side alone.
static CwStatus check_both_sides(const CwNetwork *network, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  int32_t(*count)[2] = NULL; // cuts that end at a corner, by face of its edge
  CW_NEW(count, network->corner_count);
  for (int32_t i = 0; i < network->curve_count; i++) {
    const CwCurve *curve = &network->curve[i];
    for (int end = 0; end < 2 && curve->kind == CW_CURVE_CUT; end++) {
      int32_t corner = curve->corner[end], edge = network->corner[corner].edge;
      int face[2];
      if (edge < 0) continue;
      cw_cad_edge_faces(network->cad, edge, face);
      count[corner][face[1] == curve->face[0]]++;
    }
  }
  for (int32_t i = 0; i < network->corner_count; i++) {
    const CwCorner *corner = &network->corner[i];
    int off = corner->edge >= 0 && cw_cad_edge_stands_for(network->cad, corner->edge, NULL) >= 0 &&
              count[i][0] != count[i][1];
    CW_END_UNLESS(!off, outcome, CW_OUTCOME_REPLAN, corner->x, "partition plane %d grazes a face that is left out",
                  corner->plane[0]);
  }
done:
  free(count);
  return status;
}

// Marks the corners on the wall, at which one column stands, and so at most one curve leads away from the wall.
static CwStatus find_wall_corners(CwNetwork *network, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  int32_t *away = NULL;
  CW_NEW(away, network->corner_count);
  for (int32_t i = 0; i < network->curve_count; i++) {
    const CwCurve *curve = &network->curve[i];
    for (int end = 0; end < 2; end++) {
      if (curve->wall)
        network->corner[curve->corner[end]].on_wall = 1;
      else
        away[curve->corner[end]]++;
    }
  }
  for (int32_t i = 0; i < network->corner_count; i++) {
    const CwCorner *corner = &network->corner[i];
    CW_END_UNLESS(!corner->on_wall || away[i] <= 1, outcome, CW_OUTCOME_REPLAN, corner->x,
                  "%d partition planes or open patches, more than two, meet in one point of the wall", away[i] + 1);
  }
done:
  free(away);
  return status;
}

CwStatus cw_network_make(const CwContext *context, const CwCad *cad, const CwBackground *background,
                         const CwVerticals *inside, const CwPlan *plan, CwNetwork *network, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  Place *place = NULL;
  int32_t *below = NULL, number;
  memset(network, 0, sizeof *network);
  network->cad = cad;
  network->plan = plan;
  for (int v = 0; v < cw_cad_vertex_count(cad); v++) {
    CwCorner corner = {{0}, -1, -1, 0, v, {-1, -1, -1}, 0};
    cw_cad_vertex_point(cad, v, corner.x);
    CW_TRY(cw_network_corner(network, &corner, 0, &number)); // number: v
  }
  CW_TRY_STAGE(cw_network_trace_all(context, network, background, outcome), outcome);
  CW_TRY_STAGE(check_both_sides(network, outcome), outcome);

  // Three planes meet only where one is above the two others: cells side by side touch on a plane above both alone.
  CW_NEW(below, plan->node_count);
  for (int32_t a = 0; a < plan->node_count; a++) {
    int32_t count = 0;
    for (int32_t b = a + 1; b < plan->node_count; b++) {
      if (cw_plan_is_ancestor(plan, a, b)) below[count++] = b;
    }
    for (int32_t b = 0; b < count; b++) {
      for (int32_t c = b + 1; c < count; c++) {
        CwCorner corner = {{0}, -1, -1, 0, -1, {a, below[b], below[c]}, 0};
        if (!triple_point(network, inside, corner.plane, corner.x)) continue;
        CW_TRY(cw_network_corner(network, &corner, cw_same_corner, &number));
      }
    }
  }
  CW_NEW(place, network->corner_count + 2);
  for (int e = 0; e < cw_cad_edge_count(cad); e++) CW_TRY(add_edge(network, e, place));
  for (int32_t a = 0; a < plan->node_count; a++) {
    for (int32_t b = a + 1; b < plan->node_count; b++) {
      if (cw_plan_is_ancestor(plan, a, b)) CW_TRY(add_line(network, inside, a, b, place));
    }
  }
  CW_TRY(find_wall_corners(network, outcome));
done:
  free(place);
  free(below);
  if (status != CW_OK || outcome->kind != CW_OUTCOME_DONE) cw_network_free(network);
  return status;
}
