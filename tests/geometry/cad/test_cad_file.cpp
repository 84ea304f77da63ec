// SPDX-License-Identifier: AGPL-3.0-or-later
// STEP written by XCAF and read back: names, colours and layers of faces, placement in an assembly, units; and shells
// that are sewn or left open.
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include <BRepBndLib.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <Bnd_Box.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Writer.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

#include "geometry/cad/cad_file.h"
#include "geometry/cad/cad_part.hpp"
#include "cad/small_pump.hpp"

#include "tests/test_folder.h"
#include "tests/unit_test.h"

// A box of 10 x 20 x 30 as part "water" of an assembly, moved by 100 along x; its first face is named, coloured and in
// two layers.
static void write_step(const std::string &path) {
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument("BinXCAF", document);
  const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(10, 20, 30).Shape();
  const TDF_Label part = shapes->AddShape(box, Standard_False);
  TDataStd_Name::Set(part, "water");
  const TDF_Label face = shapes->AddSubShape(part, cw_cad_faces(box)(1));
  TDataStd_Name::Set(face, "BLADE_PS_1");
  XCAFDoc_DocumentTool::ColorTool(document->Main())
      ->SetColor(face, Quantity_Color(0, 1, 0, Quantity_TOC_sRGB), XCAFDoc_ColorSurf);
  XCAFDoc_DocumentTool::LayerTool(document->Main())->SetLayer(face, "wet");
  XCAFDoc_DocumentTool::LayerTool(document->Main())->SetLayer(face, "fine");
  const TDF_Label assembly = shapes->NewShape();
  TDataStd_Name::Set(assembly, "pump");
  gp_Trsf move;
  move.SetTranslation(gp_Vec(100, 0, 0));
  TDataStd_Name::Set(shapes->AddComponent(assembly, part, TopLoc_Location(move)), "wheel_1");
  shapes->UpdateAssemblies();
  STEPCAFControl_Writer writer;
  Interface_Static::SetIVal("write.stepcaf.subshapes.name", 1);
  writer.SetNameMode(Standard_True);
  writer.SetColorMode(Standard_True);
  writer.SetLayerMode(Standard_True);
  assert_true(writer.Transfer(document, STEPControl_AsIs));
  assert_int_equal(writer.Write(path.c_str()), IFSelect_RetDone);
}

static void check_box(const CwCadBodies *bodies, double x0, double x1) {
  Bnd_Box box;
  BRepBndLib::AddOptimal(bodies->body[0].solid, box, Standard_False, Standard_False);
  assert_near(1e-3 * box.CornerMin().X(), x0, 1e-6 * x1);
  assert_near(1e-3 * box.CornerMax().X(), x1, 1e-6 * x1);
}

// The file says that its lengths are in another unit: by its text alone, so that no writer's idea of units counts.
static const char millimetre_text[] = "( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) )";

static void say_unit(const std::string &path, const std::string &unit) {
  std::ifstream in(path);
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const std::string millimetre = millimetre_text;
  size_t found = 0;
  for (size_t at = text.find(millimetre); at != std::string::npos; at = text.find(millimetre, at + 1), found++)
    text.replace(at, millimetre.size(), unit);
  assert_true(found > 0);
  const std::string inch = std::string("#9001 = LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#9002);\n#9002 = ") +
                           millimetre_text + ";\n#9003 = DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n";
  text.insert(text.rfind("ENDSEC;"), inch);
  std::ofstream(path) << text;
}

static void step_tells_all(void **) {
  CwCadBodies *bodies = nullptr;
  const std::string path = std::string(test_folder) + "/box.step";
  write_step(path);
  if (cw_cad_file_read(path.c_str(), 0, 1e-5, &bodies)) fail_msg("%s", cw_fail_message());
  assert_int_equal(cw_cad_body_count(bodies), 1);
  assert_string_equal(cw_cad_body_name(bodies, 0), "water");
  assert_string_equal(cw_cad_body_instance(bodies, 0), "wheel_1");
  check_box(bodies, 0.1, 0.11);
  int named = 0;
  for (const CwCadFaceOrigin &origin : bodies->body[0].origin) {
    if (origin.name != "BLADE_PS_1") continue;
    named++;
    assert_int_equal(origin.colour, 0x00ff00);
    assert_true(origin.layers == (std::vector<std::string>{"wet", "fine"}) ||
                origin.layers == (std::vector<std::string>{"fine", "wet"}));
  }
  assert_int_equal(named, 1);
  cw_cad_bodies_free(&bodies);
  remove(path.c_str());
}

