// SPDX-License-Identifier: AGPL-3.0-or-later
// Velocity triangles, slip, and what follows from them: head, incidence, throats, NPSH. One-dimensional
// theory at hub, mid-span and shroud with an even meridional speed across the span and no swirl before the
// impeller.
#pragma once

#include "geometry/design.h"
#include "geometry/meridian.h"
#include "pipeline/case.h"
#include "pipeline/status.h"

// Blockage 1 / (1 - z e / (2 pi r sin beta)) of `count` blades.
double cw_blockage(double count, double thickness, double radius, double angle);

// Range of the blade angles, rad.
extern const double cw_allowed_beta[2];

// Sets beta1 and the inlet triangle at mid-span: beta1 as given; else the blades meet the flow, which their own
// blockage turns, with the wanted incidence, within what the least angle on the shroud or the priority of the wrap
// allow.
void cw_inlet_triangle(const CwCase *table, const CwMeridian *meridian, CwDesign *design);

// Fails with CW_ERR_DESIGN where the blades of a design with an inlet triangle fill the inlet, or no beta1 within its
// range meets the flow between them; the line says how thick and how many they may be.
CwStatus cw_inlet_check(const CwCase *table, const CwDesign *design);

// Blades as the slip counts them: a splitter by its share of the length.
double cw_slip_blades(const CwDesign *design);

// Pfleiderer's p of H_inf = (1 + p) H_th: 0.65 (1 + beta2 / 60 deg) r2^2 / (z S) with S = integral r dm of
// the mean streamline, m2, of an impeller with a volute.
double cw_slip_pfleiderer(double count, double outlet_angle, double outlet_radius, double static_moment);

// Sets the outlet triangle at mid-span and the predicted heads for the outlet blade angle of the design.
void cw_outlet_triangle(const CwMeridian *meridian, CwDesign *design);

// The outlet blade angle in `range` with which the predicted head is the design's, rad. With slip the head grows with
// the angle only up to some angle and falls beyond, so that two may do: then the one that is nearer to the range
// `usual`, and of two that are as near the lesser. Where none does, the one of every half degree (12 to 60) whose head
// is nearest. design: [out] the outlet triangle with this angle.
double cw_outlet_angle_for_head(const CwMeridian *meridian, const double range[2], const double usual[2],
                                CwDesign *design);

// Sets both triangles at hub, mid-span and shroud, the throats and the estimate of NPSH. The design's blades
// are known.
CwStatus cw_velocity_triangles(const CwMeridian *meridian, double inlet_pressure, CwDesign *design);
