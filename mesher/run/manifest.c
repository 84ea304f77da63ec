// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/manifest.h"

#include <dirent.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "mesher/common/model_unit.h"
#include "mesher/fill/tet_bound.h"
#include "mesher/parallel/ranks.h"
#include "mesher/run/layer_record.h"
#include "mesher/run/mesh_steps.h"
#include "pipeline/log.h"
#include "pipeline/mesh/manifest.h"

// A length, area or volume of the run in m, m2 or m3.
static json_t *metres_json(double value, int dimension) {
  return cw_json_number(value * pow(cw_model_unit(), dimension));
}

static json_t *regions_json(const CwMeshRun *run, int d) {
  json_t *regions = json_array();
  for (int32_t r = 0; r < run->domain[d].plan.region_count; r++) {
    const CwRegionSummary *made = &run->summary[d][r];
    char file[64];
    snprintf(file, sizeof file, "%s-%04d.h5", run->domain[d].name, r + 1);
    json_array_append_new(
        regions, json_pack("{s:s, s:s, s:i, s:i, s:i, s:i, s:i, s:i, s:i, s:i, s:i}", "file", file, "digest",
                           made->digest, "region", r + 1, "number", run->domain[d].number[r], "points", made->points,
                           "own_points", made->own_points, "tetrahedra", made->tetrahedra, "pyramids", made->pyramids,
                           "prisms", made->prisms, "triangles", made->triangles, "quads", made->quads));
  }
  return regions;
}

// The model, with what was made of it.
static CwStatus manifest_json(CwMeshRun *run, json_t **manifest) {
  CwStatus status = CW_OK;
  CwModel *model = &run->model;
  for (int p = 0; p < model->patch_count; p++) {
    const CwModelPatch *patch = &model->patch[p];
    const CwDomain *domain = &run->domain[patch->domain];
    if (patch->kind == CW_PATCH_WALL) model->patch[p].y_plus = domain->patch_target[patch - domain->patch].first.y_plus;
  }
  CW_TRY(cw_model_pack(model, manifest));
  json_object_set_new(*manifest, "format", json_integer(CW_MANIFEST_FORMAT));
  for (int d = 0; d < model->domain_count; d++) {
    json_t *made = json_array_get(json_object_get(*manifest, "domains"), (size_t)d);
    json_object_set_new(made, "shared_points", json_integer((json_int_t)run->domain[d].shared.count));
    json_object_set_new(made, "solid_volume_m3", metres_json(run->domain[d].solid_volume, 3));
    json_object_set_new(made, "regions", regions_json(run, d));
  }
done:
  return status;
}

static json_t *counts_json(const int64_t *count, int size) {
  json_t *array = json_array();
  for (int i = 0; i < size; i++) json_array_append_new(array, json_integer((json_int_t)count[i]));
  return array;
}

// Tetrahedra that touch a partition plane, or those that do not.
static json_t *tet_figures_json(const CwTetFigures *figures) {
  double count = figures->count ? (double)figures->count : 1;
  return json_pack("{s:I, s:o, s:o, s:o, s:o, s:o}", "tetrahedra", (json_int_t)figures->count, "aspect_mean",
                   cw_json_number(figures->aspect_sum / count), "aspect_max", cw_json_number(figures->aspect_max),
                   "mean_ratio_mean", cw_json_number(figures->mean_ratio_sum / count), "mean_ratio_least",
                   cw_json_number(figures->mean_ratio_least), "least_dihedral_deg",
                   cw_json_number(figures->dihedral_least));
}

static json_t *rule_json(const CwInterfaceRuleCounts *rule) {
  return json_pack("{s:I, s:I, s:I, s:I, s:I}", "planned_triangles", (json_int_t)rule->planned, "encroached_triangles",
                   (json_int_t)rule->encroached, "inserted_centres", (json_int_t)rule->inserted, "left_triangles",
                   (json_int_t)rule->left, "final_triangles", (json_int_t)rule->refined);
}

