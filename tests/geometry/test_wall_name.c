// SPDX-License-Identifier: AGPL-3.0-or-later
// Names of walls: those that the program gives, and others.

#include "geometry/wall_name.h"
#include "tests/unit_test.h"

static void names_that_the_program_gives(void **state) {
  assert_int_equal(cw_wall_name("blade_trailing_edge")->along, CW_ALONG_TRAILING_EDGE);
  assert_int_equal(cw_wall_name("blade_pressure")->along, CW_ALONG_BLADE);
  assert_int_equal(cw_wall_name("hub_nut")->group, CW_GROUP_HUB_SHROUD);
  assert_int_equal(cw_wall_name("hub_nut")->turns, -1);
  assert_int_equal(cw_wall_name("hub_shaft_pipe")->turns, 1);
  assert_int_equal(cw_wall_name("shroud")->group, CW_GROUP_HUB_SHROUD);
}

static void what_stands_still_and_what_is_monitored(void **state) {
  assert_int_equal(cw_wall_name("suction_pipe")->turns, 0);
  assert_int_equal(cw_wall_name("tongue")->monitored, 1);
  assert_int_equal(cw_wall_name("volute")->monitored, 0);
  assert_int_equal(cw_wall_name("neck")->size, CW_GROUP_INTERFACE);
}

static void other_names_say_nothing(void **state) {
  assert_null(cw_wall_name("casing"));
  assert_null(cw_wall_name("volute_2"));
  assert_null(cw_wall_name("hu"));
  assert_null(cw_wall_name("hub_seal_pipe"));
  assert_null(cw_wall_name("blade_of_guide"));
  assert_null(cw_wall_name("shroud_2"));
  assert_null(cw_wall_name(""));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(names_that_the_program_gives),
                                     cmocka_unit_test(what_stands_still_and_what_is_monitored),
                                     cmocka_unit_test(other_names_say_nothing)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
