// SPDX-License-Identifier: AGPL-3.0-or-later
// The model of the small pump: speeds from the operating point by hand, groups, what turns, shares of the outlets and
// of several wheels (cad_wheel); and what is refused.
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <TColgp_HArray1OfPnt.hxx>

#include "cad/small_parts.hpp"

extern "C" {
#include "geometry/cad/cad_model.h"
}

static const double mm = 1e-3;

struct Made : SmallParts {
  CwCase table = {};
  CwFaceRole *role = nullptr;
  CwFacePatches patches = {};
  CwCadInterface *interfaces = nullptr;
  CwModel model = {};
  int interface_count = 0, blades = 0;

  explicit Made(const std::initializer_list<std::pair<const char *, TopoDS_Shape>> &solids) : SmallParts(solids) {
    table.cad = &cad;
    table.operating_point.flow_rate = 4. / 3600;
    table.operating_point.head = 2;
    table.operating_point.speed = 150;
  }
  ~Made() {
    free(role);
    free(interfaces);
    cw_face_patches_free(&patches);
    cw_model_free(&model);
  }
  CwStatus make() {
    CwStatus status = CW_OK;
    CW_TRY(look_imprinted());
    role = (CwFaceRole *)calloc(survey.face_count, sizeof *role);
    CW_TRY(cw_proposal_make(&survey, contact, rotating, role, &blades));
    CW_TRY(cw_face_patches_make(&cad, &small_frame, &parts, &survey, contact, role, small_tolerance, &patches));
    CW_TRY(cw_cad_interfaces_make(&cad, &survey, contact, &patches, small_tolerance, &interface_count, &interfaces));
    CW_TRY(cw_cad_model_make(&table, &survey, &patches, interface_count, interfaces, blades, 1e-3, &model));
  done:
    return status;
  }
  const CwModelPatch &patch(const char *name) const {
    const int found = cw_model_patch_find(&model, name);
    if (found < 0) fail_msg("no patch %s", name);
    return model.patch[found];
  }
};

static void speeds_follow_from_the_operating_point(void **) {
  Made made({{"rotor", small_rotor()}, {"stator", small_stator()}});
  if (made.make()) fail_msg("%s", cw_fail_message());
  // Blades end at hypot(45, 1.5) mm, the interface stands at 50 mm and is 10 mm wide.
  const double r2 = std::hypot(45, 1.5) * mm, u2 = 150 * r2, flow = 4. / 3600;
  const double swirl = 9.80665 * 2 / (0.85 * u2), meridional = flow / (2 * M_PI * r2 * 10 * mm);
  const double w2 = std::hypot(u2 - swirl, meridional), before = flow / (M_PI * 400 * mm * mm);
  const double w1 = std::hypot(150 * 20 * mm, before);
  assert_near(made.patch("blade").flow.speed, (w1 + w2) / 2, 1e-5);
  assert_near(made.patch("hub").flow.speed, (w1 + w2) / 2, 1e-5);
  // Of the vortex even at 50 mm, but no slower than the outlet.
  const double after = flow / (320 * mm * mm);
  assert_true(swirl * r2 / (50 * mm) < after);
  assert_near(made.patch("stator_wall").flow.speed, after, 1e-5);
  assert_near(made.patch("stator_pipe").flow.speed, flow / (320 * mm * mm), 1e-5);
  assert_near(made.patch("blade").flow.width, 2 * M_PI * r2 / 6 * meridional / w2, 1e-7); // less than 10 mm
  assert_int_equal(made.patch("blade").group, CW_GROUP_BLADE);
  assert_int_equal(made.patch("shroud").group, CW_GROUP_HUB_SHROUD);
  assert_int_equal(made.patch("stator_wall").group, CW_GROUP_VOLUTE);
  assert_int_equal(made.patch("stator_pipe").group, CW_GROUP_PIPE);
  assert_int_equal(made.patch("hub").turns, 1);
  assert_int_equal(made.patch("stator_wall").turns, 0);
  assert_near(made.patch("outlet").flow_share, 1, 1e-9);
  assert_int_equal(made.model.flow.blade_count, 6);
  assert_near(made.model.flow.reference_length, 2 * r2, 1e-6);
}

