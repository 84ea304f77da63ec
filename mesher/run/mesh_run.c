// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/mesh_run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/heights/coupled_rim.h"
#include "mesher/parallel/ledger.h"
#include "mesher/run/mesh_plan.h"
#include "mesher/run/pass_state.h"
#include "mesher/run/run_layers.h"
#include "mesher/run/run_step.h"
#include "mesher/run/run_thinning.h"
#include "pipeline/atomic_file.h"
#include "pipeline/log.h"

enum { PASSES_MOST = 4, WALL_PASSES = 3, SCALE_STEPS = 100 };
static const double COUNT_TOLERANCE = 0.02; // of the asked number of cells
static const double WALL_TOLERANCE = 0.01;  // of the same, before the volume is filled
static const double COPY_COST = 0.07;       // of a turned copy of a region, by that of its first
// Triangles for each area of h^2 on the walls, where the first pass starts; the passes correct it. Equilateral ones
// would be 4 / sqrt(3) = 2.31; those on rims and in bends come on top, with a share that grows with h (measured in the
// pumps of cases/ at 0.3 million cells: 2.55 to 2.72, at 1 million 2.39 to 2.49; in the paper's at 3, 8 and 20
// million 2.43, 2.38 and 2.36).
static double prisms_per_layer(double asked) {
  return 2.34 + 0.12 / sqrt(asked / 1e6);
}

// Tetrahedra for each volume of h^3, likewise. A lattice is 8.2; those that fit it to the front come on top. In coarse
// meshes they are counted by the area of the walls, for each h^2, and few tetrahedra lie off the front: sizes change
// within all of them (cells as predicted so are within 2 % in the paper's pump at 0.3 and 1 million cells, within 5 %
// in others). In fine ones those on interfaces come with the many regions (measured in the paper's from 3 to 20 million
// cells: 12.9 at scale 0.75, 11.4 at 0.51, 10.5 at 0.36).
static double tets_per_volume(const CwMeshRun *run, double scale) {
  double walls = 0, volume = 0;
  if (scale <= 1) return 8.2 + 6.25 * scale + 0.011 / (scale * scale);
  for (int d = 0; d < run->domains.count; d++) {
    walls += run->domain[d].prism_integral;
    volume += cw_domain_tet_integral(&run->domain[d], scale);
  }
  return 8.2 + 1.33 * log(fmin((double)run->table->mesh.cells, 1.5e6) / 1e6) + 4.65 * scale * walls / volume;
}

static double cells_at(const CwMeshRun *run, int d, double scale) {
  double asked = (double)run->table->mesh.cells;
  double prisms = run->prism_factor > 0 ? run->prism_factor : prisms_per_layer(asked) * run->table->walls.layer_count;
  double tets = run->tet_factor > 0 ? run->tet_factor : tets_per_volume(run, scale); // 0: nothing learned yet
  return prisms * run->domain[d].prism_integral / (scale * scale) +
         tets * cw_domain_tet_integral(&run->domain[d], scale) / (scale * scale * scale);
}

double cw_predicted_cells(const CwMeshRun *run, int domain) {
  return cells_at(run, domain, run->scale);
}

static double all_cells_at(const CwMeshRun *run, double scale) {
  double cells = 0;
  for (int d = 0; d < run->domains.count; d++) cells += cells_at(run, d, scale);
  return cells;
}

void cw_mesh_set_scale(CwMeshRun *run, double scale) {
  run->scale = scale;
  for (int d = 0; d < run->domains.count; d++) cw_size_set_scale(run->domain[d].size, scale);
}

// By secants in the logarithms, the first of a slope of -2.7, about which cells go with the scale.
void cw_mesh_solve_scale(CwMeshRun *run) {
  double asked = (double)run->table->mesh.cells, slope = -2.7, before = 0, step = 0;
  run->scale = 1; // the same bits, whatever scale was before
  for (int i = 0; i < SCALE_STEPS; i++) {
    double off = log(all_cells_at(run, run->scale) / asked);
    if (fabs(off) < 1e-12) break;
    if (i > 0 && off != before) slope = fmin(fmax((off - before) / step, -4), -1.5);
    step = -off / slope;
    before = off;
    run->scale *= exp(step);
  }
  cw_mesh_set_scale(run, run->scale);
}

