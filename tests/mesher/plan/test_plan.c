// SPDX-License-Identifier: AGPL-3.0-or-later
// The planner on the solids of the paper's pump: balance, angles, determinism and rooms for few and many regions. With
// arguments (paper 60 100): of that case's pump, so many regions a domain, which takes its time.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/network/network.h"
#include "mesher/plan/plan_model.h"
#include "pump_domains.h"

enum { CELLS_PER_REGION = 20000 };

static int asked_count;
static char **asked;

// A plan of so many regions, of so many cells each or more.
static void make_plan_of(CwDomain *of, int32_t regions, double each, CwPlan *plan) {
  double scale = 1.1;
  while (cells_at(of, scale) < each * regions) scale *= 0.99;
  cw_size_set_scale(of->size, scale);
  table.mesh.cells_per_region = (int64_t)ceil(cells_at(of, scale) / (regions - 0.5));
  CwOutcome outcome = {0};
  check(cw_domain_plan(NULL, of, &table, cells_at(of, scale), prism_factor, &outcome));
  assert_int_equal(outcome.kind, CW_OUTCOME_DONE);
  *plan = of->plan;
  of->plan = (CwPlan){0};
}

static void make_plan(CwDomain *of, int32_t regions, CwPlan *plan) {
  make_plan_of(of, regions, CELLS_PER_REGION, plan);
}

typedef struct {
  double least, greatest; // work of a region over the mean
  int off;                // regions more than 15 % off the mean
  double angle;           // degrees, the sharpest of all planes to walls
  int sharp;              // planes under 40 degrees; one for all its periodic images
} Figures;

static int is_copy(const CwPlan *plan, int32_t node) {
  int32_t end = plan->sector_first + plan->sector_count;
  if (plan->sector_count == 0 || node < plan->sector_first) return 0;
  return node < end ? node >= plan->sector_first + plan->sector_count / plan->sector_turns
                    : node >= end + (plan->node_count - end) / plan->sector_turns;
}

static Figures figures_of(const CwPlan *plan) {
  Figures figures = {INFINITY, 0, 0, 90, 0};
  double sum = 0;
  for (int32_t r = 0; r < plan->region_count; r++) sum += plan->predicted_cells[r];
  for (int32_t r = 0; r < plan->region_count; r++) {
    double share = plan->predicted_cells[r] / sum * plan->region_count;
    figures.least = fmin(figures.least, share);
    figures.greatest = fmax(figures.greatest, share);
    // A slice before the sectors may be small.
    figures.off += plan->sector_count > 0 && r < plan->sector_region ? share > 1.15 : fabs(share - 1) > 0.15;
  }
  for (int32_t n = 0; n < plan->node_count; n++) {
    double angle = asin(plan->node[n].worst) * 180 / M_PI;
    figures.angle = fmin(figures.angle, angle);
    figures.sharp += angle < 40 && !is_copy(plan, n);
  }
  return figures;
}

// Every leaf once, parents before children, both halves there.
static void check_tree(const CwPlan *plan) {
  int *seen = calloc((size_t)plan->region_count, sizeof *seen);
  assert_non_null(seen);
  assert_int_equal(plan->node_count, plan->region_count - 1);
  for (int32_t n = 0; n < plan->node_count; n++) {
    assert_true(plan->node[n].parent < n);
    assert_true(fabs(cw_norm(plan->node[n].plane.normal) - 1) < 1e-12);
    for (int s = 0; s < 2; s++) {
      int32_t child = plan->node[n].child[s];
      if (child < 0) {
        assert_true(-1 - child < plan->region_count);
        seen[-1 - child]++;
      } else {
        assert_int_equal(plan->node[child].parent, n);
      }
    }
  }
  for (int32_t r = 0; r < plan->region_count; r++) assert_int_equal(seen[r], 1);
  free(seen);
}

// Layers on a face at x, m; 0 on open patches.
static double layers_at(const CwDomain *of, int face, const double x[3]) {
  int patch = cw_cad_face_patch(of->cad, face);
  CwLayerTarget target = of->patch_layers[patch];
  if (cw_cad_patch_kind(of->cad, patch) != CW_PATCH_WALL) return 0;
  target.first_height = cw_domain_first_height(of, face);
  return cw_column_thickness_flat(&target, of->layer_count, cw_size_at(of->size, x));
}

