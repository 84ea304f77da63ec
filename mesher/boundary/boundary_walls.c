// SPDX-License-Identifier: AGPL-3.0-or-later
// The wall of the boundary: its curves, its vertices with their constraints, its faces.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/model_unit.h"
#include "mesher/common/vec.h"
#include "mesher/parallel/schedule.h"
#include "mesher/parallel/parallel_for.h"
#include "mesher/boundary/curve_division.h"
#include "mesher/boundary/periodic_boundary.h"
#include "mesher/boundary/boundary_curves.h"
#include "mesher/surface/patch_task.h"

enum { SIZE_STEPS = 400, MOST_FOR_BENDS = 12 };
static const double ON_PLANE = 1e-8; // of the model's unit
// Of the length of an edge, how far its curve may lie beside it: a circle's edges turn by 62 degrees.
static const double MOST_BESIDE = 0.14;

int cw_face_is_wall(const CwCad *cad, int32_t face) {
  return cw_cad_patch_kind(cad, cw_cad_face_patch(cad, face)) == CW_PATCH_WALL;
}

CwStatus cw_curve_divide(const CwBoundary *boundary, const CwCurve *curve, double from, double to, int32_t least,
                         int32_t *count, double **place) {
  CwStatus status = CW_OK;
  // Number of edges up to each of many small steps: integral of ds / h by the midpoint rule.
  double edges[SIZE_STEPS + 1] = {0};
  for (int i = 0; i < SIZE_STEPS; i++) {
    double x[3], parameter[2];
    cw_curve_point(&boundary->network, curve, from + (to - from) * (i + 0.5) / SIZE_STEPS, x, parameter);
    edges[i + 1] = edges[i] + fabs(to - from) / SIZE_STEPS / boundary->size_at(boundary->size, x);
  }
  int32_t whole = (int32_t)floor(edges[SIZE_STEPS] + 0.5);
  if (whole < least) whole = least;
  *count = whole + 1;
  CW_NEW(*place, whole + 1);
  (*place)[0] = from;
  (*place)[whole] = to;
  int step = 0;
  for (int32_t k = 1; k < whole; k++) {
    double wanted = edges[SIZE_STEPS] * k / whole;
    while (step < SIZE_STEPS - 1 && edges[step + 1] < wanted) step++;
    double s = (wanted - edges[step]) / (edges[step + 1] - edges[step]);
    (*place)[k] = from + (to - from) * (step + s) / SIZE_STEPS;
  }
done:
  return status;
}

static CwStatus reserve_wall(CwBoundary *boundary, int32_t capacity) {
  CwStatus status = CW_OK;
  void *xs = realloc(boundary->surface.x, (size_t)capacity * sizeof *boundary->surface.x);
  if (xs) boundary->surface.x = xs;
  void *constraints = realloc(boundary->surface.constraint, (size_t)capacity * sizeof *boundary->surface.constraint);
  if (constraints) boundary->surface.constraint = constraints;
  CW_REQUIRE(xs && constraints, CW_ERR_MEMORY, "out of memory: %d wall vertices", capacity);
  boundary->surface.vertex_capacity = capacity;
done:
  return status;
}

static CwStatus add_wall_vertex(CwBoundary *boundary, const double x[3], CwConstraint constraint, int32_t *vertex) {
  CwStatus status = CW_OK;
  if (boundary->surface.vertex_count == boundary->surface.vertex_capacity) {
    CW_TRY(reserve_wall(boundary, boundary->surface.vertex_capacity ? 2 * boundary->surface.vertex_capacity : 4096));
  }
  cw_copy(x, boundary->surface.x[boundary->surface.vertex_count]);
  boundary->surface.constraint[boundary->surface.vertex_count] = constraint;
  *vertex = boundary->surface.vertex_count++;
done:
  return status;
}