// Costs of faces: predicted triangles.
static CwStatus face_tasks(const CwMeshRun *run, int walls, int32_t *count, CwMeshTask **tasks) {
  CwStatus status = CW_OK;
  int32_t faces[CW_DOMAINS_MOST], all = 0;
  *count = 0;
  cw_face_counts(run, faces);
  for (int d = 0; d < run->domains.count; d++) all += faces[d];
  CW_NEW(*tasks, all);
  for (int d = 0; d < run->domains.count; d++) {
    const CwDomain *domain = &run->domain[d];
    for (int32_t f = 0; f < cw_cad_face_count(domain->cad); f++) {
      if (cw_face_is_wall(domain->cad, f) != walls) continue;
      if (domain->symmetry && domain->symmetry->face.first[f] != f) continue;
      (*tasks)[(*count)++] = (CwMeshTask){d, f, domain->face_triangles[f]};
    }
  }
done:
  return status;
}

// Skeletons with all wall curves, those along interfaces divided alike on both sides. Outcome: that of cw_domain_start.
static CwStatus start_walls(CwMeshRun *run, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  for (int d = 0; d < run->domains.count; d++) {
    outcome->domain = d;
    CW_TRY_STAGE(cw_domain_start(&run->domain[d], outcome), outcome);
  }
  for (int i = 0; i < run->domains.interface_count; i++) {
    const CwDomainInterface *between = &run->domains.interface[i];
    CW_TRY(cw_couple_rims(&run->domain[between->domain[0]].skeleton, between->patch[0],
                          &run->domain[between->domain[1]].skeleton, between->patch[1]));
  }
  for (int d = 0; d < run->domains.count; d++) CW_TRY(cw_skeleton_wall_curves(&run->domain[d].skeleton));
done:
  return status;
}

// Walls of all domains; repeated with a corrected scale until the prisms and the predicted tetrahedra add up to what
// is asked.
static CwStatus mesh_walls(CwMeshRun *run, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  int again = 0; // the same walls, for thinner layers
  CwResults results = {0};
  CwMeshTask *task = NULL;
  int32_t count, faces[CW_DOMAINS_MOST];
  for (int d = 0; d < run->domains.count; d++) again |= run->most_height[d] != NULL;
  CW_TRY(face_tasks(run, 1, &count, &task));
  cw_face_counts(run, faces);
  for (int pass = 0;; pass++) {
    int64_t triangles = 0;
    double integral = 0;
    cw_ledger_part("curves of the walls");
    CW_TRY_STAGE(start_walls(run, outcome), outcome);
    CW_TRY(cw_results_make(&results, run->domains.count, faces));
    CW_TRY(cw_run_step(run, "surface", "faces", cw_step_wall, count, task, NULL, results.bytes, NULL));
    cw_ledger_part("walls merged");
    for (int d = 0; d < run->domains.count; d++)
      CW_TRY(cw_skeleton_merge_walls(&run->domain[d].skeleton, results.bytes[d]));
    CW_TRY(cw_run_heights(run));
    for (int d = 0; d < run->domains.count; d++) {
      cw_log_debug("%s: graded columns take %.3f of the volume of full ones", run->domain[d].name,
                   run->domain[d].layer_share);
      triangles += run->domain[d].skeleton.wall_triangle_count;
      integral += run->domain[d].prism_integral;
    }
    cw_results_free(&results);
    run->prism_factor = (double)triangles * run->table->walls.layer_count * run->scale * run->scale / integral;
    double off = all_cells_at(run, run->scale) / (double)run->table->mesh.cells - 1;
    cw_log("surface: %lld wall triangles at scale %.4f; %.2f %% off the asked count as predicted", (long long)triangles,
           run->scale, 100 * off);
    if (again || fabs(off) <= WALL_TOLERANCE || pass + 1 == WALL_PASSES) break;
    cw_mesh_solve_scale(run);
  }
  for (int d = 0; d < run->domains.count; d++) {
    CwDomain *domain = &run->domain[d];
    for (int32_t v = 0; run->most_height[d] && v < domain->skeleton.wall_count; v++) {
      domain->heights.target[v] = fmin(domain->heights.target[v], run->most_height[d][v]);
    }
  }
done:
  cw_results_free(&results);
  free(task);
  return status;
}

