// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/wall_flow.h"

#include <math.h>

// Lengths along which the boundary layers grow, over the radius of the interface: a blade is a little longer than that,
// the spiral runs about three of them, the pipes some diameters.
static const double BLADE_LENGTH = 1.2, VOLUTE_LENGTH = 3, PIPE_LENGTH = 3;

void cw_wall_flows(const CwWaterWay *way, CwWallFlow flow[CW_ALONG_COUNT]) {
  const double throat = way->throat_diameter, discharge = way->discharge_diameter, pipe = PIPE_LENGTH * way->radius;
  // Between two blades: four times the section over its outline.
  const double passage = 2 * way->passage[0] * way->passage[1] / (way->passage[0] + way->passage[1]);
  flow[CW_ALONG_BLADE] = (CwWallFlow){way->blade_speed, BLADE_LENGTH * way->radius, passage, way->blade_width, 0};
  flow[CW_ALONG_TRAILING_EDGE] = flow[CW_ALONG_BLADE];
  flow[CW_ALONG_TRAILING_EDGE].before = way->behind_blades;
  flow[CW_ALONG_VOLUTE] =
      (CwWallFlow){way->volute_speed, VOLUTE_LENGTH * way->radius, throat, fmin(way->volute_width, throat), 0};
  flow[CW_ALONG_NECK] = flow[CW_ALONG_VOLUTE];
  flow[CW_ALONG_NECK].width = fmin(way->neck_width, throat);
  flow[CW_ALONG_SUCTION] = (CwWallFlow){way->suction_speed, pipe, way->suction_diameter, way->suction_width, 0};
  // The diffuser widens like a cone, from throat to discharge: along it the mean of Q / (pi r^2) is Q / (pi r0 r1).
  flow[CW_ALONG_DIFFUSER] = (CwWallFlow){sqrt(way->throat_speed * way->discharge_speed), pipe, sqrt(throat * discharge),
                                         fmin(throat, discharge), 0};
  flow[CW_ALONG_DISCHARGE] = (CwWallFlow){way->discharge_speed, pipe, discharge, discharge, 0};
}
