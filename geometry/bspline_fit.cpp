// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/bspline_fit.hpp"

#include <cmath>

#include <Standard_Failure.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_Array2OfPnt.hxx>

namespace {

const int degree = 3;

// Clamped knots by averaging (de Boor): the interpolation has a solution by Schoenberg-Whitney.
std::vector<double> averaged_knots(const std::vector<double> &parameters) {
  const int n = (int)parameters.size();
  std::vector<double> knots(n + degree + 1);
  for (int i = 0; i <= degree; i++) {
    knots[i] = parameters.front();
    knots[n + i] = parameters.back();
  }
  for (int i = 1; i < n - degree; i++) knots[i + degree] = (parameters[i] + parameters[i + 1] + parameters[i + 2]) / 3;
  return knots;
}

// The basis functions that do not vanish at t, by Cox and de Boor; returns the index of the first.
int basis(const std::vector<double> &knots, int n, double t, double value[degree + 1]) {
  int span = degree;
  while (span < n - 1 && t >= knots[span + 1]) span++;
  double left[degree + 1], right[degree + 1];
  value[0] = 1;
  for (int j = 1; j <= degree; j++) {
    left[j] = t - knots[span + 1 - j];
    right[j] = knots[span + j] - t;
    double saved = 0;
    for (int r = 0; r < j; r++) {
      const double part = value[r] / (right[r + 1] + left[j - r]);
      value[r] = saved + right[r + 1] * part;
      saved = left[j - r] * part;
    }
    value[j] = saved;
  }
  return span - degree;
}

// Solves for the poles of `width` functions at once: values[i * width + k] becomes the pole. Gauss with row
// pivots.
void solve_poles(const std::vector<double> &parameters, int width, std::vector<double> &values) {
  const int n = (int)parameters.size();
  const std::vector<double> knots = averaged_knots(parameters);
  std::vector<double> matrix((size_t)n * n, 0.0);
  for (int i = 0; i < n; i++) {
    double value[degree + 1];
    const int first = basis(knots, n, parameters[i], value);
    for (int j = 0; j <= degree; j++) matrix[(size_t)i * n + first + j] = value[j];
  }
  for (int c = 0; c < n; c++) {
    int pivot = c;
    for (int i = c + 1; i < n; i++)
      if (std::fabs(matrix[(size_t)i * n + c]) > std::fabs(matrix[(size_t)pivot * n + c])) pivot = i;
    if (pivot != c) {
      for (int j = 0; j < n; j++) std::swap(matrix[(size_t)c * n + j], matrix[(size_t)pivot * n + j]);
      for (int k = 0; k < width; k++) std::swap(values[(size_t)c * width + k], values[(size_t)pivot * width + k]);
    }
    for (int i = c + 1; i < n; i++) {
      const double factor = matrix[(size_t)i * n + c] / matrix[(size_t)c * n + c];
      if (factor == 0) continue;
      for (int j = c; j < n; j++) matrix[(size_t)i * n + j] -= factor * matrix[(size_t)c * n + j];
      for (int k = 0; k < width; k++) values[(size_t)i * width + k] -= factor * values[(size_t)c * width + k];
    }
  }
  for (int i = n; i-- > 0;)
    for (int k = 0; k < width; k++) {
      double sum = values[(size_t)i * width + k];
      for (int j = i + 1; j < n; j++) sum -= matrix[(size_t)i * n + j] * values[(size_t)j * width + k];
      values[(size_t)i * width + k] = sum / matrix[(size_t)i * n + i];
    }
}

// Distinct knots and multiplicities as OpenCASCADE wants them.
struct Knots {
  TColStd_Array1OfReal at;
  TColStd_Array1OfInteger times;
  explicit Knots(const std::vector<double> &parameters)
      : at(1, (int)parameters.size() - degree + 1), times(1, at.Length()) {
    const std::vector<double> all = averaged_knots(parameters);
    for (int i = 1; i <= at.Length(); i++) at(i) = all[degree + i - 1];
    times.Init(1);
    times.ChangeFirst() = times.ChangeLast() = degree + 1;
  }
};

void check(const std::vector<double> &parameters) {
  if (parameters.size() < degree + 1) throw Standard_Failure("a cubic needs four points");
}

template <class Curve, class Poles, class Point>
Handle(Curve) curve_through(int dimension, const std::vector<double> &parameters, const std::vector<Point> &points) {
  check(parameters);
  const int n = (int)parameters.size();
  std::vector<double> values;
  for (const Point &point : points)
    for (int k = 1; k <= dimension; k++) values.push_back(point.Coord(k));
  solve_poles(parameters, dimension, values);
  Poles poles(1, n);
  for (int i = 0; i < n; i++)
    for (int k = 0; k < dimension; k++) poles(i + 1).SetCoord(k + 1, values[dimension * i + k]);
  const Knots knots(parameters);
  return new Curve(poles, knots.at, knots.times, degree);
}

std::vector<double> even_parameters(int count, double a, double b) {
  std::vector<double> t(count, b);
  for (int i = 0; i < count - 1; i++) t[i] = a + i * (b - a) / (count - 1);
  return t;
}

} // namespace

