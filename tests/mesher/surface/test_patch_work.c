// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/surface/patch_work.h"

#include <stdlib.h>
#include <string.h>

#include "patch_check.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

// 4 sqrt(3) area / sum of the squares of the edges: 1 for equilateral, sqrt(3) / 2 for half a square.
static void quality_is_one_for_equilateral(void **state) {
  const double a[3] = {0, 0, 1}, b[3] = {2, 0, 1}, c[3] = {1, sqrt(3), 1}, d[3] = {0, 2, 1}, e[3] = {5, 0, 1};
  const double up[3] = {0.3, 0, 2}, down[3] = {0, 0, -1};
  assert_near(cw_patch_quality_at(a, b, c, up), 1, 1e-15);
  assert_near(cw_patch_quality_at(a, b, d, up), sqrt(0.75), 1e-15);
  assert_near(cw_patch_quality_at(a, b, d, down), -sqrt(0.75), 1e-15);
  assert_near(cw_patch_quality_at(a, b, e, up), 0, 0);
  assert_near(cw_patch_quality_at(a, a, a, up), 0, 0);
}

// The sign is that of the sum of the normals of all three corners.
static void quality_goes_by_the_normals_of_all_corners(void **state) {
  double x[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, xu[3][3], xv[3][3] = {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}};
  const CwPatchWork work = {.x = x, .xu = xu, .xv = xv};
  for (int odd = 0; odd < 3; odd++)
    for (int sign = -1; sign <= 1; sign += 2) {
      for (int p = 0; p < 3; p++) memcpy(xu[p], (double[3]){sign * (p == odd ? 3 : -1), 0, 0}, sizeof xu[p]);
      assert_near(cw_patch_quality(&work, 0, 1, 2), sign * sqrt(0.75), 1e-15);
    }
}

// Given points keep their exact places; the wanted length there is the mean of the given edges that end there, and that
// of the field where none does.
static void it_opens_with_what_is_given(void **state) {
  const double corner[5][2] = {{0, 0}, {3, 0}, {3, 4}, {0, 4}, {1, 1}};
  Plan *plan = new_plan(STRETCHED, 0.7);
  CwPatchWork work;
  for (int p = 0; p < 5; p++) add_point(plan, 50 * corner[p][0], corner[p][1]); // u is stretched by 0.02
  for (int p = 0; p < 4; p++) add_edge(plan, p, (p + 1) % 4, 1);
  add_edge(plan, 0, 2, 0);
  plan->x[2][2] = 1e-9; // a little off the map
  plan->uv[4][0] = 1;   // off the diagonal, and no edge ends there
  surface_at(plan, plan->uv[4], plan->x[4], NULL, NULL);
  open_patch(plan, &work);
  check_patch(plan, &work, 600);
  const double size[5] = {(3 + 4 + 5) / 3., (3 + 4) / 2., (3 + 4 + 5) / 3., (3 + 4) / 2., 0.7};
  for (int p = 0; p < 5; p++) {
    assert_memory_equal(work.x[p], plan->x[p], sizeof plan->x[p]);
    assert_near(work.size[p], size[p], 1e-9);
    assert_near(work.metric[p][0], 0.0004, 1e-18);
    assert_near(work.metric[p][1], 0, 0);
    assert_near(work.metric[p][2], 1, 0);
  }
  cw_patch_work_close(&work);
  assert_null(work.uv);
  free(plan);
}

// From each triangle the middle of each other is found, unless the line lies between; a place outside never is.
static void places_are_found_up_to_given_edges(void **state) {
  uint64_t seed = 3;
  CwPatchWork work;
  Plan *plan = divided_rectangle(&seed, &work);
  for (int32_t t = 0; t < work.triangle_count; t++) {
    const int32_t *c = work.corner[t];
    double middle[2];
    for (int k = 0; k < 2; k++) middle[k] = (work.uv[c[0]][k] + work.uv[c[1]][k] + work.uv[c[2]][k]) / 3;
    for (int32_t from = 0; from < work.triangle_count; from++) {
      assert_int_equal(cw_patch_find(&work, middle, from), is_right(&work, from) == is_right(&work, t) ? t : -1);
    }
    assert_int_equal(cw_patch_find(&work, (const double[2]){middle[0], 1.001}, t), -1);
    assert_int_equal(cw_patch_find(&work, (const double[2]){middle[0], -0.001}, t), -1);
  }
  cw_patch_work_close(&work);
  free(plan);
}

