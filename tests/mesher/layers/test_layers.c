// SPDX-License-Identifier: AGPL-3.0-or-later
// The envelope on solids whose layer top is known by hand, and what it refuses.
#include <unistd.h>

#include "layers_case.h"
#include "mesher/common/vec.h"
#include "mesher/policy.h"
#include "tests/test_folder.h"
#include "tests/whole_file.h"

static void flat_square(void **state) {
  Case c = {.target = 0.6 * MM};
  surface_plate(&c.wall, 0.01, 0, 1 * MM, 1);
  case_run(&c, "flat square");
  for (int32_t v = 0; v < c.wall.point_count; v++) {
    assert_near(c.out.top[v][0], c.wall.x[v][0], 1e-15);
    assert_near(c.out.top[v][1], c.wall.x[v][1], 1e-15);
    assert_near(c.out.top[v][2], 0.6 * MM, 1e-15);
  }
  assert_near(c.share, 1, 0);
  case_free(&c);
}

// About a pinched column thicknesses rise by the slope: along the lines of squares, and along a diagonal as far as it
// is one of the mesh, by the way along edges.
static void layers_taper_to_a_pinched_column(void **state) {
  Case c = {.target = 0.6 * MM};
  surface_plate(&c.wall, 0.01, 0, 1 * MM, 1);
  assert_int_equal(case_make(&c), CW_OK);
  cw_layers_free(&c.out);
  uint8_t *pinched = calloc((size_t)c.wall.point_count, 1);
  const double middle[3] = {0.005, 0.005, 0};
  int32_t tapered = 0;
  for (int32_t v = 0; v < c.wall.point_count; v++) pinched[v] = cw_distance(c.wall.x[v], middle) < 1e-12;
  c.in.pinched = pinched;
  assert_int_equal(cw_layers_make(&c.in, &c.out, &c.outcome), CW_OK);
  assert_int_equal(c.outcome.kind, CW_OUTCOME_DONE);
  for (int32_t v = 0; v < c.wall.point_count; v++) {
    const double *x = c.wall.x[v], away = cw_distance(x, middle), t = c.out.thickness[v];
    const double by_edges = fabs(x[0] - 0.005) + fabs(x[1] - 0.005);
    assert_true(t >= fmin(0.6 * MM, cw_policy.slope * away) - 1e-15);
    assert_true(t <= fmin(0.6 * MM, cw_policy.slope * by_edges) + 1e-15);
    assert_near(c.out.top[v][2], t, 1e-15);
    if (t < 0.6 * MM - 1e-12) assert_int_equal(c.out.reason[v], CW_LAYER_TAPER);
    tapered += t < 0.6 * MM - 1e-12;
  }
  assert_int_equal(tapered, 9); // those a square away
  free(pinched);
  case_free(&c);
}

// All corners concave: the layer top is the box smaller by t on each side, exactly, at any mesh size.
static void inside_of_box(void **state) {
  const double h[3] = {1.25 * MM, 0.5 * MM, 0.2 * MM};
  for (int i = 0; i < 3; i++) {
    Case c = {.target = 0.6 * MM};
    const double low[3] = {0, 0, 0}, high[3] = {0.01, 0.01, 0.01};
    surface_box(&c.wall, low, high, h[i], 63, 0);
    case_run(&c, "inside of a box");
    assert_near(c.share, 1, 0);
    assert_int_equal(c.out.repair_rounds, 0);
    for (int32_t v = 0; v < c.wall.point_count; v++) {
      for (int k = 0; k < 3; k++) {
        double x = c.wall.x[v][k], y = c.out.top[v][k];
        assert_true(y > 0.6 * MM - 1e-12 && y < 9.4 * MM + 1e-12);
        if (x < 1e-9 || x > 0.01 - 1e-9) assert_near(y, x < 1e-9 ? 0.6 * MM : 9.4 * MM, 1e-12);
      }
    }
    case_free(&c);
  }
}

