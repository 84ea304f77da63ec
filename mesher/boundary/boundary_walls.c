// SPDX-License-Identifier: AGPL-3.0-or-later
// Triangles on CAD faces: walls inside their curves, open patches inside what the layers leave of them.
#include <stdlib.h>
#include <string.h>

#include "mesher/boundary/boundary_curves.h"
#include "mesher/common/incident.h"
#include "mesher/common/vec.h"
#include "mesher/parallel/parallel_for.h"
#include "mesher/surface/patch_task.h"

static const double ON_PLANE = 1e-8; // of the model's unit

// The outline of a wall face: CAD edges first, so that their ends get the (u,v) of the edges, then the cuts.
static CwStatus wall_outline(const CwBoundaryInput *in, const CwWallCurves *curves, int32_t face,
                             CwPatchOutline *outline) {
  CwStatus status = CW_OK;
  CW_TRY(cw_outline_start(outline, curves->vertex_count));
  for (int pass = 0; pass < 2; pass++) {
    CwCurveKind kind = pass == 0 ? CW_CURVE_EDGE : CW_CURVE_CUT;
    for (int32_t i = 0; i < in->network->curve_count; i++) {
      const CwCurve *curve = &in->network->curve[i];
      if (curve->kind != kind || !curve->wall || (curve->face[0] != face && curve->face[1] != face)) continue;
      const CwCurveNodes *nodes = &curves->curve[i];
      int32_t previous = -1;
      for (int32_t k = 0; k < nodes->count; k++) {
        double uv[2];
        int32_t v = nodes->node[k];
        cw_curve_uv(in->cad, curve, nodes->parameter[k], face, uv);
        CW_TRY(cw_outline_next(outline, v, uv, curves->x[v], kind == CW_CURVE_EDGE, &previous));
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
static CwStatus mesh_face(const CwBoundaryInput *in, int32_t face, const CwPatchOutline *outline, double largest,
                          void **bytes, int64_t *size) {
  FaceMap map = {in->cad, face};
  return cw_patch_task(outline, face_map, &map, in->size_at, in->size, largest, cw_cad_face_reversed(in->cad, face),
                       region_at, in->plan, cw_cad_face_name(in->cad, face), bytes, size);
}

CwStatus cw_surface_mesh_face(const CwBoundaryInput *in, const CwWallCurves *curves, int32_t face, double largest,
                              void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  CwPatchOutline outline = {0};
  CW_TRY(wall_outline(in, curves, face, &outline));
  CW_TRY(mesh_face(in, face, &outline, largest, bytes, size));
done:
  cw_outline_free(&outline);
  return status;
}

// A surface mesh that is being made.
typedef struct {
  const CwBoundaryInput *in;
  CwSurfaceMesh *surface;
} Made;

// No triangle may reach over a partition plane: then a cut curve is missing. Periodic images are as their first.
static CwStatus check_triangle(void *context, int32_t t, void *out) {
  const Made *made = context;
  const CwBoundaryInput *in = made->in;
  const CwSurfaceMesh *surface = made->surface;
  *(uint8_t *)out = 1;
  for (int k = 0; surface->source[t] == t && k < 3; k++) {
    const double *x = surface->x[surface->triangle[t][k]];
    if (!cw_plan_in_region(in->plan, surface->region[t], x, ON_PLANE)) *(uint8_t *)out = 0;
  }
  return CW_OK;
}

static CwStatus check_regions(const CwContext *context, Made *made, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  const CwSurfaceMesh *surface = made->surface;
  uint8_t *checked = NULL;
  CW_NEW(checked, made->surface->triangle_count);
  CW_TRY(cw_parallel_for(context, "walls checked", made->surface->triangle_count, 1, check_triangle, made, checked));
  for (int32_t t = 0; t < surface->triangle_count; t++) {
    CW_END_UNLESS(checked[t], outcome, CW_OUTCOME_REPLAN, surface->x[surface->triangle[t][0]],
                  "a triangle of face %s reaches out of region %d: a cut curve is missing",
                  cw_cad_face_name(made->in->cad, surface->face[t]), surface->region[t] + 1);
  }
done:
  free(checked);
  return status;
}

// Appends the triangles of a copy of a face, whose points have the numbers `vertex`.
static void append_triangles(const CwBoundaryInput *in, CwSurfaceMesh *surface, int32_t face, int32_t turns,
                             int32_t source, const CwPatchBlock *block, const int32_t *vertex) {
  const CwPeriodicImages *images = in->images;
  int32_t on = cw_image_face(images, face, turns), label = -1, region = -1;
  for (int32_t t = 0; t < block->triangle_count; t++) {
    int32_t at = surface->triangle_count++;
    if (block->label[t] != label) { // those of one region mostly follow one another
      label = block->label[t];
      region = cw_image_region(images, in->plan, label, turns);
    }
    for (int k = 0; k < 3; k++) surface->triangle[at][k] = vertex[block->triangle[t][k]];
    surface->face[at] = on;
    surface->source[at] = source + t;
    surface->region[at] = region;
  }
}

// Appends the mesh of a face for itself and its periodic images.
static CwStatus merge_wall(const CwBoundaryInput *in, int32_t face, const CwPatchBlock *block, CwSurfaceMesh *surface) {
  CwStatus status = CW_OK;
  const CwPeriodicImages *images = in->images;
  int32_t copies = cw_image_face_copies(images, face);
  int32_t source = surface->triangle_count, *vertex = NULL;
  CW_NEW(vertex, block->outline_points + block->point_count);
  for (int32_t turns = 0; turns < copies; turns++) {
    for (int32_t i = 0; i < block->outline_points; i++) {
      vertex[i] = cw_image_node(&surface->images, block->outline_node[i], turns);
    }
    for (int32_t i = 0; i < block->point_count; i++) {
      int32_t *made = &vertex[block->outline_points + i];
      double x[3];
      cw_image_point(images, turns, block->x[i], x);
      *made = surface->vertex_count++;
      cw_copy(x, surface->x[*made]);
      surface->constraint[*made] = (CwConstraint){CW_CONSTRAINT_NONE, -1};
      CW_TRY(cw_image_link_copy(&surface->images, *made, block->point_count, turns, copies));
    }
    append_triangles(in, surface, face, turns, source, block, vertex);
  }
done:
  free(vertex);
  return status;
}

// Lists the wall triangles by region.
static CwStatus list_regions(CwSurfaceMesh *surface, int32_t regions) {
  CwStatus status = CW_OK;
  surface->region_count = regions;
  CW_NEW(surface->region_start, regions + 1);
  CW_NEW(surface->region_triangle, surface->triangle_count);
  cw_list_by_group(surface->triangle_count, surface->region, regions, surface->region_start, surface->region_triangle);
done:
  return status;
}

// Room for all vertices and triangles; the vertices of the wall curves come first.
static CwStatus start_surface(const CwWallCurves *curves, int32_t vertices, int32_t triangles, CwSurfaceMesh *surface) {
  CwStatus status = CW_OK;
  CW_NEW_UNSET(surface->x, vertices);
  CW_NEW_UNSET(surface->constraint, vertices);
  memcpy(surface->x, curves->x, (size_t)curves->vertex_count * sizeof *surface->x);
  memcpy(surface->constraint, curves->constraint, (size_t)curves->vertex_count * sizeof *surface->constraint);
  surface->vertex_count = curves->vertex_count;
  CW_TRY(cw_node_images_copy(&curves->images, &surface->images));
  CW_NEW(surface->triangle, triangles);
  CW_NEW(surface->face, triangles);
  CW_NEW(surface->region, triangles);
  CW_NEW(surface->source, triangles);
done:
  return status;
}

CwStatus cw_surface_mesh_make(const CwContext *context, const CwBoundaryInput *in, const CwWallCurves *curves,
                              void *const *bytes, CwSurfaceMesh *surface, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  int32_t faces = cw_cad_face_count(in->cad), total = 0, vertices = curves->vertex_count;
  CwPatchBlock block;
  *surface = (CwSurfaceMesh){0};
  for (int32_t f = 0; f < faces; f++) {
    if (!bytes[f]) continue;
    int32_t copies = cw_image_face_copies(in->images, f);
    cw_patch_block(bytes[f], &block);
    *outcome = block.outcome;
    if (outcome->kind != CW_OUTCOME_DONE) goto done;
    total += block.triangle_count * copies;
    vertices += block.point_count * copies;
  }
  CW_TRY(start_surface(curves, vertices, total, surface));
  for (int32_t f = 0; f < faces; f++) {
    if (!bytes[f]) continue;
    cw_patch_block(bytes[f], &block);
    CW_TRY(merge_wall(in, f, &block, surface));
  }
  CW_TRY_STAGE(check_regions(context, &(Made){in, surface}, outcome), outcome);
  CW_TRY(list_regions(surface, in->plan->region_count));
done:
  return status;
}

// Of layer top nodes: the (u,v) of the wall curve is the start of the search for theirs.
CwStatus cw_boundary_open_patch_outline(const CwBoundaryInput *in, const CwWallCurves *curves,
                                        const CwFreeCurves *free_curves, int32_t face, CwPatchOutline *outline) {
  CwStatus status = CW_OK;
  CW_TRY(cw_outline_start(outline, free_curves->nodes.count));
  for (int32_t i = 0; i < in->network->curve_count; i++) {
    const CwCurve *curve = &in->network->curve[i];
    if (curve->kind == CW_CURVE_LINE || (curve->face[0] != face && curve->face[1] != face)) continue;
    const CwCurveNodes *nodes = curve->wall ? &curves->curve[i] : &free_curves->curve[i];
    int32_t previous = -1;
    for (int32_t k = 0; k < nodes->count; k++) {
      double uv[2];
      const double *x = free_curves->nodes.x[nodes->node[k]];
      cw_curve_uv(in->cad, curve, nodes->parameter[k], face, uv);
      cw_cad_face_project(in->cad, face, x, uv);
      CW_TRY(cw_outline_next(outline, nodes->node[k], uv, x, curve->kind == CW_CURVE_EDGE, &previous));
    }
  }
done:
  return status;
}

CwStatus cw_interfaces_open_patch(const CwBoundaryInput *in, const CwWallCurves *curves,
                                  const CwFreeCurves *free_curves, int32_t face, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  CwPatchOutline outline = {0};
  CW_TRY(cw_boundary_open_patch_outline(in, curves, free_curves, face, &outline));
  CW_TRY(mesh_face(in, face, &outline, 0, bytes, size));
done:
  cw_outline_free(&outline);
  return status;
}
