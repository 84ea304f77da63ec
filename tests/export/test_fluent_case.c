// SPDX-License-Identifier: AGPL-3.0-or-later
// The table of zones that stands beside pump.msh, of a pump of four zones.
#include "export/fluent_case.h"

#include "tests/export/pump_by_hand.h"

static PumpByHand pump;

static char *written(void) {
  assert_int_equal(cw_fluent_case_write(in_test_folder("fluent"), &pump.table, &pump.assembly), CW_OK);
  return read_whole(in_test_folder("fluent/README.md"), NULL);
}

static void assert_line(const char *text, const char *line) {
  char whole[200];
  snprintf(whole, sizeof whole, "\n%s\n", line);
  if (count_of(text, whole) != 1) fail_msg("not once '%s' in:\n%s", line, text);
}

// Each zone and patch of the mesh has one row, but the lid, on which no face lies. Walls that move with their zone are
// at rest relative to it; 8 kg/s leave by the outlets.
static void each_zone_has_its_row(void **state) {
  static const char *const rows[] = {"| rotor | fluid | frame motion, 100 rad/s about +z through the origin |",
                                     "| chamber | fluid | frame motion, 100 rad/s about +z through the origin |",
                                     "| stator | fluid | at rest |",
                                     "| suction | fluid | at rest |",
                                     "| hub | wall | at rest relative to its cell zone |",
                                     "| blade | wall | at rest relative to its cell zone |",
                                     "| ring | wall | speed 0, absolute |",
                                     "| rotor_in | interface | see below |",
                                     "| rotor_out | interface | see below |",
                                     "| rotor_gap | interface | see below |",
                                     "| rotor_leak | interface | see below |",
                                     "| disc | wall | at rest relative to its cell zone |",
                                     "| chamber_gap | interface | see below |",
                                     "| stator_in | interface | see below |",
                                     "| stator_leak | interface | see below |",
                                     "| volute | wall | at rest relative to its cell zone |",
                                     "| tongue | wall | at rest relative to its cell zone |",
                                     "| outlet | pressure-outlet | target mass flow rate 6 kg/s |",
                                     "| drain | pressure-outlet | target mass flow rate 2 kg/s |",
                                     "| middle | symmetry | |",
                                     "| suction_out | interface | see below |",
                                     "| pipe | wall | at rest relative to its cell zone |",
                                     "| shaft_wall | wall | turns at 100 rad/s about +z, absolute |",
                                     "| inlet | pressure-inlet | total pressure 90000 Pa, absolute frame |",
                                     "| feed | pressure-inlet | total pressure 90000 Pa, absolute frame |"};
  enum { ROWS = sizeof rows / sizeof *rows };
  pump_by_hand(&pump);
  char *text = written();
  for (int i = 0; i < ROWS; ++i) assert_line(text, rows[i]);
  assert_int_equal(ROWS, ZONES + PATCHES - 1);
  assert_int_equal(count_of(text, "\n| "), ROWS + 1); // and the head of the table
  free(text);
}

static void each_interface_is_created(void **state) {
  pump_by_hand(&pump);
  char *text = written();
  assert_line(text, "    /define/mesh-interfaces/create interface_1 suction_out () rotor_in ()");
  assert_line(text, "    /define/mesh-interfaces/create interface_2 rotor_out () stator_in ()");
  assert_line(text, "    /define/mesh-interfaces/create interface_3 rotor_gap () chamber_gap ()");
  assert_line(text, "    /define/mesh-interfaces/create interface_4 rotor_leak () stator_leak ()");
  assert_int_equal(count_of(text, "mesh-interfaces/create"), INTERFACES);
  free(text);
}

// The model follows from the layers, the roughness from the case where its walls are rough; 800 kg/m3 times 2e-6 m2/s.
static void the_set_up_follows_from_the_case(void **state) {
  static const struct {
    double y_plus;
    const char *model;
  } models[] = {{30, "standard k-epsilon"}, {1, "k-omega SST"}, {NAN, "none, the flow is laminar"}};
  char words[100];
  for (int m = 0; m < 3; ++m)
    for (int rough = 0; rough < 2; ++rough) {
      pump_by_hand(&pump);
      pump_by_hand_y_plus(&pump, models[m].y_plus);
      pump.table.walls =
          (CwWalls){.treatment = rough ? CW_WALL_FUNCTION_ROUGH : CW_WALL_FUNCTION_SMOOTH, .roughness = 40e-6};
      char *text = written();
      snprintf(words, sizeof words, "- Turbulence: %s. Roughness height of the walls: %s m.", models[m].model,
               rough ? "4e-05" : "0");
      assert_line(text, words);
      assert_non_null(strstr(text, "density 800 kg/m3, dynamic viscosity 0.0016 kg/(m s)"));
      free(text);
    }
}

static void a_folder_that_cannot_be_is_told(void **state) {
  pump_by_hand(&pump);
  write_text(in_test_folder("file"), "");
  assert_int_equal(cw_fluent_case_write(in_test_folder("file/fluent"), &pump.table, &pump.assembly), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "file/fluent"));
  cw_fail_clear();
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_zone_has_its_row),
      cmocka_unit_test(each_interface_is_created),
      cmocka_unit_test(the_set_up_follows_from_the_case),
      cmocka_unit_test(a_folder_that_cannot_be_is_told),
  };
  return cmocka_run_group_tests(tests, make_test_folder, clear_test_folder);
}
