// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "geometry/design_check.h"
#include "pipeline/case.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/unit_test.h"

static int remarked(const CwDesign *design, const char *words) {
  CwDesignRemarks remarks;
  cw_design_check(design, &remarks);
  for (int i = 0; i < remarks.count; i++)
    if (strstr(remarks.text[i], words)) return 1;
  return 0;
}

// Table 3: D2 = 200 mm against 178 to 182 mm (a tenth over 182.2 is 200.4: just within), D3 = 1.02 D2, and a
// head that the wrap does not give.
static void paper_remarks(void **state) {
  const CwCase table = paper();
  const CwDesign design = design_of(&table);
  assert_true(remarked(&design, "predicts a head"));
  assert_true(remarked(&design, "D3 is 1.020 D2; 1.03 to 1.08 are usual: base_diameter_mm of 206 to 216"));
  assert_true(remarked(&design, "incidence"));
  assert_false(remarked(&design, "width b2 is")); // 8 mm: Guan 8.81, less 10 % is 7.93
  assert_false(remarked(&design, "outlet D2 is"));
  assert_true(remarked(&design, "6 blades; ")); // 6.5 274/126 sin 34.3 deg = 7.96
  assert_false(remarked(&design, "the wrap is"));
}

static void far_off_values_are_remarked(void **state) {
  const CwCase table = paper();
  CwDesign design = design_of(&table);
  design.outlet_diameter = 0.25;
  assert_true(remarked(&design, "impeller outlet D2 is 250 mm; Guelich's correlation gives 182.2, Guan's 178"));
  design.warn_share = 0.5;
  assert_false(remarked(&design, "impeller outlet D2 is"));
  design = design_of(&table);
  design.blade_count = 11;
  assert_true(remarked(&design, "11 blades"));
  design = design_of(&table);
  design.wrap_residual = 0.1;
  assert_true(remarked(&design, "the wrap is"));
  design = design_of(&table);
  design.head_residual = 0;
  assert_false(remarked(&design, "predicts a head"));
}

// A number that gave way is told with what was asked, a word by the reason alone.
static void what_gave_way_is_told(void **state) {
  const CwCase table = paper();
  CwDesign design = design_of(&table);
  design.source[CW_DESIGN_inlet_diameter] = "key gives way";
  design.asked[CW_DESIGN_inlet_diameter] = 2 * design.inlet_diameter;
  assert_true(remarked(&design, "key gives way: impeller inlet D1 is "));
  assert_true(remarked(&design, "the case asks for "));
  design.asked[CW_DESIGN_inlet_diameter] = design.inlet_diameter;
  assert_true(remarked(&design, "key gives way"));
  assert_false(remarked(&design, "the case asks for "));
}

// 6.5 274/126 sin 34.3 deg = 7.97. Splitters from 0.45 on make 9.3 of six blades and 15.5 of ten, from 0.8 on 4.8 of
// four, which would be 8.0 as 6.6.
static void splitters_count_as_blades(void **state) {
  const CwCase table = paper();
  CwDesign design = design_of(&table);
  design.inlet_blade_angle = design.outlet_blade_angle = 34.3 * M_PI / 180;
  assert_true(
      remarked(&design, "6 blades; Pfleiderer's 6.5 (D2 + D1)/(D2 - D1) sin(mean beta) gives a blade_count of"));
  design.splitter_start = 0.45;
  assert_false(remarked(&design, "Pfleiderer"));
  design.blade_count = 10;
  assert_true(remarked(&design, "10 blades, 15.5 with the splitters by their length; Pfleiderer"));
  assert_true(remarked(&design, "gives 8.0: a blade_count of 8.0"));
  design.blade_count = 4;
  design.splitter_start = 0.8;
  assert_true(remarked(&design, "gives 8.0: a blade_count of 6.6"));
}

