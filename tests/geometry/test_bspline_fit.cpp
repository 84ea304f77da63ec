// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/bspline_fit.hpp"

#include <cmath>

#include <Standard_Failure.hxx>

#include "tests/draw.h"
#include "tests/unit_test.h"

static double polynomial(const double c[4], double t) {
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

static std::vector<double> uneven(uint64_t *state, int count, double a, double b) {
  std::vector<double> t(count, 0.0);
  for (int i = 1; i < count; i++) t[i] = t[i - 1] + 0.05 + draw(state);
  for (double &value : t) value = a + (b - a) * value / t.back();
  t.front() = a;
  t.back() = b;
  return t;
}

// Cubic splines hold all cubics, whatever their knots: one through points of a cubic is that cubic.
static void cubics_are_met_everywhere(void **) {
  uint64_t state = 5;
  for (int trial = 0; trial < 50; trial++) {
    double c[3][4];
    for (auto &row : c)
      for (double &value : row) value = 2 * draw(&state) - 1;
    const int count = 4 + (int)(12 * draw(&state));
    const std::vector<double> t = uneven(&state, count, -1, 2);
    std::vector<gp_Pnt2d> flat;
    std::vector<gp_Pnt> points;
    for (double at : t) {
      flat.push_back(gp_Pnt2d(polynomial(c[0], at), polynomial(c[1], at)));
      points.push_back(gp_Pnt(polynomial(c[0], at), polynomial(c[1], at), polynomial(c[2], at)));
    }
    const Handle(Geom2d_BSplineCurve) plane = cw_bspline_curve_2d(t, flat);
    const Handle(Geom_BSplineCurve) space = cw_bspline_curve_3d(t, points);
    assert_near(plane->FirstParameter(), -1, 0);
    assert_near(plane->LastParameter(), 2, 0);
    for (int i = 0; i <= 40; i++) {
      const double at = -1 + 3 * i / 40.0;
      for (int k = 0; k < 2; k++) assert_near(plane->Value(at).Coord(k + 1), polynomial(c[k], at), 1e-11);
      for (int k = 0; k < 3; k++) assert_near(space->Value(at).Coord(k + 1), polynomial(c[k], at), 1e-11);
    }
  }
}

static void bicubics_are_met_everywhere(void **) {
  uint64_t state = 6;
  const double a[4] = {0.3, -1, 0.5, 0.7}, b[4] = {-0.2, 0.4, 1, -0.6};
  const auto f = [&](double u, double v) {
    return gp_Pnt(polynomial(a, u) * polynomial(b, v), u - polynomial(b, v), polynomial(a, v));
  };
  const std::vector<double> v = uneven(&state, 9, 0, 1);
  const Handle(Geom_BSplineSurface) surface[2] = {cw_bspline_surface(6, v, f), cw_bspline_surface(5, 7, f)};
  for (const auto &of : surface)
    for (int i = 0; i <= 20; i++)
      for (int j = 0; j <= 20; j++) assert_true(of->Value(i / 20.0, j / 20.0).Distance(f(i / 20.0, j / 20.0)) < 1e-12);
}

// Of other functions the points are met, and the error between them falls with the fourth power of their distance.
static void error_is_of_fourth_order(void **) {
  double error[2] = {0, 0};
  for (int fine = 0; fine < 2; fine++) {
    const int count = fine ? 41 : 21;
    const auto f = [](double t) { return gp_Pnt2d(std::cos(t), std::sin(t)); };
    const Handle(Geom2d_BSplineCurve) curve = cw_bspline_curve_2d(count, 0, M_PI, f);
    for (int i = 0; i < count; i++) {
      const double t = M_PI * i / (count - 1);
      assert_true(curve->Value(t).Distance(f(t)) < 1e-14);
    }
    for (int i = 0; i <= 1000; i++)
      error[fine] = std::fmax(error[fine], curve->Value(M_PI * i / 1000).Distance(f(M_PI * i / 1000)));
  }
  assert_true(error[0] < 1e-4);
  assert_near(std::log2(error[0] / error[1]), 4, 0.5);
}

// What two faces share is the same on both, to the bit: a row of points gives its poles alone.
static void common_edges_have_the_same_poles(void **) {
  uint64_t state = 7;
  const int nu = 6, nv = 8;
  const std::vector<double> u = uneven(&state, nu, 0, 1), v = uneven(&state, nv, 0, 1);
  std::vector<gp_Pnt> points, other, row;
  for (int i = 0; i < nu; i++)
    for (int j = 0; j < nv; j++) {
      points.push_back(gp_Pnt(draw(&state), draw(&state), draw(&state)));
      other.push_back(i == 0 ? points.back() : gp_Pnt(draw(&state), draw(&state), draw(&state)));
      if (i == 0) row.push_back(points.back());
    }
  const Handle(Geom_BSplineSurface) one = cw_bspline_surface(u, v, points), two = cw_bspline_surface(u, v, other);
  const Handle(Geom_BSplineCurve) edge = cw_bspline_curve_3d(v, row);
  for (int j = 1; j <= nv; j++) {
    assert_true(one->Pole(1, j).Distance(two->Pole(1, j)) == 0);
    assert_true(one->Pole(1, j).Distance(edge->Pole(j)) == 0);
    assert_true(one->Pole(2, j).Distance(two->Pole(2, j)) > 0);
  }
}

static void lines_are_straight(void **) {
  const gp_Pnt2d p(1, 2), q(3, -1);
  const Handle(Geom2d_BSplineCurve) line = cw_bspline_line_2d(2, 6, p, q);
  assert_true(line->Value(2).Distance(p) == 0);
  assert_true(line->Value(6).Distance(q) == 0);
  assert_true(line->Value(3).Distance(gp_Pnt2d(1.5, 1.25)) < 1e-15);
}

static void three_points_are_too_few(void **) {
  int refused = 0;
  try {
    cw_bspline_curve_2d(3, 0, 1, [](double t) { return gp_Pnt2d(t, t); });
  } catch (const Standard_Failure &) {
    refused = 1;
  }
  assert_true(refused);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cubics_are_met_everywhere), cmocka_unit_test(bicubics_are_met_everywhere),
      cmocka_unit_test(error_is_of_fourth_order),  cmocka_unit_test(common_edges_have_the_same_poles),
      cmocka_unit_test(lines_are_straight),        cmocka_unit_test(three_points_are_too_few),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
