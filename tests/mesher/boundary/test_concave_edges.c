// SPDX-License-Identifier: AGPL-3.0-or-later
// Narrow concave edges in the layer top of a flat ring of four equal passages: in each the columns of one edge are much
// lower than those beside it, which stand so high that only flat tetrahedra fit between.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "flat_ring.h"
#include "mesher/boundary/concave_edges.h"
#include "mesher/common/incident.h"
#include "mesher/common/triangle_bound.h"
#include "mesher/layers/prism_quality.h"
#include "mesher/policy.h"
#include "tests/unit_test.h"

static const double HIGH = 5.5e-3, LOW = 0.5e-3;

typedef struct {
  FlatRing flat;
  double top[POINTS][3], thickness[POINTS], target[POINTS], least[POINTS];
  uint8_t reason[POINTS];
  CwPeriodicImages images;
  CwSurfaceMesh surface;
  CwLayers layers;
  CwLayerInput wall;
} Ring;

// Columns on the ray `i` of each passage are low at the rings 5 and 6, and least ones are `least` of the others.
static void make_ring(Ring *ring, int i, double low, double least) {
  FlatRing *flat = &ring->flat;
  memset(ring, 0, sizeof *ring);
  flat_ring(flat);
  memcpy(ring->top, flat->x, sizeof ring->top);
  for (int32_t v = 0; v < POINTS; v++) {
    ring->target[v] = ring->thickness[v] = HIGH;
    ring->least[v] = least * HIGH;
  }
  for (int k = 0; k < PASSAGES; k++)
    for (int j = 5; j <= 6; j++) ring->thickness[ring_point(k * OF_PASSAGE + i, j)] = low;
  for (int32_t v = 0; v < POINTS; v++) ring->top[v][2] = ring->thickness[v];
  ring->images = (CwPeriodicImages){.symmetry = &flat->symmetry};
  ring->surface = (CwSurfaceMesh){.vertex_count = POINTS,
                                  .x = flat->x,
                                  .triangle_count = TRIANGLES,
                                  .triangle = flat->triangle,
                                  .source = flat->source,
                                  .images = ring_images(flat)};
  ring->layers =
      (CwLayers){.column_count = POINTS, .top = ring->top, .thickness = ring->thickness, .reason = ring->reason};
  ring->wall = (CwLayerInput){.point_count = POINTS,
                              .x = (const double(*)[3])flat->x,
                              .triangle_count = TRIANGLES,
                              .triangle = (const int32_t(*)[3])flat->triangle,
                              .target = ring->target,
                              .least = ring->least};
}

static double least_bound(const Ring *ring) {
  CwIncident around;
  double least = 90;
  const int32_t(*triangle)[3] = (const int32_t(*)[3])ring->flat.triangle;
  assert_int_equal(cw_incident_make(POINTS, TRIANGLES, triangle, &around), CW_OK);
  const CwBoundSurface top = {triangle, (const double(*)[3])ring->top, around.start, around.triangle};
  for (int32_t t = 0; t < TRIANGLES; t++) least = fmin(least, cw_bound_on(&top, t, 90));
  cw_incident_free(&around);
  return least;
}

static double least_prism(const Ring *ring) {
  double least = 1;
  for (int32_t t = 0; t < TRIANGLES; t++) {
    const int32_t *v = ring->flat.triangle[t];
    const double *const wall[3] = {ring->flat.x[v[0]], ring->flat.x[v[1]], ring->flat.x[v[2]]};
    const double *const top[3] = {ring->top[v[0]], ring->top[v[1]], ring->top[v[2]]};
    least = fmin(least, cw_prism_quality(wall, top));
  }
  return least;
}