// A spread of the wrap is remarked where the design chose it, not where the case gives it; cylindrical blades have
// none, which is said.
static void spread_of_the_wrap(void **state) {
  CwCase table = paper();
  CwDesign design = design_of(&table);
  design.wrap_spread = 0.1;
  design.source[CW_DESIGN_wrap_spread] = "chosen";
  assert_true(remarked(&design, "the wrap at the shroud differs by 6 deg"));
  table.impeller.wrap_spread = 0.05;
  design = design_of(&table);
  assert_near(design.wrap_spread, 0.05, 1e-15);
  assert_false(remarked(&design, "the wrap at the shroud differs"));
  assert_false(remarked(&design, "wrap_spread_deg"));
  table.impeller.blade_form = CW_BLADE_CYLINDRICAL;
  design = design_of(&table);
  assert_near(design.wrap_spread, 0, 0);
  assert_true(remarked(&design, "wrap_spread_deg gives way to cylindrical blades, which have one wrap"));
  assert_false(remarked(&design, "the wrap at the shroud differs"));
}

// What a remark tells to change is a key that the case may give beside its others, with a value that works.
static void remarks_name_keys_of_use(void **state) {
  const CwCase table = paper();
  const CwDesign paper_design = design_of(&table);
  CwDesign design = paper_design;
  design.npsh_required = 3; // 2339.2 + 998.2 9.80665 3 = 31706.2 Pa
  design.npsh_available = 2;
  design.vapour_pressure = 2339.2;
  assert_true(remarked(&design, "raise operating_point.inlet_pressure_pa to 31707"));
  // The flow comes at 3 deg: 11 deg would do, but at mid-span 12 deg on the shroud are 12 47/43, some 13 deg.
  design = paper_design;
  design.inlet_flow_angle = 3 * CW_DEGREE;
  design.incidence = 10 * CW_DEGREE;
  assert_true(remarked(&design, "the flow comes at 3.0 deg and blades have 12 deg and more: lower inlet_diameter_mm"));
  design.inlet_flow_angle = 10 * CW_DEGREE;
  assert_true(remarked(&design, "inlet_blade_angle_deg of about 13."));
  // 125 mm and a gap lie beyond 1.2 of 100 mm.
  design = paper_design;
  design.base_diameter = 0.25;
  design.tongue_tip_radius = 0.13;
  assert_true(remarked(&design, "tongue's tip lies at 1.300 of the wheel's radius; 1.05 to 1.2 are usual: "
                                "base_diameter_mm of at most 216"));
  assert_false(remarked(&design, "tongue_gap_mm"));
  design.base_diameter = paper_design.base_diameter;
  design.source[CW_DESIGN_tongue_angle] = "case";
  assert_true(remarked(&design, "tongue_gap_mm of 3 to 18 in place of tongue_angle_deg"));
  design = paper_design;
  design.diffuser_angle = 20 * CW_DEGREE;
  assert_true(remarked(&design, "raise diffuser_length_mm to"));
  design.source[CW_DESIGN_diffuser_length] = "full angle of the case";
  assert_true(remarked(&design, "lower diffuser_angle_deg to 10"));
  design.diffuser_area_ratio = 4;
  assert_true(remarked(&design, "outlet_diameter_mm of"));
  design.source[CW_DESIGN_diffuser_area_ratio] = "case";
  assert_true(remarked(&design, "1.5 to 3 are usual: diffuser_area_ratio of 1.5 to 3"));
}

// Guan's formulas have no term by which a pump becomes poor as it becomes small: 60 % at 0.1 m3/h.
static void small_pumps_by_guan(void **state) {
  CwCase table = duty_point(0.1, 1.25, 2900);
  table.design.correlations = CW_CORRELATIONS_GUAN;
  CwDesign design = design_of(&table);
  assert_true(
      remarked(&design, "0.1 m3/h lie below the 5 m3/h to which Guan's efficiencies reach; 60 % (hydraulic 78"));
  assert_true(remarked(&design, "take design.correlations guelich"));
  assert_false(remarked(&design, "Guelich's efficiencies"));
  design.water_flow_rate = 5.01 / 3600;
  assert_false(remarked(&design, "Guan's efficiencies"));
}

