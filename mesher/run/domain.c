// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/domain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/cad/background_tessellate.h"
#include "mesher/common/model_unit.h"
#include "mesher/common/vec.h"
#include "mesher/thickness/even_columns.h"
#include "mesher/thickness/layer_count.h"
#include "mesher/thickness/layer_thickness.h"
#include "mesher/layers/bare_faces.h"
#include "mesher/layers/thickness_gradation.h"
#include "mesher/layers/thin_prism.h"
#include "mesher/parallel/parallel_for.h"
#include "mesher/plan/plan_make.h"
#include "mesher/plan/sector_plan.h"
#include "mesher/policy.h"
#include "mesher/region/region_number.h"
#include "pipeline/log.h"

static const double FIRST_HEIGHT_TOLERANCE = 0.1;
static const double SAMPLE_STEP = 1.02;     // ratio of sizes of wall that count together
static const double SEED_AREA = 0.25;       // of base sizes squared, that takes as long to seed as a triangle by itself
static const double MORE_SEEDS = 0.12;      // of the triangles: as many take as long as edges or lines
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

// A background triangle.
typedef struct {
  double area, size;
} WallPiece;

static CwStatus find_piece(void *context, int32_t t, void *out) {
  const CwDomain *domain = context;
  WallPiece *piece = out;
  double centre[3];
  piece->area = triangle_area(&domain->background, t, centre);
  piece->size = cw_size_at(domain->size, centre);
  return CW_OK;
}

static CwStatus find_line(void *context, int32_t line, void *out) {
  const CwDomain *domain = context;
  *(double *)out = cw_size_line_integral(domain->size, line);
  return CW_OK;
}

// What a face is to have in triangles, and of walls pieces of one patch and nearly one size together.
static CwStatus sum_pieces(CwDomain *domain, const WallPiece *piece) {
  CwStatus status = CW_OK;
  const CwBackground *background = &domain->background;
  CwLayerSample *sample = NULL;
  double least = INFINITY, greatest = 0;
  CW_NEW(domain->face_triangles, cw_cad_face_count(domain->cad));
  for (int32_t t = 0; t < background->triangle_count; t++) {
    domain->face_triangles[background->face[t]] += piece[t].area / (piece[t].size * piece[t].size);
    if (!cw_cad_face_is_wall(domain->cad, background->face[t])) continue;
    least = fmin(least, piece[t].size);
    greatest = fmax(greatest, piece[t].size);
  }
  int patches = cw_cad_patch_count(domain->cad);
  int steps = greatest > 0 ? 1 + (int)(log(greatest / least) / log(SAMPLE_STEP)) : 0;
  CW_NEW(sample, (size_t)patches * (size_t)steps);
  for (int32_t t = 0; t < background->triangle_count; t++) {
    double h = piece[t].size;
    if (!cw_cad_face_is_wall(domain->cad, background->face[t])) continue;
    int patch = cw_cad_face_patch(domain->cad, background->face[t]);
    CwLayerSample *of = &sample[patch * steps + (int)(log(h / least) / log(SAMPLE_STEP))];
    domain->prism_integral += piece[t].area / (h * h);
    of->density += piece[t].area / (h * h * h);
    of->size += piece[t].area / (h * h); // times the density
    of->patch = patch;
  }
  CW_NEW(domain->layer_sample, (size_t)patches * (size_t)steps);
  for (int i = 0; i < patches * steps; i++) {
    if (sample[i].density == 0) continue;
    sample[i].size /= sample[i].density;
    domain->layer_sample[domain->layer_sample_count++] = sample[i];
  }
done:
  free(sample);
  return status;
}

// What the count of cells follows from: integrals of the size field at a scale, for sizes over that, over walls and
// volume. Collective.
static CwStatus integrate(CwDomain *domain, double scale) {
  CwStatus status = CW_OK;
  WallPiece *piece = NULL;
  double *along = NULL;
  int32_t lines = cw_size_line_count(domain->size);
  free(domain->face_triangles);
  free(domain->layer_sample);
  domain->face_triangles = NULL;
  domain->layer_sample = NULL;
  domain->layer_sample_count = 0;
  domain->prism_integral = domain->volume_integral = 0;
  cw_size_set_scale(domain->size, scale);
  CW_NEW(piece, domain->background.triangle_count);
  CW_NEW(along, lines);
  CW_TRY(
      cw_parallel_for("size integrals", domain->background.triangle_count, sizeof *piece, find_piece, domain, piece));
  for (int32_t t = 0; t < domain->background.triangle_count; t++) piece[t].size /= scale;
  CW_TRY(sum_pieces(domain, piece));
  CW_TRY(cw_parallel_for("size integrals", lines, sizeof *along, find_line, domain, along));
  for (int32_t i = 0; i < lines; i++) domain->volume_integral += along[i] * scale * scale * scale;
done:
  free(piece);
  free(along);
  return status;
}

