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
#include "mesher/layers/pinched.h"
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

static CwPinched pinched_of(const CwCad *cad) {
  CwPinched pinched = {};
  check(cw_pinched_find(cad, &pinched));
  int edges = 0, corners = 0;
  for (int e = 0; e < cw_cad_edge_count(cad); e++) edges += pinched.on_edge[e];
  for (int v = 0; v < cw_cad_vertex_count(cad); v++) corners += pinched.on_corner[v];
  assert_int_equal(pinched.edges, edges);
  assert_int_equal(pinched.corners, corners);
  return pinched;
}

static void a_box_and_a_block_with_a_notch_have_none(void **state) {
  for (const TopoDS_Shape &solid :
       {BRepPrimAPI_MakeBox(10, 20, 30).Shape(), prism({{0, 0}, {20, 0}, {20, 20}, {10, 5}, {0, 20}})}) {
    CwCad *cad = open_solid(solid);
    CwPinched pinched = pinched_of(cad);
    assert_int_equal(pinched.edges + pinched.corners, 0);
    cw_pinched_free(&pinched);
    cw_cad_close(&cad);
  }
}

// What the run begins with names the place and what mends it; then the places that are found to have no layers.
static void are_headlines(CwCad *cad, const CwPinched *pinched, const std::vector<std::string> &wanted) {
  CwLog *log = nullptr;
  json_t *headlines = json_array();
  CwDomain domain = {};
  domain.name = "block";
  domain.cad = cad;
  domain.pinched = *pinched;
  check(cw_log_open("mesh", nullptr, 0, 0, &log));
  cw_warn_of_pinched(log, &domain, headlines);
  assert_int_equal(json_array_size(headlines), wanted.size());
  for (size_t i = 0; i < wanted.size(); i++) {
    const std::string told = json_string_value(json_array_get(headlines, i));
    assert_string_equal(told.c_str(), cw_log_warning(log, i));
    if (told.find("block: ") != 0 || told.find(wanted[i]) == std::string::npos) fail_msg("%s", told.c_str());
  }
  json_decref(headlines);
  cw_log_close(&log);
}

// A wedge of 2 degrees: the sine of half of it is less than 0.05 on its edge and at both ends of that. At 12 degrees it
// is 0.1.
static void a_cusp_is_pinched(void **state) {
  for (double degrees : {2.0, 12.0}) {
    CwCad *cad = open_solid(prism({{0, 0}, {100, 0}, {100, 100 * std::tan(degrees * M_PI / 180)}}));
    CwPinched pinched = pinched_of(cad);
    assert_int_equal(pinched.edges, degrees < 10 ? 1 : 0);
    assert_int_equal(pinched.corners, degrees < 10 ? 2 : 0);
    for (int e = 0; e < cw_cad_edge_count(cad); e++) {
      double range[2];
      cw_cad_edge_range(cad, e, range);
      assert_int_equal(cw_pinched_at(cad, e, 0.7 * range[0] + 0.3 * range[1]), pinched.on_edge[e]);
    }
    if (degrees < 10) {
      assert_int_equal(pinched.open, -1);
      are_headlines(cad, &pinched, {"at edges (1) and corners (2)"});
      check(cw_pinched_add((const CwPinchedPlace[]){{{1, 2, 3}, 4}}, &pinched));
      are_headlines(cad, &pinched,
                    {"round the solid there", "at places (1) where they fold or cross however short edges "
                                              "are, first at (1000, 2000, 3000) mm"});
    }
    cw_pinched_free(&pinched);
    cw_cad_close(&cad);
  }
}

// Two boxes that stand across one another: at the middle of their common face's side one wall looks up and one down.
static void a_corner_of_opposite_planes_is_pinched(void **state) {
  TopoDS_Shape low = BRepPrimAPI_MakeBox(gp_Pnt(-10, -10, -10), gp_Pnt(0, 10, 0)).Shape();
  TopoDS_Shape high = BRepPrimAPI_MakeBox(gp_Pnt(-10, -10, 0), gp_Pnt(10, 0, 10)).Shape();
  CwCad *cad = open_solid(BRepAlgoAPI_Fuse(low, high).Shape());
  CwPinched pinched = pinched_of(cad);
  assert_int_equal(pinched.edges, 0);
  assert_int_equal(pinched.corners, 1);
  assert_near(cw_norm(pinched.at), 0, 1e-12);
  cw_pinched_free(&pinched);
  cw_cad_close(&cad);
}

static std::string open_at_end(const TopoDS_Face &face) {
  gp_Pln plane = BRepAdaptor_Surface(face).Plane();
  bool at_end = std::fabs(std::fabs(plane.Axis().Direction().X()) - 1) < 1e-9 && plane.Location().X() < 1;
  return at_end ? "inlet,inlet" : "wall,wall";
}

// The end of a block, parted into an inlet and a strip of wall in one plane: columns on the edge between would have to
// lie in the inlet.
static void a_wall_that_goes_on_as_an_inlet_is_pinched(void **state) {
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
  CwPinched pinched = pinched_of(cad);
  assert_int_equal(pinched.edges, 1);
  assert_int_equal(pinched.corners, 2);
  assert_near(pinched.at[0], 0, 1e-12);
  assert_near(pinched.at[2], 0.010, 1e-12);
  assert_true(pinched.open >= 0);
  assert_string_equal(cw_cad_patch_name(cad, cw_cad_face_patch(cad, pinched.open)), "inlet");
  are_headlines(cad, &pinched, {"let 'inlet' cross the walls there"});
  cw_pinched_free(&pinched);
  cw_cad_close(&cad);
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_box_and_a_block_with_a_notch_have_none),
                                     cmocka_unit_test(a_cusp_is_pinched),
                                     cmocka_unit_test(a_corner_of_opposite_planes_is_pinched),
                                     cmocka_unit_test(a_wall_that_goes_on_as_an_inlet_is_pinched)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