static void put_by_reason(json_t *result, const char *what, int reason, int64_t faces) {
  char key[CW_LAYER_KEY_SIZE];
  json_object_set_new(result, cw_layer_reason_key(what, reason, key), json_integer((json_int_t)faces));
}

// Layers on one patch: how many faces carry them, how many have their first height, why not the others, and how the
// last layer meets the tetrahedra. Where patches meet, the first height of the finer one is the target.
static json_t *coverage_json(const CwMeshRun *run, int d, int patch) {
  const CwDomain *domain = &run->domain[d];
  const CwLayerTarget *target = &domain->patch_layers[patch];
  CwLayerCoverage sum = {.least = INFINITY};
  CwLayerRatio ratio = {0};
  for (int32_t r = 0; r < domain->plan.region_count; r++) {
    const CwLayerCoverage *made = &run->summary[d][r].coverage[patch];
    if (made->faces == 0) continue;
    sum.faces += made->faces;
    sum.full += made->full;
    sum.first_met += made->first_met;
    sum.without += made->without;
    sum.thickness += made->thickness;
    sum.least = fmin(sum.least, made->least);
    for (int i = 0; i < CW_LAYER_REASONS; i++) {
      sum.reason[i] += made->reason[i];
      sum.missed[i] += made->missed[i];
    }
    sum.thin += made->thin;
    if (made->thin_wanted <= sum.thin_wanted) continue;
    sum.thin_wanted = made->thin_wanted;
    memcpy(sum.thin_at, made->thin_at, sizeof sum.thin_at);
  }
  for (int32_t r = 0; r < domain->plan.region_count; r++) {
    cw_layer_ratio_add(&ratio, &run->summary[d][r].ratio[patch]);
  }
  json_t *result =
      json_pack("{s:s, s:I, s:I, s:I, s:o, s:o, s:o}", "patch", cw_cad_patch_name(domain->cad, patch), "wall_faces",
                (json_int_t)sum.faces, "full_thickness_faces", (json_int_t)sum.full, "first_height_met_faces",
                (json_int_t)sum.first_met, "first_height_target_m", metres_json(target->first_height, 1),
                "mean_thickness_m", metres_json(sum.faces ? sum.thickness / (double)sum.faces : 0, 1),
                "least_thickness_m", metres_json(sum.faces ? sum.least : 0, 1));
  json_object_set_new(result, "without_layers_faces", json_integer((json_int_t)sum.without));
  json_object_set_new(result, "growth_ratio_most", cw_json_number(target->growth));
  for (int i = CW_LAYER_FULL + 1; i < CW_LAYER_REASONS; i++) {
    put_by_reason(result, "thinned", i, sum.reason[i]);
    put_by_reason(result, "first_height_missed", i, sum.missed[i]);
  }
  json_object_set_new(result, "thin_prisms", json_integer((json_int_t)sum.thin));
  if (sum.thin > 0) {
    json_object_set_new(result, "thin_prisms_height_wanted", cw_json_number(sum.thin_wanted));
    json_object_set_new(result, "thinnest_prism_at_m",
                        json_pack("[o, o, o]", metres_json(sum.thin_at[0], 1), metres_json(sum.thin_at[1], 1),
                                  metres_json(sum.thin_at[2], 1)));
  }
  cw_put_first_height(&domain->patch_target[patch], result);
  cw_put_layer_ratio(&ratio, result);
  return result;
}

