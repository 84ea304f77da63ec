// SPDX-License-Identifier: AGPL-3.0-or-later
#include "layers_case.h"

#include "mesher/layers/layers_inner.h"

static void add_quad(Surface *s, double ax, double ay, double az, double bx, double by, double bz, double cx, double cy,
                     double cz, double dx, double dy, double dz, int nu, int nv) {
  const double p[4][3] = {{ax, ay, az}, {bx, by, bz}, {cx, cy, cz}, {dx, dy, dz}};
  surface_quad(s, p, nu, nv);
}

// The best direction of one, two and three faces, free and held, by hand.
static void most_normal_by_hand(void **state) {
  const double n[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, none[2][3] = {{0}};
  double g[3], s = sqrt(0.5);
  assert_float_equal(cw_layers_most_normal(1, n, 0, none, g), 1, 1e-15);
  assert_float_equal(cw_layers_most_normal(2, n, 0, none, g), s, 1e-15);
  assert_float_equal(g[0], s, 1e-15);
  assert_float_equal(cw_layers_most_normal(3, n, 0, none, g), 1 / sqrt(3), 1e-15);
  for (int k = 0; k < 3; k++) assert_float_equal(g[k], 1 / sqrt(3), 1e-15);
  // A fourth normal between two others changes nothing.
  const double more[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {s, s, 0}};
  assert_float_equal(cw_layers_most_normal(4, more, 0, none, g), 1 / sqrt(3), 1e-15);
  // Held in z = 0: the third face is seen edge on. Held in the plane normal to (1,0,1): g = (a, b, -a).
  const double flat[2][3] = {{0, 0, 1}}, line[2][3] = {{0, 0, 1}, {s, -s, 0}};
  assert_float_equal(cw_layers_most_normal(2, n, 1, flat, g), s, 1e-15);
  assert_float_equal(cw_layers_most_normal(3, n, 1, flat, g), 0, 1e-15);
  assert_float_equal(cw_layers_most_normal(2, n, 2, line, g), s, 1e-15);
  assert_float_equal(g[0], s, 1e-15);
  const double slanted[2][3] = {{s, 0, s}};
  // x.g = a, y.g = b with 2 a^2 + b^2 = 1 equal at a = b = 1/sqrt(3).
  assert_float_equal(cw_layers_most_normal(2, n, 1, slanted, g), 1 / sqrt(3), 1e-15);
  // Opposite faces leave nothing to see.
  const double shut[2][3] = {{1, 0, 0}, {-1, 0, 0}};
  assert_true(cw_layers_most_normal(2, shut, 0, none, g) < 1e-15);
}

static void flat_square(void **state) {
  Case c = {.target = 0.6 * MM};
  add_quad(&c.wall, 0, 0, 0, 0, 0.01, 0, 0.01, 0.01, 0, 0.01, 0, 0, 10, 10); // outward: -z
  case_run(&c, "flat square");
  for (int32_t v = 0; v < c.wall.point_count; v++) {
    assert_float_equal(c.out.front[v][0], c.wall.x[v][0], 1e-15);
    assert_float_equal(c.out.front[v][1], c.wall.x[v][1], 1e-15);
    assert_float_equal(c.out.front[v][2], 0.6 * MM, 1e-15);
  }
  assert_float_equal(c.share, 1, 0);
  case_free(&c);
}

// All corners concave: the front is the box smaller by t on each side, exactly, at any mesh size.
static void inside_of_box(void **state) {
  const double h[3] = {1.25 * MM, 0.5 * MM, 0.2 * MM};
  for (int i = 0; i < 3; i++) {
    Case c = {.target = 0.6 * MM};
    const double low[3] = {0, 0, 0}, high[3] = {0.01, 0.01, 0.01};
    surface_box(&c.wall, low, high, h[i], 63, 0);
    case_run(&c, "inside of a box");
    assert_float_equal(c.share, 1, 0);
    assert_int_equal(c.out.repair_rounds, 0);
    for (int32_t v = 0; v < c.wall.point_count; v++) {
      int walls = 0, fronts = 0;
      for (int k = 0; k < 3; k++) {
        double x = c.wall.x[v][k], y = c.out.front[v][k];
        assert_true(y > 0.6 * MM - 1e-12 && y < 9.4 * MM + 1e-12);
        walls += x < 1e-9 || x > 0.01 - 1e-9;
        fronts += fabs(y - 0.6 * MM) < 1e-12 || fabs(y - 9.4 * MM) < 1e-12;
      }
      assert_true(fronts >= walls);
    }
    case_free(&c);
  }
}

// Convex corners of the inner box: its front is the box larger by t, corners included.
static void box_in_box(void **state) {
  Case c = {.target = 0.6 * MM};
  const double low[3] = {0, 0, 0}, high[3] = {0.01, 0.01, 0.01};
  const double outer_low[3] = {-0.01, -0.01, -0.01}, outer_high[3] = {0.02, 0.02, 0.02};
  surface_box(&c.wall, low, high, 0.5 * MM, 63, 1);
  surface_box(&c.wall, outer_low, outer_high, 1 * MM, 63, 0);
  case_run(&c, "box in a box");
  assert_float_equal(c.share, 1, 0);
  for (int32_t v = 0; v < c.wall.point_count; v++) {
    const double *x = c.wall.x[v];
    for (int k = 0; k < 3; k++) {
      if (fabs(x[0] - 0.005) > 0.0051 || fabs(x[1] - 0.005) > 0.0051 || fabs(x[2] - 0.005) > 0.0051) continue;
      double expect = x[k] < 1e-9 ? -0.6 * MM : x[k] > 0.01 - 1e-9 ? 10.6 * MM : x[k];
      assert_float_equal(c.out.front[v][k], expect, 1e-12);
    }
  }
  case_free(&c);
}

static int end_planes(const void *context, const double x[3], double normal[2][3]) {
  if (x[1] > 1e-9 && x[1] < *(const double *)context - 1e-9) return 0;
  normal[0][1] = 1;
  return 1;
}

// Caps of an extruded channel are given coarsely: a quad of each end, larger than the channel.
static void end_caps(Surface *cap, double x0, double z0, double x1, double z1, double depth) {
  add_quad(cap, x0, 0, z0, x1, 0, z0, x1, 0, z1, x0, 0, z1, 1, 1);                 // outward: -y
  add_quad(cap, x0, depth, z0, x0, depth, z1, x1, depth, z1, x1, depth, z0, 1, 1); // outward: +y
}

// L-shaped channel between two caps: one convex and five concave edges of 90 degrees, full height everywhere.
static void l_channel(void **state) {
  const double p[6][2] = {{0, 0}, {0.02, 0}, {0.02, 0.008}, {0.008, 0.008}, {0.008, 0.02}, {0, 0.02}};
  const double h[3] = {1 * MM, 0.5 * MM, 0.25 * MM}, depth = 0.01;
  for (int i = 0; i < 3; i++) {
    Case c = {.target = 0.6 * MM, .guide = end_planes, .guide_context = &depth};
    surface_extrude(&c.wall, 6, p, 1, depth, h[i], 1);
    end_caps(&c.cap, 0, 0, 0.02, 0.02, depth);
    case_run(&c, "L-shaped channel");
    assert_float_equal(c.share, 1, 0);
    for (int32_t v = 0; v < c.wall.point_count; v++) {
      const double *x = c.wall.x[v], *y = c.out.front[v];
      assert_float_equal(x[1], y[1], 1e-12);
      if (hypot(x[0] - 0.008, x[2] - 0.008) < 1e-9) { // convex edge
        assert_float_equal(y[0], 7.4 * MM, 1e-12);
        assert_float_equal(y[2], 7.4 * MM, 1e-12);
      } else if (hypot(x[0], x[2]) < 1e-9) { // concave edge
        assert_float_equal(y[0], 0.6 * MM, 1e-12);
        assert_float_equal(y[2], 0.6 * MM, 1e-12);
      }
    }
    case_free(&c);
  }
}

// Triangular channel: three concave edges of 60 degrees. On the edge the column is 2 t long.
static void sharp_creases(void **state) {
  const double p[3][2] = {{0, 0}, {0.02, 0}, {0.01, 0.01 * 1.7320508075688772}}, depth = 0.006;
  const double h[4] = {1 * MM, 0.5 * MM, 0.3 * MM, 0.2 * MM};
  for (int i = 0; i < 4; i++) {
    Case c = {.target = 0.6 * MM, .guide = end_planes, .guide_context = &depth};
    surface_extrude(&c.wall, 3, p, 1, depth, h[i], 1);
    end_caps(&c.cap, 0, 0, 0.02, 0.02, depth);
    case_run(&c, "60 degree creases");
    assert_true(c.share > 0.995);
    for (int32_t v = 0; v < c.wall.point_count; v++)
      if (hypot(c.wall.x[v][0], c.wall.x[v][2]) < 1e-9)
        assert_float_equal(hypot(c.out.front[v][0], c.out.front[v][2]), 2 * c.out.height[v], 1e-12);
    case_free(&c);
  }
}

// Two plates 1 mm apart: 0.35 of the gap.
static void thin_gap(void **state) {
  Case c = {.target = 0.6 * MM};
  add_quad(&c.wall, 0, 0, 0, 0, 0.01, 0, 0.01, 0.01, 0, 0.01, 0, 0, 20, 20);
  add_quad(&c.wall, 0, 0, 0.001, 0.01, 0, 0.001, 0.01, 0.01, 0.001, 0, 0.01, 0.001, 20, 20);
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
  add_quad(&c.wall, 0, 0, 0, 0, 0.01, 0, 0.01, 0.01, 0, 0.01, 0, 0, 20, 20);
  add_quad(&c.cap, -0.01, -0.01, 0.0005, 0.02, -0.01, 0.0005, 0.02, 0.02, 0.0005, -0.01, 0.02, 0.0005, 1, 1);
  case_run(&c, "plate before a cap");
  for (int32_t v = 0; v < c.wall.point_count; v++) assert_float_equal(c.out.height[v], 0.3 * MM, 1e-12);
  case_free(&c);
}

// A plate opposite half of another: no step in height steeper than 0.3.
static void gradation(void **state) {
  Case c = {.target = 0.6 * MM};
  add_quad(&c.wall, 0, 0, 0, 0, 0.01, 0, 0.01, 0.01, 0, 0.01, 0, 0, 40, 40);
  add_quad(&c.wall, 0, 0, 0.0008, 0.005, 0, 0.0008, 0.005, 0.01, 0.0008, 0, 0.01, 0.0008, 20, 40);
  case_run(&c, "plate over half a plate");
  int graded = 0;
  for (int32_t f = 0; f < c.wall.triangle_count; f++)
    for (int i = 0; i < 3; i++) {
      int32_t a = c.wall.triangle[f][i], b = c.wall.triangle[f][(i + 1) % 3];
      double step = fabs(c.out.height[a] - c.out.height[b]);
      assert_true(step <= 0.3 * distance3(c.wall.x[a], c.wall.x[b]) + 1e-12);
      graded += c.out.reason[a] == CW_LAYER_GRADATION;
    }
  assert_true(graded > 0);
  case_free(&c);
}

static void cylinder_point(const void *context, double u, double v, double x[3]) {
  const double *p = context; // radius, length
  x[0] = p[0] * cos(2 * M_PI * u);
  x[1] = p[1] * v;
  x[2] = p[0] * sin(2 * M_PI * u);
}

// Pipe of 120 facets between two cap planes: the front is the polygon whose sides lie t further in.
static void pipe_between_caps(void **state) {
  const double size[2] = {0.02, 0.04};
  Case c = {.target = 0.6 * MM, .guide = end_planes, .guide_context = &size[1]};
  surface_grid(&c.wall, cylinder_point, size, 120, 40, 1); // outward
  end_caps(&c.cap, -0.03, -0.03, 0.03, 0.03, size[1]);
  case_run(&c, "pipe between caps");
  assert_float_equal(c.share, 1, 0);
  for (int32_t v = 0; v < c.wall.point_count; v++) {
    assert_float_equal(hypot(c.out.front[v][0], c.out.front[v][2]), 0.02 - 0.6 * MM / cos(M_PI / 120), 1e-10);
    assert_float_equal(c.out.front[v][1], c.wall.x[v][1], 1e-10);
  }
  case_free(&c);
}

// A pipe narrower than its layers: 0.6 of the way to where the columns meet, its axis.
static void hollow(void **state) {
  const double size[2] = {0.001, 0.004};
  Case c = {.target = 0.8 * MM, .guide = end_planes, .guide_context = &size[1]};
  surface_grid(&c.wall, cylinder_point, size, 24, 16, 1); // outward
  end_caps(&c.cap, -0.03, -0.03, 0.03, 0.03, size[1]);
  case_run(&c, "narrow pipe");
  for (int32_t v = 0; v < c.wall.point_count; v++) {
    assert_float_equal(hypot(c.out.front[v][0], c.out.front[v][2]), 0.4 * MM, 1e-10);
    assert_int_equal(c.out.reason[v], CW_LAYER_GAP);
  }
  case_free(&c);
}

// The height of the front on the wall between v and w: at the height of the lower one, columns stand so far apart.
static double apart(const Case *c, int32_t v, int32_t w) {
  double low = fmin(c->out.height[v], c->out.height[w]), p[3], q[3], wall = distance3(c->wall.x[v], c->wall.x[w]);
  case_at(c, v, low / c->out.height[v], p);
  case_at(c, w, low / c->out.height[w], q);
  return fmin(wall, fmax(distance3(p, q), 0.25 * wall));
}

// A crease of 75 degrees whose columns are asked to be lower than those beside it, which stand closer on the front than
// on the wall: heights rise from it by no more than the front allows, and the front keeps most of the angle.
static void low_crease(void **state) {
  const double half = 37.5 * M_PI / 180, p[3][2] = {{0, 0}, {0.02, -0.02 * tan(half)}, {0.02, 0.02 * tan(half)}};
  const double depth = 0.006;
  Case c = {.target = 1.6 * MM, .guide = end_planes, .guide_context = &depth};
  surface_extrude(&c.wall, 3, p, 1, depth, 0.5 * MM, 1);
  end_caps(&c.cap, 0, -0.02, 0.02, 0.02, depth);
  assert_int_equal(case_make(&c), CW_OK);
  for (int32_t v = 0; v < c.wall.point_count; v++) {
    if (hypot(c.wall.x[v][0], c.wall.x[v][2]) < 1e-9) ((double *)c.in.target)[v] = 1.2 * MM;
  }
  cw_layers_free(&c.out);
  assert_int_equal(cw_layers_make(&c.in, &c.out), CW_OK);
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
    sub3(c.out.front[high], c.out.front[on], rise);
    least = fmin(least, atan2(fabs(rise[2]), rise[0]) * 180 / M_PI);
  }
  print_message("  half the angle of the front on a crease of 75 degrees: %.1f\n", least);
  assert_true(least > 20);
  case_free(&c);
}

