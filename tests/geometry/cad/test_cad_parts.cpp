// SPDX-License-Identifier: AGPL-3.0-or-later
// Bodies as parts: turned to the axis, fused, in the unit of the model, with what the file says of their faces, which
// goes with them by cad_part.
#include <BRepBndLib.hxx>
#include <Bnd_Box.hxx>

#include "cad/small_parts.hpp"

static CwCadBody body(const TopoDS_Shape &shape, const char *name) {
  CwCadBody made = {"pump.step", name, "", small_solid_of(shape), {}};
  made.origin.resize(cw_cad_faces(made.solid).Extent(), {name, {}, -1, -1});
  return made;
}

static CwStatus make(const CwCadBodies &bodies, const int *domain, const CwCadFrame &frame, int count,
                     CwCadParts **parts) {
  static char file[] = "pump.step", *files[] = {file};
  static CwCadDomain domains[2];
  strcpy(domains[0].name, "rotor");
  strcpy(domains[1].name, "stator");
  domains[0].rotating = 1;
  CwCaseCad cad = {};
  cad.files = {1, files};
  cad.domain = domains;
  cad.domain_count = count;
  return cw_cad_parts_make(&cad, &frame, &bodies, domain, parts);
}

// A wheel about the file's x axis through (0, 0, 10) mm stands about +z, and is measured in the model unit.
static void parts_stand_about_the_axis(void **) {
  const CwCadBodies bodies = {
      {body(BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(3, 0, 10), gp::DX()), 50, 20).Shape(), "wheel")}};
  const CwCadFrame frame = {{0, 0, 0.01}, {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}, 0};
  const int domain[] = {0};
  CwCadParts *parts = nullptr;
  if (make(bodies, domain, frame, 1, &parts)) fail_msg("%s", cw_fail_message());
  const double to_mm = 1e3 * cw_cad_parts_unit(parts);
  Bnd_Box box;
  double low[3], high[3];
  BRepBndLib::AddOptimal(parts->part[0].solid, box, Standard_False, Standard_False);
  box.Get(low[0], low[1], low[2], high[0], high[1], high[2]);
  assert_near(high[0] * to_mm, 50, 1e-3);
  assert_near(low[2] * to_mm, 3, 1e-3);
  assert_near(high[2] * to_mm, 23, 1e-3);
  assert_int_equal(cw_cad_part_face_count(parts, 0), 3);
  for (int f = 0; f < 3; f++) {
    assert_string_equal(cw_cad_part_face(parts, 0, f).name, "wheel");
    assert_int_equal(cw_cad_part_face(parts, 0, f).number, f);
  }
  cw_cad_parts_free(&parts);
}

// Two halves of a disc become one; the common wall goes, pieces keep their names.
static void several_bodies_are_fused(void **) {
  const TopoDS_Shape disc = small_cylinder(0, 50, 10);
  const TopoDS_Shape left = BRepAlgoAPI_Cut(disc, small_box(0, -60, -1, 60, 120, 12)).Shape(),
                     right = BRepAlgoAPI_Cut(disc, small_box(-60, -60, -1, 60, 120, 12)).Shape();
  const CwCadBodies bodies = {{body(left, "left"), body(right, "right")}};
  const int domain[] = {0, 0};
  CwCadParts *parts = nullptr;
  if (make(bodies, domain, small_frame, 1, &parts)) fail_msg("%s", cw_fail_message());
  assert_near(small_volume(parts->part[0].solid) * std::pow(1e3 * cw_cad_parts_unit(parts), 3), M_PI * 2500 * 10, 1);
  int lefts = 0, rights = 0;
  for (const CwCadFaceOrigin &origin : parts->part[0].origin) {
    lefts += origin.name == "left";
    rights += origin.name == "right";
  }
  assert_true(lefts >= 3 && rights >= 3);
  assert_string_equal(parts->part[0].from.c_str(), "solid 1 'left' of pump.step and solid 2 'right' of pump.step");
  cw_cad_parts_free(&parts);
}

static void wrong_parts_are_told(void **) {
  CwCadParts *parts = nullptr;
  const int domain[] = {0, 0};
  const CwCadBodies apart = {{body(small_box(0, 0, 0, 9, 9, 9), "a"), body(small_box(20, 0, 0, 9, 9, 9), "b")}};
  assert_int_equal(make(apart, domain, small_frame, 1, &parts), CW_ERR_GEOMETRY);
  assert_non_null(
      strstr(cw_fail_message(), "cad.domains.rotor: its solids do not make one when they are fused, but 2"));
  cw_cad_parts_free(&parts);
  CwCadBodies huge = {{body(small_cylinder(0, 1e5, 1e4), "metres"), body(small_box(0, 0, 0, 1, 1, 1), "b")}};
  huge.body[0].file = "wheel.step"; // and the other is the first that the case names
  const int first[] = {0, -1};
  assert_int_equal(make(huge, first, small_frame, 1, &parts), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(),
                         "a diameter of 200 m; allowed: 5 mm to 10 m; where wheel.step has another unit give "
                         "cad.unit_mm, such as 1 for millimetres"));
  cw_cad_parts_free(&parts);
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(parts_stand_about_the_axis),
                                     cmocka_unit_test(several_bodies_are_fused),
                                     cmocka_unit_test(wrong_parts_are_told)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