// One region of the record's list; predicted_sum: cells of all regions of the domain.
static json_t *region_json(const CwMeshRun *run, int d, int32_t r, double predicted_sum) {
  const CwDomain *domain = &run->domain[d];
  const CwRegionSummary *made = &run->summary[d][r];
  return json_pack(
      "{s:i, s:i, s:i, s:I, s:I, s:i, s:i, s:i, s:o, s:o, s:o, s:o}", "region", r + 1, "copy_of",
      cw_image_region_first(&domain->images, &domain->plan, r) + 1, "number", domain->number[r], "tetrahedra",
      (json_int_t)made->tetrahedra, "prisms", (json_int_t)made->prisms, "recovered_triangles", made->recovery.missing,
      "recovery_flips", made->recovery.flips, "tetgen", made->recovery.tetgen, "predicted_share",
      cw_json_number(domain->plan.predicted_cells[r] / predicted_sum), "seconds",
      cw_json_number(run->region_seconds[d][r]), "least_dihedral_deg", cw_json_number(made->quality.dihedral_least),
      "least_dihedral_allowed_deg", cw_json_number(made->dihedral_allowed));
}

// How even the cells of the regions are.
typedef struct {
  double sum, most, least; // of all regions, of the greatest, of the least
} Balance;

static void add_to_balance(Balance *balance, double cells) {
  balance->sum += cells;
  balance->most = fmax(balance->most, cells);
  balance->least = fmin(balance->least, cells);
}

static double cells_of(const CwRegionSummary *made) {
  return (double)made->tetrahedra + made->prisms + made->pyramids;
}

// The greatest and the least region over the mean, made and predicted, and how far the prediction was off at most.
static void put_balance(const CwMeshRun *run, int d, json_t *result) {
  const CwDomain *domain = &run->domain[d];
  int32_t regions = domain->plan.region_count;
  Balance made = {.least = INFINITY}, predicted = {.least = INFINITY};
  double error = 0;
  for (int32_t r = 0; r < regions; r++) {
    add_to_balance(&made, cells_of(&run->summary[d][r]));
    add_to_balance(&predicted, domain->plan.predicted_cells[r]);
  }
  for (int32_t r = 0; r < regions; r++) {
    double expected = domain->plan.predicted_cells[r] / predicted.sum * made.sum;
    error = fmax(error, fabs(expected / cells_of(&run->summary[d][r]) - 1));
  }
  double mean = made.sum / regions, predicted_mean = predicted.sum / regions;
  json_object_set_new(result, "region_balance", cw_json_number(made.most / mean));
  json_object_set_new(result, "region_balance_least", cw_json_number(made.least / mean));
  json_object_set_new(result, "region_balance_predicted", cw_json_number(predicted.most / predicted_mean));
  json_object_set_new(result, "region_balance_least_predicted", cw_json_number(predicted.least / predicted_mean));
  json_object_set_new(result, "region_prediction_error", cw_json_number(error));
  cw_log(run->context.log, "%s: cells of a region %.2f to %.2f of their mean; predicted %.2f to %.2f", domain->name,
         made.least / mean, made.most / mean, predicted.least / predicted_mean, predicted.most / predicted_mean);
}

