// SPDX-License-Identifier: AGPL-3.0-or-later
// Splines through functions at even parameters, on top of bspline_fit.hpp: faces that interpolate the same
// border with the same count of points share it exactly.
#ifndef CUTWATER_GEOMETRY_STATOR_SPLINE_HPP
#define CUTWATER_GEOMETRY_STATOR_SPLINE_HPP

#include <functional>
#include <vector>

#include <Geom2d_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <gp_Pnt.hxx>
#include <gp_Pnt2d.hxx>

using PointOfOne = std::function<gp_Pnt(double)>;
using PointOfTwo = std::function<gp_Pnt(double, double)>;
using PlanePointOfOne = std::function<gp_Pnt2d(double)>;

// Curve over [a, b] through f at `count` >= 4 even parameters.
Handle(Geom2d_BSplineCurve) spline_plane_curve(int count, double a, double b, const PlanePointOfOne &f);

// Straight from p at the parameter a to q at b.
Handle(Geom2d_BSplineCurve) straight_plane_curve(double a, double b, const gp_Pnt2d &p, const gp_Pnt2d &q);

// Surface over [0,1] x [0,1] through f at u_count x v_count even parameters, both at least 4.
Handle(Geom_BSplineSurface) spline_surface(int u_count, int v_count, const PointOfTwo &f);

// The same with v at the given places from 0 to 1.
Handle(Geom_BSplineSurface) spline_surface(int u_count, const std::vector<double> &v, const PointOfTwo &f);

#endif
