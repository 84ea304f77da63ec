// SPDX-License-Identifier: AGPL-3.0-or-later
// The volute: spiral casing, tongue, throat, diffuser and discharge pipe, as numbers and as functions of
// position.
//
// A cut through the axis at the angle phi behind the tongue (SI units; the flow turns about +z by the right
// hand):
//
//      z ^          ,--K--.            cone  z = h(r) = b3/2 + (r - D3/2) tan a, the same at every phi
//        |     ,---'       \           K     kink (r_k, h_k) between cone and outer wall
//     b3/2 |--'             |          arc   centre (r_c, 0), radius rho, half angle k = 35 deg:
//     b2/2 |                |                points (r_c + rho cos psi, rho sin psi), -k <= psi <= k
//        +-+----------------+--> r
//         D3/2      r_k   r_c + rho
//
// The spiral follows the law of constant angular momentum c_u r = K: the integral I of b dr / r over a
// section grows linearly with phi, I = I0 + (I1 - I0) phi / 2 pi, so that each degree takes up the same share
// of the flow.
//
// Plan view: the tongue's flank, the inner wall of the discharge, is the plane x = x_i, the flow there runs
// in +y. At each level z = w the tongue is a circle of the nose's radius that touches the level line of the
// spiral's outer wall (at the contact angle) and x = x_i. The throat is the cut at y = y_t, just behind the
// nose; from it the diffuser leads to the outlet circle. All of this is in the tongue's own frame; the solid
// is turned about z by minus the discharge's lean, so that its pipe runs in +y.
#ifndef CUTWATER_GEOMETRY_VOLUTE_DESIGN_H
#define CUTWATER_GEOMETRY_VOLUTE_DESIGN_H

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  double flow_rate;        // Q, m3/s
  double angular_momentum; // K = c_u2 r2, m2/s
  double interface_radius; // of the cylinder to the rotor, m
  double neck_width;       // b2, m: width from the interface to D3/2
  double base_diameter;    // D3, m
  double inlet_width;      // b3, m, at least b2 + 1 mm
  double side_wall_angle;  // a, rad: half angle between the side walls
  double throat_area;      // m2; NAN: what the law of constant angular momentum gives for Q and K
  double tongue_radius;    // of the nose, m
  double
      tongue_gap; // m, radial, from D3/2 to the tongue's tip at z = 0; NAN: chosen for a well shaped tongue
  double least_tongue_gap;      // m, for a chosen gap, which comes as near as the spiral allows; NAN: none
  double diffuser_length;       // m; NAN: from the diffuser's angle
  double diffuser_angle;        // rad, full angle of the cone of equal areas; used where the length is NAN
  double outlet_diameter;       // DN, m
  double discharge_pipe_length; // m, behind the diffuser
} CwVoluteInput;

typedef struct {
  CwVoluteInput input;
  double arc_half_angle;  // k, rad
  double integral_start;  // I0 at phi = 0, m
  double integral_end;    // I1 at phi = 2 pi, m
  double design_momentum; // Q / (I1 - I0), m2/s: the K that the spiral is made for; equals K unless the
                          // throat is given
  double start_angle;   // rad: where the kink line begins, at the tongue's side; the contact angle at psi = k
  double tip_angle;     // rad: the contact angle at z = 0
  double tip_radius;    // m: least distance of the tongue from the axis at z = 0
  double inner_wall_x;  // x_i, m
  double throat_y;      // y_t, m
  double throat_area;   // m2, of the cut at y = y_t
  double throat_width;  // m, in x at z = 0
  double side_level;    // m: |z| of the kink where it begins
  double side_centre_y; // m: y of the nose's centre at that level
  double side_centre_slope; // its derivative with respect to |z|
  double diffuser_length;   // m
  double diffuser_angle;    // rad, full angle of the cone of equal areas
  double discharge_lean; // rad: the discharge runs along (-sin, cos) of it, midway between the throat's walls
  double outlet_x, outlet_y; // m: centre of the diffuser's end; its z is 0
} CwVolute;

// One section at the angle phi.
typedef struct {
  double kink_radius, kink_height; // r_k, h_k, m
  double arc_radius, arc_centre;   // rho, r_c, m
  double outer_radius;             // r_c + rho, m
  double area;                     // m2, from D3/2 outward
  double integral;                 // of b dr / r, m
  double kink_slope;               // d r_k / d phi, m per rad
} CwVoluteSection;

// Designs the volute. Fails with CW_ERR_DESIGN and one line that names the quantity and its allowed range.
CwStatus cw_volute_design(const CwVoluteInput *input, CwVolute *volute);

// Half width of the casing between the side walls at the radius r >= D3/2, m.
double cw_volute_half_width(const CwVolute *volute, double r);

CwVoluteSection cw_volute_section(const CwVolute *volute, double phi);

// Point of the outer wall, and its derivatives where not NULL, m and m/rad.
void cw_volute_wall_point(const CwVolute *volute, double phi, double psi, double x[3], double x_phi[3],
                          double x_psi[3]);

// Angle phi at which the nose touches the outer wall's line psi.
double cw_volute_contact_angle(const CwVolute *volute, double psi);

// Centre of the nose's circle (x, y) where it touches the outer wall at (phi, psi), and the unit normal of
// the wall's level line in plan, out of the fluid.
void cw_volute_contact_circle(const CwVolute *volute, double phi, double psi, double centre[2],
                              double normal[2]);

// y of the centre of the nose's circle at the level |z| = w; its x is x_i - tongue radius. Above the level of
// the kink, where the spiral has no wall to touch, it goes on with the same slope and levels out.
double cw_volute_nose_y(const CwVolute *volute, double w);

// Level |z| at which the line of the nose in the direction `beta` from the circle's centre (rad from +x; the
// nose lies at -pi < beta <= 0) meets the side wall. NAN: nowhere.
double cw_volute_nose_height(const CwVolute *volute, double beta);

// Angle phi at which the outer wall's line psi crosses the plane y = y_t of the throat, more than 2 pi.
double cw_volute_throat_angle(const CwVolute *volute, double psi);

// Radial height r_o - r3 of a plain trapezoid (no outer arc) that passes the share q = Q phi / (2 pi K), m,
// of the flow with constant angular momentum: (b3 - 2 r3 tan a) ln(r_o/r3) + 2 tan a (r_o - r3) = q. NAN: no
// solution.
double cw_volute_trapezoid_height(double r3, double b3, double side_wall_angle, double q);

#ifdef __cplusplus
}
#endif
#endif
