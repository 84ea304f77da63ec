// SPDX-License-Identifier: AGPL-3.0-or-later
// Sound solids stay as they are, bad ones are mended or refused with the place.
#include <BRepCheck_Analyzer.hxx>
#include <TopExp_Explorer.hxx>

#include "cad/small_parts.hpp"

extern "C" {
#include "geometry/cad/heal.h"
}

static void sound_solids_stay(void **) {
  SmallParts small({{"rotor", small_rotor()}});
  const TopoDS_Shape before = small.parts.part[0].solid;
  CwCadFault fault;
  assert_int_equal(cw_cad_heal(0.01, &small_frame, nullptr, &small.parts, &fault), CW_OK);
  assert_true(small.parts.part[0].solid.IsSame(before));
  assert_false(fault.found);
}

static void solids_inside_out_are_turned(void **) {
  SmallParts small({{"water", small_box(0, 0, 0, 1, 2, 3)}});
  small.parts.part[0].solid.Reverse();
  CwCadFault fault;
  assert_true(small_volume(small.parts.part[0].solid) < 0);
  assert_int_equal(cw_cad_heal(0.01, &small_frame, nullptr, &small.parts, &fault), CW_OK);
  assert_near(small_volume(small.parts.part[0].solid), 6, 1e-9);
}

// A box of six faces that share nothing, the lid 0.005 off: sewn within 0.01.
static TopoDS_Shape loose_box(double gap, int faces) {
  const TopoDS_Shape box = small_box(0, 0, 0, 1, 2, 3);
  const TopTools_IndexedMapOfShape map = cw_cad_faces(box);
  BRep_Builder builder;
  TopoDS_Shell shell;
  TopoDS_Solid solid;
  builder.MakeShell(shell);
  for (int f = 1; f <= faces; f++) {
    gp_Trsf motion;
    if (f == 6) motion.SetTranslation(gp_Vec(0, 0, gap)); // the lid
    builder.Add(shell, BRepBuilderAPI_Transform(map(f), motion, Standard_True).Shape());
  }
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  return solid;
}

static void gaps_are_sewn(void **) {
  SmallParts small({{"water", loose_box(0.005, 6)}});
  CwCadFault fault;
  if (cw_cad_heal(0.01, &small_frame, nullptr, &small.parts, &fault)) fail_msg("%s", cw_fail_message());
  assert_true(BRepCheck_Analyzer(small.parts.part[0].solid).IsValid());
  assert_near(small_volume(small.parts.part[0].solid), 6, 0.02);
  assert_int_equal(small.parts.part[0].origin.size(), 6);
}

// Faces that share nothing, as one solid.
static TopoDS_Shape loose_solid(const std::vector<TopoDS_Shape> &bodies) {
  BRep_Builder builder;
  TopoDS_Shell shell;
  TopoDS_Solid solid;
  builder.MakeShell(shell);
  for (const TopoDS_Shape &body : bodies)
    for (TopExp_Explorer at(body, TopAbs_FACE); at.More(); at.Next()) builder.Add(shell, at.Current());
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  return solid;
}

static TopoDS_Shape moved(const TopoDS_Shape &shape, double x, double scale) {
  gp_Trsf motion;
  motion.SetScale(gp_Pnt(0, 0, 0), scale);
  motion.SetTranslationPart(gp_Vec(x, x, x));
  return BRepBuilderAPI_Transform(shape, motion, Standard_True).Shape();
}

// The void is a box in the box, whose lid is off as that of the outer one is.
static void voids_stay(void **) {
  SmallParts small({{"water", loose_solid({loose_box(0.005, 6), moved(loose_box(0.005, 6), 0.3, 0.3)})}});
  CwCadFault fault;
  if (cw_cad_heal(0.01, &small_frame, nullptr, &small.parts, &fault)) fail_msg("%s", cw_fail_message());
  assert_true(BRepCheck_Analyzer(small.parts.part[0].solid).IsValid());
  assert_near(small_volume(small.parts.part[0].solid), 6 * (1 - 0.027), 0.02);
  assert_int_equal(small.parts.part[0].origin.size(), 12);
}

static void several_solids_are_refused(void **) {
  SmallParts small({{"water", loose_solid({loose_box(0.005, 6), moved(loose_box(0.005, 6), 5, 1)})}});
  CwCadFault fault;
  assert_int_equal(cw_cad_heal(0.01, &small_frame, nullptr, &small.parts, &fault), CW_ERR_GEOMETRY);
  assert_non_null(strstr(cw_fail_message(), "; sewn, it makes 2 solids, one at ("));
  assert_non_null(strstr(cw_fail_message(), "; allowed: one closed, valid solid"));
}

