// SPDX-License-Identifier: AGPL-3.0-or-later
// Columns that lean: turned, then thinned.
#include "layers_case.h"
#include "mesher/common/box_tree.h"
#include "mesher/common/vec.h"
#include "mesher/layers/direction_smoothing.h"
#include "mesher/layers/layers_gap.h"
#include "mesher/layers/layers_normal.h"
#include "mesher/layers/layers_repair.h"
#include "mesher/layers/layers_topology.h"
#include "mesher/layers/layers_turn.h"
#include "mesher/layers/prism_quality.h"

static void begin(Case *c, CwLayerWork *work, CwBoxTree *tree) {
  assert_int_equal(cw_layers_topology(&c->in, work), CW_OK);
  assert_int_equal(cw_layers_normals(work, &c->outcome), CW_OK);
  assert_int_equal(cw_gap_tree_make(work, tree), CW_OK);
}

static void end(CwLayerWork *work, CwBoxTree *tree) {
  cw_box_tree_free(tree);
  cw_smoothing_free(&work->smoothing);
  cw_layers_work_free(work);
}

// A column on a plate leans so far over its neighbour that the prisms are sound and layer top triangles are not: it is
// turned back. Where it may not turn, the columns are thinned, but not below what they are asked to keep.
static void leaning_column(void **state) {
  const double least_thickness[3] = {0, 0, 0.55 * MM};
  for (int i = 0; i < 3; i++) {
    Case c = {.target = 0.6 * MM};
    surface_plate(&c.wall, 0.01, 0, 1 * MM, 1);
    assert_int_equal(case_make(&c), CW_OK);
    int32_t n = c.wall.point_count, centre = 0, rounds = 0;
    double(*top)[3] = malloc((size_t)n * sizeof *top), *least = malloc((size_t)n * sizeof *least);
    for (int32_t v = 0; v < n; v++) {
      least[v] = least_thickness[i];
      if (hypot(c.wall.x[v][0] - 0.005, c.wall.x[v][1] - 0.005) < 1e-9) centre = v;
    }
    for (int32_t v = 0; v < n && i > 0; v++) { // lines on which the columns stand and lean
      const double way = v == centre ? 0.87 : 0, length = hypot(0.6, way);
      const double across[2][3] = {{0, 1, 0}, {0.6 / length, 0, -way / length}};
      memcpy(((double(*)[2][3])c.in.constraint_normal)[v], across, sizeof across);
      ((int32_t *)c.in.constraint_count)[v] = 2;
    }
    c.in.least = least; // freed with the case
    CwLayerWork work = {0};
    CwBoxTree tree = {0};
    begin(&c, &work, &tree);
    for (int32_t v = 0; v < n; v++) work.t[v] = c.target;
    const double leaning[3] = {0.87 / 0.6, 0, 1};
    memcpy(work.column[centre], leaning, sizeof leaning);
    for (int after = 0; after < 2; after++) {
      double prism = 1, shape = 1, thickness = INFINITY;
      if (after) assert_int_equal(cw_layers_repair(&work, &tree, top, &rounds, &c.outcome), CW_OK);
      for (int32_t v = 0; v < n; v++) {
        if (!after) cw_layers_place(&work, v, top[v]);
        thickness = fmin(thickness, top[v][2]);
      }
      for (int32_t f = 0; f < c.wall.triangle_count; f++) {
        const int32_t *v = c.wall.triangle[f];
        const double *const a[3] = {c.wall.x[v[0]], c.wall.x[v[1]], c.wall.x[v[2]]};
        const double *const b[3] = {top[v[0]], top[v[1]], top[v[2]]};
        shape = fmin(shape, cw_prism_top_quality(a, b));
        prism = fmin(prism, cw_layers_prism_quality(&work, f, (const double(*)[3])top));
      }
      print_message("  leaning column: prisms %.3f, layer top %.3f, thicknesses from %.2f mm\n", prism, shape,
                    thickness / MM);
      assert_true(prism >= 0.12);
      assert_true(after && i < 2 ? shape >= 0.3 : shape < 0.3);
      if (!after || i == 0) assert_near(thickness, c.target, 1e-15);
      if (after && i == 1) assert_true(thickness < 0.55 * MM);
      if (after && i == 2) assert_near(thickness, 0.55 * MM, 1e-15);
    }
    end(&work, &tree);
    free(top);
    case_free(&c);
  }
}

