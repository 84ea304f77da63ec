// SPDX-License-Identifier: AGPL-3.0-or-later
// Outlines and triangles of a domain of three or four equal passages, by the numbers of their nodes alone. (Layers:
// test_periodic_layers.)
#include "mesher/boundary/periodic_boundary.h"

#include <stdlib.h>
#include <string.h>

#include "tests/unit_test.h"

enum { TURNS = 3, OF_PITCH = 6, NODES = TURNS * OF_PITCH, OUTLINES = 3 * TURNS - 2 };

// Node n of a pitch is n + 6 of the next. Plane 0 lies across the axis, the half-planes 1 to 3 follow one another.
static CwPlan plan = {.node_count = 4, .sector_first = 1, .sector_count = TURNS};
static CwSymmetry symmetry = {.count = TURNS};
static CwPeriodicImages images = {.symmetry = &symmetry};
static const CwBoundaryInput in = {.plan = &plan, .images = &images};

typedef struct {
  double x[NODES][3];
  int32_t next[NODES], turns[NODES], corner[OUTLINES][4];
  CwInterfaceOutline outline[OUTLINES];
  CwFreeCurves free_curves;
} Outlines;

static void add(Outlines *made, int32_t node, int32_t a, int32_t b, int32_t c, int32_t d) {
  const int32_t i = made->free_curves.outline_count++, corner[4] = {a, b, c, d};
  memcpy(made->corner[i], corner, sizeof corner);
  made->outline[i] = (CwInterfaceOutline){.node = node, .corner_count = d < 0 ? 3 : 4, .corner = made->corner[i]};
}

// On each half-plane two outlines that share two corners, with the corners in any order; on plane 0 one that has a
// corner of each pitch. Number of each: half-plane 3, 1, 2, plane 0, half-plane 2, 3, 1.
static void make(Outlines *made) {
  memset(made, 0, sizeof *made);
  for (int32_t n = 0; n < NODES; n++) {
    made->next[n] = (n + OF_PITCH) % NODES;
    made->turns[n] = n / OF_PITCH;
    for (int k = 0; k < 3; k++) made->x[n][k] = n + 0.1 * k;
  }
  made->free_curves.nodes = (CwNodeTable){.count = NODES, .x = made->x};
  made->free_curves.images = (CwNodeImages){.capacity = NODES, .next = made->next, .turns = made->turns};
  made->free_curves.outline = made->outline;
  add(made, 3, 13, 12, 15, 14); // 0 1 2 3 of the third pitch
  add(made, 1, 0, 1, 2, 3);
  add(made, 2, 9, 8, 7, 6);
  add(made, 0, 5, 17, 11, -1);
  add(made, 2, 8, 9, 10, -1); // 2 3 4
  add(made, 3, 16, 14, 15, -1);
  add(made, 1, 3, 2, 4, -1);
}

static void outlines_are_found_by_their_corners(void **state) {
  static const int32_t next[OUTLINES] = {1, 2, 0, 3, 5, 6, 4}, first[OUTLINES] = {0, 0, 0, 3, 4, 4, 4},
                       turns[OUTLINES] = {0, 1, 2, 0, 0, 1, 2};
  Outlines made;
  CwOutcome outcome = {0};
  make(&made);
  assert_int_equal(cw_image_outlines(&in, &made.free_curves, &outcome), CW_OK);
  assert_int_equal(outcome.kind, CW_OUTCOME_DONE);
  const CwImages *found = &made.free_curves.outline_images;
  for (int i = 0; i < OUTLINES; i++) {
    assert_int_equal(found->next[i], next[i]);
    assert_int_equal(found->first[i], first[i]);
    assert_int_equal(found->turns[i], turns[i]);
  }
  cw_images_free(&made.free_curves.outline_images);
}

