// SPDX-License-Identifier: AGPL-3.0-or-later
// The interfaces of the boundary: free curves, open patches, and the triangles on the partition planes.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/boundary/boundary_curves.h"
#include "mesher/boundary/periodic_boundary.h"
#include "mesher/network/plane_map.h"
#include "mesher/surface/patch_task.h"

static const double BESIDE = 1e-7; // of the model's unit: where the two regions beside an interface are asked for

// The first nodes are those of the layer top, one for each vertex of the wall. Corners off the wall get nodes of their
// own.
static CwStatus start_nodes(const CwBoundaryInput *in, const CwWallCurves *curves, const CwSurfaceMesh *surface,
                            const CwLayers *layers, CwFreeCurves *free_curves) {
  CwStatus status = CW_OK;
  const CwNetwork *network = in->network;
  free_curves->nodes.x_capacity = free_curves->nodes.plane_capacity = surface->vertex_count + 4096;
  free_curves->nodes.count = surface->vertex_count;
  CW_NEW(free_curves->nodes.x, free_curves->nodes.x_capacity);
  CW_NEW(free_curves->nodes.on_plane, free_curves->nodes.plane_capacity);
  memcpy(free_curves->nodes.x, layers->top, (size_t)surface->vertex_count * sizeof *free_curves->nodes.x);
  free_curves->corner_count = network->corner_count;
  CW_NEW(free_curves->corner_node, network->corner_count);
  for (int32_t i = 0; i < network->curve_count; i++) {
    const CwCurve *curve = &network->curve[i];
    if (!curve->wall || curve->kind != CW_CURVE_CUT) continue;
    const CwCurveNodes *nodes = &curves->curve[i];
    for (int32_t k = 0; k < nodes->count; k++) free_curves->nodes.on_plane[nodes->node[k]] = 1;
  }
  for (int32_t i = 0; i < network->corner_count; i++) {
    const CwCorner *corner = &network->corner[i];
    free_curves->corner_node[i] = curves->corner_vertex[i];
    if (corner->on_wall) continue;
    CW_TRY(cw_node_table_add(&free_curves->nodes, corner->x, corner->plane[0] >= 0, &free_curves->corner_node[i]));
  }
  const CwPeriodicImages *images = in->images;
  CW_TRY(cw_node_images_copy(&surface->images, &free_curves->images));
  for (int32_t i = 0; images->symmetry && i < network->corner_count; i++) {
    if (network->corner[i].on_wall) continue;
    int32_t next = images->corner.next[i];
    CW_TRY(cw_image_link(&free_curves->images, free_curves->corner_node[i], free_curves->corner_node[next],
                         images->corner.turns[next]));
  }
done:
  return status;
}

// Arc length of an end of a free curve: where the layers end, or the end of the curve itself.
static double free_end(const CwWallCurves *curves, const CwFreeCurves *free_curves, const CwCurve *curve, int end) {
  int32_t corner = curve->corner[end];
  if (curves->corner_vertex[corner] < 0) return end ? curve->fine_length[curve->fine_count - 1] : 0;
  return cw_curve_nearest(curve, free_curves->nodes.x[free_curves->corner_node[corner]]);
}

static CwStatus add_tight(CwFreeCurves *free_curves, const double x[3]) {
  CwStatus status = CW_OK;
  CW_GROW(free_curves->tight, free_curves->tight_capacity, free_curves->tight_count + 1);
  memcpy(free_curves->tight[free_curves->tight_count++], x, sizeof *free_curves->tight);
done:
  return status;
}

