// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <string.h>

#include "geometry/remedy.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/unit_test.h"

static const double degree = M_PI / 180;

static CwCase given(void) {
  CwCase table = duty_point(25, 10, 1450);
  table.impeller.wrap_angle = 30 * degree;
  table.impeller.outlet_width = 0.008;
  table.impeller.blade_count = 11;
  return table;
}

static int trials;

// What the design makes of open keys: a wrap of 130 degrees, 7 blades, 12 mm.
static void open_values(const CwCase *table, CwDesign *design) {
  const double wrap = table->impeller.wrap_angle;
  *design =
      (CwDesign){.wrap_angle = cw_case_given(wrap) ? wrap : 130 * degree, .blade_count = 7, .outlet_width = 0.012};
}

static CwStatus wants_wrap(const CwCase *table, CwDesign *design) {
  trials++;
  open_values(table, design);
  return table->impeller.wrap_angle < 70 * degree ? CW_FAIL(CW_ERR_DESIGN, "a wrap too small") : CW_OK;
}

static CwStatus wants_wrap_and_few_blades(const CwCase *table, CwDesign *design) {
  if (table->impeller.blade_count > 9) return CW_FAIL(CW_ERR_DESIGN, "too many blades");
  return wants_wrap(table, design);
}

// Any wrap up to 100 degrees gives way to that.
static CwStatus gives_way(const CwCase *table, CwDesign *design) {
  const double wrap = table->impeller.wrap_angle;
  if (wants_wrap(table, design) != CW_OK) return CW_ERR_DESIGN;
  if (wrap < 100 * degree) design->wrap_angle = 100 * degree;
  return CW_OK;
}

static CwStatus wants_no_blades(const CwCase *table, CwDesign *design) {
  trials++;
  open_values(table, design);
  return CW_FAIL(CW_ERR_DESIGN, "never: %d blades", table->impeller.blade_count);
}

// From 30 to 130 degrees: 40 and 55 fail, 80 is the first that works.
static void one_key_with_its_value(void **state) {
  const CwCase table = given();
  char text[200];
  trials = 0;
  assert_true(cw_remedy_find(&table, "wrap_angle_deg is bad", wants_wrap, text, sizeof text));
  assert_string_equal(text, "impeller.wrap_angle_deg: 80 works");
  assert_int_equal(trials, 4); // the key that the message names comes first
  assert_string_equal(cw_fail_message(), "");
}

// 80 degrees would be built with 100: 105 are the first that are taken as they are.
static void no_value_that_gives_way(void **state) {
  const CwCase table = given();
  char text[200];
  assert_true(cw_remedy_find(&table, "wrap_angle_deg is bad", gives_way, text, sizeof text));
  assert_string_equal(text, "impeller.wrap_angle_deg: 105 works");
}

static void several_keys_and_no_more_than_needed(void **state) {
  const CwCase table = given();
  char text[200];
  assert_true(cw_remedy_find(&table, "", wants_wrap_and_few_blades, text, sizeof text));
  assert_string_equal(text, "it works without impeller.blade_count (then 7) and impeller.wrap_angle_deg (then 130)");
}

static void nothing_helps(void **state) {
  const CwCase table = given();
  char text[200];
  trials = 0;
  assert_false(cw_remedy_find(&table, "", wants_no_blades, text, sizeof text));
  assert_true(trials <= 60);
}

// A duty alone, of which the design makes D2 = 200, b3 = 20, D1 = 80 mm and 7 blades. What a test wants of it:
static struct {
  double largest_d2, least_b3, largest_speed; // SI
  int blades;                                 // 0: any
} wanted;
static double head_residual_of_given_d2;

static CwStatus wants(const CwCase *table, CwDesign *design) {
  const double d2 = table->impeller.outlet_diameter, b3 = table->volute.inlet_width,
               d1 = table->impeller.inlet_diameter;
  const int blades = table->impeller.blade_count;
  trials++;
  *design = (CwDesign){.head = 10,
                       .blade_count = blades ? blades : 7,
                       .outlet_diameter = cw_case_given(d2) ? d2 : 0.2,
                       .inlet_diameter = cw_case_given(d1) ? d1 : 0.08,
                       .inlet_width = cw_case_given(b3) ? b3 : 0.02};
  if (cw_case_given(d2)) design->head_residual = head_residual_of_given_d2;
  const int fine = design->outlet_diameter <= wanted.largest_d2 && design->inlet_width >= wanted.least_b3 &&
                   table->operating_point.speed <= wanted.largest_speed &&
                   (!wanted.blades || design->blade_count == wanted.blades);
  return fine ? CW_OK : CW_FAIL(CW_ERR_DESIGN, "not so");
}