// Each of two eyes is as wide as its pipe, and takes half of the flow.
static void each_eye_has_its_own_width(void **) {
  Made made({{"rotor", small_rotor(2)}, {"stator", small_stator()}});
  if (made.make()) fail_msg("%s", cw_fail_message());
  const double r2 = std::hypot(45, 1.5) * mm, u2 = 150 * r2, flow = 4. / 3600;
  const double swirl = 9.80665 * 2 / (0.85 * u2), meridional = flow / (2 * M_PI * r2 * 10 * mm);
  const double w2 = std::hypot(u2 - swirl, meridional), before = flow / 2 / (M_PI * 400 * mm * mm);
  assert_near(made.patch("blade").flow.speed, (std::hypot(150 * 20 * mm, before) + w2) / 2, 1e-5);
  assert_near(made.model.flow.inlet_speed, before, 1e-5);
  assert_near(made.model.flow.inlet_diameter, 40 * mm, 1e-6);
}

// A shorter blade between each two: the passages stay six, and at the outlet they are half as wide.
static void splitters_halve_the_pitch(void **) {
  TopoDS_Shape water = small_rotor();
  for (int k = 0; k < 6; k++) {
    gp_Trsf turn;
    turn.SetRotation(gp::OZ(), (k + 0.5) * M_PI / 3);
    const TopoDS_Shape splitter = small_box(35, -1.5, -20, 10, 3, 40);
    water = BRepAlgoAPI_Cut(water, BRepBuilderAPI_Transform(splitter, turn, Standard_True).Shape()).Shape();
  }
  Made made({{"rotor", water}, {"stator", small_stator()}});
  Made without({{"rotor", small_rotor()}, {"stator", small_stator()}});
  if (made.make() || without.make()) fail_msg("%s", cw_fail_message());
  assert_int_equal(made.model.flow.blade_count, 6);
  assert_near(made.patch("blade").flow.width, without.patch("blade").flow.width / 2, 1e-7);
}

// Two wheels back to back on one disc: their blades, twelve in all, are six at each outlet.
static void halves_of_a_wheel_have_their_own_blades(void **) {
  TopoDS_Shape water = small_rotor();
  water = BRepAlgoAPI_Cut(water, BRepAlgoAPI_Cut(small_cylinder(-1, 48, 2), small_cylinder(-2, 22, 4)).Shape()).Shape();
  Made made({{"rotor", water}, {"stator", small_stator()}});
  Made without({{"rotor", small_rotor()}, {"stator", small_stator()}});
  if (made.make() || without.make()) fail_msg("%s", cw_fail_message());
  assert_int_equal(made.model.flow.blade_count, 6);
  assert_near(made.patch("blade").flow.width, without.patch("blade").flow.width, 1e-7);
}

// Of a greater head in half the flow the vortex is the faster.
static void the_spiral_has_a_free_vortex(void **) {
  Made made({{"rotor", small_rotor()}, {"stator", small_stator()}});
  made.table.operating_point.head = 3;
  made.table.operating_point.flow_rate = 2. / 3600;
  if (made.make()) fail_msg("%s", cw_fail_message());
  const double r2 = std::hypot(45, 1.5) * mm, swirl = 9.80665 * 3 / (0.85 * 150 * r2);
  double area = 0, moment = 0; // of the casing's walls
  for (int f = 0; f < made.survey.face_count; f++) {
    const CwModelPatch &patch = made.patch(made.patches.patch[made.patches.of_face[f]].name);
    if (patch.kind != CW_PATCH_WALL || patch.group != CW_GROUP_VOLUTE) continue;
    area += made.survey.face[f].area;
    moment += made.survey.face[f].area * made.survey.face[f].mean_radius;
  }
  assert_true(moment / area > 60 * mm && moment / area < 85 * mm);
  assert_near(made.patch("stator_wall").flow.speed, swirl * r2 * (1 / (50 * mm) + area / moment) / 2, 1e-5);
}

