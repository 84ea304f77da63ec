// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/cell_count.h"

#include <math.h>

#include "mesher/policy.h"
#include "mesher/run/domain_size.h"
#include "mesher/run/layer_record.h"
#include "mesher/thickness/layer_count.h"
#include "mesher/thickness/layer_thickness.h"
#include "pipeline/log.h"
#include "pipeline/wall_group.h"

enum { SCALE_STEPS = 100 };

// Triangles for each area of h^2 on the walls, where the first pass starts; the passes correct it. Equilateral ones
// would be 4 / sqrt(3) = 2.31; those on open edges and in bends come on top, with a share that grows with h (measured
// in the pumps of cases/ at 0.3 million cells: 2.55 to 2.72, at 1 million 2.39 to 2.49; in the paper's at 3, 8 and 20
// million 2.43, 2.38 and 2.36).
static double prisms_per_layer(double asked) {
  return 2.34 + 0.12 / sqrt(asked / 1e6);
}

// Tetrahedra for each volume of h^3, likewise. A lattice is 8.2; those that fit it to the layer top come on top. In
// coarse meshes they are counted by the area of the walls, for each h^2, and few tetrahedra lie off the layer top:
// sizes change within all of them (cells as predicted so are within 2 % in the paper's pump at 0.3 and 1 million cells,
// within 5 % in others). In fine ones the share of the surfaces falls with the scale (measured in the paper's: 12.75 at
// scale 0.753, 11.44 at 0.507, 10.57 at 0.359, 9.56 at 0.205, 9.50 at 0.180, 9.27 at 0.140 and 9.28 at 0.092, which are
// 3 to 1000 million cells; within 1.4 %).
static double tets_per_volume(const CwMeshRun *run, double scale) {
  double walls = 0, volume = 0;
  if (scale <= 1) return 8.26 + 6.16 * scale + 0.0037 / (scale * scale);
  for (int d = 0; d < run->model.domain_count; d++) {
    walls += run->domain[d].prism_integral;
    volume += cw_domain_tet_integral(&run->domain[d], scale);
  }
  double finer = log(fmin((double)run->table->mesh.cells, 1.5e6) / 3e5); // than 300,000 cells
  return 6.6 + 1.33 * finer + 0.37 * fmax(finer, 0) + 4.65 * scale * walls / volume;
}

static int64_t layers_of(const CwMeshRun *run) {
  int64_t layers = 0;
  for (int d = 0; d < run->model.domain_count; d++) layers += run->domain[d].layer_count;
  return layers;
}

// What was counted tells nothing of another number of layers: of those that fill a passage they leave a few tetrahedra
// in what the integral takes for next to nothing.
static double tets_at(const CwMeshRun *run, double scale) {
  const CwCellLaw *law = &run->tets;
  int is_of_these = law->factor > 0 && (law->layers == 0 || law->layers == layers_of(run));
  return is_of_these ? cw_cell_law_at(law, scale) : tets_per_volume(run, scale);
}

static double cells_at(const CwMeshRun *run, int d, double scale) {
  double asked = (double)run->table->mesh.cells;
  double prisms = run->prisms.factor > 0 ? cw_cell_law_at(&run->prisms, scale) : prisms_per_layer(asked);
  double tets = tets_at(run, scale);
  return prisms * run->domain[d].layer_count * run->domain[d].prism_integral / (scale * scale) +
         tets * cw_domain_tet_integral(&run->domain[d], scale) / (scale * scale * scale);
}

double cw_predicted_cells(const CwMeshRun *run, int domain) {
  return cells_at(run, domain, run->scale);
}

static double all_cells_at(const CwMeshRun *run, double scale) {
  double cells = 0;
  for (int d = 0; d < run->model.domain_count; d++) cells += cells_at(run, d, scale);
  return cells;
}

double cw_predicted_off(const CwMeshRun *run) {
  return all_cells_at(run, run->scale) / (double)run->table->mesh.cells - 1;
}

void cw_start_factors(CwMeshRun *run) {
  run->prisms = (CwCellLaw){.factor = prisms_per_layer((double)run->table->mesh.cells)};
  run->tets = (CwCellLaw){.factor = tets_per_volume(run, run->scale)};
}