double cw_domain_tet_integral(const CwDomain *domain, double scale) {
  double layers = 0;
  for (int32_t i = 0; i < domain->layer_sample_count; i++) {
    const CwLayerSample *sample = &domain->layer_sample[i];
    const CwLayerTarget *target = &domain->patch_layers[sample->patch];
    layers += sample->density * cw_column_thickness_flat(target, domain->layer_count, scale * sample->size);
  }
  layers *= domain->layer_share;
  // In narrow places the layers give way: never less than a tenth is left to the tetrahedra.
  return fmax(domain->volume_integral - layers, 0.1 * domain->volume_integral);
}

CwStatus cw_domain_open(CwDomain *domain, const CwModel *model, int number, const char *geometry_dir) {
  CwStatus status = CW_OK;
  const CwModelDomain *of = &model->domain[number];
  memset(domain, 0, sizeof *domain);
  domain->name = of->name;
  domain->patch = &model->patch[of->first_patch];
  CW_TRY(cw_cad_open(geometry_dir, of->name, &domain->cad));
  CW_REQUIRE(cw_cad_patch_count(domain->cad) == of->patch_count, CW_ERR_INPUT,
             "%s: %s has %d patches in faces.csv and %d in model.json", geometry_dir, of->name,
             cw_cad_patch_count(domain->cad), of->patch_count);
  for (int p = 0; p < of->patch_count; p++)
    CW_REQUIRE(!strcmp(cw_cad_patch_name(domain->cad, p), domain->patch[p].name) &&
                   cw_cad_patch_kind(domain->cad, p) == domain->patch[p].kind,
               CW_ERR_INPUT, "%s: patch %d of %s is '%s', %s, in faces.csv and '%s', %s, in model.json", geometry_dir,
               p + 1, of->name, cw_cad_patch_name(domain->cad, p),
               cw_patch_kind_name(cw_cad_patch_kind(domain->cad, p)), domain->patch[p].name,
               cw_patch_kind_name(domain->patch[p].kind));
done:
  return status;
}

CwStatus cw_domain_ask(CwDomain *domain, const CwCase *table) {
  CwStatus status = CW_OK;
  int patches = cw_cad_patch_count(domain->cad);
  domain->layer_share = CW_LAYER_SHARE;
  CW_NEW(domain->patch_target, patches);
  CW_NEW(domain->relative_size, patches);
  CW_NEW(domain->patch_layers, patches);
  for (int p = 0; p < patches; p++) {
    domain->patch_target[p] = cw_patch_target(table, &domain->patch[p]);
    domain->relative_size[p] = domain->patch_target[p].relative_size;
  }
  cw_domain_set_layers(domain, table, table->walls.layer_count > 0 ? table->walls.layer_count : CW_LAYERS_LEAST,
                       CW_LOG_LAYER_Y_PLUS);
done:
  return status;
}

void cw_domain_set_layers(CwDomain *domain, const CwCase *table, int layer_count, double y_plus_auto) {
  domain->layer_count = layer_count;
  for (int p = 0; p < cw_cad_patch_count(domain->cad); p++) {
    if (cw_cad_patch_kind(domain->cad, p) != CW_PATCH_WALL) continue;
    CwPatchTarget *target = &domain->patch_target[p];
    target->first = cw_first_height_choose(table, &target->walls, &target->flow, y_plus_auto, layer_count);
    domain->patch_layers[p] = cw_layer_target(table, &target->walls, target->first.height, layer_count);
    domain->patch_layers[p].first_height /= cw_model_unit();
    domain->patch_layers[p].thickness /= cw_model_unit();
  }
}

