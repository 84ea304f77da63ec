// SPDX-License-Identifier: AGPL-3.0-or-later
// Suction and discharge pipe as domains of their own: what is cut off is what the others lose, both sides of a
// disc have the same outline, and the case is told when there is no room for a zone.
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <BRep_Tool.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <gp_Pnt.hxx>

#include "geometry/hydraulic_design.h"
#include "geometry/measure.h"
#include "geometry/pump.h"
#include "geometry/solid.hpp"
#include "tests/geometry/paper_rotor.h"
#include "tests/unit_test.h"

static CwMeasuredSolid measure(const CwSolid *solid) {
  CwMeasuredSolid measured;
  assert_int_equal(cw_measure_solid(solid, &measured), CW_OK);
  assert_true(measured.valid && measured.closed && measured.largest_tolerance < 1e-6);
  return measured;
}

// Ends and middles of the edges of a patch's faces, mm.
static std::vector<gp_Pnt> outline(const CwSolid *solid, const char *patch, const char *kind) {
  std::vector<gp_Pnt> points;
  for (const CwSolidFace &face : solid->faces) {
    if (face.patch != patch) continue;
    assert_string_equal(cw_patch_kind_name(face.kind), kind);
    for (TopExp_Explorer at(face.face, TopAbs_EDGE); at.More(); at.Next()) {
      double first, last;
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(at.Current()), first, last);
      for (double s : {0.0, 0.5, 1.0}) points.push_back(curve->Value(first + s * (last - first)));
    }
  }
  assert_false(points.empty());
  return points;
}

static void same_outline(const CwSolid *a, const char *patch_a, const CwSolid *b, const char *patch_b) {
  const std::vector<gp_Pnt> p = outline(a, patch_a, "interface"), q = outline(b, patch_b, "interface");
  assert_int_equal(p.size(), q.size());
  for (const gp_Pnt &point : p) {
    double least = HUGE_VAL;
    for (const gp_Pnt &other : q) least = std::fmin(least, point.Distance(other));
    assert_true(least < 1e-9);
  }
}

static void check_zones(CwCase table) {
  CwDesign design, whole_design;
  CwPump zones = pump_of(&table, &design);
  table.impeller.suction_pipe_zone = table.volute.discharge_pipe_zone = CW_PIPE_WITH_NEIGHBOUR;
  table.impeller.suction_pipe_length = design.suction_pipe_length;
  CwPump whole = pump_of(&table, &whole_design);
  assert_int_equal(whole.count, 2);
  assert_int_equal(whole.interface_count, 1);
  assert_int_equal(zones.count, 4);
  assert_int_equal(zones.interface_count, 3);
  assert_string_equal(cw_solid_domain(zones.solid[2]), "suction");
  assert_string_equal(cw_solid_domain(zones.solid[3]), "discharge");
  const char *names[] = {"rotor", "stator"};
  for (int i = 0; i < 2; i++) {
    assert_string_equal(cw_solid_domain(zones.solid[i]), names[i]);
    const double all = measure(whole.solid[i]).volume, rest = measure(zones.solid[i]).volume,
                 pipe = measure(zones.solid[2 + i]).volume;
    assert_near(rest + pipe, all, 1e-5 * all);
    assert_true(pipe > 0.05 * all);
  }
  // The whole pipes: length times section.
  const double d1 = design.inlet_diameter, dn = design.discharge_diameter;
  assert_near(measure(zones.solid[3]).volume, M_PI / 4 * dn * dn * (design.discharge_pipe_length - 0.25 * dn),
              1e-9 * dn);
  assert_true(measure(zones.solid[2]).volume <
              M_PI / 4 * d1 * d1 * (design.suction_pipe_length - 0.25 * d1) * 1.000001);
  for (int i = 0; i < 3; i++) {
    const CwPumpInterface *between = &zones.interface[i];
    int found[2] = {-1, -1};
    for (int d = 0; d < zones.count; d++)
      for (int s = 0; s < 2; s++)
        for (const CwSolidFace &face : zones.solid[d]->faces)
          if (face.patch == between->patch[s]) found[s] = d;
    assert_true(found[0] >= 0 && found[1] >= 0);
    assert_int_not_equal(found[0], found[1]);
    if (i > 0) same_outline(zones.solid[found[0]], between->patch[0], zones.solid[found[1]], between->patch[1]);
  }
  outline(zones.solid[2], "inlet", "inlet");
  outline(zones.solid[3], "outlet", "outlet");
  cw_pump_free(&zones);
  cw_pump_free(&whole);
}

static void zones_add_up_to_the_whole(void **) {
  check_zones(case_of("zones"));
}

static void the_other_hand_has_zones_too(void **) {
  CwCase table = case_of("zones");
  table.impeller.rotation = CW_ROTATION_CLOCKWISE;
  check_zones(table);
}

