// SPDX-License-Identifier: AGPL-3.0-or-later
// The inner surfaces of the skeleton: free curves, caps, and the interfaces on the dividing planes.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/network/plane_map.h"
#include "mesher/skeleton/orbit_skeleton.h"
#include "mesher/skeleton/skeleton_curves.h"
#include "mesher/surface/patch_task.h"

static const double BESIDE = 1e-7; // of the model's unit: where the two regions beside an interface are asked for

CwStatus cw_skeleton_add_node(CwSkeleton *skeleton, const double x[3], int on_plane, int32_t *node) {
  CwStatus status = CW_OK;
  if (skeleton->interfaces.nodes.count == skeleton->interfaces.nodes.capacity) {
    int32_t capacity = 2 * skeleton->interfaces.nodes.capacity;
    void *xs = realloc(skeleton->interfaces.nodes.x, (size_t)capacity * sizeof *skeleton->interfaces.nodes.x);
    if (xs) skeleton->interfaces.nodes.x = xs;
    void *flags = realloc(skeleton->interfaces.nodes.on_plane, (size_t)capacity);
    if (flags) skeleton->interfaces.nodes.on_plane = flags;
    CW_REQUIRE(xs && flags, CW_ERR_MEMORY, "out of memory: %d nodes", capacity);
    skeleton->interfaces.nodes.capacity = capacity;
  }
  cw_copy(x, skeleton->interfaces.nodes.x[skeleton->interfaces.nodes.count]);
  skeleton->interfaces.nodes.on_plane[skeleton->interfaces.nodes.count] = (uint8_t)on_plane;
  *node = skeleton->interfaces.nodes.count++;
done:
  return status;
}

// Nodes 0 .. wall_count-1: the front. Corners off the wall get nodes of their own.
static CwStatus start_nodes(CwSkeleton *skeleton) {
  CwStatus status = CW_OK;
  const CwNetwork *network = &skeleton->network;
  skeleton->interfaces.nodes.capacity = skeleton->surface.vertex_count + 4096;
  skeleton->interfaces.nodes.count = skeleton->surface.vertex_count;
  CW_NEW(skeleton->interfaces.nodes.x, skeleton->interfaces.nodes.capacity);
  CW_NEW(skeleton->interfaces.nodes.on_plane, skeleton->interfaces.nodes.capacity);
  memcpy(skeleton->interfaces.nodes.x, skeleton->layers.front,
         (size_t)skeleton->surface.vertex_count * sizeof *skeleton->interfaces.nodes.x);
  CW_NEW(skeleton->interfaces.corner_node, network->corner_count);
  for (int32_t i = 0; i < network->curve_count; i++) {
    const CwCurve *curve = &network->curve[i];
    if (!curve->wall || curve->kind != CW_CURVE_CUT) continue;
    for (int32_t k = 0; k < curve->point_count; k++) skeleton->interfaces.nodes.on_plane[curve->node[k]] = 1;
  }
  for (int32_t i = 0; i < network->corner_count; i++) {
    const CwCorner *corner = &network->corner[i];
    skeleton->interfaces.corner_node[i] = skeleton->surface.corner_vertex[i];
    if (corner->on_wall) continue;
    CW_TRY(cw_skeleton_add_node(skeleton, corner->x, corner->plane[0] >= 0, &skeleton->interfaces.corner_node[i]));
  }
  CwSkeletonOrbits *orbits = &skeleton->orbits;
  for (int32_t i = 0; orbits->symmetry && i < network->corner_count; i++) {
    if (network->corner[i].on_wall) continue;
    int32_t next = orbits->corner.next[i];
    CW_TRY(cw_orbit_link(orbits, skeleton->interfaces.corner_node[i], skeleton->interfaces.corner_node[next],
                         orbits->corner.turns[next]));
  }
done:
  return status;
}

