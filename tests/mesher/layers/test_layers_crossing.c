// SPDX-License-Identifier: AGPL-3.0-or-later
// Which triangles of layer top, wall and open patches cross, against every edge tried with every triangle; and what is
// said of those that thinner columns do not part.
#include "mesher/common/vec.h"
#include "mesher/layers/layers_crossing.h"
#include "mesher/layers/layers_topology.h"
#include "surfaces.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

enum { SIDE = 8, PATCHES = 25 };

typedef struct {
  Surface wall, open_patch;
  CwLayerInput in;
  CwLayerWork work;
  CwLayerCrossing crossing;
  double (*top)[3], *target;
  int32_t *constraint_count;
} Stack;

static void bumpy(const void *context, double u, double v, double x[3]) {
  uint64_t *seed = (uint64_t *)context;
  x[0] = SIDE * u + 0.2 * draw(seed);
  x[1] = SIDE * v + 0.2 * draw(seed);
  x[2] = 0.3 * draw(seed);
}

// Two bumpy walls, the one through the other in places, and loose triangles of an open patch above them; one vertex in
// `one_in` held by a constraint, 0: none.
static void begin(Stack *s, int one_in, uint64_t *seed) {
  surface_grid(&s->wall, bumpy, seed, SIDE, SIDE, 1);
  surface_grid(&s->wall, bumpy, seed, SIDE, SIDE, 0);
  int32_t n = s->wall.point_count;
  for (int32_t v = n / 2; v < n; v++) s->wall.x[v][2] += 0.24;
  for (int i = 0; i < PATCHES; i++) {
    double middle[3] = {SIDE * draw(seed), SIDE * draw(seed), 0.6 + 0.6 * draw(seed)};
    int32_t corner[3];
    for (int k = 0; k < 3; k++) {
      double x[3];
      for (int c = 0; c < 3; c++) x[c] = middle[c] + 1.4 * draw(seed) - 0.7;
      corner[k] = surface_point(&s->open_patch, x);
    }
    surface_triangle(&s->open_patch, corner[0], corner[1], i ? corner[2] : corner[1]); // the first without area
  }
  s->target = malloc((size_t)n * sizeof *s->target);
  s->top = malloc((size_t)n * sizeof *s->top);
  s->constraint_count = calloc((size_t)n, sizeof *s->constraint_count);
  double(*normal)[2][3] = calloc((size_t)n, sizeof *normal);
  for (int32_t v = 0; v < n; v++) {
    s->target[v] = 1;
    s->constraint_count[v] = one_in > 0 && draw_below(seed, one_in) == 0;
    normal[v][0][0] = 1;
  }
  s->in = (CwLayerInput){.point_count = n,
                         .x = (const double(*)[3])s->wall.x,
                         .triangle_count = s->wall.triangle_count,
                         .triangle = (const int32_t(*)[3])s->wall.triangle,
                         .target = s->target,
                         .constraint_count = s->constraint_count,
                         .constraint_normal = (const double(*)[2][3])normal,
                         .obstacle_point_count = s->open_patch.point_count,
                         .obstacle_x = (const double(*)[3])s->open_patch.x,
                         .obstacle_triangle_count = s->open_patch.triangle_count,
                         .obstacle_triangle = (const int32_t(*)[3])s->open_patch.triangle};
  assert_int_equal(cw_layers_topology(&s->in, &s->work), CW_OK);
  assert_int_equal(cw_layers_crossing_make(&s->work, &s->crossing), CW_OK);
}

static void end(Stack *s) {
  cw_layers_crossing_free(&s->crossing);
  cw_layers_work_free(&s->work);
  free((void *)s->in.constraint_normal);
  free(s->constraint_count);
  free(s->target);
  free(s->top);
  surface_free(&s->wall);
  surface_free(&s->open_patch);
}

static void move(Stack *s, int32_t v, uint64_t *seed) {
  for (int k = 0; k < 3; k++) s->top[v][k] = s->wall.x[v][k] + (k == 2 ? 0.9 : 1.6) * (draw(seed) - (k < 2) * 0.5);
}

// Corners as numbers of layer top, wall and open patches, and their places.
static void corners(const Stack *s, int kind, int32_t f, int32_t number[3], const double *x[3]) {
  const int32_t *t = kind == 2 ? s->open_patch.triangle[f] : s->wall.triangle[f];
  for (int i = 0; i < 3; i++) {
    number[i] = t[i] + kind * s->in.point_count;
    x[i] = kind == 0 ? s->top[t[i]] : kind == 1 ? s->wall.x[t[i]] : s->open_patch.x[t[i]];
  }
}

