// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/domain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/cad/background_make.h"
#include "mesher/cad/background_tessellate.h"
#include "mesher/common/model_unit.h"
#include "mesher/plan/plan_make.h"
#include "mesher/plan/sector_plan.h"
#include "mesher/policy.h"
#include "mesher/region/region_number.h"
#include "mesher/thickness/layer_thickness.h"
#include "mesher/thickness/passage_width.h"
#include "pipeline/log.h"

static const double DEFLECTION_ANGLE = 0.2; // rad

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
done:
  return status;
}

CwStatus cw_domain_measure_walls(const CwContext *context, CwDomain *domain) {
  CwStatus status = CW_OK;
  double *width = NULL;
  int patches = cw_cad_patch_count(domain->cad);
  CW_NEW(width, patches);
  for (int p = 0; p < patches; p++) width[p] = cw_in_model_unit(domain->patch_target[p].flow.width);
  CW_TRY(cw_passage_widths(context, domain->cad, &domain->background, width));
  for (int p = 0; p < patches; p++) {
    double *of = &domain->patch_target[p].flow.width, measured = width[p] * cw_model_unit();
    if (width[p] < cw_in_model_unit(*of))
      cw_log_debug(context->log, "%s: %s is %g mm wide, %g mm as designed", domain->name, domain->patch[p].name,
                   1e3 * measured, 1e3 * *of);
    *of = measured;
  }
  CW_NEW(domain->face_radius, cw_cad_face_count(domain->cad));
  CW_TRY(cw_face_radii(domain->cad, &domain->background, domain->face_radius));
  domain->sharp = cw_sharpest_edge(domain->cad, &domain->background);
done:
  free(width);
  return status;
}

void cw_domain_set_layers(CwDomain *domain, const CwCase *table, int layer_count, double y_plus_auto) {
  domain->layer_count = layer_count;
  for (int p = 0; p < cw_cad_patch_count(domain->cad); p++) {
    if (cw_cad_patch_kind(domain->cad, p) != CW_PATCH_WALL) continue;
    CwPatchTarget *target = &domain->patch_target[p];
    target->first = cw_first_height_choose(table, &target->walls, &target->flow, y_plus_auto, layer_count);
    domain->patch_layers[p] = cw_layer_target(table, &target->walls, target->first.height, layer_count);
    CwLayerTarget *layers = &domain->patch_layers[p];
    layers->first_height = cw_in_model_unit(layers->first_height);
    layers->thickness = cw_in_model_unit(layers->thickness);
  }
}

CwStatus cw_domain_start_background(CwDomain *domain, double deflection) {
  return cw_tessellation_start(domain->cad, deflection, DEFLECTION_ANGLE, &domain->tessellation);
}

CwStatus cw_domain_take_background(const CwContext *context, CwDomain *domain, void *const *bytes) {
  CwStatus status = CW_OK;
  cw_tessellation_free(&domain->tessellation);
  CW_TRY(cw_background_join(context, domain->cad, bytes, &domain->background));
  CW_TRY(cw_verticals_make((const double(*)[3])domain->background.x, domain->background.triangle_count,
                           (const int32_t(*)[3])domain->background.triangle, &domain->inside));
done:
  return status;
}

double cw_domain_first_height(const CwDomain *domain, int face) {
  const double *radius = domain->face_radius[face];
  // Round a lesser radius the first layer would be more than twice as long on its outer side; inside of one, the layers
  // would be higher than where their columns meet.
  double inside = cw_policy.free_share * radius[CW_CONCAVE] / cw_layer_lowest(domain->layer_count);
  return fmin(domain->patch_layers[cw_cad_face_patch(domain->cad, face)].first_height, fmin(radius[CW_CONVEX], inside));
}

double cw_domain_longest_edge(const CwDomain *domain, int patch) {
  const CwLayerTarget *layers = &domain->patch_layers[patch];
  return cw_policy.prism_longest * layers->growth * layers->first_height;
}

double cw_domain_region_cells(const CwMeshTable *mesh) {
  if (mesh->cells_per_region > 0) return (double)mesh->cells_per_region;
  double cells = fmax(cw_policy.region_cells, (double)mesh->cells / cw_policy.regions_most);
  return fmin(cells, cw_policy.region_cells_most);
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
  return (int)fmin(table->mesh.least_regions, fmax(1, floor(cells / cw_policy.region_cells_fewest)));
}

// Of the layers over a wall, for the planner.
static double thickness_at(const void *given, int32_t face, const double x[3], const double normal[3]) {
  const CwDomain *domain = given;
  CwLayerTarget layers = domain->patch_layers[cw_cad_face_patch(domain->cad, face)];
  layers.first_height = cw_domain_first_height(domain, face);
  return cw_column_thickness_at(&layers, domain->layer_count, cw_size_at, domain->size, x, normal);
}

