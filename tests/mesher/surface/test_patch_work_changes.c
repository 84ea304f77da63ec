// SPDX-License-Identifier: AGPL-3.0-or-later
// Flips and removals (the rest: test_patch_work).
#include "mesher/surface/patch_work.h"

#include <stdlib.h>

#include "patch_check.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

// Each edge is turned exactly where the two triangles make a convex quadrangle and it is not given, and turning it once
// more brings it back.
static void edges_of_convex_quadrangles_are_flipped(void **state) {
  uint64_t seed = 3;
  int flips = 0, refused = 0;
  CwPatchWork work;
  Plan *plan = divided_rectangle(&seed, &work);
  for (int32_t k = 0; k < 3 * work.triangle_count; k++) {
    const int32_t t = k / 3, n = work.neighbour[t][k % 3];
    const int i = k % 3, is_given = work.given[t] >> i & 1;
    const int32_t a = work.corner[t][i], b = work.corner[t][(i + 1) % 3], c = work.corner[t][(i + 2) % 3];
    if (is_given) {
      assert_int_equal(cw_patch_flip(&work, t, i), 0);
      continue;
    }
    const int32_t d = work.corner[n][cw_patch_edge_from(&work, n, c, b)];
    const int convex =
        cw_twice_area(work.uv[a], work.uv[b], work.uv[d]) > 0 && cw_twice_area(work.uv[a], work.uv[d], work.uv[c]) > 0;
    assert_int_equal(cw_patch_flip(&work, t, i), convex);
    check_patch(plan, &work, 2);
    flips += convex;
    refused += !convex;
    if (!convex) continue;
    const int across = cw_patch_edge_from(&work, t, d, a);
    assert_in_range(across, 0, 2);
    assert_int_equal(work.corner[t][across], b);
    assert_int_equal(cw_patch_flip(&work, t, across), 1);
    check_patch(plan, &work, 2);
    const int32_t *now = work.corner[t];
    assert_true(now[0] + now[1] + now[2] - b - c == a || now[0] + now[1] + now[2] - b - c == d);
    assert_true((now[0] == b || now[1] == b || now[2] == b) && (now[0] == c || now[1] == c || now[2] == c));
  }
  assert_true(flips > 50 && refused > 10);
  cw_patch_work_close(&work);
  free(plan);
}

// Points as good as on a line make no triangle.
static void flips_make_no_flat_triangles(void **state) {
  for (int flat = 0; flat < 2; flat++) {
    const double corner[4][2] = {{1, 0}, {0, 1}, {flat ? -1e-10 : -1e-8, 0}, {0, -1}};
    Plan *plan = new_plan(PLANE, 1);
    CwPatchWork work;
    for (int p = 0; p < 4; p++) add_point(plan, corner[p][0], corner[p][1]);
    add_outline(plan);
    open_patch(plan, &work);
    int i = 0;
    while (work.given[0] >> i & 1) i++;
    assert_true(work.corner[0][i] % 2 == 1); // divided from 0 to 2
    assert_int_equal(cw_patch_flip(&work, 0, i), !flat);
    cw_patch_work_close(&work);
    free(plan);
  }
}

// The fan of a regular hexagon from one corner: its outer triangles, of the edges 1, 1 and sqrt(3), have the quality
// 0.6, the inner ones, of 1, sqrt(3) and 2, sqrt(3) / 2 of it more; the longest new edge is twice as long as wanted.
static void a_point_goes_where_its_neighbours_allow(void **state) {
  static const double least[3] = {0.599, 0.601, 0.599}, most[3] = {2.001, 2.001, 1.999};
  for (int i = 0; i < 3; i++) {
    const double middle[2] = {0, 0}, other[2] = {0.1, 0.2};
    int inserted;
    CwPatchWork work;
    Plan *plan = polygon_plan(6, 1, 0.1);
    open_patch(plan, &work);
    assert_int_equal(cw_patch_insert(&work, middle, 0, 0.5, INFINITY, &inserted), CW_OK);
    assert_int_equal(cw_patch_remove(&work, 6, least[i], most[i]), i == 0);
    assert_int_equal(check_patch(plan, &work, HEXAGON), i == 0 ? 4 : 6);
    assert_int_equal(work.point_triangle[6] < 0, i == 0);
    // The next point takes the room that is free.
    if (i == 0) {
      int32_t from = 0;
      while (work.corner[from][0] < 0) from++;
      assert_int_equal(cw_patch_insert(&work, other, from, 0.5, INFINITY, &inserted), CW_OK);
      assert_int_equal(inserted, 1);
      assert_int_equal(work.triangle_count, 6);
      assert_int_equal(check_patch(plan, &work, HEXAGON), 6);
    }
    cw_patch_work_close(&work);
    free(plan);
  }
}