// The middle of a regular polygon lies in the circles of all its triangles: as many triangles as it has corners follow,
// in a ring that runs round it; from 49 on the ring is too long.
static void the_middle_of_a_polygon_gets_all_its_corners(void **state) {
  const int corners[4] = {5, 6, 48, 49};
  for (int i = 0; i < 4; i++) {
    const int n = corners[i];
    const double middle[2] = {0, 0};
    int32_t triangles[CW_PATCH_RING], ring[CW_PATCH_RING];
    int inserted;
    CwPatchWork work;
    Plan *plan = polygon_plan(n, 1, 0.02);
    open_patch(plan, &work);
    // The marks wrap round: what was marked a long time ago is not marked.
    work.marker = UINT32_MAX;
    for (int32_t t = 0; t < work.triangle_count; t++) work.mark[t] = 1;
    assert_int_equal(cw_patch_insert(&work, middle, 0, 0.5, INFINITY, &inserted), CW_OK);
    assert_int_equal(inserted, 1);
    assert_int_equal(check_patch(plan, &work, 0.5 * n * sin(2 * M_PI / n)), n);
    assert_int_equal(work.border_count, n);
    for (int k = 0; k < n; k++) assert_int_equal(work.corner[work.fresh[k]][0], n);
    assert_int_equal(cw_patch_ring(&work, n, triangles, ring), n <= CW_PATCH_RING ? n : 0);
    for (int k = 0; k < n && n <= CW_PATCH_RING; k++) {
      const int32_t wanted[3] = {n, ring[k], ring[(k + 1) % n]};
      assert_int_equal(ring[(k + 1) % n], (ring[k] + 1) % n);
      for (int c = 0; c < 3; c++)
        assert_int_equal(work.corner[triangles[k]][(cw_patch_corner_of(work.corner[triangles[k]], n) + c) % 3],
                         wanted[c]);
    }
    if (n > CW_PATCH_RING) assert_int_equal(cw_patch_remove(&work, n, -1, 100), 0);
    cw_patch_work_close(&work);
    free(plan);
  }
}

// Tries a point in the hexagon of radius 3 in the sheared plane, which has a point in its middle. Returns whether it
// went in; *got: with which length.
static int goes_in(double size_of_middle, double size, double u, double v, double least, double cap, double *got) {
  Plan *plan = sheared_plan(polygon_plan(6, 3, size_of_middle));
  CwPatchWork work;
  double uv[2] = {0, 0};
  int inserted;
  open_patch(plan, &work);
  assert_int_equal(cw_patch_insert(&work, uv, 0, 0, INFINITY, &inserted), CW_OK);
  assert_int_equal(inserted, 1);
  plan->size = size;
  uv_of_sheared(u, v, uv);
  assert_int_equal(cw_patch_insert(&work, uv, 0, least, cap, &inserted), CW_OK);
  assert_int_equal(work.point_count, 7 + inserted);
  check_patch(plan, &work, uv_area_of_sheared(9 * HEXAGON));
  *got = inserted ? work.size[7] : 0;
  cw_patch_work_close(&work);
  free(plan);
  return inserted;
}

