// SPDX-License-Identifier: AGPL-3.0-or-later
#include <vector>

#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <TopExp_Explorer.hxx>
#include <gp_Pln.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

extern "C" {
#include "mesher/layers/bare_faces.h"
#include "mesher/run/layer_record.h"
}

#include "tests/mesher/solids.h"

// A prism of height 10 over a polygon in the plane z = 0.
static TopoDS_Shape prism(const std::vector<std::pair<double, double>> &corners) {
  BRepBuilderAPI_MakePolygon polygon;
  for (const auto &c : corners) polygon.Add(gp_Pnt(c.first, c.second, 0));
  polygon.Close();
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(polygon.Wire()).Face(), gp_Vec(0, 0, 10)).Shape();
}

// Finds the bare faces with areas as the faces are numbered, and closes the CAD; their numbers.
static std::vector<int> bare_of(CwCad *cad, CwBareFaces *bare, int asked = -1) {
  const double at[3] = {1, 2, 3};
  std::vector<double> area;
  *bare = {};
  for (int f = 0; f < cw_cad_face_count(cad); f++) area.push_back(1 + f);
  if (cw_bare_faces_find(cad, area.data(), asked, at, bare) != CW_OK) fail_msg("%s", cw_fail_message());
  std::vector<int> found;
  for (int f = 0; f < cw_cad_face_count(cad); f++)
    if (cw_cad_patch_kind(cad, cw_cad_face_patch(cad, f)) == CW_PATCH_WALL && !cw_cad_face_is_wall(cad, f))
      found.push_back(f);
  assert_int_equal(found.size(), bare->count);
  return found;
}

static void a_box_and_a_block_with_a_notch_have_none(void **state) {
  CwBareFaces bare;
  CwCad *cad = open_solid(BRepPrimAPI_MakeBox(10, 20, 30).Shape());
  assert_int_equal(bare_of(cad, &bare).size(), 0);
  assert_near(bare.share, 0, 0);
  cw_cad_close(&cad);
  cad = open_solid(prism({{0, 0}, {20, 0}, {20, 20}, {10, 5}, {0, 20}}));
  assert_int_equal(bare_of(cad, &bare).size(), 0);
  cw_cad_close(&cad);
}

// What the run begins with names the place and what mends it.
static void is_a_headline(CwCad *cad, const CwBareFaces *bare, const char *remedy) {
  CwLog *log = nullptr;
  json_t *headlines = json_array();
  CwDomain domain = {};
  domain.name = "block";
  domain.cad = cad;
  domain.bare = *bare;
  check(cw_log_open("mesh", nullptr, 0, 0, &log));
  cw_warn_of_bare(log, &domain, headlines);
  assert_int_equal(json_array_size(headlines), 1);
  const std::string told = json_string_value(json_array_get(headlines, 0));
  assert_string_equal(told.c_str(), cw_log_warning(log, 0));
  if (told.find("block: ") != 0 || told.find(remedy) == std::string::npos) fail_msg("%s", told.c_str());
  json_decref(headlines);
  cw_log_close(&log);
}

// A wedge of 2 degrees: the sine of half of it is less than 0.05 on both sides. At 12 degrees it is 0.1.
static void a_cusp_carries_none(void **state) {
  CwBareFaces bare;
  for (double degrees : {2.0, 12.0}) {
    CwCad *cad = open_solid(prism({{0, 0}, {100, 0}, {100, 100 * std::tan(degrees * M_PI / 180)}}));
    size_t found = bare_of(cad, &bare).size();
    if (degrees > 10) assert_int_equal(found, 0);
    if (degrees < 10) {
      assert_true(found >= 2);
      assert_int_equal(bare.open, -1);
      assert_true(bare.share > 0 && bare.share < 1);
      is_a_headline(cad, &bare, "round the solid there");
    }
    cw_cad_close(&cad);
  }
}

static std::string open_at_end(const TopoDS_Face &face) {
  gp_Pln plane = BRepAdaptor_Surface(face).Plane();
  bool at_end = std::fabs(std::fabs(plane.Axis().Direction().X()) - 1) < 1e-9 && plane.Location().X() < 1;
  return at_end ? "inlet,inlet" : "wall,wall";
}

// The end of a block, parted into an inlet and a strip of wall in one plane: columns on the strip would have to lie in
// the inlet. The sides stand at right angles on it and keep their layers.
static void a_wall_that_goes_on_as_an_inlet_carries_none(void **state) {
  CwBareFaces bare;
  TopoDS_Shape low = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(10, 10, 10)).Shape();
  TopoDS_Shape high = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 10), gp_Pnt(10, 10, 12)).Shape();
  int strips = 0;
  auto patch = [&strips](const TopoDS_Face &face) -> std::string {
    if (open_at_end(face)[0] != 'i') return "wall,wall";
    double least = 1e9;
    for (TopExp_Explorer it(face, TopAbs_VERTEX); it.More(); it.Next())
      least = std::fmin(least, BRep_Tool::Pnt(TopoDS::Vertex(it.Current())).Z());
    return least > 9 ? (strips++, "strip,wall") : "inlet,inlet";
  };
  CwCad *cad = open_solid(BRepAlgoAPI_Fuse(low, high).Shape(), patch); // keeps the faces apart
  assert_int_equal(strips, 1);
  std::vector<int> found = bare_of(cad, &bare);
  assert_true(found.size() >= 1);
  int of_strip = 0;
  for (int f : found) of_strip += std::string(cw_cad_patch_name(cad, cw_cad_face_patch(cad, f))) == "strip";
  assert_int_equal(of_strip, 1);
  assert_near(bare.at[0], 0, 1e-12);
  assert_true(bare.open >= 0);
  assert_string_equal(cw_cad_patch_name(cad, cw_cad_face_patch(cad, bare.open)), "inlet");
  is_a_headline(cad, &bare, "let 'inlet' cross the walls there");
  cw_cad_close(&cad);
}

// The other faces of a box can stand beside one that is bare. Those that are found with it are told with it.
static void a_face_that_is_asked_for_is_bare(void **state) {
  CwBareFaces bare;
  CwCad *cad = open_solid(BRepPrimAPI_MakeBox(10, 20, 30).Shape());
  std::vector<int> found = bare_of(cad, &bare, 3);
  assert_int_equal(found.size(), 1);
  assert_int_equal(found[0], 3);
  assert_near(bare.share, 4. / 21, 1e-15);
  is_a_headline(cad, &bare, "layers fold or cross there however short edges are, first at (1000, 2000, 3000) mm");
  cw_cad_close(&cad);
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_box_and_a_block_with_a_notch_have_none),
                                     cmocka_unit_test(a_cusp_carries_none),
                                     cmocka_unit_test(a_face_that_is_asked_for_is_bare),
                                     cmocka_unit_test(a_wall_that_goes_on_as_an_inlet_carries_none)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
