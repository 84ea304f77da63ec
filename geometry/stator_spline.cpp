// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/stator_spline.hpp"

#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <gp_XYZ.hxx>

namespace {

// Interpolation on n even parameters of [0, 1] with a clamped cubic whose knots are all parameters but the second and
// the last but one (not-a-knot). Holds the collocation matrix, reduced without pivoting: it is totally positive.
class Interpolation {
public:
  explicit Interpolation(int n) : n_(n), matrix_(size_t(n) * n, 0.0) {
    flat_.assign(4, 0.0);
    for (int i = 2; i <= n - 3; i++) flat_.push_back(double(i) / (n - 1));
    flat_.insert(flat_.end(), 4, 1.0);
    for (int i = 0; i < n; i++) {
      double basis[4], t = double(i) / (n - 1);
      int first = basis_at(t, basis);
      for (int j = 0; j < 4; j++) matrix_[size_t(i) * n + first + j] = basis[j];
    }
    for (int k = 0; k < n; k++)
      for (int i = k + 1; i < n && i <= k + 4; i++) {
        double factor = matrix_[size_t(i) * n + k] /= matrix_[size_t(k) * n + k];
        for (int j = k + 1; j < n && j <= k + 8; j++) matrix_[size_t(i) * n + j] -= factor * matrix_[size_t(k) * n + j];
      }
  }

  // Points to poles, in place.
  void solve(std::vector<gp_XYZ> &p) const {
    for (int i = 0; i < n_; i++)
      for (int k = std::max(0, i - 4); k < i; k++) p[i] -= matrix_[size_t(i) * n_ + k] * p[k];
    for (int i = n_ - 1; i >= 0; i--) {
      for (int j = i + 1; j < n_ && j <= i + 8; j++) p[i] -= matrix_[size_t(i) * n_ + j] * p[j];
      p[i] /= matrix_[size_t(i) * n_ + i];
    }
  }

  void knots(double a, double b, TColStd_Array1OfReal &knots, TColStd_Array1OfInteger &multiplicities) const {
    for (int i = 1; i <= knot_count(); i++) {
      double t = flat_[i + 2];
      knots(i) = t == 1 ? b : a + t * (b - a);
      multiplicities(i) = i == 1 || i == knot_count() ? 4 : 1;
    }
  }
  int knot_count() const { return n_ - 2; }

private:
  int basis_at(double t, double basis[4]) const {
    int span = 3;
    while (span < n_ - 1 && t >= flat_[span + 1]) span++;
    double left[4], right[4];
    basis[0] = 1;
    for (int j = 1; j <= 3; j++) {
      left[j] = t - flat_[span + 1 - j];
      right[j] = flat_[span + j] - t;
      double saved = 0;
      for (int r = 0; r < j; r++) {
        double part = basis[r] / (right[r + 1] + left[j - r]);
        basis[r] = saved + right[r + 1] * part;
        saved = left[j - r] * part;
      }
      basis[j] = saved;
    }
    return span - 3;
  }

  int n_;
  std::vector<double> matrix_, flat_;
};

std::vector<gp_XYZ> poles_of_one(const Interpolation &interpolation, int count, double a, double b,
                                 const PointOfOne &f) {
  std::vector<gp_XYZ> poles(count);
  for (int i = 0; i < count; i++) poles[i] = f(i == count - 1 ? b : a + i * (b - a) / (count - 1)).XYZ();
  interpolation.solve(poles);
  return poles;
}

} // namespace

Handle(Geom_BSplineCurve) spline_curve(int count, double a, double b, const PointOfOne &f) {
  Interpolation interpolation(count);
  std::vector<gp_XYZ> solved = poles_of_one(interpolation, count, a, b, f);
  TColgp_Array1OfPnt poles(1, count);
  for (int i = 0; i < count; i++) poles(i + 1) = gp_Pnt(solved[i]);
  TColStd_Array1OfReal knots(1, interpolation.knot_count());
  TColStd_Array1OfInteger multiplicities(1, interpolation.knot_count());
  interpolation.knots(a, b, knots, multiplicities);
  return new Geom_BSplineCurve(poles, knots, multiplicities, 3);
}

