// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <string.h>

#include "geometry/blade.h"
#include "geometry/measure.h"
#include "geometry/meridian.h"
#include "geometry/rotor.h"
#include "pipeline/case.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/unit_test.h"

static const double degree = M_PI / 180;

static void paper_rotor(void **state) {
  const CwCase table = paper();
  const CwDesign design = design_of(&table);
  CwMeasuredSolid solid;
  CwMeasuredRotor rotor;
  measure(&design, &solid, &rotor);
  assert_int_equal(solid.face_count, 6 * 10 + 2);
  assert_near(rotor.wrap_angle, 71 * degree, 0.01 * degree);
  assert_near(rotor.inlet_diameter, 0.074, 1e-6);
  assert_near(rotor.outlet_diameter, 0.200, 1e-6);
  assert_near(rotor.outlet_width, 0.008, 1e-6);
  assert_near(rotor.interface_radius, 0.101, 1e-6);
  assert_near(rotor.interface_area, 2 * M_PI * 0.101 * 0.008, 1e-9);
  assert_true(rotor.hub_crease.angle > 72 * degree);
  assert_true(rotor.shroud_crease.angle > 72 * degree);
  assert_true(2 * M_PI - rotor.trailing_edge.angle > 75 * degree);
  assert_true(rotor.kink.angle < 0.1 * degree);
  assert_true(solid.shortest_edge > 0.9e-3 && solid.narrowest_face > 0.9e-3);
  volumes_agree(&design, &solid, 1e-5);
}

static void every_face_has_a_patch(void **state) {
  static const char *const patches[] = {"inlet",
                                        "suction_pipe",
                                        "hub",
                                        "hub_nut",
                                        "shroud",
                                        "blade_pressure",
                                        "blade_suction",
                                        "blade_leading_edge",
                                        "blade_trailing_edge",
                                        "rotor_interface"};
  static const int counts[] = {1, 6, 6, 7, 6, 6, 6, 6, 12, 6};
  const CwCase table = paper();
  const CwDesign design = design_of(&table);
  CwSolid *rotor = NULL;
  assert_int_equal(cw_rotor_build(&design, &rotor), CW_OK);
  for (size_t i = 0; i < sizeof patches / sizeof *patches; i++) {
    int found = 0;
    for (int face = 0; face < cw_solid_face_count(rotor); face++)
      found += strcmp(cw_solid_face_patch(rotor, face), patches[i]) == 0;
    assert_int_equal(found, counts[i]);
  }
  for (int face = 0; face < cw_solid_face_count(rotor); face++) {
    const char *patch = cw_solid_face_patch(rotor, face), *kind = cw_patch_kind_name(cw_solid_face_kind(rotor, face));
    assert_string_equal(kind, strcmp(patch, "inlet") == 0             ? "inlet"
                              : strcmp(patch, "rotor_interface") == 0 ? "interface"
                                                                      : "wall");
  }
  cw_solid_free(&rotor);
  assert_null(rotor);
}

// Blade numbers, widths and wraps far from the paper's.
static void sweep(void **state) {
  static const double wraps[] = {71, 110, 150}, widths[] = {5, 8, 16};
  for (int z = 3; z <= 9; z++)
    for (int i = z % 3; i < 3; i += 2) {
      CwCase table = paper();
      table.impeller.blade_count = z;
      table.impeller.wrap_angle = wraps[i] * degree;
      table.impeller.outlet_width = widths[(i + z) % 3] * 1e-3;
      table.volute.inlet_width = table.impeller.outlet_width + 4e-3;
      const CwDesign design = design_of(&table);
      CwMeasuredSolid solid;
      CwMeasuredRotor rotor;
      measure(&design, &solid, &rotor);
      if (!solid.valid || !solid.closed || solid.largest_tolerance > 1e-6)
        fail_msg("z %d, wrap %.0f deg, b2 %.0f mm: valid %d, closed %d, tolerance %.3g m", z, wraps[i],
                 design.outlet_width * 1e3, solid.valid, solid.closed, solid.largest_tolerance);
      assert_near(rotor.wrap_angle, wraps[i] * degree, 0.01 * degree);
      assert_near(rotor.outlet_width, design.outlet_width, 1e-6);
      volumes_agree(&design, &solid, 2e-5);
    }
}

static void other_priorities(void **state) {
  for (int priority = CW_PRIORITY_WRAP; priority <= CW_PRIORITY_BETA; priority++) {
    CwCase table = paper();
    table.impeller.priority = (CwPriority)priority;
    const CwDesign design = design_of(&table);
    CwMeasuredSolid solid;
    CwMeasuredRotor rotor;
    measure(&design, &solid, &rotor);
    assert_near(rotor.wrap_angle, design.wrap_angle, 0.01 * degree);
  }
}

