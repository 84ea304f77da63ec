// SPDX-License-Identifier: AGPL-3.0-or-later
// A disc in a ring: the interface is a cylinder where both sides are the same one with the same ends, and a surface of
// any other form where they differ by less than the tolerance; so for planes.
#include "cad/small_parts.hpp"

extern "C" {
#include "geometry/cad/cad_interface.h"
}

static const double mm = 1e-3;

static CwCadInterface between(const TopoDS_Shape &wheel, const TopoDS_Shape &casing) {
  SmallParts small({{"rotor", wheel}, {"stator", casing}});
  CwFacePatches patches = {};
  CwCadInterface *made = nullptr;
  int count = 0;
  if (small.look()) fail_msg("%s", cw_fail_message());
  CwFaceRole *role = (CwFaceRole *)calloc(small.survey.face_count, sizeof *role);
  for (int f = 0; f < small.survey.face_count; f++)
    role[f] = small.contact[f].part >= 0 ? CW_ROLE_CONTACT : CW_ROLE_WALL;
  if (cw_face_patches_make(&small.cad, &small_frame, &small.parts, &small.survey, small.contact, role, small_tolerance,
                           &patches) ||
      cw_cad_interfaces_make(&small.cad, &small.survey, small.contact, &patches, small_tolerance, &count, &made))
    fail_msg("%s", cw_fail_message());
  assert_int_equal(count, 1);
  const CwCadInterface found = made[0];
  free(role);
  free(made);
  cw_face_patches_free(&patches);
  return found;
}

static TopoDS_Shape ring(double z, double radius, double width) {
  return BRepAlgoAPI_Cut(small_cylinder(z, 80, width), small_cylinder(z, radius, width)).Shape();
}

static void equal_sides_are_a_cylinder(void **) {
  const CwCadInterface found = between(small_cylinder(-5, 50, 10), ring(-5, 50, 10));
  assert_int_equal(found.surface, CW_SURFACE_CYLINDER);
  assert_near(found.radius, 50 * mm, 1e-9);
  assert_near(found.width, 10 * mm, 1e-7);
  assert_near(found.off, 0, 0);
}

// Later stages ask exact coordinates of a cylinder; of these sides none has them.
static void sides_within_the_tolerance_are_no_cylinder(void **) {
  for (const bool radius : {true, false}) {
    const CwCadInterface found =
        between(small_cylinder(-5, 50, 10), radius ? ring(-5, 50.008, 10) : ring(-5.008, 50, 10.008));
    assert_int_equal(found.surface, CW_SURFACE_OTHER);
    assert_near(found.radius, 0, 0);
    assert_near(found.off, 0.008 * mm, 1e-9);
  }
}

static void planes_are_exact_too(void **) {
  for (const double gap : {0.0, 0.008}) {
    const CwCadInterface found = between(small_cylinder(0, 50, 10), small_cylinder(10 + gap, 50, 10));
    assert_int_equal(found.surface, gap == 0 ? CW_SURFACE_PLANE : CW_SURFACE_OTHER);
    assert_near(found.off, gap * mm, 1e-9);
    assert_true(found.flat);
  }
  const CwCadInterface wider = between(small_cylinder(0, 50, 10), small_cylinder(10, 50.008, 10));
  assert_int_equal(wider.surface, CW_SURFACE_OTHER);
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(equal_sides_are_a_cylinder),
                                     cmocka_unit_test(sides_within_the_tolerance_are_no_cylinder),
                                     cmocka_unit_test(planes_are_exact_too)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
