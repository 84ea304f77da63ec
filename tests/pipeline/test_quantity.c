// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/quantity.h"

#include <stdlib.h>
#include <string.h>

#include "tests/unit_test.h"

// One of each unit in what it is shown in.
static void quantities_have_their_units(void **state) {
  static const struct {
    const char *key, *stem, *unit;
    double shown; // of 1 in the unit of the key
  } wanted[] = {{"flow_rate_m3_per_s", "flow_rate", "m&sup3;/h", 3600},
                {"flow_m3_per_h", "flow", "m&sup3;/h", 1},
                {"kinematic_viscosity_m2_per_s", "kinematic_viscosity", "m&sup2;/s", 1},
                {"angular_speed_rad_per_s", "angular_speed", "rad/s", 1},
                {"inlet_blade_speed_m_per_s", "inlet_blade_speed", "m/s", 1},
                {"theoretical_head_m", "theoretical_head", "m", 1},
                {"head_residual_m", "head_residual", "m", 1},
                {"predicted_head_wiesner_m", "predicted_head_wiesner", "m", 1},
                {"predicted_head_pfleiderer_m", "predicted_head_pfleiderer", "m", 1},
                {"npsh_required_m", "npsh_required", "m", 1},
                {"npsh_available_m", "npsh_available", "m", 1},
                {"wrap_angle_deg", "wrap_angle", "&deg;", 1},
                {"throat_area_m2", "throat_area", "mm&sup2;", 1e6},
                {"least_cell_volume_m3", "least_cell_volume", "mm&sup3;", 1e9},
                {"solid_volume_m3", "solid_volume", "cm&sup3;", 1e6},
                {"outlet_diameter_m", "outlet_diameter", "mm", 1e3},
                {"shaft_power_w", "shaft_power", "W", 1},
                {"vapour_pressure_pa", "vapour_pressure", "Pa", 1},
                {"blade_count", "blade_count", "", 1}};
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
    char stem[CW_STEM_SIZE];
    const CwQuantityUnit *unit = cw_quantity_unit(wanted[i].key);
    cw_quantity_stem(wanted[i].key, stem);
    assert_string_equal(stem, wanted[i].stem);
    assert_string_equal(unit->unit, wanted[i].unit);
    assert_near(unit->scale, wanted[i].shown, 0);
  }
}

// A name that is given begins with a capital where it is a word; else the stem is the name.
static void a_row_starts_with_name_and_symbol(void **state) {
  static const struct {
    const char *stem, *name, *row;
  } wanted[] = {{"outlet_diameter", NULL, "<tr><td>Outlet diameter</td><td class=\"q\">D<sub>2</sub></td>"},
                {"slip_factor", "slip by Wiesner & others",
                 "<tr><td>Slip by Wiesner &amp; others</td><td class=\"q\">&gamma;</td>"},
                {"impeller_tip_speed", "u2 at the tip", "<tr><td>u2 at the tip</td><td class=\"q\">u<sub>2</sub></td>"},
                {"unheard_of", "", "<tr><td></td><td class=\"q\"></td>"}};
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
    char *text = NULL;
    size_t size = 0;
    FILE *page = open_memstream(&text, &size);
    cw_quantity_start(page, wanted[i].stem, wanted[i].name);
    fclose(page);
    assert_string_equal(text, wanted[i].row);
    free(text);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(quantities_have_their_units),
      cmocka_unit_test(a_row_starts_with_name_and_symbol),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