static void step_files_have_their_own_unit(void **) {
  static const struct {
    const char *text;
    double metres;
  } units[] = {{millimetre_text, 1e-3},
               {"( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT($,.METRE.) )", 1},
               {"( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.CENTI.,.METRE.) )", 1e-2},
               {"( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MICRO.,.METRE.) )", 1e-6},
               {"( CONVERSION_BASED_UNIT('INCH',#9001) LENGTH_UNIT() NAMED_UNIT(#9003) )", 0.0254}};
  const std::string path = std::string(test_folder) + "/box.step";
  for (const auto &unit : units) {
    for (const double asked : {0.0, 0.0254}) { // of the file; given in its place
      CwCadBodies *bodies = nullptr;
      const double one = asked > 0 ? asked : unit.metres;
      write_step(path);
      say_unit(path, unit.text);
      if (cw_cad_file_read(path.c_str(), asked, 1e-5, &bodies)) fail_msg("%s", cw_fail_message());
      check_box(bodies, 100 * one, 110 * one);
      cw_cad_bodies_free(&bodies);
    }
  }
  remove(path.c_str());
}

static void points_and_units_of_brep_files(void **) {
  CwCadBodies *bodies = nullptr;
  const std::string path = std::string(test_folder) + "/box.brep";
  small_write(path, {BRepPrimAPI_MakeBox(1, 1, 1).Shape()});
  if (cw_cad_file_read(path.c_str(), 0.0254, 1e-5, &bodies)) fail_msg("%s", cw_fail_message());
  check_box(bodies, 0, 0.0254);
  const double inside[] = {0.02, 0.02, 0.02}, outside[] = {0.03, 0.02, 0.02};
  int holds;
  assert_int_equal(cw_cad_body_holds(bodies, 0, inside, &holds), CW_OK);
  assert_true(holds);
  assert_int_equal(cw_cad_body_holds(bodies, 0, outside, &holds), CW_OK);
  assert_false(holds);
  cw_cad_bodies_free(&bodies);
  remove(path.c_str());
}

// Faces that point into their solid leave its inside where it is.
static void solids_inside_out_hold_the_same_points(void **) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 1, 1).Shape();
  const double inside[] = {0.0005, 0.0005, 0.0005}, outside[] = {0.002, 0.0005, 0.0005};
  for (const TopoDS_Shape &solid : {box, box.Reversed()}) {
    const CwCadBodies bodies = {{{"box.step", "", "", small_solid_of(solid), {}}}};
    int holds;
    assert_int_equal(cw_cad_body_holds(&bodies, 0, inside, &holds), CW_OK);
    assert_true(holds);
    assert_int_equal(cw_cad_body_holds(&bodies, 0, outside, &holds), CW_OK);
    assert_false(holds);
  }
}

static void write_faces(const std::string &path, int count) {
  BRep_Builder builder;
  TopoDS_Compound faces;
  builder.MakeCompound(faces);
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 1, 1).Shape();
  for (int i = 1; i <= count; i++) builder.Add(faces, cw_cad_faces(box)(i));
  BRepTools::Write(faces, path.c_str());
}

static void shells_are_sewn_or_refused(void **) {
  const std::string path = std::string(test_folder) + "/faces.brep";
  CwCadBodies *bodies = nullptr;
  write_faces(path, 6);
  if (cw_cad_file_read(path.c_str(), 0, 1e-6, &bodies)) fail_msg("%s", cw_fail_message());
  assert_int_equal(cw_cad_body_count(bodies), 1);
  cw_cad_bodies_free(&bodies);
  write_faces(path, 5);
  assert_int_equal(cw_cad_file_read(path.c_str(), 0, 1e-6, &bodies), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "4 edges stay open"));
  assert_non_null(strstr(cw_fail_message(), "mm, by 0.5 mm; allowed")); // half the side that is missing
  cw_cad_bodies_free(&bodies);
  remove(path.c_str());
}

// A sphere and a ring are one face each, which makes a solid alone and beside others.
static void closed_faces_make_solids(void **) {
  const std::string path = std::string(test_folder) + "/faces.brep";
  const TopoDS_Shape ball = cw_cad_faces(BRepPrimAPI_MakeSphere(5).Shape())(1),
                     ring = cw_cad_faces(BRepPrimAPI_MakeTorus(gp_Ax2(gp_Pnt(0, 0, 50), gp::DZ()), 9, 2).Shape())(1);
  for (const int count : {1, 2}) {
    CwCadBodies *bodies = nullptr;
    double volume = 0;
    count == 1 ? small_write(path, {ball}) : small_write(path, {ball, ring});
    if (cw_cad_file_read(path.c_str(), 0, 1e-6, &bodies)) fail_msg("%s", cw_fail_message());
    assert_int_equal(cw_cad_body_count(bodies), count);
    for (const CwCadBody &body : bodies->body) {
      assert_int_equal(body.origin.size(), 1);
      volume += small_volume(body.solid);
    }
    assert_near(volume, 4 * M_PI / 3 * 125 + (count == 2 ? 2 * M_PI * 9 * M_PI * 4 : 0), 0.01);
    cw_cad_bodies_free(&bodies);
  }
  remove(path.c_str());
}

