// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "closed_surfaces.h"
#include "mesher/common/vec.h"
#include "mesher/fill/fill_points.h"
#include "mesher/policy.h"
#include "tests/unit_test.h"

typedef struct {
  double size, growth; // size + growth * |x|
  int along;           // of the first coordinate alone
} Field;

static double size_at(const void *context, const double x[3]) {
  const Field *f = context;
  return f->size + f->growth * (f->along ? fabs(x[0]) : sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]));
}

static CwFillInput input_of(const Surface *s, const Field *field) {
  return surface_fill_input(s, size_at, field);
}

static const double origin[3] = {0, 0, 0};

static int32_t make(const Surface *s, const Field *field, double (**x)[3]) {
  CwFillInput input = input_of(s, field);
  int32_t count;
  if (cw_fill_points(&input, 1.0, &count, x, NULL) != CW_OK) fail_msg("%s", cw_fail_message());
  return count;
}

static int32_t points_in(const double low[3], const double high[3], const int n[3], const Field *field, double (**x)[3],
                         Surface *s) {
  surface_add_box(s, low, high, n, 1);
  return make(s, field, x);
}

static void lattice_has_the_asked_density_and_keeps_its_distance(void **state) {
  Surface s = {0};
  double(*x)[3];
  const Field field = {0.002, 0.0, 1};
  int32_t count = points_in((double[3]){0, 0, 0}, (double[3]){0.04, 0.04, 0.04}, (int[3]){20, 20, 20}, &field, &x, &s);
  int32_t core = 0;
  for (int32_t i = 0; i < count; i++) {
    int within = 1;
    for (int k = 0; k < 3; k++) {
      assert_true(x[i][k] > 0.6 * 0.002 && x[i][k] < 0.04 - 0.6 * 0.002);
      within &= x[i][k] > 0.01 && x[i][k] < 0.03;
    }
    core += within;
  }
  // Two points in a cube of edge 2^(1/6) h: sqrt(2) in h^3; a thousand h^3 in the core, whose faces fall
  // between planes of the lattice: 17 or 18 half cells along each edge.
  assert_true(core > 0.85 * 1414 && core < 1.15 * 1414);
  free(x);
  surface_free(&s);
}

static void two_shapes_of_one_size_field_agree_in_density(void **state) {
  Surface s = {0};
  double(*x)[3];
  const Field field = {0.001, 0.04, 1}; // 1 mm to 2.6 mm along 40 mm
  int32_t count = points_in((double[3]){0, 0, 0}, (double[3]){0.04, 0.02, 0.02}, (int[3]){40, 20, 20}, &field, &x, &s);
  double wanted = 0.0; // integral of sqrt(2) / h^3 less the shell of 0.62 h
  for (int k = 0; k < 1000; k++) {
    double at = 0.04 * (k + 0.5) / 1000.0, h = field.size + field.growth * at, side = 0.02 - 1.24 * h;
    wanted += sqrt(2.0) * side * side * 0.04 / 1000.0 / (h * h * h);
  }
  assert_true(count > 0.8 * wanted && count < 1.2 * wanted);
  free(x);
  surface_free(&s);
}

static void nothing_fits_into_a_gap_below_the_size(void **state) {
  Surface s = {0};
  double(*x)[3];
  const Field field = {0.002, 0.0, 1};
  int32_t count = points_in((double[3]){0, 0, 0}, (double[3]){0.02, 0.02, 0.002}, (int[3]){10, 10, 1}, &field, &x, &s);
  assert_int_equal(count, 0);
  free(x);
  surface_free(&s);
}

