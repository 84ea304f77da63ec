// SPDX-License-Identifier: AGPL-3.0-or-later
// The smoothing of one block on a flat wall of random triangles, against the same equations solved for all at once: of
// each vertex that may lean
//   area u = L^2 sum over its neighbours of w (u_near - u), projected onto what its column may do.
#include "mesher/common/vec.h"
#include "mesher/layers/direction_smoothing_work.h"
#include "mesher/layers/layers_normal.h"
#include "mesher/layers/layers_topology.h"
#include "mesher/layers/prism_quality.h"
#include "mesher/policy.h"
#include "surfaces.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

typedef struct {
  Surface wall;
  CwLayerInput in;
  CwLayerWork work;
  CwSmoothing smoothing;
  double *target, (*constraint_normal)[2][3];
  int32_t *constraint_count;
  CwTaskResults made;
} Flat;

// A lattice of nearly equilateral triangles of side 1, its inner points shaken by up to `shake`.
static void lattice(const void *context, double u, double v, double x[3]) {
  const int *side = context;
  int i = (int)lround(u * side[0]), j = (int)lround(v * side[1]);
  x[0] = i + 0.5 * (j % 2), x[1] = j * sqrt(0.75), x[2] = 0;
}

static void begin(Flat *flat, int nu, int nv, double shake, uint64_t *seed) {
  const int side[2] = {nu, nv};
  surface_grid(&flat->wall, lattice, side, nu, nv, 1);
  int32_t n = flat->wall.point_count;
  for (int32_t v = 0; v < n; v++)
    for (int k = 0; k < 2; k++) flat->wall.x[v][k] += shake * (2 * draw(seed) - 1);
  flat->target = malloc((size_t)n * sizeof *flat->target);
  flat->constraint_count = calloc((size_t)n, sizeof *flat->constraint_count);
  flat->constraint_normal = calloc((size_t)n, sizeof *flat->constraint_normal);
  for (int32_t v = 0; v < n; v++) flat->target[v] = 1;
  flat->in = (CwLayerInput){.point_count = n,
                            .x = (const double(*)[3])flat->wall.x,
                            .triangle_count = flat->wall.triangle_count,
                            .triangle = (const int32_t(*)[3])flat->wall.triangle,
                            .target = flat->target,
                            .constraint_count = flat->constraint_count,
                            .constraint_normal = (const double(*)[2][3])flat->constraint_normal};
  CwLayerWork *work = &flat->work;
  assert_int_equal(cw_layers_topology(&flat->in, work), CW_OK);
  for (int32_t v = 0; v < n; v++) {
    const double up[3] = {0, 0, 1};
    cw_copy(up, work->normal[v]);
    cw_copy(up, work->base[v]);
    work->normal_cos[v] = work->base_cos[v] = work->t[v] = 1;
    work->crease[v] = CW_CREASE_NONE;
  }
  flat->smoothing = (CwSmoothing){.work = work,
                                  .source = calloc((size_t)n, sizeof *flat->smoothing.source),
                                  .reach = malloc((size_t)n * sizeof *flat->smoothing.reach),
                                  .member = malloc((size_t)n * sizeof *flat->smoothing.member),
                                  .place = malloc((size_t)n * sizeof *flat->smoothing.place)};
}

static void add_source(Flat *flat, int32_t v, double opening, double ux, double uy) {
  double lean[3] = {ux, uy, flat->work.t[v]};
  flat->smoothing.source[flat->smoothing.source_count++] =
      (CwSmoothingSource){.vertex = v, .opening = opening, .thickness = flat->work.t[v], .u = {ux, uy, 0}};
  cw_unit(lean);
  cw_copy(lean, flat->work.base[v]);
  flat->work.base_cos[v] = lean[2];
}

// The nearest source as the crow flies, up to `reach`; sources are wholly given, and no members.
static void set_reach(Flat *flat, double reach) {
  CwSmoothing *smoothing = &flat->smoothing;
  for (int32_t v = 0; v < flat->work.n; v++) {
    CwSmoothingReach *at = &smoothing->reach[v];
    *at = (CwSmoothingReach){INFINITY, -1};
    for (int32_t i = 0; i < smoothing->source_count; i++) {
      double way = cw_distance(flat->in.x[v], flat->in.x[smoothing->source[i].vertex]);
      if (way <= reach && way < at->distance) *at = (CwSmoothingReach){way, i};
    }
    int is_member = at->source >= 0 && at->distance > 0;
    smoothing->place[v] = is_member ? smoothing->count : -1;
    if (is_member) smoothing->member[smoothing->count++] = v;
  }
}

