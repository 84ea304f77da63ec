// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/give_back.h"
#include "mesher/run/mesh_plan.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "mesher/cad/background_tessellate.h"
#include "mesher/common/model_unit.h"
#include "mesher/parallel/groups.h"
#include "mesher/parallel/profiler.h"
#include "mesher/plan/plan_audit.h"
#include "mesher/policy.h"
#include "mesher/run/cell_count.h"
#include "mesher/run/domain_size.h"
#include "mesher/run/layer_record.h"
#include "mesher/run/mesh_steps.h"
#include "mesher/run/narrow_faces.h"
#include "mesher/run/run_step.h"
#include "mesher/size/size_audit.h"
#include "pipeline/case_schema.h"
#include "pipeline/log.h"
#include "pipeline/wall_group.h"

enum { PLANS_MORE = 3 }; // of a domain that its plan does not fit
enum { GRADATION_ROUNDS = 8 };
// Of the background triangulation, of the extent of the smallest domain: the impeller's, of which that is the 5000th.
static const double DEFLECTION = 2e-4;
// Edge length at relative size 1 and scale 1, of the cube root of the volume of all domains: a mesh of about 1.5
// million cells has such edges.
static const double BASE_SIZE = 0.01875;
static const double GRADATION_TOLERANCE = 0.05; // over that of the case
static const double OWN_PLAN = 0.15;            // of the work on a plan, what every rank does for itself
static const double PERIODIC_PLAN =
    0.5; // of equal passages, over that of others: 0.55 to 0.6 from 3 to 21 million cells

// The extent of the smallest domain.
static double least_extent(const CwMeshRun *run) {
  double least = INFINITY;
  for (int d = 0; d < run->model.domain_count; d++) {
    CwBox box = cw_box_empty();
    cw_cad_add_to_box(run->domain[d].cad, &box);
    least = fmin(least, cw_box_longest(&box));
  }
  return least;
}

static void settle_base_size(CwMeshRun *run) {
  double volume = 0;
  for (int d = 0; d < run->model.domain_count; d++) volume += fabs(cw_background_volume(&run->domain[d].background));
  for (int d = 0; d < run->model.domain_count; d++) run->domain[d].base_size = BASE_SIZE * cbrt(volume);
}

typedef void PartCosts(const CwDomain *domain, double *cost);

// Runs a step of so many parts of each domain.
static CwStatus run_parts(CwMeshRun *run, const char *name, const char *unit, CwMeshStep body, const int32_t *parts,
                          PartCosts *costs, CwResults *results) {
  CwStatus status = CW_OK;
  CwMeshTask *task = NULL;
  double *cost = NULL;
  int32_t count = 0, all = 0;
  for (int d = 0; d < run->model.domain_count; d++) all += parts[d];
  CW_TRY(cw_results_make(results, run->model.domain_count, parts));
  CW_NEW(task, all);
  for (int d = 0; d < run->model.domain_count; d++) {
    CW_NEW(cost, parts[d]);
    costs(&run->domain[d], cost);
    for (int32_t i = 0; i < parts[d]; i++) task[count++] = (CwMeshTask){d, i, cost[i]};
    free(cost);
    cost = NULL;
  }
  CW_TRY(cw_run_step(run, name, unit, body, count, task, NULL, results, NULL));
done:
  free(cost);
  free(task);
  return status;
}

static void background_costs(const CwDomain *domain, double *cost) {
  for (int f = 0; f < cw_cad_face_count(domain->cad); f++) cost[f] = cw_tessellation_cost(domain->tessellation, f);
}

