// SPDX-License-Identifier: AGPL-3.0-or-later
// The volute: spiral casing, tongue, throat, diffuser and discharge pipe, as numbers and as functions of
// position.
//
// A cut through the axis at the angle phi behind the tongue (SI units; the flow turns about +z by the right
// hand):
//
//      z ^          ,--K--.            cone  z = h(r) = b3/2 + (r - D3/2) tan a, the same at every phi
//        |     ,---'       \           K     kink (r_k, h_k) between cone and outer wall
//     b3/2 |--'             |          arcs  centres (r_c, +-f), radius rho, from the normal's angle 0 to k
//     b2/2 |                | f              at the kink; between them the wall is parallel to the axis
//        +-+----------------+--> r
//         D3/2      r_k   r_c + rho
//
// Families of sections, all with the same side walls at every phi:
//   trapezoid  without a corner radius: one arc (f = 0) with k = 35 deg everywhere; with one: rho is that
//              radius, f what is left
//   rectangle  the same with corners, a = 0
//   circle     one arc (f = 0) that touches the side walls; in a slim spiral it ends sooner
// Where k is not 35 deg everywhere, it is so at the tongue and grows over twice CW_VOLUTE_SECTOR behind it to
// 90 deg + a: from there on the arcs touch the side walls. At the tongue a wall that touches the side walls
// would lean the nose over until it has no thickness. Where a circle has no room, k ends at less.
//
// The contour's parameter psi runs from -k0 to k0, k0 = k at the tongue, in proportion to its length; where
// the contour is one arc with k = k0, psi is the angle at the arc's centre.
//
// The law of the spiral says what grows linearly with phi, M = M0 + (M1 - M0) phi / 2 pi: with constant
// angular momentum c_u r = K the integral of b dr / r over a section, so that M1 - M0 = Q / K; with constant
// velocity c3 (Stepanoff) the area, M1 - M0 = Q / c3. Either way each degree takes up the same share of the
// flow.
//
// Plan view: the tongue's flank, the inner wall of the discharge, is the plane x = x_i, the flow there runs
// in +y. At each level z = w the tongue is a circle of the nose's radius that touches the level line of the
// spiral's outer wall (at the contact angle) and x = x_i. The throat is the cut at y = y_t, just behind the
// nose; from it the diffuser leads to the outlet circle: tangentially, or bent away from the spiral until its
// pipe points away from the axis (radial discharge). All of this is in the tongue's own frame; the solid
// is turned about z by minus the discharge's lean, so that its pipe runs in +y.
#pragma once

#include "pipeline/case.h"

// rad: from one split of the solid's faces to the next; the contour changes over the first two of them.
#define CW_VOLUTE_SECTOR (M_PI * 5 / 12)

// Least difference of b3 and b2, in D3, and least half angle between side walls that are not parallel, rad.
#define CW_VOLUTE_LEAST_STEP 5e-3
#define CW_VOLUTE_LEAST_SIDE_WALL (M_PI / 36)

// A tongue lies where it was asked for within this: rad, or of D3/2.
#define CW_VOLUTE_TONGUE_SLACK 1e-6

// The fields are what the keys of the case, the design of the impeller and the correlations leave.
typedef struct {
  double flow_rate;      // Q of the spiral's law, m3/s; of a viscous fluid that with water
  double pipe_flow_rate; // Q that is delivered, m3/s, by which an open bore is chosen
  CwAreaLaw area_law;
  double angular_momentum; // K = c_u2 r2, m2/s; for constant angular momentum
  double section_speed;    // c3, m/s; for constant velocity
  CwVoluteSectionKind section;
  double corner_radius;       // m, between side and outer wall; NAN: none (a rectangle needs one)
  double interface_radius;    // of the cylinder to the rotor, m
  double neck_width;          // b2, m: width from the interface to D3/2
  double base_diameter;       // D3, m
  double inlet_width;         // b3, m
  double side_wall_angle;     // a, rad: half angle between the side walls; a rectangle has 0 whatever it says
  double throat_area;         // m2; NAN: what the law gives for Q and K or c3
  double tongue_radius;       // of the nose, m
  double tongue_gap;          // m, radial, from D3/2 to the tip at z = 0, or as near as can be; NAN: well shaped
  double tongue_angle;        // rad, from the spiral's start to the tip, or as near as can be; NAN: as the gap asks
  double tongue_gap_range[2]; // m, of a chosen gap, which comes as near as the spiral allows; NAN: no bound
  double diffuser_length;     // m; NAN: from the diffuser's angle
  double diffuser_angle;      // rad, full angle of the cone of equal areas; used where the length is NAN
  double outlet_diameter;     // DN, m; NAN: from the area ratio, or a standard bore
  double diffuser_area_ratio; // of outlet to throat; NAN: as the diameter says, and without it by cw_diffuser_bore()
  CwDischarge discharge;
  double discharge_pipe_length; // m, behind the diffuser; NAN: two outlet diameters
} CwVoluteInput;

// What could help a volute that cannot be designed; where several sections were tried, the last in this list.
typedef enum {
  CW_VOLUTE_OTHER_INPUT,    // in the range, or with other corners, circles or a diffuser that fit
  CW_VOLUTE_THINNER_TONGUE, // in its throat
  CW_VOLUTE_WIDER_SPIRAL,   // that reaches less far out, or is not too steep for a tongue; or a thinner tongue
} CwVoluteHelp;

// The fields are the dimensions of the sections, the tongue and the diffuser, in that order.
typedef struct {
  CwVoluteInput input;
  CwVoluteHelp help;          // of a failed design
  double arc_half_angle;      // k0, rad
  double end_half_angle;      // k behind the first sector, rad
  double law_start;           // M0 at phi = 0, m or m2
  double law_end;             // M1 at phi = 2 pi
  double law_constant;        // Q / (M1 - M0): the K, m2/s, or c3, m/s, that the spiral is made for; equals the
                              // given one unless the throat is given
  double start_angle;         // rad: where the kink line begins, at the tongue's side; the contact angle at psi = k
  double tip_angle;           // rad: the contact angle at z = 0
  double tip_radius;          // m: least distance of the tongue from the axis at z = 0
  double inner_wall_x;        // x_i, m
  double throat_y;            // y_t, m
  double throat_area;         // m2, of the cut at y = y_t
  double throat_width;        // m, in x at z = 0
  double side_level;          // m: |z| of the kink where it begins
  double side_centre_y;       // m: y of the nose's centre at that level
  double side_centre_slope;   // its derivative with respect to |z|
  double diffuser_length;     // m
  double diffuser_angle;      // rad, full angle of the cone of equal areas
  double diffuser_area_ratio; // outlet to throat
  double throat_lean;         // rad: the diffuser begins along (-sin, cos) of it, midway between the throat's walls
  double discharge_lean;      // rad: the pipe runs along (-sin, cos) of it; tangential: as the throat
  double outlet_x, outlet_y;  // m: centre of the diffuser's end; its z is 0
} CwVolute;