// A column on a plate leans so far over its neighbour that the prisms are sound and front triangles are not: it is
// turned back. Where it may not turn, the columns are thinned, but not below what they are asked to keep.
static void leaning_column(void **state) {
  const double least_height[3] = {0, 0, 0.55 * MM};
  for (int i = 0; i < 3; i++) {
    Case c = {.target = 0.6 * MM};
    add_quad(&c.wall, 0, 0, 0, 0, 0.01, 0, 0.01, 0.01, 0, 0.01, 0, 0, 10, 10);
    assert_int_equal(case_make(&c), CW_OK);
    int32_t n = c.wall.point_count, centre = 0, rounds = 0;
    double(*front)[3] = malloc((size_t)n * sizeof *front), *least = malloc((size_t)n * sizeof *least);
    for (int32_t v = 0; v < n; v++) {
      least[v] = least_height[i];
      if (hypot(c.wall.x[v][0] - 0.005, c.wall.x[v][1] - 0.005) < 1e-9) centre = v;
    }
    for (int32_t v = 0; v < n && i > 0; v++) { // lines on which the columns stand and lean
      const double way = v == centre ? 0.87 : 0, length = hypot(0.6, way);
      const double across[2][3] = {{0, 1, 0}, {0.6 / length, 0, -way / length}};
      memcpy(((double(*)[2][3])c.in.guide_normal)[v], across, sizeof across);
      ((int32_t *)c.in.guide_count)[v] = 2;
    }
    c.in.least = least; // freed with the case
    CwLayerWork work = {0};
    CwBoxTree tree = {0};
    assert_int_equal(cw_layers_topology(&c.in, &work), CW_OK);
    assert_int_equal(cw_layers_normals(&work), CW_OK);
    assert_int_equal(cw_gap_tree_make(&work, &tree), CW_OK);
    for (int32_t v = 0; v < n; v++) work.t[v] = c.target;
    const double leaning[3] = {0.87 / 0.6, 0, 1};
    memcpy(work.column[centre], leaning, sizeof leaning);
    for (int after = 0; after < 2; after++) {
      double prism = 1, shape = 1, height = INFINITY;
      if (after) assert_int_equal(cw_layers_repair(&work, &tree, front, &rounds), CW_OK);
      for (int32_t v = 0; v < n; v++) {
        if (!after) cw_layers_place(&work, v, front[v]);
        height = fmin(height, front[v][2]);
      }
      for (int32_t f = 0; f < c.wall.triangle_count; f++) {
        const int32_t *v = c.wall.triangle[f];
        const double *const a[3] = {c.wall.x[v[0]], c.wall.x[v[1]], c.wall.x[v[2]]};
        const double *const b[3] = {front[v[0]], front[v[1]], front[v[2]]};
        shape = fmin(shape, cw_prism_front_quality(a, b));
        prism = fmin(prism, cw_layers_prism_quality(&work, f, (const double(*)[3])front));
      }
      print_message("  leaning column: prisms %.3f, front %.3f, heights from %.2f mm\n", prism, shape, height / MM);
      assert_true(prism >= 0.12);
      assert_true(after && i < 2 ? shape >= 0.3 : shape < 0.3);
      if (!after || i == 0) assert_float_equal(height, c.target, 1e-15);
      if (after && i == 1) assert_true(height < 0.55 * MM);
      if (after && i == 2) assert_float_equal(height, 0.55 * MM, 1e-15);
    }
    cw_box_tree_free(&tree);
    cw_layers_work_free(&work);
    free(front);
    case_free(&c);
  }
}

