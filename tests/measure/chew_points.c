// SPDX-License-Identifier: AGPL-3.0-or-later
#include "chew_points.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/mix.h"
#include "mesher/common/radix.h"
#include "mesher/common/tet.h"

enum { SPLIT = CW_CHEW_SPLIT, HITS = 256, CLASSES = 64 };
static const double CLASSES_OCTAVE = 4;
static const double RAY[3] = {0.1234, 0.4321, 0.8933}; // of no plane's direction

static CwBox box_of_reach(const void *context, int32_t t) {
  const CwReachBox *reach = (const CwReachBox *)context + t;
  CwBox box;
  for (int k = 0; k < 3; k++) box.low[k] = reach->low[k], box.high[k] = reach->high[k];
  return box;
}

static CwBox box_of_sphere(const void *context, int32_t t) {
  const CwChewSphere *sphere = (const CwChewSphere *)context + t;
  CwBox box;
  for (int k = 0; k < 3; k++) {
    box.low[k] = sphere->centre[k] - sphere->radius;
    box.high[k] = sphere->centre[k] + sphere->radius;
  }
  return box;
}

static CwBox box_of_all(int32_t count, CwBoxOf box_of, const void *items) {
  CwBox sum = cw_box_empty();
  for (int32_t t = 0; t < count; t++) {
    CwBox box = box_of(items, t);
    cw_box_add(&sum, &box);
  }
  return sum;
}

static const double *corner_of(const CwRegionBoundary *inner, int32_t t, int k) {
  return inner->x[inner->triangle[t][k]];
}

CwStatus cw_chew_region_open(const CwRegionInput *from, int32_t region, CwChewRegion *made) {
  CwStatus status = CW_OK;
  *made = (CwChewRegion){.region = region};
  CW_TRY(cw_region_boundary_make(from, region, 1, &made->inner));
  const CwRegionBoundary *inner = &made->inner;
  int32_t fixed = inner->wall_count + inner->bare_count + inner->open_patch_count;
  CW_TRY(cw_rays_make(NULL, inner->node_count, (const double(*)[3])inner->x, fixed + inner->interface_count,
                      (const int32_t(*)[3])inner->triangle, &made->rays));
  CwBox all = cw_box_of_points(inner->node_count, (const double(*)[3])inner->x);
  made->across = 2 * cw_box_longest(&all);
  CW_NEW(made->box, fixed);
  CW_NEW(made->ball, fixed);
  for (int32_t t = 0; t < fixed; t++) {
    cw_reach_of_triangle(corner_of(inner, t, 0), corner_of(inner, t, 1), corner_of(inner, t, 2), INFINITY, 1.0,
                         &made->box[t], &made->ball[t]);
  }
  CwBox within = box_of_all(fixed, box_of_reach, made->box);
  CW_TRY(cw_box_tree_make(NULL, fixed, &within, box_of_reach, made->box, &made->fixed));
  CW_TRY(cw_delaunay_make(inner->node_count, (const double(*)[3])inner->x, &made->mesh));
  CW_TRY(cw_delaunay_open(&made->mesh, &made->insertion));
done:
  if (status != CW_OK) cw_chew_region_close(made);
  return status;
}

void cw_chew_region_close(CwChewRegion *region) {
  cw_delaunay_close(&region->insertion);
  cw_tet_mesh_free(&region->mesh);
  cw_rays_free(&region->rays);
  cw_box_tree_free(&region->fixed);
  cw_box_tree_free(&region->spheres);
  cw_region_boundary_free(&region->inner);
  free(region->split);
  free(region->box);
  free(region->ball);
  free(region->judged);
  free(region->sphere);
  free(region->sphere_asked);
  free(region->deferred);
  free(region->asked);
  *region = (CwChewRegion){0};
}

CwStatus cw_chew_region_add(CwChewRegion *region, const CwChewInterface *interface, int32_t index, int32_t first) {
  CwStatus status = CW_OK;
  for (int32_t p = first; p < interface->point_count; p++) {
    int32_t point;
    CW_TRY(cw_delaunay_insert(region->insertion, interface->x[p], SPLIT - region->split_count, -1, &point));
    CW_REQUIRE(point >= 0, CW_ERR_MESH, "region %d: the split of an interface falls onto a point", region->region + 1);
    CW_GROW(region->split, region->split_space, region->split_count + 1);
    region->split[region->split_count++] = (CwChewSplit){index, p};
  }
done:
  return status;
}

// A tetrahedron in the list again is the same where this is; 0 is none's.
static uint32_t print_of(const CwTet *tet) {
  uint64_t sum = 0;
  for (int i = 0; i < 4; i++) sum = (sum ^ (uint64_t)tet->corner[i]) * CW_MIX_STEP;
  return (uint32_t)(sum >> 32) | 1;
}