CwStatus cw_domain_plan(const CwContext *context, CwDomain *domain, const CwCase *table, double cells,
                        double prism_factor, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwPlan plan = {0};
  double regions = fmax(ceil(cells / cw_domain_region_cells(&table->mesh)), cw_domain_least_regions(table, cells));
  int32_t more = domain->more_regions * (domain->symmetry ? domain->symmetry->count : 1);
  CwPlanOptions options = {.region_count = domain->more_regions == CW_UNDIVIDED ? 1 : (int32_t)regions + more,
                           .thickness = thickness_at,
                           .given = domain,
                           .base_size = domain->base_size,
                           .prism_factor = prism_factor};
  status = domain->symmetry
               ? cw_sector_plan_make(context, domain->cad, &domain->background, domain->inside, domain->size, &options,
                                     domain->symmetry->count, &plan, outcome)
               : cw_plan_make(context, domain->cad, &domain->background, domain->inside, domain->size, &options, &plan);
  CW_TRY_STAGE(status, outcome);
  CW_END_UNLESS(!domain->symmetry || fixed_faces_fit(domain, &plan), outcome, CW_OUTCOME_ASYMMETRIC, NULL,
                "a face round the axis lies on the side of the passages");
  cw_plan_free(&domain->plan);
  domain->plan = plan;
  plan = (CwPlan){0};
done:
  cw_plan_free(&plan);
  return status;
}

CwStatus cw_domain_start(const CwContext *context, CwDomain *domain, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  cw_domain_clear(domain);
  domain->images.symmetry = domain->symmetry;
  domain->input = (CwBoundaryInput){.cad = domain->cad,
                                    .plan = &domain->plan,
                                    .network = &domain->network,
                                    .images = &domain->images,
                                    .size_at = cw_size_at,
                                    .size = domain->size,
                                    .pinched = &domain->pinched};
  CW_TRY_STAGE(cw_network_make(context, domain->cad, &domain->background, domain->inside, &domain->plan,
                               &domain->network, outcome),
               outcome);
  if (domain->symmetry) CW_TRY(cw_periodic_images_make(&domain->network, &domain->images, outcome));
done:
  return status;
}

CwStatus cw_domain_targets(const CwContext *context, CwDomain *domain) {
  CwStatus status = CW_OK;
  CwLayerTarget *layers = NULL; // of each face
  CwIncident around = {0};
  int faces = cw_cad_face_count(domain->cad);
  CW_NEW(layers, faces);
  for (int f = 0; f < faces; f++) {
    layers[f] = domain->patch_layers[cw_cad_face_patch(domain->cad, f)];
    layers[f].first_height = cw_domain_first_height(domain, f);
  }
  CW_TRY(cw_incident_make(domain->surface.vertex_count, domain->surface.triangle_count,
                          (const int32_t(*)[3])domain->surface.triangle, &around));
  CW_TRY(cw_column_targets_make(context, &domain->input, &domain->surface, &around, layers, domain->layer_count,
                                &domain->targets));
  CW_TRY(cw_column_targets_share(context, &domain->targets, &domain->input, &domain->surface, &around, layers,
                                 &domain->layer_share));
done:
  cw_incident_free(&around);
  free(layers);
  return status;
}

CwStatus cw_domain_number(CwDomain *domain) {
  CwStatus status = CW_OK;
  CW_TRY(cw_interfaces_adjacency(&domain->interfaces, domain->plan.region_count, &domain->pair_count, &domain->pair));
  CW_NEW(domain->number, domain->plan.region_count);
  CW_TRY(cw_region_numbers(domain->plan.region_count, domain->pair_count, (const int32_t(*)[2])domain->pair,
                           domain->number, NULL, &domain->colours));
done:
  return status;
}

CwRegionInput cw_domain_region_input(const CwDomain *domain, CwLog *log) {
  return (CwRegionInput){.log = log,
                         .in = &domain->input,
                         .wall_curves = &domain->wall_curves,
                         .surface = &domain->surface,
                         .layers = &domain->layers,
                         .interfaces = &domain->interfaces};
}

CwStatus cw_domain_share(CwLog *log, CwDomain *domain, const CwCase *table) {
  domain->context = (CwRegionContext){.from = cw_domain_region_input(domain, log),
                                      .domain = domain->name,
                                      .layer_count = domain->layer_count,
                                      .growth = domain->targets.growth,
                                      .shared = &domain->shared,
                                      .fill = table->mesh.fill,
                                      .first_height = domain->layers.first_height};
  return cw_open_edge_places_make(&domain->context.from, &domain->context.open_edge_places);
}

void cw_domain_clear(CwDomain *domain) {
  cw_open_edge_places_free(&domain->context.open_edge_places);
  cw_shared_nodes_free(&domain->shared);
  cw_interfaces_free(&domain->interfaces);
  cw_free_curves_free(&domain->free_curves);
  cw_layers_free(&domain->layers);
  cw_surface_mesh_free(&domain->surface);
  cw_wall_curves_free(&domain->wall_curves);
  cw_open_edges_free(&domain->open_edges);
  cw_periodic_images_free(&domain->images);
  cw_network_free(&domain->network);
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
  cw_verticals_free(&domain->inside);
  cw_tessellation_free(&domain->tessellation);
  cw_background_free(&domain->background);
  cw_pinched_free(&domain->pinched);
  cw_cad_close(&domain->cad);
  free(domain->layer_sample);
  free(domain->face_triangles);
  free(domain->patch_target);
  free(domain->face_radius);
  free(domain->relative_size);
  free(domain->patch_layers);
}