// The worst quality of the fan of a polygon from corner w; -1 where one of its triangles is turned over.
static double worst_of_fan(const CwPatchWork *work, int corners, int w) {
  const double up[3] = {0, 0, 1};
  double worst = 1;
  for (int k = 1; k + 1 < corners; k++) {
    const int a = (w + k) % corners, b = (w + k + 1) % corners;
    if (!(cw_twice_area(work->uv[w], work->uv[a], work->uv[b]) > 1e-3)) return -1;
    worst = fmin(worst, cw_patch_quality_at(work->x[w], work->x[a], work->x[b], up));
  }
  return worst;
}

// In a random star-shaped heptagon the middle is drawn into the corner whose fan has the best worst triangle, where
// there is a fan at all.
static void a_point_is_drawn_into_the_best_neighbour(void **state) {
  uint64_t seed = 29;
  enum { CORNERS = 7 };
  int drawn = 0, stayed = 0;
  for (int round = 0; round < 150; round++) {
    Plan *plan = new_plan(PLANE, 0.01);
    const double middle[2] = {0, 0};
    const double least = 0.8 * draw(&seed);
    double area = 0, worst[CORNERS];
    int inserted, best = 0, at = 0;
    CwPatchWork work;
    for (int k = 0; k < CORNERS; k++) {
      const double radius = 0.3 + 0.7 * draw(&seed), angle = 2 * M_PI * k / CORNERS;
      add_point(plan, radius * cos(angle), radius * sin(angle));
    }
    for (int k = 0; k < CORNERS; k++) {
      add_edge(plan, k, (k + 1) % CORNERS, 1);
      area += 0.5 * cw_twice_area(middle, plan->uv[k], plan->uv[(k + 1) % CORNERS]);
    }
    open_patch(plan, &work);
    while (cw_patch_find(&work, middle, at) < 0) at++;
    assert_int_equal(cw_patch_insert(&work, middle, at, 0.5, INFINITY, &inserted), CW_OK);
    for (int k = 0; k < CORNERS; k++) {
      worst[k] = worst_of_fan(&work, CORNERS, k);
      if (worst[k] > worst[best]) best = k;
    }
    if (inserted && work.border_count == CORNERS) {
      const int goes = cw_patch_remove(&work, CORNERS, least, 100);
      assert_int_equal(goes, worst[best] > least);
      check_patch(plan, &work, area);
      for (int32_t t = 0; goes && t < work.triangle_count; t++) {
        const int32_t *c = work.corner[t];
        if (c[0] >= 0) assert_true(c[0] == best || c[1] == best || c[2] == best);
      }
      drawn += goes;
      stayed += !goes;
    }
    cw_patch_work_close(&work);
    free(plan);
  }
  assert_true(drawn > 20 && stayed > 5);
}

// Whatever comes after whatever, in two components: the triangulation stays one.
static void any_changes_keep_it_sound(void **state) {
  uint64_t seed = 71;
  int done[3] = {0};
  CwPatchWork work;
  Plan *plan = divided_rectangle(&seed, &work);
  for (int step = 0; step < 5000; step++) {
    int32_t t = draw_below(&seed, work.triangle_count), p = draw_below(&seed, work.point_count), inserted;
    const double uv[2] = {2 * draw(&seed), draw(&seed)};
    const int kind = draw_below(&seed, 3);
    if (kind < 2 && work.corner[t][0] < 0) continue;
    if (kind == 2 && (p < 6 || work.point_triangle[p] < 0)) continue;
    if (kind == 0) {
      assert_int_equal(cw_patch_insert(&work, uv, t, 0.3, INFINITY, &inserted), CW_OK);
      done[0] += inserted;
    } else {
      done[kind] += kind == 1 ? cw_patch_flip(&work, t, draw_below(&seed, 3)) : cw_patch_remove(&work, p, 0.02, 100);
    }
    check_patch(plan, &work, 2);
    assert_true(work.component[work.point_triangle[0]] != work.component[work.point_triangle[2]]);
  }
  assert_true(done[0] > 100 && done[1] > 100 && done[2] > 100);
  cw_patch_work_close(&work);
  free(plan);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(edges_of_convex_quadrangles_are_flipped),
      cmocka_unit_test(flips_make_no_flat_triangles),
      cmocka_unit_test(a_point_goes_where_its_neighbours_allow),
      cmocka_unit_test(a_point_is_drawn_into_the_best_neighbour),
      cmocka_unit_test(any_changes_keep_it_sound),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
