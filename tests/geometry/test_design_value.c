// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/design_value.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "tests/draw.h"
#include "tests/unit_test.h"

#define OFFSET(member, kind, text) offsetof(CwDesign, member),
static const size_t offsets[] = {CW_DESIGN_LIST(OFFSET)};
#undef OFFSET

static double *member_of(CwDesign *design, int quantity) {
  return (double *)(void *)((char *)design + offsets[quantity]);
}

// One of each kind, in SI and as it is shown and stored: 0.2 m, 15 m, pi / 6, 3 m/s, 0.01 m3/s = 36 m3/h, 50 pi rad/s =
// 1500 rpm, 9e-4 m2, 0.95 m2/s, 2200 W, 2340 Pa.
static void each_kind_by_hand(void **state) {
  static const struct {
    CwDesignQuantity quantity;
    double si;
    const char *key;
    double stored;
    const char *unit;
    double shown;
  } wanted[] = {{CW_DESIGN_overlap, 1.2, "overlap", 1.2, "", 1.2},
                {CW_DESIGN_outlet_diameter, 0.2, "outlet_diameter_m", 0.2, "mm", 200},
                {CW_DESIGN_theoretical_head, 15, "theoretical_head_m", 15, "m", 15},
                {CW_DESIGN_wrap_angle, M_PI / 6, "wrap_angle_deg", 30, "deg", 30},
                {CW_DESIGN_throat_speed, 3, "throat_speed_m_per_s", 3, "m/s", 3},
                {CW_DESIGN_flow_rate, 0.01, "flow_rate_m3_per_s", 0.01, "m3/h", 36},
                {CW_DESIGN_angular_speed, 50 * M_PI, "angular_speed_rad_per_s", 50 * M_PI, "rpm", 1500},
                {CW_DESIGN_throat_area, 9e-4, "throat_area_m2", 9e-4, "mm2", 900},
                {CW_DESIGN_swirl_constant, 0.95, "swirl_constant_m2_per_s", 0.95, "m2/s", 0.95},
                {CW_DESIGN_shaft_power, 2200, "shaft_power_w", 2200, "kW", 2.2},
                {CW_DESIGN_vapour_pressure, 2340, "vapour_pressure_pa", 2340, "Pa", 2340}};
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
    CwDesign *design = calloc(1, sizeof *design);
    *member_of(design, wanted[i].quantity) = wanted[i].si;
    design->asked[wanted[i].quantity] = 2 * wanted[i].si;
    const CwDesignValue value = cw_hydraulic_design_value(design, wanted[i].quantity);
    assert_string_equal(value.key, wanted[i].key);
    assert_string_equal(value.unit, wanted[i].unit);
    assert_near(value.stored / wanted[i].stored, 1, 1e-15);
    assert_near(value.shown / wanted[i].shown, 1, 1e-15);
    assert_near(value.asked / wanted[i].shown, 2, 1e-15);
    free(design);
  }
}

// Of every quantity both numbers say the same in the units that stand beside them; each has a key and a text of its
// own.
static void every_quantity_says_its_number_twice(void **state) {
  static const struct {
    const char *text;
    double si;
  } units[] = {{"", 1},     {"mm", 1e-3},         {"m", 1},           {"deg", M_PI / 180},
               {"m/s", 1},  {"m3/h", 1.0 / 3600}, {"rpm", M_PI / 30}, {"mm2", 1e-6},
               {"m2/s", 1}, {"kW", 1e3},          {"Pa", 1}};
  CwDesign *design = calloc(1, sizeof *design);
  CwDesignValue value[CW_DESIGN_COUNT];
  uint64_t seed = 44;
  for (int i = 0; i < CW_DESIGN_COUNT; i++) {
    *member_of(design, i) = 1 + draw(&seed);
    design->asked[i] = i % 2 ? NAN : draw(&seed);
  }
  for (int i = 0; i < CW_DESIGN_COUNT; i++) {
    const double si = *member_of(design, i);
    size_t unit = 0;
    value[i] = cw_hydraulic_design_value(design, (CwDesignQuantity)i);
    while (unit < sizeof units / sizeof *units && strcmp(units[unit].text, value[i].unit)) unit++;
    assert_true(unit < sizeof units / sizeof *units);
    assert_near(value[i].shown * units[unit].si, si, 1e-14);
    const size_t length = strlen(value[i].key);
    const int degrees = length > 4 && !strcmp(value[i].key + length - 4, "_deg");
    assert_near(value[i].stored * (degrees ? M_PI / 180 : 1), si, 1e-14);
    assert_int_equal(degrees, !strcmp(value[i].unit, "deg"));
    if (i % 2)
      assert_true(isnan(value[i].asked));
    else
      assert_near(value[i].asked * units[unit].si, design->asked[i], 1e-14);
    for (int j = 0; j < i; j++) {
      assert_string_not_equal(value[i].key, value[j].key);
      assert_string_not_equal(value[i].text, value[j].text);
    }
  }
  free(design);
}

static void a_row_is_in_columns(void **state) {
  CwDesign *design = calloc(1, sizeof *design);
  char line[200];
  design->outlet_diameter = 0.2051234;
  design->source[CW_DESIGN_outlet_diameter] = "case";
  cw_hydraulic_design_row(design, CW_DESIGN_outlet_diameter, line, sizeof line);
  assert_string_equal(line, "impeller outlet D2                                       205.12 mm    case");
  cw_hydraulic_design_row(design, CW_DESIGN_outlet_diameter, line, 9);
  assert_string_equal(line, "impeller");
  free(design);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_kind_by_hand),
      cmocka_unit_test(every_quantity_says_its_number_twice),
      cmocka_unit_test(a_row_is_in_columns),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