void cw_domain_layers_needed(const CwDomain *domain, double scale, double *needing) {
  for (int32_t i = 0; i < domain->layer_sample_count; i++) {
    const CwLayerSample *sample = &domain->layer_sample[i];
    const CwLayerTarget *layers = &domain->patch_layers[sample->patch];
    double room = cw_column_room(&domain->patch_target[sample->patch].flow) / cw_model_unit();
    int fitting = cw_layer_count_fitting(layers->first_height, layers->growth, room);
    int count = cw_layer_count(layers->first_height, layers->growth, scale * sample->size);
    needing[(int)fmax(fmin(count, fitting), CW_LAYERS_LEAST)] += sample->density * sample->size;
  }
}

CwStatus cw_domain_start_background(CwDomain *domain, double deflection) {
  return cw_tessellation_start(domain->cad, deflection, DEFLECTION_ANGLE, &domain->tessellation);
}

double cw_domain_background_cost(const CwDomain *domain, int face) {
  return cw_tessellation_cost(domain->tessellation, face);
}

CwStatus cw_domain_background_face(const CwDomain *domain, int face, void **bytes, int64_t *byte_count) {
  return cw_tessellation_face(domain->tessellation, face, bytes, byte_count);
}

CwStatus cw_domain_take_background(CwDomain *domain, void *const *bytes) {
  CwStatus status = CW_OK;
  cw_tessellation_free(&domain->tessellation);
  CW_TRY(cw_background_join(domain->cad, bytes, &domain->background));
  CW_TRY(cw_inside_make(domain->background.point_count, (const double(*)[3])domain->background.x,
                        domain->background.triangle_count, (const int32_t(*)[3])domain->background.triangle,
                        &domain->inside));
done:
  return status;
}

CwStatus cw_domain_leave_bare(CwDomain *domain) {
  CwStatus status = CW_OK;
  const CwBackground *background = &domain->background;
  CwBareFaces bare;
  double *area = NULL, centre[3], walls = 0, without = 0;
  CW_NEW(area, cw_cad_face_count(domain->cad));
  for (int32_t t = 0; t < background->triangle_count; t++) {
    double of = triangle_area(background, t, centre);
    area[background->face[t]] += of;
    if (cw_cad_face_is_wall(domain->cad, background->face[t])) walls += of;
  }
  CW_TRY(cw_bare_faces_find(domain->cad, area, &bare));
  if (bare.count == 0) goto done;
  for (int f = 0; f < cw_cad_face_count(domain->cad); f++)
    if (cw_cad_face_is_wall(domain->cad, f)) without += area[f];
  cw_log_warn("%s: %d faces, %.2g %% of the wall, carry no layers: no direction sees all faces about a corner or an "
              "edge of theirs and lies in the open faces there, first at (%.6g, %.6g, %.6g) mm of face '%s'",
              domain->name, bare.count, 100 * (walls - without) / walls, CW_MM(bare.at),
              cw_cad_face_name(domain->cad, bare.first));
done:
  free(area);
  return status;
}

void cw_domain_seed_costs(const CwDomain *domain, double *cost) {
  const CwBackground *background = &domain->background;
  int faces = cw_cad_face_count(domain->cad);
  double centre[3], area = SEED_AREA * domain->base_size * domain->base_size;
  for (int32_t t = 0; t < background->triangle_count; t++)
    cost[background->face[t]] += 1 + triangle_area(background, t, centre) / area;
  for (int i = faces; i < cw_size_seed_parts(domain->cad); i++) cost[i] = MORE_SEEDS * background->triangle_count;
}

CwStatus cw_domain_seed(CwDomain *domain, const CwCase *table, int part, void **bytes, int64_t *byte_count) {
  CwStatus status = CW_OK;
  if (!domain->seeds) {
    CW_TRY(cw_size_seeds_start(domain->cad, &domain->background, &table->mesh, domain->relative_size, domain->base_size,
                               &domain->seeds));
  }
  CW_TRY(cw_size_seeds_part(domain->seeds, part, bytes, byte_count));
done:
  return status;
}

enum { SIZE_FIELDS = 2 }; // parts of the size field; volumes of faces follow

int cw_domain_size_parts(const CwDomain *domain) {
  return SIZE_FIELDS + cw_cad_face_count(domain->cad);
}