// Divides the free curve `first`, and its periodic images alike.
static CwStatus divide_free_curve(const CwBoundaryInput *in, const CwWallCurves *curves, int32_t first,
                                  CwFreeCurves *free_curves) {
  CwStatus status = CW_OK;
  const CwPeriodicImages *images = in->images;
  const CwCurve *curve = &in->network->curve[first];
  double *place = NULL;
  double from = free_end(curves, free_curves, curve, 0), to = free_end(curves, free_curves, curve, 1);
  int closed = curve->corner[0] == curve->corner[1], on_plane = curve->kind != CW_CURVE_EDGE;
  int32_t count, copies = cw_image_copies(images, &images->curve, first), index = first;
  if (closed) from = 0, to = curve->fine_length[curve->fine_count - 1];
  if (!(from < to)) {
    for (int end = 0; end < 2; end++) {
      CW_TRY(add_tight(free_curves, free_curves->nodes.x[free_curves->corner_node[curve->corner[end]]]));
    }
    goto done;
  }
  CW_TRY(cw_curve_divide(in, curve, from, to, closed ? 3 : 1, &count, &place));
  for (int32_t turns = 0; turns < copies; turns++) {
    CwCurveNodes *nodes = &free_curves->curve[index];
    CW_TRY(cw_curve_nodes_make(count, nodes));
    for (int32_t k = 0; k < count; k++) {
      double x[3];
      cw_curve_point(in->network, curve, place[k], x, nodes->parameter[k]);
      if (k == 0 || k == count - 1) {
        nodes->node[k] = free_curves->corner_node[in->network->curve[index].corner[k > 0]];
        continue;
      }
      cw_image_point(images, turns, x, x);
      CW_TRY(cw_node_table_add(&free_curves->nodes, x, on_plane, &nodes->node[k]));
    }
    if (copies > 1) index = images->curve.next[index];
  }
  CW_TRY(cw_image_link_curves(images, first, free_curves->curve, &free_curves->images));
done:
  free(place);
  return status;
}

// All edges of the network on one plane. A cut of a wall, a cut of an open patch and the line with an ancestor bound
// the interface; the line with a plane below only divides it. The outline is started, and may hold another plane's.
static CwStatus plane_outline(const CwBoundaryInput *in, const CwWallCurves *curves, const CwFreeCurves *free_curves,
                              int32_t node, CwPatchOutline *outline) {
  CwStatus status = CW_OK;
  CwPlaneMap map = cw_plane_map_of(&in->plan->node[node].plane);
  cw_outline_clear(outline);
  for (int32_t i = 0; i < in->network->curve_count; i++) {
    const CwCurve *curve = &in->network->curve[i];
    if (curve->plane[0] != node && curve->plane[1] != node) continue;
    int bounds = curve->kind == CW_CURVE_CUT || curve->plane[1] == node;
    const CwCurveNodes *nodes = curve->wall ? &curves->curve[i] : &free_curves->curve[i];
    int32_t previous = -1;
    for (int32_t k = 0; k < nodes->count; k++) {
      double uv[2];
      const double *x = free_curves->nodes.x[nodes->node[k]];
      cw_plane_uv(&map, x, uv);
      CW_TRY(cw_outline_next(outline, nodes->node[k], uv, x, bounds, &previous));
    }
  }
done:
  return status;
}

// The places where edges on a plane or an open patch cross: layers reach over a line of two planes, or over a cut.
static CwStatus find_crossings(CwFreeCurves *free_curves, const CwPatchOutline *outline) {
  CwStatus status = CW_OK;
  int32_t count, (*crossing)[4] = NULL;
  CW_TRY(cw_polygons_crossings(outline->point_count, (const double(*)[2])outline->uv, outline->edge_count,
                               (const int32_t(*)[2])outline->edge, &count, &crossing));
  for (int32_t i = 0; i < count; i++) {
    for (int k = 0; k < 4; k++) CW_TRY(add_tight(free_curves, free_curves->nodes.x[outline->node[crossing[i][k]]]));
  }
done:
  free(crossing);
  return status;
}