static double volume(const double a[3], const double b[3], const double c[3], const double d[3]) {
  double p[3], q[3], r[3], m[3];
  cw_sub(b, a, p);
  cw_sub(c, a, q);
  cw_sub(d, a, r);
  cw_cross(p, q, m);
  return cw_dot(m, r);
}

static int pierces(const double p[3], const double q[3], const double *const t[3]) {
  if ((volume(t[0], t[1], t[2], p) > 0) == (volume(t[0], t[1], t[2], q) > 0)) return 0;
  int side = volume(p, q, t[0], t[1]) > 0;
  return (volume(p, q, t[1], t[2]) > 0) == side && (volume(p, q, t[2], t[0]) > 0) == side;
}

// In places at random two triangles cross where an edge of one pierces the other, an edge that has no corner of it; two
// with an edge in common never do.
static int do_cross(const Stack *s, int kind_f, int32_t f, int kind_g, int32_t g) {
  int32_t a[3], b[3], shared = 0;
  const double *p[3], *q[3];
  corners(s, kind_f, f, a, p);
  corners(s, kind_g, g, b, q);
  for (int i = 0; i < 9; i++) shared += a[i / 3] == b[i % 3];
  if (shared > 1) return 0;
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, in_b = 0, in_a = 0;
    for (int k = 0; k < 3; k++) {
      in_b |= a[i] == b[k] || a[j] == b[k];
      in_a |= b[i] == a[k] || b[j] == a[k];
    }
    if (!in_b && pierces(p[i], p[j], q)) return 1;
    if (!in_a && pierces(q[i], q[j], p)) return 1;
  }
  return 0;
}

static int has_pair(const Stack *s, int kind_f, int32_t f, int kind_g, int32_t g) {
  int found = 0;
  for (int32_t i = 0; i < s->crossing.pair_count; i++) {
    const CwLayerPair *p = &s->crossing.pair[i];
    int same = p->kind_f == kind_f && p->kind_g == kind_g && p->f == f && p->g == g;
    int turned = p->kind_f == kind_g && p->kind_g == kind_f && p->f == g && p->g == f;
    found += same || turned;
  }
  return found;
}

static int is_held(const Stack *s, int32_t f) {
  const int32_t *t = s->wall.triangle[f];
  return s->constraint_count[t[0]] + s->constraint_count[t[1]] + s->constraint_count[t[2]] > 0;
}

// Every pair that crosses is there once, and no other. counts: of layer top with itself, the wall and open patches, and
// of the wall with itself, which never moves.
static void check_pairs(const Stack *s, int counts[4]) {
  int32_t m = s->wall.triangle_count, total = 0;
  memset(counts, 0, 4 * sizeof *counts);
  for (int32_t f = 0; f < m; f++) {
    for (int32_t g = 0; g < m; g++) {
      int top = g > f && do_cross(s, 0, f, 0, g), under = do_cross(s, 0, f, 1, g);
      int wall = g > f && do_cross(s, 1, f, 1, g);
      if (g > f) assert_int_equal(has_pair(s, 0, f, 0, g), top);
      if (g > f) assert_int_equal(has_pair(s, 1, f, 1, g), wall);
      assert_int_equal(has_pair(s, 0, f, 1, g), under);
      counts[0] += top, counts[1] += under, counts[3] += wall;
    }
    for (int32_t g = 0; g < s->open_patch.triangle_count; g++) {
      int open = g > 0 && !is_held(s, f) && do_cross(s, 0, f, 2, g);
      assert_int_equal(has_pair(s, 0, f, 2, g), open);
      counts[2] += open;
    }
  }
  for (int k = 0; k < 4; k++) total += counts[k];
  assert_int_equal(s->crossing.pair_count, total);
}

// The first search, and those after parts of the columns moved.
static void pairs_are_those_that_cross(void **state) {
  for (int i = 0; i < 3; i++) {
    uint64_t seed = 3 + i;
    int counts[4];
    Stack s = {0};
    begin(&s, i == 0 ? 0 : 6, &seed);
    uint8_t *moved = malloc((size_t)s.in.point_count);
    for (int step = 0; step < 4; step++) {
      for (int32_t v = 0; v < s.in.point_count; v++) {
        moved[v] = step == 0 || (step < 3 && draw_below(&seed, 12) == 0); // nothing in the last step
        if (moved[v]) move(&s, v, &seed);
      }
      assert_int_equal(cw_layers_crossing_find(&s.crossing, (const double(*)[3])s.top, moved), CW_OK);
      check_pairs(&s, counts);
      for (int k = 0; k < 4; k++) assert_true(counts[k] > 0);
    }
    print_message("  layer top %d, with the wall %d, with open patches %d\n", counts[0], counts[1], counts[2]);
    free(moved);
    end(&s);
  }
}