// Two points a cell of the lattice, half of h off the outer sphere, half of an edge off the void, whose triangles are
// finer than h.
static void uniform_ball_with_a_void(void **unused) {
  Surface s = {0};
  double(*x)[3], h = 0.0036, a = 1.122462048309373 * h;
  surface_add_sphere(&s, origin, 0.05, 4, 1);
  surface_add_sphere(&s, origin, 0.02, 3, 0);
  Field field = {h, 0, 0};
  int32_t count = make(&s, &field, &x);
  double nearest = INFINITY, edge = 0.0;
  for (int k = 0; k < 3; k++) { // of a triangle of the void, which was added last
    const int32_t *t = s.triangle[s.triangle_count - 1];
    double d[3];
    cw_sub(s.x[t[k]], s.x[t[(k + 1) % 3]], d);
    edge = fmax(edge, cw_norm(d));
  }
  assert_true(edge < 0.85 * h);
  for (int32_t p = 0; p < count; p++) {
    double r = cw_norm(x[p]);
    assert_true(r < 0.05 - 0.5 * h && r > 0.02 + 0.4 * edge);
    nearest = fmin(nearest, r - 0.02);
  }
  assert_true(nearest < 0.48 * h);
  double low = 0.02 + 0.5 * h, high = 0.05 - 0.62 * h;
  double wanted = 4.0 / 3.0 * 3.141592653589793 * (pow(high, 3) - pow(low, 3)) * 2.0 / (a * a * a);
  assert_true(count > 0.9 * wanted && count < 1.05 * wanted);
  free(x);
  surface_free(&s);
}

// As many points as a field asks for that grows by a factor of 2.4: cells double, but the sum is fitted.
static void graded_ball(void **unused) {
  Surface s = {0};
  double(*x)[3], lattice = 1.122462048309373, wanted = 0.0;
  surface_add_sphere(&s, origin, 0.05, 4, 1);
  Field field = {0.0015, 0.045, 0};
  int32_t count = make(&s, &field, &x), inner = 0;
  for (int32_t p = 0; p < count; p++) inner += x[p][0] * x[p][0] + x[p][1] * x[p][1] + x[p][2] * x[p][2] < 2.116e-3;
  for (int k = 0; k < 1000; k++) { // integral of 2 / a^3 over the ball of radius 0.046
    double r = 0.046 * (k + 0.5) / 1000, at[3] = {r, 0, 0}, a = lattice * size_at(&field, at);
    wanted += 4.0 * 3.141592653589793 * r * r * 0.046 / 1000 * 2.0 / (a * a * a);
  }
  assert_true(inner > 0.85 * wanted && inner < 1.15 * wanted);
  free(x);
  surface_free(&s);
}

static void equal_bits_twice_and_no_duplicates(void **unused) {
  Surface s = {0};
  double(*one)[3], (*two)[3];
  surface_add_box(&s, (double[3]){0, 0, 0}, (double[3]){0.04, 0.03, 0.02}, (int[3]){10, 8, 5}, 1);
  Field field = {0.003, 0.02, 0};
  int32_t count = make(&s, &field, &one);
  assert_int_equal(make(&s, &field, &two), count);
  assert_memory_equal(one, two, (size_t)count * sizeof *one);
  for (int32_t p = 0; p < count; p++) {
    for (int i = 0; i < 3; i++) assert_true(one[p][i] > 0.0 && one[p][i] < 0.04);
    for (int32_t q = 0; q < p; q++) assert_true(cw_distance(one[p], one[q]) > 0.001);
  }
  free(one);
  free(two);
  surface_free(&s);
}

// Over the top of a box, whose triangles come last: one for about two triangles, apart from one another, and points of
// the lattice apart from them. No clear cell holds one.
static void row_stands_over_the_last_triangles(void **unused) {
  enum { N = 10 };
  Surface s = {0};
  double(*x)[3], edge = 0.002, h = 0.0023, nearest = INFINITY;
  CwLatticeSite *site;
  int32_t count, row = 0;
  surface_add_box(&s, origin, (double[3]){N * edge, N * edge, N * edge}, (int[3]){N, N, N}, 1);
  Field field = {h, 0, 0};
  CwFillInput input = input_of(&s, &field);
  input.offset_count = 2 * N * N;
  double spacing = cbrt(h * h * sqrt(4.0 / 3.0) * edge); // the root of the mean square of 1, 1 and sqrt(2)
  assert_int_equal(cw_fill_points(&input, 1.0, &count, &x, &site), CW_OK);
  for (int32_t p = 0; p < count; p++) {
    assert_true(p == 0 || site[p].key > site[p - 1].key);
    row += site[p].key >= CW_LATTICE_NO_PLACE;
  }
  assert_true(row > 0.35 * input.offset_count && row < 0.6 * input.offset_count);
  for (int32_t p = count - row; p < count; p++) {
    assert_near(x[p][2], N * edge - sqrt(2.0 / 3) * spacing, 1e-12);
    for (int32_t q = 0; q < p; q++) {
      double distance = cw_distance(x[p], x[q]);
      assert_true(distance > cw_policy.least_distance * spacing * (1 - 1e-12));
      nearest = fmin(nearest, q < count - row ? distance : INFINITY);
      if (q < count - row && site[q].clear && (site[q].key >> site[q].level & 1)) { // a centre
        int within = 1;
        for (int i = 0; i < 3; i++) within &= fabs(x[p][i] - x[q][i]) < 0.49 * 1.122462 * h;
        assert_false(within);
      }
    }
  }
  assert_true(nearest < spacing);
  free(x);
  free(site);
  surface_free(&s);
}