void cw_mesh_set_scale(CwMeshRun *run, double scale) {
  run->scale = scale;
  for (int d = 0; d < run->model.domain_count; d++) cw_size_set_scale(run->domain[d].size, scale);
}

// The scale at which there are as many cells as asked, by secants in the logarithms from `start` on, the first of a
// slope about which cells go with the scale.
static double solve_scale(const CwMeshRun *run, double (*cells)(const CwMeshRun *, double), double start,
                          double slope) {
  double asked = (double)run->table->mesh.cells, before = 0, step = 0, scale = start;
  for (int i = 0; i < SCALE_STEPS; i++) {
    double off = log(cells(run, scale) / asked);
    if (fabs(off) < 1e-12) break;
    if (i > 0 && off != before) slope = fmin((off - before) / step, -1);
    step = fmin(fmax(-off / slope, -1), 1);
    before = off;
    scale *= exp(step);
  }
  return scale;
}

void cw_mesh_solve_scale(CwMeshRun *run) {
  // From 1, to the same bits whatever scale was before.
  cw_mesh_set_scale(run, solve_scale(run, all_cells_at, 1, -2.7));
}

static double cells_on_walls(const CwMeshRun *run, double scale) {
  double cells = 0;
  for (int d = 0; d < run->model.domain_count; d++) {
    const CwDomain *domain = &run->domain[d];
    cells += (double)domain->layer_count * domain->surface.triangle_count +
             tets_at(run, scale) * cw_domain_tet_integral(domain, scale) / (scale * scale * scale);
  }
  return cells;
}

void cw_mesh_fit_volume(CwMeshRun *run) {
  cw_mesh_set_scale(run, solve_scale(run, cells_on_walls, run->scale, -2));
}

static void set_layers(CwMeshRun *run, const int *count, double y_plus_auto) {
  run->y_plus_auto = y_plus_auto;
  for (int d = 0; d < run->model.domain_count; d++)
    cw_domain_set_layers(&run->domain[d], run->table, count[d], y_plus_auto);
}

static void set_same_layers(CwMeshRun *run, int layers, double y_plus_auto) {
  int count[CW_DOMAINS_MOST];
  for (int d = 0; d < run->model.domain_count; d++) count[d] = layers;
  set_layers(run, count, y_plus_auto);
}

// The least y+ of those that the case gives; INFINITY where it gives none, and for walls in laminar flow.
static double least_given(const CwMeshRun *run) {
  double least = INFINITY;
  for (int d = 0; d < run->model.domain_count; d++) {
    const CwDomain *domain = &run->domain[d];
    for (int p = 0; p < cw_cad_patch_count(domain->cad); p++) {
      const CwPatchTarget *target = &domain->patch_target[p];
      const CwFirstHeight *first = &target->first;
      if (cw_cad_patch_kind(domain->cad, p) != CW_PATCH_WALL || isnan(first->y_plus)) continue;
      if (cw_case_given(target->walls.y_plus) || cw_case_given(target->walls.first_height))
        least = fmin(least, first->y_plus * first->asked / first->height);
    }
  }
  return least;
}

void cw_start_layers(CwMeshRun *run) {
  int given = run->table->walls.layer_count, layers = given > 0 ? given : CW_LAYERS_LEAST;
  set_same_layers(run, layers, CW_LOG_LAYER_Y_PLUS);
  double least = least_given(run);
  if (!isinf(least)) set_same_layers(run, layers, least);
}

// The number of layers that each domain needs at the present scale.
static void find_needed(const CwMeshRun *run, int *needed) {
  for (int d = 0; d < run->model.domain_count; d++) {
    double needing[CW_LAYERS_MOST + 1] = {0};
    cw_domain_layers_needed(&run->domain[d], run->scale, needing);
    needed[d] = cw_layer_count_for(needing);
  }
}

