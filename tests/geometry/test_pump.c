// SPDX-License-Identifier: AGPL-3.0-or-later
// The whole geometry of the paper's pump: both solids as the program builds and measures them.
#include <math.h>
#include <string.h>

#include "geometry/hydraulic_design.h"
#include "geometry/measure.h"
#include "geometry/pump.h"
#include "geometry/rotor.h"
#include "geometry/stator.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/unit_test.h"

static CwDesign design;
static CwSolid *rotor, *stator;

static int setup(void **state) {
  const CwCase table = paper();
  design = design_of(&table);
  return cw_rotor_build(&design, &rotor) || cw_stator_build(&design.volute, cw_solid_unit(rotor), &stator);
}

static int teardown(void **state) {
  cw_solid_free(&rotor);
  cw_solid_free(&stator);
  return 0;
}

// D3 = 204 mm, b3 = 12 mm, and one and the same cylinder r = 101 mm, |z| <= 4 mm on both sides.
static void stator_dimensions_and_interface(void **state) {
  CwMeasuredSolid solid;
  CwMeasuredStator s;
  CwMeasuredRotor r;
  assert_int_equal(cw_measure_solid(stator, &solid), CW_OK);
  assert_true(solid.valid && solid.closed && solid.largest_tolerance < 1e-6);
  assert_int_equal(cw_measure_stator(stator, &s), CW_OK);
  assert_int_equal(cw_measure_rotor(rotor, &r), CW_OK);
  assert_near(s.base_diameter, 0.204, 1e-6);
  assert_near(s.inlet_width, 0.012, 1e-6);
  assert_near(s.interface_radius, 0.101, 1e-9);
  assert_near(s.interface_area, 2 * M_PI * 0.101 * 0.008, 1e-10);
  assert_near(s.interface_area / r.interface_area, 1, 1e-9);
}

// The dimensions of the rotor cannot be read from a stator: one line says what is missing.
static void missing_patch_is_named(void **state) {
  CwMeasuredRotor r;
  assert_int_equal(cw_measure_rotor(stator, &r), CW_ERR_GEOMETRY);
  assert_non_null(strstr(cw_fail_message(), "inlet"));
  cw_fail_clear();
}

// A nose that ends in a flat as small as a pinhead, which six blades divide: the line names edge, face and key.
static void too_short_an_edge_is_named(void **state) {
  CwPump pump = {.count = 2, .solid = {rotor, stator}, .stubs = {design.suction_pipe_length, 0}};
  CwMeasuredPump measured;
  CwDesign small = design;
  CwSolid *with_small_flat = NULL;
  assert_int_equal(cw_pump_measure(&design, &pump, &measured), CW_OK);
  small.nut_disk_radius = 0.034e-3;
  assert_int_equal(cw_rotor_build(&small, &with_small_flat), CW_OK);
  pump.solid[0] = with_small_flat;
  assert_int_equal(cw_pump_measure(&small, &pump, &measured), CW_ERR_GEOMETRY);
  const char *message = cw_fail_message();
  if (!strstr(message, "rotor: the shortest edge, of hub_nut_") || !strstr(message, "0.0356 mm") ||
      !strstr(message, "raise hub_nut_flat_diameter_mm"))
    fail_msg("unexpected message: %s", message);
  cw_fail_clear();
  cw_solid_free(&with_small_flat);
}

// Root fillets and trailing edges are the wheel's: a sharp corner of the casing lies beside its tongue.
static void sharp_corners_have_the_keys_of_their_domain(void **state) {
  CwDesign with = design;
  with.root_fillet_radius = 1e-3;
  with.volute.input.tongue_gap = NAN;
  with.volute.input.tongue_angle = 30 * CW_DEGREE;
  assert_non_null(strstr(cw_pump_blunter_corner(&with, cw_solid_domain(rotor)), "root_fillet_radius_mm"));
  assert_non_null(strstr(cw_pump_blunter_corner(&with, cw_solid_domain(stator)), "tongue_angle_deg"));
  assert_null(strstr(cw_pump_blunter_corner(&with, cw_solid_domain(stator)), "fillet"));
}

// Nothing is to be left out that is not there, nothing taken that is in use.
static void advice_is_of_use(void **state) {
  CwDesign with = design;
  with.root_fillet_radius = 0;
  with.trailing_edge = CW_EDGE_BEVELLED;
  with.volute.input.tongue_gap = with.volute.input.tongue_angle = NAN;
  assert_null(strstr(cw_pump_blunter_corner(&with, "rotor"), "root_fillet_radius_mm"));
  assert_null(strstr(cw_pump_blunter_corner(&with, "rotor"), "bevelled"));
  assert_null(strstr(cw_pump_blunter_corner(&with, "stator"), "leave"));
  assert_string_equal(cw_pump_blunter_edge(&with), "take trailing_edge rounded");
  with.volute.input.tongue_gap = 5e-3;
  assert_string_equal(cw_pump_blunter_corner(&with, "stator"), "raise tongue_gap_mm, or leave it out");
  with.trailing_edge = CW_EDGE_BLUNT;
  assert_string_equal(cw_pump_blunter_corner(&with, "rotor"), "take trailing_edge bevelled");
  assert_string_equal(cw_pump_blunter_edge(&with), "take trailing_edge bevelled or rounded");
  with.root_fillet_radius = 1e-3;
  assert_non_null(strstr(cw_pump_blunter_corner(&with, "rotor"), "leave out root_fillet_radius_mm, or take"));
  with.trailing_edge = CW_EDGE_BEVELLED;
  assert_string_equal(cw_pump_blunter_corner(&with, "rotor"), "leave out root_fillet_radius_mm");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(stator_dimensions_and_interface),
      cmocka_unit_test(missing_patch_is_named),
      cmocka_unit_test(too_short_an_edge_is_named),
      cmocka_unit_test(sharp_corners_have_the_keys_of_their_domain),
      cmocka_unit_test(advice_is_of_use),
  };
  return cmocka_run_group_tests(tests, setup, teardown);
}
