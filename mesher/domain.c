// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/domain.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/fan.h"
#include "mesher/layer_heights.h"
#include "mesher/layers.h"
#include "mesher/region_number.h"
#include "mesher/share.h"
#include "mesher/vec.h"

static const double TALLEST_COLUMN = 2.5; // of the edge length on the wall
static const double TALLER_COLUMN = 3.25; // the same where the last layer would else be lower than LOW_LAST
static const double TALLEST_AT_BEND = 2;  // both where the wall bends from triangle to triangle: there columns crowd
static const double BEND = 0.94;          // least cosine of the normals about a vertex on a wall that is as good as flat
static const double HOLLOW = 0.25;        // least rise of an edge over its length at a bend that is concave
static const double LAST_LAYER = 1.0;     // its height over that of a regular tetrahedron above, at most
static const double LOW_LAST = 0.75;      // the same where columns are at their tallest
static const double LAST_IN_HOLLOW = 0.65; // the same at concave bends, times their cosine: tetrahedra there have two faces on
                                           // the front, and are the flatter the sharper the bend is
static const double FIRST_HEIGHT_TOLERANCE = 0.1;
static const double REGULAR_HEIGHT = 0.816; // of a regular tetrahedron, over its edge
static const double EVEN_LAYERS = 1.05; // of count times first height: hardly any growth
static const double LEAST_REGION_CELLS = 400e3, MOST_REGIONS = 140;
static const double LITTLE_GROWTH = 1.1;
static const double LONGEST_AT_RIM = 16;    // of first heights: there prisms have a side on the boundary
static const double BASE_SIZE = 2e-3;       // m: edge length at relative size 1 and scale 1
static const double DEFLECTION = 4e-5;      // m, of the background triangulation
static const double DEFLECTION_ANGLE = 0.2; // rad

static double triangle_area(const CwBackground *background, int32_t t, double centre[3]) {
  const double *a = background->x[background->triangle[t][0]], *b = background->x[background->triangle[t][1]],
               *c = background->x[background->triangle[t][2]];
  double u[3], v[3], n[3];
  cw_sub(b, a, u);
  cw_sub(c, a, v);
  cw_cross(u, v, n);
  for (int k = 0; k < 3; k++) centre[k] = (a[k] + b[k] + c[k]) / 3;
  return cw_norm(n) / 2;
}

// Of a column from `first` up to a last layer of `last`, m; no layer grows by more than `growth`.
static double column_height(double first, int count, double growth, double last) {
  if (count > 1) growth = fmin(growth, pow(fmax(last / first, 1), 1.0 / (count - 1)));
  return cw_layer_thickness(first, count, growth);
}

// The tallest column that is fair below cells of the size `size`: its last layer no taller than `last` of a regular
// tetrahedron, itself no taller than `tallest` such sizes, or up to `taller` where the last layer would be low. Columns give
// up growth for it, never the first height.
static double fair_height(double first, int count, double growth, double size, double last, double tallest,
                          double taller) {
  double full = column_height(first, count, growth, last * REGULAR_HEIGHT * size);
  double low = column_height(first, count, growth, fmin(last, LOW_LAST) * REGULAR_HEIGHT * size);
  double most = fmax(tallest * size, fmin(low, taller * size));
  return fmax(EVEN_LAYERS * count * first, fmin(most, full));
}

static const double HEIGHT_SLOPE = 0.3; // heights of columns change by no more per distance (layers_gap)

// What the count of cells follows from: integrals of the size field at scale 1 over walls and volume.
static CwStatus integrate(CwDomain *domain) {
  CwStatus status = CW_OK;
  double(*x)[3] = NULL, *volume = NULL;
  int32_t count = 0;
  CW_NEW(domain->layer_sample, domain->background.triangle_count);
  for (int32_t t = 0; t < domain->background.triangle_count; t++) {
    int32_t face = domain->background.face[t];
    if (!cw_face_is_wall(domain->cad, face)) continue;
    double centre[3], area = triangle_area(&domain->background, t, centre), h = cw_size_at(domain->size, centre);
    int patch = cw_cad_face_patch(domain->cad, face);
    domain->prism_integral += area / (h * h);
    domain->layer_sample[domain->layer_sample_count++] = (CwLayerSample){area / (h * h * h), h, patch};
  }
  CW_TRY(cw_size_samples(domain->size, &count, &x, &volume));
  for (int32_t i = 0; i < count; i++) {
    double h = cw_size_at(domain->size, x[i]);
    domain->volume_integral += volume[i] / (h * h * h);
  }
done:
  free(x);
  free(volume);
  return status;
}

