// SPDX-License-Identifier: AGPL-3.0-or-later
// Traces of all planes, each made by itself and packed, are those that one after the other leaves in one network.
#include <cstring>

#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>

#include "divided_solid.h"

static void same_network(const CwNetwork &a, const CwNetwork &b) {
  assert_int_equal(a.corner_count, b.corner_count);
  assert_int_equal(a.curve_count, b.curve_count);
  for (int i = 0; i < a.corner_count; i++) {
    const CwCorner &p = a.corner[i], &q = b.corner[i];
    assert_memory_equal(p.x, q.x, sizeof p.x);
    assert_memory_equal(p.plane, q.plane, sizeof p.plane);
    assert_int_equal(p.face, q.face);
    assert_int_equal(p.edge, q.edge);
    assert_int_equal(p.vertex, q.vertex);
    assert_near(p.t, q.t, 0);
  }
  for (int i = 0; i < a.curve_count; i++) {
    const CwCurve &p = a.curve[i], &q = b.curve[i];
    const size_t n = (size_t)p.fine_count;
    assert_int_equal(p.fine_count, q.fine_count);
    assert_int_equal(p.kind, q.kind);
    assert_int_equal(p.wall, q.wall);
    assert_int_equal(p.edge, q.edge);
    assert_memory_equal(p.corner, q.corner, sizeof p.corner);
    assert_memory_equal(p.face, q.face, sizeof p.face);
    assert_memory_equal(p.plane, q.plane, sizeof p.plane);
    assert_memory_equal(p.fine_x, q.fine_x, n * sizeof *p.fine_x);
    assert_memory_equal(p.fine_parameter, q.fine_parameter, n * sizeof *p.fine_parameter);
    assert_memory_equal(p.fine_length, q.fine_length, n * sizeof *p.fine_length);
    assert_true(p.fine_x != q.fine_x);
  }
}

static void one_after_the_other(DividedSolid &solid, const std::vector<DividingPlane> &planes) {
  solid.divide(planes);
  for (int32_t i = 0; i < solid.plan.node_count && solid.outcome.kind == CW_OUTCOME_DONE; i++)
    check(cw_network_trace(&solid.network, &solid.background, i, &solid.outcome));
}

static void all_planes_are_those_of_each(void **) {
  uint64_t seed = 1;
  int shared = 0;
  for (int i = 0; i < 12; i++) {
    const TopoDS_Shape shape =
        i % 2 ? BRepPrimAPI_MakeSphere(20, -1, 1, M_PI).Shape() : BRepPrimAPI_MakeCylinder(20, 40, 2).Shape();
    DividedSolid each(shape), all(shape);
    std::vector<DividingPlane> planes;
    for (int p = 0; p < 4; p++) {
      double x[3] = {0.01 * draw(&seed), 0.002 + 0.01 * draw(&seed), i % 2 ? 0 : 0.01 + 0.02 * draw(&seed)};
      planes.push_back({random_plane(x, &seed), p == 0 ? -1 : p == 3 ? 1 : 0, p == 3 ? i / 2 % 2 : p - 1});
    }
    one_after_the_other(each, planes);
    if (each.outcome.kind != CW_OUTCOME_DONE) continue;
    all.divide(planes);
    all.outcome.domain = 5;
    check(cw_network_trace_all(NULL, &all.network, &all.background, &all.outcome));
    assert_int_equal(all.outcome.kind, CW_OUTCOME_DONE);
    assert_int_equal(all.outcome.domain, 5); // stays
    same_network(each.network, all.network);
    for (int c = 0; c < all.network.corner_count; c++) shared += all.network.corner[c].plane[1] >= 0;
    // Corners that a network has already are found again, and numbered from there.
    const int corners = all.network.corner_count, curves = all.network.curve_count;
    check(cw_network_trace_all(NULL, &all.network, &all.background, &all.outcome));
    assert_int_equal(all.network.corner_count, corners);
    assert_int_equal(all.network.curve_count, 2 * curves);
    for (int c = 0; c < curves; c++)
      assert_memory_equal(all.network.curve[c].corner, all.network.curve[curves + c].corner, 2 * sizeof(int32_t));
  }
  assert_true(shared > 20);
}

// Of several planes that are refused the first is named, whatever stands before it.
static void the_first_refusal_is_told(void **) {
  const TopoDS_Shape shape = BRepPrimAPI_MakeCylinder(20, 40, M_PI).Shape();
  DividedSolid each(shape), all(shape);
  double most = 0;
  const double *high = nullptr;
  for (int i = 0; i < each.background.point_count; i++)
    if (each.background.x[i][1] > most) most = each.background.x[i][1], high = each.background.x[i];
  const double x = high[0], y = high[1], r = std::hypot(x, y);
  const CwPlane level = {{0, 0, 1}, 0.02}, grazes = {{x / r, y / r, 0}, 0.02 - 1e-7};
  const std::vector<DividingPlane> planes = {{level, -1, 0}, {grazes, 0, 0}, {grazes, 0, 1}};
  one_after_the_other(each, planes);
  assert_int_equal(each.outcome.kind, CW_OUTCOME_REPLAN);
  all.divide(planes);
  all.outcome.domain = 3;
  check(cw_network_trace_all(NULL, &all.network, &all.background, &all.outcome));
  assert_int_equal(all.outcome.kind, CW_OUTCOME_REPLAN);
  assert_int_equal(all.outcome.domain, 3);
  assert_string_equal(all.outcome.reason, each.outcome.reason);
  assert_non_null(std::strstr(all.outcome.reason, "partition plane 1 grazes"));
  assert_memory_equal(all.outcome.place, each.outcome.place, sizeof all.outcome.place);
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(all_planes_are_those_of_each),
                              cmocka_unit_test(the_first_refusal_is_told)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