// Columns over a flat triangle that lean across its longest edge by 75 degrees: sound prisms on a sound front, but as
// one layer of small determinant. They are turned up again, at full height, where the number of layers is known.
static void sheared_prism(void **state) {
  for (int layers = 0; layers < 2; layers++) {
    Case c = {.target = 0.5 * MM};
    const double lean[3] = {0, tan(75 * M_PI / 180), 1};
    double front[3][3];
    int32_t rounds = 0;
    const double x[3][3] = {{0, 0, 0}, {5 * MM, 1 * MM, 0}, {10 * MM, 0, 0}};
    surface_triangle(&c.wall, surface_point(&c.wall, x[0]), surface_point(&c.wall, x[1]), surface_point(&c.wall, x[2]));
    assert_int_equal(case_make(&c), CW_OK);
    c.in.division.count = layers;
    CwLayerWork work = {0};
    CwBoxTree tree = {0};
    assert_int_equal(cw_layers_topology(&c.in, &work), CW_OK);
    assert_int_equal(cw_layers_normals(&work), CW_OK);
    assert_int_equal(cw_gap_tree_make(&work, &tree), CW_OK);
    for (int v = 0; v < 3; v++) {
      work.t[v] = c.target;
      memcpy(work.column[v], lean, sizeof lean);
    }
    assert_int_equal(cw_layers_repair(&work, &tree, front, &rounds), CW_OK);
    const int32_t *corner = c.wall.triangle[0];
    const double *wall[3], *end[3], whole[3] = {1, 1, 1};
    for (int k = 0; k < 3; k++) {
      wall[k] = c.wall.x[corner[k]], end[k] = front[corner[k]];
      assert_float_equal(end[k][2], c.target, 1e-15);
      if (!layers) assert_true(fabs(end[k][1] - wall[k][1] - c.target * lean[1]) < 1e-12);
    }
    assert_true(cw_prism_front_quality(wall, end) >= 0.3);
    print_message("  sheared prism: %.3f of the determinant asked for\n", cw_prism_shear_quality(wall, end, 1, whole));
    assert_true(layers ? cw_prism_shear_quality(wall, end, 1, whole) == 1
                       : cw_prism_shear_quality(wall, end, 1, whole) < 0.1);
    cw_box_tree_free(&tree);
    cw_layers_work_free(&work);
    case_free(&c);
  }
}