static const CwLean *lean_of(const Flat *flat, int32_t place) {
  return (const CwLean *)flat->made.bytes[place / CW_SMOOTHING_BLOCK] + place % CW_SMOOTHING_BLOCK;
}

static void solve_blocks(Flat *flat) {
  CwSchedule schedule = {.step = "blocks",
                         .count = (flat->smoothing.count + CW_SMOOTHING_BLOCK - 1) / CW_SMOOTHING_BLOCK,
                         .run = cw_smoothing_solve_block,
                         .context = &flat->smoothing};
  assert_int_equal(cw_schedule_gather(NULL, &schedule, &flat->made), CW_OK);
}

static void end(Flat *flat) {
  cw_task_results_free(&flat->made);
  free(flat->smoothing.source);
  free(flat->smoothing.reach);
  free(flat->smoothing.member);
  free(flat->smoothing.place);
  cw_layers_work_free(&flat->work);
  free(flat->target);
  free(flat->constraint_count);
  free(flat->constraint_normal);
  surface_free(&flat->wall);
}

static double cotangent(const double at[3], const double a[3], const double b[3]) {
  double p[3], q[3];
  cw_sub(a, at, p);
  cw_sub(b, at, q);
  double cosine = cw_dot(p, q) / (cw_norm(p) * cw_norm(q));
  return cosine / sqrt(1 - cosine * cosine);
}

// L at v: 1.5 thicknesses times the opening, which fades over six of them; at least 0.7.
static double range_at(const Flat *flat, int32_t v) {
  const CwSmoothingReach *at = &flat->smoothing.reach[v];
  const CwSmoothingSource *source = &flat->smoothing.source[at->source];
  return 1.5 * flat->work.t[v] * fmax(0.7, source->opening * fmax(0, 1 - at->distance / (6 * source->thickness)));
}

// Onto what the column of v may do: nothing across its edge, or across what holds it, and nothing off the wall.
static void project(const Flat *flat, int32_t v, double u[3]) {
  double along[3] = {0}, h;
  int is_crease = flat->work.crease[v] != CW_CREASE_NONE;
  u[2] = 0;
  if (flat->constraint_count[v] == 2) u[0] = u[1] = 0;
  if (flat->constraint_count[v] == 1) cw_flatten(u, flat->constraint_normal[v][0]);
  if (!is_crease) return;
  cw_copy(flat->work.along[v], along);
  h = cw_dot(u, along);
  for (int k = 0; k < 3; k++) u[k] = h * along[k];
}

// Gauss-Seidel over the triangles, until nothing moves. A neighbour on a convex edge that is no source takes part in
// what it can do alone: across the edge it goes along with the vertex.
static double (*solve_all(const Flat *flat))[3] {
  const CwLayerInput *in = &flat->in;
  int32_t n = in->point_count;
  double(*u)[3] = calloc((size_t)n, sizeof *u), most = 1;
  for (int32_t i = 0; i < flat->smoothing.source_count; i++)
    cw_copy(flat->smoothing.source[i].u, u[flat->smoothing.source[i].vertex]);
  for (int sweep = 0; sweep < 2000 && most > 1e-9; sweep++) {
    most = 0;
    for (int32_t v = 0; v < n; v++) {
      if (flat->smoothing.place[v] < 0) continue;
      double sum[3] = {0}, weights = 0, area = 0, square = range_at(flat, v) * range_at(flat, v), old[3];
      cw_copy(u[v], old);
      for (int32_t k = flat->work.face_start[v]; k < flat->work.face_start[v + 1]; k++) {
        const int32_t *t = in->triangle[flat->work.face[k]];
        area += fabs(cw_twice_area(in->x[t[0]], in->x[t[1]], in->x[t[2]])) / 6;
        for (int i = 0; i < 3; i++) {
          int32_t w = t[i], third = t[0] + t[1] + t[2] - v - w;
          if (w == v) continue;
          double weight = 0.5 * fmin(fmax(cotangent(in->x[third], in->x[v], in->x[w]), 0.05), 5), near[3];
          cw_copy(u[w], near);
          if (flat->work.crease[w] == CW_CREASE_CONVEX && flat->smoothing.place[w] >= 0) {
            const double *along = flat->work.along[w];
            double h = cw_dot(near, along), own = cw_dot(old, along);
            for (int c = 0; c < 3; c++) near[c] = old[c] + (h - own) * along[c];
          }
          for (int c = 0; c < 3; c++) sum[c] += weight * near[c];
          weights += weight;
        }
      }
      for (int c = 0; c < 3; c++) u[v][c] = square * sum[c] / (area + square * weights);
      project(flat, v, u[v]);
      most = fmax(most, cw_distance(u[v], old));
    }
  }
  return u;
}

