// SPDX-License-Identifier: AGPL-3.0-or-later
// Table 3 of the paper with the swirl that its wrap gives, for tests in C and C++.
#pragma once

#include <math.h>
#include <string.h>

#include "geometry/volute_design.h"
#include "tests/unit_test.h"

static inline CwVoluteInput volute_of_paper(void) {
  CwVoluteInput input;
  memset(&input, 0, sizeof input);
  input.flow_rate = input.pipe_flow_rate = 25 / 3600.0;
  input.angular_momentum = 0.95;
  input.interface_radius = 0.101;
  input.neck_width = 0.008;
  input.base_diameter = 0.204;
  input.inlet_width = 0.012;
  input.side_wall_angle = 20 * (M_PI / 180);
  input.throat_area = 905e-6;
  input.tongue_radius = 0.0015;
  input.tongue_gap = input.tongue_angle = input.tongue_gap_range[0] = input.tongue_gap_range[1] = NAN;
  input.area_law = CW_AREA_LAW_ANGULAR_MOMENTUM;
  input.section_speed = 5.9;
  input.section = CW_SECTION_TRAPEZOID;
  input.corner_radius = input.diffuser_area_ratio = NAN;
  input.discharge = CW_DISCHARGE_TANGENTIAL;
  input.diffuser_length = NAN;
  input.diffuser_angle = 9 * (M_PI / 180);
  input.outlet_diameter = 0.05;
  input.discharge_pipe_length = 0.1;
  return input;
}

static inline CwVolute designed_volute(const CwVoluteInput *input) {
  CwVolute volute;
  if (cw_volute_design(input, &volute) != CW_OK) fail_msg("%s", cw_fail_message());
  return volute;
}
