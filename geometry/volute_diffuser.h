// SPDX-License-Identifier: AGPL-3.0-or-later
// The volute's diffuser: bore of the outlet, length or opening angle, and the place of the outlet.
//
// The equivalent cone has the areas of throat and outlet and the length of the diffuser's axis. Conical diffusers with
// a given length recover the most pressure on the line Cp* of Sovran and Klomp's chart (1967); with an area ratio of 2
// it lies at a full angle of 10 to 11 degrees. 8 to 10 degrees and area ratios of 1.5 to 3 are usual behind a volute,
// whose flow is uneven (Guelich, Centrifugal Pumps, section 7.8).
#ifndef CUTWATER_GEOMETRY_VOLUTE_DIFFUSER_H
#define CUTWATER_GEOMETRY_VOLUTE_DIFFUSER_H

#include "geometry/volute.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define CW_DIFFUSER_LEAST_RATIO 1.5 // of the outlet's area to the throat's
#define CW_DIFFUSER_LARGEST_RATIO 3.0
#define CW_DIFFUSER_ANGLE (9 * M_PI / 180) // full angle, where neither it nor the length is given

// Bore of the outlet behind a throat: the smallest standard bore of at least CW_DIFFUSER_LEAST_RATIO; the next larger
// ones while the flow there is faster than the economic speed of pipes, 4 m/s, up to CW_DIFFUSER_LARGEST_RATIO. m.
double cw_diffuser_bore(double flow_rate, double throat_area);

// The wall's lines from the throat's contour to the outlet's circle are cubics. Their tangents at both ends have, where
// the diffuser is straight, this share of its length across the throat; an even larger one lets the area fall at first.
#define CW_DIFFUSER_TANGENT 0.4

// The same where it is bent (a radial discharge), for a line whose ends are `distance` apart, in the unit of that:
// nearly the length of the arc, as an arc has it. 0 where the diffuser is straight.
double cw_diffuser_bent_tangent(const CwVolute *volute, double distance);

// Sets outlet diameter, length, angle and area ratio of the diffuser, and its axis from the throat to the outlet's
// centre, of a volute whose spiral and throat are known. Fails with CW_ERR_DESIGN and one line that names the key and
// its allowed range.
CwStatus cw_volute_diffuser(CwVolute *volute);

#ifdef __cplusplus
}
#endif
#endif
