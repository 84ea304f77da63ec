// SPDX-License-Identifier: AGPL-3.0-or-later
// Small patches whose best mesh is known. (Patches of all shapes: test_patch_mesh.)
#include "mesher/surface/patch_improve.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/policy.h"
#include "mesher/surface/patch_delaunay.h"
#include "patch_check.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

// Puts in a point at (x,y) of the sheared plane, if there is room.
static int offer(CwPatchWork *work, double x, double y) {
  double uv[2];
  int inserted, from = 0;
  uv_of_sheared(x, y, uv);
  while (work->corner[from][0] < 0) from++;
  assert_int_equal(cw_patch_insert(work, uv, from, 0, INFINITY, &inserted), CW_OK);
  return inserted;
}

static void put(CwPatchWork *work, double x, double y) {
  assert_int_equal(offer(work, x, y), 1);
}

static double worst_quality(const CwPatchWork *work) {
  double worst = 1;
  for (int32_t t = 0; t < work->triangle_count; t++) {
    const int32_t *c = work->corner[t];
    if (c[0] >= 0) worst = fmin(worst, cw_patch_quality(work, c[0], c[1], c[2]));
  }
  return worst;
}

// The one free point of a hexagon goes into its middle, from wherever; unless it is nearer to it than 0.01 edges.
static void a_point_goes_to_the_middle_of_its_neighbours(void **state) {
  const double off[4] = {0.0099, 0.0101, 0.2, 0.4};
  for (int i = 0; i < 4; i++)
    for (int turn = 0; turn < 6; turn++) {
      Plan *plan = sheared_plan(polygon_plan(6, 1, 1));
      CwPatchWork work;
      open_patch(plan, &work);
      put(&work, off[i] * cos(turn), off[i] * sin(turn));
      assert_int_equal(cw_patch_improve(&work), CW_OK);
      assert_int_equal(check_patch(plan, &work, uv_area_of_sheared(HEXAGON)), 6);
      assert_near(cw_norm(work.x[6]), i == 0 ? off[i] : 0, 1e-12);
      assert_near(work.size[6], 1, 0);
      double x[3];
      sheared(NULL, work.uv[6], x, NULL, NULL);
      assert_near(cw_distance(x, work.x[6]), 0, 0);
      cw_patch_work_close(&work);
      free(plan);
    }
}

// Of two points nearer to one another than wanted one goes, and the other into the middle.
static void a_point_too_many_goes(void **state) {
  for (int turn = 0; turn < 6; turn++) {
    Plan *plan = sheared_plan(polygon_plan(6, 1, 1));
    CwPatchWork work;
    open_patch(plan, &work);
    put(&work, 0, 0);
    put(&work, 0.3 * cos(turn), 0.3 * sin(turn));
    assert_int_equal(cw_patch_improve(&work), CW_OK);
    assert_int_equal(check_patch(plan, &work, uv_area_of_sheared(HEXAGON)), 6);
    assert_int_equal(count_free_points(&work), 1);
    assert_near(worst_quality(&work), 1, 1e-3);
    cw_patch_work_close(&work);
    free(plan);
  }
}

// Diagonals of a square are sqrt(2) edges long, those of a regular pentagon 1.618: from 1.45 on they are divided, and
// the new point goes into the middle.
static void long_edges_are_divided(void **state) {
  for (int corners = 4; corners <= 5; corners++)
    for (int turn = 0; turn < 5; turn++) {
      Plan *plan = polygon_plan(corners, 1, 3);
      const double edge = 2 * sin(M_PI / corners), angle = 2 * M_PI * turn / corners;
      CwPatchWork work;
      for (int k = 0; k < corners; k++) {
        plan->uv[k][0] = cos(2 * M_PI * k / corners + angle);
        plan->uv[k][1] = sin(2 * M_PI * k / corners + angle);
      }
      sheared_plan(plan);
      open_patch(plan, &work);
      assert_int_equal(cw_patch_improve(&work), CW_OK);
      check_patch(plan, &work, uv_area_of_sheared(0.5 * corners * sin(2 * M_PI / corners)));
      assert_int_equal(count_free_points(&work), corners == 5);
      if (corners == 5) assert_near(cw_norm(work.x[5]), 0, 1e-12);
      // The field asks for longer edges: what counts is the length of the given ones and its growth from there.
      if (corners == 5) assert_near(work.size[5], edge + cw_policy.slope, 1e-12);
      cw_patch_work_close(&work);
      free(plan);
    }
}

