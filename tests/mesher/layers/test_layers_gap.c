// SPDX-License-Identifier: AGPL-3.0-or-later
// Thicknesses: what gaps, concave places and gradation leave of them.
#include "layers_case.h"
#include "mesher/common/vec.h"
#include "mesher/layers/layers.h"
#include "mesher/layers/layers_gap.h"
#include "mesher/layers/layers_topology.h"

// Two plates 1 mm apart: 0.35 of the gap, where edges are so short that tetrahedra fit what is left.
static void thin_gap(void **state) {
  Case c = {.target = 0.6 * MM};
  surface_plate(&c.wall, 0.01, 0, 0.25 * MM, 1);
  surface_plate(&c.wall, 0.01, 1 * MM, 0.25 * MM, 0);
  case_run(&c, "plates 1 mm apart");
  for (int32_t v = 0; v < c.wall.point_count; v++) {
    assert_near(c.out.thickness[v], 0.35 * MM, 1e-12);
    assert_int_equal(c.out.reason[v], CW_LAYER_GAP);
  }
  case_free(&c);
}

// Plates 1 mm apart with edges of about 1 mm: 0.65 of these is left between the layers.
static void coarse_gap(void **state) {
  Case c = {.target = 0.6 * MM};
  surface_plate(&c.wall, 0.01, 0, 1 * MM, 1);
  surface_plate(&c.wall, 0.01, 1 * MM, 1 * MM, 0);
  case_run(&c, "plates 1 mm apart, edges of 1 mm");
  for (int32_t v = 0; v < c.wall.point_count; v++) {
    assert_true(1 * MM - 2 * c.out.thickness[v] > 0.64 * MM);
    assert_int_equal(c.out.reason[v], CW_LAYER_GAP);
  }
  case_free(&c);
}

// A wall 10 before the column, in five even layers. Tetrahedra across what is left have 4 times the volume of the last
// prism at most: 10 - 2 t = 12 t / 5 at t = 10 / 4.4.
static void room_by_hand(void **state) {
  double least = 0;
  CwLayerInput in = {.division.count = 5, .least = &least};
  CwLayerWork work = {.in = &in, .n = 1};
  assert_near(cw_layers_room(&work, 0, 2, 10, 0), 3.5, 1e-12);
  assert_near(cw_layers_room(&work, 0, 2, 10, 3), 3.5, 1e-12);
  assert_near(cw_layers_room(&work, 0, 2, 10, 5), 2.5, 1e-12);
  assert_near(cw_layers_room(&work, 0, 2, 10, 8), 10 / 4.4, 1e-5);
  assert_near(cw_layers_room(&work, 0, 2, 10, 20), 10 / 4.4, 1e-5);
  least = 2.4;
  assert_near(cw_layers_room(&work, 0, 2, 10, 8), 2.4, 1e-12);
  least = 4; // more than its share
  assert_near(cw_layers_room(&work, 0, 2, 10, 8), 3.5, 1e-12);
  least = 0;
  in.division.count = 100; // thin ones: nothing is enough
  assert_near(cw_layers_room(&work, 0, 2, 10, 8), 3.5, 1e-12);
}

// The same with an open patch 10 before the column: 10 - t = 12 t / 5 at t = 10 / 3.4.
static void room_before_an_open_patch(void **state) {
  double least = 0;
  CwLayerInput in = {.division.count = 5, .least = &least};
  CwLayerWork work = {.in = &in, .n = 1};
  assert_near(cw_layers_room(&work, 0, 1, 10, 0), 6, 1e-12);
  assert_near(cw_layers_room(&work, 0, 1, 10, 4), 6, 1e-12);
  assert_near(cw_layers_room(&work, 0, 1, 10, 5), 5, 1e-12);
  assert_near(cw_layers_room(&work, 0, 1, 10, 8), 10 / 3.4, 1e-5);
  least = 4;
  assert_near(cw_layers_room(&work, 0, 1, 10, 8), 4, 1e-12);
  least = 7; // more than its share
  assert_near(cw_layers_room(&work, 0, 1, 10, 8), 6, 1e-12);
}

