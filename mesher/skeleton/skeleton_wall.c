// SPDX-License-Identifier: AGPL-3.0-or-later
// The wall of the skeleton: its curves, its vertices with their guides, its faces.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/model_unit.h"
#include "mesher/common/vec.h"
#include "mesher/parallel/schedule.h"
#include "mesher/parallel/share.h"
#include "mesher/skeleton/curve_division.h"
#include "mesher/skeleton/orbit_skeleton.h"
#include "mesher/skeleton/skeleton_curves.h"
#include "mesher/surface/patch_task.h"

enum { SIZE_STEPS = 400, MOST_FOR_BENDS = 12 };
static const double ON_PLANE = 1e-8; // of the model's unit
// Of the length of an edge, how far its curve may lie beside it: a circle's edges turn by 62 degrees.
static const double MOST_BESIDE = 0.14;

int cw_face_is_wall(const CwCad *cad, int32_t face) {
  return cw_cad_patch_kind(cad, cw_cad_face_patch(cad, face)) == CW_PATCH_WALL;
}

CwStatus cw_curve_divide(const CwSkeleton *skeleton, const CwCurve *curve, double from, double to, int32_t least,
                         int32_t *count, double **place) {
  CwStatus status = CW_OK;
  // Number of edges up to each of many small steps: integral of ds / h by the midpoint rule.
  double edges[SIZE_STEPS + 1] = {0};
  for (int i = 0; i < SIZE_STEPS; i++) {
    double x[3], parameter[2];
    cw_curve_point(&skeleton->network, curve, from + (to - from) * (i + 0.5) / SIZE_STEPS, x, parameter);
    edges[i + 1] = edges[i] + fabs(to - from) / SIZE_STEPS / skeleton->size_at(skeleton->size, x);
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

static CwStatus reserve_wall(CwSkeleton *skeleton, int32_t capacity) {
  CwStatus status = CW_OK;
  void *xs = realloc(skeleton->surface.x, (size_t)capacity * sizeof *skeleton->surface.x);
  if (xs) skeleton->surface.x = xs;
  void *guides = realloc(skeleton->surface.guide, (size_t)capacity * sizeof *skeleton->surface.guide);
  if (guides) skeleton->surface.guide = guides;
  CW_REQUIRE(xs && guides, CW_ERR_MEMORY, "out of memory: %d wall vertices", capacity);
  skeleton->surface.vertex_capacity = capacity;
done:
  return status;
}

static CwStatus add_wall_vertex(CwSkeleton *skeleton, const double x[3], CwGuide guide, int32_t *vertex) {
  CwStatus status = CW_OK;
  if (skeleton->surface.vertex_count == skeleton->surface.vertex_capacity) {
    CW_TRY(reserve_wall(skeleton, skeleton->surface.vertex_capacity ? 2 * skeleton->surface.vertex_capacity : 4096));
  }
  cw_copy(x, skeleton->surface.x[skeleton->surface.vertex_count]);
  skeleton->surface.guide[skeleton->surface.vertex_count] = guide;
  *vertex = skeleton->surface.vertex_count++;
done:
  return status;
}

// What holds the columns along a wall curve: the dividing plane of a cut, the cap at a rim, nothing else.
static CwGuide curve_guide(const CwSkeleton *skeleton, const CwCurve *curve) {
  if (curve->kind == CW_CURVE_CUT) return (CwGuide){CW_GUIDE_PLANE, curve->plane[0]};
  for (int k = 0; k < 2; k++) {
    if (!cw_face_is_wall(skeleton->cad, curve->face[k])) return (CwGuide){CW_GUIDE_CAP, curve->face[k]};
  }
  return (CwGuide){CW_GUIDE_NONE, -1};
}

// What holds the column at a wall corner: the free curve that starts there; else the one cap or plane of its curves.
static CwStatus corner_guide(const CwSkeleton *skeleton, int32_t corner, CwGuide *guide) {
  CwStatus status = CW_OK;
  *guide = (CwGuide){CW_GUIDE_NONE, -1};
  int free_curves = 0;
  const double *x = skeleton->network.corner[corner].x;
  for (int32_t i = 0; i < skeleton->network.curve_count; i++) {
    const CwCurve *curve = &skeleton->network.curve[i];
    if (curve->corner[0] != corner && curve->corner[1] != corner) continue;
    if (!curve->wall) {
      *guide = (CwGuide){CW_GUIDE_CURVE, i};
      free_curves++;
    } else if (!free_curves) {
      CwGuide along = curve_guide(skeleton, curve);
      if (along.kind != CW_GUIDE_NONE) *guide = along;
    }
  }
  CW_REQUIRE(free_curves <= 1, CW_ERR_MESH,
             "%d dividing planes or caps meet in one point of the wall at (%.3f, %.3f, %.3f) mm; at most two can",
             free_curves + 1, CW_MM(x));
done:
  return status;
}

// The rim that a curve is a piece of, NULL where it is of none.
static const CwSkeletonRim *rim_of(const CwSkeleton *skeleton, const CwCurve *curve) {
  for (int32_t i = 0; i < skeleton->rim_count && curve->kind == CW_CURVE_EDGE; i++) {
    if (skeleton->rim[i].edge == curve->edge) return &skeleton->rim[i];
  }
  return NULL;
}

// Division of a piece of a rim: arc lengths by the fine polyline, whose steps are even in the parameter. NULL where
// the division is not given.
static CwStatus divide_rim(const CwSkeleton *skeleton, const CwCurve *curve, int32_t *count, double **place) {
  CwStatus status = CW_OK;
  const CwSkeletonRim *rim = rim_of(skeleton, curve);
  *count = 0;
  int32_t last = curve->fine_count - 1;
  double from = curve->fine_parameter[0][0], to = curve->fine_parameter[last][0];
  if (!rim) goto done;
  CW_NEW(*place, rim->count + 2);
  *count = 1;
  for (int32_t i = 0; i < rim->count; i++) {
    double steps = (rim->t[i] - from) / (to - from) * last;
    if (steps <= 0 || steps >= last) continue;
    int32_t step = (int32_t)fmin(floor(steps), last - 1);
    (*place)[(*count)++] =
        curve->fine_length[step] + (steps - step) * (curve->fine_length[step + 1] - curve->fine_length[step]);
  }
  (*place)[(*count)++] = curve->fine_length[last];
done:
  return status;
}

static CwStatus add_curve_vertex(CwSkeleton *skeleton, const CwCurve *curve, const double x[3], int32_t *vertex) {
  return add_wall_vertex(skeleton, x, curve_guide(skeleton, curve), vertex);
}

typedef struct {
  const CwSkeleton *skeleton;
  int32_t count, *curve; // wall curves to divide: the first of each orbit
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
  const CwSkeleton *skeleton = curves->skeleton;
  const CwCurve *curve = &skeleton->network.curve[curves->curve[i]];
  double *place = NULL;
  CwCurvePoint *point = NULL;
  int32_t count, least = curve->corner[0] == curve->corner[1] ? 3 : 1;
  CW_TRY(divide_rim(skeleton, curve, &count, &place));
  int given = place != NULL;
  for (;;) {
    if (!given)
      CW_TRY(cw_curve_divide(skeleton, curve, 0, curve->fine_length[curve->fine_count - 1], least, &count, &place));
    CW_NEW(point, count);
    for (int32_t k = 0; k < count; k++) {
      point[k].place = place[k];
      cw_curve_point(&skeleton->network, curve, place[k], point[k].x, point[k].parameter);
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

// Divides the first of each orbit of wall curves; caller frees the points.
static CwStatus divide_curves(const CwSkeleton *skeleton, CwCurveDivision *division) {
  CwStatus status = CW_OK;
  const CwNetwork *network = &skeleton->network;
  Curves curves = {.skeleton = skeleton};
  void **bytes = NULL;
  int64_t *size = NULL;
  CW_NEW(curves.curve, network->curve_count);
  for (int32_t i = 0; i < network->curve_count; i++) {
    if (network->curve[i].wall && cw_orbit_turns(&skeleton->orbits, &skeleton->orbits.curve, i) == 0)
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
    of->given = rim_of(skeleton, &network->curve[curves.curve[i]]) != NULL;
    of->point = bytes[i];
    bytes[i] = NULL;
  }
  CW_TRY(cw_curve_divisions_refine(skeleton, division));
done:
  for (int32_t i = 0; bytes && i < curves.count; i++) free(bytes[i]);
  free(bytes);
  free(size);
  free(curves.curve);
  return status;
}

// The vertices of a divided curve and of its copies.
static CwStatus add_curve_vertices(CwSkeleton *skeleton, int32_t index, const CwCurveDivision *division) {
  CwStatus status = CW_OK;
  CwCurve *curve = &skeleton->network.curve[index];
  int32_t count = curve->point_count = division->count;
  CW_NEW(curve->node, count);
  CW_NEW(curve->parameter, count);
  CwGuide guide = curve_guide(skeleton, curve);
  for (int32_t k = 0; k < count; k++) {
    memcpy(curve->parameter[k], division->point[k].parameter, sizeof curve->parameter[k]);
    if (k == 0 || k == count - 1) {
      curve->node[k] = skeleton->surface.corner_vertex[curve->corner[k > 0]];
    } else {
      CW_TRY(add_wall_vertex(skeleton, division->point[k].x, guide, &curve->node[k]));
    }
  }
  CW_TRY(cw_orbit_copy_curve(skeleton, index, skeleton->surface.corner_vertex, &skeleton->surface.x, add_curve_vertex));
done:
  return status;
}

CwStatus cw_skeleton_wall_curves(CwSkeleton *skeleton) {
  CwStatus status = CW_OK;
  CwNetwork *network = &skeleton->network;
  CwCurveDivision *division = NULL;
  CW_NEW(skeleton->surface.corner_vertex, network->corner_count);
  for (int32_t i = 0; i < network->corner_count; i++) {
    skeleton->surface.corner_vertex[i] = -1;
    if (!network->corner[i].on_wall) continue;
    CwGuide guide;
    CW_TRY(corner_guide(skeleton, i, &guide));
    CW_TRY(add_wall_vertex(skeleton, network->corner[i].x, guide, &skeleton->surface.corner_vertex[i]));
  }
  CwSkeletonOrbits *orbits = &skeleton->orbits;
  for (int32_t i = 0; orbits->symmetry && i < network->corner_count; i++) {
    if (!network->corner[i].on_wall) continue;
    int32_t next = orbits->corner.next[i];
    CW_TRY(cw_orbit_link(orbits, skeleton->surface.corner_vertex[i], skeleton->surface.corner_vertex[next],
                         orbits->corner.turns[next]));
  }
  CW_NEW(division, network->curve_count);
  CW_TRY(divide_curves(skeleton, division));
  for (int32_t i = 0; i < network->curve_count; i++) {
    if (division[i].count) CW_TRY(add_curve_vertices(skeleton, i, &division[i]));
  }
done:
  for (int32_t i = 0; division && i < network->curve_count; i++) free(division[i].point);
  free(division);
  return status;
}

// (u,v) on `face` of point k of a curve that runs along it.
static void curve_uv(const CwSkeleton *skeleton, const CwCurve *curve, int32_t k, int32_t face, double uv[2]) {
  if (curve->kind == CW_CURVE_EDGE) {
    cw_cad_edge_uv(skeleton->cad, curve->edge, face, curve->parameter[k][0], uv);
  } else {
    memcpy(uv, curve->parameter[k], sizeof(double[2]));
  }
}

// The outline of a wall face: CAD edges first, so that their ends get the (u,v) of the edges, then the cuts.
static CwStatus wall_outline(const CwSkeleton *skeleton, int32_t face, CwPatchOutline *outline) {
  CwStatus status = CW_OK;
  CW_TRY(cw_outline_start(outline, skeleton->surface.vertex_count));
  for (int pass = 0; pass < 2; pass++) {
    CwCurveKind kind = pass == 0 ? CW_CURVE_EDGE : CW_CURVE_CUT;
    for (int32_t i = 0; i < skeleton->network.curve_count; i++) {
      const CwCurve *curve = &skeleton->network.curve[i];
      if (curve->kind != kind || !curve->wall || (curve->face[0] != face && curve->face[1] != face)) continue;
      int32_t previous = -1;
      for (int32_t k = 0; k < curve->point_count; k++) {
        double uv[2];
        int32_t local;
        curve_uv(skeleton, curve, k, face, uv);
        CW_TRY(cw_outline_point(outline, curve->node[k], uv, skeleton->surface.x[curve->node[k]], &local));
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
static CwStatus mesh_face(const CwSkeleton *skeleton, int32_t face,
                          CwStatus (*outline_of)(const CwSkeleton *, int32_t, CwPatchOutline *), void **bytes,
                          int64_t *size) {
  CwStatus status = CW_OK;
  CwPatchOutline outline = {0};
  FaceMap map = {skeleton->cad, face};
  CW_TRY(outline_of(skeleton, face, &outline));
  double largest = skeleton->largest ? skeleton->largest[cw_cad_face_patch(skeleton->cad, face)] : 0;
  CW_TRY(cw_patch_task(&outline, face_map, &map, skeleton->size_at, skeleton->size, largest,
                       cw_cad_face_reversed(skeleton->cad, face), region_at, skeleton->plan,
                       cw_cad_face_name(skeleton->cad, face), bytes, size));
done:
  cw_outline_free(&outline);
  return status;
}

CwStatus cw_skeleton_mesh_wall(const CwSkeleton *skeleton, int32_t face, void **bytes, int64_t *size) {
  return mesh_face(skeleton, face, wall_outline, bytes, size);
}

// No triangle may reach over a dividing plane: then a cut curve is missing. Turned copies are as their first.
static CwStatus check_triangle(void *context, int32_t t, void *out) {
  CwStatus status = CW_OK;
  const CwSkeleton *skeleton = context;
  if (skeleton->surface.source[t] != t) goto done;
  for (int k = 0; k < 3; k++) {
    const double *x = skeleton->surface.x[skeleton->surface.triangle[t][k]];
    CW_REQUIRE(cw_plan_in_region(skeleton->plan, skeleton->surface.region[t], x, ON_PLANE), CW_ERR_MESH,
               "a triangle of face %s at (%.3f, %.3f, %.3f) mm reaches out of region %d: a cut curve is missing",
               cw_cad_face_name(skeleton->cad, skeleton->surface.face[t]), CW_MM(x), skeleton->surface.region[t] + 1);
  }
  *(uint8_t *)out = 1;
done:
  return status;
}

static CwStatus check_regions(CwSkeleton *skeleton) {
  CwStatus status = CW_OK;
  uint8_t *checked = NULL;
  CW_NEW(checked, skeleton->surface.triangle_count);
  CW_TRY(cw_share("walls checked", skeleton->surface.triangle_count, 1, check_triangle, skeleton, checked));
done:
  free(checked);
  return status;
}

// Appends the triangles of a copy of a face, whose points have the numbers `vertex`.
static void append_triangles(CwSkeleton *skeleton, int32_t face, int32_t turns, int32_t source,
                             const CwPatchBlock *block, const int32_t *vertex) {
  const CwSkeletonOrbits *orbits = &skeleton->orbits;
  int32_t on = cw_orbit_face(orbits, face, turns), label = -1, region = -1;
  for (int32_t t = 0; t < block->triangle_count; t++) {
    int32_t at = skeleton->surface.triangle_count++;
    if (block->label[t] != label) { // those of one region mostly follow one another
      label = block->label[t];
      region = cw_orbit_region(orbits, skeleton->plan, label, turns);
    }
    for (int k = 0; k < 3; k++) skeleton->surface.triangle[at][k] = vertex[block->triangle[t][k]];
    skeleton->surface.face[at] = on;
    skeleton->surface.source[at] = source + t;
    skeleton->surface.region[at] = region;
  }
}

// Appends the mesh of a face for itself and its turned copies.
static CwStatus merge_wall(CwSkeleton *skeleton, int32_t face, const CwPatchBlock *block) {
  CwStatus status = CW_OK;
  CwSkeletonOrbits *orbits = &skeleton->orbits;
  int32_t copies = cw_orbit_face_copies(orbits, face), first = skeleton->surface.vertex_count;
  int32_t source = skeleton->surface.triangle_count, *vertex = NULL;
  CW_NEW(vertex, block->outline_points + block->point_count);
  for (int32_t turns = 0; turns < copies; turns++) {
    for (int32_t i = 0; i < block->outline_points; i++) {
      vertex[i] = cw_orbit_node(orbits, block->outline_node[i], turns);
    }
    for (int32_t i = 0; i < block->point_count; i++) {
      int32_t *made = &vertex[block->outline_points + i];
      double x[3];
      cw_orbit_point(orbits, turns, block->x[i], x);
      CW_TRY(add_wall_vertex(skeleton, x, (CwGuide){CW_GUIDE_NONE, -1}, made));
      if (turns > 0) CW_TRY(cw_orbit_link(orbits, *made - block->point_count, *made, turns));
      if (turns > 0 && turns == copies - 1) CW_TRY(cw_orbit_link(orbits, *made, first + i, 0));
    }
    append_triangles(skeleton, face, turns, source, block, vertex);
  }
done:
  free(vertex);
  return status;
}

// Lists the wall triangles by region.
static CwStatus list_regions(CwSkeleton *skeleton) {
  CwStatus status = CW_OK;
  int32_t regions = skeleton->plan->region_count, *start, *fill = NULL;
  CW_NEW(skeleton->surface.region_start, regions + 1);
  CW_NEW(skeleton->surface.region_triangle, skeleton->surface.triangle_count);
  CW_NEW(fill, regions);
  start = skeleton->surface.region_start;
  for (int32_t t = 0; t < skeleton->surface.triangle_count; t++) start[skeleton->surface.region[t] + 1]++;
  for (int32_t r = 0; r < regions; r++) {
    fill[r] = start[r];
    start[r + 1] += start[r];
  }
  for (int32_t t = 0; t < skeleton->surface.triangle_count; t++)
    skeleton->surface.region_triangle[fill[skeleton->surface.region[t]]++] = t;
done:
  free(fill);
  return status;
}

CwStatus cw_skeleton_merge_walls(CwSkeleton *skeleton, void *const *bytes) {
  CwStatus status = CW_OK;
  int32_t faces = cw_cad_face_count(skeleton->cad), total = 0, vertices = skeleton->surface.vertex_count;
  CwPatchBlock block;
  for (int32_t f = 0; f < faces; f++) {
    if (!bytes[f]) continue;
    int32_t copies = cw_orbit_face_copies(&skeleton->orbits, f);
    cw_patch_block(bytes[f], &block);
    total += block.triangle_count * copies;
    vertices += block.point_count * copies;
  }
  if (vertices > skeleton->surface.vertex_capacity) CW_TRY(reserve_wall(skeleton, vertices));
  CW_NEW(skeleton->surface.triangle, total);
  CW_NEW(skeleton->surface.face, total);
  CW_NEW(skeleton->surface.region, total);
  CW_NEW(skeleton->surface.source, total);
  for (int32_t f = 0; f < faces; f++) {
    if (!bytes[f]) continue;
    cw_patch_block(bytes[f], &block);
    CW_TRY(merge_wall(skeleton, f, &block));
  }
  CW_TRY(check_regions(skeleton));
  CW_TRY(list_regions(skeleton));
done:
  return status;
}

// Front node and its (u,v) on a cap: the (u,v) of the wall curve is the start of the search.
static CwStatus add_cap_point(const CwSkeleton *skeleton, const CwCurve *curve, int32_t k, int32_t face,
                              CwPatchOutline *outline, int32_t *local) {
  double uv[2];
  curve_uv(skeleton, curve, k, face, uv);
  const double *x = skeleton->interfaces.nodes.x[curve->node[k]];
  cw_cad_face_project(skeleton->cad, face, x, uv);
  return cw_outline_point(outline, curve->node[k], uv, x, local);
}

CwStatus cw_skeleton_cap_outline(const CwSkeleton *skeleton, int32_t face, CwPatchOutline *outline) {
  CwStatus status = CW_OK;
  CW_TRY(cw_outline_start(outline, skeleton->interfaces.nodes.count));
  for (int32_t i = 0; i < skeleton->network.curve_count; i++) {
    const CwCurve *curve = &skeleton->network.curve[i];
    if (curve->kind == CW_CURVE_LINE || (curve->face[0] != face && curve->face[1] != face)) continue;
    int32_t previous = -1, local;
    for (int32_t k = 0; k < curve->point_count; k++) {
      CW_TRY(add_cap_point(skeleton, curve, k, face, outline, &local));
      if (k > 0) CW_TRY(cw_outline_edge(outline, previous, local, curve->kind == CW_CURVE_EDGE));
      previous = local;
    }
  }
done:
  return status;
}

CwStatus cw_skeleton_mesh_cap(const CwSkeleton *skeleton, int32_t face, void **bytes, int64_t *size) {
  return mesh_face(skeleton, face, cw_skeleton_cap_outline, bytes, size);
}