// In slabs just those of all points that lie there, in their order.
static void slabs_hold_their_points_alone(void **unused) {
  Surface s = {0};
  const CwFillSlab slab[2] = {{{{1, 0, 0}, 0.02}, 0.003}, {{{0, 0.6, 0.8}, -0.01}, 0.002}};
  double(*all)[3], (*some)[3];
  int32_t count, slab_count, found = 0;
  surface_add_sphere(&s, origin, 0.05, 4, 1);
  Field field = {0.002, 0.05, 0};
  CwFillInput input = input_of(&s, &field);
  input.offset_count = s.triangle_count / 2;
  assert_int_equal(cw_fill_points(&input, 1.0, &count, &all, NULL), CW_OK);
  input.slab_count = 2;
  input.slab = slab;
  assert_int_equal(cw_fill_points(&input, 1.0, &slab_count, &some, NULL), CW_OK);
  for (int32_t p = 0; p < count; p++) {
    int within = 0;
    for (int k = 0; k < 2; k++) within |= fabs(cw_plane_distance(&slab[k].plane, all[p])) <= slab[k].reach;
    if (!within) continue;
    assert_true(found < slab_count);
    assert_memory_equal(some[found++], all[p], sizeof *all);
  }
  assert_int_equal(found, slab_count);
  assert_true(found > 100 && found < count / 2);
  free(all);
  free(some);
  surface_free(&s);
}

static void wrong_size_field_is_an_error(void **unused) {
  Surface s = {0};
  double(*x)[3];
  int32_t count;
  surface_add_sphere(&s, origin, 0.05, 1, 1);
  Field field = {0, 0, 0};
  CwFillInput input = input_of(&s, &field);
  assert_int_equal(cw_fill_points(&input, 1.0, &count, &x, NULL), CW_ERR_MESH);
  assert_non_null(strstr(cw_fail_message(), "size field"));
  field.size = 1e-9;
  assert_int_equal(cw_fill_points(&input, 1.0, &count, &x, NULL), CW_ERR_MESH);
  assert_non_null(strstr(cw_fail_message(), "the size field asks for edges of 1e-06 mm in a region of "));
  surface_free(&s);
}

// Twice the distances: fewer points, none nearer than h.
static void clearance_keeps_points_away(void **unused) {
  Surface s = {0};
  double(*x)[3], h = 0.0036;
  surface_add_sphere(&s, origin, 0.05, 4, 1);
  Field field = {h, 0, 0};
  CwFillInput input = input_of(&s, &field);
  int32_t count;
  assert_int_equal(cw_fill_points(&input, 2.0, &count, &x, NULL), CW_OK);
  assert_true(count > 1000);
  for (int32_t p = 0; p < count; p++)
    assert_true(sqrt(x[p][0] * x[p][0] + x[p][1] * x[p][1] + x[p][2] * x[p][2]) < 0.05 - 0.95 * h);
  free(x);
  surface_free(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lattice_has_the_asked_density_and_keeps_its_distance),
      cmocka_unit_test(two_shapes_of_one_size_field_agree_in_density),
      cmocka_unit_test(nothing_fits_into_a_gap_below_the_size),
      cmocka_unit_test(uniform_ball_with_a_void),
      cmocka_unit_test(graded_ball),
      cmocka_unit_test(clearance_keeps_points_away),
      cmocka_unit_test(equal_bits_twice_and_no_duplicates),
      cmocka_unit_test(row_stands_over_the_last_triangles),
      cmocka_unit_test(slabs_hold_their_points_alone),
      cmocka_unit_test(wrong_size_field_is_an_error),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
