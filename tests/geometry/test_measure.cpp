// SPDX-License-Identifier: AGPL-3.0-or-later
// What is wrong with a solid is told with the face; dimensions of rotors and stators are measured in test_pump and
// test_rotor.
#include "geometry/measure.h"

#include <cstring>

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>

#include "geometry/solid.hpp"
#include "tests/unit_test.h"

// A box of 1 by 2 by 3 units of 1 mm with its first faces, as they are named: face 1 and so on.
static CwSolid box(int faces) {
  TopTools_IndexedMapOfShape map;
  BRep_Builder builder;
  TopoDS_Shell shell;
  CwSolid solid = {"box", 1e-3, TopoDS_Solid(), {}};
  TopExp::MapShapes(BRepPrimAPI_MakeBox(1, 2, 3).Shape(), TopAbs_FACE, map);
  builder.MakeShell(shell);
  for (int i = 1; i <= faces; i++) {
    builder.Add(shell, map(i));
    solid.faces.push_back({TopoDS::Face(map(i)), "wall", CW_PATCH_WALL, std::to_string(i)});
  }
  shell.Closed(faces == map.Extent());
  builder.MakeSolid(solid.solid);
  builder.Add(solid.solid, shell);
  return solid;
}

static CwMeasuredSolid measured(const CwSolid &solid) {
  CwMeasuredSolid found;
  if (cw_measure_solid(&solid, &found) != CW_OK) fail_msg("%s", cw_fail_message());
  return found;
}

static void a_box_is_sound(void **) {
  const CwMeasuredSolid whole = measured(box(6));
  assert_true(whole.valid && whole.closed);
  assert_string_equal(whole.fault, "");
  assert_int_equal(whole.face_count, 6);
  assert_near(whole.volume, 6e-9, 1e-15);
  assert_near(whole.shortest_edge, 1e-3, 1e-9);
}

static void an_open_box_names_a_face(void **) {
  const CwMeasuredSolid open = measured(box(5));
  assert_false(open.closed);
  assert_non_null(strstr(open.fault, "face "));
  assert_non_null(strstr(open.fault, "has an edge that no other face shares"));
}

static void a_box_inside_out_is_unsound(void **) {
  CwSolid solid = box(6);
  solid.solid.Reverse();
  const CwMeasuredSolid turned = measured(solid);
  assert_false(turned.valid);
  assert_string_not_equal(turned.fault, "");
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_box_is_sound), cmocka_unit_test(an_open_box_names_a_face),
                                     cmocka_unit_test(a_box_inside_out_is_unsound)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