// What holds the columns along a wall curve: the partition plane of a cut, the open patch at an open edge, nothing
// else.
static CwConstraint curve_constraint(const CwBoundary *boundary, const CwCurve *curve) {
  if (curve->kind == CW_CURVE_CUT) return (CwConstraint){CW_CONSTRAINT_PLANE, curve->plane[0]};
  for (int k = 0; k < 2; k++) {
    if (!cw_face_is_wall(boundary->cad, curve->face[k])) return (CwConstraint){CW_CONSTRAINT_PATCH, curve->face[k]};
  }
  return (CwConstraint){CW_CONSTRAINT_NONE, -1};
}

// What holds the column at a wall corner: the free curve that starts there; else the one open patch or plane of its
// curves.
static CwStatus corner_constraint(const CwBoundary *boundary, int32_t corner, CwConstraint *constraint) {
  CwStatus status = CW_OK;
  *constraint = (CwConstraint){CW_CONSTRAINT_NONE, -1};
  int free_curves = 0;
  const double *x = boundary->network.corner[corner].x;
  for (int32_t i = 0; i < boundary->network.curve_count; i++) {
    const CwCurve *curve = &boundary->network.curve[i];
    if (curve->corner[0] != corner && curve->corner[1] != corner) continue;
    if (!curve->wall) {
      *constraint = (CwConstraint){CW_CONSTRAINT_CURVE, i};
      free_curves++;
    } else if (!free_curves) {
      CwConstraint along = curve_constraint(boundary, curve);
      if (along.kind != CW_CONSTRAINT_NONE) *constraint = along;
    }
  }
  CW_REQUIRE(
      free_curves <= 1, CW_ERR_MESH,
      "%d partition planes or open patches meet in one point of the wall at (%.3f, %.3f, %.3f) mm; at most two can",
      free_curves + 1, CW_MM(x));
done:
  return status;
}

// The open edge that a curve is a piece of, NULL where it is of none.
static const CwDividedEdge *open_edge_of(const CwBoundary *boundary, const CwCurve *curve) {
  for (int32_t i = 0; i < boundary->open_edge_count && curve->kind == CW_CURVE_EDGE; i++) {
    if (boundary->open_edge[i].edge == curve->edge) return &boundary->open_edge[i];
  }
  return NULL;
}

