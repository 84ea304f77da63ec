// SPDX-License-Identifier: AGPL-3.0-or-later
// What the files of several solvers say of a case.
#pragma once

#include "export/template.h"
#include "pipeline/case.h"

// Sets "case", its name, and "speed" (rad/s), "speed_rpm", "flow_rate" (m3/s), "head" (m), "inlet_pressure" (Pa),
// "density" (kg/m3), "viscosity" (kinematic, m2/s), "dynamic_viscosity" (Pa s), "time_step" (s), "time_step_deg" and
// "total_time" (s), of ten turns.
CwStatus cw_case_values_set(const CwCase *table, CwValues *values);

// The sand grain roughness that wall functions take (m): 0 where walls.treatment is smooth.
double cw_wall_roughness(const CwWalls *walls);

// Turbulence at the inlet and inside at the start.
typedef struct {
  double k, epsilon, omega; // m2/s2, m2/s3, 1/s
} CwTurbulence;

// From the mean speed (m/s) in a passage of that width (m), with an intensity I of 5 % and a mixing length l of 7 % of
// the width: k = 3/2 (I U)^2, epsilon = Cmu^(3/4) k^(3/2) / l, omega = epsilon / (Cmu k), with Cmu = 0.09.
CwTurbulence cw_turbulence(double speed, double width);
