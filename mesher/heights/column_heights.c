// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/heights/column_heights.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/model_unit.h"
#include "mesher/common/vec.h"
#include "mesher/heights/layer_count.h"
#include "mesher/heights/layer_heights.h"
#include "mesher/layers/height_gradation.h"
#include "mesher/parallel/share.h"

static const double BEND = 0.94;   // least cosine of the normals about a vertex of a wall as good as flat
static const double HOLLOW = 0.25; // least rise of an edge over its length at a bend that is concave
static const double LITTLE_GROWTH = 1.1;
static const double KEPT_GROWTH = 0.7; // least in columns thinned for their shape, above CW_LEAST_GROWTH: thinned
                                       // further, some made angles of 16 degrees where others have 19

// How the wall lies about a vertex.
typedef struct {
  double normal[3]; // mean of the triangles, out of the domain
  double cosine;    // least, of their normals to it
  double rise;      // greatest, of the edges against it, over their lengths: above 0 in a hollow
} Bend;

double cw_column_height_least(double first, int layer_count) {
  return CW_EVEN_LAYERS * layer_count * first;
}

// The column whose last layer is `last` times as tall as a regular tetrahedron on edges of `size`, or the tallest with
// no layer that grows by more than `growth`. Columns give up growth for it, never the first height.
static double fair_height(double first, int count, double growth, double size, double last) {
  if (count > 1) growth = fmin(growth, pow(fmax(last * CW_REGULAR_HEIGHT * size / first, 1), 1.0 / (count - 1)));
  return fmax(cw_column_height_least(first, count), cw_layer_thickness(first, count, growth));
}

double cw_column_height_flat(const CwLayerTarget *layers, int layer_count, double size) {
  return fmin(layers->thickness, fair_height(layers->first_height, layer_count, layers->growth, size, layers->last));
}

// What the tasks below read.
typedef struct {
  const CwSkeleton *skeleton;
  const CwIncident *around;
  const CwColumnHeights *heights;
  const CwLayerTarget *layers; // of each CAD face
  const CwLayerTarget *asked;  // of each vertex
  const double *graded;        // heights
} Columns;

static double size_at(const CwSkeleton *skeleton, const double x[3]) {
  return skeleton->size_at(skeleton->size, x);
}

// Unit normal of a triangle, out of the domain.
static void find_normal(const CwSkeleton *skeleton, const int32_t corner[3], double normal[3]) {
  double u[3], v[3];
  cw_sub(skeleton->surface.x[corner[1]], skeleton->surface.x[corner[0]], u);
  cw_sub(skeleton->surface.x[corner[2]], skeleton->surface.x[corner[0]], v);
  cw_cross(u, v, normal);
  cw_unit(normal);
}

static Bend bend_at(const CwSkeleton *skeleton, const CwIncident *around, int32_t v) {
  Bend bend = {.cosine = 1, .rise = -1};
  const double *x = skeleton->surface.x[v];
  for (int32_t i = around->start[v]; i < around->start[v + 1]; i++) {
    double normal[3];
    find_normal(skeleton, skeleton->surface.triangle[around->triangle[i]], normal);
    for (int c = 0; c < 3; c++) bend.normal[c] += normal[c];
  }
  cw_unit(bend.normal);
  for (int32_t i = around->start[v]; i < around->start[v + 1]; i++) {
    const int32_t *corner = skeleton->surface.triangle[around->triangle[i]];
    double normal[3], edge[3];
    find_normal(skeleton, corner, normal);
    bend.cosine = fmin(bend.cosine, cw_dot(normal, bend.normal));
    for (int k = 0; k < 3; k++) {
      if (corner[k] == v) continue;
      cw_sub(x, skeleton->surface.x[corner[k]], edge);
      cw_unit(edge);
      bend.rise = fmax(bend.rise, cw_dot(edge, bend.normal));
    }
  }
  return bend;
}