// Predicted tetrahedra: a lattice by volume / h^3 and a shell by area / h^2 that fits it to the layer top.
static const double LATTICE = 8.4, SHELL = 4.2;
enum { CUTS = 8 }; // of an edge of the background

// A wall triangle adds the work of its layers to the regions in which small pieces of it lie, less that of the lattice
// in whose place they stand.
static void count_wall(const CwDomain *of, const CwPlan *plan, int32_t t, double *work) {
  const CwBackground *background = &of->background;
  const double *corner[3];
  double x[3], area = cw_background_area(background, t, x) / (CUTS * CUTS);
  for (int k = 0; k < 3; k++) corner[k] = background->x[background->triangle[t][k]];
  for (int i = 0; i < CUTS; i++)
    for (int j = 0; i + j < CUTS; j++)
      for (int other = 0; other < 2 && i + j + other < CUTS; other++) {
        double u = (i + (1 + other) / 3.0) / CUTS, v = (j + (1 + other) / 3.0) / CUTS;
        for (int k = 0; k < 3; k++) x[k] = (1 - u - v) * corner[0][k] + u * corner[1][k] + v * corner[2][k];
        double h = cw_size_at(of->size, x), layers = layers_at(of, background->face[t], x);
        work[cw_plan_locate(plan, x)] += area / (h * h) * (prism_factor + SHELL - LATTICE * layers / h);
      }
}

// Predicted work against a count of its own: samples of the size field where they lie, and pieces of the walls. Where
// layers of two walls meet, theirs is taken off twice: all of it is less than predicted, by up to an eighth.
static void check_work(const CwDomain *of, const CwPlan *plan) {
  double(*x)[3], *volume, *work = calloc((size_t)plan->region_count, sizeof *work), sum = 0, predicted = 0;
  int32_t count;
  assert_non_null(work);
  check(cw_size_samples(of->size, &count, &x, &volume));
  for (int32_t i = 0; i < count; i++)
    work[cw_plan_locate(plan, x[i])] += LATTICE * volume[i] / pow(cw_size_at(of->size, x[i]), 3);
  for (int32_t t = 0; t < of->background.triangle_count; t++)
    if (cw_cad_face_is_wall(of->cad, of->background.face[t])) count_wall(of, plan, t, work);
  for (int32_t r = 0; r < plan->region_count; r++) sum += work[r], predicted += plan->predicted_cells[r];
  assert_true(sum > 0.87 * predicted && sum < 1.01 * predicted);
  for (int32_t r = 0; r < plan->region_count; r++)
    assert_true(fabs(plan->predicted_cells[r] / predicted - work[r] / sum) * plan->region_count < 0.13);
  free(x);
  free(volume);
  free(work);
}

// All regions within 15 % of the mean, and no plane slantwise on a wall.
static void judge(int d, int32_t regions) {
  CwPlan plan;
  make_plan(&domain[d], regions, &plan);
  Figures figures = figures_of(&plan);
  print_message("%s: %d of %d regions, work %.3f to %.3f of the mean, walls at %.0f degrees, %d planes under 40\n",
                domain[d].name, plan.region_count, regions, figures.least, figures.greatest, figures.angle,
                figures.sharp);
  check_tree(&plan);
  check_work(&domain[d], &plan);
  assert_int_equal(plan.region_count, regions);
  assert_int_equal(figures.off, 0);
  assert_int_equal(figures.sharp, 0);
  cw_plan_free(&plan);
}

static void few_regions_are_even_and_cut_cleanly(void **state) {
  for (int d = 0; d < model.domain_count; d++) {
    judge(d, 4);
    judge(d, 8);
  }
}

static void dozens_of_regions_too(void **state) {
  for (int d = 0; d < model.domain_count; d++) judge(d, 32);
}