Handle(Geom2d_BSplineCurve)
    cw_bspline_curve_2d(const std::vector<double> &parameters, const std::vector<gp_Pnt2d> &points) {
  return curve_through<Geom2d_BSplineCurve, TColgp_Array1OfPnt2d>(2, parameters, points);
}

Handle(Geom_BSplineCurve)
    cw_bspline_curve_3d(const std::vector<double> &parameters, const std::vector<gp_Pnt> &points) {
  return curve_through<Geom_BSplineCurve, TColgp_Array1OfPnt>(3, parameters, points);
}

Handle(Geom2d_BSplineCurve)
    cw_bspline_curve_2d(int count, double a, double b, const std::function<gp_Pnt2d(double)> &f) {
  const std::vector<double> parameters = even_parameters(count, a, b);
  std::vector<gp_Pnt2d> points;
  for (double t : parameters) points.push_back(f(t));
  return cw_bspline_curve_2d(parameters, points);
}

Handle(Geom2d_BSplineCurve) cw_bspline_line_2d(double a, double b, const gp_Pnt2d &p, const gp_Pnt2d &q) {
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

Handle(Geom_BSplineSurface)
    cw_bspline_surface(const std::vector<double> &u, const std::vector<double> &v, const std::vector<gp_Pnt> &points) {
  check(u);
  check(v);
  const int nu = (int)u.size(), nv = (int)v.size();
  // First along v for each row, then along u: a boundary row depends on its own points only.
  std::vector<double> by_v((size_t)nv * nu * 3), by_u((size_t)nu * nv * 3);
  for (int i = 0; i < nu; i++)
    for (int j = 0; j < nv; j++)
      for (int k = 0; k < 3; k++) by_v[((size_t)j * nu + i) * 3 + k] = points[(size_t)i * nv + j].Coord(k + 1);
  solve_poles(v, nu * 3, by_v);
  for (int i = 0; i < nu; i++)
    for (int j = 0; j < nv; j++)
      for (int k = 0; k < 3; k++) by_u[((size_t)i * nv + j) * 3 + k] = by_v[((size_t)j * nu + i) * 3 + k];
  solve_poles(u, nv * 3, by_u);
  TColgp_Array2OfPnt poles(1, nu, 1, nv);
  for (int i = 0; i < nu; i++)
    for (int j = 0; j < nv; j++) {
      const double *p = &by_u[((size_t)i * nv + j) * 3];
      poles.SetValue(i + 1, j + 1, gp_Pnt(p[0], p[1], p[2]));
    }
  const Knots u_knots(u), v_knots(v);
  return new Geom_BSplineSurface(poles, u_knots.at, v_knots.at, u_knots.times, v_knots.times, degree, degree);
}

Handle(Geom_BSplineSurface) cw_bspline_surface(int u_count, const std::vector<double> &v, const CwPointOfTwo &f) {
  const std::vector<double> u = even_parameters(u_count, 0, 1);
  std::vector<gp_Pnt> points;
  for (double at_u : u)
    for (double at_v : v) points.push_back(f(at_u, at_v));
  return cw_bspline_surface(u, v, points);
}

Handle(Geom_BSplineSurface) cw_bspline_surface(int u_count, int v_count, const CwPointOfTwo &f) {
  return cw_bspline_surface(u_count, even_parameters(v_count, 0, 1), f);
}
