// SPDX-License-Identifier: AGPL-3.0-or-later
// Root fillets, and a shaft through the inlet.
// Modules without a test of their own that it runs: root_fillet.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/measure.h"
#include "geometry/rotor.h"
#include "pipeline/case.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/unit_test.h"

static const double degree = M_PI / 180;

static int count(const CwSolid *solid, const char *patch, const char *part) {
  int found = 0;
  for (int face = 0; face < cw_solid_face_count(solid); face++)
    found += (!patch || !strcmp(cw_solid_face_patch(solid, face), patch)) &&
             strstr(cw_solid_face_name(solid, face), part) != NULL;
  return found;
}

// A fillet of radius R in a right angle has (1 - pi/4) R^2 of section. The paper's blades stand at nearly right
// angles, some 92 mm of foot on each side of six blades on two walls; near the trailing edge the fillet is
// narrower.
static void fillets_take_their_volume(void **state) {
  CwCase table = paper();
  CwMeasuredSolid solid;
  CwMeasuredRotor rotor;
  CwDesign design = design_of(&table);
  measure(&design, &solid, &rotor);
  const double without = solid.volume;
  for (double radius = 0.5e-3; radius < 3.1e-3; radius *= 2) {
    table.impeller.root_fillet_radius = radius;
    design = design_of(&table);
    measure(&design, &solid, &rotor);
    const double one = (1 - M_PI / 4) * radius * radius, length = (without - solid.volume) / one;
    if (!(length > 2.0 && length < 2.6))
      fail_msg("fillets of %.2f mm are as long as %.3f m of fillets in a right angle", radius * 1e3, length);
    volumes_agree(&design, &solid, 2e-4);
  }
}

// Tangent to the walls and to the blade, at most a third of a degree off; the fillets' faces lie in the patches
// of the blade.
static void fillets_are_tangent_and_named(void **state) {
  CwCase table = paper();
  table.impeller.root_fillet_radius = 2e-3;
  const CwDesign design = design_of(&table);
  CwMeasuredSolid solid;
  CwMeasuredRotor measured;
  CwSolid *rotor = NULL;
  measure(&design, &solid, &measured);
  assert_near(measured.hub_crease.angle, 180 * degree, 0.35 * degree);
  assert_near(measured.shroud_crease.angle, 180 * degree, 0.35 * degree);
  assert_true(measured.kink.angle < 0.15 * degree);
  assert_near(measured.wrap_angle, 71 * degree, 0.01 * degree);
  assert_int_equal(cw_rotor_build(&design, &rotor), CW_OK);
  for (int w = 0; w < 2; w++) {
    const char *root = w ? "_shroud_root" : "_hub_root";
    assert_int_equal(count(rotor, "blade_pressure", root), 6);
    assert_int_equal(count(rotor, "blade_suction", root), 6);
    assert_int_equal(count(rotor, "blade_leading_edge", root), 6);
    assert_int_equal(count(rotor, "blade_trailing_edge", root), 12);
  }
  for (int face = 0; face < cw_solid_face_count(rotor); face++)
    assert_true(strlen(cw_solid_face_name(rotor, face)) < 32);
  cw_solid_free(&rotor);
}

// With every trailing edge, with splitters, with lean, and mirrored.
static void fillets_go_with_every_option(void **state) {
  for (int i = 0; i < 7; i++) {
    CwCase table = paper();
    CwMeasuredSolid solid;
    CwMeasuredRotor measured;
    table.impeller.root_fillet_radius = 1.5e-3;
    if (i < 4) table.impeller.trailing_edge = (CwTrailingEdge)i;
    if (i == 4) table.impeller.splitter_start = 0.4;
    if (i == 5) table.impeller.lean_angle = 10 * degree;
    if (i == 6) table.impeller.rotation = CW_ROTATION_CLOCKWISE;
    const CwDesign design = design_of(&table);
    measure(&design, &solid, &measured);
    assert_true(measured.kink.angle < 1.5 * degree);
    assert_true(measured.hub_crease.angle > 178 * degree && measured.shroud_crease.angle > 178 * degree);
    volumes_agree(&design, &solid, 2e-4);
  }
}

// Fillets that meet between hub and shroud, and fillets that reach before the hub, are refused with what to do where a
// design has them all the same.
static void too_large_fillets_are_refused(void **state) {
  CwCase table = paper();
  CwSolid *rotor = NULL;
  CwDesign design = design_of(&table);
  design.root_fillet_radius = 6e-3;
  assert_int_equal(cw_rotor_build(&design, &rotor), CW_ERR_GEOMETRY);
  assert_null(rotor);
  assert_non_null(strstr(cw_fail_message(), "lower root_fillet_radius_mm to"));
  cw_fail_clear();
}