static int oblique_plane(const void *context, const double x[3], double normal[2][3]) {
  double tangent = *(const double *)context, c = 1 / sqrt(1 + tangent * tangent);
  if (fabs(x[0] - tangent * (x[2] - 0.005) - 0.01) > 1e-9) return 0;
  normal[0][0] = c;
  normal[0][2] = -c * tangent;
  return 1;
}

static void sheared(const void *context, double u, double v, double x[3]) {
  const double *p = context; // corners and the tangent of the shear
  surface_bilinear(p, u, v, x);
  double bump = 1 - fabs(x[0] - 0.01) / 0.01; // none at the ends of the box
  x[0] += p[12] * bump * (x[2] - 0.005);
}

// A box 20 x 10 x 10 mm cut by a plane through its middle, square and oblique: columns on the plane stay in
// it on all four walls.
static void plane_through_box(void **state) {
  const double angle[4] = {0, 20, 33, 45}, h[2] = {1 * MM, 0.4 * MM};
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 2; j++) {
      double tangent = tan(angle[i] * M_PI / 180);
      Case c = {.target = 0.6 * MM, .guide = oblique_plane, .guide_context = &tangent};
      const double high[3] = {0.02, 0.01, 0.01};
      int n[3] = {(int)lround(high[0] / h[j]), (int)lround(high[1] / h[j]), (int)lround(high[2] / h[j])};
      for (int side = 0; side < 6; side++) {
        int axis = side / 2, a = (axis + 1) % 3, b = (axis + 2) % 3, upper = side % 2;
        double p[13];
        for (int k = 0; k < 4; k++) {
          p[3 * k + axis] = upper ? high[axis] : 0;
          p[3 * k + a] = k == 1 || k == 2 ? high[a] : 0;
          p[3 * k + b] = k >= 2 ? high[b] : 0;
        }
        p[12] = tangent;
        surface_grid(&c.wall, sheared, p, n[a], n[b], !upper);
      }
      char name[40];
      snprintf(name, sizeof name, "plane %g degrees, h %.1f", angle[i], h[j] / MM);
      case_run(&c, name);
      int held = 0;
      for (int32_t v = 0; v < c.wall.point_count; v++) held += c.in.guide_count[v];
      assert_int_equal(held, 2 * (n[1] + n[2]));
      assert_true(c.share > (angle[i] < 40 ? 0.999 : 0.98));
      case_free(&c);
    }
}