// A kite in a circle, nearly: corners at 0, 60, 180 and 300 degrees. The circles want it divided across, into triangles
// of the qualities 0.6 and 1; along its axis both have 0.75.
static void poor_triangles_are_flipped(void **state) {
  Plan *plan = new_plan(PLANE, 1);
  CwPatchWork work;
  for (int k = 0; k < 4; k++) {
    static const double angle[4] = {0, M_PI / 3, M_PI, 5 * M_PI / 3};
    const double radius = k == 0 ? 1.001 : 1;
    add_point(plan, radius * cos(angle[k]), radius * sin(angle[k]));
  }
  add_outline(plan);
  sheared_plan(plan);
  open_patch(plan, &work);
  cw_patch_delaunay(&work, 1);
  assert_near(worst_quality(&work), 0.6, 1e-2);
  assert_int_equal(cw_patch_improve(&work), CW_OK);
  assert_int_equal(check_patch(plan, &work, uv_area_of_sheared(0.5 * 2.001 * sqrt(3))), 2);
  assert_near(worst_quality(&work), 0.75, 1e-2);
  cw_patch_work_close(&work);
  free(plan);
}

// A rhombus of equilateral triangles, `n` edges a side; inner points are off by up to `shake` edges.
static Plan *open_lattice(int n, double shake, uint64_t *seed, CwPatchWork *work) {
  Plan *plan = sheared_plan(lattice_plan(PLANE, n, 1, 1, 0.3));
  open_patch(plan, work);
  for (int a = 1; a < n; a++)
    for (int b = 1; b < n; b++) {
      const double x = a + 0.5 * b + shake * (2 * draw(seed) - 1), y = sqrt(0.75) * b + shake * (2 * draw(seed) - 1);
      put(work, x * cos(0.3) - y * sin(0.3), x * sin(0.3) + y * cos(0.3));
    }
  return plan;
}

// What is equilateral stays to the last bit.
static void a_lattice_is_left_as_it_is(void **state) {
  enum { N = 7 };
  uint64_t seed = 1;
  double before[4 * N + (N - 1) * (N - 1)][2];
  CwPatchWork work;
  Plan *plan = open_lattice(N, 0, &seed, &work);
  memcpy(before, work.uv, sizeof before);
  assert_int_equal(cw_patch_improve(&work), CW_OK);
  assert_int_equal(work.point_count, 4 * N + (N - 1) * (N - 1));
  assert_memory_equal(work.uv, before, sizeof before);
  assert_int_equal(check_patch(plan, &work, uv_area_of_sheared(N * N * sqrt(0.75))), 2 * N * N);
  assert_near(worst_quality(&work), 1, 1e-9);
  cw_patch_work_close(&work);
  free(plan);
}

// Free points with another number of neighbours than six.
static int count_odd(const CwPatchWork *work) {
  int odd = 0;
  for (int32_t p = work->given_count; p < work->point_count; p++) {
    int32_t triangle[CW_PATCH_RING], ring[CW_PATCH_RING];
    if (work->point_triangle[p] >= 0) odd += cw_patch_ring(work, p, triangle, ring) != 6;
  }
  return odd;
}

// Points that were shaken by a fifth of an edge come to stand in the lattice again.
static void shaken_points_become_a_lattice(void **state) {
  enum { N = 7 };
  uint64_t seed = 17;
  for (int round = 0; round < 30; round++) {
    CwPatchWork work;
    Plan *plan = open_lattice(N, 0.2, &seed, &work);
    assert_true(worst_quality(&work) < 0.9);
    assert_int_equal(cw_patch_improve(&work), CW_OK);
    assert_int_equal(check_patch(plan, &work, uv_area_of_sheared(N * N * sqrt(0.75))), 2 * N * N);
    assert_int_equal(count_odd(&work), 0);
    assert_true(worst_quality(&work) > 0.998);
    cw_patch_work_close(&work);
    free(plan);
  }
}