// How far a tetrahedron is out of bounds, 1: just within; and the centre of its sphere. 0: it has none to speak of.
static double need_of(const CwRegionInput *from, const CwChewBounds *bounds, const CwTetMesh *mesh, const CwTet *tet,
                      double centre[3]) {
  const double *a = mesh->point[tet->corner[0]].x;
  double e[3][3], square[3], shortest = INFINITY, n[3], length = 0;
  for (int i = 0; i < 6; i++) {
    double d[3];
    cw_sub(mesh->point[tet->corner[cw_tet_edge[i][1]]].x, mesh->point[tet->corner[cw_tet_edge[i][0]]].x, d);
    double dd = cw_dot(d, d);
    shortest = fmin(shortest, dd);
    length = fmax(length, dd);
    if (i < 3) memcpy(e[i], d, sizeof d), square[i] = dd;
  }
  double det = 0, radius = 0, sum[3] = {0};
  for (int i = 0; i < 3; i++) {
    cw_cross(e[(i + 1) % 3], e[(i + 2) % 3], n);
    if (i == 0) det = 2 * cw_dot(e[0], n);
    for (int k = 0; k < 3; k++) sum[k] += square[i] * n[k];
  }
  if (!(det > 1e-9 * length * sqrt(length))) return 0;
  for (int k = 0; k < 3; k++) {
    centre[k] = a[k] + sum[k] / det;
    radius += sum[k] / det * (sum[k] / det);
  }
  radius = sqrt(radius);
  return fmax(radius / (bounds->radius * from->in->size_at(from->in->size, centre)),
              radius / (bounds->ratio * sqrt(shortest)));
}

// What is asked of a place.
typedef struct {
  const CwChewRegion *region;
  const double *x;
  double h;
  float single[3];
  int32_t count, sphere[HITS]; // that hold it
} Place;

static int note_near(void *context, int32_t t) {
  Place *place = context;
  const CwChewRegion *region = place->region;
  if (!cw_reach_holds(&region->box[t], place->single)) return 0;
  place->count = cw_reach_in_ball(&region->ball[t], place->x) ||
                 cw_reach_is_near(corner_of(&region->inner, t, 0), corner_of(&region->inner, t, 1),
                                  corner_of(&region->inner, t, 2), &region->ball[t], place->h, 1.0, place->x);
  return place->count;
}

static int note_sphere(void *context, int32_t t) {
  Place *place = context;
  const CwChewSphere *sphere = &place->region->sphere[t];
  double d[3];
  cw_sub(place->x, sphere->centre, d);
  if (cw_dot(d, d) < sphere->radius * sphere->radius) place->sphere[place->count++] = t;
  return place->count == HITS;
}

// Whether the first hit of a ray leads out of the region.
static int ray_leads_out(const CwChewRegion *region, const double x[3]) {
  CwRayHit hit[HITS];
  double direction[3], normal[3];
  cw_copy(RAY, direction);
  cw_unit(direction);
  if (cw_rays_hits(region->rays, x, direction, 0, region->across, HITS, hit) == 0) return 0;
  const CwRegionBoundary *inner = &region->inner;
  int32_t t = hit[0].triangle;
  cw_normal(corner_of(inner, t, 0), corner_of(inner, t, 1), corner_of(inner, t, 2), normal);
  return cw_dot(normal, direction) > 0;
}

// Whether the centre of a tetrahedron lies in the region. With all corners inside it does, since its sphere is empty;
// with one of them, where the way from there does not lead out; with none, by a ray.
static int is_inside(const CwChewRegion *region, const CwTet *tet, const double centre[3]) {
  int corner = -1, inside = 0;
  for (int i = 0; i < 4; i++) {
    if (region->mesh.source[tet->corner[i]] < region->inner.node_count) continue;
    corner = i;
    inside++;
  }
  if (inside == 4) return 1;
  if (inside == 0) return ray_leads_out(region, centre);
  double way[3], distance;
  const double *x = region->mesh.point[tet->corner[corner]].x;
  cw_sub(centre, x, way);
  double length = cw_norm(way);
  cw_unit(way);
  return cw_rays_exit(region->rays, x, way, 0, length, &distance) < 0;
}

// Puts the tetrahedron aside where a sphere that holds its centre can be split; asks for that once a sphere.
static CwStatus defer(const CwChewInterface *interface, const Place *place, CwChewTet tet, CwChewRegion *region) {
  CwStatus status = CW_OK;
  int splits = 0;
  for (int32_t k = 0; k < place->count; k++) {
    const CwChewSphere *sphere = &region->sphere[place->sphere[k]];
    if (interface[sphere->interface].final[sphere->triangle]) continue;
    splits = 1;
    if (region->sphere_asked[place->sphere[k]]) continue;
    region->sphere_asked[place->sphere[k]] = 1;
    CW_GROW(region->asked, region->asked_space, region->asked_count + 1);
    CwChewAsked *asked = &region->asked[region->asked_count++];
    *asked = (CwChewAsked){.interface = sphere->interface, .region = region->region};
    cw_copy(place->x, asked->x);
  }
  if (!splits) goto done;
  CW_GROW(region->deferred, region->deferred_space, region->deferred_count + 1);
  region->deferred[region->deferred_count++] = tet;
done:
  return status;
}

