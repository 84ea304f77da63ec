// SPDX-License-Identifier: AGPL-3.0-or-later
// Sections of the volute and its outer wall as functions of position; see volute.h for the shape, the
// names and the families. They need of the volute only its input, its law and the angles of its arcs.
#pragma once

#include "geometry/volute.h"

#ifdef __cplusplus
extern "C" {
#endif

// One section at the angle phi.
typedef struct {
  double kink_radius, kink_height;   // r_k, h_k, m
  double arc_radius, arc_centre;     // rho, r_c, m
  double arc_angle, arc_angle_slope; // k, rad, and its derivative d k / d phi
  double flat;                       // f, m: half width of the wall parallel to the axis
  double outer_radius;               // r_c + rho, m
  double area;                       // m2, from D3/2 outward
  double integral;                   // of b dr / r, m
  double kink_slope;                 // d r_k / d phi, m per rad
} CwVoluteSection;

// Whether the outer wall is parallel to the axis and has corners of a given radius.
int cw_volute_has_corners(const CwVolute *volute);

// D3/2, m.
static inline double cw_volute_base_radius(const CwVolute *volute) {
  return 0.5 * volute->input.base_diameter;
}

// Half width of the casing between the side walls at the radius r >= D3/2, m.
double cw_volute_half_width(const CwVolute *volute, double r);

// The section at phi; before the tongue, where the law may begin late, none is smaller than one whose kink lies on D3.
CwVoluteSection cw_volute_section(const CwVolute *volute, double phi);

// Radius of the outer wall at the level |z| <= h_k of a section, m.
double cw_volute_wall_radius(const CwVoluteSection *section, double z);

// Point of the outer wall, and its derivatives where not NULL, m and m/rad.
void cw_volute_wall_point(const CwVolute *volute, double phi, double psi, double x[3], double x_phi[3],
                          double x_psi[3]);

// The contour's parameter psi at the level w >= 0 of a section, where the arc's normal is at most 90 degrees
// from the radius; the arc goes on beyond the kink.
double cw_volute_section_parameter(const CwVolute *volute, const CwVoluteSection *section, double w);

// What grows linearly with phi, of the section with the kink at r_k and the arcs' half angle k: m or m2.
double cw_volute_law(const CwVolute *volute, double r_k, double k);

// Radial height r_o - r3 of a plain trapezoid (no outer arc) that passes the share q = Q phi / (2 pi K), m,
// of the flow with constant angular momentum: (b3 - 2 r3 tan a) ln(r_o/r3) + 2 tan a (r_o - r3) = q. NAN: no
// solution.
double cw_volute_trapezoid_height(double r3, double b3, double side_wall_angle, double q);

#ifdef __cplusplus
}
#endif
