// SPDX-License-Identifier: AGPL-3.0-or-later
// The front of the skeleton: guides of the columns, the envelope of the layers.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/layers/front_flip.h"
#include "mesher/layers/layers.h"
#include "mesher/layers/wall_unfold.h"
#include "mesher/parallel/ledger.h"
#include "mesher/skeleton/front_open.h"
#include "mesher/skeleton/orbit_skeleton.h"
#include "mesher/skeleton/skeleton.h"
#include "pipeline/log.h"

static const double DIRECTION_LENGTH = 1e-5; // of the model's unit

// Outward or inward unit normal of a cap at the point nearest to x.
static void cap_normal(const CwCad *cad, int32_t face, const double x[3], double uv[2], double normal[3]) {
  double p[3], xu[3], xv[3];
  cw_cad_face_project(cad, face, x, uv);
  cw_cad_face_point(cad, face, uv, p, xu, xv);
  cw_cross(xu, xv, normal);
  cw_unit(normal);
}

// Corners of background triangles on a cap.
typedef struct {
  int32_t count;
  double (*x)[3], (*uv)[2];
} CapCorners;

static CwStatus collect_corners(const CwBackground *background, int32_t face, CapCorners *corners) {
  CwStatus status = CW_OK;
  int32_t triangles = 0;
  for (int32_t t = 0; t < background->triangle_count; t++) triangles += background->face[t] == face;
  CW_NEW(corners->x, 3 * (size_t)triangles);
  CW_NEW(corners->uv, 3 * (size_t)triangles);
  for (int32_t t = 0; t < background->triangle_count; t++) {
    if (background->face[t] != face) continue;
    for (int k = 0; k < 3; k++, corners->count++) {
      cw_copy(background->x[background->triangle[t][k]], corners->x[corners->count]);
      memcpy(corners->uv[corners->count], background->uv[t][k], sizeof(double[2]));
    }
  }
done:
  return status;
}

// Some (u,v) on a cap near x: that of the nearest background corner.
static void cap_start(const CapCorners *corners, const double x[3], double uv[2]) {
  double best = INFINITY;
  for (int32_t i = 0; i < corners->count; i++) {
    double distance = cw_distance(corners->x[i], x);
    if (distance >= best) continue;
    best = distance;
    memcpy(uv, corners->uv[i], sizeof(double[2]));
  }
}

// Two unit normals across a unit direction.
static void across(const double direction[3], double a[3], double b[3]) {
  int least = 0;
  for (int k = 1; k < 3; k++) {
    if (fabs(direction[k]) < fabs(direction[least])) least = k;
  }
  double axis[3] = {least == 0, least == 1, least == 2};
  cw_cross(direction, axis, a);
  cw_unit(a);
  cw_cross(direction, a, b);
}

// Direction of a free curve where it leaves the wall vertex at x. Points of a trace can lie as close as rounding: the
// first one at a distance that means something counts.
static void curve_direction(const CwCurve *curve, const double x[3], double direction[3]) {
  int32_t last = curve->fine_count - 1;
  int at_end = cw_distance(curve->fine_x[last], x) < cw_distance(curve->fine_x[0], x);
  memset(direction, 0, sizeof(double[3]));
  for (int32_t i = 1; i <= last; i++) {
    cw_sub(curve->fine_x[at_end ? last - i : i], curve->fine_x[at_end ? last : 0], direction);
    if (cw_unit(direction) > DIRECTION_LENGTH) break;
  }
}

typedef struct {
  const CwSkeleton *skeleton;
  double (*uv)[2]; // of each wall vertex that a cap guides
} Snap;

static void snap(const void *context, int32_t vertex, double x[3]) {
  const Snap *snap = context;
  const CwSkeleton *skeleton = snap->skeleton;
  CwGuide guide = skeleton->surface.guide[vertex];
  if (guide.kind == CW_GUIDE_PLANE) {
    const CwPlane *plane = &skeleton->plan->node[guide.index].plane;
    double distance = cw_plane_distance(plane, x);
    for (int k = 0; k < 3; k++) x[k] -= distance * plane->normal[k];
  } else if (guide.kind == CW_GUIDE_CAP) {
    double uv[2] = {snap->uv[vertex][0], snap->uv[vertex][1]}, from[3];
    cw_copy(x, from);
    cw_cad_face_project(skeleton->cad, guide.index, from, uv);
    cw_cad_face_point(skeleton->cad, guide.index, uv, x, NULL, NULL);
  } else if (guide.kind == CW_GUIDE_CURVE) {
    const CwCurve *curve = &skeleton->network.curve[guide.index];
    double parameter[2];
    cw_curve_point(&skeleton->network, curve, cw_curve_nearest(curve, x), x, parameter);
  }
}

// Edges may be flipped inside one CAD face and one region: curves stay. Turned copies are left to follow.
static CwStatus make_groups(const CwSkeleton *skeleton, int64_t **group) {
  CwStatus status = CW_OK;
  CW_NEW_UNSET(*group, skeleton->surface.triangle_count);
  for (int32_t t = 0; t < skeleton->surface.triangle_count; t++) {
    (*group)[t] = skeleton->surface.source[t] != t
                      ? -1 - (int64_t)t
                      : (int64_t)skeleton->surface.face[t] * skeleton->plan->region_count + skeleton->surface.region[t];
  }
done:
  return status;
}

