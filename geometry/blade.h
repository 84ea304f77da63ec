// SPDX-License-Identifier: AGPL-3.0-or-later
// The blade as sections of constant span s (0 hub, 1 shroud) in (q, theta): mean line by the blade angle law,
// ellipse at the leading edge, thickness, and a trailing edge that is cut on the D2 cylinder, with its acute
// corner bevelled, or rounded, or sharp. The blade sweeps backward: the wheel turns about +z by the right
// hand, theta falls from the leading to the trailing edge, and the pressure side is the one of greater theta.
#pragma once

#include "geometry/design.h"
#include "geometry/meridian.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_BLADE_STEPS = 400, CW_SPAN_POINTS = 13 }; // of a section; sections of a blade

typedef enum { CW_BLADE_PRESSURE, CW_BLADE_SUCTION } CwBladeSide;

// One section. Angles in rad, lengths in m. The parameter p of a blade runs from 0 at its leading to 1 at its
// trailing edge; q = start + (1 - start) p is the place between the blades' leading and trailing edges.
typedef struct {
  const CwMeridian *meridian;
  double span;
  double start;                     // 0; of a splitter: q of its leading edge
  double shift;                     // of theta: lean and, of a splitter, its place in the passage
  double beta[3];                   // poles of the quadratic Bezier beta(q): beta1, free ordinate, beta2
  double theta[CW_BLADE_STEPS + 1]; // of the mean line at equal steps of q; 0 at the trailing edge
  // Cylindrical blades: theta is a function of the radius alone, that of mid-span.
  CwBladeForm form;
  double radius[CW_BLADE_STEPS + 1];                // of mid-span at equal steps of q
  double half_leading, half_largest, half_trailing; // half thicknesses
  double thickest_at;
  double nose;          // p where the leading edge ellipse meets the sides
  double end;           // p where the sides end: 1, or where the rounding of the trailing edge begins
  double trailing_nose; // length in p of that rounding
} CwBladeSection;

// A point of a section: q along hub and shroud after the offset, theta.
typedef struct {
  double q, theta;
} CwBladePoint;

// Fifth-degree step from 0 to 1, flat to the second order at both ends.
static inline double cw_smooth_step(double x) {
  x = x < 0 ? 0 : x > 1 ? 1 : x;
  return x * x * x * (10 - 15 * x + 6 * x * x);
}

// Wrap of a blade angle law on a section of the meridian: integral of dm / (r tan beta) from q = 0 to 1, rad.
double cw_blade_wrap(const CwMeridian *meridian, double span, const double beta[3]);

// Solves the free ordinate of the law for the wrap of the section: the design's, with its spread from hub to
// shroud. Fails with CW_ERR_DESIGN where beta would leave 12 to 60 degrees, with the angles asked and what to
// change.
CwStatus cw_blade_section(const CwDesign *design, const CwMeridian *meridian, double span, CwBladeSection *section);

// The least angle between the blades' mean surface and hub or shroud, rad. Fails as cw_blade_section().
CwStatus cw_blade_wall_angle(const CwDesign *design, const CwMeridian *meridian, double *least);

// The least clear width on hub and shroud between a blade or splitter and the next, without root fillets, m; negative
// where they overlap. Fails as cw_blade_section().
CwStatus cw_blade_clearance(const CwDesign *design, const CwMeridian *meridian, double *least);

// The seams that divide a passage between blades whose walls would wind round the axis by a revolution, into equal
// parts that do not. Splitters divide it already.
typedef struct {
  int parts;
  double foremost; // angle of the foremost leading edge of blade and splitter, rad
  double reach;    // how far the walls of a part wind round the axis, rad; at most CW_SEAM_REACH_MOST can be built
} CwBladeSeams;
#define CW_SEAM_REACH_MOST (2 * M_PI - 1.5 * 0.15) // less the margins of a part beyond its blades
// Fails as cw_blade_section().
CwStatus cw_blade_seams(const CwDesign *design, const CwMeridian *meridian, CwBladeSeams *seams);

// Longest ellipse of the leading edge, in p: within half of the blade, and ending before it is thickest.
double cw_blade_longest_nose(const CwBladeSection *section);

// Makes the section of the splitter between two blades from the section of the blade.
CwBladeSection cw_blade_splitter(const CwDesign *design, const CwBladeSection *blade);

// Blade angle at p, rad; mean line theta at p in 0..1.
double cw_blade_beta(const CwBladeSection *section, double p);
double cw_blade_theta(const CwBladeSection *section, double p);
double cw_blade_half_thickness(const CwBladeSection *section, double p);

// Point of a side at p of the mean line, nose <= p <= end.
CwBladePoint cw_blade_side(const CwBladeSection *section, CwBladeSide side, double p);

// Point of the leading edge ellipse: psi from -pi/2 (suction) over 0 (foremost) to pi/2 (pressure).
CwBladePoint cw_blade_leading_edge(const CwBladeSection *section, double psi);

// Point of the rounded trailing edge: psi from -pi/2 (suction) to pi/2 (pressure).
CwBladePoint cw_blade_trailing_edge(const CwBladeSection *section, double psi);

// p on the suction side where the bevel of the trailing edge begins, for a bevel facet of the given length,
// m: with equal legs, or of a sharp edge. The same for all sections: solved at mid-span.
double cw_blade_bevel_begin(const CwBladeSection *section, CwTrailingEdge edge, double facet);

// Theta on the D2 cylinder where a bevel with legs of equal length ends.
double cw_blade_bevel_theta(const CwBladeSection *section, double p_begin);

// p before which no bevel may begin: 0.8, of a sharp edge 0.7; and the longest facet that does not.
double cw_blade_bevel_earliest(CwTrailingEdge edge);
double cw_blade_longest_bevel(const CwBladeSection *section, CwTrailingEdge edge);

// Length of the facet for which facet and rest of the trailing edge are equally long, or whose leg along the
// suction side is twice the cut (sharp), m.
double cw_blade_usual_bevel(CwTrailingEdge edge, double trailing_edge_thickness, double outlet_blade_angle);

#ifdef __cplusplus
}
#endif