// No nearer than `least` times the wanted length, which beside a point where less is wanted is the mean of both.
static void points_keep_their_distance(void **state) {
  const struct {
    double of_middle, size, least, cap, limit;
  } kind[] = {{1, 1, 0.6, INFINITY, 0.6},
              {1, 1, 0.9, INFINITY, 0.9},
              {1, 1, 0.9, 0.5, 0.45},          // the cap holds the length down
              {1, 0.5, 0.9, INFINITY, 0.45},   // longer edges there do not count
              {0.5, 1.5, 0.9, INFINITY, 0.9}}; // the mean
  for (int i = 0; i < 5; i++)
    for (int turn = 0; turn < 5; turn++) {
      const double c = cos(turn + 0.1), s = sin(turn + 0.1), near = 0.999 * kind[i].limit, far = 1.001 * kind[i].limit;
      double got;
      assert_false(goes_in(kind[i].of_middle, kind[i].size, near * c, near * s, kind[i].least, kind[i].cap, &got));
      assert_true(goes_in(kind[i].of_middle, kind[i].size, far * c, far * s, kind[i].least, kind[i].cap, &got));
      assert_near(got, fmin(kind[i].size, kind[i].cap), 0);
    }
}

// No nearer than 0.4 of the wanted length to a given edge, and not outside; beyond the edge there is nothing.
static void points_keep_off_given_edges(void **state) {
  const double inner = 1.5 * sqrt(3); // the way to each edge
  double got;
  for (int k = 0; k < 6; k++) {
    const double c = cos(M_PI * (k + 0.5) / 3), s = sin(M_PI * (k + 0.5) / 3);
    for (int half = 1; half <= 2; half++) {
      const double size = 1. / half, near = inner - 0.399 * size, far = inner - 0.401 * size;
      assert_false(goes_in(1, size, near * c, near * s, 0, INFINITY, &got));
      assert_true(goes_in(1, size, far * c, far * s, 0, INFINITY, &got));
    }
    assert_false(goes_in(1, 1e-9, 1.001 * inner * c, 1.001 * inner * s, 0, INFINITY, &got));
  }
}

// Coordinates in the sheared plane.
static void place_of(const CwPatchWork *work, int32_t p, double place[2]) {
  double first[3], second[3];
  axes_of_sheared(first, second);
  place[0] = cw_dot(work->x[p], first);
  place[1] = cw_dot(work->x[p], second);
}

// How far p lies inside of the circle through a, b and c, as a part of its radius.
static double depth_in_circle(const double a[2], const double b[2], const double c[2], const double p[2]) {
  const double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1], d = 2 * (bx * cy - by * cx);
  const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy, x = (cy * b2 - by * c2) / d, y = (bx * c2 - cx * b2) / d;
  return 1 - hypot(p[0] - a[0] - x, p[1] - a[1] - y) / hypot(x, y);
}

// Points go in by the circles of the surface: however (u,v) is sheared, the triangulation stays that of Delaunay.
static void insertions_keep_delaunay_on_the_surface(void **state) {
  uint64_t seed = 11;
  CwPatchWork work;
  Plan *plan = sheared_plan(polygon_plan(6, 1, 1e-6));
  int inserted;
  open_patch(plan, &work);
  for (int i = 0; i < 150; i++) {
    const double angle = 2 * M_PI * draw(&seed), radius = 0.86 * sqrt(draw(&seed));
    double uv[2];
    uv_of_sheared(radius * cos(angle), radius * sin(angle), uv);
    assert_int_equal(cw_patch_insert(&work, uv, draw_below(&seed, work.triangle_count), 0.5, INFINITY, &inserted),
                     CW_OK);
    assert_int_equal(inserted, 1);
    assert_memory_equal(work.uv[6 + i], uv, sizeof uv);
    assert_int_equal(check_patch(plan, &work, uv_area_of_sheared(HEXAGON)), 4 + 2 * (i + 1));
  }
  for (int32_t t = 0; t < work.triangle_count; t++) {
    double corner[3][2], place[2];
    for (int k = 0; k < 3; k++) place_of(&work, work.corner[t][k], corner[k]);
    for (int32_t p = 0; p < work.point_count; p++) {
      place_of(&work, p, place);
      assert_true(depth_in_circle(corner[0], corner[1], corner[2], place) < 1e-7);
    }
  }
  cw_patch_work_close(&work);
  free(plan);
}

