// SPDX-License-Identifier: AGPL-3.0-or-later
// The inner surfaces of the boundary: free curves, open patches, and the interfaces on the partition planes.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/network/plane_map.h"
#include "mesher/boundary/periodic_boundary.h"
#include "mesher/boundary/boundary_curves.h"
#include "mesher/surface/patch_task.h"

static const double BESIDE = 1e-7; // of the model's unit: where the two regions beside an interface are asked for

CwStatus cw_boundary_add_node(CwBoundary *boundary, const double x[3], int on_plane, int32_t *node) {
  CwStatus status = CW_OK;
  if (boundary->interfaces.nodes.count == boundary->interfaces.nodes.capacity) {
    int32_t capacity = 2 * boundary->interfaces.nodes.capacity;
    void *xs = realloc(boundary->interfaces.nodes.x, (size_t)capacity * sizeof *boundary->interfaces.nodes.x);
    if (xs) boundary->interfaces.nodes.x = xs;
    void *flags = realloc(boundary->interfaces.nodes.on_plane, (size_t)capacity);
    if (flags) boundary->interfaces.nodes.on_plane = flags;
    CW_REQUIRE(xs && flags, CW_ERR_MEMORY, "out of memory: %d nodes", capacity);
    boundary->interfaces.nodes.capacity = capacity;
  }
  cw_copy(x, boundary->interfaces.nodes.x[boundary->interfaces.nodes.count]);
  boundary->interfaces.nodes.on_plane[boundary->interfaces.nodes.count] = (uint8_t)on_plane;
  *node = boundary->interfaces.nodes.count++;
done:
  return status;
}

// Nodes 0 .. wall_count-1: the layer top. Corners off the wall get nodes of their own.
static CwStatus start_nodes(CwBoundary *boundary) {
  CwStatus status = CW_OK;
  const CwNetwork *network = &boundary->network;
  boundary->interfaces.nodes.capacity = boundary->surface.vertex_count + 4096;
  boundary->interfaces.nodes.count = boundary->surface.vertex_count;
  CW_NEW(boundary->interfaces.nodes.x, boundary->interfaces.nodes.capacity);
  CW_NEW(boundary->interfaces.nodes.on_plane, boundary->interfaces.nodes.capacity);
  memcpy(boundary->interfaces.nodes.x, boundary->layers.top,
         (size_t)boundary->surface.vertex_count * sizeof *boundary->interfaces.nodes.x);
  CW_NEW(boundary->interfaces.corner_node, network->corner_count);
  for (int32_t i = 0; i < network->curve_count; i++) {
    const CwCurve *curve = &network->curve[i];
    if (!curve->wall || curve->kind != CW_CURVE_CUT) continue;
    for (int32_t k = 0; k < curve->point_count; k++) boundary->interfaces.nodes.on_plane[curve->node[k]] = 1;
  }
  for (int32_t i = 0; i < network->corner_count; i++) {
    const CwCorner *corner = &network->corner[i];
    boundary->interfaces.corner_node[i] = boundary->surface.corner_vertex[i];
    if (corner->on_wall) continue;
    CW_TRY(cw_boundary_add_node(boundary, corner->x, corner->plane[0] >= 0, &boundary->interfaces.corner_node[i]));
  }
  CwPeriodicImages *images = &boundary->images;
  for (int32_t i = 0; images->symmetry && i < network->corner_count; i++) {
    if (network->corner[i].on_wall) continue;
    int32_t next = images->corner.next[i];
    CW_TRY(cw_image_link(images, boundary->interfaces.corner_node[i], boundary->interfaces.corner_node[next],
                         images->corner.turns[next]));
  }
done:
  return status;
}

// Arc length of an end of a free curve: where the layers end, or the end of the curve itself.
static double free_end(const CwBoundary *boundary, const CwCurve *curve, int end) {
  int32_t corner = curve->corner[end];
  if (boundary->surface.corner_vertex[corner] < 0) return end ? curve->fine_length[curve->fine_count - 1] : 0;
  return cw_curve_nearest(curve, boundary->interfaces.nodes.x[boundary->interfaces.corner_node[corner]]);
}

static CwStatus add_tight(CwBoundary *boundary, const double x[3]) {
  CwStatus status = CW_OK;
  void *grown = realloc(boundary->interfaces.tight,
                        (size_t)(boundary->interfaces.tight_count + 1) * sizeof *boundary->interfaces.tight);
  CW_REQUIRE(grown, CW_ERR_MEMORY, "out of memory: %d places", boundary->interfaces.tight_count);
  boundary->interfaces.tight = grown;
  memcpy(boundary->interfaces.tight[boundary->interfaces.tight_count++], x, sizeof *boundary->interfaces.tight);
done:
  return status;
}