typedef struct {
  const CwLayerInput *in;
  double (*top)[3];
} Top;

static CwBox box_of_top(const void *context, int32_t f) {
  const Top *of = context;
  const int32_t *p = of->in->triangle[f];
  return cw_box_of_triangle(of->top[p[0]], of->top[p[1]], of->top[p[2]]);
}

// Plates 1 mm apart with columns that no ray from the walls has limited, five even layers. Where the tops come nearer
// to one another than the 0.65 edges of a tetrahedron all get what a gap of 1 mm leaves.
static void tops_that_come_near(void **state) {
  for (double t = 0.1 * MM; t < 0.48 * MM; t += 0.05 * MM) {
    Case c = {.target = 0.5 * MM};
    surface_plate(&c.wall, 0.006, 0, 1 * MM, 1);
    surface_plate(&c.wall, 0.006, 1 * MM, 1 * MM, 0);
    assert_int_equal(case_make(&c), CW_OK);
    CwLayerWork work = {0};
    CwBoxTree tree = {0};
    int32_t n = c.wall.point_count;
    c.in.division.count = 5;
    double(*top)[3] = malloc((size_t)n * sizeof *top);
    uint8_t *lowered = malloc((size_t)n);
    assert_int_equal(cw_layers_topology(&c.in, &work), CW_OK);
    for (int32_t v = 0; v < n; v++) {
      work.column[v][0] = work.column[v][1] = 0;
      work.column[v][2] = c.wall.x[v][2] < 0.5 * MM ? 1 : -1;
      work.t[v] = t;
      for (int k = 0; k < 3; k++) top[v][k] = c.wall.x[v][k] + t * work.column[v][k];
    }
    const Top context = {&c.in, top};
    const CwBox within = cw_box_of_points(n, (const double(*)[3])top);
    assert_int_equal(cw_box_tree_make(NULL, c.in.triangle_count, &within, box_of_top, &context, &tree), CW_OK);
    int any, thick = t > 1 * MM / 4.4; // so thick ones leave 0.55 mm
    assert_int_equal(cw_layers_limit_by_top(&work, &tree, (const double(*)[3])top, lowered, &any), CW_OK);
    assert_int_equal(any, thick);
    for (int32_t v = 0; v < n; v++) {
      assert_int_equal(lowered[v], thick);
      assert_near(work.t[v], thick ? 1 * MM / 4.4 : t, 1e-5 * MM);
      if (thick) assert_int_equal(work.reason[v], CW_LAYER_GAP);
    }
    cw_box_tree_free(&tree);
    cw_layers_work_free(&work);
    free(top);
    free(lowered);
    case_free(&c);
  }
}

// Four columns in a row, each limited by that before it: the slope begins at the first, or at the last of those that
// something else limits.
static void the_foot_of_a_slope(void **state) {
  double x[4][3] = {{0}, {1}, {2}, {3}}, column[4][3] = {{0}}, t[4] = {1, 1.3, 1.6, 1.9};
  int32_t near_start[5] = {0, 1, 3, 5, 6}, near[6] = {1, 0, 2, 1, 3, 2};
  uint8_t reason[4] = {CW_LAYER_REPAIR, CW_LAYER_GRADATION, CW_LAYER_GRADATION, CW_LAYER_GRADATION};
  CwLayerInput in = {.x = (const double(*)[3])x};
  CwLayerWork work = {
      .in = &in, .n = 4, .near_start = near_start, .near = near, .column = column, .t = t, .reason = reason};
  assert_int_equal(cw_layers_slope_foot(&work, 3), 0);
  assert_int_equal(cw_layers_slope_foot(&work, 0), 0);
  reason[1] = CW_LAYER_FULL;
  assert_int_equal(cw_layers_slope_foot(&work, 3), 1);
  t[2] = 2.5; // higher than both
  assert_int_equal(cw_layers_slope_foot(&work, 2), 1);
  assert_int_equal(cw_layers_slope_foot(&work, 3), 3);
}