double cw_domain_tet_integral(const CwDomain *domain, double scale) {
  double layers = 0;
  for (int32_t i = 0; i < domain->layer_sample_count; i++) {
    const CwLayerSample *sample = &domain->layer_sample[i];
    const CwLayerTarget *target = &domain->patch_layers[sample->patch];
    double fair = fair_height(target->first_height, domain->layer_count, target->growth, scale * sample->size,
                              LAST_LAYER, TALLEST_COLUMN, TALLER_COLUMN);
    layers += sample->density * fmin(target->thickness, fair);
  }
  layers *= domain->layer_share;
  // In narrow places the layers give way: never less than a tenth is left to the tetrahedra.
  return fmax(domain->volume_integral - layers, 0.1 * domain->volume_integral);
}

CwStatus cw_domain_open(CwDomain *domain, const char *name, const char *geometry_dir, const CwCase *table,
                        const CwFlowScales *scales) {
  CwStatus status = CW_OK;
  memset(domain, 0, sizeof *domain);
  domain->name = name;
  domain->layer_count = table->walls.layer_count;
  domain->layer_share = CW_LAYER_SHARE;
  CW_TRY(cw_cad_open(geometry_dir, name, &domain->cad));
  CW_NEW(domain->relative_size, cw_cad_patch_count(domain->cad));
  CW_NEW(domain->patch_layers, cw_cad_patch_count(domain->cad));
  cw_wall_targets(domain->cad, table, scales, domain->relative_size, domain->patch_layers);
done:
  return status;
}

CwStatus cw_domain_measure(const CwDomain *domain, int part, void **bytes, int64_t *byte_count) {
  CwStatus status = CW_OK;
  CwBackground background = {0};
  double *volume = NULL;
  if (part == 0) {
    CW_TRY(cw_background_make(domain->cad, DEFLECTION, DEFLECTION_ANGLE, &background));
    CW_TRY(cw_background_pack(&background, bytes, byte_count));
  } else {
    CW_NEW(volume, 1);
    *volume = cw_cad_volume(domain->cad);
    CW_REQUIRE(*volume > 0, CW_ERR_INPUT, "%s: the solid has no volume", domain->name);
    *bytes = volume;
    *byte_count = sizeof *volume;
    volume = NULL;
  }
done:
  free(volume);
  cw_background_free(&background);
  return status;
}

CwStatus cw_domain_take_measures(CwDomain *domain, void *const *bytes) {
  CwStatus status = CW_OK;
  CW_TRY(cw_background_unpack(bytes[0], &domain->background));
  memcpy(&domain->solid_volume, bytes[1], sizeof domain->solid_volume);
  CW_TRY(cw_inside_make(domain->background.point_count, (const double(*)[3])domain->background.x,
                        domain->background.triangle_count, (const int32_t(*)[3])domain->background.triangle,
                        &domain->inside));
done:
  return status;
}

CwStatus cw_domain_seed(CwDomain *domain, const CwCase *table, int face, void **bytes, int64_t *byte_count) {
  CwStatus status = CW_OK;
  if (!domain->seeds) {
    CW_TRY(cw_size_seeds_start(domain->cad, &domain->background, &table->mesh, domain->relative_size, BASE_SIZE,
                               &domain->seeds));
  }
  CW_TRY(cw_size_seeds_of_face(domain->seeds, face, bytes, byte_count));
done:
  return status;
}

CwStatus cw_domain_make_size(const CwDomain *domain, const CwCase *table, void *const *seeds, void **bytes,
                             int64_t *byte_count) {
  CwStatus status = CW_OK;
  CwSize *size = NULL;
  double *rim_size = NULL;
  int patches = cw_cad_patch_count(domain->cad);
  CW_NEW(rim_size, patches);
  for (int p = 0; p < patches; p++) rim_size[p] = LONGEST_AT_RIM * domain->patch_layers[p].first_height;
  CW_TRY(cw_size_make(domain->cad, &domain->background, &table->mesh, domain->relative_size, BASE_SIZE, rim_size, seeds,
                      &size));
  CW_TRY(cw_size_pack(size, bytes, byte_count));
done:
  free(rim_size);
  cw_size_free(&size);
  return status;
}