// Counts, volumes and quality of all regions together.
static json_t *sums_json(const CwMeshRun *run, int d) {
  const CwDomain *domain = &run->domain[d];
  CwQuality quality;
  int64_t points = domain->shared.count, tets = 0, pyramids = 0, prisms = 0;
  double allowed = CW_TET_BOUND_MOST, solid = domain->solid_volume;
  int32_t tetgen = 0;
  cw_quality_start(&quality);
  for (int32_t r = 0; r < domain->plan.region_count; r++) {
    const CwRegionSummary *made = &run->summary[d][r];
    cw_quality_add(&quality, &made->quality);
    points += made->own_points;
    tets += made->tetrahedra;
    pyramids += made->pyramids;
    prisms += made->prisms;
    tetgen += made->recovery.tetgen;
    allowed = fmin(allowed, made->dihedral_allowed);
  }
  json_t *result = json_pack("{s:s, s:I, s:I, s:I, s:I, s:i, s:i, s:i, s:o, s:o, s:o, s:o}", "name", domain->name,
                             "points", (json_int_t)points, "tetrahedra", (json_int_t)tets, "pyramids",
                             (json_int_t)pyramids, "prisms", (json_int_t)prisms, "regions", domain->plan.region_count,
                             "interfaces", domain->interfaces.outline_count, "colours", domain->colours,
                             "mesh_volume_m3", metres_json(quality.volume, 3), "solid_volume_m3", metres_json(solid, 3),
                             "volume_error", cw_json_number(quality.volume / solid - 1), "least_cell_volume_m3",
                             metres_json(quality.least_volume, 3));
  json_object_set_new(result, "equal_passages", json_integer(domain->symmetry ? domain->symmetry->count : 1));
  cw_put_left_out(domain, result);
  cw_put_sharp_edge(domain, result);
  json_object_set_new(result, "regions_by_tetgen", json_integer(tetgen));
  json_object_set_new(result, "tetrahedron_aspect_mean", cw_json_number(quality.aspect_mean));
  json_object_set_new(result, "tetrahedron_aspect_max", cw_json_number(quality.aspect_max));
  json_object_set_new(result, "tetrahedron_aspect_class", counts_json(quality.aspect_class, 8));
  json_object_set_new(result, "least_dihedral_deg", cw_json_number(quality.dihedral_least));
  json_object_set_new(result, "least_dihedral_allowed_deg", cw_json_number(allowed));
  json_object_set_new(result, "greatest_dihedral_deg", cw_json_number(quality.dihedral_greatest));
  json_object_set_new(result, "least_dihedral_bins", counts_json(quality.dihedral_bin, 18));
  json_object_set_new(result, "prism_least_scaled_jacobian", cw_json_number(quality.prism_least_scaled_jacobian));
  json_object_set_new(result, "prism_scaled_jacobian_bins", counts_json(quality.prism_jacobian_bin, CW_QUALITY_BINS));
  json_object_set_new(result, "tetrahedra_beside_planes", tet_figures_json(&quality.beside));
  json_object_set_new(result, "tetrahedra_apart", tet_figures_json(&quality.apart));
  return result;
}

static json_t *domain_json(const CwMeshRun *run, int d) {
  const CwDomain *domain = &run->domain[d];
  json_t *result = sums_json(run, d), *patches = json_array(), *coverage = json_array();
  json_t *region_list = json_array(), *pairs = json_array();
  put_balance(run, d, result);
  json_object_set_new(result, "layers", json_integer(domain->layer_count));
  json_object_set_new(result, "region_rule", rule_json(&domain->rule));
  for (int p = 0; p < cw_cad_patch_count(domain->cad); p++) {
    CwPatchKind kind = cw_cad_patch_kind(domain->cad, p);
    double area = 0;
    for (int32_t r = 0; r < domain->plan.region_count; r++) area += run->summary[d][r].patch_area[p];
    json_array_append_new(patches, json_pack("{s:s, s:s, s:o}", "name", cw_cad_patch_name(domain->cad, p), "kind",
                                             cw_patch_kind_name(kind), "area_m2", metres_json(area, 2)));
    if (kind == CW_PATCH_WALL) json_array_append_new(coverage, coverage_json(run, d, p));
  }
  cw_warn_of_thin(run->context.log, domain->name, coverage);
  cw_warn_of_missed(run->context.log, domain->name, coverage, run->headlines);
  cw_warn_of_layers(run->context.log, domain->name, domain->layer_count, run->table->walls.layer_count == 0, coverage,
                    run->headlines);
  json_object_set_new(result, "patches", patches);
  json_object_set_new(result, "layer_coverage", coverage);
  double predicted_sum = 0;
  for (int32_t r = 0; r < domain->plan.region_count; r++) predicted_sum += domain->plan.predicted_cells[r];
  for (int32_t r = 0; r < domain->plan.region_count; r++) {
    json_array_append_new(region_list, region_json(run, d, r, predicted_sum));
  }
  json_object_set_new(result, "region_list", region_list);
  for (int32_t p = 0; p < domain->pair_count; p++) {
    json_array_append_new(pairs, json_pack("[i, i]", domain->pair[p][0] + 1, domain->pair[p][1] + 1));
  }
  json_object_set_new(result, "adjacent_regions", pairs);
  return result;
}

