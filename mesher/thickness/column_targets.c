// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/thickness/column_targets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/network/periodic_images.h"
#include "mesher/common/model_unit.h"
#include "mesher/common/vec.h"
#include "mesher/layers/thickness_gradation.h"
#include "mesher/parallel/parallel_for.h"
#include "mesher/policy.h"
#include "mesher/thickness/layer_count.h"
#include "mesher/thickness/layer_thickness.h"

// How the wall lies about a vertex.
typedef struct {
  double normal[3]; // mean of the triangles, out of the domain
  double cosine;    // least, of their normals to it
  double rise;      // greatest, of the edges against it, over their lengths: above 0 in a concave place
} Bend;

// The column whose last layer is `last` times as tall as a regular tetrahedron on edges of `size`, or the tallest with
// no layer that grows by more than `growth`. Columns give up growth for it, never the first height.
static double fair_thickness(double first, int count, double growth, double size, double last) {
  if (count > 1) growth = fmin(growth, pow(fmax(last * CW_REGULAR_HEIGHT * size / first, 1), 1.0 / (count - 1)));
  return fmax(count * first, cw_layer_thickness(first, count, growth));
}

double cw_column_thickness_flat(const CwLayerTarget *layers, int layer_count, double size) {
  return fmin(layers->thickness, fair_thickness(layers->first_height, layer_count, layers->growth, size, layers->last));
}

double cw_column_thickness_at(const CwLayerTarget *layers, int layer_count, CwSizeAt size_at, const void *size,
                              const double x[3], const double normal[3]) {
  double at_wall = size_at(size, x), thickness = 0;
  for (int pass = 0; pass < 2; pass++) {
    double end[3];
    for (int k = 0; k < 3; k++) end[k] = x[k] - thickness * normal[k];
    double above = fmin(fmax(at_wall, size_at(size, end)), at_wall + cw_policy.slope * thickness);
    thickness = fair_thickness(layers->first_height, layer_count, layers->growth, above, layers->last);
  }
  return fmin(layers->thickness, thickness);
}

// What the tasks below read.
typedef struct {
  const CwBoundaryInput *in;
  const CwSurfaceMesh *surface;
  const CwIncident *around;
  const CwColumnTargets *targets;
  const CwLayerTarget *layers; // of each CAD face
  const CwLayerTarget *asked;  // of each vertex
  const double *graded;        // thicknesses
} Columns;

static double size_at(const CwBoundaryInput *in, const double x[3]) {
  return in->size_at(in->size, x);
}

// Unit normal of a triangle, out of the domain.
static void find_normal(const CwSurfaceMesh *surface, const int32_t corner[3], double normal[3]) {
  cw_normal(surface->x[corner[0]], surface->x[corner[1]], surface->x[corner[2]], normal);
  cw_unit(normal);
}

static Bend bend_at(const CwSurfaceMesh *surface, const CwIncident *around, int32_t v) {
  Bend bend = {.cosine = 1, .rise = -1};
  const double *x = surface->x[v];
  for (int32_t i = around->start[v]; i < around->start[v + 1]; i++) {
    double normal[3];
    find_normal(surface, surface->triangle[around->triangle[i]], normal);
    for (int c = 0; c < 3; c++) bend.normal[c] += normal[c];
  }
  cw_unit(bend.normal);
  for (int32_t i = around->start[v]; i < around->start[v + 1]; i++) {
    const int32_t *corner = surface->triangle[around->triangle[i]];
    double normal[3], edge[3];
    find_normal(surface, corner, normal);
    bend.cosine = fmin(bend.cosine, cw_dot(normal, bend.normal));
    for (int k = 0; k < 3; k++) {
      if (corner[k] == v) continue;
      cw_sub(x, surface->x[corner[k]], edge);
      cw_unit(edge);
      bend.rise = fmax(bend.rise, cw_dot(edge, bend.normal));
    }
  }
  return bend;
}