typedef struct {
  double depth, tangent;
} Slant;

static int slanted_ends(const void *context, const double x[3], double normal[2][3]) {
  const Slant *s = context;
  double c = 1 / sqrt(1 + s->tangent * s->tangent), y = x[1] - s->tangent * x[2];
  if (fabs(y) > 1e-9 && fabs(y - s->depth) > 1e-9) return 0;
  normal[0][1] = c;
  normal[0][2] = -c * s->tangent;
  return 1;
}

// A square channel cut off obliquely by its caps: wedges of 90 - angle degrees between wall and cap.
static void slanted_caps(void **state) {
  const double p[4][2] = {{0, 0}, {0.012, 0}, {0.012, 0.012}, {0, 0.012}}, angle[3] = {15, 30, 45};
  for (int i = 0; i < 6; i++) {
    double h = i % 2 ? 0.3 * MM : 1 * MM;
    Slant slant = {.depth = 0.02, .tangent = tan(angle[i / 2] * M_PI / 180)};
    Case c = {.target = 0.6 * MM, .guide = slanted_ends, .guide_context = &slant};
    surface_extrude(&c.wall, 4, p, 1, slant.depth, h, 1);
    end_caps(&c.cap, -0.001, -0.001, 0.013, 0.013, slant.depth);
    for (int32_t v = 0; v < c.wall.point_count; v++) c.wall.x[v][1] += slant.tangent * c.wall.x[v][2];
    for (int32_t v = 0; v < c.cap.point_count; v++) c.cap.x[v][1] += slant.tangent * c.cap.x[v][2];
    char name[40];
    snprintf(name, sizeof name, "cap slanted by %g, h %.1f", angle[i / 2], h / MM);
    case_run(&c, name);
    assert_true(c.share > 0.99);
    case_free(&c);
  }
}

