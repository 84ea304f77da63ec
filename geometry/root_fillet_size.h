// SPDX-License-Identifier: AGPL-3.0-or-later
// How large a root fillet is at a place of the blade. A ball of radius R that rolls along the crease between
// blade and wall touches both at the tangent length L = R / tan(alpha/2), with the angle alpha between them
// through the fluid. Towards the trailing edge L falls to what has room between D2 and the interface.
#pragma once

#include "geometry/blade.h"
#include "geometry/design.h"

#ifdef __cplusplus
extern "C" {
#endif

// Greatest share of the blade's height that the fillets on hub and shroud may take together.
#define CW_ROOT_FILLETS_MOST 0.85

// A place on a wall at the foot of the blade. Vectors along the wall are (downstream, in the sense of theta).
typedef struct {
  double speed;   // of the meridian curve by q, m
  double radius;  // m
  double height;  // normal to the wall, by the share of the span, m
  double lean[2]; // of the blade's mean surface along the wall, by the height over it
} CwFilletPlace;

// The place at q of the wall of section `on`, whose span is 0 or 1; `off` is the section of a near span.
CwFilletPlace cw_root_fillet_place(const CwMeridian *meridian, const CwBladeSection *on, const CwBladeSection *off,
                                   double q);

// Angle of the crease on the side of the blade whose outline has the outward normal (m, t), rad; 45 degrees at
// least.
double cw_root_fillet_angle(const CwFilletPlace *place, double normal_m, double normal_t);

// L at q of a crease with the angle alpha, m.
double cw_root_fillet_length(const CwDesign *design, const CwBladeSection *on, double q, double alpha);

// Of the fillets on both sides of the blade's mean surface and before its leading edge.
typedef struct {
  double height_share; // of the blade's height that those on hub and shroud take together, at most
  double chord;        // of the narrowest, over R, but for the narrowing towards the trailing edge
} CwFilletFit;

// Fails as cw_blade_section().
CwStatus cw_root_fillet_fit(const CwDesign *design, const CwMeridian *meridian, CwFilletFit *fit);

#ifdef __cplusplus
}
#endif
