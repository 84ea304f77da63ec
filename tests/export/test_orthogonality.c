// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/orthogonality.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <cmocka.h>

// A tetrahedron on the triangle 0-1-2 with its tip at `tip`, and a right prism below.
static void two_cells(const double tip[3], CwOrthogonality *o) {
  double points[7][3] = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 0}, {0, 0, -2}, {3, 0, -2}, {0, 3, -2}};
  int32_t tetrahedra[][4] = {{0, 1, 2, 3}}, prisms[][6] = {{4, 5, 6, 0, 1, 2}};
  memcpy(points[3], tip, sizeof points[3]);
  CwRegionData data = {.points = points,
                       .point_count = 7,
                       .shared_count = 7,
                       .tetrahedra = tetrahedra,
                       .tetrahedron_count = 1,
                       .prisms = prisms,
                       .prism_count = 1};
  CwRegionFaces faces = {0};
  assert_int_equal(cw_region_faces("rotor", CW_ERR_INPUT, &data, &faces), CW_OK);
  cw_orthogonality_start(o);
  assert_int_equal(cw_orthogonality_region(&data, &faces, o), CW_OK);
  cw_region_faces_free(&faces);
  assert_int_equal(o->count, 1);
}

static void the_angle_is_that_of_the_centroids(void **state) {
  (void)state;
  CwOrthogonality straight, leaning;
  // The prism's centroid is (1, 1, -1), the tetrahedron's a quarter of the way from (1, 1, 0) to the tip.
  two_cells((double[3]){1, 1, 4}, &straight);
  assert_float_equal(cw_non_orthogonality_greatest(&straight), 0, 1e-6);
  two_cells((double[3]){9, 1, 4}, &leaning);
  assert_float_equal(cw_non_orthogonality_greatest(&leaning), 45, 1e-9);
  cw_orthogonality_add(&straight, &leaning);
  assert_int_equal(leaning.count, 2);
  assert_float_equal(cw_non_orthogonality_greatest(&leaning), 45, 1e-9);
  assert_float_equal(cw_non_orthogonality_mean(&leaning), acos((1 + sqrt(0.5)) / 2) * 180 / M_PI, 1e-9);
}

static void no_face_is_at_no_angle(void **state) {
  (void)state;
  CwOrthogonality o;
  cw_orthogonality_start(&o);
  assert_float_equal(cw_non_orthogonality_greatest(&o), 0, 0);
  assert_float_equal(cw_non_orthogonality_mean(&o), 0, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_angle_is_that_of_the_centroids),
      cmocka_unit_test(no_face_is_at_no_angle),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
