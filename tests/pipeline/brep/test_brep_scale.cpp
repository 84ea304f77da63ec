// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/brep/brep_scale.hpp"

#include <cmath>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <GProp_GProps.hxx>
#include <TopExp_Explorer.hxx>
#include <gp_Trsf.hxx>

#include "tests/unit_test.h"

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
    const TopoDS_Shape solid = TopExp_Explorer(of.shape, TopAbs_SOLID).Current();
    for (const double factor : {0.3, 3.0, 4.0}) {
      const TopoDS_Shape scaled = cw_brep_scaled(solid, factor);
      GProp_GProps properties;
      BRepGProp::VolumeProperties(scaled, properties);
      assert_true(BRepCheck_Analyzer(scaled).IsValid());
      assert_true(std::abs(properties.Mass() / (of.volume * factor * factor * factor) - 1) < 1e-6);
    }
  }
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(solids_of_cad)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
