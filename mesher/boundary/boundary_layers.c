// SPDX-License-Identifier: AGPL-3.0-or-later
// Sliding constraints of the columns, the layer envelope, and the layer top.
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/boundary/boundary.h"
#include "mesher/boundary/concave_edges.h"
#include "mesher/boundary/periodic_boundary.h"
#include "mesher/boundary/pinched_vertices.h"
#include "mesher/common/vec.h"
#include "mesher/layers/layer_top_flip.h"
#include "mesher/layers/layers.h"
#include "mesher/layers/wall_unfold.h"
#include "mesher/parallel/profiler.h"
#include "pipeline/log.h"

static const double DIRECTION_LENGTH = 1e-5; // of the model's unit

// Outward or inward unit normal of an open patch at the point nearest to x.
static void open_patch_normal(const CwCad *cad, int32_t face, const double x[3], double uv[2], double normal[3]) {
  double p[3], xu[3], xv[3];
  cw_cad_face_project(cad, face, x, uv);
  cw_cad_face_point(cad, face, uv, p, xu, xv);
  cw_cross(xu, xv, normal);
  cw_unit(normal);
}

// Corners of background triangles on an open patch.
typedef struct {
  int32_t count;
  double (*x)[3], (*uv)[2];
} PatchCorners;

static CwStatus collect_corners(const CwBackground *background, int32_t face, PatchCorners *corners) {
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

// Some (u,v) on an open patch near x: that of the nearest background corner.
static void open_patch_start(const PatchCorners *corners, const double x[3], double uv[2]) {
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
  const CwBoundaryInput *in;
  const CwSurfaceMesh *surface;
  double (*uv)[2];       // of each wall vertex that an open patch holds
  pthread_mutex_t *lock; // of the CAD, which one thread may ask at a time
} Snap;

void cw_boundary_hold(const CwBoundaryInput *in, CwConstraint constraint, const double uv[2], double x[3]) {
  double from[3], parameter[2];
  cw_copy(x, from);
  if (constraint.kind == CW_CONSTRAINT_PLANE) {
    const CwPlane *plane = &in->plan->node[constraint.index].plane;
    const double distance = cw_plane_distance(plane, from);
    for (int k = 0; k < 3; k++) x[k] -= distance * plane->normal[k];
  } else if (constraint.kind == CW_CONSTRAINT_PATCH) {
    double at[2] = {uv[0], uv[1]};
    cw_cad_face_project(in->cad, constraint.index, from, at);
    cw_cad_face_point(in->cad, constraint.index, at, x, NULL, NULL);
  } else if (constraint.kind == CW_CONSTRAINT_CURVE) {
    const CwCurve *curve = &in->network->curve[constraint.index];
    cw_curve_point(in->network, curve, cw_curve_nearest(curve, from), x, parameter);
  }
}

static void snap(const void *context, int32_t vertex, double x[3]) {
  const Snap *snap = context;
  pthread_mutex_lock(snap->lock);
  cw_boundary_hold(snap->in, snap->surface->constraint[vertex], snap->uv[vertex], x);
  pthread_mutex_unlock(snap->lock);
}

// Edges may be flipped inside one CAD face and one region: curves stay. Periodic images are left to follow.
static CwStatus make_groups(const CwBoundaryInput *in, const CwSurfaceMesh *surface, int64_t **group) {
  CwStatus status = CW_OK;
  CW_NEW_UNSET(*group, surface->triangle_count);
  for (int32_t t = 0; t < surface->triangle_count; t++) {
    (*group)[t] = surface->source[t] != t ? -1 - (int64_t)t
                                          : (int64_t)surface->face[t] * in->plan->region_count + surface->region[t];
  }
done:
  return status;
}

// Neighbours are found for each of two steps anew, so that they take no memory while layers are made.
static CwStatus unfold_wall(const CwContext *context, const CwBoundaryInput *in, const CwSurfaceMesh *surface,
                            CwFlipMesh *mesh) {
  CwStatus status = CW_OK;
  int64_t *group = NULL;
  int32_t flips, folded;
  CW_TRY(make_groups(in, surface, &group));
  CW_TRY(cw_flip_neighbours(context, surface->vertex_count, surface->triangle_count, group, mesh));
  CW_TRY(cw_wall_unfold(context, surface->vertex_count, (const double(*)[3])surface->x, surface->triangle_count, mesh,
                        group, &flips, &folded));
  cw_image_copy_triangles(in->images, surface, mesh->triangle);
  if (flips || folded)
    cw_log_debug(cw_log_of(context), "%d edges flipped where the wall was folded; %d vertices with sharp faces", flips,
                 folded);
done:
  free(group);
  free(mesh->near);
  mesh->near = NULL;
  return status;
}

static CwStatus flip_top(const CwContext *context, const CwBoundaryInput *in, const CwSurfaceMesh *surface,
                         const double (*top)[3], CwFlipMesh *mesh) {
  CwStatus status = CW_OK;
  int64_t *group = NULL;
  int32_t flips;
  CW_TRY(make_groups(in, surface, &group));
  CW_TRY(cw_flip_neighbours(context, surface->vertex_count, surface->triangle_count, group, mesh));
  CW_TRY(cw_layer_top_flip(context, (const double(*)[3])surface->x, top, surface->triangle_count, mesh, group, &flips));
  cw_image_copy_triangles(in->images, surface, mesh->triangle);
  cw_log_debug(cw_log_of(context), "%d edges of wall and layer top flipped", flips);
done:
  free(group);
  return status;
}

// What holds the columns on open edges and cuts.
static CwStatus make_constraints(const CwBoundaryInput *in, const CwSurfaceMesh *surface,
                                 const CwBackground *background, int32_t *constraint_count,
                                 double (*constraint_normal)[2][3], uint8_t *constraint_stays, double (*uv)[2]) {
  CwStatus status = CW_OK;
  int32_t faces = cw_cad_face_count(in->cad);
  PatchCorners *corners = NULL;
  CW_NEW(corners, faces);
  for (int32_t v = 0; v < surface->vertex_count; v++) {
    CwConstraint constraint = surface->constraint[v];
    const double *x = surface->x[v];
    if (constraint.kind == CW_CONSTRAINT_PLANE) {
      constraint_count[v] = 1;
      cw_copy(in->plan->node[constraint.index].plane.normal, constraint_normal[v][0]);
    } else if (constraint.kind == CW_CONSTRAINT_PATCH) {
      PatchCorners *open_patch = &corners[constraint.index];
      constraint_count[v] = constraint_stays[v] = 1;
      if (!open_patch->x) CW_TRY(collect_corners(background, constraint.index, open_patch));
      open_patch_start(open_patch, x, uv[v]);
      open_patch_normal(in->cad, constraint.index, x, uv[v], constraint_normal[v][0]);
    } else if (constraint.kind == CW_CONSTRAINT_CURVE) {
      const CwCurve *curve = &in->network->curve[constraint.index];
      double direction[3];
      constraint_count[v] = 2;
      constraint_stays[v] = curve->edge >= 0;
      curve_direction(curve, x, direction);
      across(direction, constraint_normal[v][0], constraint_normal[v][1]);
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

CwStatus cw_boundary_grow(const CwContext *context, const CwBoundaryInput *in, const CwWallCurves *curves,
                          const CwSurfaceMesh *surface, const CwBackground *background, const double *target,
                          const double *least, const CwLayerDivision *division, CwLayers *layers, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  int32_t n = surface->vertex_count, triangles = surface->triangle_count, open_patches = 0, opened;
  int32_t *constraint_count = NULL, (*open_patch_triangle)[3] = NULL;
  double(*constraint_normal)[2][3] = NULL;
  uint8_t *constraint_stays = NULL, *pinched = NULL;
  pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
  Snap snapping = {in, surface, NULL, &lock};
  CwFlipMesh mesh = {0};
  *layers = (CwLayers){0};
  cw_profiler_part(context, "layers: wall unfolded");
  CW_NEW_UNSET(mesh.triangle, triangles);
  memcpy(mesh.triangle, surface->triangle, (size_t)triangles * sizeof *mesh.triangle);
  CW_TRY(unfold_wall(context, in, surface, &mesh));
  CW_NEW(constraint_count, n);
  CW_NEW(constraint_normal, n);
  CW_NEW(constraint_stays, n);
  CW_NEW(snapping.uv, n);
  cw_profiler_part(context, "layers: constraints");
  CW_TRY(make_constraints(in, surface, background, constraint_count, constraint_normal, constraint_stays, snapping.uv));
  CW_TRY(cw_pinched_vertices(in, curves, surface, &pinched));
  CW_NEW(open_patch_triangle, background->triangle_count);
  for (int32_t t = 0; t < background->triangle_count; t++) {
    if (cw_cad_face_is_wall(in->cad, background->face[t])) continue;
    memcpy(open_patch_triangle[open_patches++], background->triangle[t], sizeof open_patch_triangle[0]);
  }
  CwLayerInput input = {.context = context,
                        .point_count = n,
                        .x = (const double(*)[3])surface->x,
                        .triangle_count = triangles,
                        .triangle = (const int32_t(*)[3])mesh.triangle,
                        .target = target,
                        .least = least,
                        .division = division ? *division : (CwLayerDivision){0},
                        .pinched = pinched,
                        .constraint_count = constraint_count,
                        .constraint_normal = (const double(*)[2][3])constraint_normal,
                        .constraint_stays = constraint_stays,
                        .snap = snap,
                        .snap_context = &snapping,
                        .obstacle_point_count = background->point_count,
                        .obstacle_x = (const double(*)[3])background->x,
                        .obstacle_triangle_count = open_patches,
                        .obstacle_triangle = (const int32_t(*)[3])open_patch_triangle};
  CW_TRY_STAGE(in->images->symmetry ? cw_image_layers(in->images, surface, &input, layers, outcome)
                                    : cw_layers_make(&input, layers, outcome),
               outcome);
  cw_profiler_part(context, "layers: layer top flipped");
  CW_TRY(flip_top(context, in, surface, (const double(*)[3])layers->top, &mesh));
  cw_profiler_part(context, "layers: narrow concave edges");
  CW_TRY(cw_open_concave_edges(in->images, surface, &input, layers, &opened));
  layers->triangle_count = triangles;
  layers->triangle = mesh.triangle;
  mesh.triangle = NULL;
done:
  free(mesh.triangle);
  free(mesh.near);
  if (status != CW_OK || outcome->kind != CW_OUTCOME_DONE) cw_layers_free(layers);
  free(constraint_count);
  free(constraint_normal);
  free(constraint_stays);
  free(pinched);
  free(snapping.uv);
  free(open_patch_triangle);
  return status;
}
