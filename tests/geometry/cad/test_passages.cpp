// SPDX-License-Identifier: AGPL-3.0-or-later
// Wheels of primitives, whose volumes formulas give: made symmetric they keep them, and every corner has its images to
// the last digits. Wheels that only look symmetric stay as they are.
#include "cad/small_parts.hpp"

#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <GProp_GProps.hxx>

#include "geometry/cad/divide.h"
#include "geometry/cad/images.hpp"
#include "geometry/cad/passages.h"
#include "geometry/solid.hpp"

static const double tolerance = 1e-4; // mm, the unit of the parts

static TopoDS_Shape turned(const TopoDS_Shape &shape, double degrees) {
  gp_Trsf turn;
  turn.SetRotation(gp::OZ(), degrees * M_PI / 180);
  return BRepBuilderAPI_Transform(shape, turn, Standard_True).Shape();
}

// A ring from radius 20 to 60 and 10 thick, less `count` tools.
static TopoDS_Shape ring_less(const TopoDS_Shape &tool, int count) {
  TopoDS_Shape ring = BRepAlgoAPI_Cut(small_cylinder(0, 60, 10), small_cylinder(-1, 20, 12)).Shape();
  for (int k = 0; k < count; k++) ring = BRepAlgoAPI_Cut(ring, turned(tool, 360.0 * k / count)).Shape();
  return ring;
}

static const double ring_volume = M_PI * (3600 - 400) * 10;

static CwCadPart made_of(const TopoDS_Shape &solid, int count) {
  SmallParts small({{"wheel", solid}});
  const int pieces = count;
  if (cw_cad_divide(&pieces, &small_frame, nullptr, &small.parts)) fail_msg("%s", cw_fail_message());
  if (cw_cad_passages(0, count, tolerance, nullptr, &small.parts)) fail_msg("%s", cw_fail_message());
  return small.parts.part[0];
}

static void check(const TopoDS_Shape &solid, int count, double volume) {
  const CwCadPart made = made_of(solid, count);
  CwImagesOfSolid images;
  assert_true(BRepCheck_Analyzer(made.solid).IsValid());
  assert_near(small_volume(made.solid), volume, 1e-6 * volume);
  const std::string why = images.find(made.solid, count, 1e-10, 1e-3);
  if (!why.empty()) fail_msg("%s", why.c_str());
  assert_int_equal(made.origin.size(), images.faces.Extent());
  for (int f = 0; f < images.faces.Extent(); f++) {
    assert_true(made.origin[f].number >= 0);
    if (!images.is_fixed(f)) continue;
    // What is left whole is a disc about the axis: its outline has the area of a circle.
    GProp_GProps area, outline;
    BRepGProp::SurfaceProperties(images.faces(f + 1), area);
    BRepGProp::LinearProperties(images.faces(f + 1), outline);
    assert_near(4 * M_PI * area.Mass() / (outline.Mass() * outline.Mass()), 1, 1e-6);
  }
}

// The rims of the notches are open to the outside: hub and shroud are one face each, without a seam.
static void notched_rings(void **) {
  const TopoDS_Shape notch = small_box(40, -2, -1, 30, 4, 12);
  const double outside = 3600 * std::asin(2.0 / 60) + 2 * std::sqrt(3600 - 4.0); // area of |y| < 2, x > 0 in the disc
  check(ring_less(notch, 5), 5, ring_volume - 5 * 10 * (outside - 40 * 4));
  check(ring_less(turned(notch, 17), 7), 7, ring_volume - 7 * 10 * (outside - 40 * 4));
}

// Holes: faces with several outlines.
static void pierced_rings(void **) {
  const TopoDS_Shape hole = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(40, 0, -1), gp::DZ()), 5, 12).Shape();
  check(ring_less(hole, 3), 3, ring_volume - 3 * 10 * M_PI * 25);
  check(ring_less(turned(hole, 31), 4), 4, ring_volume - 4 * 10 * M_PI * 25);
}

// The small pump's wheel has a disc with six holes, through which the axis goes.
static void a_disc_with_blades(void **) {
  check(small_rotor(), 6, M_PI * 2500 * 10 + M_PI * 400 * 55 - 6 * 20 * 3 * 10);
}