static CwStatus divide_free_curve(CwBoundary *boundary, CwCurve *curve) {
  CwStatus status = CW_OK;
  double *place = NULL;
  double from = free_end(boundary, curve, 0), to = free_end(boundary, curve, 1);
  int closed = curve->corner[0] == curve->corner[1], on_plane = curve->kind != CW_CURVE_EDGE;
  if (closed) from = 0, to = curve->fine_length[curve->fine_count - 1];
  if (!(from < to)) {
    for (int end = 0; end < 2; end++) {
      CW_TRY(add_tight(boundary, boundary->interfaces.nodes.x[boundary->interfaces.corner_node[curve->corner[end]]]));
    }
    goto done;
  }
  CW_TRY(cw_curve_divide(boundary, curve, from, to, closed ? 3 : 1, &curve->point_count, &place));
  CW_NEW(curve->node, curve->point_count);
  CW_NEW(curve->parameter, curve->point_count);
  for (int32_t k = 0; k < curve->point_count; k++) {
    double x[3];
    cw_curve_point(&boundary->network, curve, place[k], x, curve->parameter[k]);
    if (k == 0 || k == curve->point_count - 1) {
      curve->node[k] = boundary->interfaces.corner_node[curve->corner[k > 0]];
    } else {
      CW_TRY(cw_boundary_add_node(boundary, x, on_plane, &curve->node[k]));
    }
  }
done:
  free(place);
  return status;
}

static CwStatus add_curve_node(CwBoundary *boundary, const CwCurve *curve, const double x[3], int32_t *node) {
  return cw_boundary_add_node(boundary, x, curve->kind != CW_CURVE_EDGE, node);
}

// All edges of the network on one plane. A cut of a wall, a cut of an open patch and the line with an ancestor bound
// the interface; the line with a plane below only divides it. The outline is started, and may hold another plane's.
static CwStatus plane_outline(const CwBoundary *boundary, int32_t node, CwPatchOutline *outline) {
  CwStatus status = CW_OK;
  CwPlaneMap map = cw_plane_map_of(&boundary->plan->node[node].plane);
  cw_outline_clear(outline);
  for (int32_t i = 0; i < boundary->network.curve_count; i++) {
    const CwCurve *curve = &boundary->network.curve[i];
    if (curve->plane[0] != node && curve->plane[1] != node) continue;
    int bounds = curve->kind == CW_CURVE_CUT || curve->plane[1] == node;
    int32_t previous = -1, local;
    for (int32_t k = 0; k < curve->point_count; k++) {
      double uv[2];
      const double *x = boundary->interfaces.nodes.x[curve->node[k]];
      cw_plane_uv(&map, x, uv);
      CW_TRY(cw_outline_point(outline, curve->node[k], uv, x, &local));
      if (k > 0) CW_TRY(cw_outline_edge(outline, previous, local, bounds));
      previous = local;
    }
  }
done:
  return status;
}

// The places where edges on a plane or an open patch cross: layers reach over a line of two planes, or over a cut.
static CwStatus find_crossings(CwBoundary *boundary, const CwPatchOutline *outline) {
  CwStatus status = CW_OK;
  int32_t count, (*crossing)[4] = NULL;
  CW_TRY(cw_polygons_crossings(outline->point_count, (const double(*)[2])outline->uv, outline->edge_count,
                               (const int32_t(*)[2])outline->edge, &count, &crossing));
  for (int32_t i = 0; i < count; i++) {
    for (int k = 0; k < 4; k++)
      CW_TRY(add_tight(boundary, boundary->interfaces.nodes.x[outline->node[crossing[i][k]]]));
  }
done:
  free(crossing);
  return status;
}

