// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/case_schema.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/draw.h"
#include "tests/unit_test.h"

static const CwCaseKey *key_of(const char *section, const char *key) {
  const int index = cw_case_key_find(section, key);
  if (index < 0) fail_msg("no key %s in '%s'", key, section);
  return &cw_case_keys[index];
}

// A value that the key may have.
static double draw_value(const CwCaseKey *key, uint64_t *seed) {
  int choices = 0;
  while (key->choices && key->choices[choices]) choices++;
  if (key->type == CW_KEY_CHOICE) return draw_below(seed, choices);
  if (key->type == CW_KEY_CHOICES) return draw_below(seed, 1 << choices);
  const double value = key->least + draw(seed) * (key->most - key->least);
  return key->type == CW_KEY_REAL ? value : rint(value);
}

// What is set is what comes back, and no other key has changed.
static void each_key_has_a_field_of_its_own(void **state) {
  CwCase table;
  uint64_t seed = 81;
  double *wanted = calloc(cw_case_key_count, sizeof *wanted);
  cw_case_defaults(&table);
  for (size_t i = 0; i < cw_case_key_count; i++) wanted[i] = cw_case_key_value(&cw_case_keys[i], &table);
  for (int round = 0; round < 3000; round++) {
    const size_t set = (size_t)draw_below(&seed, (int)cw_case_key_count);
    const CwCaseKey *changed = &cw_case_keys[set];
    if (changed->type == CW_KEY_NAME || changed->type == CW_KEY_LIST) continue;
    wanted[set] = draw_value(changed, &seed);
    cw_case_key_set(changed, wanted[set], &table);
    for (size_t i = 0; i < cw_case_key_count; i++) {
      const double value = cw_case_key_value(&cw_case_keys[i], &table);
      if (isnan(wanted[i]))
        assert_true(isnan(value));
      else
        assert_near(value, wanted[i], cw_case_keys[i].type == CW_KEY_REAL ? 1e-14 * fabs(wanted[i]) : 0);
    }
  }
  free(wanted);
}

// 74 mm are the double next to 0.074 m; 1 in is 25.4 mm.
static void fields_are_in_si(void **state) {
  CwCase table = {0};
  const CwUnit *unit;
  cw_case_key_set(key_of("impeller", "inlet_diameter_mm"), 74, &table);
  assert_true(table.impeller.inlet_diameter == 0.074);
  cw_case_key_set(key_of("operating_point", "speed_rpm"), 30, &table);
  assert_near(table.operating_point.speed, M_PI, 1e-15);
  const int index = cw_case_key_find_in("impeller", "inlet_diameter_in", &unit);
  cw_case_key_set_in(&cw_case_keys[index], unit, 10, &table);
  assert_near(table.impeller.inlet_diameter, 0.254, 1e-16);
  assert_near(cw_case_key_value(&cw_case_keys[index], &table), 254, 1e-12); // in its own unit
}

static void a_list_has_room_for_so_many(void **state) {
  CwCase table = {0};
  const CwCaseKey *key = key_of("operating_points", "flow_rates_m3_per_h");
  for (int i = 1; i <= CW_LIST_MOST + 3; i++) cw_case_key_set(key, 3600 * i, &table);
  assert_int_equal(table.operating_points.flow_rates.count, CW_LIST_MOST);
  for (int i = 0; i < CW_LIST_MOST; i++) assert_near(table.operating_points.flow_rates.value[i], i + 1, 1e-15);
  assert_true(isnan(cw_case_key_value(key, &table)));
}

static void keys_are_found_in_units_of_their_quantity(void **state) {
  static const struct {
    const char *section, *key, *found, *unit;
  } wanted[] = {{"impeller", "outlet_diameter_mm", "outlet_diameter_mm", "mm"},
                {"impeller", "outlet_diameter_in", "outlet_diameter_mm", "in"},
                {"impeller", "blade_count", "blade_count", NULL},
                {"operating_point", "head_ft", "head_m", "ft"},
                {"operating_point", "head_FT", NULL, NULL},
                {"operating_point", "head_deg", NULL, NULL},     // an angle
                {"operating_point", "head_rated_m", NULL, NULL}, // a longer name, a shorter one
                {"operating_point", "hea_m", NULL, NULL},
                {"mesh", "head_m", NULL, NULL}, // of another section
                {"impeller", "outlet_diameter", NULL, NULL}};
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
    const CwUnit *unit;
    const int index = cw_case_key_find_in(wanted[i].section, wanted[i].key, &unit);
    if (!wanted[i].found) {
      assert_int_equal(index, -1);
      continue;
    }
    assert_string_equal(cw_case_keys[index].key, wanted[i].found);
    assert_true(unit == (wanted[i].unit ? cw_unit_find(wanted[i].unit) : NULL));
  }
  assert_true(cw_case_section_known("impeller") && cw_case_section_known(""));
  assert_false(cw_case_section_known("impellers"));
}