static void duty_remedy(const char *message, const char *expected) {
  const CwCase table = duty_point(25, 10, 1450);
  char text[200] = "";
  trials = 0;
  assert_int_equal(cw_remedy_find(&table, message, wants, text, sizeof text), expected != NULL);
  if (expected) assert_string_equal(text, expected);
  assert_true(trials <= 60);
  assert_string_equal(cw_fail_message(), "");
}

// The least step of a key that the case leaves open: a D2 of 190 mm before a b3 of 22 mm, which is told apart from the
// volute's key of the same name; 7 blades become 8. A value that gives up the head is none.
static void open_keys_of_a_duty_alone(void **state) {
  const double any = 1e9;
  head_residual_of_given_d2 = 0;
  wanted.largest_d2 = 0.195;
  wanted.largest_speed = any;
  duty_remedy("change outlet_diameter_mm", "impeller.outlet_diameter_mm: 190 works");
  wanted.largest_d2 = any;
  wanted.least_b3 = 0.0215;
  duty_remedy("", "volute.inlet_width_mm: 22 works");
  wanted.least_b3 = 0;
  wanted.blades = 8;
  duty_remedy("", "impeller.blade_count: 8 works");
  wanted.blades = 0;
  wanted.largest_d2 = 0.195;
  head_residual_of_given_d2 = -1;
  duty_remedy("", NULL);
}

// The speed is the user's, and changed where nothing else helps.
static void speed_comes_last(void **state) {
  wanted.largest_d2 = 1e9;
  wanted.largest_speed = 0.85 * 1450 * M_PI / 30;
  duty_remedy("speed_rpm is bad", "operating_point.speed_rpm: 1160 works");
  wanted.largest_speed = 0;
  duty_remedy("", NULL);
}

static CwStatus wants_little_lean_and_gap(const CwCase *table, CwDesign *design) {
  const double gap = table->volute.tongue_gap;
  *design = (CwDesign){.base_diameter = 0.2,
                       .tongue_tip_radius = 0.1 + (cw_case_given(gap) ? gap : 0.004),
                       .lean_angle = table->impeller.lean_angle};
  return design->lean_angle > 11 * degree || design->tongue_tip_radius > 0.11 ? CW_FAIL(CW_ERR_DESIGN, "no") : CW_OK;
}

// From a lean of 20 degrees to the default of 0, and from a gap of 24 mm to the 4 mm that the design has without it.
static void keys_with_a_default_and_the_tongue(void **state) {
  CwCase table = duty_point(25, 10, 1450);
  char text[200];
  table.impeller.lean_angle = 20 * degree;
  assert_true(cw_remedy_find(&table, "", wants_little_lean_and_gap, text, sizeof text));
  assert_string_equal(text, "impeller.lean_deg: 10 works");
  table.volute.tongue_gap = 0.024;
  assert_true(cw_remedy_find(&table, "", wants_little_lean_and_gap, text, sizeof text));
  assert_string_equal(text, "it works without impeller.lean_deg (then 0) and volute.tongue_gap_mm (then 4)");
  table.impeller.lean_angle = 0;
  assert_true(cw_remedy_find(&table, "", wants_little_lean_and_gap, text, sizeof text));
  assert_string_equal(text, "volute.tongue_gap_mm: 9 works");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_key_with_its_value),
      cmocka_unit_test(no_value_that_gives_way),
      cmocka_unit_test(several_keys_and_no_more_than_needed),
      cmocka_unit_test(nothing_helps),
      cmocka_unit_test(open_keys_of_a_duty_alone),
      cmocka_unit_test(speed_comes_last),
      cmocka_unit_test(keys_with_a_default_and_the_tongue),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
