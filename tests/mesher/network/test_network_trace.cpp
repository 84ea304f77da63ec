// SPDX-License-Identifier: AGPL-3.0-or-later
// Traces of planes on half a ball without its poles and on half a round bar, against the circles and ellipses that they
// are.
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>

#include "divided_solid.h"

static const double R = 0.02;

// Each point lies on its plane and on its face, where its parameters say, and ends lie at their corners.
static void check_points(const DividedSolid &solid) {
  for (int i = 0; i < solid.network.curve_count; i++) {
    const CwCurve &curve = solid.network.curve[i];
    assert_int_equal(curve.kind, CW_CURVE_CUT);
    for (int p = 0; p < curve.fine_count; p++) {
      double x[3];
      cw_cad_face_point(solid.cad, curve.face[0], curve.fine_parameter[p], x, NULL, NULL);
      assert_near(cw_distance(x, curve.fine_x[p]), 0, 1e-9);
      assert_near(cw_plane_distance(&solid.node[curve.plane[0]].plane, x), 0, 1e-9);
    }
    for (int end = 0; end < 2; end++) {
      const CwCorner &corner = solid.network.corner[curve.corner[end]];
      assert_near(cw_distance(corner.x, curve.fine_x[end ? curve.fine_count - 1 : 0]), 0, 1e-8);
      if (curve.corner[0] != curve.corner[1]) assert_true(corner.edge >= 0 || corner.plane[1] >= 0);
    }
  }
}

// The angle about `axis` through `centre` that the pieces of a plane's traces turn by, all together.
static double turned(const DividedSolid &solid, int32_t plane, const double centre[3], const double axis[3]) {
  double sum = 0;
  for (int i = 0; i < solid.network.curve_count; i++) {
    const CwCurve &curve = solid.network.curve[i];
    if (curve.plane[0] != plane) continue;
    double angle = 0;
    for (int p = 1; p < curve.fine_count; p++) {
      double a[3], b[3], n[3];
      cw_sub(curve.fine_x[p - 1], centre, a);
      cw_sub(curve.fine_x[p], centre, b);
      cw_cross(a, b, n);
      angle += std::atan2(cw_dot(n, axis), cw_dot(a, b));
    }
    sum += std::fabs(angle);
  }
  return sum;
}

static void trace(DividedSolid &solid, int32_t plane) {
  check(cw_network_trace(&solid.network, &solid.background, plane, &solid.outcome));
  if (solid.outcome.kind != CW_OUTCOME_DONE) fail_msg("%s", solid.outcome.reason);
}

// A plane that cuts a cap off the ball, inside its round face: one closed curve. With a second plane below it the curve
// is cut in two by the angles of the chord, or stays whole where that plane passes by.
static void a_closed_trace(void **) {
  DividedSolid ball(BRepPrimAPI_MakeSphere(20, -M_PI / 3, M_PI / 3, M_PI).Shape());
  const double axis[3] = {0, 1, 0};
  uint64_t seed = 1;
  for (int i = 0; i < 20; i++) {
    const double d = R * (0.6 + 0.3 * draw(&seed)), radius = std::sqrt(R * R - d * d), turn = 2 * M_PI * draw(&seed);
    const double off = radius * (i < 4 ? 1.1 : 1.8 * draw(&seed) - 0.9), centre[3] = {0, d, 0};
    const CwPlane cap = {{0, 1, 0}, d}, other = {{std::cos(turn), 0, std::sin(turn)}, off};
    ball.divide({{cap, -1, 0}, {other, 0, 0}});
    trace(ball, 0);
    const int pieces = i < 4 ? 1 : 2;
    assert_int_equal(ball.network.curve_count, pieces);
    assert_int_equal(ball.network.corner_count, pieces);
    check_points(ball);
    assert_near(turned(ball, 0, centre, axis), 2 * M_PI, 1e-9);
    double beyond = 0; // of the pieces: the angle of that on the positive side
    for (int k = 0; k < pieces; k++) {
      const CwCurve &curve = ball.network.curve[k];
      assert_int_equal(curve.corner[0] == curve.corner[1], pieces == 1);
      const double *from = curve.fine_x[0], *to = curve.fine_x[curve.fine_count - 1];
      int positive = 0;
      for (int p = 1; p + 1 < curve.fine_count; p++) {
        const int side = cw_plane_distance(&other, curve.fine_x[p]) > 0;
        if (p == 1) positive = side;
        assert_int_equal(side, positive);
      }
      if (pieces == 1) continue;
      assert_near(cw_distance(from, to), 2 * std::sqrt(radius * radius - off * off), 1e-8);
      const double length = curve.fine_length[curve.fine_count - 1];
      const double wanted = 2 * radius * (positive ? std::acos(off / radius) : M_PI - std::acos(off / radius));
      assert_true(length <= wanted && length > 0.985 * wanted); // its chords
      beyond += positive;
      for (int end = 0; end < 2; end++) {
        const CwCorner &corner = ball.network.corner[curve.corner[end]];
        assert_int_equal(corner.plane[0], 0);
        assert_int_equal(corner.plane[1], 1);
        assert_int_equal(corner.face, curve.face[0]);
        assert_near(cw_plane_distance(&other, corner.x), 0, 1e-9);
      }
    }
    assert_true(pieces == 1 || beyond == 1);
  }
}

