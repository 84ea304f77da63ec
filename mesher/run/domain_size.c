// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/domain_size.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/cad/cad_leave_out.h"
#include "mesher/common/model_unit.h"
#include "mesher/parallel/parallel_for.h"
#include "mesher/policy.h"
#include "mesher/thickness/layer_count.h"

static const double SAMPLE_STEP = 1.02; // ratio of sizes of wall that count together
static const double SEED_AREA = 0.25;   // of base sizes squared, that takes as long to seed as a triangle by itself
static const double MORE_SEEDS = 0.12;  // of the triangles: as many take as long as edges or lines

// A background triangle.
typedef struct {
  double area, size;
} WallPiece;

static CwStatus find_piece(void *context, int32_t t, void *out) {
  const CwDomain *domain = context;
  WallPiece *piece = out;
  double centre[3];
  piece->area = cw_background_area(&domain->background, t, centre);
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
    if (!cw_cad_face_is_meshed_wall(domain->cad, background->face[t])) continue;
    least = fmin(least, piece[t].size);
    greatest = fmax(greatest, piece[t].size);
  }
  int patches = cw_cad_patch_count(domain->cad);
  int steps = greatest > 0 ? 1 + (int)(log(greatest / least) / log(SAMPLE_STEP)) : 0;
  CW_NEW(sample, (size_t)patches * (size_t)steps);
  for (int32_t t = 0; t < background->triangle_count; t++) {
    double h = piece[t].size;
    if (!cw_cad_face_is_meshed_wall(domain->cad, background->face[t])) continue;
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
static CwStatus integrate(const CwContext *context, CwDomain *domain, double scale) {
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
  CW_TRY(cw_parallel_for(context, "size integrals", domain->background.triangle_count, sizeof *piece, find_piece,
                         domain, piece));
  for (int32_t t = 0; t < domain->background.triangle_count; t++) piece[t].size /= scale;
  CW_TRY(sum_pieces(domain, piece));
  CW_TRY(cw_parallel_for(context, "size integrals", lines, sizeof *along, find_line, domain, along));
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

void cw_domain_layers_needed(const CwDomain *domain, double scale, double *needing) {
  for (int32_t i = 0; i < domain->layer_sample_count; i++) {
    const CwLayerSample *sample = &domain->layer_sample[i];
    const CwLayerTarget *layers = &domain->patch_layers[sample->patch];
    double room = cw_in_model_unit(cw_column_room(&domain->patch_target[sample->patch].flow));
    int fitting = cw_layer_count_fitting(layers->first_height, layers->growth, room);
    int count = cw_layer_count(layers->first_height, layers->growth, scale * sample->size);
    needing[(int)fmax(fmin(count, fitting), CW_LAYERS_LEAST)] += sample->density * sample->size;
  }
}

void cw_domain_seed_costs(const CwDomain *domain, double *cost) {
  const CwBackground *background = &domain->background;
  int faces = cw_cad_face_count(domain->cad);
  double centre[3], area = SEED_AREA * domain->base_size * domain->base_size;
  for (int32_t t = 0; t < background->triangle_count; t++)
    cost[background->face[t]] += 1 + cw_background_area(background, t, centre) / area;
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

void cw_domain_walls_ask(const CwDomain *domain, double scale, double *wanted, double *asked) {
  for (int32_t i = 0; i < domain->layer_sample_count; i++) {
    const CwLayerSample *sample = &domain->layer_sample[i];
    double h = scale * sample->size, longest = cw_domain_longest_edge(domain, sample->patch);
    double prisms = sample->density * sample->size / (scale * scale);
    *wanted += prisms;
    *asked += prisms * fmax(1, h * h / (longest * longest));
  }
}

CwStatus cw_domain_make_size(const CwDomain *domain, const CwCase *table, double gradation, double wall_scale,
                             int32_t point_count, const CwSizePoint *point, void *const *seeds, int part, void **bytes,
                             int64_t *byte_count) {
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
    if (wall) wall[p] = cw_domain_longest_edge(domain, p) / wall_scale;
  }
  CwSizeLimits limits = {open_edge, wall, table->mesh.gradation / gradation, point_count, point};
  CW_TRY(cw_size_make(domain->cad, &domain->background, &mesh, domain->relative_size, domain->base_size, &limits, seeds,
                      (CwSizePart)part, bytes, byte_count));
done:
  free(open_edge);
  free(wall);
  return status;
}

static CwStatus take(void **bytes, int kept, CwSize **size) {
  return kept ? cw_size_read(*bytes, size) : cw_size_unpack(bytes, size);
}

CwStatus cw_domain_take_size(const CwContext *context, CwDomain *domain, int kept, void **bytes) {
  CwStatus status = CW_OK;
  CwSize *open_edges = NULL;
  cw_size_seeds_free(&domain->seeds);
  cw_size_free(&domain->size);
  CW_TRY(take(&bytes[0], kept, &domain->size));
  CW_TRY(take(&bytes[1], kept, &open_edges));
  cw_size_join(domain->size, &open_edges);
  domain->solid_volume = 0;
  for (int i = SIZE_FIELDS; i < cw_domain_size_parts(domain); i++) domain->solid_volume += *(const double *)bytes[i];
  CW_REQUIRE(domain->solid_volume > 0, CW_ERR_INPUT,
             "%s: the faces of the solid enclose %g mm3; allowed: above 0, faces whose normals point out of the fluid",
             domain->name, cw_mm3(domain->solid_volume));
  CW_TRY(integrate(context, domain, 1));
done:
  cw_size_free(&open_edges);
  return status;
}

CwStatus cw_domain_take_field(const CwContext *context, CwDomain *domain, double scale, int kept, void **bytes) {
  CwStatus status = CW_OK;
  CwSize *field = NULL;
  CW_TRY(take(bytes, kept, &field));
  cw_size_join(field, &domain->size);
  domain->size = field;
  CW_TRY(integrate(context, domain, scale));
done:
  return status;
}