// Sets `count` layers of each domain and solves the scale, where a domain has more. Returns whether one has.
static int set_fewer(CwMeshRun *run, const int32_t *count) {
  int fewer = 0;
  for (int d = 0; d < run->model.domain_count; d++) fewer |= count[d] < run->domain[d].layer_count;
  if (fewer) {
    set_layers(run, count, run->y_plus_auto);
    cw_mesh_solve_scale(run);
  }
  return fewer;
}

// What walls of flat triangles bound no filling cures, and from some scale on walls fold: the shape of the pump comes
// first.
void cw_mesh_leave_room(CwMeshRun *run, const int32_t *most) {
  int32_t count[CW_DOMAINS_MOST];
  for (int d = 0; d < run->model.domain_count; d++) {
    int32_t made = run->domain[d].layer_count;
    count[d] = most && most[d] > 0 && most[d] < made ? most[d] : made;
  }
  set_fewer(run, count);
  while (run->scale > cw_size_scale_flat()) {
    for (int d = 0; d < run->model.domain_count; d++) count[d] -= count[d] > CW_LAYERS_LEAST;
    if (!set_fewer(run, count)) break;
  }
}

// More layers take cells from the tetrahedra, whose edges become longer and ask for no fewer layers: from below the
// rounds end at the least numbers that are enough, or, beyond the usual number, where edges have become too long for
// narrow faces.
void cw_mesh_solve_layers(CwMeshRun *run) {
  const CwWalls *walls = &run->table->walls;
  double growth = cw_case_given(walls->growth_ratio) ? walls->growth_ratio : 1 + cw_policy.slope;
  cw_start_layers(run);
  int in_log_layer = cw_walls_auto(walls) && isinf(least_given(run));
  cw_mesh_solve_scale(run);
  for (int more = walls->layer_count == 0; more;) {
    double y_plus = run->y_plus_auto;
    int count[CW_DOMAINS_MOST], needed[CW_DOMAINS_MOST], before[CW_DOMAINS_MOST], most = 0;
    find_needed(run, needed);
    more = 0;
    for (int d = 0; d < run->model.domain_count; d++) {
      before[d] = run->domain[d].layer_count;
      int usual = before[d] < CW_LAYER_COUNT_USUAL;
      count[d] = before[d] + (needed[d] > before[d] && (usual || run->scale < cw_size_scale_fine()));
      more |= count[d] > before[d];
      most = (int)fmax(most, needed[d]);
    }
    if (more && most > CW_LAYER_COUNT_USUAL && in_log_layer && y_plus < CW_LOG_LAYER_END) {
      y_plus = fmin(y_plus * pow(growth, most - CW_LAYER_COUNT_USUAL), CW_LOG_LAYER_END);
      for (int d = 0; d < run->model.domain_count; d++)
        count[d] = (int)fmax(before[d], fmin(count[d], CW_LAYER_COUNT_USUAL));
    }
    if (!more) break;
    set_layers(run, count, y_plus);
    cw_mesh_solve_scale(run);
  }
  cw_mesh_leave_room(run, NULL);
}

double cw_layers_short(CwMeshRun *run, int needed[CW_DOMAINS_MOST]) {
  int made[CW_DOMAINS_MOST], is_short = 0;
  double scale = run->scale, fine = cw_size_scale_fine(), y_plus = run->y_plus_auto;
  if (run->table->walls.layer_count > 0) return 0;
  find_needed(run, needed);
  for (int d = 0; d < run->model.domain_count; d++) {
    made[d] = run->domain[d].layer_count;
    is_short |= needed[d] > made[d];
  }
  if (!is_short) return 0;
  int roomy[CW_DOMAINS_MOST];
  cw_mesh_set_scale(run, fine);
  find_needed(run, roomy);
  for (int d = 0; d < run->model.domain_count; d++) roomy[d] = (int)fmax(roomy[d], made[d]);
  set_layers(run, roomy, y_plus);
  double cells = all_cells_at(run, fine);
  set_layers(run, made, y_plus);
  cw_mesh_set_scale(run, scale);
  return cells;
}

