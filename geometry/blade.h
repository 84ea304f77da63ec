// SPDX-License-Identifier: AGPL-3.0-or-later
// The blade as sections of constant span s (0 hub, 1 shroud) in (q, theta): mean line by the blade angle law,
// ellipse at the leading edge, thickness, and a trailing edge cut on the D2 cylinder whose acute corner is
// bevelled. The blade sweeps backward: the wheel turns about +z by the right hand, theta falls from the
// leading to the trailing edge, and the pressure side is the one of greater theta.
#ifndef CUTWATER_GEOMETRY_BLADE_H
#define CUTWATER_GEOMETRY_BLADE_H

#include "geometry/hydraulic_design.h"
#include "geometry/meridian.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_BLADE_STEPS = 400 };

typedef enum { CW_BLADE_PRESSURE, CW_BLADE_SUCTION } CwBladeSide;

// One section. Angles in rad, lengths in m.
typedef struct {
  const CwMeridian *meridian;
  double span;
  double beta[3];                   // poles of the quadratic Bezier beta(q): beta1, free ordinate, beta2
  double theta[CW_BLADE_STEPS + 1]; // of the mean line at equal steps of q; 0 at the trailing edge
  double half_leading, half_largest, half_trailing; // half thicknesses
  double nose;                                      // q where the leading edge ellipse meets the sides
} CwBladeSection;

// A point of a section: q along hub and shroud after the offset, theta.
typedef struct {
  double q, theta;
} CwBladePoint;

// Wrap of a blade angle law on a section of the meridian: integral of dm / (r tan beta) from q = 0 to 1, rad.
double cw_blade_wrap(const CwMeridian *meridian, double span, const double beta[3]);

// Solves the free ordinate of the law for the design's wrap angle, the same for all sections. Fails with
// CW_ERR_DESIGN where beta would leave 12 to 60 degrees.
CwStatus cw_blade_section(const CwDesign *design, const CwMeridian *meridian, double span,
                          CwBladeSection *section);

// Blade angle at q, rad; mean line theta at q in 0..1.
double cw_blade_beta(const CwBladeSection *section, double q);
double cw_blade_theta(const CwBladeSection *section, double q);
double cw_blade_half_thickness(const CwBladeSection *section, double q);

// Point of a side at q of the mean line, nose <= q <= 1.
CwBladePoint cw_blade_side(const CwBladeSection *section, CwBladeSide side, double q);

// Point of the leading edge ellipse: psi from -pi/2 (suction) over 0 (foremost) to pi/2 (pressure).
CwBladePoint cw_blade_leading_edge(const CwBladeSection *section, double psi);

// q on the suction side where the bevel of the trailing edge begins, for a bevel facet of the given length,
// m. The same for all sections: solved at mid-span.
double cw_blade_bevel_begin(const CwBladeSection *section, double facet);

// Theta on the D2 cylinder where the bevel ends: both legs of the bevel are equally long.
double cw_blade_bevel_theta(const CwBladeSection *section, double q_begin);

// Length of the facet for which facet and rest of the trailing edge are equally long, m.
double cw_blade_balanced_bevel(double trailing_edge_thickness, double outlet_blade_angle);

#ifdef __cplusplus
}
#endif
#endif
