// SPDX-License-Identifier: AGPL-3.0-or-later
// The volute's diffuser: bore of the outlet, length or opening angle, and the place of the outlet.
//
// The equivalent cone has the areas of throat and outlet and the length of the diffuser's axis. Conical diffusers with
// a given length recover the most pressure on the line Cp* of Sovran and Klomp's chart (1967); with an area ratio of 2
// it lies at a full angle of 10 to 11 degrees. 8 to 10 degrees and area ratios of 1.5 to 3 are usual behind a volute,
// whose flow is uneven (Guelich, Centrifugal Pumps, section 7.8).
#pragma once

#include "geometry/volute.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define CW_DIFFUSER_LEAST_RATIO 1.5 // of the outlet's area to the throat's
#define CW_DIFFUSER_LARGEST_RATIO 3.0
#define CW_DIFFUSER_ANGLE (9 * M_PI / 180) // full angle, where neither it nor the length is given

// Bore of the outlet behind a throat for the flow rate that is delivered: the smallest standard bore of at least
// CW_DIFFUSER_LEAST_RATIO; the next larger ones while the flow there is faster than the economic speed of pipes, 4 m/s,
// up to CW_DIFFUSER_LARGEST_RATIO. m.
double cw_diffuser_bore(double flow_rate, double throat_area);

// The wall's lines from the throat's contour to the outlet's circle: they leave in the direction of the wall before the
// throat and arrive along the pipe. Where the diffuser is straight they are cubics with tangents of CW_DIFFUSER_TANGENT
// of its length; where it is bent (a radial discharge), the tangents are nearly as long as the arc, as an arc has them.
//
// The walls before the throat converge: cubics narrow the throat, the more, the longer they are. Where that would be
// more than a tenth of its width, the lines follow the diffuser's axis instead, and turn from their own direction into
// it over the share `turning` of their length, d the difference of both tangents:
//   line(v) = cubic along the axis + d turning t (1 - t)^3, t = v / turning <= 1
typedef struct {
  double tangent;          // CW_DIFFUSER_TANGENT of the diffuser's length
  double axis[2], down[2]; // unit vectors of the diffuser's axis at throat and outlet
  double bend;             // rad, to the right; 0: straight
  double turning;          // 1: plain cubics
} CwDiffuserLines;

#define CW_DIFFUSER_TANGENT 0.4

CwDiffuserLines cw_diffuser_lines(const CwVolute *volute);

// Point of the line from `start` to `end` at its share v, all in the lines' unit. `leaving`: the wall's direction at
// the throat, with `tangent` along y.
void cw_diffuser_line(const CwDiffuserLines *lines, const double start[3], const double leaving[3], const double end[3],
                      double v, double point[3]);

// Sets outlet diameter, length, angle and area ratio of the diffuser, and its axis from the throat to the outlet's
// centre, of a volute whose spiral and throat are known. Fails with CW_ERR_DESIGN and one line that names the key and
// its allowed range.
CwStatus cw_volute_diffuser(CwVolute *volute);

#ifdef __cplusplus
}
#endif
