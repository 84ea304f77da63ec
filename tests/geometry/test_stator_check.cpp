// SPDX-License-Identifier: AGPL-3.0-or-later
// Prisms, whose upright edges have the angles of their polygons, all others right angles.
#include "geometry/stator_check.hpp"

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>

#include "tests/geometry/hand_solids.hpp"
#include "tests/unit_test.h"

static const double degree = M_PI / 180;

// What is refused, or "".
static std::string refusal_of(const CwSolid &solid) {
  try {
    cw_stator_check(solid);
  } catch (const std::runtime_error &failure) {
    return failure.what();
  }
  return "";
}

static void says(const std::string &text, const char *words) {
  if (text.find(words) == std::string::npos) fail_msg("'%s' has no '%s'", text.c_str(), words);
}

// A kite from its sharp corner at (3, 4, 1) along both its sides of 10; its other corners are blunt. 10 high, of 2 mm.
static CwSolid kite(double angle) {
  const double half = angle / 2 * degree;
  CwSolid solid = hand_prism({gp_Pnt(3, 4, 1), gp_Pnt(13, 4, 1), gp_Pnt(3 + 13 * cos(half), 4 + 13 * sin(half), 1),
                              gp_Pnt(3 + 10 * cos(2 * half), 4 + 10 * sin(2 * half), 1)},
                             gp_Vec(0, 0, 10), 2e-3);
  const gp_Pnt right(8, 4, 6), left(3 + 5 * cos(2 * half), 4 + 5 * sin(2 * half), 6);
  for (CwSolidFace &face : solid.faces) {
    if (hand_centre(face.face).Distance(right) < 1e-9) face.name = "right";
    if (hand_centre(face.face).Distance(left) < 1e-9) face.name = "left";
  }
  return solid;
}

static void sharp_fluid_is_refused(void **) {
  assert_string_equal(refusal_of(kite(90)).c_str(), "");
  assert_string_equal(refusal_of(kite(66.1)).c_str(), "");
  const std::string text = refusal_of(kite(65.9));
  double z = 0;
  const size_t place = text.find("meet through the fluid at 65.9 deg at (6.0, 8.0, ");
  assert_true(place != std::string::npos);
  assert_int_equal(sscanf(text.c_str() + place, "meet through the fluid at 65.9 deg at (6.0, 8.0, %lf", &z), 1);
  assert_true(z == 2 || z == 22); // either end
  says(text, ") mm; allowed: at least 66 deg");
  says(text, "right");
  says(text, "left");
}

// A block with a notch from above that leaves the solid a wedge of this angle, point down at (0, 1).
static CwSolid notched(double wedge) {
  const double wide = 9 * tan(wedge / 2 * degree);
  return hand_prism({gp_Pnt(-20, 0, 0), gp_Pnt(20, 0, 0), gp_Pnt(20, 10, 0), gp_Pnt(wide, 10, 0), gp_Pnt(0, 1, 0),
                     gp_Pnt(-wide, 10, 0), gp_Pnt(-20, 10, 0)},
                    gp_Vec(0, 0, 5), 1e-3);
}

static void sharp_walls_are_refused(void **) {
  assert_string_equal(refusal_of(notched(90)).c_str(), "");
  assert_string_equal(refusal_of(notched(75.1)).c_str(), "");
  const std::string text = refusal_of(notched(74.9));
  says(text, "meet through the solid at 74.9 deg at (0.0, 1.0, ");
  says(text, " mm; allowed: at least 75 deg");
}

// The place and both lengths are in mm: of units of 2 mm. OpenCASCADE's prisms have one vertex, moved, at both ends of
// an upright edge.
static void loose_corners_are_refused(void **) {
  const struct {
    double tolerance;
    bool refused;
  } cases[] = {{0.99e-3, false}, {1e-3, true}, {1.5e-3, true}};
  for (const auto &of : cases) {
    const CwSolid solid = kite(90);
    TopTools_IndexedMapOfShape vertices;
    TopExp::MapShapes(solid.solid, TopAbs_VERTEX, vertices);
    int loosened = 0;
    for (int i = 1; i <= vertices.Extent(); i++) {
      const gp_Pnt at = BRep_Tool::Pnt(TopoDS::Vertex(vertices(i)));
      if (std::hypot(at.X() - 13, at.Y() - 4) > 1e-9) continue;
      BRep_Builder().UpdateVertex(TopoDS::Vertex(vertices(i)), of.tolerance);
      loosened++;
    }
    assert_int_equal(loosened, 2);
    const std::string text = refusal_of(solid);
    double z = -1;
    assert_int_equal(!text.empty(), of.refused);
    if (of.tolerance != 1.5e-3) continue;
    assert_int_equal(sscanf(text.c_str(), "its faces miss each other by 0.003 mm at (26.000, 8.000, %lf", &z), 1);
    assert_true(z == 2 || z == 22);
    says(text, "000) mm; allowed: 0.002 mm");
  }
}

static void solids_with_a_fault_are_refused(void **) {
  const CwSolid whole = kite(90);
  assert_string_equal(refusal_of(hand_of_faces(whole, 6)).c_str(), "");
  assert_string_equal(refusal_of(hand_of_faces(whole, 5)).c_str(), "its faces do not bound a volume");
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sharp_fluid_is_refused),
      cmocka_unit_test(sharp_walls_are_refused),
      cmocka_unit_test(loose_corners_are_refused),
      cmocka_unit_test(solids_with_a_fault_are_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
