// SPDX-License-Identifier: AGPL-3.0-or-later
// Layers on a flat ring of four equal passages: they are grown over the first and turned.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "flat_ring.h"
#include "mesher/boundary/periodic_boundary.h"
#include "mesher/layers/prism_quality.h"
#include "mesher/policy.h"
#include "tests/unit_test.h"

static const double HEIGHT = 0.6e-3;

static void leave(const void *context, int32_t v, double x[3]) {}

// Layers on the ring as images of those on its first passage.
static void grow(FlatRing *ring, const double *target, const int32_t *constraints, double (*constraint)[2][3],
                 CwLayers *layers) {
  static const uint8_t stays[POINTS];
  CwPeriodicImages images = {.symmetry = &ring->symmetry};
  CwSurfaceMesh surface = {.source = ring->source, .images = ring_images(ring)};
  CwLayerInput in = {.point_count = POINTS,
                     .x = (const double(*)[3])ring->x,
                     .triangle_count = TRIANGLES,
                     .triangle = (const int32_t(*)[3])ring->triangle,
                     .target = target,
                     .constraint_count = constraints,
                     .constraint_normal = (const double(*)[2][3])constraint,
                     .constraint_stays = stays,
                     .snap = leave};
  CwOutcome outcome = {0};
  assert_int_equal(cw_image_layers(&images, &surface, &in, layers, &outcome), CW_OK);
  assert_int_equal(outcome.kind, CW_OUTCOME_DONE);
}

// In the middle of the first seam the column of one member stands on a line that leans, that of the other is free.
static void seams_get_the_sounder_column(void **state) {
  static FlatRing ring;
  static double target[POINTS], constraint[POINTS][2][3];
  static int32_t constraints[POINTS];
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
    CwLayers layers;
    grow(&ring, target, constraints, constraint, &layers);
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

// All passages are alike and their prisms sound; a lowered column is as often 0.8 of what it was as it had no room, or
// as tall as the slope from its neighbours allows.
static void check_lowered(const FlatRing *ring, const CwLayers *layers, double height) {
  static double graded[POINTS];
  int lowered = 0, sloping = 0;
  for (int32_t v = 0; v < POINTS; v++) graded[v] = height;
  for (int32_t t = 0; t < TRIANGLES; t++) {
    const double *wall[3], *top[3];
    for (int k = 0; k < 3; k++) {
      int32_t v = ring->triangle[t][k];
      wall[k] = ring->x[v], top[k] = layers->top[v];
      for (int m = 1; m < 3; m++) {
        int32_t w = ring->triangle[t][(k + m) % 3];
        double away = hypot(ring->x[v][0] - ring->x[w][0], ring->x[v][1] - ring->x[w][1]);
        graded[v] = fmin(graded[v], layers->thickness[w] + cw_policy.slope * away);
      }
    }
    assert_true(cw_prism_quality(wall, top) >= cw_policy.sound_quality);
  }
  for (int32_t v = 0; v < POINTS; v++) {
    double steps = log(layers->thickness[v] / height) / log(cw_policy.column_kept);
    int32_t next = ring->next[v];
    assert_true(layers->thickness[v] <= graded[v] + 1e-12);
    assert_true(fabs(layers->thickness[v] - graded[v]) < 1e-12 || fabs(steps - round(steps)) < 1e-9);
    lowered += layers->thickness[v] < 0.99 * height;
    sloping += layers->thickness[v] < 0.99 * height && fabs(layers->thickness[v] - graded[v]) < 1e-12;
    assert_near(layers->thickness[next], layers->thickness[v], 1e-15);
    assert_near(layers->top[next][0], -layers->top[v][1], 1e-12);
    assert_near(layers->top[next][1], layers->top[v][0], 1e-12);
  }
  assert_true(lowered >= 4 * PASSAGES && sloping >= PASSAGES);
}

// In one passage the columns beside both seams are held on lines that lean towards the seam. In itself it has room, for
// beyond the seam stands what does not lean; as images stand there it has not, until columns are lower.
static void columns_that_images_leave_no_room_are_lowered(void **state) {
  static FlatRing ring;
  static double target[POINTS], constraint[POINTS][2][3];
  static int32_t constraints[POINTS];
  const double height = 1.2e-3, lean = 0.75;
  flat_ring(&ring);
  const double(*x)[3] = (const double(*)[3])ring.x;
  for (int32_t v = 0; v < POINTS; v++) target[v] = height;
  for (int side = 0; side < 2; side++)
    for (int j = 2; j <= RINGS - 2; j++) {
      int32_t v = ring_point(side ? OF_PASSAGE - 1 : 1, j);
      const double r = hypot(x[v][0], x[v][1]), along = side ? sin(lean) : -sin(lean);
      const double held[2][3] = {{x[v][0] / r, x[v][1] / r, 0},
                                 {-cos(lean) * x[v][1] / r, cos(lean) * x[v][0] / r, -along}};
      memcpy(constraint[v], held, sizeof held);
      constraints[v] = 2;
    }
  CwLayers layers;
  grow(&ring, target, constraints, constraint, &layers);
  check_lowered(&ring, &layers, height);
  cw_layers_free(&layers);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(seams_get_the_sounder_column),
                                     cmocka_unit_test(columns_that_images_leave_no_room_are_lowered)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