// Background triangulations, face by face, and the base size that follows from their volume.
static CwStatus triangulate_domains(CwMeshRun *run) {
  CwStatus status = CW_OK;
  CwResults results = {0};
  int32_t faces[CW_DOMAINS_MOST];
  double deflection = DEFLECTION * least_extent(run);
  cw_profiler_part(&run->context, "edges of the background");
  cw_face_counts(run, faces);
  for (int d = 0; d < run->model.domain_count; d++) CW_TRY(cw_domain_start_background(&run->domain[d], deflection));
  CW_TRY(run_parts(run, "background", "faces", cw_step_background, faces, background_costs, &results));
  cw_profiler_part(&run->context, "background joined");
  for (int d = 0; d < run->model.domain_count; d++) {
    CW_TRY(cw_domain_take_background(&run->context, &run->domain[d], results.bytes[d]));
    cw_log(run->context.log, "%s: %d faces, %d background triangles", run->domain[d].name, faces[d],
           run->domain[d].background.triangle_count);
  }
  settle_base_size(run);
done:
  cw_results_free(&results);
  return status;
}

// Looks for equal passages about the axis, anew where a symmetry was found or given up.
static CwStatus find_symmetry(CwMeshRun *run) {
  CwStatus status = CW_OK;
  for (int d = 0; d < run->model.domain_count; d++) run->domain[d].whole = 0;
  if (!run->table->mesh.periodic_impeller) goto done;
  cw_profiler_part(&run->context, "symmetry");
  for (int d = 0; d < run->model.domain_count; d++) {
    CwDomain *domain = &run->domain[d];
    cw_symmetry_free(&domain->symmetry);
    CW_TRY(cw_symmetry_find(domain->cad, &domain->background, &domain->symmetry));
    if (domain->symmetry)
      cw_log(run->context.log, "%s: one of %d equal passages is meshed", domain->name, domain->symmetry->count);
    else if (run->model.domain[d].rotating)
      cw_log(run->context.log, "%s: no equal passages; it is meshed whole", domain->name);
  }
done:
  return status;
}

static void field_cost(const CwDomain *domain, double *cost) {
  *cost = domain->background.triangle_count;
}

// Whether edges on walls are limited at a scale: where that takes no more than some more prisms. Where it would take
// most of all cells, as for the thin layers of resolved walls, flat prisms are what is asked.
static int walls_limit(const CwMeshRun *run, double scale) {
  double wanted = 0, asked = 0;
  for (int d = 0; d < run->model.domain_count; d++) cw_domain_walls_ask(&run->domain[d], scale, &wanted, &asked);
  cw_log_debug(run->context.log, "size field: walls ask for %.2f times as many prisms", asked / wanted);
  return asked <= cw_policy.walls_ask_most * wanted;
}

// Once the domains have taken their size fields: those from before are not read any more, but for the open edges as
// they were first made.
static void keep_sizes(CwMeshRun *run, int again, CwResults *results) {
  if (!again) cw_host_memory_free(&run->sizes[0]);
  cw_host_memory_free(&run->sizes[1]);
  run->sizes[again] = cw_results_keep(results);
}

// The scale multiplies the field with its growth, and with the edges on walls. Where meshes are so coarse that the
// growth would be more than the case allows, the fields are made again with less, and with edges on walls no longer
// than their layers allow. Less growth makes the scale greater, by about the fourth root of what it is less by
// (measured on all pumps of cases/ at 0.3 and 1 million cells); where edges on walls make it greater still, once more.
static CwStatus hold_gradation(CwMeshRun *run) {
  CwStatus status = CW_OK;
  CwResults results = {.shared = 1};
  double allowed = run->table->mesh.gradation, made_for = 0, greatest = 0;
  int32_t parts[CW_DOMAINS_MOST];
  for (int d = 0; d < run->model.domain_count; d++)
    parts[d] = CW_SIZE_SEEDS + 1; // open edges ask for metres, whatever the scale
  for (int round = 0;; round++) {
    cw_mesh_solve_layers(run);
    CW_TRY(cw_run_alike(run, NULL, 0));
    double growth = run->scale * run->gradation / allowed;
    if (growth <= 1 + GRADATION_TOLERANCE || round == GRADATION_ROUNDS) break;
    made_for = run->scale * pow(growth, round == 0 ? 0.25 : 1);
    if (round == 0) greatest = cw_policy.walls_ask_most * made_for;
    run->gradation = allowed / made_for;
    if (round == 0 ? walls_limit(run, made_for) : run->wall_scale > 0)
      run->wall_scale = fmin(made_for, greatest) * (1 + GRADATION_TOLERANCE);
    cw_log_debug(run->context.log, "size field: scale %.4f, made again with a gradation of %.4f, walls at %.3f",
                 run->scale, run->gradation, run->wall_scale);
    CW_TRY(run_parts(run, "size field", "parts", cw_step_size, parts, field_cost, &results));
    for (int d = 0; d < run->model.domain_count; d++)
      CW_TRY(cw_domain_take_field(&run->context, &run->domain[d], made_for, results.memory != NULL, results.bytes[d]));
    keep_sizes(run, 1, &results);
  }
done:
  cw_results_free(&results);
  return status;
}