static int plane_with_normal(const void *context, const double x[3], double normal[2][3]) {
  if (fabs(x[0] - 0.005) > 1e-9 || x[2] > 1e-9 || fabs(x[1] - 0.005) > 1e-9) return 0;
  memcpy(normal[0], context, sizeof normal[0]);
  return 1;
}

// A plane that nearly touches the floor of a box holds no column: other planes are wanted. One that stands up does.
static void guide_along_wall(void **state) {
  const double low[3] = {0, 0, 0}, high[3] = {0.01, 0.01, 0.01}, cosine[2] = {0.04, 0.6};
  for (int i = 0; i < 2; i++) {
    const double normal[3] = {cosine[i], 0, sqrt(1 - cosine[i] * cosine[i])};
    Case c = {.target = 0.6 * MM, .guide = plane_with_normal, .guide_context = normal};
    surface_box(&c.wall, low, high, 1 * MM, 63, 0);
    assert_int_equal(case_make(&c), i == 0 ? CW_RETRY : CW_OK);
    if (i == 0) assert_non_null(strstr(cw_fail_message(), "(5.0000, 5.0000, 0.0000) mm"));
    // With a cap in its place no other planes help.
    uint8_t *stays = malloc((size_t)c.wall.point_count);
    memset(stays, 1, (size_t)c.wall.point_count);
    cw_layers_free(&c.out);
    c.in.guide_stays = stays;
    assert_int_equal(cw_layers_make(&c.in, &c.out), i == 0 ? CW_ERR_MESH : CW_OK);
    if (i == 0) assert_non_null(strstr(cw_fail_message(), "inside the cap at (5.0000, 5.0000, 0.0000) mm"));
    free(stays);
    case_free(&c);
  }
}