// Arc length of an end of a free curve: where the layers end, or the end of the curve itself.
static double free_end(const CwSkeleton *skeleton, const CwCurve *curve, int end) {
  int32_t corner = curve->corner[end];
  if (skeleton->surface.corner_vertex[corner] < 0) return end ? curve->fine_length[curve->fine_count - 1] : 0;
  return cw_curve_nearest(curve, skeleton->interfaces.nodes.x[skeleton->interfaces.corner_node[corner]]);
}

static CwStatus add_tight(CwSkeleton *skeleton, const double x[3]) {
  CwStatus status = CW_OK;
  void *grown = realloc(skeleton->interfaces.tight,
                        (size_t)(skeleton->interfaces.tight_count + 1) * sizeof *skeleton->interfaces.tight);
  CW_REQUIRE(grown, CW_ERR_MEMORY, "out of memory: %d places", skeleton->interfaces.tight_count);
  skeleton->interfaces.tight = grown;
  memcpy(skeleton->interfaces.tight[skeleton->interfaces.tight_count++], x, sizeof *skeleton->interfaces.tight);
done:
  return status;
}

static CwStatus divide_free_curve(CwSkeleton *skeleton, CwCurve *curve) {
  CwStatus status = CW_OK;
  double *place = NULL;
  double from = free_end(skeleton, curve, 0), to = free_end(skeleton, curve, 1);
  int closed = curve->corner[0] == curve->corner[1], on_plane = curve->kind != CW_CURVE_EDGE;
  if (closed) from = 0, to = curve->fine_length[curve->fine_count - 1];
  if (!(from < to)) {
    for (int end = 0; end < 2; end++) {
      CW_TRY(add_tight(skeleton, skeleton->interfaces.nodes.x[skeleton->interfaces.corner_node[curve->corner[end]]]));
    }
    goto done;
  }
  CW_TRY(cw_curve_divide(skeleton, curve, from, to, closed ? 3 : 1, &curve->point_count, &place));
  CW_NEW(curve->node, curve->point_count);
  CW_NEW(curve->parameter, curve->point_count);
  for (int32_t k = 0; k < curve->point_count; k++) {
    double x[3];
    cw_curve_point(&skeleton->network, curve, place[k], x, curve->parameter[k]);
    if (k == 0 || k == curve->point_count - 1) {
      curve->node[k] = skeleton->interfaces.corner_node[curve->corner[k > 0]];
    } else {
      CW_TRY(cw_skeleton_add_node(skeleton, x, on_plane, &curve->node[k]));
    }
  }
done:
  free(place);
  return status;
}

static CwStatus add_curve_node(CwSkeleton *skeleton, const CwCurve *curve, const double x[3], int32_t *node) {
  return cw_skeleton_add_node(skeleton, x, curve->kind != CW_CURVE_EDGE, node);
}

// All edges of the network on one plane. A wall cut, a cap cut and the line with an ancestor bound the interface; the
// line with a plane below only divides it. The outline is started, and may hold another plane's.
static CwStatus plane_outline(const CwSkeleton *skeleton, int32_t node, CwPatchOutline *outline) {
  CwStatus status = CW_OK;
  CwPlaneMap map = cw_plane_map_of(&skeleton->plan->node[node].plane);
  cw_outline_clear(outline);
  for (int32_t i = 0; i < skeleton->network.curve_count; i++) {
    const CwCurve *curve = &skeleton->network.curve[i];
    if (curve->plane[0] != node && curve->plane[1] != node) continue;
    int bounds = curve->kind == CW_CURVE_CUT || curve->plane[1] == node;
    int32_t previous = -1, local;
    for (int32_t k = 0; k < curve->point_count; k++) {
      double uv[2];
      const double *x = skeleton->interfaces.nodes.x[curve->node[k]];
      cw_plane_uv(&map, x, uv);
      CW_TRY(cw_outline_point(outline, curve->node[k], uv, x, &local));
      if (k > 0) CW_TRY(cw_outline_edge(outline, previous, local, bounds));
      previous = local;
    }
  }
done:
  return status;
}