static void radial_discharge_and_splitters_have_zones_too(void **) {
  CwCase table = case_of("splitters");
  table.impeller.suction_pipe_zone = table.volute.discharge_pipe_zone = CW_PIPE_OWN_ZONE;
  table.volute.discharge = CW_DISCHARGE_RADIAL;
  table.volute.diffuser_length = 0.25;
  check_zones(table);
}

static void a_short_pipe_is_refused(void **) {
  CwCase table = case_of("zones");
  CwDesign design;
  CwPipeStubs stubs;
  table.impeller.suction_pipe_length = 0.03;
  design = design_of(&table);
  assert_int_equal(cw_pump_pipe_stubs(&table, &design, &stubs), CW_ERR_DESIGN);
  assert_non_null(std::strstr(cw_fail_message(), "raise suction_pipe_length_mm to at least"));
  table = case_of("zones");
  table.volute.discharge_pipe_length = 0.02; // DN is 50 mm: 12.5 mm stay with the stator
  design = design_of(&table);
  assert_int_equal(cw_pump_pipe_stubs(&table, &design, &stubs), CW_ERR_DESIGN);
  assert_non_null(std::strstr(cw_fail_message(), "raise discharge_pipe_length_mm to at least 25.0"));
  table.volute.outlet_diameter = 0.05005; // half of it is 25.025 mm
  design = design_of(&table);
  assert_int_equal(cw_pump_pipe_stubs(&table, &design, &stubs), CW_ERR_DESIGN);
  assert_non_null(std::strstr(cw_fail_message(), "raise discharge_pipe_length_mm to at least 25.1"));
  cw_fail_clear();
  table.volute.discharge_pipe_length = 0.0251;
  design = design_of(&table);
  assert_int_equal(cw_pump_pipe_stubs(&table, &design, &stubs), CW_OK);
}

// Round a shaft the zone is a ring, whose inner wall is the shaft; thinner than the hub, and as thick.
static void a_shaft_makes_a_ring(void **) {
  for (double share : {0.6, 1.0}) {
    CwCase table = case_of("zones");
    CwDesign design;
    CwMeasuredPump measured;
    table.impeller.hub_diameter = 0.024;
    table.impeller.through_shaft_diameter = share * 0.024;
    check_zones(table);
    CwPump pump = pump_of(&table, &design);
    if (cw_pump_measure(&design, &pump, &measured) != CW_OK) fail_msg("%s", cw_fail_message());
    int core = 0;
    for (const CwSolidFace &face : pump.solid[2]->faces)
      core += face.patch == "hub_shaft_pipe" && face.kind == CW_PATCH_WALL;
    assert_int_equal(core, design.blade_count);
    const double length = design.suction_pipe_length - pump.stubs.suction;
    const double ring = M_PI / 4 * (std::pow(design.inlet_diameter, 2) - std::pow(design.through_shaft_diameter, 2));
    assert_near(measured.solid[2].volume, ring * length, 1e-6 * ring * length);
    cw_pump_free(&pump);
  }
}

// The rotor is cut, and so are the sections that its volume is held against.
static void all_domains_are_sound(void **) {
  const CwCase table = case_of("zones");
  CwDesign design;
  CwMeasuredPump measured;
  CwPump pump = pump_of(&table, &design);
  if (cw_pump_measure(&design, &pump, &measured) != CW_OK) fail_msg("%s", cw_fail_message());
  for (int i = 0; i < pump.count; i++) assert_true(measured.solid[i].volume > 0 && measured.solid[i].valid);
  cw_pump_free(&pump);
}

static void an_open_length_leaves_a_diameter_to_the_zone(void **) {
  CwCase table = case_of("zones");
  CwDesign design;
  CwPipeStubs stubs;
  table.impeller.suction_pipe_length = NAN;
  design = design_of(&table);
  assert_int_equal(cw_pump_pipe_stubs(&table, &design, &stubs), CW_OK);
  assert_near(design.suction_pipe_length - stubs.suction, design.inlet_diameter, 1e-12);
  assert_true(stubs.suction >= 0.25 * design.inlet_diameter);
  assert_near(stubs.discharge, 0.25 * design.discharge_diameter, 1e-12);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(zones_add_up_to_the_whole),
      cmocka_unit_test(the_other_hand_has_zones_too),
      cmocka_unit_test(radial_discharge_and_splitters_have_zones_too),
      cmocka_unit_test(a_short_pipe_is_refused),
      cmocka_unit_test(a_shaft_makes_a_ring),
      cmocka_unit_test(all_domains_are_sound),
      cmocka_unit_test(an_open_length_leaves_a_diameter_to_the_zone),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
