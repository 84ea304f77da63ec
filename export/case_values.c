// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/case_values.h"

CwStatus cw_case_values_set(const CwCase *table, CwValues *values) {
  CwStatus status = CW_OK;
  const CwOperatingPoint *point = &table->operating_point;
  const CwFluid *fluid = &table->fluid;
  const struct {
    const char *key;
    double value;
  } numbers[] = {{"speed", point->speed},
                 {"speed_rpm", point->speed * 30 / M_PI},
                 {"flow_rate", point->flow_rate},
                 {"head", point->head},
                 {"inlet_pressure", point->inlet_pressure},
                 {"density", fluid->density},
                 {"viscosity", fluid->kinematic_viscosity},
                 {"dynamic_viscosity", fluid->density * fluid->kinematic_viscosity},
                 {"time_step", point->time_step_angle / point->speed},
                 {"time_step_deg", point->time_step_angle * 180 / M_PI},
                 {"total_time", 10 * 2 * M_PI / point->speed}};
  CW_TRY(cw_values_set(values, "case", "%s", table->name));
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; ++i)
    CW_TRY(cw_values_set(values, numbers[i].key, "%.9g", numbers[i].value));
done:
  return status;
}

double cw_wall_roughness(const CwWalls *walls) {
  return walls->treatment == CW_WALL_FUNCTION_ROUGH ? walls->roughness : 0;
}

CwTurbulence cw_turbulence(double speed, double width) {
  const double cmu = 0.09, intensity = 0.05, mixing_length = 0.07 * width;
  CwTurbulence t;
  t.k = 1.5 * (intensity * speed) * (intensity * speed);
  t.epsilon = pow(cmu, 0.75) * pow(t.k, 1.5) / mixing_length;
  t.omega = t.epsilon / (cmu * t.k);
  return t;
}