static int faces_of_patch(const CwSolid *solid, const char *patch) {
  int found = 0;
  for (int face = 0; face < cw_solid_face_count(solid); face++)
    found += strcmp(cw_solid_face_patch(solid, face), patch) == 0;
  return found;
}

// Each kind of trailing edge: faces a blade, and the outlet diameter that is met. A bevel takes material off
// the blunt edge, and a sharp edge more: the fluid grows.
static void trailing_edges(void **state) {
  static const int faces[] = {[CW_EDGE_BEVELLED] = 2, [CW_EDGE_BLUNT] = 1, [CW_EDGE_ROUNDED] = 1, [CW_EDGE_SHARP] = 1};
  double volume[4];
  for (int edge = CW_EDGE_BEVELLED; edge <= CW_EDGE_SHARP; edge++) {
    CwCase table = paper();
    table.impeller.trailing_edge = (CwTrailingEdge)edge;
    const CwDesign design = design_of(&table);
    CwSolid *rotor = NULL;
    CwMeasuredSolid solid;
    CwMeasuredRotor measured;
    measure(&design, &solid, &measured);
    volumes_agree(&design, &solid, 2e-5);
    volume[edge] = solid.volume;
    assert_near(measured.outlet_diameter, 0.2, edge == CW_EDGE_ROUNDED ? 1e-5 : 1e-6);
    assert_near(measured.wrap_angle, 71 * degree, edge == CW_EDGE_ROUNDED ? 1 * degree : 0.01 * degree);
    assert_int_equal(cw_rotor_build(&design, &rotor), CW_OK);
    assert_int_equal(faces_of_patch(rotor, "blade_trailing_edge"), 6 * faces[edge]);
    cw_solid_free(&rotor);
  }
  assert_true(volume[CW_EDGE_BLUNT] < volume[CW_EDGE_BEVELLED]);
  assert_true(volume[CW_EDGE_BEVELLED] < volume[CW_EDGE_SHARP]);
}

// The foremost point of the rounding lies on D2 in every section.
static void rounding_reaches_the_outlet_diameter(void **state) {
  CwCase table = paper();
  table.impeller.trailing_edge = CW_EDGE_ROUNDED;
  const CwDesign design = design_of(&table);
  CwMeridian meridian;
  CwBladeSection section;
  assert_int_equal(cw_meridian_make(&design, &meridian), CW_OK);
  for (int j = 0; j <= 2; j++) {
    double largest = 0, x[2];
    assert_int_equal(cw_blade_section(&design, &meridian, 0.5 * j, &section), CW_OK);
    for (int i = 0; i <= 200; i++) {
      const CwBladePoint point = cw_blade_trailing_edge(&section, M_PI * (i / 200.0 - 0.5));
      cw_meridian_blade_point(&meridian, 0.5 * j, point.q, x, NULL);
      largest = fmax(largest, x[0]);
    }
    assert_near(largest, 0.1, 5e-6);
  }
}

// Splitters: twice the blade faces, less fluid by their volume, and the same wrap of the blades.
static void splitters(void **state) {
  CwCase table = paper();
  table.impeller.splitter_start = 0.4;
  const CwDesign design = design_of(&table);
  CwSolid *rotor = NULL;
  CwMeasuredSolid solid;
  CwMeasuredRotor measured;
  measure(&design, &solid, &measured);
  assert_near(measured.wrap_angle, 71 * degree, 0.01 * degree);
  assert_int_equal(cw_rotor_build(&design, &rotor), CW_OK);
  assert_int_equal(faces_of_patch(rotor, "blade_pressure"), 12);
  assert_int_equal(faces_of_patch(rotor, "hub"), 12);
  int named = 0;
  for (int face = 0; face < cw_solid_face_count(rotor); face++)
    named += strncmp(cw_solid_face_name(rotor, face), "splitter_", 9) == 0;
  assert_int_equal(named, 6 * 5);
  cw_solid_free(&rotor);
  volumes_agree(&design, &solid, 2e-5);
}