// The interface polygons of one plane, kept as outlines of boundary nodes. `outline`: room for that of a plane.
static CwStatus find_polygons(const CwBoundaryInput *in, const CwWallCurves *curves, CwFreeCurves *free_curves,
                              int32_t node, CwPatchOutline *outline) {
  CwStatus status = CW_OK;
  CwPolygons polygons = {0};
  char place[40];
  CW_TRY(plane_outline(in, curves, free_curves, node, outline));
  CW_TRY(find_crossings(free_curves, outline));
  if (free_curves->tight_count > 0) goto done;
  CwStatus found = cw_polygons_find(outline->point_count, (const double(*)[2])outline->uv, outline->edge_count,
                                    (const int32_t(*)[2])outline->edge, outline->boundary, &polygons);
  if (found == CW_ERR_MESH) {
    snprintf(place, sizeof place, "partition plane %d", node);
    cw_fail_place(place);
  }
  CW_TRY(found);
  CW_GROW(free_curves->outline, free_curves->outline_capacity, free_curves->outline_count + polygons.polygon_count);
  for (int32_t p = 0; p < polygons.polygon_count; p++) {
    int32_t first = polygons.polygon_start[p], last = polygons.polygon_start[p + 1];
    int32_t start = polygons.loop_start[first], end = polygons.loop_start[last];
    CwInterfaceOutline *made = &free_curves->outline[free_curves->outline_count++];
    *made = (CwInterfaceOutline){.node = node, .corner_count = end - start, .loop_count = last - first};
    CW_NEW(made->loop_start, last - first + 1);
    CW_NEW(made->corner, end - start);
    for (int32_t l = first; l <= last; l++) made->loop_start[l - first] = polygons.loop_start[l] - start;
    for (int32_t c = start; c < end; c++) made->corner[c - start] = outline->node[polygons.corner[c]];
  }
done:
  cw_polygons_free(&polygons);
  return status;
}

static CwStatus find_crossings_on_open_patches(const CwBoundaryInput *in, const CwWallCurves *curves,
                                               CwFreeCurves *free_curves) {
  CwStatus status = CW_OK;
  CwPatchOutline outline = {0};
  const CwSymmetry *symmetry = in->images->symmetry;
  for (int32_t face = 0; face < cw_cad_face_count(in->cad); face++) {
    if (cw_cad_face_is_wall(in->cad, face) || (symmetry && symmetry->face.first[face] != face)) continue;
    CW_TRY(cw_boundary_open_patch_outline(in, curves, free_curves, face, &outline));
    CW_TRY(find_crossings(free_curves, &outline));
    cw_outline_free(&outline);
  }
done:
  cw_outline_free(&outline);
  return status;
}

CwStatus cw_free_curves_make(const CwBoundaryInput *in, const CwWallCurves *curves, const CwSurfaceMesh *surface,
                             const CwLayers *layers, CwFreeCurves *free_curves, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwPatchOutline outline = {0};
  *free_curves = (CwFreeCurves){.curve_count = in->network->curve_count};
  CW_NEW(free_curves->curve, free_curves->curve_count);
  CW_TRY(start_nodes(in, curves, surface, layers, free_curves));
  for (int32_t i = 0; i < in->network->curve_count; i++) {
    const CwPeriodicImages *images = in->images;
    if (in->network->curve[i].wall || cw_image_turns(images, &images->curve, i) > 0) continue;
    CW_TRY(divide_free_curve(in, curves, i, free_curves));
  }
  if (free_curves->tight_count > 0) goto done; // not all curves are divided
  CW_TRY(cw_outline_start(&outline, free_curves->nodes.count));
  for (int32_t node = 0; node < in->plan->node_count; node++)
    CW_TRY(find_polygons(in, curves, free_curves, node, &outline));
  if (free_curves->tight_count == 0) CW_TRY(find_crossings_on_open_patches(in, curves, free_curves));
  if (free_curves->tight_count == 0 && in->images->symmetry) CW_TRY(cw_image_outlines(in, free_curves, outcome));
done:
  if (status == CW_OK && free_curves->tight_count > 0) {
    cw_outcome_set(outcome, CW_OUTCOME_THIN, free_curves->tight[0],
                   "the layers fill a line of two partition planes, or cross it or a cut on an open patch");
  }
  cw_outline_free(&outline);
  return status;
}