// The plane, but with derivatives that say that u is stretched.
static void jumping(const void *context, const double uv[2], double x[3], double xu[3], double xv[3]) {
  const double stretch = *(const double *)context;
  memcpy(x, (const double[3]){uv[0], uv[1], 0}, sizeof(double[3]));
  if (xu) memcpy(xu, (const double[3]){stretch, 0, 0}, sizeof(double[3]));
  if (xv) memcpy(xv, (const double[3]){0, 1, 0}, sizeof(double[3]));
}

// The triangles about triangle t whose circles hold uv where u is stretched.
static int32_t held_in_circles(const CwPatchWork *work, const double uv[2], int32_t t, double stretch) {
  uint8_t taken[100] = {0};
  int32_t count = 1;
  const double place[2] = {stretch * uv[0], uv[1]};
  assert_true(work->triangle_count < 100);
  taken[t] = 1;
  for (int more = 1; more;) {
    more = 0;
    for (int32_t k = 0; k < 3 * work->triangle_count; k++) {
      const int32_t n = work->neighbour[k / 3][k % 3];
      double corner[3][2];
      if (!taken[k / 3] || n < 0 || taken[n]) continue;
      for (int i = 0; i < 3; i++) {
        corner[i][0] = stretch * work->uv[work->corner[n][i]][0];
        corner[i][1] = work->uv[work->corner[n][i]][1];
      }
      if (depth_in_circle(corner[0], corner[1], corner[2], place) <= 0) continue;
      taken[n] = 1;
      more = 1;
      count++;
    }
  }
  return count;
}

// A triangulation that is not that of Delaunay in the metric at a new point: the triangles whose circles hold it go,
// and all edges of these are seen from it, for a circle that holds it and is met across an edge has the other two
// beyond.
static void a_metric_may_jump(void **state) {
  uint64_t seed = 5;
  double stretch;
  int32_t most = 0;
  for (int i = 0; i < 300; i++) {
    Plan *plan = polygon_plan(6, 1, 1e-6);
    CwPatchWork work;
    int inserted;
    stretch = 1;
    plan->input.surface = jumping;
    plan->input.surface_context = &stretch;
    open_patch(plan, &work);
    for (int k = 0; k < 20; k++) {
      const double uv[2] = {1.2 * draw(&seed) - 0.6, 1.2 * draw(&seed) - 0.6};
      assert_int_equal(cw_patch_insert(&work, uv, 0, 0.5, INFINITY, &inserted), CW_OK);
      assert_int_equal(inserted, 1);
    }
    const double uv[2] = {draw(&seed) - 0.5, draw(&seed) - 0.5};
    stretch = 30;
    const int32_t held = held_in_circles(&work, uv, cw_patch_find(&work, uv, 0), stretch);
    assert_int_equal(cw_patch_insert(&work, uv, 0, 0, INFINITY, &inserted), CW_OK);
    assert_int_equal(inserted, 1);
    assert_int_equal(work.cavity_count, held);
    assert_int_equal(work.border_count, held + 2);
    check_patch(plan, &work, HEXAGON);
    if (held > most) most = held;
    cw_patch_work_close(&work);
    free(plan);
  }
  assert_true(most >= 8);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(quality_is_one_for_equilateral),
      cmocka_unit_test(quality_goes_by_the_normals_of_all_corners),
      cmocka_unit_test(it_opens_with_what_is_given),
      cmocka_unit_test(places_are_found_up_to_given_edges),
      cmocka_unit_test(the_middle_of_a_polygon_gets_all_its_corners),
      cmocka_unit_test(points_keep_their_distance),
      cmocka_unit_test(points_keep_off_given_edges),
      cmocka_unit_test(insertions_keep_delaunay_on_the_surface),
      cmocka_unit_test(a_metric_may_jump),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
