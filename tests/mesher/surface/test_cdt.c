// SPDX-License-Identifier: AGPL-3.0-or-later
#include <string.h>

#include "mesher/surface/cdt.h"
#include "tests/unit_test.h"

enum { MOST = 64 };

typedef struct {
  double uv[MOST][2], x[MOST][3];
  int32_t edge[MOST][2];
  uint8_t boundary[MOST];
  CwPatchInput input;
} Plan;

// Points are in metres on the plane z = 0.25 with x = u, y = v.
static int32_t add_point(Plan *plan, double u, double v) {
  int32_t p = plan->input.point_count++;
  plan->uv[p][0] = plan->x[p][0] = u;
  plan->uv[p][1] = plan->x[p][1] = v;
  plan->x[p][2] = 0.25;
  plan->input.uv = (const double(*)[2])plan->uv;
  plan->input.x = (const double(*)[3])plan->x;
  plan->input.edge = (const int32_t(*)[2])plan->edge;
  plan->input.boundary = plan->boundary;
  plan->input.name = "lid";
  return p;
}

static void add_edge(Plan *plan, int32_t a, int32_t b, int boundary) {
  int32_t e = plan->input.edge_count++;
  plan->edge[e][0] = a;
  plan->edge[e][1] = b;
  plan->boundary[e] = (uint8_t)boundary;
}

static void add_square(Plan *plan, double low, double high) {
  int32_t p = add_point(plan, low, low);
  add_point(plan, high, low);
  add_point(plan, high, high);
  add_point(plan, low, high);
  for (int k = 0; k < 4; k++) add_edge(plan, p + k, p + (k + 1) % 4, 1);
}

static double area(const Plan *plan, const CwCdt *cdt) {
  double sum = 0;
  for (int32_t t = 0; t < cdt->triangle_count; t++) {
    const double *a = plan->uv[cdt->triangle[t][0]], *b = plan->uv[cdt->triangle[t][1]],
                 *c = plan->uv[cdt->triangle[t][2]];
    double cross = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    assert_true(cross > 0);
    sum += 0.5 * cross;
  }
  return sum;
}

static void check_neighbours(const CwCdt *cdt) {
  for (int32_t t = 0; t < cdt->triangle_count; t++)
    for (int i = 0; i < 3; i++) {
      int32_t n = cdt->neighbour[t][i];
      if (n < 0) {
        assert_true(cdt->given[t] >> i & 1);
        continue;
      }
      int back = 0;
      for (int j = 0; j < 3; j++)
        if (cdt->neighbour[n][j] == t && cdt->triangle[n][(j + 1) % 3] == cdt->triangle[t][(i + 2) % 3] &&
            cdt->triangle[n][(j + 2) % 3] == cdt->triangle[t][(i + 1) % 3]) {
          back++;
          assert_int_equal(cdt->given[n] >> j & 1, cdt->given[t] >> i & 1);
        }
      assert_int_equal(back, 1);
    }
}

static const double unit[2] = {1, 1};

static void a_diagonal_cuts_a_square_in_two(void **state) {
  Plan plan = {0};
  CwCdt cdt;
  add_square(&plan, 0, 1);
  add_edge(&plan, 3, 1, 0);
  assert_int_equal(cw_cdt_make(&plan.input, unit, &cdt, &(CwOutcome){0}), CW_OK);
  const int32_t expected[2][3] = {{0, 1, 3}, {1, 2, 3}};
  assert_int_equal(cdt.triangle_count, 2);
  assert_memory_equal(cdt.triangle, expected, sizeof expected);
  assert_int_equal(cdt.component_count, 2);
  assert_int_equal(cdt.component[0], 0);
  assert_int_equal(cdt.component[1], 1);
  check_neighbours(&cdt);
  cw_cdt_free(&cdt);
}

static void nested_loops_alternate(void **state) {
  Plan plan = {0};
  CwCdt cdt;
  add_square(&plan, 0, 10);
  add_square(&plan, 2, 8);
  add_square(&plan, 4, 6);
  assert_int_equal(cw_cdt_make(&plan.input, unit, &cdt, &(CwOutcome){0}), CW_OK);
  // 100 - 36 + 4; the ring has 8 triangles, the island 2.
  assert_near(area(&plan, &cdt), 68, 1e-12);
  assert_int_equal(cdt.triangle_count, 10);
  assert_int_equal(cdt.component_count, 2);
  check_neighbours(&cdt);
  cw_cdt_free(&cdt);
}