// Only poles that the case gives can be left out.
static void given_poles_are_named(void **state) {
  const CwCase table = paper();
  CwDesign design = design_of(&table);
  design.passage_area_reversal = 0.02;
  assert_true(remarked(&design, "0.1 % are usual: change axial_length_mm"));
  assert_false(remarked(&design, "leave out"));
  design.source[CW_DESIGN_hub_pole_radial] = "case";
  assert_true(remarked(&design, "change axial_length_mm, or leave out hub_pole_radial"));
  assert_false(remarked(&design, "shroud_pole"));
  design.source[CW_DESIGN_shroud_pole_radial] = "case";
  assert_true(remarked(&design, "leave out hub_pole_radial and shroud_pole_radial"));
}

// D3 = 1.09 D2 leaves 2.4 to 9 mm, of which both ends can be had: 1.05 of the wheel's radius lies inside D3/2.
static void advised_gaps_can_be_had(void **state) {
  CwCase table = duty_point(25, 10, 1450);
  table.impeller.outlet_diameter = 0.165;
  table.volute.base_diameter = 0.18;
  table.volute.tongue_gap = 0.025;
  const CwDesign design = design_of(&table);
  CwDesignRemarks remarks;
  const char *advice = NULL;
  double gap[2];
  cw_design_check(&design, &remarks);
  for (int i = 0; i < remarks.count && !advice; i++) advice = strstr(remarks.text[i], "tongue_gap_mm of ");
  assert_non_null(advice);
  assert_int_equal(sscanf(advice, "tongue_gap_mm of %lf to %lf", &gap[0], &gap[1]), 2);
  assert_true(gap[0] > 2 && gap[0] < 3);
  assert_near(gap[1], 9, 1e-9);
  for (int i = 0; i < 2; i++) {
    table.volute.tongue_gap = 1e-3 * gap[i];
    const CwDesign better = design_of(&table);
    assert_true(isnan(better.asked[CW_DESIGN_tongue_tip_radius]));
    assert_false(remarked(&better, "the tongue's tip"));
  }
}

// The texts by which remarks know what the case gives are those of the design.
static void sources_of_the_diffuser(void **state) {
  CwCase table = paper();
  table.volute.outlet_diameter = NAN;
  table.volute.diffuser_area_ratio = 1.3;
  table.volute.diffuser_length = NAN;
  table.volute.diffuser_angle = 15 * CW_DEGREE;
  const CwDesign design = design_of(&table);
  assert_true(remarked(&design, "lower diffuser_angle_deg to 10"));
  assert_true(remarked(&design, "diffuser_area_ratio of 1.5 to 3"));
}

// On either wall a leading edge that was moved out of the eye is told.
static void leading_edges_moved_out_of_the_eye(void **state) {
  const CwCase table = paper();
  CwDesign design = design_of(&table);
  assert_false(remarked(&design, "the blades begin"));
  design.source[CW_DESIGN_leading_edge_radius_hub] = "at the eye: 0.05 of its height behind its plane";
  assert_true(remarked(&design, "leading_edge_radius_hub_mm lies at the hub's begin or inside it"));
  assert_false(remarked(&design, "leading_edge_radius_shroud_mm"));
  design.source[CW_DESIGN_leading_edge_radius_shroud] = design.source[CW_DESIGN_leading_edge_radius_hub];
  assert_true(remarked(&design, "leading_edge_radius_shroud_mm lies at the eye or inside it"));
}

// A given edge that is thicker than the computed blade, of which the table of given values does not tell.
static void edges_thicker_than_the_blade(void **state) {
  CwCase table = paper();
  CwDesign design = design_of(&table);
  assert_false(remarked(&design, "mm at an edge"));
  table.impeller.leading_edge_thickness = 5e-3; // of 0.02 D2 = 4 mm
  design = design_of(&table);
  assert_true(remarked(&design, "5 mm at an edge and 4 mm between"));
  table.impeller.blade_thickness = 5e-3;
  design = design_of(&table);
  assert_false(remarked(&design, "mm at an edge"));
}

