// SPDX-License-Identifier: AGPL-3.0-or-later
// A casing that touches the wheel at its eye and at its outlet: two surfaces, two interfaces (cad_interface), each of
// its own form and width, unless a named patch holds both.
#include "cad/small_parts.hpp"

extern "C" {
#include "geometry/cad/cad_interface.h"
#include "geometry/cad/contact_surface.h"
}

static const double mm = 1e-3;

// The wheel's water: a disc of radius 50, 10 mm wide, and a pipe of radius 20 that begins at z = -60 on the casing's
// floor. Elsewhere metal is between them.
struct Both : SmallParts {
  CwFaceRole *role = nullptr;
  CwFacePatches patches = {};
  CwCadInterface *interfaces = nullptr;
  int *number = nullptr;
  int interface_count = 0;

  Both()
      : SmallParts({{"rotor", BRepAlgoAPI_Fuse(small_cylinder(-5, 50, 10), small_cylinder(-60, 20, 55)).Shape()},
                    {"stator", BRepAlgoAPI_Cut(small_cylinder(-100, 80, 108), small_cylinder(-60, 50, 68)).Shape()}}) {}
  ~Both() {
    free(role);
    free(interfaces);
    free(number);
    cw_face_patches_free(&patches);
  }
  CwStatus make() {
    CwStatus status = CW_OK;
    CW_TRY(look_imprinted());
    number = (int *)calloc(survey.face_count, sizeof *number);
    role = (CwFaceRole *)calloc(survey.face_count, sizeof *role);
    for (int f = 0; f < survey.face_count; f++) role[f] = contact[f].part >= 0 ? CW_ROLE_CONTACT : CW_ROLE_WALL;
    CW_TRY(cw_contact_surfaces(&cad, &survey, contact, small_tolerance, number));
    CW_TRY(cw_face_patches_make(&cad, &small_frame, &parts, &survey, contact, role, small_tolerance, &patches));
    CW_TRY(cw_contact_patches_part(&cad, &survey, contact, small_tolerance, &patches));
    CW_TRY(cw_cad_interfaces_make(&cad, &survey, contact, &patches, small_tolerance, &interface_count, &interfaces));
  done:
    return status;
  }
  double area(const char *name) const {
    for (int p = 0; p < patches.count; p++)
      if (!strcmp(patches.patch[p].name, name)) return patches.patch[p].area / (mm * mm);
    return 0;
  }
};

static const double outlet = 2 * M_PI * 50 * 10, eye = M_PI * 20 * 20; // mm2

static void surfaces_are_counted_from_outside(void **) {
  Both both;
  double area[2] = {0};
  if (both.make()) fail_msg("%s", cw_fail_message());
  for (int f = 0; f < both.survey.face_count; f++) {
    assert_int_equal(both.number[f] < 0, both.contact[f].part < 0);
    if (both.number[f] >= 0) area[both.number[f]] += both.survey.face[f].area / (mm * mm);
  }
  assert_near(area[0] / (2 * outlet), 1, 1e-4);
  assert_near(area[1] / (2 * eye), 1, 1e-4);
}

static void each_surface_is_an_interface(void **) {
  Both both;
  if (both.make()) fail_msg("%s", cw_fail_message());
  assert_near(both.area("rotor_to_stator") / outlet, 1, 1e-4);
  assert_near(both.area("rotor_to_stator_2") / eye, 1, 1e-4);
  assert_near(both.area("stator_to_rotor") / outlet, 1, 1e-4);
  assert_near(both.area("stator_to_rotor_2") / eye, 1, 1e-4);
  assert_int_equal(both.interface_count, 2);
  for (int i = 0; i < 2; i++) {
    const CwCadInterface &between = both.interfaces[i];
    const bool is_outlet = between.reach > 30 * mm;
    assert_int_equal(between.surfaces, 1);
    assert_int_equal(between.surface, is_outlet ? CW_SURFACE_CYLINDER : CW_SURFACE_PLANE);
    assert_near(between.width, is_outlet ? 10 * mm : eye * mm / (2 * M_PI * 20), 1e-6);
  }
  for (int p = 1; p < both.patches.count; p++)
    assert_true(both.patches.patch[p].part >= both.patches.patch[p - 1].part);
}

// The case names the wheel's side of both: the casing's stays whole, and the width is that of the outlet alone.
static void a_named_patch_holds_surfaces_together(void **) {
  static double point[][3] = {{0, 50 * mm, 0}, {0, 10 * mm, -60 * mm}};
  Both both;
  CwCadPatch rule = {};
  strcpy(rule.name, "rim");
  strcpy(rule.domain, "rotor");
  rule.near = {2, point};
  rule.colour = rule.turns = rule.monitored = -1;
  both.cad.patch = &rule;
  both.cad.patch_count = 1;
  if (both.make()) fail_msg("%s", cw_fail_message());
  assert_near(both.area("rim") / (outlet + eye), 1, 1e-4);
  assert_near(both.area("stator_to_rotor") / (outlet + eye), 1, 1e-4);
  assert_int_equal(both.interface_count, 1);
  assert_int_equal(both.interfaces[0].surfaces, 2);
  assert_near(both.interfaces[0].reach, 50 * mm, 1e-6);
  assert_near(both.interfaces[0].width, 10 * mm, 1e-6);
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(surfaces_are_counted_from_outside),
                                     cmocka_unit_test(each_surface_is_an_interface),
                                     cmocka_unit_test(a_named_patch_holds_surfaces_together)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