// Right columns of a bumpy plate cross nothing, though all neighbours touch; two that fold a triangle flat onto the
// next one do.
static void neighbours_cross_where_folded(void **state) {
  Surface wall = {0};
  double target[4] = {1, 1, 1, 1}, top[4][3];
  uint8_t moved[4] = {1, 1, 1, 1};
  for (int v = 0; v < 4; v++) surface_point(&wall, (const double[3]){v % 2, v / 2, 0});
  surface_triangle(&wall, 0, 2, 1);
  surface_triangle(&wall, 1, 2, 3);
  CwLayerInput in = {.point_count = 4,
                     .x = (const double(*)[3])wall.x,
                     .triangle_count = 2,
                     .triangle = (const int32_t(*)[3])wall.triangle,
                     .target = target};
  CwLayerWork work = {0};
  CwLayerCrossing crossing = {0};
  assert_int_equal(cw_layers_topology(&in, &work), CW_OK);
  assert_int_equal(cw_layers_crossing_make(&work, &crossing), CW_OK);
  const double corner[5][3] = {{1, 1, 1}, {0.6, 0.6, 1.5}, {0.3, 0.3, 1.5}, {0.2, 0.2, 1}, {2, 2, 1}};
  for (int i = 0; i < 5; i++) {
    for (int v = 0; v < 4; v++) cw_copy(v == 3 ? corner[i] : (const double[3]){v % 2, v / 2, 1}, top[v]);
    assert_int_equal(cw_layers_crossing_find(&crossing, (const double(*)[3])top, moved), CW_OK);
    assert_int_equal(crossing.pair_count, i == 3);
  }
  cw_layers_crossing_free(&crossing);
  cw_layers_work_free(&work);
  surface_free(&wall);
}

// A column of more than a hundredth of its target, of either triangle, may still get clear; else what is crossed is
// named, at the first corner. Other planes may help where a plane holds that one.
static void what_no_thinner_column_parts(void **state) {
  const double x[6][3] = {{3, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  const int32_t triangle[2][3] = {{0, 1, 2}, {3, 4, 5}};
  const double target[6] = {2, 2, 2, 2, 2, 2};
  const char *crossed[3] = {"the layer top crosses itself", "crosses the wall", "crosses an open patch"};
  for (int kind = 0; kind < 3; kind++) {
    for (int high = -1; high < 6; high++) {
      int32_t held[6] = {kind == 1}; // by a plane
      double t[6];
      for (int v = 0; v < 6; v++) t[v] = v == high ? 0.021 : 0.019;
      CwLayerInput in = {.x = x, .triangle = triangle, .target = target, .constraint_count = held};
      CwLayerWork work = {.in = &in, .t = t};
      CwLayerPair pair = {0, 1, 0, kind};
      CwLayerCrossing crossing = {.work = &work, .pair_count = 1, .pair = &pair};
      CwOutcome outcome = {0};
      cw_layers_crossing_judge(&crossing, &outcome);
      if (high >= 0 && (high < 3 || kind == 0)) {
        assert_int_equal(outcome.kind, CW_OUTCOME_DONE);
      } else {
        assert_int_equal(outcome.kind, kind == 1 ? CW_OUTCOME_REPLAN : CW_OUTCOME_PINCH);
        assert_non_null(strstr(outcome.reason, crossed[kind]));
        assert_int_equal(outcome.places, 1);
        assert_memory_equal(outcome.place[0], x[0], sizeof x[0]);
      }
    }
  }
  const double t[6] = {2, 2, 2, 2, 2, 2};
  CwLayerInput in = {.x = x, .triangle = triangle, .target = target};
  CwLayerWork work = {.in = &in, .t = (double *)t};
  CwLayerPair pair[2] = {{0, 1, 0, 0}, {0, 1, 1, 1}};
  CwLayerCrossing crossing = {.work = &work, .pair_count = 2, .pair = pair};
  CwOutcome outcome = {0};
  cw_layers_crossing_judge(&crossing, &outcome); // the second: no thickness parts walls
  assert_int_equal(outcome.kind, CW_OUTCOME_FINER);
  assert_non_null(strstr(outcome.reason, "the wall crosses or touches itself"));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(pairs_are_those_that_cross),
      cmocka_unit_test(neighbours_cross_where_folded),
      cmocka_unit_test(what_no_thinner_column_parts),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
