// SPDX-License-Identifier: AGPL-3.0-or-later
// Boxes about the axis, millimetres: which end leads to the impeller, and where the fluid on the axis ends.
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepPrimAPI_MakeBox.hxx>

#include "planned_solid.h"

extern "C" {
#include "mesher/plan/plan_axis.h"
}

static TopoDS_Shape box(double half, double from, double to) {
  return BRepPrimAPI_MakeBox(gp_Pnt(-half, -half, from), 2 * half, 2 * half, to - from).Shape();
}

static const double step = 0.07 / 400; // m: places at which the axis is looked at

static int found(const TopoDS_Shape &shape, CwPlanAxis *axis) {
  PlannedSolid solid(shape);
  return cw_plan_axis_find(&solid.background, solid.inside, axis);
}

// A pipe below a wheel with a hub in it, which ends at z = 30.
static void fluid_at_one_end(void **) {
  const TopoDS_Shape water = BRepAlgoAPI_Fuse(box(8, 0, 40), box(20, 40, 70)).Shape();
  CwPlanAxis axis;
  assert_true(found(BRepAlgoAPI_Cut(water, box(3, 30, 71)).Shape(), &axis));
  assert_near(axis.up, 1, 0);
  assert_near(axis.low, 0, 1e-9);
  assert_near(axis.high, 0.07, 1e-9);
  assert_near(axis.nose, 0.03, step);
  assert_true(found(BRepAlgoAPI_Cut(water, box(3, -1, 30)).Shape(), &axis));
  assert_near(axis.up, -1, 0);
  assert_near(axis.low, -0.07, 1e-9);
  assert_near(axis.high, 0, 1e-9);
  assert_near(axis.nose, -0.03, step);
}

static void a_shaft_from_end_to_end(void **) {
  CwPlanAxis axis;
  const TopoDS_Shape shaft = box(3, -1, 71);
  assert_true(found(BRepAlgoAPI_Cut(BRepAlgoAPI_Fuse(box(8, 0, 40), box(20, 40, 70)).Shape(), shaft).Shape(), &axis));
  assert_near(axis.up, 1, 0);
  assert_near(axis.nose, 0, 1e-9);
  assert_true(found(BRepAlgoAPI_Cut(BRepAlgoAPI_Fuse(box(20, 0, 30), box(8, 30, 70)).Shape(), shaft).Shape(), &axis));
  assert_near(axis.up, -1, 0);
  assert_near(axis.nose, -0.07, 1e-9);
}

static void fluid_at_both_ends(void **) {
  CwPlanAxis axis;
  assert_false(found(box(20, 0, 70), &axis));
  assert_false(found(BRepAlgoAPI_Cut(box(20, 0, 70), box(3, 20, 40)).Shape(), &axis));
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(fluid_at_one_end),
      cmocka_unit_test(a_shaft_from_end_to_end),
      cmocka_unit_test(fluid_at_both_ends),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