// The size fields: seeds face by face, of the edges, and lines through the domain; then the fields they spread to, with
// the exact volumes beside them. The same ones whatever meshes were made before.
static CwStatus make_sizes(CwMeshRun *run) {
  CwStatus status = CW_OK;
  CwResults seeds = {0}, results = {.shared = 1};
  int32_t parts[CW_DOMAINS_MOST];
  cw_start_layers(run); // which the seeds make room for
  for (int d = 0; d < run->model.domain_count; d++) parts[d] = cw_size_seed_parts(run->domain[d].cad);
  CW_TRY(run_parts(run, "size seeds", "parts", cw_step_seed, parts, cw_domain_seed_costs, &seeds));
  for (int d = 0; d < run->model.domain_count; d++) {
    run->seeds[d] = seeds.bytes[d];
    parts[d] = cw_domain_size_parts(&run->domain[d]);
  }
  run->gradation = run->table->mesh.gradation;
  run->wall_scale = 0;
  CW_TRY(run_parts(run, "size field", "parts", cw_step_size, parts, cw_domain_size_costs, &results));
  cw_profiler_part(&run->context, "integrals of the size");
  for (int d = 0; d < run->model.domain_count; d++)
    CW_TRY(cw_domain_take_size(&run->context, &run->domain[d], results.memory != NULL, results.bytes[d]));
  keep_sizes(run, 0, &results);
  CW_TRY(hold_gradation(run));
  for (int d = 0; d < run->model.domain_count; d++)
    CW_AUDIT(cw_size_audit(run->domain[d].size, &run->domain[d].background));
done:
  for (int d = 0; d < run->model.domain_count; d++) run->seeds[d] = NULL;
  cw_results_free(&seeds);
  cw_results_free(&results);
  return status;
}

// Brings the solids to the unit of the model, which their size decides.
static CwStatus settle_unit(CwMeshRun *run) {
  CwStatus status = CW_OK;
  CwBox box = cw_box_empty();
  for (int d = 0; d < run->model.domain_count; d++) cw_cad_add_to_box(run->domain[d].cad, &box);
  double extent = cw_box_longest(&box);
  CW_REQUIRE(
      extent > 0 && isfinite(extent), CW_ERR_INPUT,
      "%s/geometry: the solids reach over %g mm; allowed: a length above 0; make it again with cutwater-geometry",
      run->run_path, 1e3 * extent);
  cw_model_unit_fit(run->model.unit, extent);
  for (int d = 0; d < run->model.domain_count; d++) CW_TRY(cw_cad_rescale(run->domain[d].cad, cw_model_unit()));
  cw_log_debug(run->context.log, "the model reaches over %.6g mm; the unit of lengths is %.6g mm", 1e3 * extent,
               cw_mm(1));
done:
  return status;
}

static CwStatus find_pinched(CwMeshRun *run) {
  CwStatus status = CW_OK;
  for (int d = 0; d < run->model.domain_count; d++)
    CW_TRY(cw_pinched_find(run->domain[d].cad, &run->domain[d].pinched));
done:
  return status;
}

