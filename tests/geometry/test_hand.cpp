// SPDX-License-Identifier: AGPL-3.0-or-later
// Both hands of the paper's pump. The wheel turns by the right hand about +z; seen from the drive, which stands
// opposite to the suction, that is counter-clockwise where the suction is at -z.
#include <cmath>
#include <string>

#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <gp_Pnt.hxx>

#include "geometry/hydraulic_design.h"
#include "geometry/pump.h"
#include "geometry/solid.hpp"
#include "tests/geometry/paper_rotor.h"
#include "tests/unit_test.h"

// Of the face of that name.
static gp_Pnt middle(const CwSolid *solid, const std::string &name) {
  GProp_GProps properties;
  int found = 0;
  for (const CwSolidFace &face : solid->faces) {
    if (face.name != name) continue;
    BRepGProp::SurfaceProperties(face.face, properties);
    found++;
  }
  if (found != 1) fail_msg("%d faces are called %s", found, name.c_str());
  return properties.CentreOfMass();
}

static double degrees_between(const gp_Pnt &ahead, const gp_Pnt &behind) {
  return std::remainder(std::atan2(ahead.Y(), ahead.X()) - std::atan2(behind.Y(), behind.X()), 2 * M_PI) * 180 / M_PI;
}

// Blades sweep backward by the wrap of 71 degrees, 3 to 4 mm thick with the pressure side in front, and the spiral
// opens in the sense of rotation: at x > 0 towards +y.
static void suction_blades_and_spiral(void **) {
  for (CwRotation rotation : {CW_ROTATION_COUNTER_CLOCKWISE, CW_ROTATION_CLOCKWISE}) {
    CwCase table = paper();
    CwDesign design;
    table.impeller.rotation = rotation;
    CwPump pump = pump_of(&table, &design);
    const CwSolid *rotor = pump.solid[CW_PUMP_ROTOR];
    const double inlet = middle(rotor, "inlet").Z();
    assert_true(rotation == CW_ROTATION_CLOCKWISE ? inlet > 50 : inlet < -50);
    assert_near(degrees_between(middle(rotor, "blade_leading_edge_1"), middle(rotor, "blade_trailing_edge_1")), 71, 10);
    const double thick = degrees_between(middle(rotor, "blade_pressure_1"), middle(rotor, "blade_suction_1"));
    assert_true(thick > 1 && thick < 15);
    const gp_Pnt outlet = middle(pump.solid[CW_PUMP_STATOR], "outlet");
    assert_true(outlet.X() > 0 && outlet.Y() > 100);
    cw_pump_free(&pump);
  }
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(suction_blades_and_spiral)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