// A diagonal of the lattice is drawn apart to 1.4 edges, and the points across it, else sqrt(3) apart, together
// to 1.33: that turns it, for the circles, and leaves two points with five neighbours and two with seven. It is turned
// back.
static void neighbours_are_evened_out(void **state) {
  enum { N = 8 };
  for (int direction = 0; direction < 3; direction++) {
    Plan *plan = sheared_plan(lattice_plan(PLANE, N, 1, 1, 0));
    const double middle[2] = {N / 2 + 0.5 * N / 2, sqrt(0.75) * N / 2};
    const double along[2] = {cos(M_PI / 3 * direction), sin(M_PI / 3 * direction)};
    CwPatchWork work;
    open_patch(plan, &work);
    for (int a = 1; a < N; a++)
      for (int b = 1; b < N; b++) {
        double x = a + 0.5 * b, y = sqrt(0.75) * b;
        const double p = (x - middle[0]) * along[0] + (y - middle[1]) * along[1] - 0.5; // from the edge's middle
        const double q = (y - middle[1]) * along[0] - (x - middle[0]) * along[1];
        const int end = fabs(q) < 0.1 && fabs(p) < 0.6, across = fabs(p) < 0.1 && fabs(q) < 0.9;
        const double out = end ? 0.2 * p / fabs(p) : 0, in = across ? -0.2 * q / fabs(q) : 0;
        x += out * along[0] - in * along[1];
        y += out * along[1] + in * along[0];
        put(&work, x, y);
      }
    assert_int_equal(count_odd(&work), 4);
    assert_int_equal(cw_patch_improve(&work), CW_OK);
    assert_int_equal(check_patch(plan, &work, uv_area_of_sheared(N * N * sqrt(0.75))), 2 * N * N);
    assert_int_equal(count_odd(&work), 0);
    assert_true(worst_quality(&work) > 0.99);
    cw_patch_work_close(&work);
    free(plan);
  }
}

enum { HEXAGON_CORNERS = 6 };

// The worst quality of the triangles between a point at x and the edges of a hexagon. Nearer to one of these than half
// of its wanted length a point counts no more than its distance over that: 1, or what grows from the corners.
static double worst_about(const CwPatchWork *work, const double x[3]) {
  double up[3], worst = 1, size = 1;
  cw_cross(XU, XV, up);
  for (int k = 0; k < HEXAGON_CORNERS; k++)
    size = fmin(size, work->size[k] + cw_policy.slope * cw_distance(work->x[k], x));
  for (int k = 0; k < HEXAGON_CORNERS; k++) {
    const double *a = work->x[k], *b = work->x[(k + 1) % HEXAGON_CORNERS];
    double n[3];
    cw_normal(x, a, b, n);
    worst = fmin(worst, cw_patch_quality_at(x, a, b, up));
    const double away = cw_norm(n) / cw_distance(a, b) / size;
    if (away < cw_policy.boundary_distance) worst = fmin(worst, away);
  }
  return worst;
}

// The best of these for any place in the plane, by trying them all.
static double best_worst(const CwPatchWork *work) {
  double best = -1, uv[2], x[3];
  for (int i = -50; i <= 50; i++)
    for (int j = -50; j <= 50; j++) {
      uv_of_sheared(0.02 * i, 0.02 * j, uv);
      sheared(NULL, uv, x, NULL, NULL);
      best = fmax(best, worst_about(work, x));
    }
  return best;
}

// A random hexagon that is not regular: corners between 0.5 and 1.6 from the origin, and nearer to it across.
static Plan *odd_hexagon(uint64_t *seed, double *area) {
  const double middle[2] = {0, 0};
  Plan *plan = polygon_plan(HEXAGON_CORNERS, 1, 1);
  const double flat = 0.5 + 0.5 * draw(seed);
  *area = 0;
  for (int k = 0; k < HEXAGON_CORNERS; k++) {
    const double radius = 0.5 + 1.1 * draw(seed);
    plan->uv[k][0] *= radius;
    plan->uv[k][1] *= radius * flat;
  }
  for (int k = 0; k < HEXAGON_CORNERS; k++)
    *area += 0.5 * cw_twice_area(middle, plan->uv[k], plan->uv[(k + 1) % HEXAGON_CORNERS]);
  return sheared_plan(plan);
}

