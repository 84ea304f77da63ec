// SPDX-License-Identifier: AGPL-3.0-or-later

#include "mesher/common/cubes.h"
#include "mesher/common/vec.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

enum { POINTS = 3000 };

// Every point within the radius is in one of the cubes, for places inside and outside, and none stands there twice.
static void nothing_near_is_missed(void **state) {
  static double x[POINTS][3];
  uint64_t random = 1;
  for (int i = 0; i < POINTS; i++) {
    for (int k = 0; k < 3; k++) x[i][k] = draw(&random) * (k + 1);
  }
  CwCubes cubes;
  assert_int_equal(cw_cubes_make(POINTS, (const double(*)[3])x, 0.11, &cubes), CW_OK);
  for (int q = 0; q < 200; q++) {
    double at[3] = {1.4 * x[q][0] - 0.2, x[q][1], x[q][2]}, radius = 0.01 * q / 10;
    int32_t from[3], to[3], found = 0, wanted = 0;
    cw_cubes_near(&cubes, at, radius, from, to);
    for (int32_t c = from[2]; c <= to[2]; c++) {
      for (int32_t b = from[1]; b <= to[1]; b++) {
        for (int32_t a = from[0]; a <= to[0]; a++) {
          size_t cube = cw_cube(&cubes, a, b, c);
          for (int32_t i = cubes.start[cube]; i < cubes.start[cube + 1]; i++) {
            found += cw_distance(x[cubes.member[i]], at) <= radius;
          }
        }
      }
    }
    for (int i = 0; i < POINTS; i++) wanted += cw_distance(x[i], at) <= radius;
    assert_int_equal(found, wanted);
  }
  cw_cubes_free(&cubes);
}

static void no_points_no_cubes_to_search(void **state) {
  CwCubes cubes;
  const double far[3] = {1, 2, 3};
  int32_t from[3], to[3];
  assert_int_equal(cw_cubes_make(0, NULL, 0.1, &cubes), CW_OK);
  cw_cubes_near(&cubes, far, 0.5, from, to);
  assert_true(from[0] > to[0]);
  cw_cubes_free(&cubes);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(nothing_near_is_missed),
      cmocka_unit_test(no_points_no_cubes_to_search),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