// Division of a piece of an open edge: arc lengths by the fine polyline, whose steps are even in the parameter. NULL
// where the division is not given.
static CwStatus divide_open_edge(const CwBoundary *boundary, const CwCurve *curve, int32_t *count, double **place) {
  CwStatus status = CW_OK;
  const CwDividedEdge *open_edge = open_edge_of(boundary, curve);
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

static CwStatus add_curve_vertex(CwBoundary *boundary, const CwCurve *curve, const double x[3], int32_t *vertex) {
  return add_wall_vertex(boundary, x, curve_constraint(boundary, curve), vertex);
}

typedef struct {
  const CwBoundary *boundary;
  int32_t count, *curve; // wall curves to divide: the first of each image set
} Curves;

// Whether some edge between the points of a division cuts off a bend of the curve.
static int cuts_bend(const CwCurve *curve, int32_t count, const CwCurvePoint *point) {
  int32_t i = 1;
  for (int32_t k = 0; k + 1 < count; k++) {
    double along[3], from[3], beside[3];
    cw_sub(point[k + 1].x, point[k].x, along);
    double length = cw_unit(along);
    for (; i + 1 < curve->fine_count && curve->fine_length[i] < point[k + 1].place; i++) {
      cw_sub(curve->fine_x[i], point[k].x, from);
      cw_cross(along, from, beside);
      if (cw_norm(beside) > MOST_BESIDE * length) return 1;
    }
  }
  return 0;
}

// Divides one curve: a task, whose result are its points. Where the wanted edges are wider than the nose of a blade, it
// gets more of them: points inside the blade's face would else stand out beyond the edges along it.
static CwStatus divide_curve(void *context, int32_t i, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  const Curves *curves = context;
  const CwBoundary *boundary = curves->boundary;
  const CwCurve *curve = &boundary->network.curve[curves->curve[i]];
  double *place = NULL;
  CwCurvePoint *point = NULL;
  int32_t count, least = curve->corner[0] == curve->corner[1] ? 3 : 1;
  CW_TRY(divide_open_edge(boundary, curve, &count, &place));
  int given = place != NULL;
  for (;;) {
    if (!given)
      CW_TRY(cw_curve_divide(boundary, curve, 0, curve->fine_length[curve->fine_count - 1], least, &count, &place));
    CW_NEW(point, count);
    for (int32_t k = 0; k < count; k++) {
      point[k].place = place[k];
      cw_curve_point(&boundary->network, curve, place[k], point[k].x, point[k].parameter);
    }
    if (given || count > MOST_FOR_BENDS || !cuts_bend(curve, count, point)) break;
    least = count; // one edge more
    free(place);
    free(point);
    place = NULL;
    point = NULL;
  }
  *bytes = point;
  *size = count * (int64_t)sizeof *point;
done:
  free(place);
  return status;
}

// Divides the first of each image set of wall curves; caller frees the points.
static CwStatus divide_curves(const CwBoundary *boundary, CwCurveDivision *division) {
  CwStatus status = CW_OK;
  const CwNetwork *network = &boundary->network;
  Curves curves = {.boundary = boundary};
  void **bytes = NULL;
  int64_t *size = NULL;
  CW_NEW(curves.curve, network->curve_count);
  for (int32_t i = 0; i < network->curve_count; i++) {
    if (network->curve[i].wall && cw_image_turns(&boundary->images, &boundary->images.curve, i) == 0)
      curves.curve[curves.count++] = i;
  }
  CW_NEW(bytes, curves.count);
  CW_NEW(size, curves.count);
  CwSchedule schedule = {
      .step = "curves of the walls", .count = curves.count, .run = divide_curve, .context = &curves, .gather = 1};
  CW_TRY(cw_schedule_run(&schedule, bytes, size, NULL));
  for (int32_t i = 0; i < curves.count; i++) {
    CwCurveDivision *of = &division[curves.curve[i]];
    of->count = (int32_t)((size_t)size[i] / sizeof *of->point);
    of->given = open_edge_of(boundary, &network->curve[curves.curve[i]]) != NULL;
    of->point = bytes[i];
    bytes[i] = NULL;
  }
  CW_TRY(cw_curve_divisions_refine(boundary, division));
done:
  for (int32_t i = 0; bytes && i < curves.count; i++) free(bytes[i]);
  free(bytes);
  free(size);
  free(curves.curve);
  return status;
}

// The vertices of a divided curve and of its copies.
static CwStatus add_curve_vertices(CwBoundary *boundary, int32_t index, const CwCurveDivision *division) {
  CwStatus status = CW_OK;
  CwCurve *curve = &boundary->network.curve[index];
  int32_t count = curve->point_count = division->count;
  CW_NEW(curve->node, count);
  CW_NEW(curve->parameter, count);
  CwConstraint constraint = curve_constraint(boundary, curve);
  for (int32_t k = 0; k < count; k++) {
    memcpy(curve->parameter[k], division->point[k].parameter, sizeof curve->parameter[k]);
    if (k == 0 || k == count - 1) {
      curve->node[k] = boundary->surface.corner_vertex[curve->corner[k > 0]];
    } else {
      CW_TRY(add_wall_vertex(boundary, division->point[k].x, constraint, &curve->node[k]));
    }
  }
  CW_TRY(cw_image_copy_curve(boundary, index, boundary->surface.corner_vertex, &boundary->surface.x, add_curve_vertex));
done:
  return status;
}

CwStatus cw_boundary_wall_curves(CwBoundary *boundary) {
  CwStatus status = CW_OK;
  CwNetwork *network = &boundary->network;
  CwCurveDivision *division = NULL;
  CW_NEW(boundary->surface.corner_vertex, network->corner_count);
  for (int32_t i = 0; i < network->corner_count; i++) {
    boundary->surface.corner_vertex[i] = -1;
    if (!network->corner[i].on_wall) continue;
    CwConstraint constraint;
    CW_TRY(corner_constraint(boundary, i, &constraint));
    CW_TRY(add_wall_vertex(boundary, network->corner[i].x, constraint, &boundary->surface.corner_vertex[i]));
  }
  CwPeriodicImages *images = &boundary->images;
  for (int32_t i = 0; images->symmetry && i < network->corner_count; i++) {
    if (!network->corner[i].on_wall) continue;
    int32_t next = images->corner.next[i];
    CW_TRY(cw_image_link(images, boundary->surface.corner_vertex[i], boundary->surface.corner_vertex[next],
                         images->corner.turns[next]));
  }
  CW_NEW(division, network->curve_count);
  CW_TRY(divide_curves(boundary, division));
  for (int32_t i = 0; i < network->curve_count; i++) {
    if (division[i].count) CW_TRY(add_curve_vertices(boundary, i, &division[i]));
  }
done:
  for (int32_t i = 0; division && i < network->curve_count; i++) free(division[i].point);
  free(division);
  return status;
}

// (u,v) on `face` of point k of a curve that runs along it.
static void curve_uv(const CwBoundary *boundary, const CwCurve *curve, int32_t k, int32_t face, double uv[2]) {
  if (curve->kind == CW_CURVE_EDGE) {
    cw_cad_edge_uv(boundary->cad, curve->edge, face, curve->parameter[k][0], uv);
  } else {
    memcpy(uv, curve->parameter[k], sizeof(double[2]));
  }
}

// The outline of a wall face: CAD edges first, so that their ends get the (u,v) of the edges, then the cuts.
static CwStatus wall_outline(const CwBoundary *boundary, int32_t face, CwPatchOutline *outline) {
  CwStatus status = CW_OK;
  CW_TRY(cw_outline_start(outline, boundary->surface.vertex_count));
  for (int pass = 0; pass < 2; pass++) {
    CwCurveKind kind = pass == 0 ? CW_CURVE_EDGE : CW_CURVE_CUT;
    for (int32_t i = 0; i < boundary->network.curve_count; i++) {
      const CwCurve *curve = &boundary->network.curve[i];
      if (curve->kind != kind || !curve->wall || (curve->face[0] != face && curve->face[1] != face)) continue;
      int32_t previous = -1;
      for (int32_t k = 0; k < curve->point_count; k++) {
        double uv[2];
        int32_t local;
        curve_uv(boundary, curve, k, face, uv);
        CW_TRY(cw_outline_point(outline, curve->node[k], uv, boundary->surface.x[curve->node[k]], &local));
        if (k > 0) CW_TRY(cw_outline_edge(outline, previous, local, kind == CW_CURVE_EDGE));
        previous = local;
      }
    }
  }
done:
  return status;
}

typedef struct {
  const CwCad *cad;
  int32_t face;
} FaceMap;

static void face_map(const void *context, const double uv[2], double x[3], double xu[3], double xv[3]) {
  const FaceMap *map = context;
  cw_cad_face_point(map->cad, map->face, uv, x, xu, xv);
}

static int32_t region_at(const void *plan, const double x[3]) {
  return cw_plan_locate(plan, x);
}

// Meshes a CAD face inside its outline; the label of each triangle is its region.
static CwStatus mesh_face(const CwBoundary *boundary, int32_t face,
                          CwStatus (*outline_of)(const CwBoundary *, int32_t, CwPatchOutline *), void **bytes,
                          int64_t *size) {
  CwStatus status = CW_OK;
  CwPatchOutline outline = {0};
  FaceMap map = {boundary->cad, face};
  CW_TRY(outline_of(boundary, face, &outline));
  double largest = boundary->largest ? boundary->largest[cw_cad_face_patch(boundary->cad, face)] : 0;
  CW_TRY(cw_patch_task(&outline, face_map, &map, boundary->size_at, boundary->size, largest,
                       cw_cad_face_reversed(boundary->cad, face), region_at, boundary->plan,
                       cw_cad_face_name(boundary->cad, face), bytes, size));
done:
  cw_outline_free(&outline);
  return status;
}

CwStatus cw_boundary_mesh_wall(const CwBoundary *boundary, int32_t face, void **bytes, int64_t *size) {
  return mesh_face(boundary, face, wall_outline, bytes, size);
}

// No triangle may reach over a partition plane: then a cut curve is missing. Periodic images are as their first.
static CwStatus check_triangle(void *context, int32_t t, void *out) {
  CwStatus status = CW_OK;
  const CwBoundary *boundary = context;
  if (boundary->surface.source[t] != t) goto done;
  for (int k = 0; k < 3; k++) {
    const double *x = boundary->surface.x[boundary->surface.triangle[t][k]];
    CW_REQUIRE(cw_plan_in_region(boundary->plan, boundary->surface.region[t], x, ON_PLANE), CW_ERR_MESH,
               "a triangle of face %s at (%.3f, %.3f, %.3f) mm reaches out of region %d: a cut curve is missing",
               cw_cad_face_name(boundary->cad, boundary->surface.face[t]), CW_MM(x), boundary->surface.region[t] + 1);
  }
  *(uint8_t *)out = 1;
done:
  return status;
}

static CwStatus check_regions(CwBoundary *boundary) {
  CwStatus status = CW_OK;
  uint8_t *checked = NULL;
  CW_NEW(checked, boundary->surface.triangle_count);
  CW_TRY(cw_parallel_for("walls checked", boundary->surface.triangle_count, 1, check_triangle, boundary, checked));
done:
  free(checked);
  return status;
}

// Appends the triangles of a copy of a face, whose points have the numbers `vertex`.
static void append_triangles(CwBoundary *boundary, int32_t face, int32_t turns, int32_t source,
                             const CwPatchBlock *block, const int32_t *vertex) {
  const CwPeriodicImages *images = &boundary->images;
  int32_t on = cw_image_face(images, face, turns), label = -1, region = -1;
  for (int32_t t = 0; t < block->triangle_count; t++) {
    int32_t at = boundary->surface.triangle_count++;
    if (block->label[t] != label) { // those of one region mostly follow one another
      label = block->label[t];
      region = cw_image_region(images, boundary->plan, label, turns);
    }
    for (int k = 0; k < 3; k++) boundary->surface.triangle[at][k] = vertex[block->triangle[t][k]];
    boundary->surface.face[at] = on;
    boundary->surface.source[at] = source + t;
    boundary->surface.region[at] = region;
  }
}

// Appends the mesh of a face for itself and its periodic images.
static CwStatus merge_wall(CwBoundary *boundary, int32_t face, const CwPatchBlock *block) {
  CwStatus status = CW_OK;
  CwPeriodicImages *images = &boundary->images;
  int32_t copies = cw_image_face_copies(images, face), first = boundary->surface.vertex_count;
  int32_t source = boundary->surface.triangle_count, *vertex = NULL;
  CW_NEW(vertex, block->outline_points + block->point_count);
  for (int32_t turns = 0; turns < copies; turns++) {
    for (int32_t i = 0; i < block->outline_points; i++) {
      vertex[i] = cw_image_node(images, block->outline_node[i], turns);
    }
    for (int32_t i = 0; i < block->point_count; i++) {
      int32_t *made = &vertex[block->outline_points + i];
      double x[3];
      cw_image_point(images, turns, block->x[i], x);
      CW_TRY(add_wall_vertex(boundary, x, (CwConstraint){CW_CONSTRAINT_NONE, -1}, made));
      if (turns > 0) CW_TRY(cw_image_link(images, *made - block->point_count, *made, turns));
      if (turns > 0 && turns == copies - 1) CW_TRY(cw_image_link(images, *made, first + i, 0));
    }
    append_triangles(boundary, face, turns, source, block, vertex);
  }
done:
  free(vertex);
  return status;
}

// Lists the wall triangles by region.
static CwStatus list_regions(CwBoundary *boundary) {
  CwStatus status = CW_OK;
  int32_t regions = boundary->plan->region_count, *start, *fill = NULL;
  CW_NEW(boundary->surface.region_start, regions + 1);
  CW_NEW(boundary->surface.region_triangle, boundary->surface.triangle_count);
  CW_NEW(fill, regions);
  start = boundary->surface.region_start;
  for (int32_t t = 0; t < boundary->surface.triangle_count; t++) start[boundary->surface.region[t] + 1]++;
  for (int32_t r = 0; r < regions; r++) {
    fill[r] = start[r];
    start[r + 1] += start[r];
  }
  for (int32_t t = 0; t < boundary->surface.triangle_count; t++)
    boundary->surface.region_triangle[fill[boundary->surface.region[t]]++] = t;
done:
  free(fill);
  return status;
}

CwStatus cw_boundary_merge_walls(CwBoundary *boundary, void *const *bytes) {
  CwStatus status = CW_OK;
  int32_t faces = cw_cad_face_count(boundary->cad), total = 0, vertices = boundary->surface.vertex_count;
  CwPatchBlock block;
  for (int32_t f = 0; f < faces; f++) {
    if (!bytes[f]) continue;
    int32_t copies = cw_image_face_copies(&boundary->images, f);
    cw_patch_block(bytes[f], &block);
    total += block.triangle_count * copies;
    vertices += block.point_count * copies;
  }
  if (vertices > boundary->surface.vertex_capacity) CW_TRY(reserve_wall(boundary, vertices));
  CW_NEW(boundary->surface.triangle, total);
  CW_NEW(boundary->surface.face, total);
  CW_NEW(boundary->surface.region, total);
  CW_NEW(boundary->surface.source, total);
  for (int32_t f = 0; f < faces; f++) {
    if (!bytes[f]) continue;
    cw_patch_block(bytes[f], &block);
    CW_TRY(merge_wall(boundary, f, &block));
  }
  CW_TRY(check_regions(boundary));
  CW_TRY(list_regions(boundary));
done:
  return status;
}

// Layer top node and its (u,v) on an open patch: the (u,v) of the wall curve is the start of the search.
static CwStatus add_cap_point(const CwBoundary *boundary, const CwCurve *curve, int32_t k, int32_t face,
                              CwPatchOutline *outline, int32_t *local) {
  double uv[2];
  curve_uv(boundary, curve, k, face, uv);
  const double *x = boundary->interfaces.nodes.x[curve->node[k]];
  cw_cad_face_project(boundary->cad, face, x, uv);
  return cw_outline_point(outline, curve->node[k], uv, x, local);
}

CwStatus cw_boundary_open_patch_outline(const CwBoundary *boundary, int32_t face, CwPatchOutline *outline) {
  CwStatus status = CW_OK;
  CW_TRY(cw_outline_start(outline, boundary->interfaces.nodes.count));
  for (int32_t i = 0; i < boundary->network.curve_count; i++) {
    const CwCurve *curve = &boundary->network.curve[i];
    if (curve->kind == CW_CURVE_LINE || (curve->face[0] != face && curve->face[1] != face)) continue;
    int32_t previous = -1, local;
    for (int32_t k = 0; k < curve->point_count; k++) {
      CW_TRY(add_cap_point(boundary, curve, k, face, outline, &local));
      if (k > 0) CW_TRY(cw_outline_edge(outline, previous, local, curve->kind == CW_CURVE_EDGE));
      previous = local;
    }
  }
done:
  return status;
}

CwStatus cw_boundary_mesh_open_patch(const CwBoundary *boundary, int32_t face, void **bytes, int64_t *size) {
  return mesh_face(boundary, face, cw_boundary_open_patch_outline, bytes, size);
}