void cw_domain_size_costs(const CwDomain *domain, double *cost) {
  const CwBackground *background = &domain->background;
  for (int i = 0; i < SIZE_FIELDS; i++) cost[i] = background->triangle_count;
  for (int32_t t = 0; t < background->triangle_count; t++) cost[SIZE_FIELDS + background->face[t]]++;
}

static CwStatus measure_face(const CwDomain *domain, int face, void **bytes, int64_t *byte_count) {
  CwStatus status = CW_OK;
  double *volume;
  CW_NEW(volume, 1);
  *volume = cw_cad_face_volume(domain->cad, face);
  *bytes = volume;
  *byte_count = sizeof *volume;
done:
  return status;
}

// Longer edges make prisms of small determinant.
static double longest_on_wall(const CwDomain *domain, int patch) {
  const CwLayerTarget *layers = &domain->patch_layers[patch];
  return cw_policy.prism_longest * layers->growth * layers->first_height;
}

void cw_domain_walls_ask(const CwDomain *domain, double scale, double *wanted, double *asked) {
  for (int32_t i = 0; i < domain->layer_sample_count; i++) {
    const CwLayerSample *sample = &domain->layer_sample[i];
    double h = scale * sample->size, longest = longest_on_wall(domain, sample->patch);
    double prisms = sample->density * sample->size / (scale * scale);
    *wanted += prisms;
    *asked += prisms * fmax(1, h * h / (longest * longest));
  }
}

CwStatus cw_domain_make_size(const CwDomain *domain, const CwCase *table, double gradation, double wall_scale,
                             void *const *seeds, int part, void **bytes, int64_t *byte_count) {
  CwStatus status = CW_OK;
  CwMeshTable mesh = table->mesh;
  mesh.gradation = gradation;
  if (part >= SIZE_FIELDS) return measure_face(domain, part - SIZE_FIELDS, bytes, byte_count);
  double *open_edge = NULL, *wall = NULL; // no wall is limited where wall_scale is 0
  int patches = cw_cad_patch_count(domain->cad);
  CW_NEW(open_edge, patches);
  if (wall_scale > 0) CW_NEW(wall, patches);
  for (int p = 0; p < patches; p++) {
    open_edge[p] = cw_policy.prism_longest_open * domain->patch_layers[p].first_height;
    if (wall) wall[p] = longest_on_wall(domain, p) / wall_scale;
  }
  CwSizeLimits limits = {open_edge, wall, table->mesh.gradation / gradation};
  CW_TRY(cw_size_make(domain->cad, &domain->background, &mesh, domain->relative_size, domain->base_size, &limits, seeds,
                      (CwSizePart)part, bytes, byte_count));
done:
  free(open_edge);
  free(wall);
  return status;
}

CwStatus cw_domain_take_size(CwDomain *domain, void **bytes) {
  CwStatus status = CW_OK;
  CwSize *open_edges = NULL;
  cw_size_seeds_free(&domain->seeds);
  CW_TRY(cw_size_unpack(&bytes[0], &domain->size));
  CW_TRY(cw_size_unpack(&bytes[1], &open_edges));
  cw_size_join(domain->size, &open_edges);
  domain->solid_volume = 0;
  for (int i = SIZE_FIELDS; i < cw_domain_size_parts(domain); i++) domain->solid_volume += *(const double *)bytes[i];
  CW_REQUIRE(domain->solid_volume > 0, CW_ERR_INPUT, "%s: the solid has no volume", domain->name);
  CW_TRY(integrate(domain, 1));
done:
  cw_size_free(&open_edges);
  return status;
}

CwStatus cw_domain_take_field(CwDomain *domain, double scale, void **bytes) {
  CwStatus status = CW_OK;
  CwSize *field = NULL;
  CW_TRY(cw_size_unpack(bytes, &field));
  cw_size_join(field, &domain->size);
  domain->size = field;
  CW_TRY(integrate(domain, scale));
done:
  return status;
}

// Cells a region. With more than some 140 regions in all a partition plane finds no good place in narrow parts, such as
// beside the tongue, while memory never asks for so many.
static double cells_per_region(const CwCase *table) {
  if (table->mesh.cells_per_region > 0) return (double)table->mesh.cells_per_region;
  return fmax(cw_policy.region_cells, (double)table->mesh.cells / cw_policy.regions_most);
}

