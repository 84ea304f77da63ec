// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/interface_rule.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/boundary/boundary_curves.h"
#include "mesher/common/vec.h"
#include "mesher/fill/fill_points.h"
#include "mesher/region/encroach.h"
#include "mesher/region/region_boundary.h"

// The refined interfaces of a region, packed: their number, and of each a header, the inserted points and the
// triangles. Corners below 0 are inserted points: -1 - k.
enum { OUTLINE, INSERTED, TRIANGLES, ENCROACHED, LEFT, HEADER };

int32_t cw_interface_owner(const CwRegionInput *from, const int32_t *number, int32_t outline) {
  const CwInterfaces *interfaces = from->interfaces;
  const CwPeriodicImages *images = from->in->images;
  const int32_t *region = cw_interfaces_of(interfaces, 1)->region[interfaces->outline[outline].triangle_start];
  int32_t first[2];
  for (int k = 0; k < 2; k++) first[k] = cw_image_region_first(images, from->in->plan, region[k]);
  return number[first[1]] < number[first[0]] ? region[1] : region[0];
}

int32_t cw_interface_refiner(const CwRegionInput *from, const int32_t *number, int32_t outline) {
  const CwPeriodicImages *images = from->in->images;
  int32_t owner = cw_interface_owner(from, number, outline);
  int own_image = cw_image_region(images, from->in->plan, owner, 1) == owner; // owns all images of the outline
  int turned = own_image ? cw_image_turns(images, &from->interfaces->outline_images, outline) > 0
                         : cw_image_region_first(images, from->in->plan, owner) != owner;
  return turned ? -1 : owner;
}

// Candidates of the region: no nearer to its boundary than the fill allows, and outside the spheres of layer top and
// open patches. Where there are slabs, those in them.
static CwStatus candidates(const CwRegionInput *from, int32_t region, const char *name, int32_t slab_count,
                           const CwFillSlab *slab, int32_t *count, double (**x)[3], CwLatticeSite **site) {
  CwStatus status = CW_OK;
  CwRegionBoundary inner = {0};
  CW_TRY(cw_region_boundary_make(from, region, 1, &inner));
  CwFillInput input = cw_region_fill_input(from, &inner, name);
  input.open_count = inner.interface_count;
  input.slab_count = slab_count;
  input.slab = slab;
  CW_TRY(cw_fill_points(&input, 1.0, count, x, site));
done:
  cw_region_boundary_free(&inner);
  return status;
}

// The outline with the inner nodes of the planned interface.
static CwStatus planned_points(const CwRegionInput *from, const CwInterfaceOutline *interface, const CwPlaneMap *map,
                               CwPatchOutline *outline) {
  CwStatus status = CW_OK;
  CW_TRY(cw_boundary_interface_outline(&from->interfaces->nodes, interface, map, outline));
  for (int32_t node = interface->free_start; node < interface->free_start + interface->free_count; node++) {
    double uv[2];
    int32_t local;
    cw_plane_uv(map, from->interfaces->nodes.x[node], uv);
    CW_TRY(cw_outline_point(outline, node, uv, from->interfaces->nodes.x[node], &local));
  }
done:
  return status;
}

// How far from the plane the sphere of a triangle can reach: a bound for all triangles of a triangulation.
static double largest_radius(const CwPlaneMap *map, int32_t count, const int32_t (*triangle)[3], const double (*x)[3]) {
  double largest = 0;
  for (int32_t t = 0; t < count; t++) {
    double uv[3][2], centre[2], radius;
    for (int k = 0; k < 3; k++) cw_plane_uv(map, x[triangle[t][k]], uv[k]);
    if (cw_encroach_circle(uv[0], uv[1], uv[2], centre, &radius)) largest = fmax(largest, radius);
  }
  return largest;
}

static CwStatus pack(int32_t index, const CwPlaneMap *map, const CwPatchOutline *outline,
                     const CwEncroachRefined *refined, char **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  int32_t header[HEADER] = {index, refined->point_count, refined->triangle_count, refined->encroached, refined->left};
  size_t more = sizeof header + (size_t)refined->point_count * sizeof(double[3]) +
                (size_t)refined->triangle_count * sizeof(int32_t[3]);
  char *grown = realloc(*bytes, (size_t)*size + more);
  CW_REQUIRE(grown, CW_ERR_MEMORY, "out of memory: interface %d", index);
  *bytes = grown;
  char *at = grown + *size;
  *size += (int64_t)more;
  memcpy(at, header, sizeof header);
  at += sizeof header;
  for (int32_t p = 0; p < refined->point_count; p++, at += sizeof(double[3])) {
    double x[3];
    cw_plane_map(map, refined->uv[p], x, NULL, NULL);
    memcpy(at, x, sizeof x);
  }
  for (int32_t t = 0; t < refined->triangle_count; t++, at += sizeof(int32_t[3])) {
    int32_t corner[3];
    for (int k = 0; k < 3; k++) {
      int32_t p = refined->triangle[t][k];
      corner[k] = p < outline->point_count ? outline->node[p] : -1 - (p - outline->point_count);
    }
    memcpy(at, corner, sizeof corner);
  }
done:
  return status;
}

