// SPDX-License-Identifier: AGPL-3.0-or-later
// Layers on a flat ring of four equal passages: they are grown over the first and turned.
// Modules without a test of their own that it runs: periodic_boundary.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "flat_ring.h"
#include "mesher/boundary/periodic_boundary.h"

static const double HEIGHT = 0.6e-3;

static void leave(const void *context, int32_t v, double x[3]) {
  (void)context, (void)v, (void)x;
}

// In the middle of the first seam the column of one member stands on a line that leans, that of the other is free.
static void seams_get_the_sounder_column(void **state) {
  static FlatRing ring;
  static double target[POINTS], constraint[POINTS][2][3];
  static int32_t constraints[POINTS];
  static uint8_t stays[POINTS];
  const int32_t middle = RINGS / 2;
  flat_ring(&ring);
  const double(*x)[3] = (const double(*)[3])ring.x;
  for (int32_t v = 0; v < POINTS; v++) target[v] = HEIGHT;
  for (int leaning = 0; leaning < 2; leaning++) { // which member
    memset(constraints, 0, sizeof constraints);
    int32_t held = ring_point(leaning * OF_PASSAGE, middle);
    double out[2] = {x[held][0] / hypot(x[held][0], x[held][1]), x[held][1] / hypot(x[held][0], x[held][1])};
    const double across[2][3] = {{-out[1], out[0], 0}, {0.6 * out[0], 0.6 * out[1], -0.8}};
    memcpy(constraint[held], across, sizeof across);
    constraints[held] = 2;
    CwPeriodicImages images = {.symmetry = &ring.symmetry};
    CwSurfaceMesh surface = {.source = ring.source, .images = ring_images(&ring)};
    CwLayerInput in = {.point_count = POINTS,
                       .x = x,
                       .triangle_count = TRIANGLES,
                       .triangle = (const int32_t(*)[3])ring.triangle,
                       .target = target,
                       .constraint_count = constraints,
                       .constraint_normal = constraint,
                       .constraint_stays = stays,
                       .snap = leave};
    CwLayers layers;
    CwOutcome outcome = {0};
    assert_int_equal(cw_image_layers(&images, &surface, &in, &layers, &outcome), CW_OK);
    assert_int_equal(outcome.kind, CW_OUTCOME_DONE);
    for (int k = 0; k < PASSAGES; k++) {
      int32_t v = ring_point(k * OF_PASSAGE, middle);
      const double *end = layers.top[v];
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
