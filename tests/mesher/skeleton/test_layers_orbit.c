// SPDX-License-Identifier: AGPL-3.0-or-later
// Layers on a flat ring of four equal passages: they are grown over the first and turned.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "mesher/skeleton/orbit_skeleton.h"

enum { PASSAGES = 4, OF_PASSAGE = 16, AROUND = PASSAGES * OF_PASSAGE, RINGS = 10 };
enum { POINTS = AROUND * (RINGS + 1), TRIANGLES = 2 * AROUND * RINGS };
static const double HEIGHT = 0.6e-3;

static int32_t point(int i, int j) {
  return i % AROUND * (RINGS + 1) + j;
}

static void leave(const void *context, int32_t v, double x[3]) {
  (void)context, (void)v, (void)x;
}

// In the middle of the first seam the column of one member stands on a line that leans, that of the other is free.
static void seams_get_the_sounder_column(void **state) {
  static double x[POINTS][3], target[POINTS], guide[POINTS][2][3];
  static int32_t triangle[TRIANGLES][3], source[TRIANGLES], next[POINTS], turns[POINTS], guides[POINTS];
  static uint8_t stays[POINTS];
  const int32_t middle = RINGS / 2;
  for (int leaning = 0; leaning < 2; leaning++) { // which member
    int32_t count = 0;
    memset(guides, 0, sizeof guides);
    for (int i = 0; i < AROUND; i++) {
      double angle = 2 * M_PI * i / AROUND;
      for (int j = 0; j <= RINGS; j++) {
        int32_t v = point(i, j);
        x[v][0] = (10e-3 + j * 1e-3) * cos(angle);
        x[v][1] = (10e-3 + j * 1e-3) * sin(angle);
        target[v] = HEIGHT;
        next[v] = point(i + OF_PASSAGE, j);
        turns[v] = i / OF_PASSAGE;
      }
      for (int j = 0; j < RINGS; j++) {
        const int32_t corner[2][3] = {{point(i, j), point(i + 1, j), point(i + 1, j + 1)},
                                      {point(i, j), point(i + 1, j + 1), point(i, j + 1)}};
        for (int k = 0; k < 2; k++, count++) {
          memcpy(triangle[count], corner[k], sizeof *triangle);
          source[count] = count % (TRIANGLES / PASSAGES);
        }
      }
    }
    int32_t held = point(leaning * OF_PASSAGE, middle);
    double out[2] = {x[held][0] / hypot(x[held][0], x[held][1]), x[held][1] / hypot(x[held][0], x[held][1])};
    const double across[2][3] = {{-out[1], out[0], 0}, {0.6 * out[0], 0.6 * out[1], -0.8}};
    memcpy(guide[held], across, sizeof across);
    guides[held] = 2;
    CwSymmetry symmetry = {.count = PASSAGES};
    CwSkeleton skeleton = {.wall_source = source};
    skeleton.orbits =
        (CwSkeletonOrbits){.symmetry = &symmetry, .node_capacity = POINTS, .node_next = next, .node_turns = turns};
    CwLayerInput in = {.point_count = POINTS,
                       .x = x,
                       .triangle_count = TRIANGLES,
                       .triangle = triangle,
                       .target = target,
                       .guide_count = guides,
                       .guide_normal = guide,
                       .guide_stays = stays,
                       .snap = leave};
    CwLayers layers;
    assert_int_equal(cw_orbit_layers(&skeleton, &in, &layers), CW_OK);
    for (int k = 0; k < PASSAGES; k++) {
      int32_t v = point(k * OF_PASSAGE, middle);
      const double *end = layers.front[v];
      print_message("  member %d leaning: copy %d ends %.3f mm aside, %.3f mm high\n", leaning, k,
                    1e3 * hypot(end[0] - x[v][0], end[1] - x[v][1]), 1e3 * fabs(end[2]));
      assert_true(hypot(end[0] - x[v][0], end[1] - x[v][1]) < 0.1 * HEIGHT);
      assert_true(fabs(fabs(end[2]) - HEIGHT) < 0.01 * HEIGHT);
    }
    cw_layers_free(&layers);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(seams_get_the_sounder_column)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
