// SPDX-License-Identifier: AGPL-3.0-or-later
// What the sources of the smoothing reach: a row by hand, and Dijkstra's algorithm over a whole wall at once.
#include "hexagon.h"
#include "mesher/common/vec.h"
#include "mesher/layers/direction_smoothing_work.h"
#include "mesher/layers/layers_topology.h"
#include "mesher/policy.h"
#include "surfaces.h"
#include "tests/draw.h"

typedef struct {
  Surface wall;
  CwLayerInput in;
  CwLayerWork work;
  CwSmoothing smoothing;
} Reach;

// `sources` vertices of the wall at random, each of a thickness between `thin` and `thick`; the blocks follow x, or
// nothing.
static void begin(Reach *r, int sources, double thin, double thick, int shuffled, uint64_t *seed) {
  int32_t n = r->wall.point_count;
  double *target = malloc((size_t)n * sizeof *target);
  for (int32_t v = 0; v < n; v++) target[v] = 1;
  r->in = (CwLayerInput){.point_count = n,
                         .x = (const double(*)[3])r->wall.x,
                         .triangle_count = r->wall.triangle_count,
                         .triangle = (const int32_t(*)[3])r->wall.triangle,
                         .target = target};
  assert_int_equal(cw_layers_topology(&r->in, &r->work), CW_OK);
  r->work.curve = malloc((size_t)n * sizeof *r->work.curve);
  for (int32_t v = 0; v < n; v++) r->work.curve[v] = v;
  for (int32_t v = n - 1; v > 0 && shuffled; v--) {
    int32_t other = draw_below(seed, v + 1), kept = r->work.curve[v];
    r->work.curve[v] = r->work.curve[other];
    r->work.curve[other] = kept;
  }
  r->smoothing.work = &r->work;
  r->smoothing.source = calloc((size_t)sources, sizeof *r->smoothing.source);
  r->smoothing.reach = calloc((size_t)n, sizeof *r->smoothing.reach);
  for (int32_t v = 0; v < n && r->smoothing.source_count < sources; v++) { // as many as wanted of those that are left
    if (draw(seed) * (n - v) >= sources - r->smoothing.source_count) continue;
    r->smoothing.source[r->smoothing.source_count++] =
        (CwSmoothingSource){.vertex = v, .thickness = thin + (thick - thin) * draw(seed)};
  }
}

static void end(Reach *r) {
  free((void *)r->in.target);
  free(r->smoothing.source);
  free(r->smoothing.reach);
  cw_layers_work_free(&r->work);
  surface_free(&r->wall);
}

// The least of those that are open settles; from it the wave goes on as far as its source's thickness allows.
static void dijkstra(const Reach *r, CwSmoothingReach *wanted) {
  const CwLayerWork *work = &r->work;
  uint8_t *settled = calloc((size_t)work->n, 1);
  for (int32_t v = 0; v < work->n; v++) wanted[v] = (CwSmoothingReach){INFINITY, -1};
  for (int32_t i = 0; i < r->smoothing.source_count; i++)
    wanted[r->smoothing.source[i].vertex] = (CwSmoothingReach){0, i};
  for (;;) {
    int32_t v = -1;
    for (int32_t w = 0; w < work->n; w++) {
      if (!settled[w] && wanted[w].source >= 0 && (v < 0 || wanted[w].distance < wanted[v].distance)) v = w;
    }
    if (v < 0) break;
    settled[v] = 1;
    double most = 6 * r->smoothing.source[wanted[v].source].thickness; // cw_policy.smoothing_reach
    for (int32_t k = work->near_start[v]; k < work->near_start[v + 1]; k++) {
      int32_t w = work->near[k];
      double way = wanted[v].distance + cw_distance(work->in->x[v], work->in->x[w]);
      if (way <= most && way < wanted[w].distance) wanted[w] = (CwSmoothingReach){way, wanted[v].source};
    }
  }
  free(settled);
}

static void bumpy(const void *context, double u, double v, double x[3]) {
  uint64_t *seed = (uint64_t *)context;
  x[0] = 60 * u + 0.6 * draw(seed);
  x[1] = 80 * v + 0.6 * draw(seed);
  x[2] = 4 * sin(6 * u) * cos(5 * v) + 0.5 * draw(seed);
}