// The back of the wheel as a patch of this name, of which the case says nothing more.
static CwCadPatch back_as(const char *name) {
  static double point[][3] = {{47 * mm, 0, 5 * mm}};
  CwCadPatch rule = {};
  strcpy(rule.name, name);
  rule.near = {1, point};
  rule.y_plus = rule.velocity = NAN;
  rule.colour = rule.turns = rule.monitored = -1;
  return rule;
}

// What the case says of a patch goes before what is measured.
static void rules_go_before(void **) {
  Made made({{"rotor", small_rotor()}, {"stator", small_stator()}});
  CwCadPatch rule = back_as("back");
  rule.walls = CW_CAD_WALLS_PIPE;
  rule.y_plus = 3;
  rule.velocity = 9;
  rule.turns = 0;
  rule.monitored = 1;
  made.cad.patch = &rule;
  made.cad.patch_count = 1;
  if (made.make()) fail_msg("%s", cw_fail_message());
  const CwModelPatch &patch = made.patch("back");
  assert_int_equal(patch.group, CW_GROUP_PIPE);
  assert_near(patch.flow.speed, 9, 0);
  assert_near(patch.y_plus_asked, 3, 0);
  assert_int_equal(patch.turns, 0);
  assert_int_equal(patch.monitored, 1);
}

// Names of generated walls go before form and place: the back of the wheel as a pipe that stands still.
static void names_are_those_of_generated_walls(void **) {
  Made made({{"rotor", small_rotor()}, {"stator", small_stator()}});
  CwCadPatch rule = back_as("suction_pipe");
  made.cad.patch = &rule;
  made.cad.patch_count = 1;
  if (made.make()) fail_msg("%s", cw_fail_message());
  const CwModelPatch &patch = made.patch("suction_pipe");
  assert_int_equal(patch.group, CW_GROUP_PIPE);
  assert_int_equal(patch.size, CW_GROUP_PIPE);
  assert_near(patch.flow.speed, 4. / 3600 / (M_PI * 400 * mm * mm), 1e-5);
  assert_int_equal(patch.turns, 0);
  assert_int_equal(patch.monitored, 0);
}

// A name that begins as one of the wheel's does says nothing: the casing's side is a wall of the casing.
static void beginnings_of_names_say_nothing(void **) {
  static double point[][3] = {{-65 * mm, 0, 8 * mm}};
  Made made({{"rotor", small_rotor()}, {"stator", small_stator()}});
  CwCadPatch rule = back_as("hub_seal_pipe");
  rule.near = {1, point};
  made.cad.patch = &rule;
  made.cad.patch_count = 1;
  if (made.make()) fail_msg("%s", cw_fail_message());
  assert_int_equal(made.patch("hub_seal_pipe").group, CW_GROUP_VOLUTE);
}

// A side of the casing as a wall of the wheel's kind, by name or by `walls`: its group is that, its flow the spiral's.
static void blades_that_stand_still_have_the_flow_of_a_spiral(void **) {
  double point[][3] = {{-65 * mm, 0, 8 * mm}};
  for (const char *name : {"blade_pressure", "side"}) {
    Made made({{"rotor", small_rotor()}, {"stator", small_stator()}});
    CwCadPatch rule = back_as(name);
    rule.near = {1, point};
    if (!strcmp(name, "side")) rule.walls = CW_CAD_WALLS_BLADE;
    made.cad.patch = &rule;
    made.cad.patch_count = 1;
    if (made.make()) fail_msg("%s", cw_fail_message());
    assert_int_equal(made.patch(name).group, CW_GROUP_BLADE);
    assert_near(made.patch(name).flow.speed, made.patch("stator_wall").flow.speed, 0);
    assert_true(std::fabs(made.patch(name).flow.speed - made.patch("blade").flow.speed) > 0.1);
  }
}