static void failures(void **state) {
  Case c = {.target = 0.6 * MM};
  const double low[3] = {0, 0, 0}, high[3] = {0.01, 0.01, 0.01}, low2[3] = {0.0052, 0.0052, 0.0052};
  const double high2[3] = {0.0152, 0.0152, 0.0152};
  surface_box(&c.wall, low, high, 1 * MM, 63, 0);
  surface_box(&c.wall, low2, high2, 1 * MM, 63, 0);
  assert_int_equal(case_make(&c), CW_ERR_MESH);
  assert_non_null(strstr(cw_fail_message(), " mm"));
  print_message("  %s\n", cw_fail_message());
  case_free(&c);

  // Two faces folded onto each other.
  Case fold = {.target = 0.6 * MM};
  const double a[3] = {0, 0, 0}, b[3] = {0.01, 0, 0}, d[3] = {0, 0.01, 0};
  surface_point(&fold.wall, a);
  surface_point(&fold.wall, b);
  surface_point(&fold.wall, d);
  surface_triangle(&fold.wall, 0, 1, 2);
  surface_triangle(&fold.wall, 2, 1, 0);
  assert_int_equal(case_make(&fold), CW_ERR_MESH);
  print_message("  %s\n", cw_fail_message());
  case_free(&fold);

  // A cap that pierces the floor: no front is clear of it.
  Case pierced = {.target = 0.6 * MM};
  const double corner[3][3] = {{0.005, 0.005, -0.002}, {0.005, 0.005, 0.002}, {0.007, 0.006, 0}};
  surface_box(&pierced.wall, low, high, 1 * MM, 63, 0);
  for (int i = 0; i < 3; i++) surface_point(&pierced.cap, corner[i]);
  surface_triangle(&pierced.cap, 0, 1, 2);
  assert_int_equal(case_make(&pierced), CW_ERR_MESH);
  assert_non_null(strstr(cw_fail_message(), "the front crosses a cap"));
  assert_non_null(strstr(cw_fail_message(), "ask for more cells"));
  print_message("  %s\n", cw_fail_message());
  case_free(&pierced);

  Case zero = {.target = 0};
  surface_box(&zero.wall, low, high, 1 * MM, 63, 0);
  assert_int_equal(case_make(&zero), CW_ERR_INPUT);
  print_message("  %s\n", cw_fail_message());
  case_free(&zero);
}

