// SPDX-License-Identifier: AGPL-3.0-or-later
// Grooves in the front of a flat ring of four equal passages: in each the columns of one edge are much lower than those
// beside it, which stand so high that only flat tetrahedra fit between.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "mesher/common/incident.h"
#include "mesher/layers/prism_quality.h"
#include "mesher/skeleton/front_open.h"

enum { PASSAGES = 4, OF_PASSAGE = 16, AROUND = PASSAGES * OF_PASSAGE, RINGS = 10 };
enum { POINTS = AROUND * (RINGS + 1), TRIANGLES = 2 * AROUND * RINGS };
static const double HIGH = 5.5e-3, LOW = 0.5e-3;

typedef struct {
  double x[POINTS][3], front[POINTS][3], height[POINTS], target[POINTS], least[POINTS];
  int32_t triangle[TRIANGLES][3], source[TRIANGLES], next[POINTS], turns[POINTS];
  uint8_t reason[POINTS];
  CwSymmetry symmetry;
  CwSkeleton skeleton;
  CwLayerInput wall;
} Ring;

static int32_t point(int i, int j) {
  return i % AROUND * (RINGS + 1) + j;
}

// Columns on the ray `i` of each passage are low at the rings 5 and 6, and least ones are `least` of the others.
static void make_ring(Ring *ring, int i, double low, double least) {
  int32_t count = 0;
  memset(ring, 0, sizeof *ring);
  for (int a = 0; a < AROUND; a++) {
    double angle = 2 * M_PI * a / AROUND;
    for (int j = 0; j <= RINGS; j++) {
      int32_t v = point(a, j);
      ring->x[v][0] = ring->front[v][0] = (10e-3 + j * 1e-3) * cos(angle);
      ring->x[v][1] = ring->front[v][1] = (10e-3 + j * 1e-3) * sin(angle);
      ring->target[v] = HIGH;
      ring->least[v] = least * HIGH;
      ring->height[v] = a % OF_PASSAGE == i && (j == 5 || j == 6) ? low : HIGH;
      ring->front[v][2] = ring->height[v];
      ring->next[v] = point(a + OF_PASSAGE, j);
      ring->turns[v] = a / OF_PASSAGE;
    }
    for (int j = 0; j < RINGS; j++) {
      const int32_t corner[2][3] = {{point(a, j), point(a + 1, j), point(a + 1, j + 1)},
                                    {point(a, j), point(a + 1, j + 1), point(a, j + 1)}};
      for (int k = 0; k < 2; k++, count++) {
        memcpy(ring->triangle[count], corner[k], sizeof corner[k]);
        ring->source[count] = count % (TRIANGLES / PASSAGES);
      }
    }
  }
  ring->symmetry.count = PASSAGES;
  ring->skeleton = (CwSkeleton){.wall_count = POINTS,
                                .wall_x = ring->x,
                                .wall_triangle_count = TRIANGLES,
                                .wall_triangle = ring->triangle,
                                .wall_source = ring->source,
                                .front = ring->front,
                                .height = ring->height,
                                .reason = ring->reason};
  ring->skeleton.orbits = (CwSkeletonOrbits){
      .symmetry = &ring->symmetry, .node_capacity = POINTS, .node_next = ring->next, .node_turns = ring->turns};
  ring->wall = (CwLayerInput){.point_count = POINTS,
                              .x = (const double(*)[3])ring->x,
                              .triangle_count = TRIANGLES,
                              .triangle = (const int32_t(*)[3])ring->triangle,
                              .target = ring->target,
                              .least = ring->least};
}

static double least_bound(const Ring *ring) {
  CwIncident around;
  double least = 90;
  const int32_t(*triangle)[3] = (const int32_t(*)[3])ring->triangle;
  assert_int_equal(cw_incident_make(POINTS, TRIANGLES, triangle, &around), CW_OK);
  for (int32_t t = 0; t < TRIANGLES; t++) {
    const double(*front)[3] = (const double(*)[3])ring->front;
    least = fmin(least, cw_front_bound(t, triangle, front, around.start, around.triangle, 90));
  }
  cw_incident_free(&around);
  return least;
}

