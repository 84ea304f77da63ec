// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>
#include <vector>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <Geom_BezierCurve.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <gp_Trsf.hxx>

#include "mesher/common/vec.h"
#include "solids.h"

namespace {

// All that is asked of a solid, as far as it is a length or a direction.
struct Answers {
  std::vector<double> lengths, directions;
};

void add(std::vector<double> &list, const double x[3]) {
  list.insert(list.end(), x, x + 3);
}

Answers ask(const CwCad *cad) {
  Answers answers;
  for (int v = 0; v < cw_cad_vertex_count(cad); v++) {
    double x[3];
    cw_cad_vertex_point(cad, v, x);
    add(answers.lengths, x);
  }
  for (int e = 0; e < cw_cad_edge_count(cad); e++) {
    int face[2];
    double range[2];
    cw_cad_edge_faces(cad, e, face);
    cw_cad_edge_range(cad, e, range);
    for (int i = 0; i <= 10; i++) {
      double t = range[0] + (range[1] - range[0]) * i / 10, x[3], uv[2], n[3];
      cw_cad_edge_point(cad, e, t, x, nullptr);
      add(answers.lengths, x);
      for (int side = 0; side < 2; side++) {
        cw_cad_edge_uv(cad, e, face[side], t, uv);
        cw_cad_face_point(cad, face[side], uv, x, nullptr, nullptr);
        cw_cad_face_normal(cad, face[side], uv, n);
        add(answers.lengths, x);
        add(answers.directions, n);
        double curvature = cw_cad_face_curvature(cad, face[side], uv, nullptr);
        answers.lengths.push_back(curvature != 0 ? 1 / curvature : 0);
      }
    }
  }
  return answers;
}

// Every length 2^power times as great, to `rounding` of the greatest; every direction as it was.
void check_scaling(const TopoDS_Shape &solid, int power, double rounding) {
  const double unit = 0.128; // m: 2^7 of the file's
  CwCad *cad = open_solid(solid);
  assert_int_equal(cw_cad_rescale(cad, unit), CW_OK);
  Answers before = ask(cad);
  CwBox box = cw_box_empty(), scaled_box = cw_box_empty();
  cw_cad_add_to_box(cad, &box);
  double off = rounding * std::ldexp(cw_distance(box.low, box.high), power);
  assert_int_equal(cw_cad_rescale(cad, std::ldexp(unit, -power)), CW_OK);
  cw_cad_add_to_box(cad, &scaled_box);
  for (int k = 0; k < 3; k++) assert_near(scaled_box.high[k], std::ldexp(box.high[k], power), off);
  Answers scaled = ask(cad);
  assert_int_equal(scaled.lengths.size(), before.lengths.size());
  for (size_t i = 0; i < before.lengths.size(); i++)
    assert_near(scaled.lengths[i], std::ldexp(before.lengths[i], power), off);
  for (size_t i = 0; i < before.directions.size(); i++)
    assert_near(scaled.directions[i], before.directions[i], rounding);
  assert_int_equal(cw_cad_rescale(cad, unit), CW_OK);
  Answers after = ask(cad);
  for (size_t i = 0; i < before.lengths.size(); i++)
    assert_near(after.lengths[i], before.lengths[i], std::ldexp(off, -power));
  cw_cad_close(&cad);
}

void check_scalings(const TopoDS_Shape &solid, double rounding) {
  for (int power : {-7, -1, 1, 10}) check_scaling(solid, power, rounding);
}

TopoDS_Face bulging_face() {
  TColgp_Array1OfPnt pole(1, 3);
  pole(1) = gp_Pnt(11.3, 0, 0);
  pole(2) = gp_Pnt(16.1, 0, 4.7);
  pole(3) = gp_Pnt(12.9, 0, 9.1);
  TopoDS_Edge bulge = BRepBuilderAPI_MakeEdge(new Geom_BezierCurve(pole));
  BRepBuilderAPI_MakeWire wire(bulge);
  wire.Add(BRepBuilderAPI_MakeEdge(pole(3), gp_Pnt(3.7, 0, 9.1)).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(gp_Pnt(3.7, 0, 9.1), gp_Pnt(3.7, 0, 0)).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(gp_Pnt(3.7, 0, 0), pole(1)).Edge());
  return BRepBuilderAPI_MakeFace(wire.Wire()).Face();
}

} // namespace

static void a_power_of_two_costs_no_bit(void **state) {
  TopoDS_Shape cone = BRepPrimAPI_MakeCone(5.3, 2.9, 12.1, 1.9).Shape();
  check_scalings(BRepPrimAPI_MakeBox(gp_Pnt(1.1, -2.3, 0.7), 10.1, 20.3, 29.9).Shape(), 0);
  check_scalings(BRepPrimAPI_MakeCylinder(5.3, 12.1, 1.9).Shape(), 0);
  check_scalings(BRepPrimAPI_MakeTorus(11.7, 3.1, 0.3, 1.7, 2.3).Shape(), 0);
  check_scalings(cone, 0);
  check_scalings(BRepBuilderAPI_NurbsConvert(cone).Shape(), 0);
}

// Their end faces, and the last solid, are moved copies: what the library adds up to place them rounds.
static void moved_faces_are_off_by_rounding(void **state) {
  gp_Trsf move;
  move.SetTranslation(gp_Vec(3.3, 1.9, -7.7));
  gp_Ax1 axis(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1));
  check_scalings(BRepPrimAPI_MakeRevol(bulging_face(), axis, 2.1).Shape(), 1e-14);
  check_scalings(BRepPrimAPI_MakePrism(bulging_face(), gp_Vec(0.3, 7.7, 0.4)).Shape(), 1e-14);
  check_scalings(BRepPrimAPI_MakeCylinder(5.3, 12.1, 1.9).Shape().Moved(TopLoc_Location(move)), 1e-14);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_power_of_two_costs_no_bit),
      cmocka_unit_test(moved_faces_are_off_by_rounding),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