// Where the middle of the corners gives a triangle below 0.8, the point climbs up to there, or to where its worst
// triangle is as good as anywhere: but for what the last step, 0.025 edges, leaves.
static void a_poor_point_climbs(void **state) {
  uint64_t seed = 41;
  int climbs = 0;
  for (int round = 0; round < 300; round++) {
    int32_t triangle[CW_PATCH_RING], ring[CW_PATCH_RING];
    double area, middle[3] = {0};
    CwPatchWork work;
    Plan *plan = odd_hexagon(&seed, &area);
    open_patch(plan, &work);
    offer(&work, 0, 0);
    assert_int_equal(cw_patch_improve(&work), CW_OK);
    check_patch(plan, &work, uv_area_of_sheared(area));
    for (int k = 0; k < 3 * HEXAGON_CORNERS; k++) middle[k % 3] += work.x[k / 3][k % 3] / HEXAGON_CORNERS;
    if (count_free_points(&work) == 1 && work.point_count == 7 && work.point_triangle[HEXAGON_CORNERS] >= 0 &&
        cw_patch_ring(&work, HEXAGON_CORNERS, triangle, ring) == HEXAGON_CORNERS) {
      const double wanted = fmin(0.8, best_worst(&work)) - 0.03;
      assert_true(worst_about(&work, work.x[HEXAGON_CORNERS]) >= wanted);
      climbs += worst_about(&work, middle) < wanted;
    }
    cw_patch_work_close(&work);
    free(plan);
  }
  assert_true(climbs > 10);
}

// The middle of the corners of this pentagon is 0.46 from its base: there no point goes that stands farther off, where
// half of the wanted length, 1, can be kept.
static void points_keep_off_given_edges(void **state) {
  static const double corner[5][2] = {{-0.55, 0}, {0.55, 0}, {1.1, 0.35}, {0, 1.6}, {-1.1, 0.35}};
  Plan *plan = new_plan(PLANE, 1);
  CwPatchWork work;
  double area = 0, second[3], first[3];
  for (int p = 0; p < 5; p++) add_point(plan, corner[p][0], corner[p][1]);
  for (int p = 0; p < 5; p++) {
    add_edge(plan, p, (p + 1) % 5, 1);
    area += 0.5 * cw_twice_area(corner[0], corner[p], corner[(p + 1) % 5]);
  }
  sheared_plan(plan);
  open_patch(plan, &work);
  put(&work, 0, 0.6);
  assert_int_equal(cw_patch_improve(&work), CW_OK);
  assert_int_equal(check_patch(plan, &work, uv_area_of_sheared(area)), 5);
  axes_of_sheared(first, second);
  assert_true(cw_dot(work.x[5], second) >= 0.5);
  assert_true(worst_quality(&work) > 0.7);
  cw_patch_work_close(&work);
  free(plan);
}

// Inner points of a lattice want 0.72 edges. Of triangles that large corners may want up to 0.9 of `largest`, and
// triangles of edges of 1 are larger than allowed from there down: so those with three free corners are halved for 0.9,
// and nothing is for 0.79 and for 1.01.
static void large_triangles_are_halved(void **state) {
  enum { N = 6 };
  static const double largest[4] = {0, 0.79, 0.9, 1.01};
  for (int i = 0; i < 4; i++) {
    Plan *plan = sheared_plan(lattice_plan(PLANE, N, 1, 1, 0));
    CwPatchWork work;
    plan->size = 0.72;
    plan->input.largest = largest[i];
    open_patch(plan, &work);
    for (int k = 0; k < (N - 1) * (N - 1); k++) {
      const int a = 1 + k / (N - 1), b = 1 + k % (N - 1);
      put(&work, a + 0.5 * b, sqrt(0.75) * b);
    }
    const int32_t before = work.point_count;
    assert_int_equal(cw_patch_improve(&work), CW_OK);
    check_patch(plan, &work, uv_area_of_sheared(N * N * sqrt(0.75)));
    // Each new point halves two triangles; 2 (N - 2)^2 are to be halved.
    if (i == 2) assert_in_range(work.point_count, before + (N - 2) * (N - 2), before + 2 * (N - 2) * (N - 2));
    if (i != 2) assert_int_equal(work.point_count, before);
    for (int32_t t = 0; i == 2 && t < work.triangle_count; t++) {
      const int32_t *c = work.corner[t];
      double n[3];
      cw_normal(work.x[c[0]], work.x[c[1]], work.x[c[2]], n);
      if ((work.size[c[0]] + work.size[c[1]] + work.size[c[2]]) / 3 < 0.81)
        assert_true(cw_norm(n) < sqrt(0.75) * 0.9 * 0.9);
    }
    cw_patch_work_close(&work);
    free(plan);
  }
}