CwStatus cw_boundary_interface_outline(const CwNodeTable *nodes, const CwInterfaceOutline *interface,
                                       const CwPlaneMap *map, CwPatchOutline *outline) {
  CwStatus status = CW_OK;
  CW_TRY(cw_outline_start(outline, nodes->count));
  for (int32_t l = 0; l < interface->loop_count; l++) {
    int32_t first = interface->loop_start[l], count = interface->loop_start[l + 1] - first;
    for (int32_t k = 0; k < count; k++) {
      int32_t local[2];
      for (int end = 0; end < 2; end++) {
        int32_t node = interface->corner[first + (k + end) % count];
        double uv[2];
        cw_plane_uv(map, nodes->x[node], uv);
        CW_TRY(cw_outline_point(outline, node, uv, nodes->x[node], &local[end]));
      }
      CW_TRY(cw_outline_edge(outline, local[0], local[1], 1));
    }
  }
done:
  return status;
}

typedef struct {
  const CwPlan *plan;
  const double *normal;
} Sides;

// Label of a piece of an interface: the regions on its negative and positive side, in one number.
static int32_t sides_at(const void *context, const double x[3]) {
  const Sides *sides = context;
  double below[3], above[3];
  for (int k = 0; k < 3; k++) below[k] = x[k] - BESIDE * sides->normal[k], above[k] = x[k] + BESIDE * sides->normal[k];
  return cw_plan_locate(sides->plan, below) * sides->plan->region_count + cw_plan_locate(sides->plan, above);
}

CwStatus cw_interfaces_polygon(const CwBoundaryInput *in, const CwFreeCurves *free_curves, int32_t index, void **bytes,
                               int64_t *size) {
  CwStatus status = CW_OK;
  CwPatchOutline outline = {0};
  const CwInterfaceOutline *interface = &free_curves->outline[index];
  CwPlaneMap map = cw_plane_map_of(&in->plan->node[interface->node].plane);
  Sides sides = {in->plan, map.axis[2]};
  char name[64];
  snprintf(name, sizeof name, "interface %d on partition plane %d", index, interface->node);
  CW_TRY(cw_boundary_interface_outline(&free_curves->nodes, interface, &map, &outline));
  CW_TRY(cw_patch_task(&outline, cw_plane_map, &map, in->size_at, in->size, 0, 0, sides_at, &sides, name, bytes, size));
done:
  cw_outline_free(&outline);
  return status;
}

// Appends a packed patch, turned: its new points as nodes, its triangles at triangle[count...].
static CwStatus append(const CwBoundaryInput *in, CwInterfaces *interfaces, const CwPatchBlock *block, int on_plane,
                       int32_t turns, int32_t copies, int32_t (*triangle)[3]) {
  CwStatus status = CW_OK;
  const CwPeriodicImages *images = in->images;
  int32_t first = interfaces->nodes.count, node;
  for (int32_t i = 0; i < block->point_count; i++) {
    double x[3];
    cw_image_point(images, turns, block->x[i], x);
    CW_TRY(cw_node_table_add(&interfaces->nodes, x, on_plane, &node));
    CW_TRY(cw_image_link_copy(&interfaces->images, node, block->point_count, turns, copies));
  }
  for (int32_t t = 0; t < block->triangle_count; t++) {
    for (int k = 0; k < 3; k++) {
      int32_t local = block->triangle[t][k];
      triangle[t][k] = local < block->outline_points
                           ? cw_image_node(&interfaces->images, block->outline_node[local], turns)
                           : first + local - block->outline_points;
    }
  }
done:
  return status;
}

static CwStatus merge_open_patch(const CwBoundaryInput *in, CwInterfaces *interfaces, int32_t face,
                                 const CwPatchBlock *block) {
  CwStatus status = CW_OK;
  int32_t copies = cw_image_face_copies(in->images, face);
  for (int32_t turns = 0; turns < copies; turns++) {
    CW_TRY(append(in, interfaces, block, 0, turns, copies,
                  interfaces->open_patch.triangle + interfaces->open_patch.count));
    for (int32_t t = 0; t < block->triangle_count; t++) {
      interfaces->open_patch.face[interfaces->open_patch.count] = cw_image_face(in->images, face, turns);
      interfaces->open_patch.region[interfaces->open_patch.count++] =
          cw_image_region(in->images, in->plan, block->label[t], turns);
    }
  }
done:
  return status;
}