// Two planes at random: the circle of the first is whole, that of the second lies in its cell, to the angle.
static void circles_end_at_their_cells(void **) {
  DividedSolid ball(BRepPrimAPI_MakeSphere(20, -M_PI / 3, M_PI / 3, M_PI).Shape());
  uint64_t seed = 2;
  int ends = 0;
  for (int i = 0; i < 60; i++) {
    CwPlane plane[2];
    double centre[2][3], angle = 2 * M_PI;
    for (int p = 0; p < 2; p++) {
      const double tilt = 0.26 * draw(&seed), turn = 2 * M_PI * draw(&seed);
      plane[p] = {{std::sin(tilt) * std::cos(turn), std::cos(tilt), std::sin(tilt) * std::sin(turn)}, 0};
      plane[p].offset = R * (0.82 + 0.12 * draw(&seed));
      for (int k = 0; k < 3; k++) centre[p][k] = plane[p].offset * plane[p].normal[k];
    }
    const CwPlane &first = plane[0], &second = plane[1];
    const int side = draw_below(&seed, 2);
    const double cosine = cw_dot(first.normal, second.normal), sine = std::sqrt(1 - cosine * cosine);
    const double radius = std::sqrt(R * R - second.offset * second.offset);
    const double chord = (first.offset - second.offset * cosine) / sine; // from its centre to the line of both
    if (sine < 0.05 || std::fabs(std::fabs(chord) - radius) < 0.02 * R) continue;
    if (std::fabs(chord) < radius)
      angle = 2 * (side ? std::acos(chord / radius) : M_PI - std::acos(chord / radius));
    else if ((chord < 0) != side)
      angle = 0;
    ball.divide({{first, -1, 0}, {second, 0, side}});
    trace(ball, 0);
    trace(ball, 1);
    check_points(ball);
    assert_near(turned(ball, 0, centre[0], first.normal), 2 * M_PI, 1e-8);
    assert_near(turned(ball, 1, centre[1], second.normal), angle, 1e-7);
    ends += angle > 0 && angle < 6;
  }
  assert_true(ends > 15);
}

// Slanted planes across the bar give half an ellipse on its round face and two straight lines on its flat ones; seen
// along the bar the ellipse is half a circle. A plane along the bar gives a rectangle.
static void ellipses_of_a_bar(void **) {
  DividedSolid bar(BRepPrimAPI_MakeCylinder(20, 60, M_PI).Shape());
  uint64_t seed = 3;
  for (int i = 0; i < 15; i++) {
    double turn = 2 * M_PI * draw(&seed), tilt = 0.5 * draw(&seed), slope = std::tan(tilt), wanted = 0;
    CwPlane plane = {{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)}, 0};
    plane.offset = 0.03 * plane.normal[2];
    bar.divide({{plane, -1, 0}});
    trace(bar, 0);
    for (int p = 0; p < 4000; p++) { // z falls by the slope along the direction of the tilt
      double a = M_PI * (p + 0.5) / 4000;
      wanted += M_PI / 4000 * R * std::hypot(1, slope * std::sin(a - turn));
    }
    assert_int_equal(bar.network.curve_count, 3);
    assert_int_equal(bar.network.corner_count, 3);
    check_points(bar);
    double arc = 0, straight = 0;
    for (int c = 0; c < 3; c++) {
      const CwCurve &curve = bar.network.curve[c];
      const int flat = std::fabs(curve.fine_x[1][1]) < 1e-12;
      (flat ? straight : arc) += curve.fine_length[curve.fine_count - 1];
      for (int p = 0; p < curve.fine_count; p++) {
        const double *x = curve.fine_x[p];
        assert_near(flat ? x[1] : std::hypot(x[0], x[1]), flat ? 0 : R, 1e-9);
      }
    }
    assert_true(arc <= wanted + 1e-9 && arc > 0.985 * wanted);
    assert_near(straight, 2 * R * std::hypot(1, slope * std::cos(turn)), 1e-8);
  }
  bar.divide({{{{1, 0, 0}, 0.012}, -1, 0}});
  trace(bar, 0);
  check_points(bar);
  double length = 0;
  for (int c = 0; c < bar.network.curve_count; c++)
    length += bar.network.curve[c].fine_length[bar.network.curve[c].fine_count - 1];
  assert_near(length, 2 * (0.06 + 0.016), 1e-9);
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(a_closed_trace), cmocka_unit_test(circles_end_at_their_cells),
                              cmocka_unit_test(ellipses_of_a_bar)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
