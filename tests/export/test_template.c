// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/template.h"

#include <stdlib.h>
#include <string.h>

#include "tests/unit_test.h"

static void keys_are_replaced_and_other_signs_stay(void **state) {
  CwValues values = {0};
  char *text = NULL;
  assert_int_equal(cw_values_set(&values, "speed", "%.1f", 1.5), CW_OK);
  assert_int_equal(cw_values_set(&values, "a_b", "x"), CW_OK);
  assert_int_equal(cw_template_fill("t", "@speed@ m/s, f()@inlet, @@ @a_b@@speed@ @", &values, &text), CW_OK);
  assert_string_equal(text, "1.5 m/s, f()@inlet, @@ x1.5 @");
  free(text);
  cw_values_free(&values);
}

static void a_key_without_value_is_told(void **state) {
  CwValues values = {0};
  char *text = NULL;
  assert_int_equal(cw_template_fill("system/x", "a @speed@", &values, &text), CW_ERR_EXPORT);
  assert_non_null(strstr(cw_fail_message(), "system/x: no value for @speed@"));
  assert_null(text);
}

static void texts_are_appended(void **state) {
  CwValues values = {0};
  assert_int_equal(cw_values_start(&values, "list"), CW_OK);
  assert_int_equal(cw_values_append(&values, "list", "%d", 1), CW_OK);
  assert_int_equal(cw_values_set(&values, "end", "rotor"), CW_OK);
  assert_int_equal(cw_values_append(&values, "list", ", %s", cw_values_get(&values, "list")), CW_OK);
  assert_string_equal(cw_values_get(&values, "list"), "1, 1");
  assert_int_equal(cw_values_start(&values, "list"), CW_OK);
  assert_int_equal(cw_values_append_file(&values, "list", "cfx_parts/symmetry.ccl"), CW_OK);
  assert_memory_equal(cw_values_get(&values, "list"), "    BOUNDARY: rotor\n", 20); // without the licence
  assert_int_equal(cw_values_append_file(&values, "list", "cfx_parts/none.ccl"), CW_ERR_EXPORT);
  assert_null(cw_values_get(&values, "lis"));
  cw_values_free(&values);
}

static void the_scripts_are_built_in_and_executable(void **state) {
  int scripts = 0;
  for (int i = 0; i < cw_template_count; ++i)
    if (cw_templates[i].executable) {
      ++scripts;
      assert_memory_equal(cw_templates[i].text, "#!", 2);
    }
  assert_int_equal(scripts, 6); // Allrun of the three cases, Allclean, summary, run of code_saturne
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(keys_are_replaced_and_other_signs_stay),
      cmocka_unit_test(a_key_without_value_is_told),
      cmocka_unit_test(texts_are_appended),
      cmocka_unit_test(the_scripts_are_built_in_and_executable),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