// Plane and place of the outline that has none: its first corner.
static void told(Outlines *made, int32_t outline) {
  CwOutcome outcome = {0};
  char words[100];
  assert_int_equal(cw_image_outlines(&in, &made->free_curves, &outcome), CW_OK);
  assert_int_equal(outcome.kind, CW_OUTCOME_ASYMMETRIC);
  snprintf(words, sizeof words, "an interface on plane %d has no periodic image", made->outline[outline].node);
  assert_string_equal(outcome.reason, words);
  assert_memory_equal(outcome.place[0], made->x[made->corner[outline][0]], sizeof outcome.place[0]);
  assert_null(made->free_curves.outline_images.next);
  make(made);
}

static void outlines_without_an_image_are_told(void **state) {
  Outlines made;
  make(&made);
  made.corner[2][1] = 10; // for 8: that of half-plane 1 does not find it
  told(&made, 1);
  made.outline[2].corner_count = 3; // the last corner, 6, is left out
  told(&made, 1);
  made.outline[5].node = 1; // on another half-plane
  told(&made, 4);
  made.corner[5][0] = 17; // for 16, the last of its corners
  told(&made, 4);
  made.corner[5][3] = 17; // one more
  made.outline[5].corner_count = 4;
  told(&made, 4);
  made.corner[3][1] = 16; // plane 0 is to be its own image
  told(&made, 3);
  made.next[14] = -1; // a corner that no turn takes anywhere
  told(&made, 0);
}

// Two outlines that four turns swap twice: each is to come back after four turns, not two.
static void outlines_that_come_back_too_early_are_told(void **state) {
  int32_t next[8], corner[2][4] = {{0, 2, 4, 6}, {1, 3, 5, 7}};
  double x[8][3] = {{0}};
  for (int32_t n = 0; n < 8; n++) next[n] = n / 4 * 4 + (n + 1) % 4;
  CwInterfaceOutline outline[2] = {{.corner_count = 4, .corner = corner[0]}, {.corner_count = 4, .corner = corner[1]}};
  CwFreeCurves free_curves = {
      .nodes = {.count = 8, .x = x}, .images = {.capacity = 8, .next = next}, .outline_count = 2, .outline = outline};
  CwOutcome outcome = {0};
  symmetry.count = 4;
  assert_int_equal(cw_image_outlines(&in, &free_curves, &outcome), CW_OK);
  symmetry.count = TURNS;
  assert_int_equal(outcome.kind, CW_OUTCOME_ASYMMETRIC);
  assert_string_equal(outcome.reason, "turns do not bring the interfaces to themselves");
}

// Two triangles of each pitch, one over the seam, and one on the axis; faces 0 to 2 follow one another, 3 is fixed. An
// edge of the first pitch was flipped: the others follow, and what is no copy stays.
static void copies_follow_their_source(void **state) {
  int32_t next[NODES + 1], face[7] = {0, 0, 2, 1, 3, 2, 1}, source[7] = {0, 1, 0, 1, 4, 1, 0}, turns[4] = {0, 1, 2, 0};
  int32_t triangle[7][3] = {{0, 1, 3}, {6, 0, 3}, {-7}, {-7}, {18, 0, 6}, {-7}, {-7}};
  static const int32_t wanted[7][3] = {{0, 1, 3},  {6, 0, 3},   {12, 13, 15}, {12, 6, 9},
                                       {18, 0, 6}, {0, 12, 15}, {6, 7, 9}};
  for (int32_t n = 0; n <= NODES; n++) next[n] = n == NODES ? n : (n + OF_PITCH) % NODES;
  const CwSurfaceMesh surface = {
      .triangle_count = 7, .face = face, .source = source, .images = {.capacity = NODES + 1, .next = next}};
  symmetry.face.turns = turns;
  cw_image_copy_triangles(&images, &surface, triangle);
  assert_memory_equal(triangle, wanted, sizeof wanted);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(outlines_are_found_by_their_corners),
      cmocka_unit_test(outlines_without_an_image_are_told),
      cmocka_unit_test(outlines_that_come_back_too_early_are_told),
      cmocka_unit_test(copies_follow_their_source),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