CwStatus cw_domain_take_size(CwDomain *domain, const void *bytes) {
  CwStatus status = CW_OK;
  cw_size_seeds_free(&domain->seeds);
  CW_TRY(cw_size_unpack(bytes, &domain->size));
  CW_TRY(integrate(domain));
done:
  return status;
}

// Cells a region. With more than some 140 regions in all a dividing plane finds no good place in narrow parts, such as
// beside the tongue, while memory never asks for so many.
static double cells_per_region(const CwCase *table) {
  if (table->mesh.cells_per_region > 0) return (double)table->mesh.cells_per_region;
  return fmax(LEAST_REGION_CELLS, (double)table->mesh.cells / MOST_REGIONS);
}

CwStatus cw_domain_plan(const CwDomain *domain, const CwCase *table, double cells, double prism_factor,
                        double tet_factor, void **bytes, int64_t *byte_count) {
  CwStatus status = CW_OK;
  CwPlan plan = {0};
  double regions = ceil(cells / cells_per_region(table));
  double *thickness = NULL, *least = NULL;
  CW_NEW(thickness, cw_cad_patch_count(domain->cad));
  CW_NEW(least, cw_cad_patch_count(domain->cad));
  for (int p = 0; p < cw_cad_patch_count(domain->cad); p++) {
    if (cw_cad_patch_kind(domain->cad, p) != CW_PATCH_WALL) continue;
    thickness[p] = domain->patch_layers[p].thickness;
    least[p] = EVEN_LAYERS * table->walls.layer_count * domain->patch_layers[p].first_height;
  }
  CwPlanOptions options = {.region_count = (int32_t)fmax(regions, table->mesh.least_regions),
                           .thickness = thickness,
                           .least_thickness = least,
                           .tallest = TALLEST_COLUMN,
                           .tet_factor = tet_factor,
                           .prism_factor = prism_factor};
  status = domain->symmetry ? cw_fan_plan_make(domain->cad, &domain->background, domain->inside, domain->size, &options,
                                               domain->symmetry->count, &plan)
                            : cw_plan_make(domain->cad, &domain->background, domain->inside, domain->size, &options, &plan);
  CW_TRY(status);
  CW_TRY(cw_plan_pack(&plan, bytes, byte_count));
done:
  cw_plan_free(&plan);
  free(thickness);
  free(least);
  return status;
}

// True where all faces that turns bring to themselves lie on the side of the pipe: regions of the fan are copied with
// their faces.
static int fixed_faces_fit(const CwDomain *domain) {
  const CwBackground *background = &domain->background;
  for (int32_t t = 0; t < background->triangle_count; t++) {
    if (domain->symmetry->face.next[background->face[t]] != background->face[t]) continue;
    for (int k = 0; k < 3; k++) {
      if (cw_plane_distance(&domain->plan.node[0].plane, background->x[background->triangle[t][k]]) > 0) return 0;
    }
  }
  return 1;
}

CwStatus cw_domain_take_plan(CwDomain *domain, const void *bytes) {
  CwStatus status = CW_OK;
  CwNetwork network = {0};
  CwSkeletonOrbits orbits = {.symmetry = domain->symmetry};
  cw_plan_free(&domain->plan);
  CW_TRY(cw_plan_unpack(bytes, &domain->plan));
  if (!domain->symmetry) goto done;
  if (fixed_faces_fit(domain)) {
    status = cw_network_make(domain->cad, &domain->background, domain->inside, &domain->plan, &network);
    if (status == CW_OK) status = cw_orbit_network(&network, &orbits);
  } else {
    status = CW_FAIL(CW_RETRY, "a face round the axis lies on the side of the passages");
  }
  if (status == CW_OK) goto done;
  cw_plan_free(&domain->plan);
  if (status == CW_ERR_MESH) status = CW_RETRY; // a half-plane grazes something; planes of the other kind may not
done:
  cw_orbit_free(&orbits);
  cw_network_free(&network);
  return status;
}

CwStatus cw_domain_start(CwDomain *domain) {
  CwStatus status = CW_OK;
  CwSkeleton *skeleton = &domain->skeleton;
  cw_domain_clear(domain);
  skeleton->cad = domain->cad;
  skeleton->plan = &domain->plan;
  skeleton->size_at = cw_size_at;
  skeleton->size = domain->size;
  CW_TRY(cw_network_make(domain->cad, &domain->background, domain->inside, &domain->plan, &skeleton->network));
  skeleton->orbits.symmetry = domain->symmetry;
  if (domain->symmetry) CW_TRY(cw_orbit_network(&skeleton->network, &skeleton->orbits));
done:
  return status;
}