static void same_each_time(void **state) {
  double *front[2];
  int32_t n = 0;
  for (int i = 0; i < 2; i++) {
    const double p[3][2] = {{0, 0}, {0.02, 0}, {0.01, 0.01 * 1.7320508075688772}};
    Case c = {.target = 1 * MM};
    surface_extrude(&c.wall, 3, p, 1, 0.006, 0.4 * MM, 1);
    assert_int_equal(case_make(&c), CW_OK);
    n = c.wall.point_count;
    front[i] = malloc(n * 3 * sizeof(double));
    memcpy(front[i], c.out.front, n * 3 * sizeof(double));
    case_free(&c);
  }
  assert_memory_equal(front[0], front[1], n * 3 * sizeof(double));
  free(front[0]);
  free(front[1]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(most_normal_by_hand),
      cmocka_unit_test(flat_square),
      cmocka_unit_test(inside_of_box),
      cmocka_unit_test(box_in_box),
      cmocka_unit_test(l_channel),
      cmocka_unit_test(sharp_creases),
      cmocka_unit_test(thin_gap),
      cmocka_unit_test(gap_to_cap),
      cmocka_unit_test(gradation),
      cmocka_unit_test(pipe_between_caps),
      cmocka_unit_test(plane_through_box),
      cmocka_unit_test(failures),
      cmocka_unit_test(same_each_time),
      cmocka_unit_test(slanted_caps),
      cmocka_unit_test(hollow),
      cmocka_unit_test(guide_along_wall),
      cmocka_unit_test(low_crease),
      cmocka_unit_test(leaning_column),
      cmocka_unit_test(sheared_prism),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