// Convex corners of the inner box: its layer top is the box larger by t, corners included.
static void box_in_box(void **state) {
  Case c = {.target = 0.6 * MM};
  const double low[3] = {0, 0, 0}, high[3] = {0.01, 0.01, 0.01};
  const double outer_low[3] = {-0.01, -0.01, -0.01}, outer_high[3] = {0.02, 0.02, 0.02};
  surface_box(&c.wall, low, high, 0.5 * MM, 63, 1);
  surface_box(&c.wall, outer_low, outer_high, 1 * MM, 63, 0);
  case_run(&c, "box in a box");
  assert_near(c.share, 1, 0);
  int inner = 0;
  for (int32_t v = 0; v < c.wall.point_count; v++) {
    const double *x = c.wall.x[v];
    if (fabs(x[0] - 0.005) > 0.0051 || fabs(x[1] - 0.005) > 0.0051 || fabs(x[2] - 0.005) > 0.0051) continue;
    inner++;
    for (int k = 0; k < 3; k++) {
      double expect = x[k] < 1e-9 ? -0.6 * MM : x[k] > 0.01 - 1e-9 ? 10.6 * MM : x[k];
      assert_near(c.out.top[v][k], expect, 1e-12);
    }
  }
  assert_int_equal(inner, 6 * 20 * 20 + 2);
  case_free(&c);
}

// L-shaped channel between two open patches: one convex and five concave edges of 90 degrees, full thickness
// everywhere.
static void l_channel(void **state) {
  const double p[6][2] = {{0, 0}, {0.02, 0}, {0.02, 0.008}, {0.008, 0.008}, {0.008, 0.02}, {0, 0.02}};
  const double h[3] = {1 * MM, 0.5 * MM, 0.25 * MM}, depth = 0.01;
  for (int i = 0; i < 3; i++) {
    Case c = {.target = 0.6 * MM, .constraint = case_end_planes, .constraint_context = &depth};
    surface_extrude(&c.wall, 6, p, 1, depth, h[i], 1);
    surface_ends(&c.open_patch, 0, 0, 0.02, 0.02, depth);
    case_run(&c, "L-shaped channel");
    assert_near(c.share, 1, 0);
    int convex = 0, concave = 0;
    for (int32_t v = 0; v < c.wall.point_count; v++) {
      const double *x = c.wall.x[v], *y = c.out.top[v];
      assert_near(x[1], y[1], 1e-12);
      if (hypot(x[0] - 0.008, x[2] - 0.008) < 1e-9) {
        convex++;
        assert_near(y[0], 7.4 * MM, 1e-12);
        assert_near(y[2], 7.4 * MM, 1e-12);
      } else if (hypot(x[0], x[2]) < 1e-9) {
        concave++;
        assert_near(y[0], 0.6 * MM, 1e-12);
        assert_near(y[2], 0.6 * MM, 1e-12);
      }
    }
    assert_int_equal(convex, lround(depth / h[i]) + 1);
    assert_int_equal(concave, lround(depth / h[i]) + 1);
    case_free(&c);
  }
}

// Triangular channel: three concave edges of 60 degrees. On the edge the column is 2 t long.
static void sharp_creases(void **state) {
  const double p[3][2] = {{0, 0}, {0.02, 0}, {0.01, 0.01 * 1.7320508075688772}}, depth = 0.006;
  const double h[4] = {1 * MM, 0.5 * MM, 0.3 * MM, 0.2 * MM};
  for (int i = 0; i < 4; i++) {
    Case c = {.target = 0.6 * MM, .constraint = case_end_planes, .constraint_context = &depth};
    surface_extrude(&c.wall, 3, p, 1, depth, h[i], 1);
    surface_ends(&c.open_patch, 0, 0, 0.02, 0.02, depth);
    case_run(&c, "60 degree creases");
    assert_true(c.share > 0.995);
    int on_edge = 0;
    for (int32_t v = 0; v < c.wall.point_count; v++) {
      if (hypot(c.wall.x[v][0], c.wall.x[v][2]) > 1e-9) continue;
      assert_near(hypot(c.out.top[v][0], c.out.top[v][2]), 2 * c.out.thickness[v], 1e-12);
      on_edge++;
    }
    assert_int_equal(on_edge, lround(depth / h[i]) + 1);
    case_free(&c);
  }
}