Handle(Geom2d_BSplineCurve) spline_plane_curve(int count, double a, double b, const PlanePointOfOne &f) {
  Interpolation interpolation(count);
  std::vector<gp_XYZ> solved = poles_of_one(interpolation, count, a, b, [&](double t) {
    gp_Pnt2d p = f(t);
    return gp_Pnt(p.X(), p.Y(), 0);
  });
  TColgp_Array1OfPnt2d poles(1, count);
  for (int i = 0; i < count; i++) poles(i + 1) = gp_Pnt2d(solved[i].X(), solved[i].Y());
  TColStd_Array1OfReal knots(1, interpolation.knot_count());
  TColStd_Array1OfInteger multiplicities(1, interpolation.knot_count());
  interpolation.knots(a, b, knots, multiplicities);
  return new Geom2d_BSplineCurve(poles, knots, multiplicities, 3);
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

Handle(Geom_BSplineSurface) spline_surface(int u_count, int v_count, const PointOfTwo &f) {
  Interpolation in_u(u_count), in_v(v_count);
  TColgp_Array2OfPnt poles(1, u_count, 1, v_count);
  std::vector<std::vector<gp_XYZ>> rows(u_count);
  for (int i = 0; i < u_count; i++) {
    double u = double(i) / (u_count - 1);
    rows[i] = poles_of_one(in_v, v_count, 0, 1, [&](double v) { return f(u, v); });
  }
  std::vector<gp_XYZ> column(u_count);
  for (int j = 0; j < v_count; j++) {
    for (int i = 0; i < u_count; i++) column[i] = rows[i][j];
    in_u.solve(column);
    for (int i = 0; i < u_count; i++) poles(i + 1, j + 1) = gp_Pnt(column[i]);
  }
  TColStd_Array1OfReal u_knots(1, in_u.knot_count()), v_knots(1, in_v.knot_count());
  TColStd_Array1OfInteger u_multiplicities(1, in_u.knot_count()), v_multiplicities(1, in_v.knot_count());
  in_u.knots(0, 1, u_knots, u_multiplicities);
  in_v.knots(0, 1, v_knots, v_multiplicities);
  return new Geom_BSplineSurface(poles, u_knots, v_knots, u_multiplicities, v_multiplicities, 3, 3);
}

Handle(Geom_BSplineSurface) hermite_surface(int u_count, const PointOfOne &start, const PointOfOne &start_derivative,
                                            const PointOfOne &end, const PointOfOne &end_derivative) {
  Interpolation in_u(u_count);
  std::vector<gp_XYZ> rows[4] = {
    poles_of_one(in_u, u_count, 0, 1, start), poles_of_one(in_u, u_count, 0, 1, start_derivative),
    poles_of_one(in_u, u_count, 0, 1, end_derivative), poles_of_one(in_u, u_count, 0, 1, end)};
  TColgp_Array2OfPnt poles(1, u_count, 1, 4);
  for (int i = 0; i < u_count; i++) {
    poles(i + 1, 1) = gp_Pnt(rows[0][i]);
    poles(i + 1, 2) = gp_Pnt(rows[0][i] + rows[1][i] / 3);
    poles(i + 1, 3) = gp_Pnt(rows[3][i] - rows[2][i] / 3);
    poles(i + 1, 4) = gp_Pnt(rows[3][i]);
  }
  TColStd_Array1OfReal u_knots(1, in_u.knot_count()), v_knots(1, 2);
  TColStd_Array1OfInteger u_multiplicities(1, in_u.knot_count()), v_multiplicities(1, 2);
  in_u.knots(0, 1, u_knots, u_multiplicities);
  v_knots(1) = 0;
  v_knots(2) = 1;
  v_multiplicities.Init(4);
  return new Geom_BSplineSurface(poles, u_knots, v_knots, u_multiplicities, v_multiplicities, 3, 3);
}