// Both ends of what is usual, and where the sources do not reach.
static void ends_and_reach_are_remarked(void **state) {
  const CwCase table = paper();
  const CwDesign paper_design = design_of(&table);
  CwDesign design = paper_design;
  assert_false(remarked(&design, "overlap"));
  assert_false(remarked(&design, "tongue's tip"));
  assert_false(remarked(&design, "ANSI/HI"));
  assert_false(remarked(&design, "NPSH3"));
  assert_false(remarked(&design, "Guelich's efficiencies"));
  design.overlap = 0.7;
  assert_true(remarked(&design, "raise wrap_angle_deg to 60"));
  design.overlap = 3.5;
  assert_true(remarked(&design, "lower wrap_angle_deg to 180"));
  design.diffusion_ratio = 0.7; // the least without a remark
  assert_false(remarked(&design, "separate"));
  design.diffusion_ratio = 0.699;
  assert_true(remarked(&design, "separate"));
  design.diffusion_ratio = 1.1; // the most
  assert_false(remarked(&design, "accelerates"));
  design.diffusion_ratio = 1.3;
  assert_true(remarked(&design, "accelerates"));
  design.npsh_required = 12; // (2339 + 998.2 9.80665 12) Pa
  assert_true(remarked(&design, "raise operating_point.inlet_pressure_pa to 1198"));
  design.tongue_tip_radius = 0.13;
  assert_true(remarked(
      &design, "tongue's tip lies at 1.300 of the wheel's radius; 1.05 to 1.2 are usual: tongue_gap_mm of 3 to 18"));
  design.tongue_tip_radius = 0.102;
  assert_true(remarked(&design, "tongue's tip lies at 1.020"));
  design.diffuser_area_ratio = 4;
  assert_true(remarked(&design, "area ratio of 4.00"));
  design.water_flow_rate = 0.5 / 3600;
  assert_true(remarked(&design, "0.5 m3/h lie below the 18 m3/h"));
  design.viscous_efficiency_factor = 0.1;
  design.viscous_parameter = 55;
  assert_true(remarked(&design, "B = 55"));
  assert_true(remarked(&design, "the NPSH3 of 12 m is that with water"));
  design.shaft_diameter = 2 * design.hub_diameter;
  assert_true(remarked(&design, "has no room for the shaft"));
  design.specific_speed_ns = 25;
  assert_false(remarked(&design, "Guan's formulas"));
  design.correlations = CW_CORRELATIONS_GUAN;
  assert_true(remarked(&design, "Guan's formulas are those of centrifugal pumps of ns 30 to 300"));
  design.specific_speed_nq = 50;
  assert_false(remarked(&design, "Stepanoff"));
  design.volute.input.area_law = CW_AREA_LAW_VELOCITY;
  assert_true(remarked(&design, "Stepanoff's velocity factor was read off for nq 10 to 40"));
  design.source[CW_DESIGN_section_speed] = "case: K3";
  assert_false(remarked(&design, "Stepanoff"));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(paper_remarks),
                                     cmocka_unit_test(ends_and_reach_are_remarked),
                                     cmocka_unit_test(far_off_values_are_remarked),
                                     cmocka_unit_test(what_gave_way_is_told),
                                     cmocka_unit_test(splitters_count_as_blades),
                                     cmocka_unit_test(spread_of_the_wrap),
                                     cmocka_unit_test(remarks_name_keys_of_use),
                                     cmocka_unit_test(advised_gaps_can_be_had),
                                     cmocka_unit_test(given_poles_are_named),
                                     cmocka_unit_test(small_pumps_by_guan),
                                     cmocka_unit_test(leading_edges_moved_out_of_the_eye),
                                     cmocka_unit_test(edges_thicker_than_the_blade),
                                     cmocka_unit_test(sources_of_the_diffuser)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
