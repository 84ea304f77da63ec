// SPDX-License-Identifier: AGPL-3.0-or-later
// Heights: what gaps, hollows and gradation leave of them.
#include "layers_case.h"

#include "mesher/layers/layers_inner.h"

// Two plates 1 mm apart: 0.35 of the gap.
static void thin_gap(void **state) {
  Case c = {.target = 0.6 * MM};
  surface_plate(&c.wall, 0.01, 0, 0.5 * MM, 1);
  surface_plate(&c.wall, 0.01, 1 * MM, 0.5 * MM, 0);
  case_run(&c, "plates 1 mm apart");
  for (int32_t v = 0; v < c.wall.point_count; v++) {
    assert_float_equal(c.out.height[v], 0.35 * MM, 1e-12);
    assert_int_equal(c.out.reason[v], CW_LAYER_GAP);
  }
  case_free(&c);
}

// A plate 0.5 mm before a cap: 0.6 of the gap.
static void gap_to_cap(void **state) {
  Case c = {.target = 0.6 * MM};
  surface_plate(&c.wall, 0.01, 0, 0.5 * MM, 1);
  const double z = 0.5 * MM, cap[4][3] = {{-0.01, -0.01, z}, {0.02, -0.01, z}, {0.02, 0.02, z}, {-0.01, 0.02, z}};
  surface_quad(&c.cap, cap, 1, 1);
  case_run(&c, "plate before a cap");
  for (int32_t v = 0; v < c.wall.point_count; v++) assert_float_equal(c.out.height[v], 0.3 * MM, 1e-12);
  case_free(&c);
}

// A plate opposite half of another: no step in height steeper than 0.3.
static void gradation(void **state) {
  Case c = {.target = 0.6 * MM};
  surface_plate(&c.wall, 0.01, 0, 0.25 * MM, 1);
  surface_plate(&c.wall, 0.005, 0.8 * MM, 0.25 * MM, 0);
  case_run(&c, "plate over half a plate");
  int graded = 0;
  for (int32_t f = 0; f < c.wall.triangle_count; f++)
    for (int i = 0; i < 3; i++) {
      int32_t a = c.wall.triangle[f][i], b = c.wall.triangle[f][(i + 1) % 3];
      double step = fabs(c.out.height[a] - c.out.height[b]);
      assert_true(step <= 0.3 * cw_distance(c.wall.x[a], c.wall.x[b]) + 1e-12);
      graded += c.out.reason[a] == CW_LAYER_GRADATION;
    }
  assert_true(graded > 0);
  case_free(&c);
}

// A pipe narrower than its layers: 0.6 of the way to where the columns meet, its axis.
static void hollow(void **state) {
  const double length = 4 * MM;
  Case c = {.target = 0.8 * MM, .guide = case_end_planes, .guide_context = &length};
  surface_pipe(&c.wall, 1 * MM, length, 24, 16);
  surface_ends(&c.cap, -0.03, -0.03, 0.03, 0.03, length);
  case_run(&c, "narrow pipe");
  for (int32_t v = 0; v < c.wall.point_count; v++) {
    assert_float_equal(hypot(c.out.front[v][0], c.out.front[v][2]), 0.4 * MM, 1e-10);
    assert_int_equal(c.out.reason[v], CW_LAYER_GAP);
  }
  case_free(&c);
}

// The height of the front on the wall between v and w: at the height of the lower one, columns stand so far apart.
static double apart(const Case *c, int32_t v, int32_t w) {
  double low = fmin(c->out.height[v], c->out.height[w]), p[3], q[3], wall = cw_distance(c->wall.x[v], c->wall.x[w]);
  case_at(c, v, low / c->out.height[v], p);
  case_at(c, w, low / c->out.height[w], q);
  return fmin(wall, fmax(cw_distance(p, q), 0.25 * wall));
}

// A crease of 75 degrees whose columns are asked to be lower than those beside it, which stand closer on the front than
// on the wall: heights rise from it by no more than the front allows, and the front keeps most of the angle.
static void low_crease(void **state) {
  const double half = 37.5 * M_PI / 180, p[3][2] = {{0, 0}, {0.02, -0.02 * tan(half)}, {0.02, 0.02 * tan(half)}};
  const double depth = 0.006;
  Case c = {.target = 1.6 * MM, .guide = case_end_planes, .guide_context = &depth};
  surface_extrude(&c.wall, 3, p, 1, depth, 0.5 * MM, 1);
  surface_ends(&c.cap, 0, -0.02, 0.02, 0.02, depth);
  assert_int_equal(case_make(&c), CW_OK);
  for (int32_t v = 0; v < c.wall.point_count; v++) {
    if (hypot(c.wall.x[v][0], c.wall.x[v][2]) < 1e-9) ((double *)c.in.target)[v] = 1.2 * MM;
  }
  cw_layers_free(&c.out);
  assert_int_equal(cw_layers_make(&c.in, &c.out, &c.outcome), CW_OK);
  case_check_prisms(&c);
  case_check_front(&c);
  double least = 90;
  for (int32_t f = 0; f < c.wall.triangle_count; f++) {
    int32_t on = -1, high = -1;
    for (int i = 0; i < 3; i++) {
      int32_t v = c.wall.triangle[f][i], w = c.wall.triangle[f][(i + 1) % 3];
      assert_true(fabs(c.out.height[v] - c.out.height[w]) <= 0.3 * apart(&c, v, w) + 1e-9);
      (hypot(c.wall.x[v][0], c.wall.x[v][2]) < 1e-9 ? &on : &high)[0] = v;
    }
    if (on < 0) continue;
    double rise[3];
    cw_sub(c.out.front[high], c.out.front[on], rise);
    least = fmin(least, atan2(fabs(rise[2]), rise[0]) * 180 / M_PI);
  }
  print_message("  half the angle of the front on a crease of 75 degrees: %.1f\n", least);
  assert_true(least > 20 && least < 37.5);
  case_free(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(thin_gap), cmocka_unit_test(gap_to_cap), cmocka_unit_test(gradation),
      cmocka_unit_test(hollow),   cmocka_unit_test(low_crease),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