// How far from the plane of an interface points may lie that count there. Inserting centres makes no circle larger; the
// constrained Delaunay triangulation may differ a little from the planned one before.
static CwFillSlab beside_interface(const CwRegionInput *from, const CwInterfaceOutline *interface) {
  const CwPlane *plane = &from->in->plan->node[interface->node].plane;
  CwPlaneMap map = cw_plane_map_of(plane);
  double radius = largest_radius(&map, interface->triangle_count,
                                 (const int32_t(*)[3])from->interfaces->refined.triangle + interface->triangle_start,
                                 (const double(*)[3])from->interfaces->nodes.x);
  return (CwFillSlab){*plane, 2 * radius};
}

static CwStatus refine(const CwRegionInput *from, int32_t index, double reach, int32_t count,
                       const double (*candidate)[3], char **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  const CwInterfaceOutline *interface = &from->interfaces->outline[index];
  CwPatchOutline outline = {0};
  CwBeside beside = {0};
  CwEncroachRefined refined = {0};
  CwPlaneMap map = cw_plane_map_of(&from->in->plan->node[interface->node].plane);
  CW_TRY(planned_points(from, interface, &map, &outline));
  CW_TRY(cw_beside_make(map.origin, (const double(*)[3])map.axis, reach, count, candidate, &beside));
  CwPatchInput patch = {.surface = cw_plane_map,
                        .surface_context = &map,
                        .size = from->in->size_at,
                        .size_context = from->in->size,
                        .point_count = outline.point_count,
                        .uv = (const double(*)[2])outline.uv,
                        .x = (const double(*)[3])outline.x,
                        .edge_count = outline.edge_count,
                        .edge = (const int32_t(*)[2])outline.edge,
                        .boundary = outline.boundary,
                        .name = "on a partition plane"};
  CW_TRY(cw_encroach_refine(&patch, &beside, &refined));
  CW_TRY(pack(index, &map, &outline, &refined, bytes, size));
done:
  cw_encroach_refined_free(&refined);
  cw_beside_free(&beside);
  cw_outline_free(&outline);
  return status;
}

CwStatus cw_interface_rule(const CwRegionInput *from, const int32_t *number, int32_t region, const char *name,
                           void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  double(*candidate)[3] = NULL;
  CwFillSlab *slab = NULL;
  char *made = NULL;
  int32_t count = 0, owned = 0, *outline = NULL;
  *bytes = NULL;
  *size = 0;
  CW_NEW(made, sizeof owned);
  *size = sizeof owned;
  CW_NEW(outline, from->interfaces->outline_count);
  CW_NEW(slab, from->interfaces->outline_count);
  for (int32_t i = 0; i < from->interfaces->outline_count; i++) {
    if (cw_interface_refiner(from, number, i) != region) continue;
    slab[owned] = beside_interface(from, &from->interfaces->outline[i]);
    outline[owned++] = i;
  }
  CW_TRY(candidates(from, region, name, owned, slab, &count, &candidate, NULL));
  for (int32_t i = 0; i < owned; i++) {
    CW_TRY(refine(from, outline[i], slab[i].reach, count, (const double(*)[3])candidate, &made, size));
  }
  memcpy(made, &owned, sizeof owned);
  *bytes = made;
  made = NULL;
done:
  free(candidate);
  free(slab);
  free(outline);
  free(made);
  return status;
}

// Takes up one packed interface, turned: its new points as nodes, its triangles behind those that are there.
static CwStatus take_up(const CwPeriodicImages *images, CwInterfaces *interfaces, int32_t index, int32_t turns,
                        int32_t copies, const char *block) {
  CwStatus status = CW_OK;
  CwInterfaceOutline *interface = &interfaces->outline[index];
  int32_t header[HEADER], first = interfaces->nodes.count, node;
  memcpy(header, block, sizeof header);
  const char *at = block + sizeof header;
  for (int32_t p = 0; p < header[INSERTED]; p++, at += sizeof(double[3])) {
    double x[3], turned[3];
    memcpy(x, at, sizeof x);
    cw_image_point(images, turns, x, turned);
    CW_TRY(cw_node_table_add(&interfaces->nodes, turned, 1, &node));
    CW_TRY(cw_image_link_copy(&interfaces->images, node, header[INSERTED], turns, copies));
  }
  interface->refined_start = interfaces->refined.count;
  interface->refined_count = header[TRIANGLES];
  for (int32_t t = 0; t < header[TRIANGLES]; t++, at += sizeof(int32_t[3])) {
    int32_t *corner = interfaces->refined.triangle[interfaces->refined.count];
    memcpy(corner, at, sizeof(int32_t[3]));
    for (int k = 0; k < 3; k++)
      corner[k] = corner[k] < 0 ? first + (-1 - corner[k]) : cw_image_node(&interfaces->images, corner[k], turns);
    memcpy(interfaces->refined.region[interfaces->refined.count++],
           interfaces->planned.region[interface->triangle_start], sizeof(int32_t[2]));
  }
done:
  return status;
}

