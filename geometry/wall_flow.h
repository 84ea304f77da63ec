// SPDX-License-Identifier: AGPL-3.0-or-later
// The flow along each kind of wall, from the sections that the water runs through: for a designed pump and for one of
// CAD.
#pragma once

#include "geometry/wall_name.h"
#include "pipeline/model.h"

// Speeds in m/s, lengths in m.
typedef struct {
  double radius;                                 // of the wheel's interface
  double blade_speed, passage[2], blade_width;   // relative; sides of the section between two blades; narrowest
  double behind_blades;                          // way from the trailing edges to the interface
  double volute_speed, volute_width, neck_width; // of spiral, and of what leads there
  double suction_speed, suction_diameter, suction_width;
  double throat_speed, throat_diameter; // where the spiral ends
  double discharge_speed, discharge_diameter;
} CwWaterWay;

void cw_wall_flows(const CwWaterWay *way, CwWallFlow flow[CW_ALONG_COUNT]);
