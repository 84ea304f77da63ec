// SPDX-License-Identifier: AGPL-3.0-or-later
// The tongue's nose and the throat as functions of position; see volute.h for the shape and the names. They need of the
// volute what its tongue is placed by.
#pragma once

#include "geometry/volute.h"

#ifdef __cplusplus
extern "C" {
#endif

// Angle phi at which the nose touches the outer wall's line psi.
double cw_volute_contact_angle(const CwVolute *volute, double psi);

// Centre of the nose's circle (x, y) where it touches the outer wall at (phi, psi), and the unit normal of
// the wall's level line in plan, out of the fluid.
void cw_volute_contact_circle(const CwVolute *volute, double phi, double psi, double centre[2], double normal[2]);

// y of the centre of the nose's circle at the level |z| = w; its x is x_i - tongue radius. Above the level of
// the kink, where the spiral has no wall to touch, it goes on with the same slope and levels out.
double cw_volute_nose_y(const CwVolute *volute, double w);

// Sets the fields side_...: where the line of the nose's centres goes on above the wall.
void cw_volute_side_line(CwVolute *volute);

// Level |z| at which the line of the nose in the direction `beta` from the circle's centre (rad from +x; the
// nose lies at -pi < beta <= 0) meets the side wall. NAN: nowhere.
double cw_volute_nose_height(const CwVolute *volute, double beta);

// Angle phi at which the outer wall's line psi crosses the plane y = y_t of the throat, more than 2 pi.
double cw_volute_throat_angle(const CwVolute *volute, double psi);

#ifdef __cplusplus
}
#endif
