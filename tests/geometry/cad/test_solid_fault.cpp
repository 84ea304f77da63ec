// SPDX-License-Identifier: AGPL-3.0-or-later
// Faults of small solids are told with what they are of.
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <gp_Pln.hxx>

#include "cad/small_parts.hpp"
#include "geometry/cad/solid_fault.hpp"

static TopoDS_Shape both(const TopoDS_Shape &a, const TopoDS_Shape &b) {
  BRep_Builder builder;
  TopoDS_Compound all;
  builder.MakeCompound(all);
  builder.Add(all, a);
  builder.Add(all, b);
  return all;
}

static void sound_solids_have_none(void **) {
  assert_string_equal(cw_cad_solid_fault(small_box(0, 0, 0, 1, 2, 3), 0.01).what.c_str(), "");
}

static void one_solid_is_asked_for(void **) {
  const TopoDS_Shape box = small_box(0, 0, 0, 1, 2, 3);
  const CwSolidFault two = cw_cad_solid_fault(both(box, small_box(5, 0, 0, 1, 2, 3)), 0.01);
  assert_string_equal(two.what.c_str(), "it makes 2 solids, one");
  assert_true(two.at->X() >= 5);
  assert_string_equal(cw_cad_solid_fault(cw_cad_faces(box)(1), 0.01).what.c_str(), "it makes 0 solids");
}

// The prism over a bow tie: its ends cross themselves.
static void outlines_that_cross_are_told(void **) {
  BRepBuilderAPI_MakePolygon tie(gp_Pnt(0, 0, 0), gp_Pnt(4, 2, 0), gp_Pnt(4, 0, 0), gp_Pnt(0, 2, 0), Standard_True);
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), tie.Wire()).Face();
  const CwSolidFault fault = cw_cad_solid_fault(BRepPrimAPI_MakePrism(face, gp_Vec(0, 0, 3)).Shape(), 0.01);
  assert_string_equal(fault.what.c_str(), "the outline crosses itself");
  assert_int_equal(fault.on.ShapeType(), TopAbs_WIRE);
  assert_false(fault.open);
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(sound_solids_have_none), cmocka_unit_test(one_solid_is_asked_for),
                                     cmocka_unit_test(outlines_that_cross_are_told)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
