// SPDX-License-Identifier: AGPL-3.0-or-later
// A pump of primitives from a B-rep file to its model: seams are divided, the strip of the casing that the wheel's
// outlet leaves free is cut off, patches are proposed by form and place, and what is wrong is told.
#include <cmath>
#include <cstdlib>
#include <string>

#include <BRepBuilderAPI_MakeEdge.hxx>

#include "geometry/cad/cad_pump.h"
#include "pipeline/case_read.h"
#include "cad/small_pump.hpp"

#include "tests/test_folder.h"
#include "tests/unit_test.h"

static std::string folder;
static const double mm = 1e-3;

static CwStatus read_case(const std::string &cad, CwCase *table) {
  const std::string path = folder + "/case.yaml";
  FILE *file = fopen(path.c_str(), "w");
  fprintf(file, "name: small\noperating_point: {flow_rate_m3_per_h: 4, head_m: 2, speed_rpm: 1450}\ncad:\n%s",
          cad.c_str());
  fclose(file);
  return cw_case_read(path.c_str(), table);
}

static const char *const whole = "  files: pump.brep\n"
                                 "  domains:\n"
                                 "    rotor: {inside_mm: [0, 0, -30], rotating: true}\n"
                                 "    stator: {solid: 2}\n";

static double area_of(const CwCadPump &pump, const char *name, CwPatchKind kind) {
  double area = 0;
  for (int i = 0; i < pump.patches.count; i++)
    if (!strcmp(pump.patches.patch[i].name, name) && pump.patches.patch[i].kind == kind)
      area += pump.patches.patch[i].area;
  return area / (mm * mm);
}

// Areas by hand: the wheel's outlet is a cylinder of radius 50 and width 10, the casing's inner wall 16 wide.
static void patches_are_proposed(void **) {
  CwCase table;
  CwCadPump pump = {};
  CwModel model = {};
  if (read_case(whole, &table) || cw_cad_pump_read(table.cad, NULL, &pump) || cw_cad_pump_name(table.cad, &pump) ||
      cw_cad_model_make(&table, &pump.survey, &pump.patches, pump.interface_count, pump.interface, pump.blade_count,
                        cw_cad_parts_unit(pump.parts), &model))
    fail_msg("%s", cw_fail_message());
  assert_int_equal(pump.blade_count, 6);
  assert_near(area_of(pump, "inlet", CW_PATCH_INLET) / (M_PI * 20 * 20), 1, 1e-5);
  assert_near(area_of(pump, "outlet", CW_PATCH_OUTLET) / (20 * 16), 1, 1e-5);
  assert_near(area_of(pump, "rotor_to_stator", CW_PATCH_INTERFACE) / (2 * M_PI * 50 * 10), 1, 1e-5);
  assert_near(area_of(pump, "stator_to_rotor", CW_PATCH_INTERFACE) / (2 * M_PI * 50 * 10), 1, 1e-5);
  assert_near(area_of(pump, "blade", CW_PATCH_WALL) / (6 * (2 * 20 + 2 * 3) * 10), 1, 1e-5);
  assert_near(area_of(pump, "hub", CW_PATCH_WALL) / (M_PI * 50 * 50 - 6 * 20 * 3), 1, 1e-5);
  assert_near(area_of(pump, "shroud", CW_PATCH_WALL) / (M_PI * (50 * 50 - 20 * 20) - 6 * 20 * 3 + 2 * M_PI * 20 * 55),
              1, 1e-5);
  assert_int_equal(model.interface_count, 1);
  assert_int_equal(model.interface[0].surface, CW_SURFACE_CYLINDER);
  assert_near(model.interface[0].radius / (0.05), 1, 1e-5);
  assert_near(model.flow.inlet_speed / (4. / 3600 / (M_PI * 0.02 * 0.02)), 1, 1e-5);
  const int blade = cw_model_patch_find(&model, "blade");
  assert_int_equal(model.patch[blade].group, CW_GROUP_BLADE);
  assert_int_equal(model.patch[blade].turns, 1);
  cw_model_free(&model);
  cw_cad_pump_free(&pump);
  cw_case_free(&table);
}

// Water from both sides, and no shaft: it reaches along the whole axis.
static void wheels_with_two_eyes_need_no_shaft(void **) {
  CwCase table;
  CwCadPump pump = {};
  CwModel model = {};
  std::string eyes(whole);
  eyes.replace(eyes.find("pump.brep"), 9, "eyes.brep");
  if (read_case(eyes, &table) || cw_cad_pump_read(table.cad, NULL, &pump) || cw_cad_pump_name(table.cad, &pump) ||
      cw_cad_model_make(&table, &pump.survey, &pump.patches, pump.interface_count, pump.interface, pump.blade_count,
                        cw_cad_parts_unit(pump.parts), &model))
    fail_msg("%s", cw_fail_message());
  assert_int_equal(pump.blade_count, 6);
  assert_near(area_of(pump, "inlet", CW_PATCH_INLET) / (2 * M_PI * 20 * 20), 1, 1e-5);
  assert_near(area_of(pump, "blade", CW_PATCH_WALL) / (6 * (2 * 20 + 2 * 3) * 10), 1, 1e-5);
  assert_near(area_of(pump, "shroud", CW_PATCH_WALL) /
                  (2 * (M_PI * (50 * 50 - 20 * 20) - 6 * 20 * 3 + 2 * M_PI * 20 * 55)),
              1, 1e-5);
  assert_true(area_of(pump, "hub", CW_PATCH_WALL) == 0);
  assert_near(model.flow.inlet_diameter / 0.04, 1, 1e-5);
  cw_model_free(&model);
  cw_cad_pump_free(&pump);
  cw_case_free(&table);
}