// One side of an interface as two patches, the greater above or below.
static void interfaces_of_three_patches_are_told(void **) {
  for (const double y : {3, 7}) {
    const TopoDS_Shape halves = BRepAlgoAPI_Fuse(small_box(0, 0, 0, 10, y, 10), small_box(0, y, 0, 10, 10 - y, 10));
    Made made({{"a", halves}, {"b", small_box(10, 0, 0, 5, 10, 10)}});
    double point[][3] = {{10 * mm, (y + 10) / 2 * mm, 5 * mm}};
    CwCadPatch rule = back_as("upper");
    rule.near = {1, point};
    strcpy(rule.domain, "a");
    made.cad.patch = &rule;
    made.cad.patch_count = 1;
    made.cad.domain[0].rotating = made.rotating[0] = 0;
    assert_int_equal(made.make(), CW_ERR_INPUT);
    if (!strstr(cw_fail_message(), "cad.patches: patch b_to_a touches both ")) fail_msg("%s", cw_fail_message());
  }
}

// A second outlet, a side of the casing's ring but for its pipe: the flow leaves by both in the ratio of their areas.
static void outlets_share_the_flow(void **) {
  Made made({{"rotor", small_rotor()}, {"stator", small_stator()}});
  static double side[][3] = {{-65 * mm, 0, 8 * mm}};
  CwCadPatch rule = back_as("drain");
  rule.near = {1, side};
  rule.kind = CW_CAD_KIND_OUTLET;
  made.cad.patch = &rule;
  made.cad.patch_count = 1;
  if (made.make()) fail_msg("%s", cw_fail_message());
  const double pipe = 320 * mm * mm;
  double drain = 0;
  for (int f = 0; f < made.survey.face_count; f++)
    if (!strcmp(made.patches.patch[made.patches.of_face[f]].name, "drain")) drain += made.survey.face[f].area;
  assert_true(drain > 9000 * mm * mm && drain < 15000 * mm * mm);
  assert_near(made.patch("outlet").flow_share, pipe / (pipe + drain), 1e-9);
  assert_near(made.patch("drain").flow_share, drain / (pipe + drain), 1e-9);
}

// A disc of the wheel's width whose rim is a spline through 24 points of radius 50 and a wave on it.
static TopoDS_Shape spline_disc(double wave) {
  const int count = 24;
  const Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, count);
  for (int i = 0; i < count; i++) {
    const double angle = 2 * M_PI * i / count, r = 50 + wave * std::cos(5 * angle);
    points->SetValue(i + 1, gp_Pnt(r * std::cos(angle), r * std::sin(angle), -5));
  }
  GeomAPI_Interpolate spline(points, Standard_True, 1e-9);
  spline.Perform();
  const TopoDS_Edge rim = BRepBuilderAPI_MakeEdge(spline.Curve()).Edge();
  const TopoDS_Face base = BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(rim).Wire()).Face();
  return BRepPrimAPI_MakePrism(base, gp_Vec(0, 0, 10)).Shape();
}

// Normals of a spline waver by more than those of a cylinder, its points by less than 0.001 mm.
static void interfaces_may_be_splines(void **) {
  for (const double wave : {0.0, 0.05}) {
    const TopoDS_Shape disc = spline_disc(wave), pipe = small_box(0, 55, -5, 150, 20, 10),
                       around = BRepAlgoAPI_Fuse(small_cylinder(-5, 80, 10), pipe).Shape();
    Made made({{"rotor", BRepAlgoAPI_Fuse(disc, small_cylinder(-60, 20, 55)).Shape()},
               {"stator", BRepAlgoAPI_Cut(around, disc).Shape()}});
    const CwStatus status = made.make();
    int touching = 0;
    for (int f = 0; f < made.survey.face_count; f++) {
      if (made.contact[f].part < 0) continue;
      touching++;
      assert_false(made.survey.face[f].turned);
    }
    assert_int_equal(touching, 2);
    if (wave == 0 && status) fail_msg("%s", cw_fail_message());
    if (wave == 0) continue;
    assert_int_equal(status, CW_ERR_GEOMETRY);
    assert_non_null(strstr(cw_fail_message(), "is no surface of revolution about the axis"));
    assert_non_null(strstr(cw_fail_message(), "within cad.tolerance_mm, 0.01"));
  }
}