static void two_plans_are_the_same(void **state) {
  CwPlan a, b;
  make_plan(&domain[0], 12, &a);
  make_plan(&domain[0], 12, &b);
  assert_int_equal(a.region_count, b.region_count);
  assert_memory_equal(a.node, b.node, (size_t)a.node_count * sizeof *a.node);
  assert_memory_equal(a.predicted_cells, b.predicted_cells, (size_t)a.region_count * sizeof *a.predicted_cells);
  cw_plan_free(&a);
  cw_plan_free(&b);
}

static void packed_plans_come_back_whole(void **state) {
  CwPlan plan, copy;
  void *bytes;
  int64_t size;
  make_plan(&domain[1], 5, &plan);
  check(cw_plan_pack(&plan, &bytes, &size));
  check(cw_plan_unpack(bytes, &copy));
  assert_int_equal(copy.region_count, plan.region_count);
  assert_memory_equal(copy.node, plan.node, (size_t)plan.node_count * sizeof *plan.node);
  assert_memory_equal(copy.predicted_cells, plan.predicted_cells, 5 * sizeof *plan.predicted_cells);
  const double x[3] = {0.05, 0.1, 0.001};
  assert_int_equal(cw_plan_locate(&copy, x), cw_plan_locate(&plan, x));
  assert_true(cw_plan_in_region(&copy, cw_plan_locate(&plan, x), x, 0));
  free(bytes);
  cw_plan_free(&plan);
  cw_plan_free(&copy);
}

static double layers_at_corner(const CwDomain *of, const CwCorner *corner) {
  double most = corner->face >= 0 ? layers_at(of, corner->face, corner->x) : 0;
  int faces[2];
  if (corner->edge >= 0) {
    cw_cad_edge_faces(of->cad, corner->edge, faces);
    for (int s = 0; s < 2; s++) most = fmax(most, layers_at(of, faces[s], corner->x));
  }
  return most;
}

// True where the plane runs along a sharp CAD edge, nearer than half of the layers there.
static int runs_along(const CwDomain *of, const CwPlan *plan, int32_t node, int edge) {
  double range[2], x[3], tangent[3];
  int face[2];
  cw_cad_edge_range(of->cad, edge, range);
  cw_cad_edge_faces(of->cad, edge, face);
  for (int i = 0; i <= 100; i++) {
    cw_cad_edge_point(of->cad, edge, range[0] + (range[1] - range[0]) * i / 100, x, tangent);
    cw_unit(tangent);
    double layers = fmax(layers_at(of, face[0], x), layers_at(of, face[1], x));
    if (fabs(cw_plane_distance(&plan->node[node].plane, x)) < layers / 2 &&
        fabs(cw_dot(plan->node[node].plane.normal, tangent)) < 0.35 && cw_plan_in_cell(plan, node, x, 0, NULL, 0)) {
      return 1;
    }
  }
  return 0;
}

// True where the cut of the plane runs along a CAD edge, sharp or smooth, so near that only flat triangles fit between.
static int touches(const CwDomain *of, const CwPlan *plan, int32_t node, int edge) {
  double range[2], x[3], tangent[3];
  cw_cad_edge_range(of->cad, edge, range);
  for (int i = 0; i <= 400; i++) {
    cw_cad_edge_point(of->cad, edge, range[0] + (range[1] - range[0]) * i / 400, x, tangent);
    cw_unit(tangent);
    if (fabs(cw_plane_distance(&plan->node[node].plane, x)) < 0.15 * cw_size_at(of->size, x) &&
        fabs(cw_dot(plan->node[node].plane.normal, tangent)) < 0.1 && cw_plan_in_cell(plan, node, x, 0, NULL, 0)) {
      return 1;
    }
  }
  return 0;
}

typedef struct {
  int filled;   // pieces of lines that the layers at their ends fill
  int along;    // planes and edges; one for all periodic images of a plane
  int touching; // likewise, of those that come much nearer
} Room;

