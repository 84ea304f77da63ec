// SPDX-License-Identifier: AGPL-3.0-or-later
// Planes that touch a face or an edge where they ought to cross it: they are refused, so that others may be tried.
// Modules without a test of their own that it runs: network_parallel, network_trace, network_make, network_curve.
#include <cstring>

#include <BRepPrimAPI_MakeCylinder.hxx>

extern "C" {
#include "mesher/cad/background_make.h"
#include "mesher/network/network.h"
}

#include "solids.h"

// Half a cylinder of 20 mm radius and 30 mm length over the plane y = 0, and one partition plane.
struct Half {
  CwCad *cad = open_solid(BRepPrimAPI_MakeCylinder(20, 30, M_PI).Shape());
  CwBackground background;
  CwVerticals *inside = nullptr;
  CwPlanNode node = {};
  double none[2] = {0, 0};
  CwNetwork network;
  CwOutcome outcome;

  Half() {
    assert_int_equal(cw_background_make(cad, 1e-4, 0.2, &background), CW_OK);
    assert_int_equal(cw_verticals_make(background.x, background.triangle_count, background.triangle, &inside), CW_OK);
  }
  ~Half() {
    cw_verticals_free(&inside);
    cw_background_free(&background);
    cw_cad_close(&cad);
  }
  CwOutcomeKind divide(const CwPlane &plane) {
    node = {plane, -1, {-1, -2}, 0};
    CwPlan plan = {1, 2, &node, none, 0, 0, 0, 0};
    outcome = {};
    assert_int_equal(cw_network_make(NULL, cad, &background, inside, &plan, &network, &outcome), CW_OK);
    if (outcome.kind == CW_OUTCOME_DONE) cw_network_free(&network);
    return outcome.kind;
  }
};

// The highest point of the background, on one of the two arcs.
static double highest(const CwBackground &background, double *x) {
  double most = 0;
  for (int i = 0; i < background.point_count; i++) {
    if (background.x[i][1] > most) most = background.x[i][1], *x = background.x[i][0];
  }
  return most;
}

static void a_plane_through_the_middle_divides(void **) {
  Half half;
  assert_int_equal(half.divide({{0, 1, 0}, 0.011}), CW_OUTCOME_DONE);
  assert_int_equal(half.divide({{0, 0, 1}, 0.017}), CW_OUTCOME_DONE);
}

static void a_plane_that_grazes_is_refused(void **) {
  Half half;
  double x = 0, top = highest(half.background, &x);
  // A tenth of a micrometre below a point of the background on the arc, and parallel to the surface there.
  assert_near(std::hypot(x, top), 0.02, 1e-9);
  CwPlane plane = {{x / 0.02, top / 0.02, 0}, 0.02 - 1e-7};
  assert_int_equal(half.divide(plane), CW_OUTCOME_REPLAN);
  assert_non_null(strstr(half.outcome.reason, "partition plane 0 grazes"));
  assert_near(std::hypot(half.outcome.place[0], half.outcome.place[1]), 0.02, 1e-3);
  char text[CW_OUTCOME_TEXT_SIZE];
  print_message("  %s\n", cw_outcome_text(&half.outcome, 1e3, text));
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(a_plane_through_the_middle_divides),
                              cmocka_unit_test(a_plane_that_grazes_is_refused)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