static void boundary_may_touch_itself_at_a_point(void **state) {
  Plan plan = {0};
  CwCdt cdt;
  add_square(&plan, 0, 2);
  int32_t q = add_point(&plan, 1, 0.5);
  add_point(&plan, 0.5, 1);
  // A triangular hole that hangs on the corner at the origin.
  add_edge(&plan, 0, q, 1);
  add_edge(&plan, q, q + 1, 1);
  add_edge(&plan, q + 1, 0, 1);
  assert_int_equal(cw_cdt_make(&plan.input, unit, &cdt, &(CwOutcome){0}), CW_OK);
  assert_near(area(&plan, &cdt), 4 - 0.375, 1e-12);
  check_neighbours(&cdt);
  cw_cdt_free(&cdt);
}

// The Delaunay diagonal of a kite depends on the scale of the plane.
static void scale_decides_the_diagonal(void **state) {
  Plan plan = {0};
  CwCdt cdt;
  const double tall[2] = {1, 4}, flat[2] = {4, 1};
  const double kite[4][2] = {{-1, 0}, {0, -1}, {1, 0.01}, {0, 1}};
  for (int k = 0; k < 4; k++) add_point(&plan, kite[k][0], kite[k][1]);
  for (int k = 0; k < 4; k++) add_edge(&plan, k, (k + 1) % 4, 1);
  assert_int_equal(cw_cdt_make(&plan.input, tall, &cdt, &(CwOutcome){0}), CW_OK);
  assert_int_equal(cdt.triangle[0][2], 2); // 0 1 2: joined across
  cw_cdt_free(&cdt);
  assert_int_equal(cw_cdt_make(&plan.input, flat, &cdt, &(CwOutcome){0}), CW_OK);
  assert_int_equal(cdt.triangle[0][2], 3); // 0 1 3: joined upright
  cw_cdt_free(&cdt);
}

static void expect_refusal(const Plan *plan, const char *text, const char *place) {
  CwCdt cdt;
  CwOutcome outcome = {0};
  char told[CW_OUTCOME_TEXT_SIZE];
  cw_fail_clear();
  CwStatus status = cw_cdt_make(&plan->input, unit, &cdt, &outcome);
  assert_int_equal(status, outcome.kind == CW_OUTCOME_FINER ? CW_OK : CW_ERR_MESH);
  const char *message = status == CW_OK ? cw_outcome_text(&outcome, 1e3, told) : cw_fail_message();
  if (!strstr(message, "patch lid") || !strstr(message, text) || !strstr(message, place))
    fail_msg("unexpected message: %s", message);
  assert_null(cdt.triangle);
}

static void crossing_edges_are_refused_with_their_place(void **state) {
  Plan plan = {0};
  add_point(&plan, 0, 0);
  add_point(&plan, 1, 0);
  add_point(&plan, 0, 1);
  add_point(&plan, 1, 1);
  for (int k = 0; k < 4; k++) add_edge(&plan, k, (k + 1) % 4, 1);
  expect_refusal(&plan, "cross", "(u,v) = (0.5, 0.5) at (500.000, 500.000, 250.000) mm");
}

static void points_on_edges_are_refused(void **state) {
  Plan plan = {0};
  add_square(&plan, 0, 1);
  int32_t p = add_point(&plan, 0.5, 0), q = add_point(&plan, 0.5, 0.5);
  add_edge(&plan, p, q, 0);
  expect_refusal(&plan, "point 4", "lies on edge 0");
}

static void open_boundaries_are_refused(void **state) {
  Plan plan = {0};
  add_square(&plan, 0, 1);
  plan.input.edge_count--;
  expect_refusal(&plan, "open at point 0", "(0, 0, 250) mm");
}

static void doubles_and_bad_numbers_are_refused(void **state) {
  Plan plan = {0};
  add_square(&plan, 0, 1);
  add_edge(&plan, 1, 0, 0);
  expect_refusal(&plan, "given twice", "points 0 and 1");
  plan.edge[4][1] = 9;
  expect_refusal(&plan, "edge 4", "0 to 3");
  plan.input.edge_count--;
  plan.uv[2][0] = 1;
  plan.uv[2][1] = 0;
  expect_refusal(&plan, "coincides", "(u,v) = (1, 0)");
  plan.uv[2][1] = 0.0 / 0.0;
  expect_refusal(&plan, "point 2", "not finite");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_diagonal_cuts_a_square_in_two),
      cmocka_unit_test(nested_loops_alternate),
      cmocka_unit_test(boundary_may_touch_itself_at_a_point),
      cmocka_unit_test(scale_decides_the_diagonal),
      cmocka_unit_test(crossing_edges_are_refused_with_their_place),
      cmocka_unit_test(points_on_edges_are_refused),
      cmocka_unit_test(open_boundaries_are_refused),
      cmocka_unit_test(doubles_and_bad_numbers_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
