// SPDX-License-Identifier: AGPL-3.0-or-later
// Directions of columns: free, and held in open patches and partition planes.
#include "layers_case.h"
#include "mesher/layers/layers.h"
#include "mesher/layers/layers_normal.h"
#include "mesher/layers/layers_topology.h"

// The best direction of one, two and three faces, free and held, by hand.
static void most_normal_by_hand(void **state) {
  const double n[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, none[2][3] = {{0}};
  double g[3], s = sqrt(0.5);
  assert_near(cw_layers_most_normal(1, n, 0, none, g), 1, 1e-14);
  assert_near(cw_layers_most_normal(2, n, 0, none, g), s, 1e-14);
  assert_near(g[0], s, 1e-14);
  assert_near(cw_layers_most_normal(3, n, 0, none, g), 1 / sqrt(3), 1e-14);
  for (int k = 0; k < 3; k++) assert_near(g[k], 1 / sqrt(3), 1e-14);
  // A fourth normal between two others changes nothing.
  const double more[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {s, s, 0}};
  assert_near(cw_layers_most_normal(4, more, 0, none, g), 1 / sqrt(3), 1e-14);
  // Held in z = 0: the third face is seen edge on. Held in the plane normal to (1,0,1): g = (a, b, -a).
  const double flat[2][3] = {{0, 0, 1}}, line[2][3] = {{0, 0, 1}, {s, -s, 0}};
  assert_near(cw_layers_most_normal(2, n, 1, flat, g), s, 1e-14);
  assert_near(cw_layers_most_normal(3, n, 1, flat, g), 0, 1e-14);
  assert_near(cw_layers_most_normal(2, n, 2, line, g), s, 1e-14);
  assert_near(g[0], s, 1e-14);
  const double slanted[2][3] = {{s, 0, s}};
  // x.g = a, y.g = b with 2 a^2 + b^2 = 1 equal at a = b = 1/sqrt(3).
  assert_near(cw_layers_most_normal(2, n, 1, slanted, g), 1 / sqrt(3), 1e-14);
  // Opposite faces leave nothing to see.
  const double shut[2][3] = {{1, 0, 0}, {-1, 0, 0}};
  assert_true(cw_layers_most_normal(2, shut, 0, none, g) < 1e-15);
}

// Where a knife edge along z of half angle a stands on z = 0: shares of sin(a) with the edge's sides and of the root of
// a half with the floor are as great for all three in (1, 0, root of a half), over its length. Equal edges change
// nothing, nor do two faces, nor does the plane that halves the edge.
static void fair_normal_by_hand(void **state) {
  const double s = sqrt(0.5), none[2][3] = {{0}}, across[2][3] = {{0, 1, 0}};
  for (int i = 0; i < 3; i++) {
    double a = (4 + 13 * i) * M_PI / 180, g[3], length = sqrt(1.5);
    const double n[3][3] = {{sin(a), cos(a), 0}, {sin(a), -cos(a), 0}, {0, 0, 1}};
    for (int held = 0; held < 2; held++) {
      assert_near(cw_layers_fair_normal(3, n, held, held ? across : none, g), sin(a) / length, 1e-13);
      assert_near(g[0], 1 / length, 1e-13);
      assert_near(g[1], 0, 1e-13);
      assert_near(g[2], s / length, 1e-13);
    }
    assert_near(cw_layers_fair_normal(2, n, 0, none, g), sin(a), 1e-13);
  }
  const double n[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double g[3];
  assert_near(cw_layers_fair_normal(3, n, 0, none, g), 1 / sqrt(3), 1e-14);
  // No less than a column needs: of an edge of 3.5 degrees in half, the most normal direction.
  const double thin = 3.5 * M_PI / 180, edge[3][3] = {{sin(thin), cos(thin), 0}, {sin(thin), -cos(thin), 0}, {0, 0, 1}};
  assert_near(cw_layers_fair_normal(3, edge, 0, none, g), sin(thin) / sqrt(1 + sin(thin) * sin(thin)), 1e-13);
}

// The fold of two planes over x = 0 that both rise (or fall) by an angle from it: columns fan out from a concave one,
// unless it is nearly flat; a convex one is an edge where it is sharper.
static void folds_by_hand(void **state) {
  const struct {
    double degrees;
    CwCrease crease;
  } wanted[] = {{8, CW_CREASE_NONE},  {14, CW_CREASE_CONCAVE}, {20, CW_CREASE_CONCAVE}, {45, CW_CREASE_CONCAVE},
                {-8, CW_CREASE_NONE}, {-20, CW_CREASE_NONE},   {-26, CW_CREASE_CONVEX}, {-45, CW_CREASE_CONVEX}};
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
    double slope = tan(wanted[i].degrees * M_PI / 180), x[9][3], target[9];
    int32_t triangle[8][3];
    for (int v = 0; v < 9; v++) {
      x[v][0] = v % 3 - 1, x[v][1] = v / 3, x[v][2] = slope * fabs(x[v][0]);
      target[v] = 0.1;
    }
    for (int t = 0; t < 8; t++) { // the fluid lies above
      int32_t a = t / 4 * 3 + t / 2 % 2;
      triangle[t][0] = a, triangle[t][1] = t % 2 ? a + 4 : a + 3, triangle[t][2] = t % 2 ? a + 1 : a + 4;
    }
    CwLayerInput in = {.point_count = 9,
                       .x = (const double(*)[3])x,
                       .triangle_count = 8,
                       .triangle = (const int32_t(*)[3])triangle,
                       .target = target};
    CwLayerWork work = {0};
    CwOutcome outcome = {0};
    assert_int_equal(cw_layers_topology(&in, &work), CW_OK);
    assert_int_equal(cw_layers_normals(&work, &outcome), CW_OK);
    for (int v = 1; v < 9; v += 3) {
      assert_int_equal(work.crease[v], wanted[i].crease);
      assert_near(fabs(work.normal[v][2]), 1, 1e-12);
      if (wanted[i].crease != CW_CREASE_NONE) assert_near(fabs(work.along[v][1]), 1, 1e-12);
    }
    for (int v = 0; v < 9; v += 3) assert_int_equal(work.crease[v], CW_CREASE_NONE);
    cw_layers_work_free(&work);
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
      Case c = {.target = 0.6 * MM, .constraint = oblique_plane, .constraint_context = &tangent};
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
      for (int32_t v = 0; v < c.wall.point_count; v++) held += c.in.constraint_count[v];
      assert_int_equal(held, 2 * (n[1] + n[2]));
      assert_true(c.share > (angle[i] < 40 ? 0.999 : 0.98));
      case_free(&c);
    }
}

static int crossing_planes(const void *context, const double x[3], double normal[2][3]) {
  int count = 0;
  for (int k = 0; k < 2; k++)
    if (fabs(x[k] - 0.4 * (1 + 11 * k) * MM) < 1e-9) normal[count++][k] = 1;
  return count;
}

// Two planes cross in a line that meets the floor and the ceiling one edge off a wall, from where the smoothing leans
// columns: the column on the line cannot, the others on a plane along it alone.
static void planes_crossing_beside_a_wall(void **state) {
  const double low[3] = {0, 0, 0}, high[3] = {0.008, 0.008, 0.008};
  Case c = {.target = 0.6 * MM, .constraint = crossing_planes};
  int crossings = 0;
  surface_box(&c.wall, low, high, 0.4 * MM, 63, 0);
  case_run(&c, "crossing planes"); // looks at the columns on planes
  for (int32_t v = 0; v < c.wall.point_count; v++) crossings += c.in.constraint_count[v] == 2;
  assert_int_equal(crossings, 2);
  case_free(&c);
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

// A square channel cut off obliquely by its open patches: wedges of 90 - angle degrees between wall and open patch.
static void slanted_open_patches(void **state) {
  const double p[4][2] = {{0, 0}, {0.012, 0}, {0.012, 0.012}, {0, 0.012}}, angle[3] = {15, 30, 45};
  for (int i = 0; i < 6; i++) {
    double h = i % 2 ? 0.3 * MM : 1 * MM;
    Slant slant = {.depth = 0.02, .tangent = tan(angle[i / 2] * M_PI / 180)};
    Case c = {.target = 0.6 * MM, .constraint = slanted_ends, .constraint_context = &slant};
    surface_extrude(&c.wall, 4, p, 1, slant.depth, h, 1);
    surface_ends(&c.open_patch, -0.001, -0.001, 0.013, 0.013, slant.depth);
    for (int32_t v = 0; v < c.wall.point_count; v++) c.wall.x[v][1] += slant.tangent * c.wall.x[v][2];
    for (int32_t v = 0; v < c.open_patch.point_count; v++) c.open_patch.x[v][1] += slant.tangent * c.open_patch.x[v][2];
    char name[60];
    snprintf(name, sizeof name, "open patch slanted by %g, h %.1f", angle[i / 2], h / MM);
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
static void constraint_along_wall(void **state) {
  const double low[3] = {0, 0, 0}, high[3] = {0.01, 0.01, 0.01}, cosine[2] = {0.04, 0.6};
  for (int i = 0; i < 2; i++) {
    const double normal[3] = {cosine[i], 0, sqrt(1 - cosine[i] * cosine[i])};
    Case c = {.target = 0.6 * MM, .constraint = plane_with_normal, .constraint_context = normal};
    surface_box(&c.wall, low, high, 1 * MM, 63, 0);
    assert_int_equal(case_make(&c), CW_OK);
    assert_int_equal(c.outcome.kind, i == 0 ? CW_OUTCOME_REPLAN : CW_OUTCOME_DONE);
    for (int k = 0; i == 0 && k < 3; k++) assert_true(fabs(c.outcome.place[0][k] - (k < 2 ? 0.005 : 0)) < 1e-9);
    // With an open patch in its place no other planes help: the column may be pinched.
    uint8_t *stays = malloc((size_t)c.wall.point_count);
    memset(stays, 1, (size_t)c.wall.point_count);
    cw_layers_free(&c.out);
    c.in.constraint_stays = stays;
    c.outcome = (CwOutcome){0};
    assert_int_equal(cw_layers_make(&c.in, &c.out, &c.outcome), CW_OK);
    assert_int_equal(c.outcome.kind, i == 0 ? CW_OUTCOME_PINCH : CW_OUTCOME_DONE);
    if (i == 0) assert_non_null(strstr(c.outcome.reason, "no column inside the open patch leaves the wall"));
    free(stays);
    case_free(&c);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(most_normal_by_hand),   cmocka_unit_test(fair_normal_by_hand),
      cmocka_unit_test(folds_by_hand),         cmocka_unit_test(plane_through_box),
      cmocka_unit_test(slanted_open_patches),  cmocka_unit_test(planes_crossing_beside_a_wall),
      cmocka_unit_test(constraint_along_wall),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