// How the wall lies about a vertex.
typedef struct {
  double normal[3]; // mean of the triangles, out of the domain
  double cosine;    // least, of their normals to it
  double rise;      // greatest, of the edges against it, over their lengths: above 0 in a hollow
} Bend;

// Whether all corners are turned copies, which get the heights of their first.
static int is_copy(const CwSkeleton *skeleton, const int32_t corner[3]) {
  const CwSkeletonOrbits *orbits = &skeleton->orbits;
  return cw_orbit_node_turns(orbits, corner[0]) > 0 && cw_orbit_node_turns(orbits, corner[1]) > 0 &&
         cw_orbit_node_turns(orbits, corner[2]) > 0;
}

// Of all vertices but turned copies.
static CwStatus find_bends(const CwSkeleton *skeleton, Bend **bend) {
  CwStatus status = CW_OK;
  double(*normal)[3] = NULL;
  CW_NEW(*bend, skeleton->wall_count);
  CW_NEW(normal, skeleton->wall_triangle_count);
  for (int32_t t = 0; t < skeleton->wall_triangle_count; t++) {
    const int32_t *corner = skeleton->wall_triangle[t];
    double u[3], v[3];
    if (is_copy(skeleton, corner)) continue;
    cw_sub(skeleton->wall_x[corner[1]], skeleton->wall_x[corner[0]], u);
    cw_sub(skeleton->wall_x[corner[2]], skeleton->wall_x[corner[0]], v);
    cw_cross(u, v, normal[t]);
    cw_unit(normal[t]);
    for (int k = 0; k < 3; k++) {
      for (int c = 0; c < 3; c++) (*bend)[corner[k]].normal[c] += normal[t][c];
    }
  }
  for (int32_t v = 0; v < skeleton->wall_count; v++) {
    (*bend)[v].cosine = 1, (*bend)[v].rise = -1;
    cw_unit((*bend)[v].normal);
  }
  for (int32_t t = 0; t < skeleton->wall_triangle_count; t++) {
    const int32_t *corner = skeleton->wall_triangle[t];
    for (int k = 0; k < 3 && !is_copy(skeleton, corner); k++) {
      Bend *at = &(*bend)[corner[k]], *next = &(*bend)[corner[(k + 1) % 3]];
      double edge[3], cosine = cw_dot(normal[t], at->normal);
      if (cosine < at->cosine) at->cosine = cosine;
      cw_sub(skeleton->wall_x[corner[k]], skeleton->wall_x[corner[(k + 1) % 3]], edge);
      cw_unit(edge);
      double rise = cw_dot(edge, at->normal), other = -cw_dot(edge, next->normal);
      if (rise > at->rise) at->rise = rise;
      if (other > next->rise) next->rise = other;
    }
  }
done:
  free(normal);
  return status;
}

// The height of a column that is fair by the cells around it. The tetrahedron on it stands at the end of the column, where the size is
// another than at the wall: the height is reckoned twice. Nowhere grow sizes faster than heights.
static double fair_target(const CwDomain *domain, int32_t v, const Bend *bend) {
  const double *x = domain->skeleton.wall_x[v];
  int bent = bend->cosine < BEND, count = domain->layer_count;
  double last = bent && bend->rise > HOLLOW ? LAST_IN_HOLLOW * bend->cosine : LAST_LAYER;
  double size = cw_size_at(domain->size, x), height = 0;
  for (int pass = 0; pass < 2; pass++) {
    double end[3];
    for (int k = 0; k < 3; k++) end[k] = x[k] - height * bend->normal[k];
    double above = fmin(fmax(size, cw_size_at(domain->size, end)), size + HEIGHT_SLOPE * height);
    height = fair_height(domain->first_height[v], count, domain->growth[v], above, last,
                         bent ? TALLEST_AT_BEND : TALLEST_COLUMN, bent ? TALLEST_AT_BEND : TALLER_COLUMN);
  }
  return height;
}