double cw_cells_crowded(CwMeshRun *run) {
  double scale = run->scale, fine = cw_size_scale_fine();
  int given = run->table->walls.layer_count, made = run->domain[0].layer_count;
  if (scale <= fine && made >= given) return 0;
  cw_mesh_set_scale(run, fine);
  if (given > made) set_same_layers(run, given, run->y_plus_auto);
  double cells = all_cells_at(run, fine);
  if (given > made) set_same_layers(run, made, run->y_plus_auto);
  cw_mesh_set_scale(run, scale);
  return cells;
}

void cw_tell_layers(CwMeshRun *run) {
  char y_plus[64] = "";
  int needed[CW_DOMAINS_MOST], given = run->table->walls.layer_count, changed = 0;
  for (int d = 0; d < run->model.domain_count; d++) {
    const CwDomain *domain = &run->domain[d];
    changed |= run->layers_told[d] != domain->layer_count || run->pinched_told[d] != domain->pinched.place_count + 1;
    run->layers_told[d] = domain->layer_count;
  }
  if (!changed) return;
  while (json_array_size(run->headlines) > run->headlines_before)
    json_array_remove(run->headlines, run->headlines_before);
  for (int d = 0; d < run->model.domain_count; d++) {
    const CwDomain *domain = &run->domain[d];
    const int told = domain->pinched.place_count + 1;
    cw_warn_of_pinched(run->pinched_told[d] != told ? run->context.log : NULL, domain, run->headlines);
    run->pinched_told[d] = told;
  }
  double cells = cw_cells_crowded(run);
  if (cells > 0)
    cw_warn_of_long_edges(run->context.log, run->table, run->domain[0].layer_count, run->scale, cells, run->headlines);
  cells = cw_layers_short(run, needed);
  if (cw_walls_auto(&run->table->walls))
    snprintf(y_plus, sizeof y_plus, "; y+ %.3g where it is open", run->y_plus_auto);
  for (int d = 0; given == 0 && d < run->model.domain_count; d++) {
    const CwDomain *domain = &run->domain[d];
    if (cells > 0 && needed[d] > domain->layer_count)
      cw_warn_of_few_layers(run->context.log, domain, needed[d], cells, run->headlines);
    else
      cw_log(run->context.log, "%s: %d layers lead from the first height to the size of the tetrahedra%s", domain->name,
             domain->layer_count, y_plus);
  }
}

void cw_mesh_take_start(CwMeshRun *run, const CwPassStart *start) {
  if (start->prisms.factor > 0) {
    run->prisms = start->prisms;
    run->tets = start->tets;
    cw_mesh_solve_scale(run);
  }
  cw_mesh_leave_room(run, start->layers);
  cw_tell_layers(run);
}

void cw_learn_prisms(CwMeshRun *run) {
  double integral = 0, prisms = 0;
  for (int d = 0; d < run->model.domain_count; d++) {
    const CwDomain *domain = &run->domain[d];
    integral += domain->layer_count * domain->prism_integral;
    prisms += (double)domain->layer_count * domain->surface.triangle_count;
  }
  double factor = prisms * run->scale * run->scale / integral;
  cw_cell_law_learn(&run->prisms, factor, run->scale, 2, 0);
}

// All cells count that are none of full layers.
void cw_learn_tets(CwMeshRun *run) {
  double made = (double)run->cells, integral = 0;
  for (int d = 0; d < run->model.domain_count; d++) {
    made -= (double)run->domain[d].layer_count * run->domain[d].surface.triangle_count;
    integral += cw_domain_tet_integral(&run->domain[d], run->scale);
  }
  if (run->tets.layers != layers_of(run)) run->tets = (CwCellLaw){.layers = layers_of(run)}; // its slope as well
  double asked = (double)run->table->mesh.cells, before = run->tets.scale;
  int between = before > 0 && (all_cells_at(run, before) > asked) != ((double)run->cells > asked);
  cw_cell_law_learn(&run->tets, made * run->scale * run->scale * run->scale / integral, run->scale, 3, between);
  cw_log_debug(run->context.log,
               "%.3f tetrahedra and %.3f prisms a layer for each unit of the integrals; exponents %.2f, %.2f",
               run->tets.factor, run->prisms.factor, run->tets.exponent, run->prisms.exponent);
}
