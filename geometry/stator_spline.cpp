// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/stator_spline.hpp"

#include <vector>

#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>

#include "geometry/bspline_fit.hpp"

static std::vector<double> even_parameters(int count, double a, double b) {
  std::vector<double> t(count, b);
  for (int i = 0; i < count - 1; i++) t[i] = a + i * (b - a) / (count - 1);
  return t;
}

Handle(Geom2d_BSplineCurve) spline_plane_curve(int count, double a, double b, const PlanePointOfOne &f) {
  std::vector<double> parameters = even_parameters(count, a, b);
  std::vector<gp_Pnt2d> points;
  for (double t : parameters) points.push_back(f(t));
  return cw_bspline_curve_2d(parameters, points);
}

Handle(Geom2d_BSplineCurve) straight_plane_curve(double a, double b, const gp_Pnt2d &p, const gp_Pnt2d &q) {
  TColgp_Array1OfPnt2d poles(1, 2);
  poles(1) = p;
  poles(2) = q;
  TColStd_Array1OfReal knots(1, 2);
  knots(1) = a;
  knots(2) = b;
  TColStd_Array1OfInteger multiplicities(1, 2);
  multiplicities.Init(2);
  return new Geom2d_BSplineCurve(poles, knots, multiplicities, 1);
}

Handle(Geom_BSplineSurface) spline_surface(int u_count, const std::vector<double> &v, const PointOfTwo &f) {
  std::vector<double> u = even_parameters(u_count, 0, 1);
  std::vector<gp_Pnt> points;
  for (double at_u : u)
    for (double at_v : v) points.push_back(f(at_u, at_v));
  return cw_bspline_surface(u, v, points);
}

Handle(Geom_BSplineSurface) spline_surface(int u_count, int v_count, const PointOfTwo &f) {
  return spline_surface(u_count, even_parameters(v_count, 0, 1), f);
}
