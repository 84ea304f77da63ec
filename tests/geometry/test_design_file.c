// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <unistd.h>

#include <jansson.h>

#include "geometry/design_file.h"
#include "geometry/hydraulic_design.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

static double number(const json_t *root, const char *key) {
  const json_t *value = json_object_get(root, key);
  if (!json_is_number(value)) fail_msg("no number %s", key);
  return json_number_value(value);
}

// The keys that other stages read, with their units.
static void keys_of_the_format(void **state) {
  static const char *const keys[] = {"impeller_tip_speed_m_per_s", "relative_speed_m_per_s",  "volute_speed_m_per_s",
                                     "suction_speed_m_per_s",      "discharge_speed_m_per_s", "interface_radius_m",
                                     "predicted_head_m",           "rotor_volume_m3",         "stator_volume_m3"};
  const CwCase table = paper();
  const CwDesign design = design_of(&table);
  CwMeasuredPump measured = {.solid = {{.volume = 5e-4}, {.volume = 7e-4}}, .rotor.wrap_angle = 71 * M_PI / 180};
  assert_int_equal(cw_design_file_write(&design, &measured, in_test_folder("design.json")), CW_OK);
  json_error_t error;
  json_t *root = json_load_file(in_test_folder("design.json"), 0, &error);
  unlink(in_test_folder("design.json"));
  assert_non_null(root);
  for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) assert_true(number(root, keys[i]) > 0);
  assert_true(fabs(number(root, "wrap_angle_deg") - 71) < 1e-9);
  assert_true(fabs(number(root, "outlet_diameter_m") - 0.2) < 1e-12);
  assert_true(number(root, "rotor_volume_m3") == 5e-4);
  assert_true(fabs(number(json_object_get(root, "measured"), "wrap_angle_deg") - 71) < 1e-9);
  // The area of the paper's volute half way round, and its growth.
  const json_t *sections = json_object_get(root, "volute_sections");
  assert_int_equal(json_array_size(sections), 8);
  assert_true(fabs(number(json_array_get(sections, 3), "angle_deg") - 180) < 1e-12);
  assert_true(fabs(number(json_array_get(sections, 3), "area_m2") - 425e-6) < 1e-6);
  for (size_t i = 1; i < 8; i++)
    assert_true(number(json_array_get(sections, i), "outer_radius_m") >
                number(json_array_get(sections, i - 1), "outer_radius_m"));
  // Every number of the design says where it comes from.
  const json_t *sources = json_object_get(root, "sources");
  assert_int_equal(json_object_size(sources), CW_DESIGN_COUNT + 1); // and blade_count
  assert_string_equal(json_string_value(json_object_get(sources, "outlet_diameter_m")), "case");
  const json_t *names = json_object_get(root, "names");
  assert_int_equal(json_object_size(names), CW_DESIGN_COUNT);
  assert_string_equal(json_string_value(json_object_get(names, "outlet_diameter_m")), "impeller outlet D2");
  // Six triangles; both families for each correlated quantity (Guan's D2 is 178 mm); a remark on the head.
  assert_int_equal(json_array_size(json_object_get(root, "velocity_triangles")), 2 * CW_TRIANGLE_SPANS);
  const json_t *d2 = json_object_get(json_object_get(root, "correlations"), "outlet_diameter_m");
  assert_true(fabs(number(d2, "used") - 0.2) < 1e-12);
  assert_true(fabs(number(json_object_get(d2, "guan"), "value") - 0.178) < 5e-4);
  assert_true(fabs(number(json_object_get(d2, "guelich"), "value") - 0.1822) < 1e-4);
  assert_true(json_array_size(json_object_get(root, "remarks")) >= 3);
  json_decref(root);
}

// One splitter a blade, or none.
static void splitters_are_counted(void **state) {
  const CwCase table = paper();
  CwMeasuredPump measured = {.solid = {{.volume = 5e-4}, {.volume = 7e-4}}};
  for (int splitters = 0; splitters < 2; splitters++) {
    CwDesign design = design_of(&table);
    if (splitters) design.splitter_start = 0.4;
    assert_int_equal(cw_design_file_write(&design, &measured, in_test_folder("design.json")), CW_OK);
    json_error_t error;
    json_t *root = json_load_file(in_test_folder("design.json"), 0, &error);
    unlink(in_test_folder("design.json"));
    assert_non_null(root);
    assert_true(number(root, "blade_count") == 6);
    assert_true(number(root, "splitter_count") == 6 * splitters);
    json_decref(root);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(keys_of_the_format), cmocka_unit_test(splitters_are_counted)};
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