// Outcome: CW_OUTCOME_THIN where layers leave no room on the planes, with the places of all domains;
// CW_OUTCOME_ASYMMETRIC.
static CwStatus mesh_inner(CwMeshRun *run, CwThinPlaces *places, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwResults results = {0}; // of each domain first those of its faces
  CwMeshTask *cap = NULL, *task = NULL;
  int32_t caps, count, faces[CW_DOMAINS_MOST], parts[CW_DOMAINS_MOST];
  cw_ledger_part("free curves");
  for (int d = 0; d < run->domains.count; d++) {
    CwOutcome of_domain = {.domain = d};
    CW_TRY(cw_skeleton_free_curves(&run->domain[d].skeleton, &of_domain));
    if (of_domain.kind == CW_OUTCOME_THIN) CW_TRY(cw_thin_places_on_planes(run, &of_domain, places));
    if (of_domain.kind == CW_OUTCOME_DONE) continue;
    *outcome = of_domain;
    if (outcome->kind == CW_OUTCOME_ASYMMETRIC) goto done;
  }
  if (outcome->kind != CW_OUTCOME_DONE) goto done;
  cw_face_counts(run, faces);
  CW_TRY(face_tasks(run, 0, &caps, &cap));
  count = caps;
  for (int d = 0; d < run->domains.count; d++) {
    parts[d] = faces[d] + run->domain[d].skeleton.outline_count;
    count += run->domain[d].skeleton.outline_count;
  }
  CW_TRY(cw_results_make(&results, run->domains.count, parts));
  CW_NEW(task, count);
  memcpy(task, cap, (size_t)caps * sizeof *task);
  count = caps;
  for (int d = 0; d < run->domains.count; d++) {
    const CwSkeleton *skeleton = &run->domain[d].skeleton;
    for (int32_t i = 0; i < skeleton->outline_count; i++) {
      if (cw_orbit_turns(&skeleton->orbits, &skeleton->orbits.outline, i) > 0) continue;
      // Takes about as long as a cap of as many triangles.
      task[count++] = (CwMeshTask){d, faces[d] + i, skeleton->outline[i].corner_count};
    }
  }
  CW_TRY(cw_run_step(run, "inner surfaces", "surfaces", cw_step_inner, count, task, NULL, results.bytes, NULL));
  cw_ledger_part("inner surfaces merged");
  for (int d = 0; d < run->domains.count; d++) {
    CW_TRY(cw_skeleton_merge_inner(&run->domain[d].skeleton, results.bytes[d], results.bytes[d] + faces[d]));
    CW_TRY(cw_domain_number(&run->domain[d]));
  }
done:
  cw_results_free(&results);
  free(cap);
  free(task);
  return status;
}

// The owners of interfaces refine them where new points of theirs come too near (paper, section 2.3). Not where
// passages are copies of one another: there neither neighbour goes before the other, and both drop their candidates.
static CwStatus refine_interfaces(CwMeshRun *run) {
  CwStatus status = CW_OK;
  CwResults results = {0};
  CwMeshTask *task = NULL;
  int32_t regions[CW_DOMAINS_MOST], all = 0, count = 0;
  for (int d = 0; d < run->domains.count; d++) {
    regions[d] = run->domain[d].plan.region_count;
    all += regions[d];
  }
  CW_NEW(task, all);
  for (int d = 0; d < run->domains.count; d++) {
    const CwDomain *domain = &run->domain[d];
    for (int32_t r = 0; r < regions[d]; r++) {
      int owns = 0;
      for (int32_t i = 0; i < domain->skeleton.outline_count && !domain->symmetry; i++) {
        owns |= cw_interface_owner(&domain->skeleton, domain->number, i) == r;
      }
      if (owns) task[count++] = (CwMeshTask){d, r, domain->plan.predicted_cells[r]};
    }
  }
  CW_TRY(cw_results_make(&results, run->domains.count, regions));
  CW_TRY(cw_run_step(run, "region rule", "regions", cw_step_rule, count, task, NULL, results.bytes, NULL));
  cw_ledger_part("interfaces merged");
  for (int d = 0; d < run->domains.count; d++) {
    CwDomain *domain = &run->domain[d];
    if (domain->symmetry) continue;
    CW_TRY(cw_interface_rule_merge(&domain->skeleton, results.bytes[d], &domain->rule));
    if (domain->rule.planned == 0) continue;
    cw_log("%s: region numbers in %d colours; of %lld interface triangles, with new points in their spheres %lld, "
           "centres inserted %lld, triangles left to both sides %lld",
           domain->name, domain->colours, (long long)domain->rule.planned, (long long)domain->rule.encroached,
           (long long)domain->rule.inserted, (long long)domain->rule.left);
  }
done:
  cw_results_free(&results);
  free(task);
  return status;
}