// A cone's seam ends at a notch: one passage has a corner that the others lack.
static void a_seam_that_ends_at_a_blade(void **) {
  TopoDS_Shape cone = BRepPrimAPI_MakeCone(60, 30, 30).Shape();
  for (int k = 0; k < 3; k++) cone = BRepAlgoAPI_Cut(cone, turned(small_box(45, -2, -1, 30, 4, 12), 120 * k)).Shape();
  check(cone, 3, small_volume(cone));
}

// A cone up to its tip, and half a ball: all passages meet in a corner on the axis, where their faces have poles.
static void a_nose_that_ends_on_the_axis(void **) {
  for (TopoDS_Shape nose : {BRepPrimAPI_MakeCone(60, 0, 40).Shape(), BRepPrimAPI_MakeSphere(60, 0, M_PI / 2).Shape()}) {
    for (int k = 0; k < 5; k++) nose = BRepAlgoAPI_Cut(nose, turned(small_box(45, -2, -1, 30, 4, 40), 72 * k)).Shape();
    check(nose, 5, small_volume(nose));
  }
}

static void what_is_not_symmetric_stays(void **) {
  TopoDS_Shape ring = ring_less(small_box(40, -2, -1, 30, 4, 12), 5);
  ring = BRepAlgoAPI_Cut(ring, turned(small_box(39.9, -2, -1, 30, 4, 12), 72)).Shape(); // one is deeper by 0.1 mm
  const double volume = small_volume(ring);
  const CwCadPart made = made_of(ring, 5);
  CwImagesOfSolid images;
  assert_near(small_volume(made.solid), volume, 1e-9 * volume);
  const std::string why = images.find(made.solid, 5, tolerance, 1e-3);
  if (why.find("is 0.1 mm off its image") == std::string::npos) fail_msg("%s", why.c_str());
}

// The faces of a wheel of images in another order, all of it pushed aside by less than the tolerance.
static TopoDS_Shape reordered_and_moved(const TopoDS_Shape &solid, double aside) {
  const TopTools_IndexedMapOfShape faces = cw_cad_faces(solid);
  BRep_Builder builder;
  TopoDS_Shell shell;
  TopoDS_Solid made;
  gp_Trsf move;
  move.SetTranslation(gp_Vec(aside, 0, 0));
  builder.MakeShell(shell);
  for (int f = 0; f < faces.Extent(); f++) builder.Add(shell, faces(1 + (11 * f + 3) % faces.Extent()));
  shell.Closed(Standard_True);
  builder.MakeSolid(made);
  builder.Add(made, shell);
  return BRepBuilderAPI_Transform(made, move, Standard_True).Shape();
}

static void faces_keep_their_order(void **) {
  const CwCadPart wheel = made_of(ring_less(small_box(40, -2, -1, 30, 4, 12), 5), 5);
  const TopoDS_Shape given = reordered_and_moved(wheel.solid, 1e-6);
  const CwCadPart made = made_of(given, 5);
  const TopTools_IndexedMapOfShape before = cw_cad_faces(given), after = cw_cad_faces(made.solid);
  assert_int_equal(before.Extent(), 35);
  assert_int_equal(after.Extent(), before.Extent());
  for (int f = 1; f <= before.Extent(); f++) {
    GProp_GProps old, fresh;
    BRepGProp::SurfaceProperties(before(f), old);
    BRepGProp::SurfaceProperties(after(f), fresh);
    assert_true(old.CentreOfMass().Distance(fresh.CentreOfMass()) < tolerance);
  }
}

static void images_keep_their_bits(void **) {
  const CwCadPart wheel = made_of(ring_less(small_box(40, -2, -1, 30, 4, 12), 5), 5);
  assert_true(made_of(wheel.solid, 5).solid.IsSame(wheel.solid));
}

// Why a wheel stays as it is: an exception without text is a reason too.
static void failures_have_a_text(void **) {
  assert_string_equal(cw_solid_failure_text(Standard_Failure()).c_str(), "failed without a word");
  assert_string_equal(cw_solid_failure_text(Standard_Failure("no curve")).c_str(), "no curve");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(notched_rings),
      cmocka_unit_test(pierced_rings),
      cmocka_unit_test(a_disc_with_blades),
      cmocka_unit_test(a_seam_that_ends_at_a_blade),
      cmocka_unit_test(a_nose_that_ends_on_the_axis),
      cmocka_unit_test(what_is_not_symmetric_stays),
      cmocka_unit_test(faces_keep_their_order),
      cmocka_unit_test(images_keep_their_bits),
      cmocka_unit_test(failures_have_a_text),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