// The thickness of a column that is fair by the cells around it, or the target where that is less. Periodic images get
// that of their first: the size field is symmetric only to within its grid.
static CwStatus find_fair(void *context, int32_t v, void *out) {
  const Columns *columns = context;
  const CwBoundaryInput *in = columns->in;
  const CwSurfaceMesh *surface = columns->surface;
  if (cw_image_node_turns(&surface->images, v) > 0) return CW_OK;
  Bend bend = bend_at(surface, columns->around, v);
  CwLayerTarget layers = columns->asked[v];
  layers.first_height = columns->targets->first_height[v];
  layers.growth = columns->targets->growth[v];
  // In a concave place tetrahedra have two faces on the layer top, and are the flatter the sharper the bend is.
  if (bend.cosine < cw_policy.crease_cosine && bend.rise > cw_policy.concave_rise) layers.last *= bend.cosine;
  *(double *)out =
      cw_column_thickness_at(&layers, columns->targets->layer_count, in->size_at, in->size, surface->x[v], bend.normal);
  return CW_OK;
}

// What the gradation of thicknesses at wall vertices reads.
typedef struct {
  const CwSurfaceMesh *surface;
  const double *thickness;
  double slope;
} Slope;

static double most_beside(const void *context, int32_t v, int32_t w) {
  const Slope *slope = context;
  return slope->thickness[v] + slope->slope * cw_distance(slope->surface->x[v], slope->surface->x[w]);
}

// Thicknesses rise by no more than `slope` per distance along any edge of the wall. Collective.
static CwStatus grade(const CwContext *context, const CwSurfaceMesh *surface, const CwIncident *around, double slope,
                      double *thickness) {
  return cw_grade_thickness(&(CwGradation){.context = context,
                                           .step = "thicknesses: steep",
                                           .count = surface->vertex_count,
                                           .start = around->start,
                                           .triangle = around->triangle,
                                           .corner = (const int32_t(*)[3])surface->triangle,
                                           .most = most_beside,
                                           .given = &(Slope){surface, thickness, slope},
                                           .thickness = thickness},
                            NULL);
}

// The finer one holds where patches meet.
static CwStatus find_asked(void *context, int32_t v, void *out) {
  CwStatus status = CW_OK;
  const Columns *columns = context;
  const double *x = columns->surface->x[v];
  CwLayerTarget of = {.first_height = INFINITY, .thickness = INFINITY, .last = INFINITY};
  int32_t before = -1;
  for (int32_t i = columns->around->start[v]; i < columns->around->start[v + 1]; i++) {
    int32_t face = columns->surface->face[columns->around->triangle[i]];
    if (face == before) continue;
    before = face;
    of.first_height = fmin(of.first_height, columns->layers[face].first_height);
    of.thickness = fmin(of.thickness, columns->layers[face].thickness);
    of.growth = fmax(of.growth, columns->layers[face].growth);
    of.last = fmin(of.last, columns->layers[face].last);
  }
  CW_REQUIRE(isfinite(of.thickness), CW_ERR_MESH, "wall vertex at (%.3f, %.3f, %.3f) mm belongs to no triangle",
             CW_MM(x));
  *(CwLayerTarget *)out = of;
done:
  return status;
}

// What the walls ask of each vertex. Away from where patches meet the first height grows no faster than columns whose
// layers grow a little can. A single layer has no growth to give up where columns may rise less than that: it rises as
// the first of two.
static CwStatus take_asked(const CwContext *context, const CwSurfaceMesh *surface, const CwIncident *around,
                           const CwLayerTarget *layers, CwColumnTargets *targets, CwLayerTarget *asked) {
  CwStatus status = CW_OK;
  Columns columns = {.surface = surface, .around = around, .layers = layers};
  CW_TRY(cw_parallel_for(context, "thicknesses: asked", surface->vertex_count, sizeof *asked, find_asked, &columns,
                         asked));
  for (int32_t v = 0; v < surface->vertex_count; v++) {
    targets->first_height[v] = asked[v].first_height;
    targets->growth[v] = asked[v].growth;
  }
  int count = targets->layer_count > 1 ? targets->layer_count : 2;
  CW_TRY(grade(context, surface, around, cw_policy.slope / count, targets->first_height));
done:
  return status;
}

static void turn_copies(const CwNodeImages *nodes, int32_t count, CwColumnTargets *targets) {
  for (int32_t v = 0; v < count; v++) {
    if (cw_image_node_turns(nodes, v) > 0) continue;
    for (int32_t at = cw_image_after(nodes, v, v); at >= 0; at = cw_image_after(nodes, at, v)) {
      targets->target[at] = targets->target[v];
      targets->first_height[at] = targets->first_height[v];
      targets->growth[at] = targets->growth[v];
    }
  }
}