// A quarter of a cylinder, cut across in two edges that bend aside by 0.06: the triangle of both lies within 60 degrees
// of the surface and its angles are those of Delaunay, but it lies in the cut. It is flipped away.
static void no_triangle_lies_in_a_cut(void **state) {
  const double corner[6][2] = {{0, -0.15}, {M_PI / 2, -0.15}, {M_PI / 2, 0}, {M_PI / 2, 0.25}, {0, 0.25}, {0, 0}};
  for (int is_cut = 0; is_cut < 2; is_cut++) {
    Plan *plan = new_plan(CYLINDER, 0.3);
    CwPatchWork work;
    int in_cut = 0;
    for (int p = 0; p < 6; p++) add_point(plan, corner[p][0], corner[p][1]);
    add_outline(plan);
    add_point(plan, M_PI / 4, 0.06);
    add_edge(plan, 5, 6, 0);
    add_edge(plan, 6, 2, 0);
    open_patch(plan, &work);
    const int32_t cut[3] = {5, 2, 6};
    assert_true(cosine_on_cylinder(&work, cut) > 0.5);
    if (is_cut) assert_int_equal(cw_patch_improve(&work), CW_OK);
    if (!is_cut) cw_patch_delaunay(&work, 1);
    check_patch(plan, &work, M_PI / 2 * 0.4);
    for (int32_t t = 0; t < work.triangle_count; t++) {
      const int32_t *c = work.corner[t];
      int on_cut = 0;
      for (int k = 0; k < 9; k++) on_cut += c[k / 3] == cut[k % 3];
      in_cut += on_cut == 3;
    }
    assert_int_equal(in_cut, !is_cut);
    assert_int_equal(work.point_count, 7);
    cw_patch_work_close(&work);
    free(plan);
  }
}

// Points stay on a surface that bends and shears, and what is kept of it is that of their places.
static void points_stay_on_the_surface(void **state) {
  uint64_t seed = 7;
  Plan *plan = new_plan(FUNNEL, 0.15);
  CwPatchWork work;
  int inserted;
  plan->slope = 0.2;
  add_rectangle(plan, 0, 0.3, 2, 1);
  open_patch(plan, &work);
  for (int k = 0; k < 60; k++) {
    const double uv[2] = {2 * draw(&seed), 0.3 + 0.7 * draw(&seed)};
    int from = 0;
    while (work.corner[from][0] < 0) from++;
    assert_int_equal(cw_patch_insert(&work, uv, from, 0.7, INFINITY, &inserted), CW_OK);
  }
  assert_int_equal(cw_patch_improve(&work), CW_OK);
  check_patch(plan, &work, 1.4);
  assert_true(count_free_points(&work) > 10);
  for (int32_t p = work.given_count; p < work.point_count; p++) {
    double x[3], xu[3], xv[3];
    if (work.point_triangle[p] < 0) continue;
    surface_at(plan, work.uv[p], x, xu, xv);
    assert_memory_equal(work.x[p], x, sizeof x);
    assert_memory_equal(work.xu[p], xu, sizeof xu);
    assert_memory_equal(work.xv[p], xv, sizeof xv);
    assert_near(work.metric[p][0], cw_dot(xu, xu), 0);
    assert_near(work.metric[p][1], cw_dot(xu, xv), 0);
    assert_near(work.metric[p][2], cw_dot(xv, xv), 0);
    assert_true(work.size[p] <= size_at(plan, x));
  }
  cw_patch_work_close(&work);
  free(plan);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_point_goes_to_the_middle_of_its_neighbours),
      cmocka_unit_test(a_point_too_many_goes),
      cmocka_unit_test(long_edges_are_divided),
      cmocka_unit_test(poor_triangles_are_flipped),
      cmocka_unit_test(a_lattice_is_left_as_it_is),
      cmocka_unit_test(shaken_points_become_a_lattice),
      cmocka_unit_test(neighbours_are_evened_out),
      cmocka_unit_test(a_poor_point_climbs),
      cmocka_unit_test(points_keep_off_given_edges),
      cmocka_unit_test(large_triangles_are_halved),
      cmocka_unit_test(no_triangle_lies_in_a_cut),
      cmocka_unit_test(points_stay_on_the_surface),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
