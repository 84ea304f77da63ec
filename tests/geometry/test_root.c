// SPDX-License-Identifier: AGPL-3.0-or-later
// Roots that are known: of cubics at random, of steep and of flat functions, and of those that have none.
#include "geometry/root.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

static int calls; // of the function, since it was set to 0

// scale (x - root) (1 + bend (x - root)^2): one root
static double cubic(double x, const void *context) {
  const double *p = context, d = x - p[0];
  calls++;
  return p[1] * d * (1 + p[2] * d * d);
}

static void cubics(void **state) {
  uint64_t seed = 1;
  int most = 0;
  for (int i = 0; i < 5000; i++) {
    const double root = 20 * draw(&seed) - 10, scale = (i % 2 ? 1 : -1) * pow(10, 12 * draw(&seed) - 6);
    const double p[3] = {root, scale, 100 * draw(&seed)};
    const double a = root - 10 * draw(&seed) - 1e-3, b = root + 10 * draw(&seed) + 1e-3;
    calls = 0;
    assert_near(cw_root_find(cubic, p, a, b), root, 4e-15 * (1 + fabs(root)));
    if (calls > most) most = calls;
    assert_near(cw_root_find(cubic, p, b, a), root, 4e-15 * (1 + fabs(root)));
  }
  print_message("  at most %d calls\n", most);
  assert_true(most < 60);
}

static double steep(double x, const void *context) {
  const double *root = context;
  return atan(1e6 * (x - *root));
}

static double flat(double x, const void *context) {
  const double *root = context;
  return pow(x - *root, 3);
}

static double exponential(double x, const void *context) {
  const double *level = context;
  return exp(x) - *level;
}

static void other_functions(void **state) {
  uint64_t seed = 2;
  for (int i = 0; i < 500; i++) {
    const double root = draw(&seed), level = exp(10 * root);
    assert_near(cw_root_find(steep, &root, -1, 2), root, 1e-14);
    assert_near(cw_root_find(flat, &root, -1, 3), root, 1e-5); // where it is 1e-15 of what it is at the ends
    assert_near(cw_root_find(exponential, &level, -30, 11), 10 * root, 1e-13);
  }
}

static double none(double x, const void *context) {
  return x > 0.5 ? NAN : x;
}

static void ends_of_the_interval(void **state) {
  const double p[3] = {1, 2, 0}, not_there = -1;
  assert_near(cw_root_find(cubic, p, 1, 3), 1, 0);
  assert_near(cw_root_find(cubic, p, -4, 1), 1, 0);
  assert_true(isnan(cw_root_find(cubic, p, 2, 3)));
  assert_true(isnan(cw_root_find(cubic, p, -3, 0)));
  assert_true(isnan(cw_root_find(exponential, &not_there, -5, 5)));
  assert_true(isnan(cw_root_find(none, NULL, -1, 1)));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cubics),
      cmocka_unit_test(other_functions),
      cmocka_unit_test(ends_of_the_interval),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
