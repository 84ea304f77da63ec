// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/mesh/cell.h"

#include <math.h>
#include <string.h>

#include "tests/unit_test.h"

// The unit cube's corners, then its top centre.
static double points[][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},  {0, 0, 1},
                             {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {.5, .5, 1}};
static int32_t tetrahedra[][4] = {{0, 1, 3, 4}};
static int32_t pyramids[][5] = {{0, 1, 2, 3, 8}};
static int32_t prisms[][6] = {{0, 1, 3, 4, 5, 7}};

static CwRegionData one_of_each(void) {
  return (CwRegionData){.points = points,
                        .point_count = 9,
                        .tetrahedra = tetrahedra,
                        .tetrahedron_count = 1,
                        .pyramids = pyramids,
                        .pyramid_count = 1,
                        .prisms = prisms,
                        .prism_count = 1};
}

static void volumes_of_the_three_shapes(void **state) {
  const double p[8][3] = {{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {0, 0, 5}, {2, 0, 5}, {2, 3, 5}, {0, 3, 5}};
  const double top[3] = {0.3, 0.4, 5};
  const double *prism[6] = {p[0], p[1], p[2], p[4], p[5], p[6]};
  const double *pyramid[5] = {p[0], p[1], p[2], p[3], top};
  const double *down[6] = {p[4], p[5], p[6], p[0], p[1], p[2]};
  assert_near(cw_cell_volume(6, prism), 15.0, 1e-12);
  assert_near(cw_cell_volume(5, pyramid), 10.0, 1e-12);
  assert_near(cw_cell_volume(6, down), -15.0, 1e-12);
  // A bent quadrilateral is the fan about its mean point, from both sides: what one prism gains the other loses.
  const double bent[3] = {2, 3, 6};
  const double *one[6] = {p[0], p[1], p[2], p[4], p[5], bent}, *two[6] = {p[0], p[2], p[3], p[4], bent, p[7]};
  // By hand: the box, and on its top two triangles that rise to 1 at the corner: 3 * 1/3 each; the outer sides stay
  // flat.
  assert_near(cw_cell_volume(6, one) + cw_cell_volume(6, two), 30.0 + 2.0, 1e-12);
}

static void an_inverted_tetrahedron_has_a_negative_volume(void **state) {
  const double *x[4] = {points[0], points[1], points[3], points[4]}, *inverted[4] = {x[1], x[0], x[2], x[3]};
  assert_near(cw_cell_volume(4, x), 1.0 / 6, 1e-15);
  assert_near(cw_cell_volume(4, inverted), -1.0 / 6, 1e-15);
}

// A quarter of the way up from the base of tetrahedron and pyramid; half a box, in the middle of its height.
static void centroids_of_the_three_shapes(void **state) {
  CwRegionData region = one_of_each();
  const double wanted[3][3] = {{0.25, 0.25, 0.25}, {0.5, 0.5, 0.25}, {1.0 / 3, 1.0 / 3, 0.5}};
  for (int32_t cell = 0; cell < 3; ++cell) {
    const double *x[6];
    double centroid[3];
    cw_cell_centroid(cw_cell_points(&region, cell, x), x, centroid);
    for (int k = 0; k < 3; ++k) assert_near(centroid[k], wanted[cell][k], 1e-14);
  }
}

// Every face looks out of its cell, and together they close.
static void faces_look_outward_and_close(void **state) {
  CwRegionData region = one_of_each();
  const int faces[] = {4, 5, 5}, triangles[] = {4, 4, 2};
  for (int32_t cell = 0; cell < 3; ++cell) {
    int found_triangles = 0;
    double sum[3] = {0}, centre[3];
    cw_cell_centre(&region, cell, centre);
    for (int f = 0; f < faces[cell]; ++f) {
      int32_t corner[4];
      double area[3], out = 0;
      int count = cw_cell_face(&region, cell, f, corner);
      cw_face_area((const double(*)[3])points, corner, count, area);
      found_triangles += count == 3;
      for (int k = 0; k < 3; ++k) {
        sum[k] += area[k];
        out += area[k] * (points[corner[0]][k] - centre[k]);
      }
      assert_true(out > 0);
    }
    assert_int_equal(found_triangles, triangles[cell]);
    for (int k = 0; k < 3; ++k) assert_near(sum[k], 0, 1e-15);
  }
}

// A prism on a right angle with legs of 1 and a height h has the components 2 h, 2 h and 1.
static void aspects_and_determinants_by_hand(void **state) {
  for (int i = 1; i <= 3; ++i) {
    const double h = pow(0.1, i), p[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, h}, {1, 0, h}, {0, 1, h}};
    const double *prism[6] = {p[0], p[1], p[2], p[3], p[4], p[5]};
    assert_near(cw_cell_aspect(6, prism), fmax(1 / (2 * h), (1 + 4 * h) / 6 / pow(h / 2, 2.0 / 3)), 1e-9);
    // The sums of squares: sides h along y, h along x and (h, h); base and top 1 / 2 along z.
    const double mean = (2 * 0.5 + (2 + sqrt(2)) * h) / 5, all = (4 - 1) * pow(h, 4) * 0.5 / 8 / pow(mean, 6);
    assert_near(cw_cell_determinant(6, prism, 31) / all, 1, 1e-12);
    // Without the wall at its base, and with one side to another cell alone.
    const double near = (0.5 + (2 + sqrt(2)) * h) / 4;
    assert_near(cw_cell_determinant(6, prism, 23) / (3 * pow(h, 4) * 0.25 / 8 / pow(near, 6)), 1, 1e-12);
    assert_near(cw_cell_determinant(6, prism, 25), 0, 1e-12);
  }
  const double *regular[4] = {points[0], points[1], points[3], points[4]};
  assert_true(cw_cell_determinant(4, regular, 15) > 0.1 && cw_cell_aspect(4, regular) < 10);
  assert_near(cw_cell_determinant(4, regular, 0), 0, 0);
}

static void interfaces_may_be_off_by_a_hundredth_of_the_shortest_edge(void **state) {
  const double a[3] = {0, 0, 0}, b[3] = {4, 0, 0}, c[3] = {4, 3, 0}, d[3] = {0, 2, 0}, e[3] = {4, 0, 0.5};
  const double *const triangle[4] = {a, b, c}, *const quad[4] = {a, b, c, d}, *const thin[4] = {a, b, e, d};
  assert_true(fabs(cw_interface_tolerance(3, triangle) - 0.03) < 1e-15);
  assert_true(fabs(cw_interface_tolerance(4, quad) - 0.02) < 1e-15);
  assert_true(fabs(cw_interface_tolerance(4, thin) - 0.005) < 1e-15);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(volumes_of_the_three_shapes),
      cmocka_unit_test(an_inverted_tetrahedron_has_a_negative_volume),
      cmocka_unit_test(centroids_of_the_three_shapes),
      cmocka_unit_test(faces_look_outward_and_close),
      cmocka_unit_test(aspects_and_determinants_by_hand),
      cmocka_unit_test(interfaces_may_be_off_by_a_hundredth_of_the_shortest_edge),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