// Pipe of 120 facets between two open patch planes: the layer top is the polygon whose sides lie t further in.
static void pipe_between_open_patches(void **state) {
  const double length = 40 * MM;
  Case c = {.target = 0.6 * MM, .constraint = case_end_planes, .constraint_context = &length};
  surface_pipe(&c.wall, 20 * MM, length, 120, 40);
  surface_ends(&c.open_patch, -0.03, -0.03, 0.03, 0.03, length);
  case_run(&c, "pipe between open patches");
  assert_near(c.share, 1, 0);
  for (int32_t v = 0; v < c.wall.point_count; v++) {
    assert_near(hypot(c.out.top[v][0], c.out.top[v][2]), 0.02 - 0.6 * MM / cos(M_PI / 120), 1e-10);
    assert_near(c.out.top[v][1], c.wall.x[v][1], 1e-10);
  }
  case_free(&c);
}

// Shorter edges are asked for at a place, with the reason; or no layers, where these may do.
static void asks_for_shorter_edges(Case *c, CwOutcomeKind kind, const char *reason, const double place[3],
                                   double near) {
  assert_int_equal(case_make(c), CW_OK);
  assert_int_equal(c->outcome.kind, kind);
  assert_non_null(strstr(c->outcome.reason, reason));
  assert_true(c->outcome.places >= 1);
  assert_true(cw_distance(c->outcome.place[0], place) <= near);
  case_free(c);
}

static void failures(void **state) {
  Case c = {.target = 0.6 * MM};
  const double low[3] = {0, 0, 0}, high[3] = {0.01, 0.01, 0.01}, low2[3] = {0.0052, 0.0052, 0.0052};
  const double high2[3] = {0.0152, 0.0152, 0.0152};
  surface_box(&c.wall, low, high, 1 * MM, 63, 0);
  surface_box(&c.wall, low2, high2, 1 * MM, 63, 0);
  // Faces cross along edges of the cube of 4.8 mm in which the boxes overlap; triangles have sides of 1 mm.
  const double middle[3] = {0.0076, 0.0076, 0.0076};
  asks_for_shorter_edges(&c, CW_OUTCOME_FINER, "the wall crosses or touches itself", middle,
                         2.4 * sqrt(3) * MM + sqrt(2) * MM);

  // Two faces folded onto each other.
  Case fold = {.target = 0.6 * MM};
  const double a[3] = {0, 0, 0}, b[3] = {0.01, 0, 0}, d[3] = {0, 0.01, 0};
  surface_point(&fold.wall, a);
  surface_point(&fold.wall, b);
  surface_point(&fold.wall, d);
  surface_triangle(&fold.wall, 0, 1, 2);
  surface_triangle(&fold.wall, 2, 1, 0);
  asks_for_shorter_edges(&fold, CW_OUTCOME_PINCH, "see no common direction", a, 0);

  // An open patch that pierces the floor: no layer top is clear of it.
  Case pierced = {.target = 0.6 * MM};
  const double corner[3][3] = {{0.005, 0.005, -0.002}, {0.005, 0.005, 0.002}, {0.007, 0.006, 0}};
  surface_box(&pierced.wall, low, high, 1 * MM, 63, 0);
  for (int i = 0; i < 3; i++) surface_point(&pierced.open_patch, corner[i]);
  surface_triangle(&pierced.open_patch, 0, 1, 2);
  asks_for_shorter_edges(&pierced, CW_OUTCOME_PINCH, "the layer top crosses an open patch", corner[2], 3.7 * MM);

  Case zero = {.target = 0};
  surface_box(&zero.wall, low, high, 1 * MM, 63, 0);
  assert_int_equal(case_make(&zero), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "thickness 0 mm asked at ("));
  print_message("  %s\n", cw_fail_message());
  case_free(&zero);
}

