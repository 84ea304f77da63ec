// SPDX-License-Identifier: AGPL-3.0-or-later
// Curves divided by the size field: numbers and places that follow from the integral of ds / h.
#include <stdlib.h>

#include "mesher/boundary/boundary_curves.h"
#include "tests/unit_test.h"

static double even(const void *context, double place) {
  return *(const double *)context;
}

// Grows with the place: h = g s.
static double growing(const void *context, double place) {
  return *(const double *)context * place;
}

// 10 edges of 0.3, from either end.
static void even_sizes_give_even_places(void **state) {
  const double h = 0.3;
  for (int back = 0; back < 2; back++) {
    double from = back ? 5 : 2, to = back ? 2 : 5, *place;
    int32_t count;
    assert_int_equal(cw_divide_by_size(even, &h, from, to, 3, 1, &count, &place), CW_OK);
    assert_int_equal(count, 11);
    for (int k = 0; k < count; k++) assert_near(place[k], from + (to - from) * k / 10, 1e-12);
    free(place);
  }
}

// The nearest whole number, but no fewer than are asked for.
static void numbers_are_whole(void **state) {
  const double h = 1;
  const struct {
    double length;
    int32_t least, edges;
  } wanted[] = {{2.4, 1, 2}, {2.6, 1, 3}, {0.2, 1, 1}, {2.4, 4, 4}, {0.2, 2, 2}};
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
    double *place;
    int32_t count;
    assert_int_equal(cw_divide_by_size(even, &h, 0, 1, wanted[i].length, wanted[i].least, &count, &place), CW_OK);
    assert_int_equal(count, wanted[i].edges + 1);
    assert_near(place[0], 0, 0);
    assert_near(place[count - 1], 1, 0);
    free(place);
  }
}

// From 1 to e^2 with g = 0.25: the integral is 2 / 0.25 = 8, and the places are the powers of e^(1/4).
static void growing_sizes_give_geometric_places(void **state) {
  const double growth = 0.25, to = exp(2);
  double *place;
  int32_t count;
  assert_int_equal(cw_divide_by_size(growing, &growth, 1, to, to - 1, 1, &count, &place), CW_OK);
  assert_int_equal(count, 9);
  for (int k = 0; k < count; k++) assert_near(place[k] / exp(0.25 * k), 1, 1e-4);
  free(place);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(even_sizes_give_even_places),
      cmocka_unit_test(numbers_are_whole),
      cmocka_unit_test(growing_sizes_give_geometric_places),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
