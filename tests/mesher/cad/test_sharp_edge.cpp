// SPDX-License-Identifier: AGPL-3.0-or-later
// Wedges of known angles in a box of fluid.
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <gp_Vec.hxx>

extern "C" {
#include "mesher/cad/background_make.h"
#include "mesher/cad/sharp_edge.h"
}

#include "tests/mesher/solids.h"

static CwSharpEdge sharpest(const TopoDS_Shape &shape, const PatchOfFace &patch_of = all_wall) {
  CwCad *cad = open_solid(shape, patch_of);
  CwBackground background;
  assert_int_equal(cw_background_make(cad, 1e-4, 0.2, &background), CW_OK);
  CwSharpEdge edge = cw_sharpest_edge(cad, &background);
  cw_background_free(&background);
  cw_cad_close(&cad);
  return edge;
}

// A box of 40 x 40 x 20 mm without a wedge that has its edge at x = 10, y = 20 mm, 20 mm long.
static TopoDS_Shape round_a_wedge(double degrees) {
  double half = 20 * std::tan(degrees / 2 * M_PI / 180);
  BRepBuilderAPI_MakePolygon section(gp_Pnt(10, 20, 0), gp_Pnt(30, 20 - half, 0), gp_Pnt(30, 20 + half, 0), true);
  BRepPrimAPI_MakePrism wedge(BRepBuilderAPI_MakeFace(section.Wire()).Face(), gp_Vec(0, 0, 20));
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(40, 40, 20).Shape(), wedge.Shape()).Shape();
}

static void the_edge_of_a_wedge_is_found(void **) {
  for (double degrees : {5.0, 20.0, 55.0}) {
    CwSharpEdge edge = sharpest(round_a_wedge(degrees));
    assert_near(edge.angle, degrees, 1e-6);
    assert_near(edge.at[0], 0.01, 1e-9);
    assert_near(edge.at[1], 0.02, 1e-9);
    assert_int_not_equal(edge.face[0], edge.face[1]);
  }
}

// Its other two edges have angles of (180 - 80) / 2 degrees.
static void the_sharpest_counts(void **) {
  assert_near(sharpest(round_a_wedge(80)).angle, 50, 1e-6);
}

static void a_box_has_none(void **) {
  assert_near(sharpest(BRepPrimAPI_MakeBox(40, 40, 20).Shape()).angle, 180, 1e-6);
}

// Where the sides of the wedge are open, no wall is sharp.
static void open_faces_do_not_count(void **) {
  auto walls_of_the_box = [](const TopoDS_Face &face) -> std::string {
    gp_Dir normal = BRepAdaptor_Surface(face).Plane().Axis().Direction();
    bool slanting = std::fabs(normal.X()) < 0.999 && std::fabs(normal.Y()) < 0.999 && std::fabs(normal.Z()) < 0.999;
    return slanting ? "open,inlet" : "wall,wall";
  };
  assert_near(sharpest(round_a_wedge(20), walls_of_the_box).angle, 180, 1e-6);
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(the_edge_of_a_wedge_is_found), cmocka_unit_test(the_sharpest_counts),
                              cmocka_unit_test(a_box_has_none), cmocka_unit_test(open_faces_do_not_count)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