// A plate 0.5 mm before an open patch: 0.6 of the gap, where edges are so short that tetrahedra fit what is left; with
// edges of about 0.5 mm 0.65 of these is left.
static void gap_to_open_patch(void **state) {
  for (int coarse = 0; coarse < 2; coarse++) {
    Case c = {.target = 0.6 * MM};
    surface_plate(&c.wall, 0.01, 0, (coarse ? 0.5 : 0.25) * MM, 1);
    const double z = 0.5 * MM,
                 open_patch[4][3] = {{-0.01, -0.01, z}, {0.02, -0.01, z}, {0.02, 0.02, z}, {-0.01, 0.02, z}};
    surface_quad(&c.open_patch, open_patch, 1, 1);
    case_run(&c, "plate before an open patch");
    for (int32_t v = 0; v < c.wall.point_count; v++) {
      if (coarse)
        assert_true(0.5 * MM - c.out.thickness[v] > 0.64 * 0.5 * MM);
      else
        assert_near(c.out.thickness[v], 0.3 * MM, 1e-12);
    }
    case_free(&c);
  }
}

// A plate opposite half of another: no step in thickness steeper than 0.3.
static void gradation(void **state) {
  Case c = {.target = 0.6 * MM};
  surface_plate(&c.wall, 0.01, 0, 0.25 * MM, 1);
  surface_plate(&c.wall, 0.005, 0.8 * MM, 0.25 * MM, 0);
  case_run(&c, "plate over half a plate");
  int graded = 0;
  for (int32_t f = 0; f < c.wall.triangle_count; f++)
    for (int i = 0; i < 3; i++) {
      int32_t a = c.wall.triangle[f][i], b = c.wall.triangle[f][(i + 1) % 3];
      double step = fabs(c.out.thickness[a] - c.out.thickness[b]);
      assert_true(step <= 0.3 * cw_distance(c.wall.x[a], c.wall.x[b]) + 1e-12);
      graded += c.out.reason[a] == CW_LAYER_GRADATION;
    }
  assert_true(graded > 0);
  case_free(&c);
}

// A pipe narrower than its layers: at most 0.6 of the way to where the columns meet, its axis, and less as far as the
// triangles of the layer top would be narrow.
static void concave_place(void **state) {
  const double length = 4 * MM;
  Case c = {.target = 0.8 * MM, .constraint = case_end_planes, .constraint_context = &length};
  surface_pipe(&c.wall, 1 * MM, length, 24, 16);
  surface_ends(&c.open_patch, -0.03, -0.03, 0.03, 0.03, length);
  case_run(&c, "narrow pipe");
  for (int32_t v = 0; v < c.wall.point_count; v++) {
    double left = hypot(c.out.top[v][0], c.out.top[v][2]);
    assert_true(left > 0.4 * MM - 1e-10 && left < 0.6 * MM);
    assert_int_not_equal(c.out.reason[v], CW_LAYER_FULL);
  }
  case_free(&c);
}

enum { ROUND = 24 };

// Two rings between 5 and 10 mm from the y axis, 1 mm apart; the rim's points of one lie between those of the other.
static void ring_point(const void *context, double u, double v, double x[3]) {
  const double *p = context, angle = 2 * M_PI * (u + p[1]); // height, turn
  x[0] = (5 + 5 * v) * MM * cos(angle);
  x[1] = p[0];
  x[2] = (5 + 5 * v) * MM * sin(angle);
}

static int radial_at_rim(const void *context, const double x[3], double normal[2][3]) {
  double r = hypot(x[0], x[2]);
  normal[0][0] = x[0] / r;
  normal[0][2] = x[2] / r;
  return r > 9.99 * MM;
}