// A ball inside of a box is a void of it.
static void shells_inside_are_voids(void **) {
  const std::string path = std::string(test_folder) + "/faces.brep";
  const TopTools_IndexedMapOfShape box = cw_cad_faces(BRepPrimAPI_MakeBox(10, 10, 10).Shape());
  std::vector<TopoDS_Shape> faces = {cw_cad_faces(BRepPrimAPI_MakeSphere(gp_Pnt(5, 5, 5), 2).Shape())(1)};
  for (int i = 1; i <= 6; i++) faces.push_back(box(i));
  BRep_Builder builder;
  TopoDS_Compound all;
  builder.MakeCompound(all);
  for (const TopoDS_Shape &face : faces) builder.Add(all, face);
  BRepTools::Write(all, path.c_str());
  CwCadBodies *bodies = nullptr;
  if (cw_cad_file_read(path.c_str(), 0, 1e-6, &bodies)) fail_msg("%s", cw_fail_message());
  assert_int_equal(cw_cad_body_count(bodies), 1);
  assert_int_equal(bodies->body[0].origin.size(), 7);
  assert_near(small_volume(bodies->body[0].solid), 1000 - 4 * M_PI / 3 * 8, 0.01);
  cw_cad_bodies_free(&bodies);
  remove(path.c_str());
}

// A box of one unit of the file, its lid off by so many.
static void write_with_lid_off(const std::string &path, double off) {
  BRep_Builder builder;
  TopoDS_Compound faces;
  builder.MakeCompound(faces);
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 1, 1).Shape();
  for (int i = 1; i <= 6; i++) {
    gp_Trsf motion;
    if (i == 6) motion.SetTranslation(gp_Vec(0, 0, off));
    builder.Add(faces, BRepBuilderAPI_Transform(cw_cad_faces(box)(i), motion, Standard_True).Shape());
  }
  STEPControl_Writer writer;
  assert_int_equal(writer.Transfer(faces, STEPControl_AsIs), IFSelect_RetDone);
  assert_int_equal(writer.Write(path.c_str()), IFSelect_RetDone);
}

// Where no tolerance is given a share of the box's diagonal counts, of whatever unit.
static void shells_of_any_size_are_sewn_alike(void **) {
  const std::string path = std::string(test_folder) + "/faces.step";
  for (const double unit : {0.001, 0.01, 10.0}) {
    CwCadBodies *bodies = nullptr;
    write_with_lid_off(path, 2e-5);
    if (cw_cad_file_read(path.c_str(), unit, 0, &bodies)) fail_msg("%s", cw_fail_message());
    assert_int_equal(cw_cad_body_count(bodies), 1);
    cw_cad_bodies_free(&bodies);
    write_with_lid_off(path, 2e-4);
    assert_int_equal(cw_cad_file_read(path.c_str(), unit, 0, &bodies), CW_ERR_INPUT);
    cw_cad_bodies_free(&bodies);
  }
  remove(path.c_str());
}

// The lid stands off by half a percent of a unit of the file: within the tolerance in mm, not in m.
static void shells_are_sewn_in_the_unit_that_counts(void **) {
  const std::string path = std::string(test_folder) + "/faces.step";
  CwCadBodies *bodies = nullptr;
  write_with_lid_off(path, 0.005);
  if (cw_cad_file_read(path.c_str(), 0, 1e-5, &bodies)) fail_msg("%s", cw_fail_message());
  assert_int_equal(cw_cad_body_count(bodies), 1);
  cw_cad_bodies_free(&bodies);
  assert_int_equal(cw_cad_file_read(path.c_str(), 1, 1e-5, &bodies), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "do not close within 0.01 mm"));
  cw_cad_bodies_free(&bodies);
  if (cw_cad_file_read(path.c_str(), 1, 1e-2, &bodies)) fail_msg("%s", cw_fail_message());
  assert_near(small_volume(bodies->body[0].solid), 1e9, 1e7);
  cw_cad_bodies_free(&bodies);
  remove(path.c_str());
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(step_tells_all),
                                     cmocka_unit_test(step_files_have_their_own_unit),
                                     cmocka_unit_test(points_and_units_of_brep_files),
                                     cmocka_unit_test(solids_inside_out_hold_the_same_points),
                                     cmocka_unit_test(shells_are_sewn_or_refused),
                                     cmocka_unit_test(closed_faces_make_solids),
                                     cmocka_unit_test(shells_inside_are_voids),
                                     cmocka_unit_test(shells_are_sewn_in_the_unit_that_counts),
                                     cmocka_unit_test(shells_of_any_size_are_sewn_alike)};
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
