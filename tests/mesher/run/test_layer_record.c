// SPDX-License-Identifier: AGPL-3.0-or-later
#include <string.h>

#include "mesher/run/layer_record.h"
#include "pipeline/log.h"
#include "tests/unit_test.h"

static CwLog *test_log;

#define PATCH(name, faces, met, gap, thin, thick, over, most, weights)                                                 \
  json_pack("{s:s, s:i, s:i, s:i, s:i, s:i, s:i, s:f, s:f, s:i, s:f}", "patch", name, "wall_faces", faces,             \
            "first_height_met_faces", met, "first_height_missed_by_gap_faces", gap, "thin_last_layer_faces", thin,     \
            "thick_last_layer_faces", thick, "volume_ratio_over_10_faces", over, "volume_ratio_95_percent",            \
            (double)(most), "volume_ratio_greatest", 2.0 * (most), "small_weight_faces", weights, "growth_ratio_most", \
            1.2)

static json_t *coverage, *headlines;

static int start(void **state) {
  coverage = json_array();
  headlines = json_array();
  return cw_log_open("mesh", NULL, 0, 0, &test_log) != CW_OK;
}

static int end(void **state) {
  json_decref(coverage);
  json_decref(headlines);
  cw_log_close(&test_log);
  return 0;
}

static void says(const char *text, const char *part) {
  if (!strstr(text, part)) fail_msg("'%s' is not in: %s", part, text);
}

static void even_layers_are_not_told_of(void **state) {
  json_array_append_new(coverage, PATCH("hub", 1000, 950, 50, 20, 30, 0, 3.9, 0));
  cw_warn_of_layers(test_log, "rotor", 5, 0, coverage, headlines);
  cw_warn_of_missed(test_log, "rotor", coverage, headlines);
  assert_int_equal(cw_log_warning_count(test_log), 0);
  assert_int_equal(json_array_size(headlines), 0);
}

// From 13.824 to 4 it is 3.456, which lies between 1.2^6 and 1.2^7.
static void thin_layers_need_more(void **state) {
  json_array_append_new(coverage, PATCH("hub", 1000, 1000, 0, 20, 0, 0, 3, 0));
  json_array_append_new(coverage, PATCH("shroud", 1000, 1000, 0, 81, 0, 7, 13.824, 4));
  cw_warn_of_layers(test_log, "rotor", 5, 0, coverage, headlines);
  assert_int_equal(json_array_size(headlines), 1);
  const char *told = json_string_value(json_array_get(headlines, 0));
  assert_string_equal(told, cw_log_warning(test_log, 0));
  says(told, "rotor: volumes change by more than 4");
  says(told, "within: shroud 13.8, greatest 27.6, 4 face weights below 0.05;");
  says(told, "walls.layer_count 12 instead of 5, or auto");
  assert_null(strstr(told, "hub"));
}

static void thick_layers_need_a_lower_y_plus(void **state) {
  json_array_append_new(coverage, PATCH("volute", 100, 100, 0, 1, 5, 0, 4.5, 0));
  cw_warn_of_layers(test_log, "stator", 5, 1, coverage, headlines);
  says(json_string_value(json_array_get(headlines, 0)), "thick: a lower walls.y_plus");
}

static void few_faces_are_no_headline(void **state) {
  json_array_append_new(coverage, PATCH("volute", 100, 100, 0, 1, 0, 1, 2, 0));
  cw_warn_of_layers(test_log, "stator", 5, 1, coverage, headlines);
  assert_int_equal(json_array_size(headlines), 0);
  assert_int_equal(cw_log_warning_count(test_log), 1);
  says(cw_log_warning(test_log, 0), "few faces");
}

static void first_heights_that_are_missed(void **state) {
  json_array_append_new(coverage, PATCH("hub", 100, 94, 6, 0, 0, 0, 2, 0));
  json_array_append_new(coverage, PATCH("tongue", 100, 20, 80, 0, 0, 0, 2, 0));
  cw_warn_of_missed(test_log, "stator", coverage, headlines);
  const char *told = json_string_value(json_array_get(headlines, 0));
  says(told, "stator: only 57 % of the wall faces");
  says(told, "tongue 20 % (gap)");
  assert_null(strstr(told, "hub"));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(even_layers_are_not_told_of, start, end),
      cmocka_unit_test_setup_teardown(thin_layers_need_more, start, end),
      cmocka_unit_test_setup_teardown(thick_layers_need_a_lower_y_plus, start, end),
      cmocka_unit_test_setup_teardown(few_faces_are_no_headline, start, end),
      cmocka_unit_test_setup_teardown(first_heights_that_are_missed, start, end),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