CwStatus cw_mesh_pinch(CwMeshRun *run, int32_t first) {
  CwStatus status = CW_OK;
  for (int32_t i = first; i < run->finer.count; i++) {
    const CwFinerPlace *place = &run->finer.place[i];
    const double *x = place->point.x;
    if (!place->pinched) continue;
    CW_TRY(
        cw_pinched_add(&(CwPinchedPlace){{x[0], x[1], x[2]}, place->point.size}, &run->domain[place->domain].pinched));
  }
done:
  return status;
}

// Once the sizes tell which faces are too narrow for the mesh: the same without them.
static CwStatus leave_out_narrow(CwMeshRun *run) {
  CwStatus status = CW_OK;
  int left;
  cw_profiler_part(&run->context, "narrow faces");
  CW_TRY(cw_leave_out_narrow(run, &left));
  if (left == 0) goto done;
  CW_TRY(find_pinched(run));
  CW_TRY(find_symmetry(run));
  CW_TRY(make_sizes(run));
done:
  return status;
}

CwStatus cw_mesh_open(CwMeshRun *run) {
  CwStatus status = CW_OK;
  char path[4096];
  double started = cw_seconds();
  run->headlines = json_array();
  cw_profiler_part(&run->context, "geometry");
  snprintf(path, sizeof path, "%s/geometry/model.json", run->run_path);
  CW_TRY(cw_model_read(path, &run->model));
  snprintf(path, sizeof path, "%s/geometry", run->run_path);
  for (int d = 0; d < run->model.domain_count; d++) CW_TRY(cw_domain_open(&run->domain[d], &run->model, d, path));
  CW_TRY(settle_unit(run));
  for (int d = 0; d < run->model.domain_count; d++) CW_TRY(cw_domain_ask(&run->domain[d], run->table));
  if (run->rank == 0)
    CW_TRY(cw_record_step(run->record, "geometry", cw_seconds() - started, run->model.domain_count, "domains"));
  CW_TRY(triangulate_domains(run));
  CW_TRY(find_pinched(run));
  for (int d = 0; d < run->model.domain_count; d++) CW_TRY(cw_domain_measure_walls(&run->context, &run->domain[d]));
  cw_start_layers(run);
  for (int d = 0; d < run->model.domain_count; d++) {
    cw_warn_of_first_heights(run->context.log, &run->domain[d], run->headlines);
    cw_tell_of_sharp_edge(run->context.log, &run->domain[d]);
  }
  CW_TRY(find_symmetry(run));
  CW_TRY(make_sizes(run));
  CW_TRY(leave_out_narrow(run));
  run->headlines_before = json_array_size(run->headlines);
  cw_tell_layers(run);
done:
  return status;
}

CwStatus cw_mesh_resize(CwMeshRun *run) {
  CwStatus status = CW_OK;
  run->prisms = run->tets = (CwCellLaw){0}; // as when the sizes were first made
  int32_t given_up = 0;
  for (int d = 0; d < run->model.domain_count; d++) {
    cw_domain_clear(&run->domain[d]);
    run->domain[d].layer_share = CW_LAYER_SHARE;
    given_up |= run->domain[d].whole;
  }
  if (given_up) CW_TRY(find_symmetry(run));
  CW_TRY(make_sizes(run));
done:
  return status;
}

// Collective; given: the run. Outcome: CW_OUTCOME_ASYMMETRIC where it has a symmetry and the plan cannot have it.
static CwStatus plan_domain(void *given, const CwContext *context, int32_t d, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwMeshRun *run = given;
  cw_profiler_part(context, "planes weighed");
  double prisms = run->domain[d].layer_count * cw_cell_law_at(&run->prisms, run->scale);
  CW_TRY_STAGE(cw_domain_plan(context, &run->domain[d], run->table, cw_predicted_cells(run, d), prisms, outcome),
               outcome);
  CW_AUDIT(cw_plan_audit(&run->domain[d].plan));
done:
  return status;
}

