// SPDX-License-Identifier: AGPL-3.0-or-later
#include <stdlib.h>
#include <string.h>

#include "mesher/common/hilbert.h"
#include "tests/unit_test.h"

// Each cell once, and each next to the one before.
static void curve_visits_neighbours(void **unused) {
  enum { BITS = 4, SIDE = 1 << BITS, CELLS = SIDE * SIDE * SIDE };
  uint32_t(*cell)[3] = malloc(CELLS * sizeof *cell);
  uint8_t *seen = calloc(CELLS, 1);
  for (uint32_t k = 0; k < CELLS; k++) {
    const uint32_t c[3] = {k % SIDE, k / SIDE % SIDE, k / SIDE / SIDE};
    uint64_t place = cw_hilbert_place(c, BITS);
    assert_true(place < CELLS);
    assert_false(seen[place]);
    seen[place] = 1;
    memcpy(cell[place], c, sizeof c);
  }
  for (int k = 1; k < CELLS; k++) {
    int steps = 0;
    for (int i = 0; i < 3; i++) steps += abs((int)cell[k][i] - (int)cell[k - 1][i]);
    assert_int_equal(steps, 1);
  }
  free(cell);
  free(seen);
}

static double distance(const double a[3], const double b[3]) {
  double square = 0.0;
  for (int i = 0; i < 3; i++) square += (a[i] - b[i]) * (a[i] - b[i]);
  return square;
}

enum { SIDE = 20, COUNT = SIDE * SIDE * SIDE };

// How many of the steps from point to point in this order, of which each comes once, are at most this long.
static int short_steps(const double (*x)[3], const int32_t *order, double most) {
  uint8_t *seen = calloc(COUNT, 1);
  int count = 0;
  for (int k = 0; k < COUNT; k++) {
    assert_true(order[k] >= 0 && order[k] < COUNT && !seen[order[k]]);
    seen[order[k]] = 1;
    count += k && distance(x[order[k]], x[order[k - 1]]) <= most * most;
  }
  free(seen);
  return count;
}

static void orders_are_permutations_with_short_steps(void **unused) {
  double(*x)[3] = malloc(COUNT * sizeof *x);
  int32_t *order = malloc(COUNT * sizeof *order);
  for (int k = 0; k < COUNT; k++) x[k][0] = k % SIDE, x[k][1] = k / SIDE % SIDE, x[k][2] = k / SIDE / SIDE;
  assert_int_equal(cw_hilbert_order(COUNT, (const double(*)[3])x, order), CW_OK);
  assert_true(short_steps((const double(*)[3])x, order, 1.8) > COUNT * 9 / 10); // along the curve: to a neighbour
  assert_int_equal(cw_hilbert_rounds(COUNT, (const double(*)[3])x, order), CW_OK);
  assert_true(short_steps((const double(*)[3])x, order, 2.0) > COUNT * 3 / 4);
  // The first rounds are thin: among the first 64th no two points are neighbours but by chance.
  int touching = 0;
  for (int k = 1; k < COUNT / 64; k++) touching += distance(x[order[k]], x[order[k - 1]]) <= 1.0;
  assert_true(touching < COUNT / 64 / 8);
  free(x);
  free(order);
}

static void points_without_extent(void **unused) {
  double x[3][3] = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  int32_t order[3];
  assert_int_equal(cw_hilbert_order(3, (const double(*)[3])x, order), CW_OK);
  assert_int_equal(order[0] + order[1] + order[2], 3);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(curve_visits_neighbours),
      cmocka_unit_test(orders_are_permutations_with_short_steps),
      cmocka_unit_test(points_without_extent),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