// The places where edges on a plane or a cap cross: layers reach over a line of two planes, or over a cut.
static CwStatus find_crossings(CwSkeleton *skeleton, const CwPatchOutline *outline) {
  CwStatus status = CW_OK;
  int32_t count, (*crossing)[4] = NULL;
  CW_TRY(cw_polygons_crossings(outline->point_count, (const double(*)[2])outline->uv, outline->edge_count,
                               (const int32_t(*)[2])outline->edge, &count, &crossing));
  for (int32_t i = 0; i < count; i++) {
    for (int k = 0; k < 4; k++)
      CW_TRY(add_tight(skeleton, skeleton->interfaces.nodes.x[outline->node[crossing[i][k]]]));
  }
done:
  free(crossing);
  return status;
}

// The interface polygons of one plane, kept as outlines of skeleton nodes. `outline`: room for that of a plane.
static CwStatus find_polygons(CwSkeleton *skeleton, int32_t node, CwPatchOutline *outline) {
  CwStatus status = CW_OK;
  CwPolygons polygons = {0};
  CW_TRY(plane_outline(skeleton, node, outline));
  CW_TRY(find_crossings(skeleton, outline));
  if (skeleton->interfaces.tight_count > 0) goto done;
  CW_TRY(cw_polygons_find(outline->point_count, (const double(*)[2])outline->uv, outline->edge_count,
                          (const int32_t(*)[2])outline->edge, outline->boundary, &polygons));
  if (polygons.polygon_count == 0) goto done;
  CwInterfaceOutline *grown =
      realloc(skeleton->interfaces.outline, (size_t)(skeleton->interfaces.outline_count + polygons.polygon_count) *
                                                sizeof *skeleton->interfaces.outline);
  CW_REQUIRE(grown, CW_ERR_MEMORY, "out of memory: %d interfaces", skeleton->interfaces.outline_count);
  skeleton->interfaces.outline = grown;
  for (int32_t p = 0; p < polygons.polygon_count; p++) {
    int32_t first = polygons.polygon_start[p], last = polygons.polygon_start[p + 1];
    int32_t start = polygons.loop_start[first], end = polygons.loop_start[last];
    CwInterfaceOutline *made = &skeleton->interfaces.outline[skeleton->interfaces.outline_count++];
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

static CwStatus find_crossings_on_caps(CwSkeleton *skeleton) {
  CwStatus status = CW_OK;
  CwPatchOutline outline = {0};
  const CwSymmetry *symmetry = skeleton->orbits.symmetry;
  for (int32_t face = 0; face < cw_cad_face_count(skeleton->cad); face++) {
    if (cw_face_is_wall(skeleton->cad, face) || (symmetry && symmetry->face.first[face] != face)) continue;
    CW_TRY(cw_skeleton_cap_outline(skeleton, face, &outline));
    CW_TRY(find_crossings(skeleton, &outline));
    cw_outline_free(&outline);
  }
done:
  cw_outline_free(&outline);
  return status;
}

CwStatus cw_skeleton_free_curves(CwSkeleton *skeleton, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwPatchOutline outline = {0};
  CW_TRY(start_nodes(skeleton));
  for (int32_t i = 0; i < skeleton->network.curve_count; i++) {
    const CwSkeletonOrbits *orbits = &skeleton->orbits;
    if (skeleton->network.curve[i].wall || cw_orbit_turns(orbits, &orbits->curve, i) > 0) continue;
    CW_TRY(divide_free_curve(skeleton, &skeleton->network.curve[i]));
    if (skeleton->interfaces.tight_count > 0) continue;
    CW_TRY(cw_orbit_copy_curve(skeleton, i, skeleton->interfaces.corner_node, &skeleton->interfaces.nodes.x,
                               add_curve_node));
  }
  if (skeleton->interfaces.tight_count > 0) goto done; // not all curves are divided
  CW_TRY(cw_outline_start(&outline, skeleton->interfaces.nodes.count));
  for (int32_t node = 0; node < skeleton->plan->node_count; node++) CW_TRY(find_polygons(skeleton, node, &outline));
  if (skeleton->interfaces.tight_count == 0) CW_TRY(find_crossings_on_caps(skeleton));
  if (skeleton->interfaces.tight_count == 0 && skeleton->orbits.symmetry) CW_TRY(cw_orbit_outlines(skeleton, outcome));
done:
  if (status == CW_OK && skeleton->interfaces.tight_count > 0) {
    cw_outcome_set(outcome, CW_OUTCOME_THIN, skeleton->interfaces.tight[0],
                   "the layers fill a line of two dividing planes, or cross it or a cut on a cap");
  }
  cw_outline_free(&outline);
  return status;
}

CwStatus cw_skeleton_interface_outline(const CwSkeleton *skeleton, const CwInterfaceOutline *interface,
                                       const CwPlaneMap *map, CwPatchOutline *outline) {
  CwStatus status = CW_OK;
  CW_TRY(cw_outline_start(outline, skeleton->interfaces.nodes.count));
  for (int32_t l = 0; l < interface->loop_count; l++) {
    int32_t first = interface->loop_start[l], count = interface->loop_start[l + 1] - first;
    for (int32_t k = 0; k < count; k++) {
      int32_t local[2];
      for (int end = 0; end < 2; end++) {
        int32_t node = interface->corner[first + (k + end) % count];
        double uv[2];
        cw_plane_uv(map, skeleton->interfaces.nodes.x[node], uv);
        CW_TRY(cw_outline_point(outline, node, uv, skeleton->interfaces.nodes.x[node], &local[end]));
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

CwStatus cw_skeleton_mesh_interface(const CwSkeleton *skeleton, int32_t index, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  CwPatchOutline outline = {0};
  const CwInterfaceOutline *interface = &skeleton->interfaces.outline[index];
  CwPlaneMap map = cw_plane_map_of(&skeleton->plan->node[interface->node].plane);
  Sides sides = {skeleton->plan, map.axis[2]};
  char name[64];
  snprintf(name, sizeof name, "interface %d on dividing plane %d", index, interface->node);
  CW_TRY(cw_skeleton_interface_outline(skeleton, interface, &map, &outline));
  CW_TRY(cw_patch_task(&outline, cw_plane_map, &map, skeleton->size_at, skeleton->size, 0, 0, sides_at, &sides, name,
                       bytes, size));
done:
  cw_outline_free(&outline);
  return status;
}

// Appends a packed patch, turned: its new points as nodes, its triangles at triangle[count...].
static CwStatus append(CwSkeleton *skeleton, const CwPatchBlock *block, int on_plane, int32_t turns, int32_t copies,
                       int32_t (*triangle)[3]) {
  CwStatus status = CW_OK;
  CwSkeletonOrbits *orbits = &skeleton->orbits;
  int32_t first = skeleton->interfaces.nodes.count, node;
  for (int32_t i = 0; i < block->point_count; i++) {
    double x[3];
    cw_orbit_point(orbits, turns, block->x[i], x);
    CW_TRY(cw_skeleton_add_node(skeleton, x, on_plane, &node));
    if (turns > 0) CW_TRY(cw_orbit_link(orbits, node - block->point_count, node, turns));
    if (turns > 0 && turns == copies - 1) {
      CW_TRY(cw_orbit_link(orbits, node, node - turns * block->point_count, 0));
    }
  }
  for (int32_t t = 0; t < block->triangle_count; t++) {
    for (int k = 0; k < 3; k++) {
      int32_t local = block->triangle[t][k];
      triangle[t][k] = local < block->outline_points ? cw_orbit_node(orbits, block->outline_node[local], turns)
                                                     : first + local - block->outline_points;
    }
  }
done:
  return status;
}

static CwStatus merge_cap(CwSkeleton *skeleton, int32_t face, const CwPatchBlock *block) {
  CwStatus status = CW_OK;
  int32_t copies = cw_orbit_face_copies(&skeleton->orbits, face);
  for (int32_t turns = 0; turns < copies; turns++) {
    CW_TRY(
        append(skeleton, block, 0, turns, copies, skeleton->interfaces.cap.triangle + skeleton->interfaces.cap.count));
    for (int32_t t = 0; t < block->triangle_count; t++) {
      skeleton->interfaces.cap.face[skeleton->interfaces.cap.count] = cw_orbit_face(&skeleton->orbits, face, turns);
      skeleton->interfaces.cap.region[skeleton->interfaces.cap.count++] =
          cw_orbit_region(&skeleton->orbits, skeleton->plan, block->label[t], turns);
    }
  }
done:
  return status;
}

static CwStatus merge_interface(CwSkeleton *skeleton, int32_t index, const CwPatchBlock *block) {
  CwStatus status = CW_OK;
  CwSkeletonOrbits *orbits = &skeleton->orbits;
  int32_t copies = cw_orbit_copies(orbits, &orbits->outline, index), regions = skeleton->plan->region_count;
  for (int32_t turns = 0, copy = index; turns < copies; turns++) {
    CwInterfaceOutline *interface = &skeleton->interfaces.outline[copy];
    interface->free_start = skeleton->interfaces.nodes.count;
    interface->free_count = block->point_count;
    interface->triangle_start = skeleton->interfaces.refined.count;
    interface->triangle_count = block->triangle_count;
    CW_TRY(append(skeleton, block, 1, turns, copies,
                  skeleton->interfaces.refined.triangle + skeleton->interfaces.refined.count));
    for (int32_t t = 0; t < block->triangle_count; t++) {
      int32_t *region = skeleton->interfaces.refined.region[skeleton->interfaces.refined.count++];
      region[0] = cw_orbit_region(orbits, skeleton->plan, block->label[t] / regions, turns);
      region[1] = cw_orbit_region(orbits, skeleton->plan, block->label[t] % regions, turns);
    }
    if (copies > 1) copy = orbits->outline.next[copy];
  }
done:
  return status;
}

CwStatus cw_skeleton_merge_inner(CwSkeleton *skeleton, void *const *cap_bytes, void *const *interface_bytes) {
  CwStatus status = CW_OK;
  CwPatchBlock block;
  const CwSkeletonOrbits *orbits = &skeleton->orbits;
  int32_t faces = cw_cad_face_count(skeleton->cad), caps = 0, interfaces = 0;
  for (int32_t f = 0; f < faces; f++) {
    if (!cap_bytes[f]) continue;
    cw_patch_block(cap_bytes[f], &block);
    caps += block.triangle_count * cw_orbit_face_copies(orbits, f);
  }
  for (int32_t i = 0; i < skeleton->interfaces.outline_count; i++) {
    if (!interface_bytes[i]) continue;
    cw_patch_block(interface_bytes[i], &block);
    interfaces += block.triangle_count * cw_orbit_copies(orbits, &orbits->outline, i);
  }
  CW_NEW(skeleton->interfaces.cap.triangle, caps);
  CW_NEW(skeleton->interfaces.cap.face, caps);
  CW_NEW(skeleton->interfaces.cap.region, caps);
  CW_NEW(skeleton->interfaces.refined.triangle, interfaces);
  CW_NEW(skeleton->interfaces.refined.region, interfaces);
  for (int32_t f = 0; f < faces; f++) {
    if (!cap_bytes[f]) continue;
    cw_patch_block(cap_bytes[f], &block);
    CW_TRY(merge_cap(skeleton, f, &block));
  }
  for (int32_t i = 0; i < skeleton->interfaces.outline_count; i++) {
    if (!interface_bytes[i]) continue;
    cw_patch_block(interface_bytes[i], &block);
    CW_TRY(merge_interface(skeleton, i, &block));
  }
done:
  return status;
}