// A block in a fork, as a wheel whose two eyes are flat: no one plane holds both sides of it.
static void two_planes_are_no_plane(void **) {
  const TopoDS_Shape leg = small_box(-5, 0, 0, 5, 15, 10), bridge = small_box(0, 12, 0, 10, 3, 10);
  const TopoDS_Shape fork = BRepAlgoAPI_Fuse(BRepAlgoAPI_Fuse(leg, bridge), small_box(10, 0, 0, 5, 15, 10)).Shape();
  for (const TopoDS_Shape &around : {leg, fork}) {
    Made made({{"a", small_box(0, 0, 0, 10, 10, 10)}, {"b", around}});
    made.cad.domain[0].rotating = made.rotating[0] = 0;
    assert_int_not_equal(made.make(), CW_OK); // for lack of a wheel
    assert_int_equal(made.interface_count, 1);
    assert_int_equal(made.interfaces[0].surface, around.IsSame(leg) ? CW_SURFACE_PLANE : CW_SURFACE_OTHER);
    assert_true(made.interfaces[0].flat);
  }
}

// A wheel as small_rotor(), by `factor` as large, 200 mm above.
static TopoDS_Shape raised(const TopoDS_Shape &shape, double factor) {
  gp_Trsf larger, up;
  larger.SetScale(gp::Origin(), factor);
  up.SetTranslation(gp_Vec(0, 0, 200));
  return BRepBuilderAPI_Transform(shape, up * larger, Standard_True).Shape();
}

// Two stages: what leads from the first wheel's outlet to the eye of the second, 0.8 as large, touches both.
static void wheels_have_their_own_radii(void **) {
  const TopoDS_Shape can = BRepAlgoAPI_Cut(small_cylinder(-8, 80, 160), small_cylinder(-8, 50, 108)).Shape(),
                     crossover = BRepAlgoAPI_Cut(can, small_cylinder(-8, 55, 2)).Shape();
  Made made({{"first", small_rotor()},
             {"crossover", crossover},
             {"second", raised(small_rotor(), 0.8)},
             {"casing", raised(small_stator(), 0.8)}});
  made.cad.domain[2].rotating = made.rotating[2] = 1;
  if (made.make()) fail_msg("%s", cw_fail_message());
  assert_near(made.patch("blade").flow.length, 1.2 * 50 * mm, 1e-7);
  assert_near(made.patch("blade_2").flow.length, 1.2 * 40 * mm, 1e-7);
  assert_near(made.patch("casing_wall").flow.length, 3 * 40 * mm, 1e-7);
  // Both have all the flow, and of the head 2 m in the ratio of the squares of their radii.
  const double flow = 4. / 3600, w1 = std::hypot(150 * 20 * mm, flow / (M_PI * 400 * mm * mm));
  for (const double factor : {1.0, 0.8}) {
    const double r2 = factor * std::hypot(45, 1.5) * mm, u2 = 150 * r2;
    const double swirl = 9.80665 * 2 * factor * factor / (1 + 0.64) / (0.85 * u2);
    const double w2 = std::hypot(u2 - swirl, flow / (2 * M_PI * r2 * factor * 10 * mm));
    assert_near(made.patch(factor == 1 ? "blade" : "blade_2").flow.speed, (w1 + w2) / 2, 1e-5);
  }
}