// What the manifest will tell of must lie there: a person may have cleared the folder meanwhile.
static CwStatus check_files(const CwMeshRun *run) {
  CwStatus status = CW_OK;
  char path[4096], digest[CW_HASH_TEXT];
  for (int d = 0; d < run->model.domain_count; d++) {
    for (int32_t r = 0; r < run->domain[d].plan.region_count; r++) {
      snprintf(path, sizeof path, "%s/mesh/%s-%04d.h5", run->run_path, run->domain[d].name, r + 1);
      status = cw_region_digest_read(path, digest);
      CW_REQUIRE(status == CW_OK && !strcmp(digest, run->summary[d][r].digest), CW_ERR_IO,
                 "%s: was removed or changed while the mesher ran; run it again, it makes this region anew", path);
    }
  }
done:
  return status;
}

// Whether a file is called as this format says: DOMAIN-NNNN in some places of it.
static int is_called(const char *name, const char *format) {
  int from = 0, to = 0, end = 0;
  sscanf(name, format, &from, &to, &end);
  return end > 0 && !name[end] && to - from >= 4;
}

static int is_named(const json_t *manifest, const char *file) {
  size_t d, r;
  json_t *domain, *region;
  json_array_foreach(json_object_get(manifest, "domains"), d, domain) {
    json_array_foreach(json_object_get(domain, "regions"), r, region) {
      if (!strcmp(json_string_value(json_object_get(region, "file")), file)) return 1;
    }
  }
  return 0;
}

void cw_mesh_remove_others(const json_t *manifest, const char *folder) {
  DIR *list = opendir(folder);
  for (struct dirent *entry; list && (entry = readdir(list));) {
    const char *name = entry->d_name;
    int is_region = is_called(name, "%*[A-Za-z0-9_]-%n%*[0-9]%n.h5%n") && !is_named(manifest, name);
    if (is_region || is_called(name, "failed-%*[A-Za-z0-9_]-%n%*[0-9]%n.vtk%n")) unlinkat(dirfd(list), name, 0);
  }
  if (list) closedir(list);
}

CwStatus cw_mesh_manifest(CwMeshRun *run) {
  CwStatus status = CW_OK;
  char path[4096];
  json_t *manifest = NULL, *domains = json_array();
  CW_TRY(manifest_json(run, &manifest));
  CW_TRY(check_files(run));
  snprintf(path, sizeof path, "%s/mesh/manifest.json", run->run_path);
  CW_TRY(cw_json_write(manifest, path));
  snprintf(path, sizeof path, "%s/mesh", run->run_path);
  cw_mesh_remove_others(manifest, path);
  CW_TRY(cw_record_file(run->record, path, "manifest.json"));
  for (int d = 0; d < run->model.domain_count; d++) json_array_append_new(domains, domain_json(run, d));
  CW_TRY(cw_record_integer(run->record, "ranks", cw_team_ranks(run->context.team)));
  CW_TRY(cw_record_integer(run->record, "asked_cells", run->table->mesh.cells));
  CW_TRY(cw_record_integer(run->record, "cells", run->cells));
  CW_TRY(cw_record_integer(run->record, "passes", run->passes));
  CW_TRY(cw_record_integer(run->record, "retries", run->retries));
  CW_TRY(cw_record_number(run->record, "size_scale", run->scale));
  CW_TRY(cw_record_number(run->record, "size_gradation", run->scale * run->gradation));
  CW_TRY(cw_record_json(run->record, "headlines", json_incref(run->headlines)));
  json_t *given = domains;
  domains = NULL;
  CW_TRY(cw_record_json(run->record, "domains", given));
  CW_TRY(cw_record_number(run->record, "processor_seconds", cw_processor_seconds()));
done:
  json_decref(manifest);
  json_decref(domains);
  return status;
}
