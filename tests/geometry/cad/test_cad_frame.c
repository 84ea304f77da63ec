// SPDX-License-Identifier: AGPL-3.0-or-later
// The pump's coordinates for axes along z, along x and aslant: right-handed, and there and back.
#include <math.h>
#include <string.h>

#include "geometry/cad/cad_frame.h"
#include "tests/unit_test.h"

static void make(const double point[3], const double axis[3], CwCadFrame *frame) {
  CwCaseCad cad = {.unit = 1e-3};
  memcpy(cad.point, point, sizeof cad.point);
  memcpy(cad.axis, axis, sizeof cad.axis);
  cw_cad_frame_make(&cad, frame);
}

static void along_z_nothing_moves(void **state) {
  CwCadFrame frame;
  make((double[]){0, 0, 0}, (double[]){0, 0, 1}, &frame);
  const double at[] = {1, 2, 3};
  double x[3];
  cw_cad_frame_from_file(&frame, at, x);
  assert_true(frame.same);
  for (int i = 0; i < 3; i++) assert_true(x[i] == at[i]);
}

static void any_axis_becomes_z(void **state) {
  static const double axes[][3] = {{1, 0, 0}, {0, 0, -1}, {0.6, 0, 0.8}, {-2. / 3, 1. / 3, 2. / 3}};
  for (int a = 0; a < 4; a++) {
    CwCadFrame frame;
    const double point[] = {0.1, -0.2, 0.3};
    double on_axis[3], x[3], back[3], determinant = 0;
    make(point, axes[a], &frame);
    assert_false(frame.same);
    for (int i = 0; i < 3; i++) on_axis[i] = point[i] + 0.5 * axes[a][i];
    cw_cad_frame_from_file(&frame, on_axis, x);
    assert_true(fabs(x[0]) < 1e-15 && fabs(x[1]) < 1e-15 && fabs(x[2] - 0.5) < 1e-15);
    for (int i = 0; i < 3; i++) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      determinant += frame.axis[0][i] * (frame.axis[1][j] * frame.axis[2][k] - frame.axis[1][k] * frame.axis[2][j]);
    }
    assert_true(fabs(determinant - 1) < 1e-14);
    const double at[] = {0.7, 0.8, -0.9};
    cw_cad_frame_to_file(&frame, at, back);
    cw_cad_frame_from_file(&frame, back, back);
    for (int i = 0; i < 3; i++) assert_true(fabs(back[i] - at[i]) < 1e-14);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(along_z_nothing_moves), cmocka_unit_test(any_axis_becomes_z)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