// Plans a domain without symmetry anew, with the scale, factors and layers of the first plan: a run that goes on from a
// later pass plans alike.
static CwStatus plan_anew(CwMeshRun *run, int d) {
  CwStatus status = CW_OK;
  CwOutcome outcome = {0}; // done: there is no symmetry to miss
  CwCellLaw prisms = run->prisms, tets = run->tets;
  double scale = run->scale;
  int layers = run->domain[d].layer_count;
  cw_domain_clear(&run->domain[d]);
  run->domain[d].layer_count = run->planned_layers[d];
  run->prisms = run->planned_prisms;
  run->tets = run->planned_tets;
  cw_mesh_set_scale(run, run->planned_scale);
  CW_TRY(plan_domain(run, &run->context, d, &outcome));
  run->prisms = prisms;
  run->tets = tets;
  run->domain[d].layer_count = layers;
  cw_mesh_set_scale(run, scale);
done:
  return status;
}

// Gives up the symmetry of a domain: it is planned as if it had none, to be meshed whole.
static CwStatus plan_whole(CwMeshRun *run, int d, const char *reason) {
  CwStatus status = CW_OK;
  cw_log(run->context.log, "%s: its passages are not meshed alike (%s); it is meshed whole", run->domain[d].name,
         reason);
  cw_domain_clear(&run->domain[d]); // what hangs on the symmetry goes first
  cw_symmetry_free(&run->domain[d].symmetry);
  run->domain[d].whole = 1;
  CW_TRY(plan_anew(run, d));
done:
  return status;
}

CwStatus cw_mesh_plan_whole(CwMeshRun *run, const int32_t *whole, const char *reason) {
  CwStatus status = CW_OK;
  for (int d = 0; d < run->model.domain_count; d++) {
    if (whole[d] && run->domain[d].symmetry) CW_TRY(plan_whole(run, d, reason));
  }
done:
  return status;
}

static void log_plan(const CwMeshRun *run, int d) {
  const CwDomain *domain = &run->domain[d];
  double worst = 1;
  for (int32_t n = 0; n < domain->plan.node_count; n++) {
    const CwPlane *plane = &domain->plan.node[n].plane;
    worst = fmin(worst, domain->plan.node[n].worst);
    cw_log_debug(run->context.log,
                 "%s: plane %d under %d: normal (%.4f, %.4f, %.4f) at %.3f mm, %.0f degrees to the walls", domain->name,
                 n, domain->plan.node[n].parent, plane->normal[0], plane->normal[1], plane->normal[2],
                 cw_mm(plane->offset), asin(domain->plan.node[n].worst) * 180 / M_PI);
  }
  cw_log(run->context.log, "%s: %d regions, %.0f cells predicted, planes at least %.0f degrees to the walls",
         domain->name, domain->plan.region_count, cw_predicted_cells(run, d), asin(worst) * 180 / M_PI);
}

// A domain that is to be one region must be as small as a case file may ask regions to be.
static CwStatus require_one_region(const CwMeshRun *run, int d, const char *reason) {
  CwStatus status = CW_OK;
  const CwCaseKey *key = &cw_case_keys[cw_case_key_find("mesh", "cells_per_region")];
  double cells = cw_predicted_cells(run, d);
  CW_REQUIRE(cells <= key->most, CW_ERR_MESH,
             "%s: %s; after %d other plans, and one region cannot hold its %.0f cells; allowed: up to %.0f in one, so "
             "at most %.2g times the present mesh.cells, or another mesh.cells_per_region (%.0f to %.0f)",
             run->domain[d].name, reason, PLANS_MORE, cells, key->most, key->most / cells, key->least, key->most);
done:
  return status;
}

int cw_mesh_has_other_plan(const CwMeshRun *run, int d) {
  const CwDomain *domain = &run->domain[d];
  return !domain->symmetry && domain->more_regions != CW_UNDIVIDED && domain->more_regions < PLANS_MORE;
}