// Compares displacements, and columns with what these make of them; returns the greatest displacement of a member.
static double compare(const Flat *flat, double tolerance) {
  double(*wanted)[3] = solve_all(flat), most = 0;
  for (int32_t i = 0; i < flat->smoothing.count; i++) {
    int32_t v = flat->smoothing.member[i];
    const CwLean *lean = lean_of(flat, i);
    assert_near(lean->widen, 1, 0);
    assert_int_equal(lean->changed, 1);
    assert_near(cw_distance(lean->u, wanted[v]) / flat->work.t[v], 0, tolerance);
    assert_near(lean->u[2], 0, 1e-15);
    assert_near(lean->column[2], 1, 1e-12); // its thickness
    for (int k = 0; k < 2; k++) assert_near(lean->column[k], lean->u[k] / flat->work.t[v], 1e-12);
    most = fmax(most, cw_norm(lean->u));
  }
  free(wanted);
  return most;
}

static void random_sources(Flat *flat, int one_in, double most, uint64_t *seed) {
  for (int32_t v = 0; v < flat->work.n; v++) flat->work.t[v] = 0.8 + 0.4 * draw(seed);
  for (int32_t v = 0; v < flat->work.n; v++) {
    if (draw_below(seed, one_in)) continue;
    double ux = most * (2 * draw(seed) - 1), uy = most * (2 * draw(seed) - 1);
    add_source(flat, v, 1.6 * draw(seed), ux, uy);
  }
}

static void one_block(void **state) {
  for (int i = 0; i < 6; i++) {
    uint64_t seed = 11 + i;
    Flat flat = {0};
    begin(&flat, 24, 24, 0.15, &seed);
    random_sources(&flat, i % 2 ? 8 : 40, 0.15, &seed);
    set_reach(&flat, 3 + i % 3);
    solve_blocks(&flat);
    assert_true(compare(&flat, 3e-3) > 0.05);
    end(&flat);
  }
}

// Blocks side by side go together, but for what one sweep of a neighbour would still change.
static void two_blocks(void **state) {
  uint64_t seed = 21;
  Flat flat = {0};
  begin(&flat, 70, 70, 0.15, &seed);
  random_sources(&flat, 20, 0.25, &seed);
  set_reach(&flat, 6);
  assert_true(flat.smoothing.count > CW_SMOOTHING_BLOCK);
  solve_blocks(&flat);
  assert_int_equal(flat.made.count, 2);
  assert_true(compare(&flat, 5e-3) > 0.1);
  end(&flat);
}

// Columns on a convex edge lean along it, those in a plane within it, those on a line not at all, and columns beside
// the edge do not feel that it cannot lean across.
static void held_columns(void **state) {
  uint64_t seed = 31;
  for (int i = 0; i < 6; i++) {
    Flat flat = {0};
    begin(&flat, 24, 24, 0.1, &seed);
    random_sources(&flat, 30, 0.25, &seed);
    for (int32_t v = 0; v < flat.work.n; v++) {
      double angle = i * 0.5, turn[3] = {cos(angle), sin(angle), 0};
      int row = v % 25, kind = row == 8 ? 1 : row == 12 ? 2 : row == 16 ? 3 : row == 20 ? 4 : 0;
      if (kind == 1 || kind == 4) {
        flat.work.crease[v] = CW_CREASE_CONVEX;
        cw_copy(turn, flat.work.along[v]);
      }
      if (kind > 1) flat.constraint_count[v] = kind == 3 ? 2 : 1;
      if (kind == 4) turn[0] = -sin(angle), turn[1] = cos(angle); // the edge runs in the plane
      if (kind > 1) cw_copy(turn, flat.constraint_normal[v][0]);
    }
    int32_t kept = 0; // sources on edges that nothing holds, and elsewhere
    for (int32_t s = 0; s < flat.smoothing.source_count; s++) {
      int32_t v = flat.smoothing.source[s].vertex;
      if (!flat.constraint_count[v])
        flat.smoothing.source[kept++] = flat.smoothing.source[s];
      else
        flat.work.base_cos[v] = 1, flat.work.base[v][0] = flat.work.base[v][1] = 0, flat.work.base[v][2] = 1;
    }
    flat.smoothing.source_count = kept;
    set_reach(&flat, 5);
    solve_blocks(&flat);
    compare(&flat, 3e-3);
    end(&flat);
  }
}

