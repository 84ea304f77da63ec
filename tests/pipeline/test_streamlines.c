// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/report/streamlines.h"
#include "tests/unit_test.h"

enum { WIDTH = 240, HEIGHT = 160 };
static const double APART = 12;

static float velocity[WIDTH * HEIGHT][2];
static uint16_t group[WIDTH * HEIGHT];
static CwStreamlines lines;

// Round the middle by the clock, as the picture shows it.
static void turning(double x, double y, float *v) {
  v[0] = (float)(HEIGHT / 2.0 - y);
  v[1] = (float)(x - WIDTH / 2.0);
}

// Down a slope of 1 : 2.
static void straight(double x, double y, float *v) {
  (void)x, (void)y;
  v[0] = 2;
  v[1] = 1;
}

static void make(void (*flow)(double x, double y, float *v), uint16_t (*of)(double x, double y)) {
  for (int k = 0; k < WIDTH * HEIGHT; k++) {
    const double x = k % WIDTH + 0.5, y = k / WIDTH + 0.5; // NOLINT(bugprone-integer-division)
    flow(x, y, velocity[k]);
    group[k] = of(x, y);
  }
  const CwPixelFlow pixels = {WIDTH, HEIGHT, (const float(*)[2])velocity, group};
  assert_int_equal(cw_streamlines_make(&pixels, APART, &lines), CW_OK);
  assert_true(lines.count > 0 && lines.end[lines.count - 1] == lines.point_count);
}

static int first_of(int line) {
  return line ? lines.end[line - 1] : 0;
}

static uint16_t all(double x, double y) {
  (void)x, (void)y;
  return 1;
}

static uint16_t halves(double x, double y) {
  return y < 20 || y > HEIGHT - 20 ? 0 : x < 100 ? 1 : 2;
}

// Each line keeps its radius, goes round the right way, and not twice.
static void lines_of_a_turning_flow_are_circles(void **state) {
  make(turning, all);
  int round = 0;
  for (int l = 0; l < lines.count; l++) {
    const double *start = lines.point[first_of(l)];
    const double radius = hypot(start[0] - WIDTH / 2.0, start[1] - HEIGHT / 2.0);
    double turned = 0;
    for (int i = first_of(l); i + 1 < lines.end[l]; i++) {
      const double *a = lines.point[i], *b = lines.point[i + 1];
      const double ax = a[0] - WIDTH / 2.0, ay = a[1] - HEIGHT / 2.0, bx = b[0] - WIDTH / 2.0, by = b[1] - HEIGHT / 2.0;
      assert_true(fabs(hypot(bx, by) - radius) < 0.5);
      assert_true(fabs(hypot(b[0] - a[0], b[1] - a[1]) - 1) < 1e-12);
      turned += atan2(ax * by - ay * bx, ax * bx + ay * by);
    }
    assert_true(turned > 0 && turned < 2 * M_PI);
    round += turned > 1.5 * M_PI;
  }
  assert_true(round >= 3); // of a circle of 80 px, lines some 12 px apart
}

// No two lines come nearer than half of the distance, and nowhere is a pixel farther than it from all of them.
static void lines_are_evenly_spaced(void **state) {
  make(straight, all);
  for (int l = 0; l < lines.count; l++)
    for (int other = 0; other < l; other++)
      for (int i = first_of(l); i < lines.end[l]; i++)
        for (int k = first_of(other); k < lines.end[other]; k++)
          assert_true(hypot(lines.point[i][0] - lines.point[k][0], lines.point[i][1] - lines.point[k][1]) >
                      0.5 * APART - 1);
  for (int y = 30; y < HEIGHT - 30; y++) {
    for (int x = 30; x < WIDTH - 30; x++) {
      double nearest = INFINITY;
      for (int i = 0; i < lines.point_count; i++)
        nearest = fmin(nearest, hypot(lines.point[i][0] - x, lines.point[i][1] - y));
      assert_true(nearest < 1.5 * APART);
    }
  }
}

static void along_rows(double x, double y, float *v) {
  (void)x, (void)y;
  v[0] = 1;
  v[1] = 0;
}

static int from_above(const void *a, const void *b) {
  const double *first = a, *second = b;
  return (first[1] > second[1]) - (first[1] < second[1]);
}

// Where the middles of pixels lie just as far from a line as the next one should.
static void lines_along_rows_are_no_farther_apart(void **state) {
  double begin[HEIGHT][2];
  make(along_rows, all);
  assert_true(lines.count < HEIGHT);
  for (int l = 0; l < lines.count; l++) memcpy(begin[l], lines.point[first_of(l)], sizeof *begin);
  qsort(begin, lines.count, sizeof *begin, from_above);
  for (int l = 0; l + 1 < lines.count; l++) {
    const double apart = begin[l + 1][1] - begin[l][1];
    assert_true(apart > 0.5 * APART && apart < 1.1 * APART);
  }
  assert_true(begin[0][1] < APART && begin[lines.count - 1][1] > HEIGHT - APART);
}

static void lines_are_straight_and_keep_to_their_group(void **state) {
  make(straight, halves);
  for (int l = 0; l < lines.count; l++) {
    const double *start = lines.point[first_of(l)];
    const uint16_t own = halves(start[0], start[1]);
    assert_true(own > 0 && lines.end[l] - first_of(l) >= 2 * APART);
    for (int i = first_of(l); i < lines.end[l]; i++) {
      const double *x = lines.point[i];
      assert_int_equal(halves(x[0], x[1]), own);
      assert_true(fabs((x[0] - start[0]) - 2 * (x[1] - start[1])) < 1e-9);
    }
  }
}

static void standing(double x, double y, float *v) {
  straight(x, y, v);
  if (x > 120) v[0] = v[1] = 0;
}

static void water_that_stands_has_none(void **state) {
  make(standing, all);
  for (int i = 0; i < lines.point_count; i++) assert_true(lines.point[i][0] < 122);
}

static int free_lines(void **state) {
  cw_streamlines_free(&lines);
  return 0;
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_teardown(lines_of_a_turning_flow_are_circles, free_lines),
      cmocka_unit_test_teardown(lines_are_evenly_spaced, free_lines),
      cmocka_unit_test_teardown(lines_along_rows_are_no_farther_apart, free_lines),
      cmocka_unit_test_teardown(lines_are_straight_and_keep_to_their_group, free_lines),
      cmocka_unit_test_teardown(water_that_stands_has_none, free_lines),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