// Lowers the values at wall vertices until they change by no more than `slope` per distance along any edge: over all
// triangles, forth and back by turns; after the first time over those alone where something has changed since.
static CwStatus grade(const CwSkeleton *skeleton, double slope, double *value) {
  CwStatus status = CW_OK;
  int32_t *changed = NULL; // the sweep in which each vertex was lowered last
  CW_NEW(changed, skeleton->wall_count);
  for (int32_t sweep = 1, lowered = 1; lowered; sweep++) {
    lowered = 0;
    for (int32_t i = 0; i < skeleton->wall_triangle_count; i++) {
      const int32_t *corner = skeleton->wall_triangle[sweep % 2 ? i : skeleton->wall_triangle_count - 1 - i];
      int32_t last = changed[corner[0]] > changed[corner[1]] ? changed[corner[0]] : changed[corner[1]];
      if (changed[corner[2]] > last) last = changed[corner[2]];
      if (sweep > 1 && last < sweep - 1) continue;
      for (int k = 0; k < 3; k++) {
        int32_t a = corner[k], b = corner[(k + 1) % 3];
        if (value[a] == value[b]) continue;
        int32_t low = value[a] < value[b] ? a : b, high = low == a ? b : a;
        double most = value[low] + slope * cw_distance(skeleton->wall_x[a], skeleton->wall_x[b]);
        if (value[high] <= most) continue;
        value[high] = most;
        changed[high] = sweep;
        lowered = 1;
      }
    }
  }
done:
  free(changed);
  return status;
}

// What a wall triangle takes of the volume, and what was predicted for it, in cells; with its turned copies.
typedef struct {
  double taken, predicted;
} Taken;

typedef struct {
  CwDomain *domain;
  const double *height;
  const Bend *bend;
} Columns;

static CwStatus find_taken(void *context, int32_t t, void *out) {
  const Columns *columns = context;
  const CwDomain *domain = columns->domain;
  const CwSkeleton *skeleton = &domain->skeleton;
  const int32_t *corner = skeleton->wall_triangle[t], face = skeleton->wall_face[t];
  const CwLayerTarget *layers = &domain->patch_layers[cw_cad_face_patch(domain->cad, face)];
  double u[3], v[3], normal[3], centre[3], mean = 0;
  if (skeleton->wall_source[t] != t) return CW_OK;
  for (int k = 0; k < 3; k++) {
    u[k] = skeleton->wall_x[corner[1]][k] - skeleton->wall_x[corner[0]][k];
    v[k] = skeleton->wall_x[corner[2]][k] - skeleton->wall_x[corner[0]][k];
    centre[k] = skeleton->wall_x[corner[0]][k] + (u[k] + v[k]) / 3;
    mean += columns->height[corner[k]] / 3;
  }
  cw_cross(u, v, normal);
  double h = cw_size_at(domain->size, centre);
  double weight = cw_norm(normal) / (h * h * h) * cw_orbit_face_copies(&skeleton->orbits, face);
  double fair = fair_height(layers->first_height, domain->layer_count, layers->growth, h, LAST_LAYER,
                            TALLEST_COLUMN, TALLER_COLUMN);
  *(Taken *)out = (Taken){weight * mean, weight * fmin(layers->thickness, fair)};
  return CW_OK;
}

// The share of the volume predicted for the layers (in cells) that columns take once their heights are graded.
static CwStatus learn_share(CwDomain *domain) {
  CwStatus status = CW_OK;
  const CwSkeleton *skeleton = &domain->skeleton;
  double *height = NULL;
  Taken *of = NULL, sum = {0};
  CW_NEW(height, skeleton->wall_count);
  CW_NEW(of, skeleton->wall_triangle_count);
  memcpy(height, domain->target, (size_t)skeleton->wall_count * sizeof *height);
  CW_TRY(grade(skeleton, HEIGHT_SLOPE, height));
  Columns columns = {.domain = domain, .height = height};
  CW_TRY(cw_share("heights: volume", skeleton->wall_triangle_count, sizeof *of, find_taken, &columns, of));
  for (int32_t t = 0; t < skeleton->wall_triangle_count; t++) {
    sum.taken += of[t].taken;
    sum.predicted += of[t].predicted;
  }
  domain->layer_share = sum.predicted > 0 ? sum.taken / sum.predicted : 1;
done:
  free(height);
  free(of);
  return status;
}