static void refusals_name_solid_face_and_gap(void **) {
  SmallParts small({{"wheel", small_box(5, 5, 5, 1, 1, 1)}, {"water", loose_box(0.02, 6)}});
  small.parts.part[1].from = "solid 2 'tank' of pump.step";
  for (CwCadFaceOrigin &origin : small.parts.part[1].origin) origin.name = "SIDE";
  CwCadFault fault;
  assert_int_equal(cw_cad_heal(0.01, &small_frame, nullptr, &small.parts, &fault), CW_ERR_GEOMETRY);
  const char *at = strstr(cw_fail_message(), ": solid 2 'tank' of pump.step, face ");
  int face = 0;
  assert_non_null(at);
  assert_int_equal(sscanf(at, ": solid 2 'tank' of pump.step, face %d 'SIDE': 8 edges", &face), 1);
  assert_true(face > 6 && face <= 12); // behind the six of the wheel
  assert_non_null(strstr(at, "'SIDE': 8 edges do not lie between two faces, one at ("));
  assert_non_null(strstr(at, " mm, open by 0.02 mm; allowed"));
}

static void what_stays_open_is_refused_with_its_place(void **) {
  SmallParts small({{"wheel", small_box(5, 5, 5, 1, 1, 1)}, {"water", loose_box(0, 5)}});
  CwCadFault fault;
  assert_int_equal(cw_cad_heal(0.01, &small_frame, nullptr, &small.parts, &fault), CW_ERR_GEOMETRY);
  assert_non_null(strstr(cw_fail_message(), "cad.domains.water: the solid cannot be healed within 0.01 mm"));
  assert_non_null(strstr(cw_fail_message(), "edges do not lie between two faces"));
  assert_non_null(strstr(cw_fail_message(), "mm; allowed"));
  assert_true(fault.found);
  assert_int_equal(fault.part, 1);
  assert_near(fault.at[2], 3e-3, 1e-9); // the lid is missing
}

// A box one corner of which lies at `at`, and is said to be within 0.9 mm of its edges.
static TopoDS_Shape wide_cornered_box(const gp_Pnt &at) {
  const TopoDS_Shape box = small_box(0, 0, 0, 1, 2, 3);
  for (TopExp_Explorer corner(box, TopAbs_VERTEX); corner.More(); corner.Next()) {
    const TopoDS_Vertex &vertex = TopoDS::Vertex(corner.Current());
    if (BRep_Tool::Pnt(vertex).Distance(gp_Pnt(1, 2, 3)) < 1e-9) BRep_Builder().UpdateVertex(vertex, at, 0.9);
  }
  return box;
}

static void tolerances_that_are_not_needed_go(void **) {
  SmallParts small({{"water", wide_cornered_box(gp_Pnt(1, 2, 3))}});
  CwCadFault fault;
  if (cw_cad_heal(0.01, &small_frame, nullptr, &small.parts, &fault)) fail_msg("%s", cw_fail_message());
  assert_true(BRepCheck_Analyzer(small.parts.part[0].solid).IsValid());
  for (TopExp_Explorer at(small.parts.part[0].solid, TopAbs_VERTEX); at.More(); at.Next())
    assert_true(BRep_Tool::Tolerance(TopoDS::Vertex(at.Current())) <= 0.1);
  assert_near(small_volume(small.parts.part[0].solid), 6, 1e-9);
}

// Edges that meet in a corner within 0.7 mm alone, where 0.01 mm are allowed: the refusal names that corner.
static void wide_corners_are_refused_with_their_place(void **) {
  SmallParts small({{"water", wide_cornered_box(gp_Pnt(1.4, 2.4, 3.4))}});
  CwCadFault fault;
  assert_int_equal(cw_cad_heal(0.01, &small_frame, nullptr, &small.parts, &fault), CW_ERR_GEOMETRY);
  assert_non_null(strstr(cw_fail_message(), "fit one another within no less than 9"));
  assert_true(fault.found);
  for (int k = 0; k < 3; k++) assert_near(fault.at[k], 1e-3 * (k + 1.4), 1e-9);
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(sound_solids_stay),
                                     cmocka_unit_test(solids_inside_out_are_turned),
                                     cmocka_unit_test(gaps_are_sewn),
                                     cmocka_unit_test(voids_stay),
                                     cmocka_unit_test(several_solids_are_refused),
                                     cmocka_unit_test(refusals_name_solid_face_and_gap),
                                     cmocka_unit_test(what_stays_open_is_refused_with_its_place),
                                     cmocka_unit_test(tolerances_that_are_not_needed_go),
                                     cmocka_unit_test(wide_corners_are_refused_with_their_place)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
