// SPDX-License-Identifier: AGPL-3.0-or-later
// The meridional section (r, z) of the impeller: hub and shroud as cubic Beziers, both run radially to the
// interface in one piece; the hub ends upstream in a quarter ellipse and a flat disk (the nut), or in a shaft
// that goes out through the inlet, the shroud in the suction pipe.
//
//                      interface r = ri
//          z = -b2/2 +---+ z = +b2/2
//      shroud       /    |
//   pipe  ________ /    /  hub
//     r = D1/2         /
//               nut __/
//        -------|----------------- axis, +z to the right, suction at the left
#pragma once

#include "geometry/design.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_MERIDIAN_STEPS = 256 };

// The hub begins this many axial lengths before its end, near the plane where the shroud begins.
#define CW_MERIDIAN_HUB_START 1.2

// A cubic Bezier in the plane (r, z), m, with its arc length at equal steps of t.
typedef struct {
  double pole[4][2];
  double length[CW_MERIDIAN_STEPS + 1];
} CwMeridianCurve;

typedef struct {
  CwMeridianCurve hub, shroud;            // t = 0 upstream, t = 1 at the interface
  double hub_leading, hub_trailing;       // arc lengths of the blade's ends on the hub, m
  double shroud_leading, shroud_trailing; // the same on the shroud
  double nut_disk_radius, nut_end_z;      // end of the nut: flat, or on the shaft; without a nut the hub's
  double shaft_radius;                    // of a shaft through the inlet; 0: none
  double inlet_z;                         // plane of the inlet
} CwMeridian;

// Point (and derivative by t, NULL: not wanted) of a curve; t may lie a little outside 0..1.
void cw_meridian_point(const CwMeridianCurve *curve, double t, double x[2], double dx[2]);

// The parameter t at an arc length from t = 0 (m); within 1e-13 of the exact one.
double cw_meridian_parameter(const CwMeridianCurve *curve, double length);

// The arc length at t.
double cw_meridian_length(const CwMeridianCurve *curve, double t);

// The poles of hub and shroud, without their lengths, for the shares of cw_meridian_shape(): of the eye's height at
// which the hub's third pole lies, of the axial length at which the shroud's second lies before its end, of r2 - r1 at
// which its third lies outside the eye.
void cw_meridian_walls(const CwDesign *design, double hub_radial, double shroud_axial, double shroud_radial,
                       CwMeridianCurve *hub, CwMeridianCurve *shroud);

// Makes the section of a design. Reads D1, D2, b2, the hub, the shaft, the axial length, the poles' shares, the leading
// edge radii, the interface radius and the pipe. Fails with CW_ERR_DESIGN where a leading edge radius does not lie on
// its curve.
CwStatus cw_meridian_make(const CwDesign *design, CwMeridian *meridian);

// Point M_s(q) = (1 - s) H(q) + s S(q) with hub H and shroud S by arc length from the leading (q = 0) to the
// trailing edge (q = 1); dx = d/dq, NULL: not wanted.
void cw_meridian_blade_point(const CwMeridian *meridian, double s, double q, double x[2], double dx[2]);

// Flow area of the passage at fraction q from the leading edge to the trailing edge, square to the direction of the
// flow at mid-span, without blades, m2.
double cw_meridian_area(const CwMeridian *meridian, double q);

// Curvature at t, 1/m.
double cw_meridian_curvature(const CwMeridianCurve *curve, double t);

// The least bend radius of a curve between its ends, m.
double cw_meridian_bend_radius(const CwMeridianCurve *curve);

// Volume of the rotor's fluid without blades, m3: by integration of the section, exact to 1e-12.
double cw_meridian_volume(const CwMeridian *meridian);

#ifdef __cplusplus
}
#endif