// Columns over a flat triangle that lean across its longest edge by 75 degrees: sound prisms on a sound layer top, but
// as one layer of small determinant. They are turned up again, at full thickness, where the number of layers is known.
static void sheared_prism(void **state) {
  for (int layers = 0; layers < 2; layers++) {
    Case c = {.target = 0.5 * MM};
    const double lean[3] = {0, tan(75 * M_PI / 180), 1};
    double top[3][3];
    int32_t rounds = 0;
    const double x[3][3] = {{0, 0, 0}, {5 * MM, 1 * MM, 0}, {10 * MM, 0, 0}};
    surface_triangle(&c.wall, surface_point(&c.wall, x[0]), surface_point(&c.wall, x[1]), surface_point(&c.wall, x[2]));
    assert_int_equal(case_make(&c), CW_OK);
    c.in.division.count = layers;
    CwLayerWork work = {0};
    CwBoxTree tree = {0};
    begin(&c, &work, &tree);
    for (int v = 0; v < 3; v++) {
      work.t[v] = c.target;
      memcpy(work.column[v], lean, sizeof lean);
    }
    assert_int_equal(cw_layers_repair(&work, &tree, top, &rounds, &c.outcome), CW_OK);
    const int32_t *corner = c.wall.triangle[0];
    const double *wall[3], *up[3], whole[3] = {1, 1, 1};
    for (int k = 0; k < 3; k++) {
      wall[k] = c.wall.x[corner[k]], up[k] = top[corner[k]];
      assert_near(up[k][2], c.target, 1e-15);
      if (!layers) assert_true(fabs(up[k][1] - wall[k][1] - c.target * lean[1]) < 1e-12);
    }
    assert_true(cw_prism_top_quality(wall, up) >= 0.3);
    print_message("  sheared prism: %.3f of the determinant asked for\n", cw_prism_shear_quality(wall, up, 1, whole));
    assert_true(layers ? cw_prism_shear_quality(wall, up, 1, whole) == 1
                       : cw_prism_shear_quality(wall, up, 1, whole) < 0.1);
    end(&work, &tree);
    case_free(&c);
  }
}

// A triangle with an edge in the plane x = 0, under a layer top that rises from the plane so steeply that it leaves a
// wedge of less than 54 degrees between them: its free column is turned away from the plane, where a plane is. Where it
// would cross another layer top it is turned back, and nothing is thinned.
static void wedge_beside_plane(void **state) {
  for (int i = 0; i < 3; i++) {
    int held = i > 0, faced = i == 2, points = faced ? 6 : 3;
    Case c = {.target = 7 * MM};
    const double x[3][3] = {{0, 0, 0}, {0, 10 * MM, 0}, {8 * MM, 5 * MM, 0}}, up[3] = {0, 0, 1};
    double top[6][3], column[3];
    int32_t rounds = 0;
    for (int v = 0; v < 3; v++) assert_int_equal(surface_point(&c.wall, x[v]), v);
    surface_triangle(&c.wall, 0, 1, 2);
    const double at[3][3] = {{8.3 * MM, 0, 6 * MM}, {8.3 * MM, 10 * MM, 6 * MM}, {8.3 * MM, 5 * MM, 9 * MM}};
    for (int v = 0; v < 3 && faced; v++) assert_int_equal(surface_point(&c.wall, at[v]), 3 + v);
    if (faced) surface_triangle(&c.wall, 3, 4, 5);
    assert_int_equal(case_make(&c), CW_OK);
    for (int v = 0; v < 2 && held; v++) {
      ((int32_t *)c.in.constraint_count)[v] = 1;
      ((double(*)[2][3])c.in.constraint_normal)[v][0][0] = v ? -1 : 1;
    }
    CwLayerWork work = {0};
    CwBoxTree tree = {0};
    begin(&c, &work, &tree);
    for (int v = 0; v < points; v++) {
      work.t[v] = v == 2 ? c.target : v < 2 ? 0.5 * MM : 0.2 * MM;
      if (v < 3) memcpy(work.column[v], up, sizeof up);
    }
    assert_int_equal(cw_layers_repair(&work, &tree, top, &rounds, &c.outcome), CW_OK);
    cw_sub(top[2], x[2], column);
    assert_near(column[2], c.target, 1e-15);
    double wedge = atan2(top[2][0], top[2][2] - 0.5 * MM) * 180 / M_PI;
    print_message("  %s plane%s: a wedge of %.1f degrees\n", held ? "with a" : "without", faced ? " and a wall" : "",
                  wedge);
    assert_true(i == 1 ? wedge >= 54 : wedge < 52 && column[0] == 0);
    if (faced) assert_near(top[3][0], 8.1 * MM, 1e-15);
    end(&work, &tree);
    case_free(&c);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(leaning_column),
      cmocka_unit_test(sheared_prism),
      cmocka_unit_test(wedge_beside_plane),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