// By the network that follows from the plan, not by what the planner thought of it. False where a plane grazes an edge:
// then the mesher plans again with one region more.
static int room_of(const CwDomain *of, const CwPlan *plan, Room *found) {
  CwNetwork network;
  CwOutcome outcome = {0};
  Room room = {0};
  check(cw_network_make(NULL, of->cad, &of->background, of->inside, plan, &network, &outcome));
  if (outcome.kind != CW_OUTCOME_DONE) return 0;
  for (int32_t i = 0; i < network.curve_count; i++) {
    const CwCurve *curve = &network.curve[i];
    if (curve->kind != CW_CURVE_LINE) continue;
    double layers = 0;
    for (int k = 0; k < 2; k++) layers += layers_at_corner(of, &network.corner[curve->corner[k]]);
    room.filled += curve->fine_length[curve->fine_count - 1] < layers;
  }
  cw_network_free(&network);
  for (int e = 0; e < cw_cad_edge_count(of->cad); e++) {
    for (int32_t n = 0; n < plan->node_count; n++) room.touching += !is_copy(plan, n) && touches(of, plan, n, e);
    if (cw_plan_edge_is_smooth(of->cad, e)) continue;
    for (int32_t n = 0; n < plan->node_count; n++) room.along += !is_copy(plan, n) && runs_along(of, plan, n, e);
  }
  *found = room;
  return 1;
}

// All ways of dividing the pump: regions are even, planes and lines keep clear of layers, but for `filled` lines, and
// no plane stands slantwise on walls, but for `few` of the rotor's; `along` may run along edges, and as many as lines
// are filled touch some.
static void judge_room(int32_t regions, double each, int few, int filled, int along) {
  for (int way = 0; way < 3; way++) {
    CwDomain *of = &domain[way == 2];
    CwPlan plan;
    if (way == 1 && !symmetry) continue;
    of->symmetry = way == 1 ? symmetry : NULL;
    Room room;
    make_plan_of(of, regions, each, &plan);
    for (int more = 1; !room_of(of, &plan, &room); more++) {
      assert_true(more <= 3 && way != 1);
      cw_plan_free(&plan);
      make_plan_of(of, regions + more, each, &plan);
    }
    of->symmetry = NULL;
    Figures figures = figures_of(&plan);
    print_message(
        "%s%s: %d of %d regions, work %.3f to %.3f of the mean, %d more than 15 %% off, walls at %.0f degrees, "
        "%d planes under 40, %d lines filled, %d planes along edges, %d touching\n",
        of->name, way == 1 ? ", periodic" : "", plan.region_count, regions, figures.least, figures.greatest,
        figures.off, figures.angle, figures.sharp, room.filled, room.along, room.touching);
    assert_int_equal(plan.sector_count > 0, way == 1);
    assert_int_equal(figures.off, 0);
    assert_true(figures.sharp <= (way == 2 ? 0 : few) && room.filled <= filled && room.along <= along);
    assert_true(room.touching <= filled);
    cw_plan_free(&plan);
  }
}

static void planes_keep_clear_of_edges_and_layers(void **state) {
  judge_room(8, 4e5, 0, 0, 0);
  judge_room(30, 1e5, 0, 0, 0);
}

// Hundreds do not find room beside all edges. From some 190 on the layers before the nose of the nut and the nose where
// it is blunt are longer than a slice of a periodic rotor may be, and planes between slices can only stand across. One
// plane of the rotor of ns200 in 32 regions has 38 degrees, whatever four tries of each small part find.
static void all_that_are_asked_can_be_had(void **state) {
  for (int i = 0; i < asked_count; i++) {
    int regions = atoi(asked[i]);
    judge_room(regions, regions < 100 ? 1e5 : 4e5, 1, regions / 100, regions / 8);
  }
}

int main(int argc, char **argv) {
  const struct CMUnitTest quick[] = {
      cmocka_unit_test(few_regions_are_even_and_cut_cleanly),  cmocka_unit_test(dozens_of_regions_too),
      cmocka_unit_test(planes_keep_clear_of_edges_and_layers), cmocka_unit_test(two_plans_are_the_same),
      cmocka_unit_test(packed_plans_come_back_whole),
  };
  const struct CMUnitTest many[] = {cmocka_unit_test(all_that_are_asked_can_be_had)};
  if (argc < 2) return cmocka_run_group_tests(quick, open_pump, close_pump);
  case_name = argv[1];
  asked = argv + 2;
  asked_count = argc - 2;
  return cmocka_run_group_tests(many, open_pump, close_pump);
}