// The height of a column that is fair by the cells around it, or the target where that is less. The tetrahedron on it
// stands at the end of the column, where the size is another than at the wall: the height is reckoned twice. Nowhere
// grow sizes faster than heights. Turned copies get that of their first: the size field is symmetric only to within its
// grid.
static CwStatus find_fair(void *context, int32_t v, void *out) {
  const Columns *columns = context;
  const CwSkeleton *skeleton = columns->skeleton;
  const CwColumnHeights *heights = columns->heights;
  const double *x = skeleton->surface.x[v];
  if (cw_orbit_node_turns(&skeleton->orbits, v) > 0) return CW_OK;
  Bend bend = bend_at(skeleton, columns->around, v);
  double size = size_at(skeleton, x), height = 0, last = columns->asked[v].last;
  // In a hollow tetrahedra have two faces on the layer top, and are the flatter the sharper the bend is.
  if (bend.cosine < BEND && bend.rise > HOLLOW) last *= bend.cosine;
  for (int pass = 0; pass < 2; pass++) {
    double end[3];
    for (int k = 0; k < 3; k++) end[k] = x[k] - height * bend.normal[k];
    double above = fmin(fmax(size, size_at(skeleton, end)), size + CW_HEIGHT_SLOPE * height);
    height = fair_height(heights->first_height[v], heights->layer_count, heights->growth[v], above, last);
  }
  *(double *)out = fmin(columns->asked[v].thickness, height);
  return CW_OK;
}

// What the gradation of heights at wall vertices reads.
typedef struct {
  const CwSkeleton *skeleton;
  const double *height;
  double slope;
} Slope;

static double most_beside(const void *context, int32_t v, int32_t w) {
  const Slope *slope = context;
  return slope->height[v] + slope->slope * cw_distance(slope->skeleton->surface.x[v], slope->skeleton->surface.x[w]);
}

// Heights rise by no more than `slope` per distance along any edge of the wall. Collective.
static CwStatus grade(const CwSkeleton *skeleton, const CwIncident *around, double slope, double *height) {
  return cw_grade_heights(&(CwGradation){.step = "heights: steep",
                                         .count = skeleton->surface.vertex_count,
                                         .start = around->start,
                                         .triangle = around->triangle,
                                         .corner = (const int32_t(*)[3])skeleton->surface.triangle,
                                         .most = most_beside,
                                         .context = &(Slope){skeleton, height, slope},
                                         .height = height},
                          NULL);
}