// Blocks of the wall find bit for bit what is found on the whole.
static void blocks_find_what_the_whole_finds(void **state) {
  assert_near(cw_policy.smoothing_reach, 6, 0);
  for (int i = 0; i < 6; i++) {
    uint64_t seed = 7 + i;
    Reach r = {0};
    surface_grid(&r.wall, bumpy, &seed, 60, 80, 1);
    begin(&r, i < 2 ? 1 : i < 4 ? 12 : 300, i % 2 ? 0.2 : 0.8, i % 2 ? 2.5 : 0.9, i == 3 || i == 5, &seed);
    int32_t n = r.work.n, reached = 0, out = 0;
    assert_true(n > 2 * 2048); // three blocks
    CwSmoothingReach *wanted = malloc((size_t)n * sizeof *wanted);
    dijkstra(&r, wanted);
    assert_int_equal(cw_smoothing_find_reach(&r.smoothing), CW_OK);
    for (int32_t v = 0; v < n; v++) {
      assert_int_equal(r.smoothing.reach[v].source, wanted[v].source);
      if (wanted[v].source < 0) assert_true(isinf(r.smoothing.reach[v].distance));
      if (wanted[v].source >= 0) assert_near(r.smoothing.reach[v].distance, wanted[v].distance, 0);
      wanted[v].source < 0 ? out++ : reached++;
    }
    assert_true(reached > r.smoothing.source_count && (out > 0 || i > 3));
    free(wanted);
    end(&r);
  }
}

// The hexagon's centre is 2 from all its corners, and these are 2 from one another: a source at corner 1 comes to the
// two corners beside it and the centre after 2, to the others after 4, each time where it is thick enough for the way.
static void a_hexagon_by_hand(void **state) {
  const double thickness[4] = {0.33, 0.34, 0.66, 0.67}, way[7] = {2, 0, 2, 4, 4, 4, 2};
  for (int i = 0; i < 4; i++) {
    Hexagon wall;
    CwLayerWork work = {0};
    CwSmoothingSource source = {.vertex = 1, .thickness = thickness[i]};
    CwSmoothingReach reach[7];
    CwSmoothing smoothing = {.work = &work, .source_count = 1, .source = &source, .reach = reach};
    hexagon_make(&wall);
    assert_int_equal(cw_layers_topology(&wall.in, &work), CW_OK);
    work.curve = malloc(7 * sizeof *work.curve);
    for (int v = 0; v < 7; v++) work.curve[v] = 6 - v;
    assert_int_equal(cw_smoothing_find_reach(&smoothing), CW_OK);
    for (int v = 0; v < 7; v++) {
      int within = way[v] <= 6 * thickness[i];
      assert_int_equal(reach[v].source, within ? 0 : -1);
      if (within) assert_near(reach[v].distance, way[v], 1e-14);
    }
    cw_layers_work_free(&work);
  }
}

// A place belongs to the wave that comes first, even where that ends there and another would go on: three sources in a
// row of points 1 apart, of which the middle one is too thin to go far.
static void the_first_wave_holds_its_place(void **state) {
  Reach r = {0};
  uint64_t seed = 1;
  for (int i = 0; i <= 12; i++) { // two rows, the second one far off
    surface_point(&r.wall, (const double[3]){i, 0, 0});
    surface_point(&r.wall, (const double[3]){i, 100, 0});
  }
  for (int i = 0; i < 12; i++) {
    surface_triangle(&r.wall, 2 * i, 2 * i + 1, 2 * i + 2);
    surface_triangle(&r.wall, 2 * i + 1, 2 * i + 3, 2 * i + 2);
  }
  begin(&r, 2, 1, 1, 0, &seed);
  r.smoothing.source[0] = (CwSmoothingSource){.vertex = 0, .thickness = 1.5};  // goes 9
  r.smoothing.source[1] = (CwSmoothingSource){.vertex = 8, .thickness = 0.35}; // at x = 4, goes 2.1
  assert_int_equal(cw_smoothing_find_reach(&r.smoothing), CW_OK);
  const int source[13] = {0, 0, 0, 1, 1, 1, 1, -1, -1, -1, -1, -1, -1}, way[13] = {0, 1, 2, 1, 0, 1, 2};
  for (int i = 0; i <= 12; i++) {
    if (i == 2) { // 2 from both: which of them, the order says
      assert_near(r.smoothing.reach[4].distance, 2, 0);
      continue;
    }
    assert_int_equal(r.smoothing.reach[2 * i].source, source[i]);
    if (source[i] >= 0) assert_near(r.smoothing.reach[2 * i].distance, way[i], 0);
    assert_int_equal(r.smoothing.reach[2 * i + 1].source, -1);
  }
  end(&r);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(blocks_find_what_the_whole_finds),
      cmocka_unit_test(a_hexagon_by_hand),
      cmocka_unit_test(the_first_wave_holds_its_place),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