static double least_prism(const Ring *ring) {
  double least = 1;
  for (int32_t t = 0; t < TRIANGLES; t++) {
    const int32_t *v = ring->triangle[t];
    const double *const wall[3] = {ring->x[v[0]], ring->x[v[1]], ring->x[v[2]]};
    const double *const front[3] = {ring->front[v[0]], ring->front[v[1]], ring->front[v[2]]};
    least = fmin(least, cw_prism_quality(wall, front));
  }
  return least;
}

// Inside of the passages, and on their seams.
static void grooves_are_opened(void **state) {
  static Ring ring;
  for (int i = 0; i < OF_PASSAGE; i += 7) {
    int32_t opened;
    make_ring(&ring, i, LOW, 0.5);
    double before = least_bound(&ring);
    assert_true(before < CW_FRONT_NARROW);
    assert_int_equal(cw_front_open(&ring.skeleton, &ring.wall, &opened), CW_OK);
    print_message("  groove on ray %d: %.1f degrees, then %.1f by %d columns; prisms %.2f\n", i, before,
                  least_bound(&ring), opened, least_prism(&ring));
    assert_true(least_bound(&ring) >= CW_FRONT_NARROW);
    assert_true(least_prism(&ring) >= 0.12);
    assert_in_range(opened, 1, 16);
    for (int32_t v = 0; v < POINTS; v++) {
      const double *end = ring.front[v], *next = ring.front[ring.next[v]]; // a quarter of a turn on
      assert_float_equal(next[0], -end[1], 1e-15);
      assert_float_equal(next[1], end[0], 1e-15);
      assert_float_equal(next[2], end[2], 1e-15);
      assert_float_equal(ring.height[v], end[2], 1e-12);
      assert_true(ring.height[v] >= fmin(ring.least[v], LOW));
      if (fabs(ring.height[v] / HIGH - 1) > 0.02 && ring.height[v] != LOW)
        assert_int_equal(ring.reason[v], CW_LAYER_REPAIR);
    }
  }
  (void)state;
}

// Two things leave all as it is: no groove, and one in which something stands.
static void others_stay(void **state) {
  static Ring ring, before;
  for (int cap = 0; cap < 2; cap++) {
    int32_t opened;
    make_ring(&ring, 7, cap ? LOW : HIGH, 1);
    const double angle = 2 * M_PI * 7 / AROUND, *a = ring.x[point(7, 5)];
    double corner[3][3]; // of a plate that stands in the groove
    const int32_t triangle[1][3] = {{0, 1, 2}};
    for (int k = 0; k < 3; k++) {
      double out = 0.3e-3 + 0.2e-3 * k;
      corner[k][0] = a[0] + out * cos(angle);
      corner[k][1] = a[1] + out * sin(angle);
      corner[k][2] = LOW + (k == 1 ? 3e-3 : 0.2e-3);
    }
    ring.wall.obstacle_point_count = 3;
    ring.wall.obstacle_x = (const double(*)[3])corner;
    ring.wall.obstacle_triangle_count = cap;
    ring.wall.obstacle_triangle = triangle;
    before = ring;
    assert_true(cap ? least_bound(&ring) < CW_FRONT_NARROW : least_bound(&ring) > 40);
    assert_int_equal(cw_front_open(&ring.skeleton, &ring.wall, &opened), CW_OK);
    assert_int_equal(opened, 0);
    assert_memory_equal(ring.front, before.front, sizeof ring.front);
    assert_memory_equal(ring.height, before.height, sizeof ring.height);
    assert_memory_equal(ring.reason, before.reason, sizeof ring.reason);
  }
  (void)state;
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(grooves_are_opened), cmocka_unit_test(others_stay)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
