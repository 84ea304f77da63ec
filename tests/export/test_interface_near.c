// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/interface_near.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/vec.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

// The place that r, s mean in a face: of CGNS' shape functions.
static void point_in(const CwInterfaceFace *face, const double rs[2], double x[3]) {
  const double r = rs[0], s = rs[1],
               weight[2][4] = {{1 - r - s, r, s, 0}, {(1 - r) * (1 - s), r * (1 - s), r * s, (1 - r) * s}};
  memset(x, 0, sizeof(double[3]));
  for (int n = 0; n < face->count; ++n)
    for (int k = 0; k < 3; ++k) x[k] += weight[face->count - 3][n] * face->nodes[n][k];
}

// Of a triangle or rhombus: over it along its normal, else from the nearest place of its edges, tried one by one.
static double distance_from(const CwInterfaceFace *face, const double point[3]) {
  double normal[3], best = INFINITY;
  int over = 1;
  cw_normal(face->nodes[0], face->nodes[1], face->nodes[2], normal);
  cw_unit(normal);
  for (int n = 0; n < face->count; ++n) {
    const double *a = face->nodes[n], *b = face->nodes[(n + 1) % face->count];
    double along[3], off[3], out[3];
    cw_sub(b, a, along);
    const double length = cw_unit(along);
    cw_sub(point, a, off);
    cw_cross(along, normal, out);
    if (cw_dot(out, off) > 0) over = 0;
    const double t = fmin(fmax(cw_dot(off, along), 0), length);
    for (int k = 0; k < 3; ++k) off[k] -= t * along[k];
    best = fmin(best, cw_norm(off));
  }
  if (!over) return best;
  double off[3];
  cw_sub(point, face->nodes[0], off);
  return fabs(cw_dot(off, normal));
}

// A triangle, or a rhombus, of edges about `size` somewhere in a box of 1 x 1 x flat.
static CwInterfaceFace draw_face(uint64_t *seed, double size, double flat) {
  CwInterfaceFace face = {.count = draw(seed) < 0.5 ? 3 : 4};
  double side[2][3];
  for (int k = 0; k < 3; ++k) {
    face.nodes[0][k] = draw(seed) * (k == 2 ? flat : 1);
    for (int j = 0; j < 2; ++j) side[j][k] = draw(seed) - 0.5;
  }
  const double length[2] = {cw_unit(side[0]), cw_unit(side[1])};
  assert_true(length[0] > 0 && length[1] > 0);
  for (int k = 0; k < 3; ++k) {
    const double a = face.nodes[0][k], u = size * side[0][k], v = size * side[1][k];
    face.nodes[1][k] = a + u;
    face.nodes[2][k] = a + v + (face.count == 4 ? u : 0);
    face.nodes[3][k] = a + v;
  }
  return face;
}

static double longest_of(const CwInterfaceFace *face) {
  double longest = 0;
  for (int n = 0; n < face->count; ++n)
    longest = fmax(longest, cw_distance(face->nodes[n], face->nodes[(n + 1) % face->count]));
  return longest;
}

static void no_other_face_is_nearer(void **state) {
  enum { FACES = 60, OTHERS = 150 };
  static CwInterfaceFace face[FACES], other[OTHERS];
  uint64_t seed = 5;
  for (int round = 0; round < 12; ++round) {
    // Scattered in a cube or a thin layer; on one side both small and large ones, some far outside of the others' box.
    const double flat = round % 2 ? 1e-3 : 1;
    int64_t donor[FACES], worst, worst_wanted = 0;
    double place[FACES][2], gap, gap_wanted = 0;
    for (int i = 0; i < FACES; ++i) face[i] = draw_face(&seed, i % 2 ? 0.3 : 2, i % 5 ? flat : 4);
    for (int i = 0; i < OTHERS; ++i) other[i] = draw_face(&seed, i % 10 ? 0.05 : 0.5, flat);
    assert_int_equal(cw_interface_near(face, FACES, other, OTHERS, donor, place, &gap, &worst), CW_OK);
    for (int i = 0; i < FACES; ++i) {
      double centre[3] = {0}, x[3], least = INFINITY;
      for (int n = 0; n < face[i].count; ++n)
        for (int k = 0; k < 3; ++k) centre[k] += face[i].nodes[n][k] / face[i].count;
      for (int o = 0; o < OTHERS; ++o) least = fmin(least, distance_from(&other[o], centre));
      assert_in_range(donor[i], 0, OTHERS - 1);
      const CwInterfaceFace *d = &other[donor[i]];
      assert_near(distance_from(d, centre), least, 1e-12);
      point_in(d, place[i], x);
      assert_near(cw_distance(x, centre), least, 1e-9); // where the foot is, the distance changes little
      for (int k = 0; k < 2; ++k) assert_true(place[i][k] >= 0 && place[i][k] <= 1);
      if (d->count == 3) assert_true(place[i][0] + place[i][1] <= 1 + 1e-15);
      const double off = least / fmax(longest_of(&face[i]), longest_of(d));
      if (off > gap_wanted) worst_wanted = i;
      gap_wanted = fmax(gap_wanted, off);
    }
    assert_near(gap, gap_wanted, 1e-9);
    assert_int_equal(worst, worst_wanted);
  }
}