// However far a source leans, a column beside it keeps its thickness and a cosine of 0.3.
static void no_column_leans_too_far(void **state) {
  uint64_t seed = 41;
  int limited = 0;
  for (int i = 0; i < 8; i++) {
    Flat flat = {0};
    begin(&flat, 12, 12, 0.1, &seed);
    add_source(&flat, 6 * 13 + 6, 1, 4.0 * (i + 1), i);
    set_reach(&flat, 4);
    solve_blocks(&flat);
    for (int32_t k = 0; k < flat.smoothing.count; k++) {
      const CwLean *lean = lean_of(&flat, k);
      double flat_lean = hypot(lean->column[0], lean->column[1]), asked = hypot(lean->u[0], lean->u[1]);
      assert_near(lean->column[2], 1, 1e-12);
      assert_true(1 / hypot(1, flat_lean) >= 0.3);
      if (asked < 3) { // as asked, and halved until it is allowed where that is more
        assert_near(flat_lean, asked, 1e-9);
      } else if (asked > 3.2) {
        double halvings = log2(asked / flat_lean);
        assert_near(halvings, round(halvings), 1e-9);
        assert_true(1 / hypot(1, 2 * flat_lean) < 0.3);
        limited++;
      }
      assert_true(lean->u[0] * lean->column[1] - lean->u[1] * lean->column[0] < 1e-9);
    }
    end(&flat);
  }
  assert_true(limited > 10);
}

// The worst prism over triangles without a source, where the members have these displacements.
static double worst_prism(const Flat *flat, const double (*u)[3]) {
  double least = INFINITY;
  for (int32_t f = 0; f < flat->in.triangle_count; f++) {
    const int32_t *t = flat->in.triangle[f];
    double top[3][3];
    const double *a[3], *b[3];
    for (int k = 0; k < 3; k++) {
      for (int c = 0; c < 3; c++) top[k][c] = flat->in.x[t[k]][c] + u[t[k]][c] + (c == 2) * flat->work.t[t[k]];
      a[k] = flat->in.x[t[k]], b[k] = top[k];
    }
    least = fmin(least, cw_prism_quality(a, b));
  }
  return least;
}

// A single column that leans over several fine triangles would turn prisms over; a wider smoothing keeps them.
static void fine_walls_are_smoothed_wider(void **state) {
  uint64_t seed = 51;
  for (int i = 0; i < 3; i++) {
    Flat flat = {0};
    begin(&flat, 40, 40, 0.1, &seed);
    for (int32_t v = 0; v < flat.work.n; v++) flat.work.t[v] = 4;
    add_source(&flat, 20 * 41 + 20, 0.6, 2.8 + 0.1 * i, 0.5);
    set_reach(&flat, 16);
    solve_blocks(&flat);
    double(*plain)[3] = solve_all(&flat), (*wide)[3] = calloc((size_t)flat.work.n, sizeof *wide), widest = 1;
    cw_copy(flat.smoothing.source[0].u, wide[flat.smoothing.source[0].vertex]);
    for (int32_t k = 0; k < flat.smoothing.count; k++) {
      const CwLean *lean = lean_of(&flat, k);
      assert_true(lean->widen >= 1 && lean->widen <= 5);
      widest = fmax(widest, lean->widen);
      cw_copy(lean->u, wide[flat.smoothing.member[k]]);
    }
    double before = worst_prism(&flat, (const double(*)[3])plain), after = worst_prism(&flat, (const double(*)[3])wide);
    print_message("  worst prism %.3f, widened up to %.2f: %.3f\n", before, widest, after);
    assert_true(before < 0.2 && after > before + 0.05 && widest >= 1.4);
    free(plain);
    free(wide);
    end(&flat);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_block),
      cmocka_unit_test(two_blocks),
      cmocka_unit_test(held_columns),
      cmocka_unit_test(no_column_leans_too_far),
      cmocka_unit_test(fine_walls_are_smoothed_wider),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
