// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "mesher/common/predicates.h"
#include "mesher/common/vec.h"
#include "mesher/fill/sphere.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

static uint64_t state;

// Corners of a tetrahedron that encloses points up to `size` from the middle.
static CwSphereFrame frame_of(const double middle[3], double size) {
  static const double sign[4][3] = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
  double x[4][3];
  for (int k = 0; k < 12; k++) x[k / 3][k % 3] = middle[k % 3] + 4 * size * sign[k / 3][k % 3];
  return cw_sphere_frame(x[0], x[1], x[2], x[3]);
}

static void set(const CwSphereFrame *frame, const double x[4][3], CwTet *tet) {
  double place[3], arm[3][4];
  cw_sphere_place(frame, x[3], place);
  for (int k = 0; k < 3; k++) {
    arm[k][3] = 0;
    for (int i = 0; i < 3; i++) {
      arm[k][i] = (x[k][i] - x[3][i]) * frame->scale;
      arm[k][3] += arm[k][i] * arm[k][i];
    }
  }
  // Beside the same with its corners turned, and the two exchanged: neither knows of the other.
  const double *a[2] = {arm[0], arm[1]}, *b[2] = {arm[1], arm[2]}, *c[2] = {arm[2], arm[0]};
  const double *d[2] = {a[1], a[0]}, *e[2] = {b[1], b[0]}, *f[2] = {c[1], c[0]};
  CwTet turned = {.quality = 0.0}, again[2] = {{.quality = 0.0}, {.quality = 0.0}};
  cw_sphere_set((CwTet *const[2]){tet, &turned}, place, a, b, c);
  cw_sphere_set((CwTet *const[2]){&again[0], &again[1]}, place, d, e, f);
  assert_memory_equal(tet->centre, again[1].centre, 4 * sizeof(float));
  assert_memory_equal(turned.centre, again[0].centre, 4 * sizeof(float));
}

// Beside three others, at each place of four in turn: the answers are those one by one.
static unsigned look(const CwSphereFrame *frame, const CwTet *tet, const double p[3]) {
  static const CwTet none = {.centre = {8}}, small = {.centre = {0.1f, 0.1f, 0.1f}, .radius_square = 0.25f};
  static const CwTet taken = {.centre = {0.1f}, .radius_square = -0.25f};
  double place[3];
  cw_sphere_place(frame, p, place);
  const float seen[3] = {(float)place[0], (float)place[1], (float)place[2]};
  unsigned alone = cw_sphere_compare(tet, seen);
  for (int k = 0; k < 4; k++) {
    const CwTet *four[4] = {&none, &small, &taken, &none};
    int32_t known[4];
    four[k] = tet;
    cw_sphere_compare_4(four, seen, known);
    for (int i = 0; i < 4; i++) assert_int_equal(known[i], i == k ? alone : cw_sphere_compare(four[i], seen));
  }
  return alone;
}

// The middle and the unit; the sphere of a corner of a cube.
static void framed(void **unused) {
  const double middle[3] = {7, -3, 0.5}, x[4][3] = {{8, -3, 0.5}, {7, -2, 0.5}, {7, -3, 1.5}, {7, -3, 0.5}};
  CwSphereFrame frame = frame_of(middle, 2);
  CwTet tet = {.quality = 0.0};
  double place[3];
  cw_sphere_place(&frame, (double[3]){9, -3, -0.5}, place);
  assert_true(place[0] == 1 && place[1] == 0 && place[2] == -0.5);
  set(&frame, x, &tet);
  for (int i = 0; i < 3; i++) assert_true(fabs(tet.centre[i] - 0.25) < 1e-6);
  assert_true(fabs(tet.radius_square - 3.0 / 16) < 1e-6);
}

// What is sure is as the exact predicate has it: spheres of 1e-9 to 30 units, tetrahedra that take as much of one as
// lies inside or as little as a millionth, or whose corners are all near one circle, and points that are off the sphere
// by as little as 1e-9 of its radius.
static void as_exact(void **unused) {
  const double middle[3] = {0.3, 0.1, -0.7};
  CwSphereFrame frame = frame_of(middle, 1);
  int seen[3] = {0};
  state = 3;
  for (int trial = 0; trial < 100000; trial++) {
    double x[5][3], centre[3] = {0}, way[5][3], radius = pow(10, 1.5 - 10.5 * draw(&state)),
                    most = fmin(1, 0.4 / radius);
    double flat = trial % 2 ? 1 : pow(0.1, 12 * draw(&state)),
           part = trial % 2 ? most * pow(0.1, 6 * draw(&state)) : most;
    double off = (draw(&state) - 0.5) * most * pow(0.1, 9 * draw(&state));
    CwTet tet;
    for (int k = 0; k < 5; k++) {
      for (int i = 0; i < 3; i++) way[k][i] = draw(&state) - 0.5;
      for (int i = 0; i < 3 && k; i++) way[k][i] = way[0][i] + (k == 4 ? most : part) * way[k][i];
      if (k < 4) way[k][2] *= flat;
      cw_unit(way[k]);
      for (int i = 0; i < 3; i++) {
        if (k == 0) centre[i] = middle[i] + 1.1 * (draw(&state) - 0.5) - radius * way[0][i];
        x[k][i] = centre[i] + (k == 4 ? 1 + off : 1) * radius * way[k][i];
      }
    }
    if (cw_orient3d(x[0], x[1], x[2], x[3]) <= 0) continue;
    set(&frame, (const double(*)[3])x, &tet);
    unsigned known = look(&frame, &tet, x[4]);
    assert_true(known <= CW_BEYOND);
    seen[known]++;
    if (known) assert_int_equal(known == CW_WITHIN, cw_insphere(x[0], x[1], x[2], x[3], x[4]) > 0);
  }
  for (int k = 0; k < 3; k++) assert_true(seen[k] > 2000);
}

// Four points of a plane have no sphere: nothing is sure of it.
static void flat(void **unused) {
  const double x[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.4, 0}}, middle[3] = {0, 0, 0};
  CwSphereFrame frame = frame_of(middle, 1);
  CwTet tet;
  set(&frame, x, &tet);
  assert_int_equal(look(&frame, &tet, (double[3]){0.1, 0.1, 0.5}), 0);
  cw_sphere_take(&tet, 1);
  assert_int_equal(look(&frame, &tet, (double[3]){0.1, 0.1, 0.5}), CW_TAKEN);
}

// One that is taken holds no point, wherever it lies.
static void taken(void **unused) {
  const double x[4][3] = {{0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {0, 0, 0}}, middle[3] = {0, 0, 0};
  CwSphereFrame frame = frame_of(middle, 1);
  CwTet tet;
  set(&frame, x, &tet);
  const double p[3][3] = {{0.2, 0.2, 0.2}, {-0.9, 0, 0}, {0.5, 0, 0}};
  cw_sphere_take(&tet, 0);
  assert_int_equal(look(&frame, &tet, p[0]), CW_WITHIN);
  assert_int_equal(look(&frame, &tet, p[1]), CW_BEYOND);
  assert_int_equal(look(&frame, &tet, p[2]), 0);
  cw_sphere_take(&tet, 1);
  for (int k = 0; k < 3; k++) assert_int_equal(look(&frame, &tet, p[k]) & (CW_WITHIN | CW_TAKEN), CW_TAKEN);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(framed), cmocka_unit_test(as_exact), cmocka_unit_test(flat),
                                     cmocka_unit_test(taken)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
