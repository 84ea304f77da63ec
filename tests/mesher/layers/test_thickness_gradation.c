// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/incident.h"
#include "mesher/layers/thickness_gradation.h"
#include "tests/unit_test.h"

enum { SIDE = 12, POINTS = SIDE * SIDE, TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1) };

// A square of SIDE x SIDE points, bent at random.
typedef struct {
  double x[POINTS][2], thickness[POINTS], slope;
  int32_t triangle[TRIANGLES][3];
  CwIncident around;
} Square;

static double apart(const Square *square, int32_t v, int32_t w) {
  return hypot(square->x[v][0] - square->x[w][0], square->x[v][1] - square->x[w][1]);
}

static double most(const void *context, int32_t v, int32_t w) {
  const Square *square = context;
  return square->thickness[v] + square->slope * apart(square, v, w);
}

static double chance(void) {
  return (double)rand() / RAND_MAX;
}

static void make_square(Square *square) {
  int32_t t = 0;
  for (int32_t i = 0; i < POINTS; i++) {
    square->x[i][0] = i % SIDE + 0.3 * chance();
    square->x[i][1] = i / SIDE + 0.3 * chance();
    square->thickness[i] = 0.2 + 4 * chance();
  }
  for (int32_t i = 0; i < POINTS; i++) {
    if (i % SIDE == SIDE - 1 || i / SIDE == SIDE - 1) continue;
    memcpy(square->triangle[t++], (int32_t[3]){i, i + 1, i + SIDE}, sizeof *square->triangle);
    memcpy(square->triangle[t++], (int32_t[3]){i + 1, i + SIDE + 1, i + SIDE}, sizeof *square->triangle);
  }
  square->slope = 0.1 + 0.5 * chance();
  assert_int_equal(cw_incident_make(POINTS, TRIANGLES, (const int32_t(*)[3])square->triangle, &square->around), CW_OK);
}

static void grade(Square *square, uint8_t *graded, const uint8_t *lowered) {
  CwGradation gradation = {.step = "test",
                           .count = POINTS,
                           .start = square->around.start,
                           .triangle = square->around.triangle,
                           .corner = (const int32_t(*)[3])square->triangle,
                           .most = most,
                           .given = square,
                           .thickness = square->thickness,
                           .graded = graded};
  assert_int_equal(cw_grade_thickness(&gradation, lowered), CW_OK);
}

// What all edges allow, swept over until nothing changes (Bellman and Ford).
static void relax(const Square *square, double *thickness) {
  for (int changed = 1; changed;) {
    changed = 0;
    for (int32_t t = 0; t < TRIANGLES; t++) {
      for (int k = 0; k < 9; k++) {
        int32_t v = square->triangle[t][k / 3], w = square->triangle[t][k % 3];
        double allowed = thickness[v] + square->slope * apart(square, v, w);
        if (v == w || thickness[w] <= allowed) continue;
        thickness[w] = allowed;
        changed = 1;
      }
    }
  }
}

static void greatest_heights_of_the_slope(void **state) {
  srand(11);
  for (int round = 0; round < 50; round++) {
    Square square;
    double wanted[POINTS], before[POINTS];
    uint8_t graded[POINTS] = {0}, lowered[POINTS] = {0};
    make_square(&square);
    memcpy(wanted, square.thickness, sizeof wanted);
    memcpy(before, square.thickness, sizeof before);
    relax(&square, wanted);
    grade(&square, graded, NULL);
    for (int i = 0; i < POINTS; i++) {
      assert_true(fabs(square.thickness[i] - wanted[i]) < 1e-12);
      assert_int_equal(graded[i], square.thickness[i] < before[i]);
    }
    // One vertex is lowered: only what stands too high beside it comes down.
    int32_t v = rand() % POINTS;
    square.thickness[v] *= 0.1;
    lowered[v] = 1;
    memcpy(wanted, square.thickness, sizeof wanted);
    relax(&square, wanted);
    grade(&square, NULL, lowered);
    for (int i = 0; i < POINTS; i++) assert_true(fabs(square.thickness[i] - wanted[i]) < 1e-12);
    cw_incident_free(&square.around);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(greatest_heights_of_the_slope)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
