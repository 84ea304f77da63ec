// SPDX-License-Identifier: AGPL-3.0-or-later
// Cubic B-splines through points at prescribed parameters, or through functions at even ones. Two faces that
// interpolate the same row of points at the same parameters get the same boundary poles, so that their common edge is
// exact on both.
#pragma once

#include <functional>
#include <vector>

#include <Geom2d_BSplineCurve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <gp_Pnt.hxx>
#include <gp_Pnt2d.hxx>

// Curve through points[i] at parameters[i] (rising, at least four).
Handle(Geom2d_BSplineCurve)
    cw_bspline_curve_2d(const std::vector<double> &parameters, const std::vector<gp_Pnt2d> &points);

// The same in space.
Handle(Geom_BSplineCurve) cw_bspline_curve_3d(const std::vector<double> &parameters, const std::vector<gp_Pnt> &points);

// Surface through points[i * v.size() + j] at (u[i], v[j]); u and v rising, at least four each.
Handle(Geom_BSplineSurface)
    cw_bspline_surface(const std::vector<double> &u, const std::vector<double> &v, const std::vector<gp_Pnt> &points);

// Curve over [a, b] through f at `count` even parameters, at least 4.
Handle(Geom2d_BSplineCurve)
    cw_bspline_curve_2d(int count, double a, double b, const std::function<gp_Pnt2d(double)> &f);

// Straight from p at the parameter a to q at b.
Handle(Geom2d_BSplineCurve) cw_bspline_line_2d(double a, double b, const gp_Pnt2d &p, const gp_Pnt2d &q);

// Surface over [0,1] x [0,1] through f at u_count even parameters and, along v, at v_count or at the given places: at
// least 4 each way.
using CwPointOfTwo = std::function<gp_Pnt(double, double)>;
Handle(Geom_BSplineSurface) cw_bspline_surface(int u_count, int v_count, const CwPointOfTwo &f);
Handle(Geom_BSplineSurface) cw_bspline_surface(int u_count, const std::vector<double> &v, const CwPointOfTwo &f);
