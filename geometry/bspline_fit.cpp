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
void open_cascade_knots(const std::vector<double> &parameters, std::vector<double> &knots, std::vector<int> &times) {
  const std::vector<double> all = averaged_knots(parameters);
  knots = {all.front()};
  times = {degree + 1};
  for (size_t i = degree + 1; i + degree + 1 < all.size(); i++) {
    knots.push_back(all[i]);
    times.push_back(1);
  }
  knots.push_back(all.back());
  times.push_back(degree + 1);
}

template <class Array, class Value> Array to_array(const std::vector<Value> &values) {
  Array array(1, (int)values.size());
  for (size_t i = 0; i < values.size(); i++) array.SetValue((int)i + 1, values[i]);
  return array;
}

void check(const std::vector<double> &parameters) {
  if (parameters.size() < degree + 1) throw Standard_Failure("a cubic needs four points");
}

} // namespace

Handle(Geom2d_BSplineCurve)
    cw_bspline_curve_2d(const std::vector<double> &parameters, const std::vector<gp_Pnt2d> &points) {
  check(parameters);
  const int n = (int)parameters.size();
  std::vector<double> values((size_t)n * 2), knots;
  std::vector<int> times;
  for (int i = 0; i < n; i++) {
    values[2 * i] = points[i].X();
    values[2 * i + 1] = points[i].Y();
  }
  solve_poles(parameters, 2, values);
  TColgp_Array1OfPnt2d poles(1, n);
  for (int i = 0; i < n; i++) poles.SetValue(i + 1, gp_Pnt2d(values[2 * i], values[2 * i + 1]));
  open_cascade_knots(parameters, knots, times);
  return new Geom2d_BSplineCurve(poles, to_array<TColStd_Array1OfReal>(knots), to_array<TColStd_Array1OfInteger>(times),
                                 degree);
}

Handle(Geom_BSplineCurve)
    cw_bspline_curve_3d(const std::vector<double> &parameters, const std::vector<gp_Pnt> &points) {
  check(parameters);
  const int n = (int)parameters.size();
  std::vector<double> values((size_t)n * 3), knots;
  std::vector<int> times;
  for (int i = 0; i < n; i++)
    for (int k = 0; k < 3; k++) values[3 * i + k] = points[i].Coord(k + 1);
  solve_poles(parameters, 3, values);
  TColgp_Array1OfPnt poles(1, n);
  for (int i = 0; i < n; i++) poles.SetValue(i + 1, gp_Pnt(values[3 * i], values[3 * i + 1], values[3 * i + 2]));
  open_cascade_knots(parameters, knots, times);
  return new Geom_BSplineCurve(poles, to_array<TColStd_Array1OfReal>(knots), to_array<TColStd_Array1OfInteger>(times),
                               degree);
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
  std::vector<double> uk, vk;
  std::vector<int> ut, vt;
  open_cascade_knots(u, uk, ut);
  open_cascade_knots(v, vk, vt);
  return new Geom_BSplineSurface(poles, to_array<TColStd_Array1OfReal>(uk), to_array<TColStd_Array1OfReal>(vk),
                                 to_array<TColStd_Array1OfInteger>(ut), to_array<TColStd_Array1OfInteger>(vt), degree,
                                 degree);
}