// A disc of metal in the casing, its shaft's end an inlet: all of its other faces touch the water.
static void wheels_without_walls_are_told(void **) {
  const TopoDS_Shape disc = BRepAlgoAPI_Fuse(small_cylinder(-5, 50, 10), small_cylinder(-60, 20, 55)).Shape(),
                     can = BRepAlgoAPI_Fuse(small_cylinder(-60, 80, 80), small_box(0, 55, -8, 150, 20, 16)).Shape();
  Made made({{"rotor", disc}, {"stator", BRepAlgoAPI_Cut(can, disc).Shape()}});
  double point[][3] = {{0, 0, -60 * mm}};
  CwCadPatch rule = back_as("inlet");
  rule.near = {1, point};
  rule.kind = CW_CAD_KIND_INLET;
  made.cad.patch = &rule;
  made.cad.patch_count = 1;
  assert_int_equal(made.make(), CW_ERR_GEOMETRY);
  if (!strstr(cw_fail_message(), "cad.domains.rotor.inside_mm: its solid has no wall"))
    fail_msg("%s", cw_fail_message());
}

// The eye drawn as a wall: the water that is in the wheel cannot come from anywhere.
static void wheels_with_one_opening_are_told(void **) {
  double point[][3] = {{0, 10 * mm, -60 * mm}}, side[][3] = {{-65 * mm, 0, 8 * mm}};
  Made made({{"rotor", small_rotor()}, {"stator", small_stator()}});
  CwCadPatch rules[] = {back_as("lid"), back_as("feed")};
  rules[0].near = {1, point};
  rules[0].kind = CW_CAD_KIND_WALL;
  rules[1].near = {1, side};
  rules[1].kind = CW_CAD_KIND_INLET;
  made.cad.patch = rules;
  made.cad.patch_count = 2;
  assert_int_equal(made.make(), CW_ERR_GEOMETRY);
  if (!strstr(cw_fail_message(), "cad.domains.rotor: the wheel has one opening alone"))
    fail_msg("%s", cw_fail_message());
}

static void pumps_that_cannot_be_are_told(void **) {
  Made both({{"rotor", small_rotor()}, {"stator", small_stator()}});
  both.cad.domain[1].rotating = both.rotating[1] = 1;
  assert_int_not_equal(both.make(), CW_OK);
  assert_non_null(strstr(cw_fail_message(), "cad."));
  Made high({{"rotor", small_rotor()}, {"stator", small_stator()}});
  high.table.operating_point.head = 50;
  assert_int_equal(high.make(), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "operating_point.head_m: 50 contradicts speed_rpm and the wheel"));
  gp_Trsf aside;
  aside.SetTranslation(gp_Vec(400, 0, 0));
  // A ball of metal beside the pump.
  Made metal({{"rotor", small_rotor()},
              {"stator", small_stator()},
              {"metal", BRepBuilderAPI_Transform(BRepPrimAPI_MakeSphere(20).Shape(), aside, Standard_True).Shape()}});
  assert_int_equal(metal.make(), CW_ERR_GEOMETRY);
  assert_non_null(strstr(cw_fail_message(), "cad.domains.metal: touches no other domain"));
  assert_non_null(strstr(cw_fail_message(), "is it the metal?"));
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(speeds_follow_from_the_operating_point),
                                     cmocka_unit_test(each_eye_has_its_own_width),
                                     cmocka_unit_test(splitters_halve_the_pitch),
                                     cmocka_unit_test(halves_of_a_wheel_have_their_own_blades),
                                     cmocka_unit_test(the_spiral_has_a_free_vortex),
                                     cmocka_unit_test(rules_go_before),
                                     cmocka_unit_test(names_are_those_of_generated_walls),
                                     cmocka_unit_test(beginnings_of_names_say_nothing),
                                     cmocka_unit_test(blades_that_stand_still_have_the_flow_of_a_spiral),
                                     cmocka_unit_test(interfaces_of_three_patches_are_told),
                                     cmocka_unit_test(outlets_share_the_flow),
                                     cmocka_unit_test(interfaces_may_be_splines),
                                     cmocka_unit_test(two_planes_are_no_plane),
                                     cmocka_unit_test(wheels_have_their_own_radii),
                                     cmocka_unit_test(wheels_without_walls_are_told),
                                     cmocka_unit_test(wheels_with_one_opening_are_told),
                                     cmocka_unit_test(pumps_that_cannot_be_are_told)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
