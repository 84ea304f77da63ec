// SPDX-License-Identifier: AGPL-3.0-or-later
#include "chew_interfaces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/boundary/boundary_curves.h"
#include "mesher/region/encroach.h"

static CwPatchInput patch_of(const CwRegionInput *from, const CwChewInterface *interface) {
  return (CwPatchInput){.surface = cw_plane_map,
                        .surface_context = &interface->map,
                        .size = from->in->size_at,
                        .size_context = from->in->size,
                        .point_count = interface->point_count,
                        .uv = (const double(*)[2])interface->uv,
                        .x = (const double(*)[3])interface->x,
                        .edge_count = interface->outline.edge_count,
                        .edge = (const int32_t(*)[2])interface->outline.edge,
                        .boundary = interface->outline.boundary,
                        .name = "on a partition plane"};
}

static int compare_triangles(const void *p, const void *q) {
  const int32_t *a = p, *b = q;
  for (int k = 0; k < 3; k++) {
    if (a[k] != b[k]) return a[k] < b[k] ? -1 : 1;
  }
  return 0;
}

// Triangles that were final and are still there stay so; those with a point in their spheres become it.
static CwStatus find_final(const CwChewInterface *before, const CwBeside *beside, CwChewInterface *interface) {
  CwStatus status = CW_OK;
  CW_NEW(interface->final, interface->triangle_count);
  for (int32_t t = 0; t < interface->triangle_count; t++) {
    const int32_t *p = interface->triangle[t];
    double centre[2], radius;
    if (!cw_encroach_circle(interface->uv[p[0]], interface->uv[p[1]], interface->uv[p[2]], centre, &radius)) continue;
    interface->final[t] = cw_beside_in_sphere(beside, centre, radius, NULL) > 0;
    if (before->triangle_count == 0) continue;
    const int32_t(*same)[3] =
        bsearch(p, before->triangle, (size_t)before->triangle_count, sizeof *before->triangle, compare_triangles);
    if (same) interface->final[t] |= before->final[same - (const int32_t(*)[3])before->triangle];
  }
done:
  return status;
}

// Takes up a triangulation with its new points.
static CwStatus take(const CwBeside *beside, CwEncroachRefined *refined, CwChewInterface *interface) {
  CwStatus status = CW_OK;
  CwChewInterface before = *interface;
  int32_t count = interface->point_count + refined->point_count;
  interface->triangle = refined->triangle;
  interface->triangle_count = refined->triangle_count;
  interface->final = NULL;
  refined->triangle = NULL;
  void *uv = realloc(interface->uv, (size_t)count * sizeof *interface->uv);
  if (uv) interface->uv = uv;
  void *x = realloc(interface->x, (size_t)count * sizeof *interface->x);
  if (x) interface->x = x;
  CW_REQUIRE(uv && x, CW_ERR_MEMORY, "out of memory: %d points of an interface", count);
  for (int32_t p = 0; p < refined->point_count; p++) {
    double *to = interface->uv[interface->point_count];
    memcpy(to, refined->uv[p], sizeof *refined->uv);
    cw_plane_map(&interface->map, to, interface->x[interface->point_count++], NULL, NULL);
  }
  CW_TRY(find_final(&before, beside, interface));
done:
  free(before.triangle);
  free(before.final);
  return status;
}

CwStatus cw_chew_interface_make(const CwRegionInput *from, int32_t index, CwChewInterface *interface) {
  CwStatus status = CW_OK;
  const CwInterfaceOutline *planned = &from->interfaces->outline[index];
  CwPatchOutline *outline = &interface->outline;
  CwEncroachRefined refined = {0};
  CwBeside nothing = {0};
  *interface = (CwChewInterface){.map = cw_plane_map_of(&from->in->plan->node[planned->node].plane)};
  memcpy(interface->region, from->interfaces->planned.region[planned->triangle_start], sizeof interface->region);
  CW_TRY(cw_boundary_interface_outline(&from->interfaces->nodes, planned, &interface->map, outline));
  for (int32_t node = planned->free_start; node < planned->free_start + planned->free_count; node++) {
    double uv[2];
    int32_t local;
    cw_plane_uv(&interface->map, from->interfaces->nodes.x[node], uv);
    CW_TRY(cw_outline_point(outline, node, uv, from->interfaces->nodes.x[node], &local));
  }
  free(outline->local); // as long as all nodes of the domain
  outline->local = NULL;
  CW_NEW(interface->uv, outline->point_count);
  CW_NEW(interface->x, outline->point_count);
  interface->point_count = outline->point_count;
  memcpy(interface->uv, outline->uv, (size_t)outline->point_count * sizeof *interface->uv);
  memcpy(interface->x, outline->x, (size_t)outline->point_count * sizeof *interface->x);
  CwPatchInput patch = patch_of(from, interface);
  CW_TRY(cw_encroach_refine(&patch, &nothing, &refined));
  CW_TRY(take(&nothing, &refined, interface));
done:
  cw_encroach_refined_free(&refined);
  if (status != CW_OK) cw_chew_interface_free(interface);
  return status;
}

void cw_chew_interface_free(CwChewInterface *interface) {
  cw_outline_free(&interface->outline);
  free(interface->uv);
  free(interface->x);
  free(interface->triangle);
  free(interface->final);
  *interface = (CwChewInterface){0};
}

CwStatus cw_chew_interface_spheres(const CwChewInterface *interface, int32_t index, CwChewSphere **sphere,
                                   int32_t *count, int32_t *space) {
  CwStatus status = CW_OK;
  CW_GROW(*sphere, *space, *count + interface->triangle_count);
  for (int32_t t = 0; t < interface->triangle_count; t++) {
    const int32_t *p = interface->triangle[t];
    double centre[2];
    CwChewSphere *made = &(*sphere)[*count];
    *made = (CwChewSphere){.interface = index, .triangle = t};
    if (!cw_encroach_circle(interface->uv[p[0]], interface->uv[p[1]], interface->uv[p[2]], centre, &made->radius))
      continue;
    cw_plane_map(&interface->map, centre, made->centre, NULL, NULL);
    ++*count;
  }
done:
  return status;
}

// How far from the plane a sphere reaches.
static double reach_of(const CwChewInterface *interface) {
  double most = 0;
  for (int32_t t = 0; t < interface->triangle_count; t++) {
    const int32_t *p = interface->triangle[t];
    double centre[2], radius;
    if (cw_encroach_circle(interface->uv[p[0]], interface->uv[p[1]], interface->uv[p[2]], centre, &radius))
      most = fmax(most, radius);
  }
  return most;
}

CwStatus cw_chew_interface_split(const CwRegionInput *from, int32_t count, const CwChewAsked *asked,
                                 CwChewInterface *interface, int32_t *added) {
  CwStatus status = CW_OK;
  CwEncroachRefined refined = {0};
  CwBeside beside = {0};
  double(*x)[3] = NULL;
  *added = 0;
  CW_NEW(x, count);
  for (int32_t k = 0; k < count; k++) memcpy(x[k], asked[k].x, sizeof *x);
  CW_TRY(cw_beside_make(interface->map.origin, (const double(*)[3])interface->map.axis, 2 * reach_of(interface), count,
                        (const double(*)[3])x, &beside));
  CwPatchInput patch = patch_of(from, interface);
  CW_TRY(cw_encroach_refine(&patch, &beside, &refined));
  *added = refined.point_count;
  CW_TRY(take(&beside, &refined, interface));
done:
  cw_encroach_refined_free(&refined);
  cw_beside_free(&beside);
  free(x);
  return status;
}
