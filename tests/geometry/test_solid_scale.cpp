// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/solid_scale.hpp"

#include <sstream>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepTools.hxx>
#include <GProp_GProps.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <gp_Trsf.hxx>

#include "geometry/hydraulic_design.h"
#include "geometry/measure.h"
#include "geometry/pump.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/unit_test.h"

static std::string text_of(const CwSolid &solid) {
  std::ostringstream text;
  BRepTools::Write(solid.solid, text);
  return text.str();
}

// All kinds of faces and curves: cones, tori's neighbours, zones, a shaft and a mirror image. What is scaled is sound,
// has exactly the scaled volume, and comes back to the last bit.
static void there_and_back(void **) {
  CwCase table = case_of("zones");
  CwDesign design;
  table.impeller.rotation = CW_ROTATION_CLOCKWISE;
  CwPump pump = pump_of(&table, &design);
  for (int i = 0; i < pump.count; i++) {
    CwMeasuredSolid before, after;
    const CwSolid &solid = *pump.solid[i];
    const CwSolid large = cw_solid_scaled(solid, 8), odd = cw_solid_scaled(solid, 3);
    assert_true(large.unit == solid.unit / 8);
    assert_true(text_of(large) != text_of(solid));
    assert_true(text_of(cw_solid_scaled(large, 0.125)) == text_of(cw_solid_scaled(solid, 1)));
    assert_int_equal(cw_measure_solid(&solid, &before), CW_OK);
    for (const CwSolid *scaled : {&large, &odd}) {
      assert_int_equal(cw_measure_solid(scaled, &after), CW_OK);
      assert_true(after.valid && after.closed);
      assert_int_equal(after.face_count, before.face_count);
      assert_true(std::abs(after.volume / before.volume - 1) < 1e-9); // in m3: the unit is that much smaller
    }
  }
  cw_pump_free(&pump);
}

// Solids as CAD has them: poles, tips, and curves in parameter planes of every kind. Volumes by hand.
static void solids_of_cad(void **) {
  gp_Trsf tilt;
  tilt.SetRotation(gp_Ax1(gp_Pnt(0, 0, 5), gp::DX()), 0.3);
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(gp_Pnt(-20, -20, 5), gp_Pnt(20, 20, 40)).Shape();
  const TopoDS_Shape cut = BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(3, 30, M_PI).Shape(),
                                           BRepBuilderAPI_Transform(block, tilt, Standard_True).Shape())
                               .Shape();
  const struct {
    TopoDS_Shape shape;
    double volume;
  } cases[] = {{BRepPrimAPI_MakeCone(3, 0, 7, M_PI / 2).Shape(), M_PI * 9 * 7 / 12},
               {BRepPrimAPI_MakeSphere(7, 0, M_PI / 2, M_PI / 2).Shape(), M_PI / 6 * 343},
               {cut, M_PI * 9 / 2 * 5 + std::tan(0.3) * 2 / 3 * 27}}; // the half disc's area, and its moment
  for (const auto &of : cases) {
    CwSolid solid;
    solid.unit = 1e-3;
    solid.solid = TopoDS::Solid(TopExp_Explorer(of.shape, TopAbs_SOLID).Current());
    for (TopExp_Explorer at(solid.solid, TopAbs_FACE); at.More(); at.Next())
      solid.faces.push_back({TopoDS::Face(at.Current()), "wall", CW_PATCH_WALL, "face"});
    for (const double factor : {0.3, 3.0}) {
      const CwSolid scaled = cw_solid_scaled(solid, factor);
      GProp_GProps properties;
      BRepGProp::VolumeProperties(scaled.solid, properties);
      assert_true(BRepCheck_Analyzer(scaled.solid).IsValid());
      assert_true(std::abs(properties.Mass() / (of.volume * factor * factor * factor) - 1) < 1e-6);
    }
  }
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(there_and_back), cmocka_unit_test(solids_of_cad)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