// Round posts for blades, the seam of each elsewhere: the pieces that they are divided into are no periodic images.
static TopoDS_Shape with_posts(TopoDS_Shape water) {
  for (int k = 0; k < 6; k++) {
    const double at = k * M_PI / 3, seam = 0.7 * k;
    const gp_Ax2 place(gp_Pnt(35 * std::cos(at), 35 * std::sin(at), -20), gp::DZ(),
                       gp_Dir(std::cos(seam), std::sin(seam), 0));
    water = BRepAlgoAPI_Cut(water, BRepPrimAPI_MakeCylinder(place, 3, 40).Shape()).Shape();
  }
  return small_solid_of(water);
}

static void check_posts(const std::string &posts) {
  CwCase table;
  CwCadPump pump = {};
  if (read_case(posts, &table) || cw_cad_pump_read(table.cad, NULL, &pump) || cw_cad_pump_name(table.cad, &pump))
    fail_msg("%s", cw_fail_message());
  assert_int_equal(pump.blade_count, 6);
  assert_near(area_of(pump, "blade", CW_PATCH_WALL) / (6 * 2 * M_PI * 3 * 10), 1, 1e-5);
  assert_true(area_of(pump, "rotor_wall", CW_PATCH_WALL) == 0);
  cw_cad_pump_free(&pump);
  cw_case_free(&table);
}

static void pieces_of_blades_are_blades(void **) {
  std::string posts(whole);
  posts.replace(posts.find("pump.brep"), 9, "posts.brep");
  check_posts(posts);
}

// Five lengths of pipe and the wheel, fused: the wheel's faces have greater numbers in the file than there are faces.
static void numbers_of_fused_solids_may_be_great(void **) {
  check_posts("  files: lengths.brep\n  domains:\n    stator: {solid: 1}\n"
              "    rotor: {solid: [2, 3, 4, 5, 6, 7], rotating: true}\n");
}

// The first rule that takes a face has it; a point chooses one; a number is that of the sheet.
static void rules_name_patches(void **) {
  CwCase table;
  CwCadPump pump = {};
  const std::string rules = std::string(whole) + "  patches:\n"
                                                 "    suction: {near_mm: [0, 0, -60], kind: inlet}\n"
                                                 "    back: {near_mm: [47, 0, 5], walls: hub_shroud, y_plus: 5}\n"
                                                 "    again: {faces: '*', domain: rotor}\n";
  if (read_case(rules, &table) || cw_cad_pump_read(table.cad, NULL, &pump) || cw_cad_pump_name(table.cad, &pump))
    fail_msg("%s", cw_fail_message());
  assert_near(area_of(pump, "suction", CW_PATCH_INLET) / (M_PI * 20 * 20), 1, 1e-5);
  assert_near(area_of(pump, "back", CW_PATCH_WALL) / (M_PI * 50 * 50 - 6 * 20 * 3), 1, 1e-5);
  assert_near(area_of(pump, "again", CW_PATCH_INTERFACE) / (2 * M_PI * 50 * 10), 1, 1e-5);
  assert_true(area_of(pump, "stator_wall", CW_PATCH_WALL) > 0);
  cw_cad_pump_free(&pump);
  cw_case_free(&table);
}