static void same_each_time(void **state) {
  double *top[2];
  int32_t n = 0;
  for (int i = 0; i < 2; i++) {
    const double p[3][2] = {{0, 0}, {0.02, 0}, {0.01, 0.01 * 1.7320508075688772}};
    Case c = {.target = 1 * MM};
    surface_extrude(&c.wall, 3, p, 1, 0.006, 0.4 * MM, 1);
    assert_int_equal(case_make(&c), CW_OK);
    n = c.wall.point_count;
    top[i] = malloc(n * 3 * sizeof(double));
    memcpy(top[i], c.out.top, n * 3 * sizeof(double));
    case_free(&c);
  }
  assert_memory_equal(top[0], top[1], n * 3 * sizeof(double));
  free(top[0]);
  free(top[1]);
}

// Columns over a square of two triangles.
typedef struct {
  CwLayers layers;
  double x[4][3], top[4][3], thickness[4];
  int32_t triangle[2][3], region[2];
  uint8_t reason[4];
} Square;

static void square(Square *made) {
  static const Square plain = {.x = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                               .top = {{0, 0, -0.1}, {1, 0, -0.1}, {1, 1, -0.2}, {0, 1, -0.1}},
                               .thickness = {0.1, 0.1, 0.2, 0.1},
                               .triangle = {{0, 1, 2}, {0, 2, 3}},
                               .region = {3, 4},
                               .reason = {CW_LAYER_FULL, CW_LAYER_GAP, CW_LAYER_FULL, CW_LAYER_REPAIR}};
  *made = plain;
  made->layers = (CwLayers){.column_count = 4,
                            .triangle_count = 2,
                            .triangle = made->triangle,
                            .top = made->top,
                            .thickness = made->thickness,
                            .reason = made->reason};
}

static void told(Square *of, const char *message) {
  assert_int_equal(cw_layers_audit(&of->layers, (const double(*)[3])of->x), CW_ERR_FAULT);
  if (!strstr(cw_fail_message(), message)) fail_msg("%s", cw_fail_message());
  square(of);
}

static void spoiled_layers_are_told(void **state) {
  Square of;
  square(&of);
  assert_int_equal(cw_layers_audit(&of.layers, (const double(*)[3])of.x), CW_OK);
  of.thickness[2] = 0;
  told(&of, "the column at (1000.000, 1000.000, 0.000) mm is 0 mm thick and 200 mm long");
  of.thickness[2] = of.top[2][2] = 0; // a pinched one
  assert_int_equal(cw_layers_audit(&of.layers, (const double(*)[3])of.x), CW_OK);
  of.thickness[2] = -1;
  told(&of, "is -1000 mm thick and 0 mm long");
  of.triangle[1][2] = 4;
  told(&of, "triangle 1 has the corners 0, 2, 4 of 4 columns");
  of.triangle[0][1] = 0;
  told(&of, "triangle 0 has the corners 0, 0, 2");
  of.top[3][2] = 0.1; // out of the domain
  told(&of, "the prism over triangle 1");
}

static void vtk_has_the_layer_top(void **state) {
  Square of;
  square(&of);
  const char *path = in_test_folder("it.vtk");
  assert_int_equal(cw_layers_vtk(&of.layers, of.region, path), CW_OK);
  char *text = read_whole(path, NULL);
  remove(path);
  assert_non_null(strstr(text, "POINTS 4 double\n0 0 -0.1"));
  assert_non_null(strstr(text, "POLYGONS 2 8\n3 0 1 2\n3 0 2 3\n"));
  assert_non_null(strstr(text, "SCALARS reason int 1\nLOOKUP_TABLE default\n3\n5\n")); // of its thinnest column
  assert_non_null(strstr(text, "SCALARS region int 1\nLOOKUP_TABLE default\n3\n4\n"));
  free(text);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(flat_square),
      cmocka_unit_test(layers_taper_to_a_pinched_column),
      cmocka_unit_test(inside_of_box),
      cmocka_unit_test(box_in_box),
      cmocka_unit_test(l_channel),
      cmocka_unit_test(sharp_creases),
      cmocka_unit_test(pipe_between_open_patches),
      cmocka_unit_test(failures),
      cmocka_unit_test(same_each_time),
      cmocka_unit_test(spoiled_layers_are_told),
      cmocka_unit_test(vtk_has_the_layer_top),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
