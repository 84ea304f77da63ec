// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/design_value.h"

#include <math.h>
#include <stdio.h>

// How each kind of quantity is shown, and stored in design.json.
enum { NUMBER, LENGTH, HEAD, ANGLE, SPEED, FLOW, ANGULAR_SPEED, AREA, DIFFUSIVITY, POWER, PRESSURE };
static const struct {
  double shown;
  const char *unit;
  double stored;
  const char *suffix;
} units[] = {
    [NUMBER] = {1, "", 1, ""},
    [LENGTH] = {1e3, "mm", 1, "_m"},
    [HEAD] = {1, "m", 1, "_m"},
    [ANGLE] = {180 / M_PI, "deg", 180 / M_PI, "_deg"},
    [SPEED] = {1, "m/s", 1, "_m_per_s"},
    [FLOW] = {3600, "m3/h", 1, "_m3_per_s"},
    [ANGULAR_SPEED] = {30 / M_PI, "rpm", 1, "_rad_per_s"},
    [AREA] = {1e6, "mm2", 1, "_m2"},
    [DIFFUSIVITY] = {1, "m2/s", 1, "_m2_per_s"},
    [POWER] = {1e-3, "kW", 1, "_w"},
    [PRESSURE] = {1, "Pa", 1, "_pa"},
};

CwDesignValue cw_hydraulic_design_value(const CwDesign *design, CwDesignQuantity quantity) {
#define ROW(member, kind, text) {#member, text, kind},
  static const struct {
    const char *member, *text;
    int kind;
  } rows[] = {CW_DESIGN_LIST(ROW)};
#undef ROW
#define VALUE(member, kind, text) design->member,
  const double values[] = {CW_DESIGN_LIST(VALUE)};
#undef VALUE
  const int kind = rows[quantity].kind;
  CwDesignValue value = {.text = rows[quantity].text,
                         .unit = units[kind].unit,
                         .shown = values[quantity] * units[kind].shown,
                         .asked = design->asked[quantity] * units[kind].shown,
                         .stored = values[quantity] * units[kind].stored};
  snprintf(value.key, sizeof value.key, "%s%s", rows[quantity].member, units[kind].suffix);
  return value;
}

void cw_hydraulic_design_row(const CwDesign *design, CwDesignQuantity quantity, char *line, size_t size) {
  const CwDesignValue value = cw_hydraulic_design_value(design, quantity);
  snprintf(line, size, "%-52s %10.5g %-5s %s", value.text, value.shown, value.unit, design->source[quantity]);
}
