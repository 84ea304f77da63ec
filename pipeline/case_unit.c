// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/case_unit.h"

#include <math.h>
#include <string.h>
#include <strings.h>

// Those that keys end in, and those that people write by mistake.
static const CwUnit units[] = {
    {"mm", "mm", "length", 1, 1000},
    {"m", "m", "length", 1, 1},
    {"cm", "cm", "length", 1, 100},
    {"um", "um", "length", 1, 1e6},
    {"in", "in", "length", 254, 10000},
    {"in2", "in2", "area", 64516, 1e8},
    {"inch", "in", "length", 254, 10000},
    {"ft", "ft", "length", 3048, 10000},
    {"mm2", "mm2", "area", 1, 1e6},
    {"cm2", "cm2", "area", 1, 1e4},
    {"m2", "m2", "area", 1, 1},
    {"deg", "degrees", "angle", M_PI, 180},
    {"rad", "rad", "angle", 1, 1},
    {"rpm", "rpm", "speed", M_PI, 30},
    {"rad_per_s", "rad/s", "speed", 1, 1},
    {"hz", "Hz", "speed", 2 * M_PI, 1},
    {"m_per_s", "m/s", "velocity", 1, 1},
    {"ft_per_s", "ft/s", "velocity", 3048, 10000},
    {"m3_per_h", "m3/h", "flow rate", 1, 3600},
    {"m3_per_s", "m3/s", "flow rate", 1, 1},
    {"l_per_s", "l/s", "flow rate", 1, 1000},
    {"l_per_min", "l/min", "flow rate", 1, 60000},
    {"gpm", "US gal/min", "flow rate", 3785411784.0, 60e12},
    {"ft3_per_s", "ft3/s", "flow rate", 28316846592.0, 1e12},
    {"pa", "Pa", "pressure", 1, 1},
    {"kpa", "kPa", "pressure", 1000, 1},
    {"mpa", "MPa", "pressure", 1e6, 1},
    {"bar", "bar", "pressure", 1e5, 1},
    {"atm", "atm", "pressure", 101325, 1},
    {"psi", "psi", "pressure", 6894757293168.0, 1e9},
    {"kg_per_m3", "kg/m3", "density", 1, 1},
    {"g_per_cm3", "g/cm3", "density", 1000, 1},
    {"lb_per_ft3", "lb/ft3", "density", 45359237e4, 28316846592.0},
    {"m2_per_s", "m2/s", "viscosity", 1, 1},
    {"mm2_per_s", "mm2/s", "viscosity", 1, 1e6},
    {"cst", "cSt", "viscosity", 1, 1e6},
    {"ft2_per_s", "ft2/s", "viscosity", 9290304, 1e8},
    {"c", "degrees Celsius", "temperature", 1, 1},
};
enum { UNIT_COUNT = sizeof units / sizeof *units };

const CwUnit *cw_unit_find(const char *suffix) {
  for (int i = 0; i < UNIT_COUNT; ++i)
    if (!strcmp(units[i].suffix, suffix)) return &units[i];
  return NULL;
}

const CwUnit *cw_unit_of_key(const char *key, size_t *stem) {
  // The longest suffix wins: "speed_rad_per_s" does not end in "s" and "kinematic_viscosity_m2_per_s" not in
  // "m2".
  const CwUnit *best = NULL;
  size_t length = strlen(key), best_size = 0;
  *stem = length;
  for (int i = 0; i < UNIT_COUNT; ++i) {
    size_t size = strlen(units[i].suffix);
    if (size <= best_size || size + 2 > length || key[length - size - 1] != '_') continue;
    if (strcasecmp(key + length - size, units[i].suffix)) continue;
    best = &units[i];
    best_size = size;
    *stem = length - size - 1;
  }
  return best;
}

void cw_units_markdown(FILE *stream) {
  fputs("\n### Units\n\nA key takes any unit of its quantity: `outlet_diameter_in: 8` stands for "
        "`outlet_diameter_mm: 203.2`.\n\n| quantity | a key may end in |\n|---|---|\n",
        stream);
  for (int i = 0; i < UNIT_COUNT; ++i) {
    int known = 0;
    for (int j = 0; j < i; ++j) known |= !strcmp(units[i].quantity, units[j].quantity);
    if (known) continue;
    fprintf(stream, "| %s |", units[i].quantity);
    for (int j = i; j < UNIT_COUNT; ++j)
      if (!strcmp(units[i].quantity, units[j].quantity))
        fprintf(stream, "%s `_%s`", j == i ? "" : ",", units[j].suffix);
    fputs(" |\n", stream);
  }
}