static CwStatus merge_interface(const CwBoundaryInput *in, CwInterfaces *interfaces, int32_t index,
                                const CwPatchBlock *block) {
  CwStatus status = CW_OK;
  const CwPeriodicImages *images = in->images;
  int32_t copies = cw_image_copies(images, &interfaces->outline_images, index), regions = in->plan->region_count;
  for (int32_t turns = 0, copy = index; turns < copies; turns++) {
    CwInterfaceOutline *interface = &interfaces->outline[copy];
    interface->free_start = interfaces->nodes.count;
    interface->free_count = block->point_count;
    interface->triangle_start = interfaces->refined.count;
    interface->triangle_count = block->triangle_count;
    CW_TRY(append(in, interfaces, block, 1, turns, copies, interfaces->refined.triangle + interfaces->refined.count));
    for (int32_t t = 0; t < block->triangle_count; t++) {
      int32_t *region = interfaces->refined.region[interfaces->refined.count++];
      region[0] = cw_image_region(images, in->plan, block->label[t] / regions, turns);
      region[1] = cw_image_region(images, in->plan, block->label[t] % regions, turns);
    }
    if (copies > 1) copy = interfaces->outline_images.next[copy];
  }
done:
  return status;
}

// Nodes and outlines go from one to the other.
static CwStatus take_over(CwFreeCurves *free_curves, CwInterfaces *interfaces) {
  CwStatus status = CW_OK;
  CW_TRY(cw_arrays_own(free_curves, cw_free_curves_arrays, &free_curves->memory));
  *interfaces = (CwInterfaces){.nodes = free_curves->nodes,
                               .images = free_curves->images,
                               .outline_count = free_curves->outline_count,
                               .outline = free_curves->outline,
                               .outline_images = free_curves->outline_images};
  free_curves->nodes = (CwNodeTable){0};
  free_curves->images = (CwNodeImages){0};
  free_curves->outline_count = 0;
  free_curves->outline = NULL;
  free_curves->outline_images = (CwImages){0};
  cw_free_curves_free(free_curves);
done:
  return status;
}

CwStatus cw_interfaces_make(const CwBoundaryInput *in, CwFreeCurves *free_curves, void *const *open_patch_bytes,
                            void *const *interface_bytes, CwInterfaces *interfaces, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwPatchBlock block;
  const CwPeriodicImages *images = in->images;
  int32_t faces = cw_cad_face_count(in->cad), open_patches = 0, on_planes = 0;
  CW_TRY(take_over(free_curves, interfaces));
  for (int32_t f = 0; f < faces; f++) {
    if (!open_patch_bytes[f]) continue;
    cw_patch_block(open_patch_bytes[f], &block);
    *outcome = block.outcome;
    if (outcome->kind != CW_OUTCOME_DONE) goto done;
    open_patches += block.triangle_count * cw_image_face_copies(images, f);
  }
  for (int32_t i = 0; i < interfaces->outline_count; i++) {
    if (!interface_bytes[i]) continue;
    cw_patch_block(interface_bytes[i], &block);
    if (block.outcome.kind != CW_OUTCOME_DONE) {
      *outcome = block.outcome;
      outcome->kind = CW_OUTCOME_REPLAN; // it lies on a plane
      goto done;
    }
    on_planes += block.triangle_count * cw_image_copies(images, &interfaces->outline_images, i);
  }
  CW_NEW(interfaces->open_patch.triangle, open_patches);
  CW_NEW(interfaces->open_patch.face, open_patches);
  CW_NEW(interfaces->open_patch.region, open_patches);
  CW_NEW(interfaces->refined.triangle, on_planes);
  CW_NEW(interfaces->refined.region, on_planes);
  for (int32_t f = 0; f < faces; f++) {
    if (!open_patch_bytes[f]) continue;
    cw_patch_block(open_patch_bytes[f], &block);
    CW_TRY(merge_open_patch(in, interfaces, f, &block));
  }
  for (int32_t i = 0; i < interfaces->outline_count; i++) {
    if (!interface_bytes[i]) continue;
    cw_patch_block(interface_bytes[i], &block);
    CW_TRY(merge_interface(in, interfaces, i, &block));
  }
done:
  return status;
}
