// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <string.h>

#include "mesher/layers/thin_prism.h"
#include "tests/unit_test.h"

// Determinant of a right prism from its faces, as checkMesh has it. The triangle lies in z = 0.
static double by_faces(const double corner[3][2], double height, int on_wall) {
  double sum[3][3] = {{0}}, face[5][3] = {{0}}, mean = 0;
  double area = 0.5 * fabs((corner[1][0] - corner[0][0]) * (corner[2][1] - corner[0][1]) -
                           (corner[1][1] - corner[0][1]) * (corner[2][0] - corner[0][0]));
  int count = 0;
  face[count++][2] = area;
  if (!on_wall) face[count++][2] = -area;
  for (int k = 0; k < 3; k++, count++) {
    const double *p = corner[k], *q = corner[(k + 1) % 3];
    face[count][0] = height * (q[1] - p[1]);
    face[count][1] = height * (p[0] - q[0]);
  }
  for (int f = 0; f < count; f++)
    mean += sqrt(face[f][0] * face[f][0] + face[f][1] * face[f][1] + face[f][2] * face[f][2]) / count;
  for (int f = 0; f < count; f++) {
    for (int i = 0; i < 9; i++) sum[i / 3][i % 3] += face[f][i / 3] * face[f][i % 3] / (mean * mean);
  }
  return (sum[0][0] * (sum[1][1] * sum[2][2] - sum[1][2] * sum[2][1]) -
          sum[0][1] * (sum[1][0] * sum[2][2] - sum[1][2] * sum[2][0]) +
          sum[0][2] * (sum[1][0] * sum[2][1] - sum[1][1] * sum[2][0])) /
         8;
}

// That of the mesher, the top moved by `lean` along x.
static double made(const double corner[3][2], double height, double lean, int on_wall) {
  double base[3][3] = {{0}}, top[3][3];
  for (int k = 0; k < 3; k++) {
    memcpy(base[k], corner[k], sizeof corner[k]);
    memcpy(top[k], base[k], sizeof top[k]);
    top[k][0] += lean;
    top[k][2] = height;
  }
  return cw_prism_determinant((const double(*)[3])base, (const double(*)[3])top, on_wall);
}

static void as_by_the_faces(void **state) {
  const double shape[2][3][2] = {{{0, 0}, {1, 0}, {0.5, 0.75}}, {{0, 0}, {3, 0.2}, {0.4, 1.1}}};
  for (int s = 0; s < 2; s++) {
    for (int on_wall = 0; on_wall < 2; on_wall++) {
      for (double height = 0.01; height < 2; height *= 5) {
        double wanted = by_faces(shape[s], height, on_wall);
        assert_true(fabs(made(shape[s], height, 0, on_wall) / wanted - 1) < 1e-12);
      }
    }
  }
}

// On an equilateral triangle: small from edges of 39 heights on, on the wall of 65.
static void limits_by_hand(void **state) {
  const double equilateral[3][2] = {{0, 0}, {1, 0}, {0.5, 0.5 * sqrt(3)}};
  const struct {
    double length, wanted;
    int on_wall;
  } side[] = {{39, 1, 0}, {65, 1, 1}, {78, 1.88, 0}}; // not 2: sides count in the mean
  for (int i = 0; i < 3; i++) {
    double determinant = made(equilateral, 1 / side[i].length, 0, side[i].on_wall);
    assert_true(fabs(cw_thin_prism_wanted(determinant) / side[i].wanted - 1) < 0.03);
  }
}

// Leaning columns leave height and base: the sum over the faces has the same determinant, but their mean area is
// greater.
static void of_leaning_columns(void **state) {
  const double base[3][2] = {{0, 0}, {3, 0}, {0, 4}}, height = 2;
  for (int on_wall = 0; on_wall < 2; on_wall++) {
    // Sides: 3 x 2 whatever the lean along it, 4 x 2.5 for 4 x 2, and 5 x sqrt(4 + (1.5 x 4/5)^2) for 5 x 2.
    int triangles = on_wall ? 1 : 2;
    double upright = triangles * 6 + 24, leaning = triangles * 6 + 6 + 10 + 5 * sqrt(4 + 1.44);
    double wanted = by_faces(base, height, on_wall) * pow(upright / leaning, 6);
    assert_true(fabs(made(base, height, 1.5, on_wall) / wanted - 1) < 1e-12);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(as_by_the_faces), cmocka_unit_test(limits_by_hand),
                                     cmocka_unit_test(of_leaning_columns)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