// True where all faces that turns bring to themselves lie on the side of the pipe: regions of the sectors are copied
// with their faces.
static int fixed_faces_fit(const CwDomain *domain, const CwPlan *plan) {
  const CwBackground *background = &domain->background;
  for (int32_t t = 0; t < background->triangle_count; t++) {
    if (domain->symmetry->face.next[background->face[t]] != background->face[t]) continue;
    for (int k = 0; k < 3; k++) {
      if (cw_plane_distance(&plan->node[0].plane, background->x[background->triangle[t][k]]) > 0) return 0;
    }
  }
  return 1;
}

int cw_domain_least_regions(const CwCase *table, double cells) {
  return (int)fmin(table->mesh.least_regions,
                   fmax(cw_policy.regions_free, floor(cells / cw_policy.region_cells_fewest)));
}

CwStatus cw_domain_plan(CwDomain *domain, const CwCase *table, double cells, double prism_factor, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwPlan plan = {0};
  double regions = fmax(ceil(cells / cells_per_region(table)), cw_domain_least_regions(table, cells));
  double *thickness = NULL, *least = NULL;
  CW_NEW(thickness, cw_cad_patch_count(domain->cad));
  CW_NEW(least, cw_cad_patch_count(domain->cad));
  for (int p = 0; p < cw_cad_patch_count(domain->cad); p++) {
    if (cw_cad_patch_kind(domain->cad, p) != CW_PATCH_WALL) continue;
    thickness[p] = domain->patch_layers[p].thickness;
    least[p] = cw_column_thickness_least(domain->patch_layers[p].first_height, domain->layer_count);
  }
  CwPlanOptions options = {.region_count =
                               domain->more_regions == CW_UNDIVIDED ? 1 : (int32_t)regions + domain->more_regions,
                           .thickness = thickness,
                           .least_thickness = least,
                           .tallest = cw_policy.tallest_column,
                           .base_size = domain->base_size,
                           .prism_factor = prism_factor};
  status = domain->symmetry
               ? cw_sector_plan_make(domain->cad, &domain->background, domain->inside, domain->size, &options,
                                     domain->symmetry->count, &plan, outcome)
               : cw_plan_make(domain->cad, &domain->background, domain->inside, domain->size, &options, &plan);
  CW_TRY_STAGE(status, outcome);
  CW_END_UNLESS(!domain->symmetry || fixed_faces_fit(domain, &plan), outcome, CW_OUTCOME_ASYMMETRIC, NULL,
                "a face round the axis lies on the side of the passages");
  cw_plan_free(&domain->plan);
  domain->plan = plan;
  plan = (CwPlan){0};
done:
  cw_plan_free(&plan);
  free(thickness);
  free(least);
  return status;
}

CwStatus cw_domain_start(CwDomain *domain, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwBoundary *boundary = &domain->boundary;
  cw_domain_clear(domain);
  boundary->cad = domain->cad;
  boundary->plan = &domain->plan;
  boundary->size_at = cw_size_at;
  boundary->size = domain->size;
  int patches = cw_cad_patch_count(domain->cad);
  CW_NEW(boundary->largest, patches);
  for (int p = 0; p < patches; p++)
    boundary->largest[p] = cw_policy.prism_largest / cw_policy.prism_longest * longest_on_wall(domain, p);
  CW_TRY_STAGE(
      cw_network_make(domain->cad, &domain->background, domain->inside, &domain->plan, &boundary->network, outcome),
      outcome);
  boundary->images.symmetry = domain->symmetry;
  if (domain->symmetry) CW_TRY(cw_periodic_images_make(&boundary->network, &boundary->images, outcome));
done:
  return status;
}

CwStatus cw_domain_targets(CwDomain *domain) {
  CwStatus status = CW_OK;
  const CwBoundary *boundary = &domain->boundary;
  CwLayerTarget *layers = NULL; // of each face
  CwIncident around = {0};
  int faces = cw_cad_face_count(domain->cad);
  CW_NEW(layers, faces);
  for (int f = 0; f < faces; f++) layers[f] = domain->patch_layers[cw_cad_face_patch(domain->cad, f)];
  CW_TRY(cw_incident_make(boundary->surface.vertex_count, boundary->surface.triangle_count,
                          (const int32_t(*)[3])boundary->surface.triangle, &around));
  CW_TRY(cw_column_targets_make(boundary, &around, layers, domain->layer_count, &domain->targets));
  CW_TRY(cw_column_targets_share(&domain->targets, boundary, &around, layers, &domain->layer_share));
done:
  cw_incident_free(&around);
  free(layers);
  return status;
}