static void texts_by_hand(void **state) {
  static const char *const one[] = {"a", NULL}, *const two[] = {"a", "b", NULL}, *const three[] = {"a", "b", "c", NULL};
  static const struct {
    const char *section, *key, *path, *allowed;
  } wanted[] = {
      {"", "name", "name", "1 to 32 letters, digits, _ and -, a letter first"},
      {"impeller", "outlet_diameter_mm", "impeller.outlet_diameter_mm", "10 to 10000 mm"},
      {"impeller", "blade_count", "impeller.blade_count", "a whole number from 2 to 12"},
      {"impeller", "priority", "impeller.priority", "wrap, head, beta or auto"},
      {"walls", "layer_count", "walls.layer_count", "a whole number from 1 to 40, or auto"},
      {"operating_points", "flow_shares", "operating_points.flow_shares",
       "a list [..., ...] of 1 to 12 ascending values, each 0.01 to 3"},
      {"export", "formats", "export.formats", "a list of one or more of cgns, openfoam, cfx, fluent or code_saturne"}};
  char text[CW_KEY_ALLOWED_SIZE], path[CW_KEY_PATH_SIZE];
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
    const CwCaseKey *key = key_of(wanted[i].section, wanted[i].key);
    cw_case_key_allowed(key, text);
    assert_string_equal(text, wanted[i].allowed);
    cw_case_key_path(key, path);
    assert_string_equal(path, wanted[i].path);
  }
  cw_case_words(one, text, sizeof text);
  assert_string_equal(text, "a");
  cw_case_words(two, text, sizeof text);
  assert_string_equal(text, "a or b");
  cw_case_words(three, text, sizeof text);
  assert_string_equal(text, "a, b or c");
  cw_case_words(three, text, 4);
  assert_string_equal(text, "a, ");
  cw_case_key_chosen(key_of("impeller", "priority"), CW_PRIORITY_HEAD, text);
  assert_string_equal(text, "head");
  assert_string_equal(cw_case_choice("impeller", "priority", CW_PRIORITY_HEAD), "head");
  cw_case_key_chosen(key_of("export", "formats"), 1 << CW_FORMAT_CGNS | 1 << CW_FORMAT_FLUENT, text);
  assert_string_equal(text, "[cgns, fluent]");
  cw_case_key_chosen(key_of("export", "formats"), 0, text);
  assert_string_equal(text, "[]");
}

// No text of any key fills its room: none is cut.
static void no_text_is_cut(void **state) {
  for (size_t i = 0; i < cw_case_key_count; i++) {
    const CwCaseKey *key = &cw_case_keys[i];
    char allowed[CW_KEY_ALLOWED_SIZE], path[CW_KEY_PATH_SIZE];
    cw_case_key_allowed(key, allowed);
    cw_case_key_path(key, path);
    assert_true(strlen(allowed) < sizeof allowed - 1 && strlen(path) < sizeof path - 1);
    if (key->type != CW_KEY_CHOICES) continue;
    cw_case_key_chosen(key, INT32_MAX, allowed); // all
    assert_true(strlen(allowed) < sizeof allowed - 1);
  }
}

// The design follows from the duty, the fluid and the wheel; not from walls, mesh, the curve or what solvers take.
static void what_shapes_the_pump_is_known(void **state) {
  static const struct {
    const char *section, *key;
    int shapes;
  } wanted[] = {{"operating_point", "head_m", 1},
                {"operating_point", "time_step_deg", 0},
                {"operating_point", "test_head_m", 0},
                {"operating_points", "flow_shares", 0},
                {"fluid", "density_kg_per_m3", 1},
                {"impeller", "blade_count", 1},
                {"volute", "tongue_radius_mm", 1},
                {"walls", "layer_count", 0},
                {"mesh", "cells", 0},
                {"openfoam", "labels", 0}};
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++)
    assert_int_equal(cw_case_key_shapes_pump(key_of(wanted[i].section, wanted[i].key)), wanted[i].shapes);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_key_has_a_field_of_its_own),
      cmocka_unit_test(fields_are_in_si),
      cmocka_unit_test(a_list_has_room_for_so_many),
      cmocka_unit_test(keys_are_found_in_units_of_their_quantity),
      cmocka_unit_test(texts_by_hand),
      cmocka_unit_test(no_text_is_cut),
      cmocka_unit_test(what_shapes_the_pump_is_known),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
