// SPDX-License-Identifier: AGPL-3.0-or-later
// What faces are proposed to be: of the small pump by its areas, of single solids by their number.
#include "cad/small_parts.hpp"

extern "C" {
#include "geometry/cad/proposal.h"
}

struct Proposed {
  int count[CW_ROLE_PIPE + 1] = {0};
  double area[CW_ROLE_PIPE + 1] = {0}; // mm2
  int blades = 0;
};

static Proposed propose(SmallParts &small) {
  Proposed made;
  if (small.look()) fail_msg("%s", cw_fail_message());
  CwFaceRole *role = (CwFaceRole *)calloc(small.survey.face_count, sizeof *role);
  assert_int_equal(cw_proposal_make(&small.survey, small.contact, small.rotating, role, &made.blades), CW_OK);
  for (int f = 0; f < small.survey.face_count; f++) {
    made.count[role[f]]++;
    made.area[role[f]] += 1e6 * small.survey.face[f].area;
  }
  free(role);
  return made;
}

static void the_wheel_has_hub_shroud_and_blades(void **) {
  SmallParts small({{"rotor", small_rotor()}, {"stator", small_stator()}});
  const Proposed made = propose(small);
  assert_int_equal(made.blades, 6);
  assert_near(made.area[CW_ROLE_INLET], M_PI * 400, 1);
  assert_near(made.area[CW_ROLE_OUTLET], 20 * 16, 1e-3);
  assert_near(made.area[CW_ROLE_BLADE], 6 * (2 * 20 + 2 * 3) * 10, 1e-3);
  assert_near(made.area[CW_ROLE_HUB], M_PI * 2500 - 6 * 60, 1);
  assert_int_equal(made.count[CW_ROLE_PIPE], 4);
}

// Water along a shaft from both sides: the shaft is hub, all else shroud, also where one pipe is longer.
static void both_halves_of_a_wheel_have_a_shroud(void **) {
  for (const double top : {60, 140}) {
    const TopoDS_Shape lower = BRepAlgoAPI_Fuse(small_cylinder(-5, 50, 10), small_cylinder(-60, 20, 55)).Shape(),
                       water = BRepAlgoAPI_Fuse(lower, small_cylinder(5, 20, top - 5)).Shape();
    SmallParts small(
        {{"rotor", BRepAlgoAPI_Cut(water, small_cylinder(-61, 8, top + 62)).Shape()}, {"stator", small_stator()}});
    const Proposed made = propose(small);
    assert_int_equal(made.count[CW_ROLE_INLET], 2);
    assert_near(made.area[CW_ROLE_HUB], 2 * M_PI * 8 * (60 + top), 1);
    assert_near(made.area[CW_ROLE_SHROUD], 2 * M_PI * (2500 - 400) + 2 * M_PI * 20 * (50 + top), 1);
  }
}

// Without its blades a wheel has one passage.
static void a_disc_has_no_passages(void **) {
  SmallParts small({{"rotor", BRepAlgoAPI_Fuse(small_cylinder(-5, 50, 10), small_cylinder(-60, 20, 55)).Shape()}});
  const Proposed made = propose(small);
  assert_int_equal(made.blades, 1);
  assert_int_equal(made.count[CW_ROLE_BLADE], 0);
}

// A disc of water behind the wheel has no opening, round though it is.
static void side_chambers_have_no_opening(void **) {
  SmallParts small({{"rotor", small_rotor()},
                    {"stator", small_stator()},
                    {"chamber", BRepAlgoAPI_Cut(small_cylinder(6, 48, 4), small_cylinder(6, 10, 4)).Shape()}});
  const Proposed made = propose(small);
  assert_int_equal(made.count[CW_ROLE_INLET], 1);
  assert_int_equal(made.count[CW_ROLE_OUTLET], 1);
}

// Five of six blades: nothing comes to itself.
static void a_missing_blade_is_seen(void **) {
  TopoDS_Shape water = small_cylinder(-5, 50, 10);
  for (int k = 0; k < 5; k++) {
    gp_Trsf turn;
    turn.SetRotation(gp::OZ(), k * M_PI / 3);
    const TopoDS_Shape blade = small_box(25, -1.5, -20, 20, 3, 40);
    water = BRepAlgoAPI_Cut(water, BRepBuilderAPI_Transform(blade, turn, Standard_True).Shape()).Shape();
  }
  SmallParts small({{"rotor", water}});
  assert_int_equal(propose(small).blades, 1);
}

// A pipe that stands still: its ends are openings, its wall is a pipe.
static void pipes_have_two_ends(void **) {
  gp_Trsf aside;
  aside.SetTranslation(gp_Vec(200, 0, 0));
  SmallParts small({{"rotor", small_rotor()},
                    {"pipe", BRepBuilderAPI_Transform(small_cylinder(0, 5, 50), aside, Standard_True).Shape()}});
  const Proposed made = propose(small);
  assert_int_equal(made.count[CW_ROLE_PIPE], 1);
  assert_int_equal(made.count[CW_ROLE_OUTLET], 2);
}

static TopoDS_Shape ring(double z, double within, double radius) {
  return BRepAlgoAPI_Cut(small_cylinder(z, radius, 10), small_cylinder(z - 1, within, 12)).Shape();
}

// Rings about the axis: the ends of one that begins within the wheel are inlets, those of one round it side walls.
static void a_casing_round_the_wheel_has_side_walls(void **) {
  SmallParts small({{"rotor", small_rotor()}, {"suction", ring(200, 20, 40)}});
  const int inlets = propose(small).count[CW_ROLE_INLET];
  SmallParts round({{"rotor", small_rotor()}, {"casing", ring(0, 60, 80)}});
  const Proposed made = propose(round);
  assert_int_equal(made.count[CW_ROLE_INLET], inlets - 2);
  assert_int_equal(made.count[CW_ROLE_OUTLET], 0);
  assert_int_equal(made.count[CW_ROLE_PIPE], 0);
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_wheel_has_hub_shroud_and_blades),
                                     cmocka_unit_test(both_halves_of_a_wheel_have_a_shroud),
                                     cmocka_unit_test(a_disc_has_no_passages),
                                     cmocka_unit_test(a_missing_blade_is_seen),
                                     cmocka_unit_test(side_chambers_have_no_opening),
                                     cmocka_unit_test(pipes_have_two_ends),
                                     cmocka_unit_test(a_casing_round_the_wheel_has_side_walls)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