// The interface polygons of one plane, kept as outlines of boundary nodes. `outline`: room for that of a plane.
static CwStatus find_polygons(CwBoundary *boundary, int32_t node, CwPatchOutline *outline) {
  CwStatus status = CW_OK;
  CwPolygons polygons = {0};
  CW_TRY(plane_outline(boundary, node, outline));
  CW_TRY(find_crossings(boundary, outline));
  if (boundary->interfaces.tight_count > 0) goto done;
  CW_TRY(cw_polygons_find(outline->point_count, (const double(*)[2])outline->uv, outline->edge_count,
                          (const int32_t(*)[2])outline->edge, outline->boundary, &polygons));
  if (polygons.polygon_count == 0) goto done;
  CwInterfaceOutline *grown =
      realloc(boundary->interfaces.outline, (size_t)(boundary->interfaces.outline_count + polygons.polygon_count) *
                                                sizeof *boundary->interfaces.outline);
  CW_REQUIRE(grown, CW_ERR_MEMORY, "out of memory: %d interfaces", boundary->interfaces.outline_count);
  boundary->interfaces.outline = grown;
  for (int32_t p = 0; p < polygons.polygon_count; p++) {
    int32_t first = polygons.polygon_start[p], last = polygons.polygon_start[p + 1];
    int32_t start = polygons.loop_start[first], end = polygons.loop_start[last];
    CwInterfaceOutline *made = &boundary->interfaces.outline[boundary->interfaces.outline_count++];
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

static CwStatus find_crossings_on_open_patches(CwBoundary *boundary) {
  CwStatus status = CW_OK;
  CwPatchOutline outline = {0};
  const CwSymmetry *symmetry = boundary->images.symmetry;
  for (int32_t face = 0; face < cw_cad_face_count(boundary->cad); face++) {
    if (cw_face_is_wall(boundary->cad, face) || (symmetry && symmetry->face.first[face] != face)) continue;
    CW_TRY(cw_boundary_open_patch_outline(boundary, face, &outline));
    CW_TRY(find_crossings(boundary, &outline));
    cw_outline_free(&outline);
  }
done:
  cw_outline_free(&outline);
  return status;
}

CwStatus cw_boundary_free_curves(CwBoundary *boundary, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwPatchOutline outline = {0};
  CW_TRY(start_nodes(boundary));
  for (int32_t i = 0; i < boundary->network.curve_count; i++) {
    const CwPeriodicImages *images = &boundary->images;
    if (boundary->network.curve[i].wall || cw_image_turns(images, &images->curve, i) > 0) continue;
    CW_TRY(divide_free_curve(boundary, &boundary->network.curve[i]));
    if (boundary->interfaces.tight_count > 0) continue;
    CW_TRY(cw_image_copy_curve(boundary, i, boundary->interfaces.corner_node, &boundary->interfaces.nodes.x,
                               add_curve_node));
  }
  if (boundary->interfaces.tight_count > 0) goto done; // not all curves are divided
  CW_TRY(cw_outline_start(&outline, boundary->interfaces.nodes.count));
  for (int32_t node = 0; node < boundary->plan->node_count; node++) CW_TRY(find_polygons(boundary, node, &outline));
  if (boundary->interfaces.tight_count == 0) CW_TRY(find_crossings_on_open_patches(boundary));
  if (boundary->interfaces.tight_count == 0 && boundary->images.symmetry) CW_TRY(cw_image_outlines(boundary, outcome));
done:
  if (status == CW_OK && boundary->interfaces.tight_count > 0) {
    cw_outcome_set(outcome, CW_OUTCOME_THIN, boundary->interfaces.tight[0],
                   "the layers fill a line of two partition planes, or cross it or a cut on an open patch");
  }
  cw_outline_free(&outline);
  return status;
}

CwStatus cw_boundary_interface_outline(const CwBoundary *boundary, const CwInterfaceOutline *interface,
                                       const CwPlaneMap *map, CwPatchOutline *outline) {
  CwStatus status = CW_OK;
  CW_TRY(cw_outline_start(outline, boundary->interfaces.nodes.count));
  for (int32_t l = 0; l < interface->loop_count; l++) {
    int32_t first = interface->loop_start[l], count = interface->loop_start[l + 1] - first;
    for (int32_t k = 0; k < count; k++) {
      int32_t local[2];
      for (int end = 0; end < 2; end++) {
        int32_t node = interface->corner[first + (k + end) % count];
        double uv[2];
        cw_plane_uv(map, boundary->interfaces.nodes.x[node], uv);
        CW_TRY(cw_outline_point(outline, node, uv, boundary->interfaces.nodes.x[node], &local[end]));
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

CwStatus cw_boundary_mesh_interface(const CwBoundary *boundary, int32_t index, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  CwPatchOutline outline = {0};
  const CwInterfaceOutline *interface = &boundary->interfaces.outline[index];
  CwPlaneMap map = cw_plane_map_of(&boundary->plan->node[interface->node].plane);
  Sides sides = {boundary->plan, map.axis[2]};
  char name[64];
  snprintf(name, sizeof name, "interface %d on partition plane %d", index, interface->node);
  CW_TRY(cw_boundary_interface_outline(boundary, interface, &map, &outline));
  CW_TRY(cw_patch_task(&outline, cw_plane_map, &map, boundary->size_at, boundary->size, 0, 0, sides_at, &sides, name,
                       bytes, size));
done:
  cw_outline_free(&outline);
  return status;
}

// Appends a packed patch, turned: its new points as nodes, its triangles at triangle[count...].
static CwStatus append(CwBoundary *boundary, const CwPatchBlock *block, int on_plane, int32_t turns, int32_t copies,
                       int32_t (*triangle)[3]) {
  CwStatus status = CW_OK;
  CwPeriodicImages *images = &boundary->images;
  int32_t first = boundary->interfaces.nodes.count, node;
  for (int32_t i = 0; i < block->point_count; i++) {
    double x[3];
    cw_image_point(images, turns, block->x[i], x);
    CW_TRY(cw_boundary_add_node(boundary, x, on_plane, &node));
    if (turns > 0) CW_TRY(cw_image_link(images, node - block->point_count, node, turns));
    if (turns > 0 && turns == copies - 1) {
      CW_TRY(cw_image_link(images, node, node - turns * block->point_count, 0));
    }
  }
  for (int32_t t = 0; t < block->triangle_count; t++) {
    for (int k = 0; k < 3; k++) {
      int32_t local = block->triangle[t][k];
      triangle[t][k] = local < block->outline_points ? cw_image_node(images, block->outline_node[local], turns)
                                                     : first + local - block->outline_points;
    }
  }
done:
  return status;
}

static CwStatus merge_open_patch(CwBoundary *boundary, int32_t face, const CwPatchBlock *block) {
  CwStatus status = CW_OK;
  int32_t copies = cw_image_face_copies(&boundary->images, face);
  for (int32_t turns = 0; turns < copies; turns++) {
    CW_TRY(append(boundary, block, 0, turns, copies,
                  boundary->interfaces.open_patch.triangle + boundary->interfaces.open_patch.count));
    for (int32_t t = 0; t < block->triangle_count; t++) {
      boundary->interfaces.open_patch.face[boundary->interfaces.open_patch.count] =
          cw_image_face(&boundary->images, face, turns);
      boundary->interfaces.open_patch.region[boundary->interfaces.open_patch.count++] =
          cw_image_region(&boundary->images, boundary->plan, block->label[t], turns);
    }
  }
done:
  return status;
}

static CwStatus merge_interface(CwBoundary *boundary, int32_t index, const CwPatchBlock *block) {
  CwStatus status = CW_OK;
  CwPeriodicImages *images = &boundary->images;
  int32_t copies = cw_image_copies(images, &images->outline, index), regions = boundary->plan->region_count;
  for (int32_t turns = 0, copy = index; turns < copies; turns++) {
    CwInterfaceOutline *interface = &boundary->interfaces.outline[copy];
    interface->free_start = boundary->interfaces.nodes.count;
    interface->free_count = block->point_count;
    interface->triangle_start = boundary->interfaces.refined.count;
    interface->triangle_count = block->triangle_count;
    CW_TRY(append(boundary, block, 1, turns, copies,
                  boundary->interfaces.refined.triangle + boundary->interfaces.refined.count));
    for (int32_t t = 0; t < block->triangle_count; t++) {
      int32_t *region = boundary->interfaces.refined.region[boundary->interfaces.refined.count++];
      region[0] = cw_image_region(images, boundary->plan, block->label[t] / regions, turns);
      region[1] = cw_image_region(images, boundary->plan, block->label[t] % regions, turns);
    }
    if (copies > 1) copy = images->outline.next[copy];
  }
done:
  return status;
}

CwStatus cw_boundary_merge_inner(CwBoundary *boundary, void *const *open_patch_bytes, void *const *interface_bytes) {
  CwStatus status = CW_OK;
  CwPatchBlock block;
  const CwPeriodicImages *images = &boundary->images;
  int32_t faces = cw_cad_face_count(boundary->cad), open_patches = 0, interfaces = 0;
  for (int32_t f = 0; f < faces; f++) {
    if (!open_patch_bytes[f]) continue;
    cw_patch_block(open_patch_bytes[f], &block);
    open_patches += block.triangle_count * cw_image_face_copies(images, f);
  }
  for (int32_t i = 0; i < boundary->interfaces.outline_count; i++) {
    if (!interface_bytes[i]) continue;
    cw_patch_block(interface_bytes[i], &block);
    interfaces += block.triangle_count * cw_image_copies(images, &images->outline, i);
  }
  CW_NEW(boundary->interfaces.open_patch.triangle, open_patches);
  CW_NEW(boundary->interfaces.open_patch.face, open_patches);
  CW_NEW(boundary->interfaces.open_patch.region, open_patches);
  CW_NEW(boundary->interfaces.refined.triangle, interfaces);
  CW_NEW(boundary->interfaces.refined.region, interfaces);
  for (int32_t f = 0; f < faces; f++) {
    if (!open_patch_bytes[f]) continue;
    cw_patch_block(open_patch_bytes[f], &block);
    CW_TRY(merge_open_patch(boundary, f, &block));
  }
  for (int32_t i = 0; i < boundary->interfaces.outline_count; i++) {
    if (!interface_bytes[i]) continue;
    cw_patch_block(interface_bytes[i], &block);
    CW_TRY(merge_interface(boundary, i, &block));
  }
done:
  return status;
}