// The summaries of a region and of its turned copies.
static void take_summaries(CwMeshRun *run, int d, int32_t region, const CwRegionSummary *made) {
  const CwSkeleton *skeleton = &run->domain[d].skeleton;
  int32_t copies = cw_region_copies(skeleton, region);
  for (int32_t turns = 0; turns < copies; turns++) {
    int32_t copy = cw_orbit_region(&skeleton->orbits, skeleton->plan, region, turns);
    run->summary[d][copy] = *made;
    run->cells += (int64_t)made->tetrahedra + made->pyramids + made->prisms;
  }
}

// Regions are made, and the turned copies of each as soon as it is whole. Outcome: CW_OUTCOME_THIN with the places
// where regions could not be made; they have no copies.
static CwStatus mesh_regions(CwMeshRun *run, CwThinPlaces *places, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwResults results = {0};
  CwMeshTask *task = NULL;
  uint64_t open_faces[CW_DOMAINS_MOST] = {0};
  int32_t regions[CW_DOMAINS_MOST], all = 0, count = 0, *after = NULL;
  for (int d = 0; d < run->domains.count; d++) {
    regions[d] = run->domain[d].plan.region_count;
    all += regions[d];
    free(run->summary[d]);
    free(run->region_seconds[d]);
    run->summary[d] = NULL;
    run->region_seconds[d] = NULL;
    CW_NEW(run->summary[d], regions[d]);
    CW_NEW(run->region_seconds[d], regions[d]);
  }
  CW_NEW(task, all);
  CW_NEW(after, all);
  for (int d = 0; d < run->domains.count; d++) {
    const CwSkeleton *skeleton = &run->domain[d].skeleton;
    for (int32_t r = 0; r < regions[d]; r++) {
      if (cw_orbit_region_first(&skeleton->orbits, skeleton->plan, r) != r) continue;
      int32_t first = count, copies = cw_region_copies(skeleton, r);
      double cost = run->domain[d].plan.predicted_cells[r];
      after[count] = -1;
      task[count++] = (CwMeshTask){d, r, cost};
      for (int32_t turns = 1; turns < copies; turns++) {
        after[count] = first;
        task[count++] = (CwMeshTask){d, cw_orbit_region(&skeleton->orbits, skeleton->plan, r, turns), COPY_COST * cost};
      }
    }
  }
  CW_TRY(cw_results_make(&results, run->domains.count, regions));
  CW_TRY(
      cw_run_step(run, "regions", "regions", cw_step_region, count, task, after, results.bytes, run->region_seconds));
  cw_ledger_part("results");
  run->cells = 0;
  for (int32_t i = 0; i < count; i++) {
    const CwRegionSummary *made = results.bytes[task[i].domain][task[i].index];
    if (after[i] < 0) take_summaries(run, task[i].domain, task[i].index, made);
    open_faces[task[i].domain] += made->quality.open_faces;
    if (made->failure.failed) outcome->kind = CW_OUTCOME_THIN;
  }
  if (outcome->kind == CW_OUTCOME_THIN) CW_TRY_STAGE(cw_thin_places_in_regions(run, places), outcome);
  for (int d = 0; d < run->domains.count; d++) {
    CW_REQUIRE(open_faces[d] == 0, CW_ERR_MESH, "%s: the regions in %s/mesh do not fit together on the dividing planes",
               run->domain[d].name, run->run_path);
  }
done:
  cw_results_free(&results);
  free(after);
  free(task);
  return status;
}

// Sets the factor of the tetrahedra to what the last pass made of them.
static void learn_tets(CwMeshRun *run) {
  double made = 0, integral = 0;
  for (int d = 0; d < run->domains.count; d++) {
    for (int32_t r = 0; r < run->domain[d].plan.region_count; r++) made += run->summary[d][r].tetrahedra;
    integral += cw_domain_tet_integral(&run->domain[d], run->scale);
  }
  run->tet_factor = made * run->scale * run->scale * run->scale / integral;
  cw_log_debug("%.3f tetrahedra and %.3f prisms a layer for each unit of the integrals", run->tet_factor,
               run->prism_factor / run->table->walls.layer_count);
}

// The stages of one attempt, in their order.
static CwStatus mesh_attempt(CwMeshRun *run, CwThinPlaces *places, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CW_TRY_STAGE(mesh_walls(run, outcome), outcome);
  CW_TRY_STAGE(cw_run_layers(run, outcome), outcome);
  CW_TRY_STAGE(mesh_inner(run, places, outcome), outcome);
  CW_TRY(refine_interfaces(run));
  cw_ledger_part("points that regions share");
  for (int d = 0; d < run->domains.count; d++) CW_TRY(cw_domain_share(&run->domain[d], run->table));
  CW_TRY(mesh_regions(run, places, outcome));
done:
  return status;
}