CwStatus cw_interface_rule_merge(const CwPeriodicImages *images, CwInterfaces *interfaces, int32_t regions,
                                 void *const *bytes, CwInterfaceRuleCounts *counts) {
  CwStatus status = CW_OK;
  const char **block = NULL;
  int32_t header[HEADER];
  CW_TRY(cw_arrays_own(interfaces, cw_interfaces_arrays, &interfaces->memory));
  *counts = (CwInterfaceRuleCounts){.planned = interfaces->refined.count};
  CW_NEW(block, interfaces->outline_count);
  for (int32_t r = 0; r < regions; r++) {
    int32_t owned = 0;
    const char *at = bytes[r];
    if (!at) continue;
    memcpy(&owned, at, sizeof owned);
    at += sizeof owned;
    for (int32_t k = 0; k < owned; k++) {
      memcpy(header, at, sizeof header);
      block[header[OUTLINE]] = at;
      at +=
          sizeof header + (size_t)header[INSERTED] * sizeof(double[3]) + (size_t)header[TRIANGLES] * sizeof(int32_t[3]);
      int64_t copies = cw_image_copies(images, &interfaces->outline_images, header[OUTLINE]);
      counts->inserted += copies * header[INSERTED];
      counts->refined += copies * header[TRIANGLES];
      counts->encroached += copies * header[ENCROACHED];
      counts->left += copies * header[LEFT];
    }
  }
  interfaces->planned = interfaces->refined;
  interfaces->refined = (CwInterfaceTriangles){0};
  CW_NEW(interfaces->refined.triangle, counts->refined);
  CW_NEW(interfaces->refined.region, counts->refined);
  for (int32_t i = 0; i < interfaces->outline_count; i++) {
    int32_t copies = cw_image_copies(images, &interfaces->outline_images, i);
    for (int32_t turns = 0, copy = i; block[i] && turns < copies; turns++) {
      CW_TRY(take_up(images, interfaces, copy, turns, copies, block[i]));
      if (copies > 1) copy = interfaces->outline_images.next[copy];
    }
  }
  for (int32_t i = 0; i < interfaces->outline_count; i++)
    CW_REQUIRE(interfaces->outline[i].refined_count > 0, CW_ERR_FAULT, "interface %d has no owner", i);
done:
  free(block);
  return status;
}

CwStatus cw_interface_rule_points(const CwRegionInput *from, int32_t region, const char *name, int32_t *count,
                                  double (**x)[3], CwLatticeSite **site) {
  CwStatus status = CW_OK;
  CwBeside beside = {0};
  uint8_t *dropped = NULL;
  int32_t kept = 0;
  CW_TRY(candidates(from, region, name, 0, NULL, count, x, site));
  CW_NEW(dropped, *count);
  for (int32_t i = 0; i < from->interfaces->outline_count; i++) {
    const CwInterfaceOutline *interface = &from->interfaces->outline[i];
    const int32_t *regions = from->interfaces->refined.region[interface->refined_start];
    if (regions[0] != region && regions[1] != region) continue;
    CwPlaneMap map = cw_plane_map_of(&from->in->plan->node[interface->node].plane);
    const int32_t(*triangle)[3] = (const int32_t(*)[3])from->interfaces->refined.triangle + interface->refined_start;
    double reach =
        largest_radius(&map, interface->refined_count, triangle, (const double(*)[3])from->interfaces->nodes.x);
    CW_TRY(cw_beside_make(map.origin, (const double(*)[3])map.axis, reach, *count, (const double(*)[3]) * x, &beside));
    for (int32_t t = 0; t < interface->refined_count; t++) {
      double uv[3][2], centre[2], radius;
      for (int k = 0; k < 3; k++) cw_plane_uv(&map, from->interfaces->nodes.x[triangle[t][k]], uv[k]);
      if (!cw_encroach_circle(uv[0], uv[1], uv[2], centre, &radius)) continue;
      cw_beside_in_sphere(&beside, centre, radius, dropped);
    }
    cw_beside_free(&beside);
  }
  for (int32_t i = 0; i < *count; i++) {
    if (dropped[i]) continue;
    (*site)[kept] = (*site)[i];
    memmove((*x)[kept++], (*x)[i], sizeof **x);
  }
  *count = kept;
done:
  cw_beside_free(&beside);
  free(dropped);
  if (status != CW_OK) {
    free(*x);
    free(*site);
    *x = NULL;
    *site = NULL;
  }
  return status;
}