// The radius that the refusal names fits, also on the same wheel with a D2 of 200/512 = 0.39 mm: some 0.006 mm.
static void named_fillets_fit(void **state) {
  CwCase table = paper();
  for (int size = 1; size <= 512; size *= 512) {
    CwDesign design = design_of(&table);
    CwSolid *rotor = NULL;
    double fits = 0;
    design.root_fillet_radius = 6e-3;
    double *length[] = {
        &design.inlet_diameter,         &design.outlet_diameter,         &design.outlet_width,
        &design.hub_diameter,           &design.nut_disk_radius,         &design.nut_length,
        &design.axial_length,           &design.leading_edge_radius_hub, &design.leading_edge_radius_shroud,
        &design.leading_edge_thickness, &design.blade_thickness,         &design.trailing_edge_thickness,
        &design.trailing_edge_bevel,    &design.root_fillet_radius,      &design.suction_pipe_length,
        &design.interface_radius};
    for (size_t i = 0; i < sizeof length / sizeof *length; i++) *length[i] /= size;
    assert_int_equal(cw_rotor_build(&design, &rotor), CW_ERR_GEOMETRY);
    const char *named = strstr(cw_fail_message(), "lower root_fillet_radius_mm to");
    assert_non_null(named);
    assert_int_equal(sscanf(named, "lower root_fillet_radius_mm to %lf", &fits), 1);
    cw_fail_clear();
    assert_true(fits > 1.0 / size && fits < 6.0 / size);
    design.root_fillet_radius = 1e-3 * fits;
    if (cw_rotor_build(&design, &rotor) != CW_OK) fail_msg("%g mm: %s", fits, cw_fail_message());
    cw_solid_free(&rotor);
  }
}

// The shaft takes its cylinder from the inlet on; the inlet is a ring.
static void shaft_through_the_inlet(void **state) {
  for (int thick = 0; thick < 2; thick++) {
    CwCase table = paper();
    const double d = thick ? 24e-3 : 16e-3;
    table.impeller.hub_diameter = 24e-3;
    table.impeller.through_shaft_diameter = d;
    const CwDesign design = design_of(&table);
    CwMeasuredSolid solid;
    CwMeasuredRotor measured;
    CwSolid *rotor = NULL;
    measure(&design, &solid, &measured);
    assert_near(measured.inlet_diameter, 0.074, 1e-6);
    assert_near(measured.inlet_area, M_PI / 4 * (0.074 * 0.074 - d * d), 1e-9);
    assert_true(measured.kink.angle < 0.1 * degree);
    volumes_agree(&design, &solid, 1e-5);
    assert_int_equal(cw_rotor_build(&design, &rotor), CW_OK);
    assert_int_equal(count(rotor, "inlet", "inlet_"), 6);
    assert_int_equal(count(rotor, "hub_shaft", "hub_shaft_"), 6);
    // A shaft as thick as the hub goes on from it without a nut.
    assert_int_equal(count(rotor, "hub_nut", "hub_nut"), thick ? 0 : 6);
    cw_solid_free(&rotor);
  }
}

// The hub grows to a shaft that is thicker than its computed diameter.
static void hub_follows_the_shaft(void **state) {
  CwCase table = paper();
  table.impeller.through_shaft_diameter = 30e-3;
  const CwDesign design = design_of(&table);
  assert_near(design.hub_diameter, 30e-3, 1e-12);
  assert_near(design.nut_length, 0, 0);
}

// Two blades whose passages wind round the axis by more than a revolution: seams cut hub, shroud and what goes on from
// them into as many equal parts as it takes, and the fluid stays the same.
static void seams_cut_passages_that_wind(void **state) {
  static const double wraps[] = {130, 200, 250};
  for (int i = 0; i < 3; i++) {
    CwCase table = duty_point(1.3357, 0.16303, 111.76);
    table.impeller.blade_count = 2;
    table.impeller.wrap_angle = wraps[i] * degree;
    table.impeller.through_shaft_diameter = i == 1 ? 16e-3 : 0;
    const CwDesign design = design_of(&table);
    assert_near(design.wrap_angle, wraps[i] * degree, 1e-9);
    CwMeasuredSolid solid;
    CwMeasuredRotor measured;
    CwSolid *rotor = NULL;
    measure(&design, &solid, &measured);
    assert_true(measured.kink.angle < 0.1 * degree);
    assert_near(measured.wrap_angle, wraps[i] * degree, 0.02 * degree);
    volumes_agree(&design, &solid, i == 0 ? 2e-5 : 2e-4);
    assert_int_equal(cw_rotor_build(&design, &rotor), CW_OK);
    assert_int_equal(count(rotor, "hub", "hub_"), 2 * (i + 1));
    assert_int_equal(count(rotor, "shroud", "shroud_"), 2 * (i + 1));
    assert_int_equal(count(rotor, "blade_pressure", "pressure"), 2);
    cw_solid_free(&rotor);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(fillets_take_their_volume),    cmocka_unit_test(fillets_are_tangent_and_named),
      cmocka_unit_test(fillets_go_with_every_option), cmocka_unit_test(too_large_fillets_are_refused),
      cmocka_unit_test(shaft_through_the_inlet),      cmocka_unit_test(hub_follows_the_shaft),
      cmocka_unit_test(seams_cut_passages_that_wind), cmocka_unit_test(named_fillets_fit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