// One pass at the present scale. Where equal passages do not come out equal, the impeller is meshed whole; a domain
// with a plane that grazes a wall, or on which no column leaves one, gets other planes; surfaces and regions that fail
// are tried again with thinner layers, and with other planes where these do not do.
static CwStatus mesh_pass(CwMeshRun *run) {
  CwStatus status = CW_OK;
  CwThinPlaces places = {0};
  for (int attempt = 0;;) {
    CwOutcome outcome = {0};
    places.count = 0;
    CW_TRY(mesh_attempt(run, &places, &outcome));
    if (outcome.kind == CW_OUTCOME_DONE) break;
    if (outcome.kind == CW_OUTCOME_THIN) {
      outcome = (CwOutcome){0};
      CW_TRY(cw_thin(run, &places, attempt++, &outcome));
      if (outcome.kind == CW_OUTCOME_DONE) continue;
    }
    attempt = 0;
    cw_end_thinning(run); // the walls will be others
    CW_TRY(cw_mesh_plan_again(run, &outcome));
  }
done:
  cw_thin_places_free(&places);
  cw_end_thinning(run);
  return status;
}

static double rounded(double value) {
  char text[32];
  snprintf(text, sizeof text, "%.12g", value);
  return strtod(text, NULL);
}

CwStatus cw_mesh_run(CwMeshRun *run) {
  CwStatus status = CW_OK;
  char path[4096], fingerprint[33];
  snprintf(path, sizeof path, "%s/mesh", run->run_path);
  CW_TRY(cw_make_directory(path));
  CW_TRY(cw_mesh_open(run));
  double asked = (double)run->table->mesh.cells;
  run->prism_factor = prisms_per_layer(asked) * run->table->walls.layer_count;
  run->tet_factor = tets_per_volume(run, run->scale);
  CwPassState state = {.pass = 1};
  CW_TRY(cw_pass_fingerprint(run->table, run->run_path, &run->domains, fingerprint));
  cw_pass_state_read(run->run_path, fingerprint, &state);
  for (int d = 0; d < run->domains.count; d++) run->domain[d].more_regions = state.more_regions[d];
  CW_TRY(cw_mesh_plan(run));
  if (state.pass > 1) {
    run->prism_factor = state.prism_factor;
    run->tet_factor = state.tet_factor;
    cw_mesh_solve_scale(run);
    cw_log("going on with pass %d of an earlier run", state.pass);
    if (state.whole) CW_TRY(cw_mesh_plan_whole(run, "as in the run that this one goes on from"));
  }
  for (run->passes = state.pass;; run->passes++) {
    CW_TRY(mesh_pass(run));
    double off = (double)run->cells / asked - 1;
    cw_log("pass %d: %lld cells, %.2f %% off the asked %.0f", run->passes, (long long)run->cells, 100 * off, asked);
    learn_tets(run);
    if (fabs(off) <= COUNT_TOLERANCE) break;
    if (run->passes == PASSES_MOST) {
      cw_log_warn("%lld cells made, %.1f %% off the asked %.0f after %d passes", (long long)run->cells, 100 * off,
                  asked, run->passes);
      break;
    }
    // As many digits as the file keeps, so that a run that goes on from it has the same bits.
    run->prism_factor = rounded(run->prism_factor);
    run->tet_factor = rounded(run->tet_factor);
    state = (CwPassState){run->passes + 1, run->prism_factor, run->tet_factor, run->whole, {0}};
    for (int d = 0; d < run->domains.count; d++) state.more_regions[d] = run->domain[d].more_regions;
    if (run->rank == 0) CW_TRY(cw_pass_state_write(run->run_path, fingerprint, &state));
    for (int d = 0; d < run->domains.count; d++) run->domain[d].layer_share = CW_LAYER_SHARE;
    cw_mesh_solve_scale(run);
  }
  cw_ledger_part("manifest");
  if (run->rank == 0) CW_TRY(cw_mesh_manifest(run));
done:
  return status;
}

void cw_mesh_run_free(CwMeshRun *run) {
  for (int d = 0; d < run->domains.count; d++) {
    cw_domain_close(&run->domain[d]);
    free(run->summary[d]);
    free(run->region_seconds[d]);
  }
}
