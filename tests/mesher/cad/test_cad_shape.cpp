// SPDX-License-Identifier: AGPL-3.0-or-later
// Faces made by hand: what they evaluate to beside knots, at a pole and out of their ranges.
#include <cmath>
#include <vector>

#include <Geom_BSplineSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <gp_Ax3.hxx>

#include "mesher/cad/cad_shape.h"

#include "tests/unit_test.h"

static const double radius = 2;

// A parameter within 1e-12 of the whole range from a knot is put on it, to the last bit.
static void parameters_beside_knots_are_put_on_them(void **) {
  const CwCadKnots knots{{-1, 0.5, 3}}, none, wide{{0, 1000}};
  for (double knot : knots.knot) {
    for (double off : {0.0, 3.9e-12, -3.9e-12}) assert_true(knots.snap(knot + off) == knot);
    for (double off : {4.1e-12, -4.1e-12, 0.2, -0.2}) assert_true(knots.snap(knot + off) == knot + off);
    assert_true(none.snap(knot + 1e-15) == knot + 1e-15);
  }
  assert_true(wide.snap(9e-10) == 0 && wide.snap(1000 - 9e-10) == 1000);
  assert_true(wide.snap(1.1e-9) == 1.1e-9);
}

// Straight from step to step of unequal lengths; ends are ends to the last bit, and nothing is past them.
static void a_replaced_edge_has_the_places_of_the_other(void **) {
  CwCadReplaced replaced = {};
  replaced.t = {5, 3, 2.5, -1};
  const double share[] = {0, 1. / 6, 1. / 3, 0.5, 2. / 3, 5. / 6, 1, -0.5, 1.5};
  const double wanted[] = {5, 4, 3, 2.75, 2.5, 0.75, -1, 5, -1};
  for (int i = 0; i < 9; i++) assert_near(replaced.parameter(share[i]), wanted[i], 1e-14);
  for (int i = 1; i < 200; i++) {
    replaced.t = {0.1 * i, std::sqrt(i), -1. / i};
    assert_true(replaced.parameter(0) == replaced.t[0]);
    assert_true(replaced.parameter(0.5) == replaced.t[1]);
    assert_true(replaced.parameter(1) == replaced.t[2]);
  }
}

// A spline of two by two straight spans with a kink at u = 1 and one at v = 1.5.
static CwCadFace kinked_face() {
  TColgp_Array2OfPnt pole(1, 3, 1, 3);
  TColStd_Array1OfReal u(1, 3), v(1, 3);
  TColStd_Array1OfInteger times(1, 3);
  for (int i = 1; i <= 3; i++) {
    u(i) = i - 1;
    v(i) = 1.5 * (i - 1);
    times(i) = i == 2 ? 1 : 2;
    for (int k = 1; k <= 3; k++) pole(i, k) = gp_Pnt(1.1 * i, 1.3 * k, (i == 2 ? 0.7 : 0) + (k == 2 ? 0.3 : 0));
  }
  CwCadFace face = {};
  face.surface.Load(new Geom_BSplineSurface(pole, u, v, times, times, 1, 1));
  face.u_knots.knot = {0, 1, 2};
  face.v_knots.knot = {0, 1.5, 3};
  return face;
}

// To either side of a kink, a rounding error off, point and derivatives are those on it.
static void faces_are_evaluated_on_their_knots(void **) {
  const CwCadFace face = kinked_face();
  const double off = 1e-14, kinks[][2] = {{1, 0.8}, {0.6, 1.5}, {1, 1.5}};
  for (const auto &kink : kinks) {
    gp_Pnt on, at;
    gp_Vec first_on[2], first[2];
    CwCadSecond second;
    face.derive(kink, on, first_on, nullptr);
    for (int i = 0; i < 9; i++) {
      const double u = kink[0] == 1 ? 1 + (i % 3 - 1) * off : kink[0],
                   v = kink[1] == 1.5 ? 1.5 + (i / 3 - 1) * off : kink[1];
      const double uv[2] = {u, v}, before[2] = {0.1 + 0.2 * i, 0.1 + 0.3 * i};
      face.point(before);
      assert_near(face.point(uv).Distance(on), 0, 0);
      for (CwCadSecond *also : {(CwCadSecond *)nullptr, &second}) {
        face.derive(before, at, first, nullptr);
        face.derive(uv, at, first, also);
        assert_near(at.Distance(on), 0, 0);
        for (int k = 0; k < 2; k++) assert_near((first[k] - first_on[k]).Magnitude(), 0, 1e-15);
      }
    }
  }
  // Half of a span along u, a third along v, with poles 1.1 and 1.3 apart.
  const double uv[2] = {0.5, 0.5};
  assert_near(face.point(uv).X(), 1.65, 1e-15);
  assert_near(face.point(uv).Y(), 1.3 * 4 / 3, 1e-15);
  assert_near(face.point(uv).Z(), 0.35 + 0.1, 1e-15);
}

static CwCadFace sphere() {
  CwCadFace face = {};
  face.surface.Load(new Geom_SphericalSurface(gp_Ax3(), radius));
  return face;
}