static void wrong_input_is_told(void **) {
  static const struct {
    const char *cad, *message;
  } wrong[] = {
      {"  files: none.brep\n  domains: {rotor: {solid: 1, rotating: true}}\n", "none.brep: cannot be read"},
      {"  files: case.yaml\n  domains: {rotor: {solid: 1, rotating: true}}\n", "is neither STEP nor a B-rep"},
      {"  files: pump.brep\n  domains: {rotor: {solid: wheel, rotating: true}}\n", "'wheel' matches no solid"},
      {"  files: pump.brep\n  domains: {rotor: {solid: 1}}\n", "none rotates"},
      {"  files: pump.brep\n  domains: {rotor: {solid: 1, rotating: true}, stator: {solid: 1}}\n",
       "belongs to cad.domains.rotor"},
      {"  files: pump.brep\n  domains: {rotor: {inside_mm: [0, 0, 300], rotating: true}}\n", "lies in 0 solids"},
      {"  files: pump.brep\n  unit_m: 1\n  domains: {rotor: {solid: 1, rotating: true}, stator: {solid: 2}}\n",
       "a diameter of 100 m"},
      {"  files: pump.brep\n  axis: {point_mm: [3, 0, 0]}\n  domains: {rotor: {solid: 1, rotating: true}, stator: "
       "{solid: 2}}\n",
       "no surface of revolution about the axis"},
      {"  files: pump.brep\n  domains: {rotor: {solid: 1, rotating: true}, stator: {solid: 2}}\n  patches: {wall: "
       "{faces: WALL*}}\n",
       "cad.patches.wall.faces: 'WALL*' matches no face"},
      {"  files: pump.brep\n  domains: {rotor: {solid: 1, rotating: true}, stator: {solid: 2}}\n  patches: {lid: "
       "{colour: '#00ff00'}}\n",
       "cad.patches.lid.colour: no face has its colour"},
      {"  files: apart.brep\n  domains: {rotor: {solid: 1, rotating: true}, stator: {solid: 2}}\n",
       "a gap or an overlap of 0.02"},
      {"  files: line.brep\n  domains: {rotor: {solid: 1, rotating: true}}\n", "line.brep: holds no solid and no face"},
      {"  files: shell.brep\n  domains: {rotor: {solid: 1, rotating: true}}\n",
       "shell.brep: holds no solid, and its 4 faces do not close"},
      {"  files: pump.brep\n  domains: {rotor: {solid: 1, rotating: true}, stator: {solid: 2, rotating: true}}\n",
       "cad.domains: all rotate, stator too"},
      {"  files: pump.brep\n  domains: {rotor: {solid: 1, rotating: true}, stator: {solid: 2}}\n  patches: {back: "
       "{near_mm: [0, 20, -60]}}\n",
       "cad.patches.back.near_mm: (0, 20, -60) lies as near to another face"},
      {"  files: pump.brep\n  cut: {radius_mm: 300}\n  domains: {rotor: {solid: 1, rotating: true}, stator: {solid: "
       "2}}\n",
       "cad.cut: the surface parts no solid of"},
  };
  for (const auto &at : wrong) {
    CwCase table = {};
    CwCadPump pump = {};
    CwModel model = {};
    CwStatus status = read_case(at.cad, &table);
    if (status == CW_OK) status = cw_cad_pump_read(table.cad, NULL, &pump);
    if (status == CW_OK) status = cw_cad_pump_name(table.cad, &pump);
    if (status == CW_OK)
      status = cw_cad_model_make(&table, &pump.survey, &pump.patches, pump.interface_count, pump.interface,
                                 pump.blade_count, cw_cad_parts_unit(pump.parts), &model);
    assert_int_not_equal(status, CW_OK);
    if (!strstr(cw_fail_message(), at.message)) fail_msg("'%s' has no '%s'", cw_fail_message(), at.message);
    cw_model_free(&model);
    cw_cad_pump_free(&pump);
    cw_case_free(&table);
  }
}

static int make_files(void **) {
  if (make_test_folder(nullptr)) return -1;
  folder = test_folder;
  const TopoDS_Shape rotor = small_rotor(), stator = small_stator();
  const auto length = [](int number) { return small_cylinder(-60 + 11 * number, 20, 11); };
  const TopoDS_Shape disc = small_cylinder(-5, 50, 10),
                     wheel = BRepAlgoAPI_Fuse(disc, small_cylinder(-60, 20, 55)).Shape();
  small_write(folder + "/posts.brep", {with_posts(wheel), stator});
  small_write(folder + "/lengths.brep",
              {stator, length(0), length(1), length(2), length(3), length(4), with_posts(disc)});
  gp_Trsf wider;
  wider.SetScale(gp::Origin(), 50.02 / 50);
  small_write(folder + "/pump.brep", {rotor, stator});
  small_write(folder + "/eyes.brep", {small_rotor(2), stator});
  small_write(folder + "/line.brep", {BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(1, 0, 0)).Shape()});
  BRep_Builder builder;
  TopoDS_Compound open;
  builder.MakeCompound(open);
  for (TopExp_Explorer at(BRepPrimAPI_MakeBox(10, 20, 30).Shape(), TopAbs_FACE); at.More(); at.Next())
    builder.Add(open, at.Current());
  TopExp_Explorer lid(open, TopAbs_FACE);
  const TopoDS_Shape first = lid.Current();
  lid.Next();
  const TopoDS_Shape second = lid.Current();
  builder.Remove(open, first);
  builder.Remove(open, second);
  small_write(folder + "/shell.brep", {open});
  small_write(folder + "/apart.brep", {rotor, BRepBuilderAPI_Transform(stator, wider, Standard_True).Shape()});
  return 0;
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(patches_are_proposed),        cmocka_unit_test(wheels_with_two_eyes_need_no_shaft),
      cmocka_unit_test(pieces_of_blades_are_blades), cmocka_unit_test(numbers_of_fused_solids_may_be_great),
      cmocka_unit_test(rules_name_patches),          cmocka_unit_test(wrong_input_is_told)};
  return cmocka_run_group_tests(tests, make_files, clear_test_folder);
}