CwStatus cw_domain_number(CwDomain *domain) {
  CwStatus status = CW_OK;
  CW_TRY(cw_boundary_adjacency(&domain->boundary, &domain->pair_count, &domain->pair));
  CW_NEW(domain->number, domain->plan.region_count);
  CW_TRY(cw_region_numbers(domain->plan.region_count, domain->pair_count, (const int32_t(*)[2])domain->pair,
                           domain->number, NULL, &domain->colours));
done:
  return status;
}

CwStatus cw_domain_share(CwDomain *domain, const CwCase *table) {
  CwStatus status = CW_OK;
  domain->context = (CwRegionContext){.boundary = &domain->boundary,
                                      .domain = domain->name,
                                      .layer_count = domain->layer_count,
                                      .growth = domain->targets.growth,
                                      .fill = table->mesh.fill,
                                      .first_height = domain->targets.first_made};
  CW_TRY(cw_region_context_make(&domain->context));
done:
  return status;
}

// Adds the prisms over a wall triangle that are thin for their length, or sheared: of small determinants.
static void count_thin(const CwBoundary *boundary, int32_t t, const CwColumnTargets *targets, CwLayerCoverage *of) {
  const int32_t *corner = boundary->layers.triangle[t];
  double determinant[CW_LAYERS_MOST], first[3];
  for (int k = 0; k < 3; k++) first[k] = targets->first_made[corner[k]];
  cw_column_determinants(targets, boundary, t, first, determinant);
  for (int k = 0; k < targets->layer_count; k++) {
    if (determinant[k] >= CW_SMALL_DETERMINANT) continue;
    double wanted = cw_thin_prism_wanted(determinant[k]);
    of->thin++;
    if (wanted <= of->thin_wanted) continue;
    of->thin_wanted = wanted;
    cw_copy(boundary->surface.x[corner[0]], of->thin_at);
  }
}

void cw_domain_coverage(const CwDomain *domain, int32_t region, int patches, CwLayerCoverage *coverage) {
  const CwBoundary *boundary = &domain->boundary;
  const CwColumnTargets *targets = &domain->targets;
  double fraction[CW_LAYERS_MOST + 1];
  for (int32_t i = boundary->surface.region_start[region]; i < boundary->surface.region_start[region + 1]; i++) {
    int32_t t = boundary->surface.region_triangle[i];
    int patch = cw_cad_face_patch(domain->cad, boundary->surface.face[t]);
    if (patch >= patches) continue;
    CwLayerCoverage *of = &coverage[patch];
    int full = 1, met = 1, worst = 0;
    for (int k = 0; k < 3; k++) {
      int32_t v = boundary->layers.triangle[t][k];
      double thickness = boundary->layers.thickness[v];
      double wanted = targets->first_height[v];
      double first =
          cw_layer_fractions(thickness, targets->first_made[v], targets->layer_count, targets->growth[v], fraction);
      full &= thickness >= 0.99 * targets->target[v];
      met &= fabs(first / wanted - 1) <= FIRST_HEIGHT_TOLERANCE;
      if (boundary->layers.reason[v] > worst) worst = boundary->layers.reason[v];
      of->thickness += thickness / 3;
      of->least = of->faces == 0 && k == 0 ? thickness : fmin(of->least, thickness);
    }
    of->faces++;
    of->full += full;
    of->first_met += met;
    of->reason[full ? 0 : worst]++;
    if (!met) of->missed[worst]++;
    count_thin(boundary, t, targets, of);
  }
}

void cw_domain_clear(CwDomain *domain) {
  cw_region_context_free(&domain->context);
  cw_boundary_free(&domain->boundary);
  cw_column_targets_free(&domain->targets);
  free(domain->number);
  free(domain->pair);
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
  cw_tessellation_free(&domain->tessellation);
  cw_background_free(&domain->background);
  cw_cad_close(&domain->cad);
  free(domain->layer_sample);
  free(domain->face_triangles);
  free(domain->patch_target);
  free(domain->relative_size);
  free(domain->patch_layers);
}
