// SPDX-License-Identifier: AGPL-3.0-or-later
// Cubic B-splines through points at prescribed parameters. Two faces that interpolate the same row of points
// at the same parameters get the same boundary poles, so that their common edge is exact on both.
#ifndef CUTWATER_GEOMETRY_BSPLINE_FIT_HPP
#define CUTWATER_GEOMETRY_BSPLINE_FIT_HPP

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

#endif