// Columns on the rim run along an open cylinder. The chords of the other rim lie within it, and are met all the same.
static void gap_beside_bent_patch(void **state) {
  Case c = {.target = 0.6 * MM, .constraint = radial_at_rim};
  surface_grid(&c.wall, ring_point, (const double[2]){0, 0}, ROUND, 20, 1);
  surface_grid(&c.wall, ring_point, (const double[2]){1 * MM, 0.5 / ROUND}, ROUND, 20, 0);
  assert_int_equal(case_make(&c), CW_OK);
  cw_layers_free(&c.out);
  uint8_t *stays = calloc(c.wall.point_count, 1);
  for (int32_t v = 0; v < c.wall.point_count; v++) stays[v] = c.in.constraint_count[v] > 0;
  c.in.constraint_stays = stays;
  assert_int_equal(cw_layers_make(&c.in, &c.out, &c.outcome), CW_OK);
  for (int32_t v = 0; v < c.wall.point_count; v++) {
    if (!stays[v]) continue;
    assert_true(c.out.thickness[v] < 0.35 * MM + 1e-9);
    assert_int_equal(c.out.reason[v], CW_LAYER_GAP);
  }
  free(stays);
  case_free(&c);
}

// The thickness of the layer top on the wall between v and w: at the thickness of the lower one, columns stand so far
// apart.
static double apart(const Case *c, int32_t v, int32_t w) {
  double low = fmin(c->out.thickness[v], c->out.thickness[w]), p[3], q[3],
         wall = cw_distance(c->wall.x[v], c->wall.x[w]);
  case_at(c, v, low / c->out.thickness[v], p);
  case_at(c, w, low / c->out.thickness[w], q);
  return fmin(wall, fmax(cw_distance(p, q), 0.25 * wall));
}

// A crease of 75 degrees whose columns are asked to be lower than those beside it, which stand closer on the layer top
// than on the wall: thicknesses rise from it by no more than the layer top allows, and the layer top keeps most of the
// angle.
static void low_crease(void **state) {
  const double half = 37.5 * M_PI / 180, p[3][2] = {{0, 0}, {0.02, -0.02 * tan(half)}, {0.02, 0.02 * tan(half)}};
  const double depth = 0.006;
  Case c = {.target = 1.6 * MM, .constraint = case_end_planes, .constraint_context = &depth};
  surface_extrude(&c.wall, 3, p, 1, depth, 0.5 * MM, 1);
  surface_ends(&c.open_patch, 0, -0.02, 0.02, 0.02, depth);
  assert_int_equal(case_make(&c), CW_OK);
  for (int32_t v = 0; v < c.wall.point_count; v++) {
    if (hypot(c.wall.x[v][0], c.wall.x[v][2]) < 1e-9) ((double *)c.in.target)[v] = 1.2 * MM;
  }
  cw_layers_free(&c.out);
  assert_int_equal(cw_layers_make(&c.in, &c.out, &c.outcome), CW_OK);
  case_check_prisms(&c);
  case_check_top(&c);
  double least = 90;
  for (int32_t f = 0; f < c.wall.triangle_count; f++) {
    int32_t on = -1, high = -1;
    for (int i = 0; i < 3; i++) {
      int32_t v = c.wall.triangle[f][i], w = c.wall.triangle[f][(i + 1) % 3];
      assert_true(fabs(c.out.thickness[v] - c.out.thickness[w]) <= 0.3 * apart(&c, v, w) + 1e-9);
      (hypot(c.wall.x[v][0], c.wall.x[v][2]) < 1e-9 ? &on : &high)[0] = v;
    }
    if (on < 0) continue;
    double rise[3];
    cw_sub(c.out.top[high], c.out.top[on], rise);
    least = fmin(least, atan2(fabs(rise[2]), rise[0]) * 180 / M_PI);
  }
  print_message("  half the angle of the layer top on a crease of 75 degrees: %.1f\n", least);
  assert_true(least > 20 && least < 37.5);
  case_free(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(thin_gap),
      cmocka_unit_test(coarse_gap),
      cmocka_unit_test(room_by_hand),
      cmocka_unit_test(room_before_an_open_patch),
      cmocka_unit_test(tops_that_come_near),
      cmocka_unit_test(the_foot_of_a_slope),
      cmocka_unit_test(gap_to_open_patch),
      cmocka_unit_test(gradation),
      cmocka_unit_test(concave_place),
      cmocka_unit_test(low_crease),
      cmocka_unit_test(gap_beside_bent_patch),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