// Turned copies get that of their first: the size field is
// symmetric only to within its grid.
static CwStatus find_fair(void *context, int32_t v, void *out) {
  const Columns *columns = context;
  const CwDomain *domain = columns->domain;
  if (cw_orbit_node_turns(&domain->skeleton.orbits, v) > 0) return CW_OK;
  *(double *)out = fair_target(domain, v, &columns->bend[v]);
  return CW_OK;
}

CwStatus cw_domain_targets(CwDomain *domain, const CwCase *table) {
  CwStatus status = CW_OK;
  const CwSkeleton *skeleton = &domain->skeleton;
  Bend *bend = NULL;
  double *fair = NULL;
  CW_TRY(find_bends(skeleton, &bend));
  CW_NEW(domain->first_height, skeleton->wall_count);
  CW_NEW(domain->target, skeleton->wall_count);
  CW_NEW(domain->growth, skeleton->wall_count);
  for (int32_t v = 0; v < skeleton->wall_count; v++) domain->first_height[v] = domain->target[v] = INFINITY;
  // Where patches meet, the finer one holds.
  for (int32_t t = 0; t < skeleton->wall_triangle_count; t++) {
    const CwLayerTarget *layers = &domain->patch_layers[cw_cad_face_patch(domain->cad, skeleton->wall_face[t])];
    for (int k = 0; k < 3; k++) {
      int32_t v = skeleton->wall_triangle[t][k];
      domain->first_height[v] = fmin(domain->first_height[v], layers->first_height);
      domain->target[v] = fmin(domain->target[v], layers->thickness);
      domain->growth[v] = fmax(domain->growth[v], layers->growth);
    }
  }
  // Away from there the first height grows no faster than columns whose layers grow a little can.
  CW_TRY(grade(skeleton, HEIGHT_SLOPE / cw_layer_thickness(1, table->walls.layer_count, LITTLE_GROWTH),
               domain->first_height));
  for (int32_t v = 0; v < skeleton->wall_count; v++) {
    const double *x = skeleton->wall_x[v];
    CW_REQUIRE(isfinite(domain->target[v]), CW_ERR_MESH,
               "%s: wall vertex at (%.3f, %.3f, %.3f) mm belongs to no triangle", domain->name, 1e3 * x[0],
               1e3 * x[1], 1e3 * x[2]);
  }
  Columns columns = {.domain = domain, .bend = bend};
  CW_NEW(fair, skeleton->wall_count);
  CW_TRY(cw_share("heights: fair ones", skeleton->wall_count, sizeof *fair, find_fair, &columns, fair));
  for (int32_t v = 0; v < skeleton->wall_count; v++) {
    if (cw_orbit_node_turns(&skeleton->orbits, v) == 0) domain->target[v] = fmin(domain->target[v], fair[v]);
  }
  for (int32_t v = 0; v < skeleton->wall_count; v++) {
    if (cw_orbit_node_turns(&skeleton->orbits, v) > 0) continue;
    for (int32_t at = cw_orbit_node(&skeleton->orbits, v, 1); at >= 0 && at != v; at = cw_orbit_node(&skeleton->orbits, at, 1)) {
      domain->target[at] = domain->target[v];
      domain->first_height[at] = domain->first_height[v];
      domain->growth[at] = domain->growth[v];
    }
  }
  CW_TRY(learn_share(domain));
done:
  free(bend);
  free(fair);
  return status;
}

CwStatus cw_domain_number(CwDomain *domain) {
  CwStatus status = CW_OK;
  CW_TRY(cw_skeleton_adjacency(&domain->skeleton, &domain->pair_count, &domain->pair));
  CW_NEW(domain->number, domain->plan.region_count);
  CW_TRY(cw_region_numbers(domain->plan.region_count, domain->pair_count, (const int32_t(*)[2])domain->pair,
                           domain->number, NULL, &domain->colours));
done:
  return status;
}

// How tall columns could be by the case, gaps and repair where heights rise by the slope that holds for them.
static CwStatus find_room(CwDomain *domain) {
  CwStatus status = CW_OK;
  const CwSkeleton *skeleton = &domain->skeleton;
  CW_NEW(domain->room, skeleton->wall_count);
  for (int32_t v = 0; v < skeleton->wall_count; v++) {
    int thinned = skeleton->reason[v] == CW_LAYER_GAP || skeleton->reason[v] == CW_LAYER_REPAIR;
    domain->room[v] = thinned ? skeleton->height[v]
                              : cw_layer_thickness(domain->first_height[v], domain->layer_count, domain->growth[v]);
  }
  CW_TRY(grade(skeleton, HEIGHT_SLOPE, domain->room));
done:
  return status;
}