static CwStatus unfold_wall(CwSkeleton *skeleton, const int64_t *group, CwFlipMesh *mesh) {
  CwStatus status = CW_OK;
  int32_t flips, folded;
  CW_TRY(cw_flip_neighbours(skeleton->surface.vertex_count, skeleton->surface.triangle_count, group, mesh));
  CW_TRY(cw_wall_unfold(skeleton->surface.vertex_count, (const double(*)[3])skeleton->surface.x,
                        skeleton->surface.triangle_count, mesh, group, &flips, &folded));
  cw_orbit_copy_triangles(skeleton);
  if (flips && skeleton->orbits.symmetry) { // copies have followed
    CW_TRY(cw_flip_neighbours(skeleton->surface.vertex_count, skeleton->surface.triangle_count, group, mesh));
  }
  if (flips || folded)
    cw_log_debug("%d edges flipped where the wall was folded; %d vertices with sharp faces", flips, folded);
done:
  return status;
}

static CwStatus flip_front(CwSkeleton *skeleton, const int64_t *group, CwFlipMesh *mesh) {
  CwStatus status = CW_OK;
  int32_t flips;
  CW_TRY(cw_front_flip((const double(*)[3])skeleton->surface.x, (const double(*)[3])skeleton->layers.front,
                       skeleton->surface.triangle_count, mesh, group, &flips));
  cw_orbit_copy_triangles(skeleton);
  cw_log_debug("%d edges of wall and front flipped", flips);
done:
  return status;
}

// What holds the columns on rims and cuts.
static CwStatus make_guides(const CwSkeleton *skeleton, const CwBackground *background, int32_t *guide_count,
                            double (*guide_normal)[2][3], uint8_t *guide_stays, double (*uv)[2]) {
  CwStatus status = CW_OK;
  int32_t faces = cw_cad_face_count(skeleton->cad);
  CapCorners *corners = NULL;
  CW_NEW(corners, faces);
  for (int32_t v = 0; v < skeleton->surface.vertex_count; v++) {
    CwGuide guide = skeleton->surface.guide[v];
    const double *x = skeleton->surface.x[v];
    if (guide.kind == CW_GUIDE_PLANE) {
      guide_count[v] = 1;
      cw_copy(skeleton->plan->node[guide.index].plane.normal, guide_normal[v][0]);
    } else if (guide.kind == CW_GUIDE_CAP) {
      CapCorners *cap = &corners[guide.index];
      guide_count[v] = guide_stays[v] = 1;
      if (!cap->x) CW_TRY(collect_corners(background, guide.index, cap));
      cap_start(cap, x, uv[v]);
      cap_normal(skeleton->cad, guide.index, x, uv[v], guide_normal[v][0]);
    } else if (guide.kind == CW_GUIDE_CURVE) {
      double direction[3];
      guide_count[v] = 2;
      curve_direction(&skeleton->network.curve[guide.index], x, direction);
      across(direction, guide_normal[v][0], guide_normal[v][1]);
    }
  }
done:
  for (int32_t f = 0; corners && f < faces; f++) {
    free(corners[f].x);
    free(corners[f].uv);
  }
  free(corners);
  return status;
}

CwStatus cw_skeleton_grow(CwSkeleton *skeleton, const CwBackground *background, const double *target,
                          const double *least, const CwLayerDivision *division, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  int32_t n = skeleton->surface.vertex_count, caps = 0, opened;
  int32_t *guide_count = NULL, (*cap_triangle)[3] = NULL;
  double(*guide_normal)[2][3] = NULL;
  uint8_t *guide_stays = NULL;
  Snap snapping = {skeleton, NULL};
  CwLayers layers = {0};
  CwFlipMesh mesh = {.triangle = skeleton->surface.triangle};
  int64_t *group = NULL;
  cw_ledger_part("layers: wall unfolded");
  CW_TRY(make_groups(skeleton, &group));
  CW_TRY(unfold_wall(skeleton, group, &mesh));
  CW_NEW(guide_count, n);
  CW_NEW(guide_normal, n);
  CW_NEW(guide_stays, n);
  CW_NEW(snapping.uv, n);
  cw_ledger_part("layers: guides");
  CW_TRY(make_guides(skeleton, background, guide_count, guide_normal, guide_stays, snapping.uv));
  CW_NEW(cap_triangle, background->triangle_count);
  for (int32_t t = 0; t < background->triangle_count; t++) {
    if (cw_face_is_wall(skeleton->cad, background->face[t])) continue;
    memcpy(cap_triangle[caps++], background->triangle[t], sizeof cap_triangle[0]);
  }
  CwLayerInput input = {.point_count = n,
                        .x = (const double(*)[3])skeleton->surface.x,
                        .triangle_count = skeleton->surface.triangle_count,
                        .triangle = (const int32_t(*)[3])skeleton->surface.triangle,
                        .target = target,
                        .least = least,
                        .division = division ? *division : (CwLayerDivision){0},
                        .guide_count = guide_count,
                        .guide_normal = (const double(*)[2][3])guide_normal,
                        .guide_stays = guide_stays,
                        .snap = snap,
                        .snap_context = &snapping,
                        .obstacle_point_count = background->point_count,
                        .obstacle_x = (const double(*)[3])background->x,
                        .obstacle_triangle_count = caps,
                        .obstacle_triangle = (const int32_t(*)[3])cap_triangle};
  CW_TRY_STAGE(skeleton->orbits.symmetry ? cw_orbit_layers(skeleton, &input, &layers, outcome)
                                         : cw_layers_make(&input, &layers, outcome),
               outcome);
  skeleton->layers = layers;
  layers = (CwLayers){0};
  cw_ledger_part("layers: front flipped");
  CW_TRY(flip_front(skeleton, group, &mesh));
  cw_ledger_part("layers: grooves");
  CW_TRY(cw_front_open(skeleton, &input, &opened));
done:
  free(mesh.near);
  free(group);
  cw_layers_free(&layers);
  free(guide_count);
  free(guide_normal);
  free(guide_stays);
  free(snapping.uv);
  free(cap_triangle);
  return status;
}
