// SPDX-License-Identifier: AGPL-3.0-or-later
// The stage writes what later stages and people read; where it fails it leaves the sheet, or the place of the fault.
#include <filesystem>
#include <fstream>
#include <iterator>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <gp_Pln.hxx>

#include "cad/small_parts.hpp"
#include "tests/test_folder.h"

extern "C" {
#include "geometry/cad/cad_stage.h"
#include "pipeline/case_read.h"
}

static std::string folder;

// `anew`: into an empty folder, not into that of the run before.
static CwStatus run(const std::string &cad, bool anew = true) {
  CwStatus status = CW_OK;
  CwCase table = {};
  CwRecord *record = nullptr;
  CwStageArgs args = {};
  const std::string path = folder + "/case.yaml";
  args.case_path = path.c_str();
  args.run_path = folder.c_str();
  if (anew) std::filesystem::remove_all(folder + "/geometry");
  std::filesystem::create_directory(folder + "/geometry");
  std::ofstream(path) << "name: small\noperating_point: {flow_rate_m3_per_h: 4, head_m: 2, speed_rpm: 1450}\ncad:\n"
                      << cad;
  CW_TRY(cw_case_read(path.c_str(), &table));
  CW_TRY(cw_record_start("geometry", NULL, &record));
  CW_TRY(cw_cad_stage(&args, &table, record));
  CW_TRY(cw_record_write(record, (folder + "/geometry/record.json").c_str()));
done:
  cw_record_free(record);
  cw_case_free(&table);
  return status;
}

static bool is_there(const char *name) {
  return std::filesystem::exists(folder + "/geometry/" + name);
}

static const char *const whole =
    "  files: pump.brep\n  domains: {rotor: {solid: 1, rotating: true}, stator: {solid: 2}}\n";

static bool record_says(const char *text) {
  std::ifstream in(folder + "/geometry/record.json");
  return std::string(std::istreambuf_iterator<char>(in), {}).find(text) != std::string::npos;
}

static void all_files_are_written(void **) {
  if (run(whole)) fail_msg("%s", cw_fail_message());
  for (const char *name : {"rotor.brep", "stator.brep", "faces.csv", "faces_sheet.csv", "model.json", "pump.step",
                           "faces_rotor.svg", "faces_stator.svg"})
    if (!is_there(name)) fail_msg("%s is missing", name);
  assert_false(is_there("fault.svg"));
  assert_true(record_says("\"inputs\": {"));
  assert_true(record_says("/pump.brep\": \""));
}

// The small pump's inlet lies at z = -60 mm; about the axis that runs the other way at 60 mm.
static void the_suction_side_follows_the_axis(void **) {
  if (run(whole)) fail_msg("%s", cw_fail_message());
  assert_true(record_says("\"suction_side\": -1"));
  if (run(std::string("  axis: {direction: [0, 0, -1]}\n") + whole)) fail_msg("%s", cw_fail_message());
  assert_true(record_says("\"suction_side\": 1"));
}

static void the_sheet_is_there_where_a_rule_fails(void **) {
  assert_int_equal(run(std::string(whole) + "  patches: {blade: {faces: PS*}}\n"), CW_ERR_INPUT);
  assert_true(is_there("faces_sheet.csv"));
  assert_true(is_there("faces_rotor.svg"));
  assert_false(is_there("model.json"));
}

static void the_place_of_a_fault_is_drawn(void **) {
  assert_int_equal(run("  files: open.brep\n  domains: {rotor: {solid: 1, rotating: true}}\n"), CW_ERR_GEOMETRY);
  assert_non_null(strstr(cw_fail_message(), "cad.domains.rotor: the solid cannot be healed"));
  assert_true(is_there("fault.svg"));
  assert_false(is_there("faces_sheet.csv"));
  assert_int_equal(run(whole, false), CW_OK);
  assert_false(is_there("fault.svg"));
}

// Ends whose outlines cross have no triangles: their edges are drawn, and the place of the open side is marked.
static void the_edges_of_a_bad_face_are_drawn(void **) {
  assert_int_equal(run("  files: tie.brep\n  domains: {rotor: {solid: 1, rotating: true}}\n"), CW_ERR_GEOMETRY);
  assert_non_null(strstr(cw_fail_message(), "the solid cannot be healed"));
  assert_non_null(strstr(cw_fail_message(), "mm: solid 1 of "));
  assert_true(is_there("fault.svg"));
}

// A prism over a bow tie that lacks a side.
static TopoDS_Shape open_tie() {
  BRepBuilderAPI_MakePolygon outline(gp_Pnt(-50, -20, 0), gp_Pnt(50, 20, 0), gp_Pnt(50, -20, 0), gp_Pnt(-50, 20, 0),
                                     Standard_True);
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), outline.Wire(), Standard_False).Face();
  BRep_Builder builder;
  TopoDS_Shell shell;
  TopoDS_Solid solid;
  builder.MakeShell(shell);
  bool lacks = false;
  for (TopExp_Explorer at(BRepPrimAPI_MakePrism(face, gp_Vec(0, 0, 10)).Shape(), TopAbs_FACE); at.More(); at.Next()) {
    const std::array<double, 6> box = cw_cad_box(at.Current());
    if (lacks || box[5] - box[2] < 5)
      builder.Add(shell, at.Current());
    else
      lacks = true;
  }
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  return solid;
}

// A disc that lacks a lid, as a solid.
static TopoDS_Shape open_disc() {
  const TopTools_IndexedMapOfShape map = cw_cad_faces(small_cylinder(0, 50, 10));
  BRep_Builder builder;
  TopoDS_Shell shell;
  TopoDS_Solid solid;
  builder.MakeShell(shell);
  builder.Add(shell, map(1));
  builder.Add(shell, map(2));
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  return solid;
}

static int make_files(void **) {
  if (make_test_folder(nullptr)) return -1;
  folder = test_folder;
  small_write(folder + "/pump.brep", {small_rotor(), small_stator()});
  small_write(folder + "/open.brep", {open_disc()});
  small_write(folder + "/tie.brep", {open_tie()});
  return 0;
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(all_files_are_written), cmocka_unit_test(the_suction_side_follows_the_axis),
      cmocka_unit_test(the_sheet_is_there_where_a_rule_fails), cmocka_unit_test(the_place_of_a_fault_is_drawn),
      cmocka_unit_test(the_edges_of_a_bad_face_are_drawn)};
  return cmocka_run_group_tests(tests, make_files, clear_test_folder);
}
