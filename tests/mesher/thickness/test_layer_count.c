// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>

#include "mesher/thickness/layer_count.h"
#include "tests/unit_test.h"

// Thicknesses of 1, 2, 4 and 8; a ninth of a regular tetrahedron on edges of sqrt(3/2) 9 s is s high.
static void layers_by_hand(void **state) {
  const double edge = 9 * sqrt(1.5);
  assert_int_equal(cw_layer_count(1, 2, 0.5 * edge), 1);
  assert_int_equal(cw_layer_count(1, 2, 1 * edge), 1);
  assert_int_equal(cw_layer_count(1, 2, 1.01 * edge), 2);
  assert_int_equal(cw_layer_count(1, 2, 2 * edge), 2);
  assert_int_equal(cw_layer_count(1, 2, 8 * edge), 4);
  assert_int_equal(cw_layer_count(1, 2, 8.1 * edge), 5);
  assert_int_equal(cw_layer_count(1, 1, 2 * edge), CW_LAYERS_MOST); // even layers never come to it
}

static void layers_that_fit(void **state) {
  assert_int_equal(cw_layer_count_fitting(1, 2, 0.5), 1);
  assert_int_equal(cw_layer_count_fitting(1, 2, 6.9), 2); // 1 + 2 + 4
  assert_int_equal(cw_layer_count_fitting(1, 2, 7), 3);
  assert_int_equal(cw_layer_count_fitting(1, 1, 1000), CW_LAYERS_MOST);
}

// The volumes that the last prism of so many layers and a regular tetrahedron on it have are as 3 or less, and one
// layer less would not do.
static void last_volumes_of_random_walls(void **state) {
  srand(7);
  for (int i = 0; i < 10000; i++) {
    double size = pow(10, 6.0 * rand() / RAND_MAX - 5), first = size * pow(10, -4.0 * rand() / RAND_MAX);
    double growth = 1.05 + 0.5 * rand() / RAND_MAX, regular = sqrt(2.0 / 3) / 3 * size; // its volume over the face
    int count = cw_layer_count(first, growth, size);
    assert_in_range(count, 1, CW_LAYERS_MOST);
    if (count < CW_LAYERS_MOST) assert_true(first * pow(growth, count - 1) >= regular / 3 * (1 - 1e-6));
    if (count > 1) assert_true(first * pow(growth, count - 2) < regular / 3 * (1 + 1e-6));
  }
}

static void enough_for_most_faces(void **state) {
  double needing[CW_LAYERS_MOST + 1] = {0};
  needing[4] = 90;
  needing[7] = 5;
  needing[20] = 5;
  assert_int_equal(cw_layer_count_for(needing), 7);
  needing[7] = 4;
  assert_int_equal(cw_layer_count_for(needing), 20);
  needing[20] = 0;
  needing[4] = 1000;
  assert_int_equal(cw_layer_count_for(needing), 4);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(layers_by_hand), cmocka_unit_test(layers_that_fit),
                                     cmocka_unit_test(last_volumes_of_random_walls),
                                     cmocka_unit_test(enough_for_most_faces)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
