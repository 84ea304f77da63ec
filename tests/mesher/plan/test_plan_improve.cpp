// SPDX-License-Identifier: AGPL-3.0-or-later
// Planes whose line ends slantwise on a steep wall, and what becomes of them.
#include <BRepPrimAPI_MakeWedge.hxx>

extern "C" {
#include "mesher/common/vec.h"
#include "mesher/plan/plan_cost.h"
#include "mesher/plan/plan_improve.h"
#include "mesher/plan/plan_lines.h"
#include "mesher/policy.h"
}

#include "planned_solid.h"

// A wedge of 50 x 40 x 40 mm whose wall over x = 0 .. `run` mm rises to y = 40 mm, divided by the planes z = 20 mm and,
// on its negative side, x = `place` mm.
struct Wedge : PlannedSolid {
  CwPlanNode node[2] = {};
  double cells[3] = {0, 0, 0};
  CwPlan plan = {2, 3, node, cells, 0, 0, 0, 0};
  CwPlanPart half = {};

  Wedge(double run, double place) : PlannedSolid(BRepPrimAPI_MakeWedge(50, 40, 40, run, 0, 50, 40).Shape()) {
    node[0] = {{{0, 0, 1}, 0.020}, -1, {1, -3}, 0};
    node[1] = {{{1, 0, 0}, 1e-3 * place}, 0, {-1, -2}, 0};
    check(cw_plan_part_clip(&model, &whole, &node[0].plane, 0, &half));
    model.mean_work = half.work / 2;
  }
  ~Wedge() {
    cw_plan_part_free(&half);
  }
  double cosine() {
    CwPlanLines lines;
    check(cw_plan_lines(&model, &plan, 1, &half, &node[1].plane, INFINITY, &lines));
    assert_false(std::isinf(lines.cost));
    return lines.cosine;
  }
};

// The line of both planes goes along y, and at x = 12 mm meets a wall of 32 mm a run of 16 with a cosine of 0.37.
static void leaning_lines_are_raised(void **) {
  Wedge wedge(16, 12);
  assert_near(wedge.cosine(), 16 / std::hypot(16, 40), 1e-6);
  check(cw_plan_improve(&wedge.model, &wedge.plan, &wedge.whole, 0));
  assert_true(wedge.cosine() > 0.42);
  assert_near(cw_norm(wedge.node[1].plane.normal), 1, 1e-12);
  assert_near(wedge.cells[0] + wedge.cells[1] + wedge.cells[2], wedge.whole.work, 1e-9 * wedge.whole.work);
}

// Across a wall of 40 mm over a run of 30 the plane x = 25 mm stands at 37 degrees; its line leans less.
static void slantwise_planes_are_turned(void **) {
  Wedge wedge(30, 25);
  assert_true(wedge.cosine() > cw_policy.upright_cosine);
  check(cw_plan_improve(&wedge.model, &wedge.plan, &wedge.whole, 0));
  assert_false(cw_plan_is_sharp(wedge.node[1].worst));
}

static void planes_that_stand_well_are_left(void **) {
  Wedge wedge(40, 25);
  const CwPlane before[2] = {wedge.node[0].plane, wedge.node[1].plane};
  check(cw_plan_improve(&wedge.model, &wedge.plan, &wedge.whole, 0));
  for (int n = 0; n < 2; n++) assert_memory_equal(&before[n], &wedge.node[n].plane, sizeof before[n]);
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(leaning_lines_are_raised), cmocka_unit_test(slantwise_planes_are_turned),
                              cmocka_unit_test(planes_that_stand_well_are_left)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