// Straight blades: theta is a function of r alone; lean turns hub and shroud apart by b2 tan(lean) / r2.
static void cylindrical_blades_and_lean(void **state) {
  CwCase table = paper();
  table.impeller.blade_form = CW_BLADE_CYLINDRICAL;
  CwDesign design = design_of(&table);
  CwMeridian meridian;
  CwBladeSection hub, shroud;
  assert_int_equal(cw_meridian_make(&design, &meridian), CW_OK);
  assert_int_equal(cw_blade_section(&design, &meridian, 0, &hub), CW_OK);
  assert_int_equal(cw_blade_section(&design, &meridian, 1, &shroud), CW_OK);
  for (double p = 0.2; p < 0.95; p += 0.1) {
    // The same radius on the hub, by bisection.
    double x[2], y[2], low = 0, high = 1;
    cw_meridian_blade_point(&meridian, 1, p, x, NULL);
    for (int i = 0; i < 60; i++) {
      cw_meridian_blade_point(&meridian, 0, 0.5 * (low + high), y, NULL);
      *(y[0] < x[0] ? &low : &high) = 0.5 * (low + high);
    }
    assert_near(cw_blade_theta(&hub, low), cw_blade_theta(&shroud, p), 1e-7);
  }
  CwMeasuredSolid solid;
  CwMeasuredRotor measured;
  measure(&design, &solid, &measured);
  table = paper();
  table.impeller.lean_angle = 12 * degree;
  design = design_of(&table);
  assert_int_equal(cw_blade_section(&design, &meridian, 0, &hub), CW_OK);
  assert_int_equal(cw_blade_section(&design, &meridian, 1, &shroud), CW_OK);
  assert_near(cw_blade_theta(&shroud, 1) - cw_blade_theta(&hub, 1), 8e-3 * tan(12 * degree) / 0.1, 1e-12);
  measure(&design, &solid, &measured);
}

static void too_long_a_bevel_is_refused(void **state) {
  CwCase table = paper();
  table.impeller.trailing_edge_bevel = 5e-3;
  const CwDesign design = design_of(&table);
  CwSolid *rotor = NULL;
  assert_int_equal(cw_rotor_build(&design, &rotor), CW_ERR_GEOMETRY);
  assert_null(rotor);
  assert_non_null(strstr(cw_fail_message(), "bevel"));
  cw_fail_clear();
}

// Seven short blades of 1.8 mm: a sharp edge as long as usual would take nearly half of each.
static void an_open_bevel_fits(void **state) {
  CwCase table = duty_point(44.187, 156.7, 27627);
  table.design.correlations = CW_CORRELATIONS_GUAN;
  table.impeller.blade_form = CW_BLADE_CYLINDRICAL;
  table.impeller.trailing_edge = CW_EDGE_SHARP;
  table.impeller.blade_count = 7;
  const CwDesign design = design_of(&table);
  CwMeasuredSolid solid;
  CwMeasuredRotor rotor;
  assert_true(design.trailing_edge_bevel <
              cw_blade_usual_bevel(CW_EDGE_SHARP, design.trailing_edge_thickness, design.outlet_blade_angle));
  measure(&design, &solid, &rotor);
  volumes_agree(&design, &solid, 1e-4);
}

// Two blades that wind round the axis nearly once: hub and shroud between them end in long curves.
static void long_blades_have_the_volume_of_their_sections(void **state) {
  CwCase table = duty_point(0.86613, 0.89204, 666.56);
  table.design.slip = CW_SLIP_PFLEIDERER;
  table.impeller.blade_count = 2;
  table.impeller.outlet_width = 4.7371e-3;
  const CwDesign design = design_of(&table);
  CwMeasuredSolid solid;
  CwMeasuredRotor rotor;
  measure(&design, &solid, &rotor);
  volumes_agree(&design, &solid, 1e-5);
}

// Half a circle of 15 mm takes more than a fifth of a blade that is 57 mm long in the meridian: no bevel is to blame.
static void too_thick_a_rounding_is_refused(void **state) {
  CwCase table = paper();
  table.impeller.trailing_edge = CW_EDGE_ROUNDED;
  CwDesign design = design_of(&table);
  design.trailing_edge_thickness = 30e-3;
  CwSolid *rotor = NULL;
  assert_int_equal(cw_rotor_build(&design, &rotor), CW_ERR_GEOMETRY);
  assert_non_null(strstr(cw_fail_message(), "lower trailing_edge_thickness_mm (30 mm)"));
  assert_null(strstr(cw_fail_message(), "bevel"));
  cw_fail_clear();
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(paper_rotor),
      cmocka_unit_test(every_face_has_a_patch),
      cmocka_unit_test(sweep),
      cmocka_unit_test(other_priorities),
      cmocka_unit_test(trailing_edges),
      cmocka_unit_test(rounding_reaches_the_outlet_diameter),
      cmocka_unit_test(splitters),
      cmocka_unit_test(cylindrical_blades_and_lean),
      cmocka_unit_test(too_long_a_bevel_is_refused),
      cmocka_unit_test(an_open_bevel_fits),
      cmocka_unit_test(long_blades_have_the_volume_of_their_sections),
      cmocka_unit_test(too_thick_a_rounding_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