// x = R (cos u cos v, sin u cos v, sin v) and its derivatives by hand.
static void derivatives_of_a_sphere(void **) {
  const CwCadFace face = sphere();
  const double uv[2] = {0.7, -0.4}, c = std::cos(0.7), s = std::sin(0.7), p = std::cos(-0.4), q = std::sin(-0.4);
  gp_Pnt at;
  gp_Vec first[2], alone[2];
  CwCadSecond second;
  face.derive(uv, at, alone, nullptr);
  face.derive(uv, at, first, &second);
  assert_near(at.Distance(gp_Pnt(radius * c * p, radius * s * p, radius * q)), 0, 1e-14);
  assert_near((first[0] - radius * gp_Vec(-s * p, c * p, 0)).Magnitude(), 0, 1e-14);
  assert_near((first[1] - radius * gp_Vec(-c * q, -s * q, p)).Magnitude(), 0, 1e-14);
  assert_near((second.uu - radius * gp_Vec(-c * p, -s * p, 0)).Magnitude(), 0, 1e-14);
  assert_near((second.vv - radius * gp_Vec(-c * p, -s * p, -q)).Magnitude(), 0, 1e-14);
  assert_near((second.uv - radius * gp_Vec(s * q, -c * q, 0)).Magnitude(), 0, 1e-14);
  for (int k = 0; k < 2; k++) assert_near((first[k] - alone[k]).Magnitude(), 0, 1e-14);
}

// About its pole, v = 90 degrees, the quarter of the sphere from u = 0 to 90 degrees: polar coordinates, whose first
// axis lies over u = 45 degrees.
static CwCadFace quarter_about_its_pole() {
  CwCadFace face = sphere();
  face.pole.is = true;
  face.pole.pole = M_PI / 2;
  face.pole.inward = -1;
  face.pole.middle = M_PI / 4;
  face.pole.smallest = 1e-3;
  face.u_range[0] = face.v_range[0] = 0;
  face.u_range[1] = face.v_range[1] = M_PI / 2;
  return face;
}

static gp_Pnt on_sphere(double polar, double around) {
  return gp_Pnt(radius * std::sin(polar) * std::cos(around), radius * std::sin(polar) * std::sin(around),
                radius * std::cos(polar));
}

// The point at the pole is the pole; derivatives there are those 1e-3 beside it, no less.
static void a_pole_has_a_point_and_derivatives(void **) {
  const CwCadFace face = quarter_about_its_pole();
  const double pole[2] = {0, 0}, half = std::sqrt(0.5);
  const gp_Vec axis[2] = {gp_Vec(half, half, 0), gp_Vec(-half, half, 0)};
  gp_Pnt at;
  gp_Vec first[2];
  CwCadSecond second;
  for (CwCadSecond *also : {(CwCadSecond *)nullptr, &second}) {
    face.derive(pole, at, first, also);
    assert_near(at.Distance(gp_Pnt(0, 0, radius)), 0, 1e-15);
    for (int k = 0; k < 2; k++) assert_near((first[k] - radius * axis[k]).Magnitude(), 0, 1.001e-3 * radius);
  }
  assert_near((second.uu - gp_Vec(0, 0, -radius)).Magnitude(), 0, 2e-3 * radius);
  for (double polar : {1e-5, 0.3, 1.2}) {
    for (double turn : {-0.6, 0.2}) {
      const double st[2] = {polar * std::cos(turn), polar * std::sin(turn)};
      const gp_Pnt wanted = on_sphere(polar, M_PI / 4 + turn);
      assert_near(face.point(st).Distance(wanted), 0, 1e-14);
      face.derive(st, at, first, nullptr);
      assert_near(at.Distance(wanted), 0, 1e-14);
    }
  }
}

static void parameters_are_kept_in_ranges(void **) {
  CwCadFace plain = sphere();
  plain.u_range[0] = 1;
  plain.u_range[1] = 2;
  plain.v_range[0] = -INFINITY;
  plain.v_range[1] = 5;
  const double asked[][2] = {{0.5, 3}, {1.5, -1e9}, {3, 7}}, kept[][2] = {{1, 3}, {1.5, -1e9}, {2, 5}};
  for (int i = 0; i < 3; i++) {
    double uv[2] = {asked[i][0], asked[i][1]};
    plain.keep_in_ranges(uv);
    assert_near(uv[0], kept[i][0], 0);
    assert_near(uv[1], kept[i][1], 0);
  }
  // About the pole: farther than 90 degrees, 60 degrees to one side of the middle, and within.
  const CwCadFace round = quarter_about_its_pole();
  double far[2] = {2, 0}, beside[2] = {0.3 * std::cos(M_PI / 3), -0.3 * std::sin(M_PI / 3)}, within[2] = {0.5, 0.1};
  round.keep_in_ranges(far);
  assert_near(far[0], M_PI / 2, 1e-15);
  assert_near(far[1], 0, 1e-15);
  round.keep_in_ranges(beside);
  assert_near(beside[0], 0.3 * std::sqrt(0.5), 1e-15);
  assert_near(beside[1], -0.3 * std::sqrt(0.5), 1e-15);
  round.keep_in_ranges(within);
  assert_near(within[0], 0.5, 1e-15);
  assert_near(within[1], 0.1, 1e-15);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(parameters_beside_knots_are_put_on_them),
      cmocka_unit_test(a_replaced_edge_has_the_places_of_the_other),
      cmocka_unit_test(faces_are_evaluated_on_their_knots),
      cmocka_unit_test(derivatives_of_a_sphere),
      cmocka_unit_test(a_pole_has_a_point_and_derivatives),
      cmocka_unit_test(parameters_are_kept_in_ranges),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
