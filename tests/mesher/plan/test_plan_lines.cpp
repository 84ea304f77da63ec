// SPDX-License-Identifier: AGPL-3.0-or-later
// Lines in which a new plane meets the plane above it, in a box with layers on its walls.
#include <vector>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>

extern "C" {
#include "mesher/plan/plan_cost.h"
#include "mesher/plan/plan_lines.h"
}

#include "planned_solid.h"

// A solid with layers of 1 mm, as a rule a box of 40 x 30 x 20 mm, divided by the plane x = 21 mm.
struct Box : PlannedSolid {
  CwPlanNode node[2] = {};
  double none[3] = {0, 0, 0};
  CwPlan plan = {1, 2, node, none, 0, 0, 0, 0};

  explicit Box(const TopoDS_Shape &shape = BRepPrimAPI_MakeBox(40, 30, 20).Shape()) : PlannedSolid(shape) {
    node[0] = {{{1, 0, 0}, 0.021}, -1, {-1, 1}, 0};
    node[1].parent = 0;
  }
  // Of the plane with this normal through a point, in mm.
  double cost(double nx, double ny, double nz, double x, double y, double z) {
    double length = std::sqrt(nx * nx + ny * ny + nz * nz);
    CwPlane plane = {{nx / length, ny / length, nz / length}, 0};
    plane.offset = (nx * x + ny * y + nz * z) / length * 1e-3;
    CwPlanLines found;
    assert_int_equal(cw_plan_lines(&model, &plan, 1, &whole, &plane, INFINITY, &found), CW_OK);
    return found.cost;
  }
};

static void lines_with_room_cost_nothing(void **) {
  Box box;
  assert_near(box.cost(0, 1, 0, 30, 14, 10), 0, 1e-9);
  assert_near(box.cost(0, 0, 1, 30, 14, 10), 0, 1e-9);
}

// The line comes from the wall y = 30 mm to the floor at y = 2 mm; its cosine to the floor's normal is that of the
// case.
static void lines_tangent_to_a_wall_are_refused(void **) {
  Box box;
  const double cosine[] = {0.1, 0.29, 0.31, 0.4};
  for (double c : cosine) {
    double cost = box.cost(0, -c, std::sqrt(1 - c * c), 30, 2, 0);
    assert_int_equal(std::isinf(cost), c < 0.3);
    assert_true(cost > 0);
  }
}

// Columns along a line that leans much come out crooked: the more, the less is left to a cosine of 0.3.
static void lines_that_lean_much_cost_much(void **) {
  Box box;
  auto leaning = [&](double c) { return box.cost(0, -c, std::sqrt(1 - c * c), 30, 2, 0); };
  assert_true(std::isinf(leaning(0.29)));
  assert_near(leaning(0.35), 0.75 * 0.75, 1e-6); // of the way from a cosine of 0.5 to 0.3
}

static void lines_in_the_layers_are_refused(void **) {
  Box box;
  assert_true(std::isinf(box.cost(0, 0, 1, 30, 14, 0.9)));
  assert_true(std::isinf(box.cost(0, 0, 1, 30, 14, 19.1)));
  double cramped = box.cost(0, 0, 1, 30, 14, 1.3);
  assert_true(cramped > 0 && !std::isinf(cramped));
}

// Planes that meet under 40 degrees cost more than those over it, and parallel ones leave a region between them.
static void sharp_lines_cost_much(void **) {
  Box box;
  double sharp = box.cost(std::cos(35 * M_PI / 180), std::sin(35 * M_PI / 180), 0, 21, 15, 10);
  double fair = box.cost(std::cos(55 * M_PI / 180), std::sin(55 * M_PI / 180), 0, 21, 15, 10);
  assert_near(sharp, cw_plan_sharpness(std::sin(35 * M_PI / 180)), 1e-9);
  assert_near(fair, cw_plan_sharpness(std::sin(55 * M_PI / 180)), 1e-9);
  assert_true(std::isinf(box.cost(1, 0, 0, 21.1, 15, 10)));
  assert_near(box.cost(1, 0, 0, 31, 15, 10), 0, 1e-9);
}

// The line runs upwards outside the wall y = 30 mm, where edges of 2 mm are wanted: both planes cut that wall and its
// edges side by side, nearly at one place.
static void lines_just_outside_cost_as_those_without_room(void **) {
  Box box;
  auto outside = [&](double y) { return box.cost(std::sqrt(0.75), 0.5, 0, 21, y, 10); };
  assert_near(outside(30.001), CW_PLAN_FAULT, 1e-6);
  assert_near(outside(31.9), CW_PLAN_FAULT, 1e-6);
  assert_near(outside(36), 0, 1e-9);
}

// The line comes from the wall y = 0, enters a blade from floor to ceiling at y = 12 mm, and leaves it through the
// ceiling, so far before the edge of blade and ceiling at y = 48 mm, which both planes cross.
static void lines_that_leave_a_blade_at_its_edge_cost_as_those_without_room(void **) {
  TopoDS_Shape room = BRepPrimAPI_MakeBox(40, 60, 40).Shape();
  TopoDS_Shape blade = BRepPrimAPI_MakeBox(gp_Pnt(10, 12, 0), gp_Pnt(30, 48, 40)).Shape();
  Box box(BRepAlgoAPI_Cut(room, blade).Shape());
  auto before = [&](double y) { return box.cost(1, -1, 2, 21, 48 - y, 40); };
  assert_near(before(18), cw_plan_sharpness(std::sqrt(5.0 / 6)), 1e-9); // for the angle between the planes alone
  assert_near(before(0.1) - before(18), CW_PLAN_FAULT, 1e-6);
}

// Behind x = 21 mm lie as many planes as hundreds of regions have, and the last ends where the new one would begin.
static void the_last_of_many_planes_is_seen(void **) {
  Box box;
  const int32_t many = 200;
  std::vector<CwPlanNode> node(many + 1, box.node[0]);
  for (int32_t n = 1; n < many; n++) {
    node[n] = {{{0, 1, 0}, 0.024 - 1e-6 * n}, n - 1, {n + 1, -1 - n}, 0};
    node[n - 1].child[0] = n;
  }
  node[many - 1].plane.offset = 0.014;
  node[many - 1].child[0] = -1;
  node[0].child[1] = many;
  node[many] = {{}, 0, {INT32_MIN, INT32_MIN}, 0};
  box.plan.node = node.data();
  box.plan.node_count = many;
  auto cost = [&](double y) {
    CwPlane plane = {{0, 1, 0}, y};
    CwPlanLines found;
    assert_int_equal(cw_plan_lines(&box.model, &box.plan, many, &box.whole, &plane, INFINITY, &found), CW_OK);
    return found.cost;
  };
  assert_true(std::isinf(cost(0.0141)));
  assert_false(std::isinf(cost(0.019)));
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(lines_with_room_cost_nothing),
                              cmocka_unit_test(lines_tangent_to_a_wall_are_refused),
                              cmocka_unit_test(lines_that_lean_much_cost_much),
                              cmocka_unit_test(lines_in_the_layers_are_refused),
                              cmocka_unit_test(sharp_lines_cost_much),
                              cmocka_unit_test(lines_just_outside_cost_as_those_without_room),
                              cmocka_unit_test(lines_that_leave_a_blade_at_its_edge_cost_as_those_without_room),
                              cmocka_unit_test(the_last_of_many_planes_is_seen)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