CwStatus cw_column_targets_make(const CwContext *context, const CwBoundaryInput *in, const CwSurfaceMesh *surface,
                                const CwIncident *around, const CwLayerTarget *layers, int layer_count,
                                CwColumnTargets *targets) {
  CwStatus status = CW_OK;
  CwLayerTarget *asked = NULL;
  *targets = (CwColumnTargets){.layer_count = layer_count, .vertex_count = surface->vertex_count};
  CW_NEW_UNSET(targets->first_height, surface->vertex_count);
  CW_NEW_UNSET(targets->growth, surface->vertex_count);
  CW_NEW_UNSET(targets->target, surface->vertex_count);
  CW_NEW_UNSET(targets->least, surface->vertex_count);
  CW_NEW_UNSET(asked, surface->vertex_count);
  CW_TRY(take_asked(context, surface, around, layers, targets, asked));
  Columns columns = {.in = in, .surface = surface, .around = around, .targets = targets, .asked = asked};
  CW_TRY(cw_parallel_for(context, "thicknesses: fair ones", surface->vertex_count, sizeof *targets->target, find_fair,
                         &columns, targets->target));
  turn_copies(&surface->images, surface->vertex_count, targets);
  double lowest = cw_layer_lowest(layer_count);
  for (int32_t v = 0; v < surface->vertex_count; v++) targets->least[v] = lowest * targets->first_height[v];
done:
  free(asked);
  return status;
}

// What a wall triangle takes of the volume, and what a flat wall would, in cells; with its periodic images.
typedef struct {
  double taken, flat;
} Taken;

static CwStatus find_taken(void *context, int32_t t, void *out) {
  const Columns *columns = context;
  const CwBoundaryInput *in = columns->in;
  const CwSurfaceMesh *surface = columns->surface;
  const int32_t *corner = surface->triangle[t], face = surface->face[t];
  double u[3], v[3], normal[3], centre[3], mean = 0;
  if (surface->source[t] != t) return CW_OK;
  for (int k = 0; k < 3; k++) {
    u[k] = surface->x[corner[1]][k] - surface->x[corner[0]][k];
    v[k] = surface->x[corner[2]][k] - surface->x[corner[0]][k];
    centre[k] = surface->x[corner[0]][k] + (u[k] + v[k]) / 3;
    mean += columns->graded[corner[k]] / 3;
  }
  cw_cross(u, v, normal);
  double h = size_at(in, centre);
  double weight = cw_norm(normal) / (h * h * h) * cw_image_face_copies(in->images, face);
  double flat = cw_column_thickness_flat(&columns->layers[face], columns->targets->layer_count, h);
  *(Taken *)out = (Taken){weight * mean, weight * flat};
  return CW_OK;
}

CwStatus cw_column_targets_share(const CwContext *context, const CwColumnTargets *targets, const CwBoundaryInput *in,
                                 const CwSurfaceMesh *surface, const CwIncident *around, const CwLayerTarget *layers,
                                 double *share) {
  CwStatus status = CW_OK;
  double *graded = NULL;
  Taken *of = NULL, sum = {0};
  CW_NEW_UNSET(graded, surface->vertex_count);
  CW_NEW_UNSET(of, surface->triangle_count);
  memcpy(graded, targets->target, (size_t)surface->vertex_count * sizeof *graded);
  CW_TRY(grade(context, surface, around, cw_policy.slope, graded));
  Columns columns = {.in = in, .surface = surface, .targets = targets, .layers = layers, .graded = graded};
  CW_TRY(
      cw_parallel_for(context, "thicknesses: volume", surface->triangle_count, sizeof *of, find_taken, &columns, of));
  for (int32_t t = 0; t < surface->triangle_count; t++) {
    sum.taken += of[t].taken;
    sum.flat += of[t].flat;
  }
  *share = sum.flat > 0 ? sum.taken / sum.flat : 1;
done:
  free(graded);
  free(of);
  return status;
}

void cw_column_targets_arrays(void *product, CwArrayVisit visit, void *given) {
  CwColumnTargets *targets = product;
  CW_SHOW(visit, given, targets->first_height, targets->vertex_count);
  CW_SHOW(visit, given, targets->growth, targets->vertex_count);
  CW_SHOW(visit, given, targets->target, targets->vertex_count);
  CW_SHOW(visit, given, targets->least, targets->vertex_count);
}

void cw_column_targets_free(CwColumnTargets *targets) {
  cw_arrays_free(targets, cw_column_targets_arrays, &targets->memory);
  *targets = (CwColumnTargets){0};
}
