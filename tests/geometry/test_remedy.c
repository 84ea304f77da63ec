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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_key_with_its_value),
      cmocka_unit_test(no_value_that_gives_way),
      cmocka_unit_test(several_keys_and_no_more_than_needed),
      cmocka_unit_test(nothing_helps),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