// Inside of the passages, and on their seams.
static void concave_edges_are_opened(void **state) {
  static Ring ring;
  for (int i = 0; i < OF_PASSAGE; i += 7) {
    int32_t opened;
    make_ring(&ring, i, LOW, 0.5);
    double before = least_bound(&ring);
    assert_true(before < cw_policy.wanted_angle);
    assert_int_equal(cw_open_concave_edges(&ring.images, &ring.surface, &ring.wall, &ring.layers, &opened), CW_OK);
    print_message("  narrow concave edge on ray %d: %.1f degrees, then %.1f by %d columns; prisms %.2f\n", i, before,
                  least_bound(&ring), opened, least_prism(&ring));
    assert_true(least_bound(&ring) >= cw_policy.wanted_angle);
    assert_true(least_prism(&ring) >= 0.12);
    assert_in_range(opened, 1, 16);
    for (int32_t v = 0; v < POINTS; v++) {
      const double *end = ring.top[v], *next = ring.top[ring.flat.next[v]]; // a quarter of a turn on
      assert_near(next[0], -end[1], 1e-15);
      assert_near(next[1], end[0], 1e-15);
      assert_near(next[2], end[2], 1e-15);
      assert_near(ring.thickness[v], end[2], 1e-12);
      assert_true(ring.thickness[v] >= fmin(ring.least[v], LOW));
      if (fabs(ring.thickness[v] / HIGH - 1) > 0.02 && ring.thickness[v] != LOW)
        assert_int_equal(ring.reason[v], CW_LAYER_REPAIR);
    }
  }
}

// Columns on a seam are judged with their periodic images: as in a ring of one passage, whose columns about the ray 0
// are tried in the same order, though in directions that do not turn with the images: alike to 1 % of their height.
static void seams_do_not_matter(void **state) {
  static Ring ring, whole;
  int32_t opened;
  make_ring(&ring, 0, LOW, 0.5);
  make_ring(&whole, 0, LOW, 0.5);
  whole.flat.symmetry.count = 1;
  for (int32_t v = 0; v < POINTS; v++) whole.flat.next[v] = v, whole.flat.turns[v] = 0;
  for (int32_t t = 0; t < TRIANGLES; t++) whole.flat.source[t] = t;
  assert_int_equal(cw_open_concave_edges(&ring.images, &ring.surface, &ring.wall, &ring.layers, &opened), CW_OK);
  assert_int_equal(cw_open_concave_edges(&whole.images, &whole.surface, &whole.wall, &whole.layers, &opened), CW_OK);
  assert_true(opened > 0);
  for (int i = -4; i <= 4; i++)
    for (int j = 0; j <= RINGS; j++)
      for (int k = 0; k < 3; k++) {
        int32_t v = ring_point(AROUND + i, j);
        assert_near(ring.top[v][k], whole.top[v][k], 0.01 * HIGH);
      }
}

// Two things leave all as it is: no narrow concave edge, and one in which something stands.
static void others_stay(void **state) {
  static Ring ring, before;
  for (int open_patch = 0; open_patch < 2; open_patch++) {
    int32_t opened;
    make_ring(&ring, 7, open_patch ? LOW : HIGH, 1);
    const double angle = 2 * M_PI * 7 / AROUND, *a = ring.flat.x[ring_point(7, 5)];
    double corner[3][3]; // of a plate that stands in the narrow concave edge
    const int32_t triangle[1][3] = {{0, 1, 2}};
    for (int k = 0; k < 3; k++) {
      double out = 0.3e-3 + 0.2e-3 * k;
      corner[k][0] = a[0] + out * cos(angle);
      corner[k][1] = a[1] + out * sin(angle);
      corner[k][2] = LOW + (k == 1 ? 3e-3 : 0.2e-3);
    }
    ring.wall.obstacle_point_count = 3;
    ring.wall.obstacle_x = (const double(*)[3])corner;
    ring.wall.obstacle_triangle_count = open_patch;
    ring.wall.obstacle_triangle = triangle;
    before = ring;
    assert_true(open_patch ? least_bound(&ring) < cw_policy.wanted_angle : least_bound(&ring) > 40);
    assert_int_equal(cw_open_concave_edges(&ring.images, &ring.surface, &ring.wall, &ring.layers, &opened), CW_OK);
    assert_int_equal(opened, 0);
    assert_memory_equal(ring.top, before.top, sizeof ring.top);
    assert_memory_equal(ring.thickness, before.thickness, sizeof ring.thickness);
    assert_memory_equal(ring.reason, before.reason, sizeof ring.reason);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(concave_edges_are_opened), cmocka_unit_test(seams_do_not_matter),
                                     cmocka_unit_test(others_stay)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