CwStatus cw_mesh_plan_again(CwMeshRun *run, const CwOutcome *why) {
  CwStatus status = CW_OK;
  CwDomain *domain = &run->domain[why->domain];
  char text[CW_OUTCOME_TEXT_SIZE];
  const char *reason = cw_outcome_text(why, cw_mm(1), text);
  if (domain->symmetry) return plan_whole(run, why->domain, reason);
  CW_REQUIRE(domain->more_regions != CW_UNDIVIDED, CW_ERR_MESH,
             "%s: %s; after %d other plans, undivided too; allowed: walls without folds and knife edges there, with "
             "layers that have room; fewer walls.layer_count, a lower y+ or other mesh.cells may do",
             domain->name, reason, PLANS_MORE);
  if (cw_mesh_has_other_plan(run, why->domain)) {
    cw_log_warn(run->context.log, "%s: %s; planned again with one region more", domain->name, reason);
    domain->more_regions++;
  } else {
    CW_TRY(require_one_region(run, why->domain, reason));
    cw_log_warn(run->context.log, "%s: %s; meshed undivided after %d other plans", domain->name, reason, PLANS_MORE);
    domain->more_regions = CW_UNDIVIDED;
  }
  run->retries++;
  CW_TRY(plan_anew(run, why->domain));
  log_plan(run, why->domain);
done:
  return status;
}

void cw_warn_of_few_cells(const CwMeshRun *run) {
  for (int d = 0; d < run->model.domain_count; d++) {
    double cells = cw_predicted_cells(run, d);
    int asked = run->table->mesh.least_regions, least = cw_domain_least_regions(run->table, cells);
    if (least == asked) continue;
    cw_log_warn(run->context.log,
                "%s: mesh.least_regions is %d, %d are taken: its %.0f predicted cells are too few for more; allowed: "
                "one for %.0f, or more mesh.cells",
                run->domain[d].name, asked, least, cells, cw_policy.region_cells_fewest);
  }
}

static CwStatus hand_plan(void *given, const CwGroupHand *hand) {
  CwStatus status = CW_OK;
  CwMeshRun *run = given;
  CwPlan *plan = &run->domain[hand->item].plan;
  void *bytes = NULL;
  int64_t size = 0;
  if (hand->mine) CW_TRY(cw_plan_pack(plan, &bytes, &size));
  cw_group_give(hand, &size, sizeof size);
  if (!hand->mine) CW_NEW_UNSET(bytes, size);
  cw_group_give(hand, bytes, size);
  if (!hand->mine) CW_TRY(cw_plan_unpack(bytes, plan));
done:
  free(bytes);
  return status;
}

CwStatus cw_mesh_plan(CwMeshRun *run) {
  CwStatus status = CW_OK;
  CwOutcome outcome[CW_DOMAINS_MOST];
  char text[CW_OUTCOME_TEXT_SIZE];
  double started = cw_seconds(), cost[CW_DOMAINS_MOST];
  CW_TRY(cw_run_alike(run, NULL, 0));
  run->planned_prisms = run->prisms;
  run->planned_tets = run->tets;
  run->planned_scale = run->scale;
  for (int d = 0; d < run->model.domain_count; d++) run->planned_layers[d] = run->domain[d].layer_count;
  for (int d = 0; d < run->model.domain_count; d++) cost[d] = run->domain[d].symmetry ? PERIODIC_PLAN : 1;
  CwGroupWork work = {.step = "decomposition",
                      .count = run->model.domain_count,
                      .cost = cost,
                      .own = OWN_PLAN,
                      .run = plan_domain,
                      .hand = hand_plan,
                      .given = run};
  cw_progress_start(run->context.log, "decomposition", run->model.domain_count, "domains");
  CW_TRY(cw_groups_run(&run->context, &work, outcome));
  cw_progress(run->context.log, run->model.domain_count);
  cw_progress_end(run->context.log);
  for (int d = 0; d < run->model.domain_count; d++) {
    if (outcome[d].kind != CW_OUTCOME_DONE) CW_TRY(plan_whole(run, d, cw_outcome_text(&outcome[d], cw_mm(1), text)));
    log_plan(run, d);
  }
  CW_TRY(cw_run_alike(run, NULL, 0));
  cw_give_back(); // it lies between what stays
  if (run->rank == 0) {
    CW_TRY(cw_record_step(run->record, "decomposition", cw_seconds() - started, run->model.domain_count, "domains"));
  }
done:
  return status;
}