CwStatus cw_domain_share(CwDomain *domain, const CwCase *table) {
  CwStatus status = CW_OK;
  CW_TRY(find_room(domain));
  domain->context = (CwRegionContext){.skeleton = &domain->skeleton,
                                      .domain = domain->name,
                                      .layer_count = table->walls.layer_count,
                                      .growth = domain->growth,
                                      .fill = table->mesh.fill,
                                      .first_height = domain->first_height};
  CW_TRY(cw_region_context_make(&domain->context));
done:
  return status;
}

void cw_domain_coverage(const CwDomain *domain, int32_t region, int patches, CwLayerCoverage *coverage) {
  const CwSkeleton *skeleton = &domain->skeleton;
  double fraction[CW_LAYERS_MOST + 1];
  for (int32_t i = skeleton->region_wall_start[region]; i < skeleton->region_wall_start[region + 1]; i++) {
    int32_t t = skeleton->region_wall[i];
    int patch = cw_cad_face_patch(domain->cad, skeleton->wall_face[t]);
    if (patch >= patches) continue;
    CwLayerCoverage *of = &coverage[patch];
    int full = 1, met = 1, worst = 0;
    for (int k = 0; k < 3; k++) {
      int32_t v = skeleton->wall_triangle[t][k];
      double height = skeleton->height[v];
      double first = cw_layer_fractions(height, domain->first_height[v], domain->layer_count, domain->growth[v], fraction);
      full &= height >= 0.99 * domain->target[v];
      met &= fabs(first / domain->first_height[v] - 1) <= FIRST_HEIGHT_TOLERANCE;
      if (skeleton->reason[v] > worst) worst = skeleton->reason[v];
      of->thickness += height / 3;
      of->least = of->faces == 0 && k == 0 ? height : fmin(of->least, height);
    }
    of->faces++;
    of->full += full;
    of->first_met += met;
    of->reason[full ? 0 : worst]++;
    if (!met) of->missed[worst]++;
  }
}

CwStatus cw_domain_ratio_walls(const CwDomain *domain, int32_t region, CwRatioWall **wall) {
  CwStatus status = CW_OK;
  const CwSkeleton *skeleton = &domain->skeleton;
  int32_t count = 0, layers = domain->layer_count;
  double fraction[CW_LAYERS_MOST + 1];
  CW_NEW(*wall, skeleton->region_wall_start[region + 1] - skeleton->region_wall_start[region]);
  for (int32_t i = skeleton->region_wall_start[region]; i < skeleton->region_wall_start[region + 1]; i++) {
    int32_t t = skeleton->region_wall[i];
    CwRatioWall *made = &(*wall)[count++];
    made->first = INFINITY;
    for (int k = 0; k < 3; k++) {
      int32_t v = skeleton->wall_triangle[t][k];
      cw_layer_fractions(domain->room[v], domain->first_height[v], layers, domain->growth[v], fraction);
      made->first = fmin(made->first, domain->first_height[v]);
      made->last += domain->room[v] * (1 - fraction[layers - 1]) / 3;
      made->cramped |= skeleton->reason[v] == CW_LAYER_GAP || skeleton->reason[v] == CW_LAYER_REPAIR;
    }
  }
done:
  return status;
}

void cw_domain_clear(CwDomain *domain) {
  cw_region_context_free(&domain->context);
  cw_skeleton_free(&domain->skeleton);
  free(domain->first_height);
  free(domain->target);
  free(domain->room);
  free(domain->growth);
  free(domain->number);
  free(domain->pair);
  domain->first_height = domain->target = domain->growth = NULL;
  domain->room = NULL;
  domain->number = NULL;
  domain->pair = NULL;
}

void cw_domain_close(CwDomain *domain) {
  cw_domain_clear(domain);
  cw_plan_free(&domain->plan);
  cw_size_seeds_free(&domain->seeds);
  cw_size_free(&domain->size);
  cw_symmetry_free(&domain->symmetry);
  cw_inside_free(&domain->inside);
  cw_background_free(&domain->background);
  cw_cad_close(&domain->cad);
  free(domain->layer_sample);
  free(domain->relative_size);
  free(domain->patch_layers);
}