// A triangle of edges below 0.01 with its centre at x.
static CwInterfaceFace small_at(const double x[3]) {
  static const double off[3][2] = {{2e-3, 0}, {-1e-3, 1e-3}, {-1e-3, -1e-3}};
  CwInterfaceFace face = {.count = 3};
  for (int n = 0; n < 3; ++n)
    memcpy(face.nodes[n], (double[]){x[0] + off[n][0], x[1] + off[n][1], x[2]}, sizeof face.nodes[n]);
  return face;
}

// Over a right triangle and beside each of its edges; over a square beside it.
static void places_by_hand(void **state) {
  const CwInterfaceFace others[] = {{.count = 3, .nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                                    {.count = 4, .nodes = {{2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {2, 1, 0}}}};
  static const struct {
    double at[3];
    int donor;
    double place[2], off; // over the longest edge: sqrt(2) and 1
  } wanted[] = {{{0.2, 0.3, 0.1}, 0, {0.2, 0.3}, 0.1 / M_SQRT2}, {{0.25, -0.1, 0}, 0, {0.25, 0}, 0.1 / M_SQRT2},
                {{-0.2, 0.5, 0}, 0, {0, 0.5}, 0.2 / M_SQRT2},    {{0.6, 0.6, 0}, 0, {0.5, 0.5}, 0.1},
                {{2.1, 0.9, -0.3}, 1, {0.1, 0.9}, 0.3},          {{3.3, 1.4, 0}, 1, {1, 1}, 0.5}};
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; ++i) {
    const CwInterfaceFace face = small_at(wanted[i].at);
    int64_t donor, worst;
    double place[1][2], gap;
    assert_int_equal(cw_interface_near(&face, 1, others, 2, &donor, place, &gap, &worst), CW_OK);
    assert_int_equal(donor, wanted[i].donor);
    for (int k = 0; k < 2; ++k) assert_near(place[0][k], wanted[i].place[k], 1e-12);
    assert_near(gap, wanted[i].off, 1e-12);
  }
}

// On the saddle z = r s, from a point along its normal (-s, -r, 1).
static void the_foot_on_a_warped_face_is_found(void **state) {
  const CwInterfaceFace saddle = {.count = 4, .nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}}};
  uint64_t seed = 8;
  for (int i = 0; i < 200; ++i) {
    const double r = draw(&seed), s = draw(&seed), t = 0.4 * (draw(&seed) - 0.5);
    const CwInterfaceFace face = small_at((double[]){r - t * s, s - t * r, r * s + t});
    int64_t donor, worst;
    double place[1][2], gap;
    assert_int_equal(cw_interface_near(&face, 1, &saddle, 1, &donor, place, &gap, &worst), CW_OK);
    assert_near(place[0][0], r, 1e-3);
    assert_near(place[0][1], s, 1e-3);
    assert_near(gap, fabs(t) * sqrt(1 + r * r + s * s) / M_SQRT2, 1e-6);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(no_other_face_is_nearer),
      cmocka_unit_test(places_by_hand),
      cmocka_unit_test(the_foot_on_a_warped_face_is_found),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