// The finer one holds where patches meet.
static CwStatus find_asked(void *context, int32_t v, void *out) {
  CwStatus status = CW_OK;
  const Columns *columns = context;
  const double *x = columns->skeleton->surface.x[v];
  CwLayerTarget of = {.first_height = INFINITY, .thickness = INFINITY, .last = INFINITY};
  int32_t before = -1;
  for (int32_t i = columns->around->start[v]; i < columns->around->start[v + 1]; i++) {
    int32_t face = columns->skeleton->surface.face[columns->around->triangle[i]];
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
// layers grow a little can.
static CwStatus take_asked(const CwSkeleton *skeleton, const CwIncident *around, const CwLayerTarget *layers,
                           CwColumnHeights *heights, CwLayerTarget *asked) {
  CwStatus status = CW_OK;
  Columns columns = {.skeleton = skeleton, .around = around, .layers = layers};
  CW_TRY(cw_share("heights: asked", skeleton->surface.vertex_count, sizeof *asked, find_asked, &columns, asked));
  for (int32_t v = 0; v < skeleton->surface.vertex_count; v++) {
    heights->first_height[v] = asked[v].first_height;
    heights->growth[v] = asked[v].growth;
  }
  CW_TRY(grade(skeleton, around, CW_HEIGHT_SLOPE / cw_layer_thickness(1, heights->layer_count, LITTLE_GROWTH),
               heights->first_height));
done:
  return status;
}

static void turn_copies(const CwSkeletonOrbits *orbits, int32_t count, CwColumnHeights *heights) {
  for (int32_t v = 0; v < count; v++) {
    if (cw_orbit_node_turns(orbits, v) > 0) continue;
    for (int32_t at = cw_orbit_node(orbits, v, 1); at >= 0 && at != v; at = cw_orbit_node(orbits, at, 1)) {
      heights->target[at] = heights->target[v];
      heights->first_height[at] = heights->first_height[v];
      heights->growth[at] = heights->growth[v];
    }
  }
}

CwStatus cw_column_heights_make(const CwSkeleton *skeleton, const CwIncident *around, const CwLayerTarget *layers,
                                int layer_count, CwColumnHeights *heights) {
  CwStatus status = CW_OK;
  CwLayerTarget *asked = NULL;
  *heights = (CwColumnHeights){.layer_count = layer_count};
  CW_NEW_UNSET(heights->first_height, skeleton->surface.vertex_count);
  CW_NEW_UNSET(heights->growth, skeleton->surface.vertex_count);
  CW_NEW_UNSET(heights->target, skeleton->surface.vertex_count);
  CW_NEW_UNSET(heights->least, skeleton->surface.vertex_count);
  CW_NEW_UNSET(asked, skeleton->surface.vertex_count);
  CW_TRY(take_asked(skeleton, around, layers, heights, asked));
  Columns columns = {.skeleton = skeleton, .around = around, .heights = heights, .asked = asked};
  CW_TRY(cw_share("heights: fair ones", skeleton->surface.vertex_count, sizeof *heights->target, find_fair, &columns,
                  heights->target));
  turn_copies(&skeleton->orbits, skeleton->surface.vertex_count, heights);
  double lowest = cw_layer_thickness(1, layer_count, KEPT_GROWTH);
  for (int32_t v = 0; v < skeleton->surface.vertex_count; v++) heights->least[v] = lowest * heights->first_height[v];
done:
  free(asked);
  return status;
}

// What a wall triangle takes of the volume, and what a flat wall would, in cells; with its turned copies.
typedef struct {
  double taken, flat;
} Taken;

static CwStatus find_taken(void *context, int32_t t, void *out) {
  const Columns *columns = context;
  const CwSkeleton *skeleton = columns->skeleton;
  const int32_t *corner = skeleton->surface.triangle[t], face = skeleton->surface.face[t];
  double u[3], v[3], normal[3], centre[3], mean = 0;
  if (skeleton->surface.source[t] != t) return CW_OK;
  for (int k = 0; k < 3; k++) {
    u[k] = skeleton->surface.x[corner[1]][k] - skeleton->surface.x[corner[0]][k];
    v[k] = skeleton->surface.x[corner[2]][k] - skeleton->surface.x[corner[0]][k];
    centre[k] = skeleton->surface.x[corner[0]][k] + (u[k] + v[k]) / 3;
    mean += columns->graded[corner[k]] / 3;
  }
  cw_cross(u, v, normal);
  double h = size_at(skeleton, centre);
  double weight = cw_norm(normal) / (h * h * h) * cw_orbit_face_copies(&skeleton->orbits, face);
  double flat = cw_column_height_flat(&columns->layers[face], columns->heights->layer_count, h);
  *(Taken *)out = (Taken){weight * mean, weight * flat};
  return CW_OK;
}

CwStatus cw_column_heights_share(const CwColumnHeights *heights, const CwSkeleton *skeleton, const CwIncident *around,
                                 const CwLayerTarget *layers, double *share) {
  CwStatus status = CW_OK;
  double *graded = NULL;
  Taken *of = NULL, sum = {0};
  CW_NEW_UNSET(graded, skeleton->surface.vertex_count);
  CW_NEW_UNSET(of, skeleton->surface.triangle_count);
  memcpy(graded, heights->target, (size_t)skeleton->surface.vertex_count * sizeof *graded);
  CW_TRY(grade(skeleton, around, CW_HEIGHT_SLOPE, graded));
  Columns columns = {.skeleton = skeleton, .heights = heights, .layers = layers, .graded = graded};
  CW_TRY(cw_share("heights: volume", skeleton->surface.triangle_count, sizeof *of, find_taken, &columns, of));
  for (int32_t t = 0; t < skeleton->surface.triangle_count; t++) {
    sum.taken += of[t].taken;
    sum.flat += of[t].flat;
  }
  *share = sum.flat > 0 ? sum.taken / sum.flat : 1;
done:
  free(graded);
  free(of);
  return status;
}

void cw_column_heights_free(CwColumnHeights *heights) {
  free(heights->first_height);
  free(heights->first_made);
  free(heights->growth);
  free(heights->target);
  free(heights->least);
  *heights = (CwColumnHeights){0};
}
