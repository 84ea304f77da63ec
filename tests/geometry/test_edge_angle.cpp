// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/edge_angle.hpp"

#include <cmath>
#include <map>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <gp_Vec.hxx>

#include "tests/unit_test.h"

static const double degree = M_PI / 180;

// A prism of height 2 over a polygon in z = 0.
static CwSolid prism(const std::vector<gp_Pnt> &corners) {
  BRepBuilderAPI_MakePolygon outline;
  for (const gp_Pnt &corner : corners) outline.Add(corner);
  outline.Close();
  const TopoDS_Shape shape = BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(outline.Wire()).Face(), gp_Vec(0, 0, 2));
  CwSolid solid = {"prism", 1, TopoDS::Solid(shape), {}};
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(solid.solid, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); i++)
    solid.faces.push_back({TopoDS::Face(faces(i)), "wall", CW_PATCH_WALL, "face"});
  return solid;
}

// A right-angled triangle of 30 and 60 degrees: its upright edges have the triangle's angles, the other six 90 degrees;
// each end face has the triangle's corners, and each side four right angles.
static void wedge(void **) {
  const CwSolid solid = prism({gp_Pnt(0, 0, 0), gp_Pnt(std::sqrt(3), 0, 0), gp_Pnt(0, 1, 0)});
  std::map<int, int> edges, corners;
  double upright = 0;
  cw_edge_angles(solid, nullptr, [&](const CwEdgeAngle &found) {
    edges[(int)std::lround(found.angle / degree)]++;
    assert_int_not_equal(found.face[0], found.face[1]);
    if (found.angle > 31 * degree) return;
    assert_near(found.angle, 30 * degree, 1e-9);
    assert_near(found.at.X(), std::sqrt(3), 1e-9);
    upright = std::fmax(upright, found.at.Z());
  });
  assert_near(upright, 2, 1e-9);
  assert_int_equal(edges.size(), 3);
  assert_int_equal(edges[60], edges[30]);
  assert_int_equal(edges[90], 7 * edges[30]);
  cw_corner_angles(solid, [&](const CwCornerAngle &found) { corners[(int)std::lround(found.angle / degree)]++; });
  assert_int_equal(corners.size(), 3);
  assert_int_equal(corners[30], 2);
  assert_int_equal(corners[60], 2);
  assert_int_equal(corners[90], 2 + 12);
}

// An L: where two walls meet from within, the edge and the corners of the ends have 270 degrees. Faces that are not
// wanted are left out.
static void ledge(void **) {
  const CwSolid solid =
      prism({gp_Pnt(0, 0, 0), gp_Pnt(2, 0, 0), gp_Pnt(2, 1, 0), gp_Pnt(1, 1, 0), gp_Pnt(1, 2, 0), gp_Pnt(0, 2, 0)});
  int inner = 0, corners = 0, none = 0;
  cw_edge_angles(solid, nullptr, [&](const CwEdgeAngle &found) {
    if (found.angle < M_PI) return;
    assert_near(found.angle, 1.5 * M_PI, 1e-9);
    assert_near(found.at.X(), 1, 1e-9);
    assert_near(found.at.Y(), 1, 1e-9);
    inner++;
  });
  assert_true(inner > 2);
  cw_corner_angles(solid, [&](const CwCornerAngle &found) {
    if (found.angle < M_PI) return;
    assert_near(found.angle, 1.5 * M_PI, 1e-9);
    corners++;
  });
  assert_int_equal(corners, 2);
  cw_edge_angles(
      solid, [](const CwSolidFace &a, const CwSolidFace &) { return a.patch == "hub"; },
      [&](const CwEdgeAngle &) { none++; });
  assert_int_equal(none, 0);
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(wedge), cmocka_unit_test(ledge)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