// Inserts the centre of a tetrahedron where it can be had.
static CwStatus try_centre(const CwRegionInput *from, const CwChewInterface *interface, const double centre[3],
                           CwChewTet tet, CwChewRegion *region) {
  CwStatus status = CW_OK;
  int32_t point;
  Place place = {region, centre, from->in->size_at(from->in->size, centre), {0}, 0, {0}};
  CwBox box = cw_box_of_point(centre);
  for (int k = 0; k < 3; k++) place.single[k] = (float)centre[k];
  cw_box_tree_overlaps(&region->fixed, &box, note_near, &place);
  if (place.count) goto done;
  if (!is_inside(region, &region->mesh.tet[tet.tet], centre)) goto done;
  if (region->sphere_count) cw_box_tree_overlaps(&region->spheres, &box, note_sphere, &place);
  if (place.count) {
    CW_TRY(defer(interface, &place, tet, region));
    goto done;
  }
  CW_TRY(cw_delaunay_insert(region->insertion, centre, region->inner.node_count, tet.tet, &point));
done:
  return status;
}

// Tetrahedra that are out of bounds and were not tried: the worst first, by classes, and in a class as they lie in
// memory. *record has room for all.
static CwStatus collect(const CwRegionInput *from, const CwChewBounds *bounds, CwChewRegion *region, int32_t *space,
                        CwRadix **record, int32_t *count) {
  CwStatus status = CW_OK;
  const CwTetMesh *mesh = &region->mesh;
  int32_t judged = region->judged_space;
  *count = 0;
  CW_GROW(region->judged, region->judged_space, mesh->tet_count);
  if (region->judged_space > judged)
    memset(region->judged + judged, 0, (size_t)(region->judged_space - judged) * sizeof *region->judged);
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    const CwTet *tet = &mesh->tet[t];
    double centre[3];
    cw_tet_prefetch_ahead(tet);
    if (tet->corner[0] < 0) continue;
    uint32_t print = print_of(tet);
    if (region->judged[t] == print) continue;
    region->judged[t] = print;
    int enclosing = 0;
    for (int i = 0; i < 4; i++) enclosing |= tet->corner[i] < CW_ENCLOSING_POINTS;
    double need = enclosing ? 0 : need_of(from, bounds, mesh, tet, centre);
    if (!(need > 1)) continue;
    int class = (int)fmin(CLASSES_OCTAVE * log2(need), CLASSES - 1);
    CW_GROW(*record, *space, *count + 1);
    (*record)[(*count)++] = (CwRadix){(uint64_t)(CLASSES - 1 - class) << 32 | (uint32_t)t, t, (int32_t)print};
  }
  CW_TRY(cw_radix_sort(*count, *record));
done:
  return status;
}

// The spheres of the interfaces as they are now, and nothing asked for. What was put aside is to be tried again.
static CwStatus begin_round(int32_t count, const CwChewInterface *interface, CwChewRegion *region) {
  CwStatus status = CW_OK;
  region->sphere_count = region->asked_count = 0;
  for (int32_t i = 0; i < count; i++) {
    if (interface[i].region[0] != region->region && interface[i].region[1] != region->region) continue;
    CW_TRY(cw_chew_interface_spheres(&interface[i], i, &region->sphere, &region->sphere_count, &region->sphere_space));
  }
  free(region->sphere_asked);
  region->sphere_asked = NULL;
  CW_NEW(region->sphere_asked, region->sphere_count);
  cw_box_tree_free(&region->spheres);
  if (region->sphere_count) {
    CwBox within = box_of_all(region->sphere_count, box_of_sphere, region->sphere);
    CW_TRY(cw_box_tree_make(NULL, region->sphere_count, &within, box_of_sphere, region->sphere, &region->spheres));
  }
  for (int32_t k = 0; k < region->deferred_count; k++) {
    const CwChewTet *tet = &region->deferred[k];
    if (region->judged[tet->tet] == tet->print) region->judged[tet->tet] = 0;
  }
  region->deferred_count = 0;
done:
  return status;
}

CwStatus cw_chew_region_refine(const CwRegionInput *from, const CwChewBounds *bounds, int32_t count,
                               const CwChewInterface *interface, CwChewRegion *region) {
  CwStatus status = CW_OK;
  CwRadix *record = NULL;
  int32_t records = 0, space = 0;
  CW_TRY(begin_round(count, interface, region));
  for (;;) {
    CW_TRY(collect(from, bounds, region, &space, &record, &records));
    if (records == 0) break;
    for (int32_t k = 0; k < records; k++) {
      CwChewTet tet = {record[k].item, (uint32_t)record[k].tag};
      double centre[3];
      const CwTet *at = &region->mesh.tet[tet.tet];
      if (at->corner[0] < 0 || print_of(at) != tet.print) continue;
      if (need_of(from, bounds, &region->mesh, at, centre) > 1)
        CW_TRY(try_centre(from, interface, centre, tet, region));
    }
  }
done:
  free(record);
  return status;
}
