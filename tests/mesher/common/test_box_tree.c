// SPDX-License-Identifier: AGPL-3.0-or-later
// The tree against a plain loop over all boxes, before and after they move.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/box_tree.h"
#include "mesher/common/vec.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

enum { COUNT = 700 };

static void random_boxes(uint64_t seed, CwBox *box) {
  for (int i = 0; i < COUNT; i++) {
    for (int k = 0; k < 3; k++) {
      box[i].low[k] = draw(&seed);
      box[i].high[k] = box[i].low[k] + 0.1 * draw(&seed);
    }
  }
}

static const CwBox WITHIN = {{0, 0, 0}, {1.1, 1.1, 1.1}};

static CwBox box_of(const void *context, int32_t item) {
  return ((const CwBox *)context)[item];
}

static int mark(void *context, int32_t item) {
  ((uint8_t *)context)[item] = 1;
  return 0;
}

static void check_overlaps(const CwBoxTree *tree, const CwBox *box) {
  for (int i = 0; i < COUNT; i += 7) {
    uint8_t seen[COUNT] = {0};
    int met = 0;
    cw_box_tree_overlaps(tree, &box[i], mark, seen);
    for (int j = 0; j < COUNT; j++) {
      if (cw_boxes_meet(&box[i], &box[j])) assert_true(seen[j]), met++;
    }
    assert_true(met >= 1);
  }
}

static void finds_all_that_meet(void **state) {
  CwBox *box = calloc(COUNT, sizeof *box);
  CwBoxTree tree, alike;
  random_boxes(1, box);
  assert_int_equal(cw_box_tree_make(NULL, COUNT, &WITHIN, box_of, box, &tree), CW_OK);
  check_overlaps(&tree, box);
  random_boxes(2, box);
  assert_int_equal(cw_box_tree_alike(NULL, &tree, box_of, box, &alike), CW_OK);
  check_overlaps(&alike, box);
  cw_box_tree_free(&alike);
  cw_box_tree_free(&tree);
  free(box);
}

// From the starts of a box around several, a walk visits the same items in the same order as from the root.
static int list(void *context, int32_t item) {
  int32_t *order = context;
  order[1 + order[0]++] = item;
  return 0;
}

static void starts_lead_to_the_same(void **state) {
  CwBox *box = calloc(COUNT, sizeof *box);
  CwBoxTree tree;
  random_boxes(6, box);
  assert_int_equal(cw_box_tree_make(NULL, COUNT, &WITHIN, box_of, box, &tree), CW_OK);
  for (int i = 0; i + 4 < COUNT; i += 4) {
    CwBox around = cw_box_empty();
    const int32_t *near = &tree.item[i];
    int group = i % 3 ? 4 : 1;
    for (int j = 0; j < group; j++) cw_box_add(&around, &box[near[j]]);
    const CwBoxStarts starts = cw_box_tree_starts(&tree, &around);
    for (int j = 0; j < group; j++) {
      int32_t all[COUNT + 1] = {0}, some[COUNT + 1] = {0};
      cw_box_tree_overlaps(&tree, &box[near[j]], list, all);
      cw_box_tree_overlaps_from(&tree, &starts, &box[near[j]], list, some);
      assert_memory_equal(all, some, sizeof all);
    }
  }
  const CwBox far = {{5, 5, 5}, {6, 6, 6}};
  assert_int_equal(cw_box_tree_starts(&tree, &far).count, 0);
  cw_box_tree_free(&tree);
  free(box);
}

static void finds_all_that_are_near(void **state) {
  CwBox *box = calloc(COUNT, sizeof *box);
  CwBoxTree tree;
  random_boxes(7, box);
  assert_int_equal(cw_box_tree_make(NULL, COUNT, &WITHIN, box_of, box, &tree), CW_OK);
  int visits = 0;
  for (int i = 0; i < COUNT; i++) {
    const double *p = box[i].low, reach = 0.001 * i / COUNT * 100;
    uint8_t seen[COUNT] = {0};
    cw_box_tree_near(&tree, p, &reach, mark, seen);
    for (int j = 0; j < COUNT; j++) {
      double square = 0;
      for (int k = 0; k < 3; k++) square += pow(fmax(0, fmax(box[j].low[k] - p[k], p[k] - box[j].high[k])), 2);
      if (sqrt(square) < reach) assert_true(seen[j]);
      visits += seen[j];
    }
  }
  assert_true(visits < COUNT * COUNT / 8);
  cw_box_tree_free(&tree);
  free(box);
}

typedef struct {
  const CwBox *box;
  const double *p;
  double reach;
  int item, visits;
} Nearest;

static int take_nearer(void *context, int32_t item) {
  Nearest *nearest = context;
  double square = 0;
  for (int k = 0; k < 3; k++) square += pow(nearest->box[item].low[k] - nearest->p[k], 2);
  if (square < nearest->reach * nearest->reach) nearest->reach = sqrt(square), nearest->item = item;
  nearest->visits++;
  return 0;
}

static void finds_the_nearest_where_the_visitor_lowers_the_reach(void **state) {
  CwBox *box = calloc(COUNT, sizeof *box);
  CwBoxTree tree;
  int visits = 0;
  random_boxes(8, box);
  for (int i = 0; i < COUNT; i++) memcpy(box[i].high, box[i].low, sizeof box[i].high);
  assert_int_equal(cw_box_tree_make(NULL, COUNT, &WITHIN, box_of, box, &tree), CW_OK);
  for (int i = 0; i < COUNT; i++) {
    double p[3], least = INFINITY;
    for (int k = 0; k < 3; k++) p[k] = 0.99 * box[i].low[k] + 0.005;
    Nearest nearest = {box, p, 2, -1, 0};
    cw_box_tree_near(&tree, p, &nearest.reach, take_nearer, &nearest);
    for (int j = 0; j < COUNT; j++) {
      double square = 0;
      for (int k = 0; k < 3; k++) square += pow(box[j].low[k] - p[k], 2);
      least = fmin(least, sqrt(square));
    }
    assert_true(nearest.item >= 0);
    assert_true(nearest.reach == least);
    visits += nearest.visits;
  }
  assert_true(visits < COUNT * COUNT / 8);
  cw_box_tree_free(&tree);
  free(box);
}

static void follows_those_that_move(void **state) {
  CwBox *box = calloc(COUNT, sizeof *box);
  CwBoxTree tree, before, whole;
  uint8_t moved[COUNT - 1] = {0};
  random_boxes(6, box);
  assert_int_equal(cw_box_tree_make(NULL, COUNT, &WITHIN, box_of, box, &tree), CW_OK);
  assert_int_equal(cw_box_tree_make(NULL, COUNT, &WITHIN, box_of, box, &before), CW_OK);
  for (int i = 0; i < COUNT - 1; i += 10) {
    moved[i] = 1;
    for (int k = 0; k < 3; k++) box[i].low[k] += 1, box[i].high[k] += 2;
  }
  cw_box_tree_follow(&tree, moved, COUNT - 1, box_of, box);
  assert_int_equal(cw_box_tree_alike(NULL, &before, box_of, box, &whole), CW_OK);
  assert_memory_equal(tree.node + 1, whole.node + 1, ((size_t)tree.node_count - 1) * sizeof *tree.node);
  cw_box_tree_free(&tree);
  cw_box_tree_free(&before);
  cw_box_tree_free(&whole);
  free(box);
}

// Of each item 4 bytes, and for four of them a leaf and half of what lies above, in single precision; leaves without
// items take nothing. A tree alike has no items of its own.
static void takes_little_memory(void **state) {
  CwBox *box = calloc(COUNT, sizeof *box);
  CwBoxTree tree, alike;
  random_boxes(9, box);
  assert_int_equal(cw_box_tree_make(NULL, COUNT, &WITHIN, box_of, box, &tree), CW_OK);
  assert_int_equal(cw_box_tree_alike(NULL, &tree, box_of, box, &alike), CW_OK);
  assert_int_equal(sizeof *tree.node, 24);
  assert_int_equal(tree.node_count, tree.leaves + (COUNT + 3) / 4);
  assert_ptr_equal(alike.item, tree.item);
  cw_box_tree_free(&alike);
  cw_box_tree_free(&tree);
  free(box);
}

static void passes_by_most(void **state) {
  CwBox *box = calloc(COUNT, sizeof *box);
  CwBoxTree tree;
  random_boxes(3, box);
  assert_int_equal(cw_box_tree_make(NULL, COUNT, &WITHIN, box_of, box, &tree), CW_OK);
  uint8_t seen[COUNT] = {0};
  int visited = 0;
  cw_box_tree_overlaps(&tree, &box[5], mark, seen);
  for (int j = 0; j < COUNT; j++) visited += seen[j];
  assert_true(visited < COUNT / 4);
  cw_box_tree_free(&tree);
  free(box);
}

// Rays along x through the middle of each box: every box whose sides enclose the line is visited.
static void rays_meet_what_lies_on_them(void **state) {
  CwBox *box = calloc(COUNT, sizeof *box);
  CwBoxTree tree;
  random_boxes(4, box);
  assert_int_equal(cw_box_tree_make(NULL, COUNT, &WITHIN, box_of, box, &tree), CW_OK);
  for (int i = 0; i < COUNT; i += 11) {
    const double x[3] = {-1, 0.5 * (box[i].low[1] + box[i].high[1]), 0.5 * (box[i].low[2] + box[i].high[2])};
    const double g[3] = {1, 0, 0};
    double far = 1.5;
    uint8_t seen[COUNT] = {0};
    cw_box_tree_ray(&tree, NULL, x, g, &far, mark, seen);
    for (int j = 0; j < COUNT; j++) {
      if (box[j].low[0] <= 0.5 && box[j].low[1] <= x[1] && x[1] <= box[j].high[1] && box[j].low[2] <= x[2] &&
          x[2] <= box[j].high[2])
        assert_true(seen[j]);
    }
  }
  cw_box_tree_free(&tree);
  free(box);
}

static CwBox normal_at(const void *context, int32_t item) {
  return cw_box_of_point(((const double(*)[3])context)[item]);
}

// What is left out of what a ray meets has a normal against it; most of what has is left out where neighbours point the
// same way.
static void rays_pass_over_what_points_against_them(void **state) {
  CwBox *box = calloc(COUNT, sizeof *box);
  double(*normal)[3] = calloc(COUNT, sizeof *normal);
  CwBoxTree tree, normals;
  int against = 0, visited = 0;
  random_boxes(7, box);
  for (int j = 0; j < COUNT; j++) {
    for (int k = 0; k < 3; k++) normal[j][k] = 0.5 * (box[j].low[k] + box[j].high[k]) - 0.5; // out of the middle
    cw_unit(normal[j]);
  }
  assert_int_equal(cw_box_tree_make(NULL, COUNT, &WITHIN, box_of, box, &tree), CW_OK);
  assert_int_equal(cw_box_tree_alike(NULL, &tree, normal_at, normal, &normals), CW_OK);
  for (int i = 0; i < COUNT; i += 11) {
    const double x[3] = {-1, 0.5 * (box[i].low[1] + box[i].high[1]), 0.5 * (box[i].low[2] + box[i].high[2])};
    const double g[3] = {1, 0, 0};
    double far = 3;
    uint8_t all[COUNT] = {0}, seen[COUNT] = {0};
    cw_box_tree_ray(&tree, NULL, x, g, &far, mark, all);
    cw_box_tree_ray(&tree, &normals, x, g, &far, mark, seen);
    for (int j = 0; j < COUNT; j++) {
      assert_int_equal(seen[j] || (all[j] && normal[j][0] <= 0), all[j]);
      against += all[j] && normal[j][0] <= 0;
      visited += seen[j] && normal[j][0] <= 0;
    }
  }
  assert_true(visited < against / 2);
  cw_box_tree_free(&tree);
  cw_box_tree_free(&normals);
  free(normal);
  free(box);
}

static int stop(void *context, int32_t item) {
  return ++*(int *)context == 3;
}

static void empty_and_stopped(void **state) {
  CwBoxTree tree;
  CwBox all = {{-1, -1, -1}, {2, 2, 2}}, *box = calloc(COUNT, sizeof *box);
  int visits = 0;
  assert_int_equal(cw_box_tree_make(NULL, 0, &WITHIN, box_of, NULL, &tree), CW_OK);
  cw_box_tree_overlaps(&tree, &all, stop, &visits);
  assert_int_equal(visits, 0);
  cw_box_tree_free(&tree);
  random_boxes(5, box);
  assert_int_equal(cw_box_tree_make(NULL, COUNT, &WITHIN, box_of, box, &tree), CW_OK);
  cw_box_tree_overlaps(&tree, &all, stop, &visits);
  assert_int_equal(visits, 3);
  cw_box_tree_free(&tree);
  free(box);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(finds_all_that_meet),
                                     cmocka_unit_test(starts_lead_to_the_same),
                                     cmocka_unit_test(finds_all_that_are_near),
                                     cmocka_unit_test(finds_the_nearest_where_the_visitor_lowers_the_reach),
                                     cmocka_unit_test(follows_those_that_move),
                                     cmocka_unit_test(takes_little_memory),
                                     cmocka_unit_test(passes_by_most),
                                     cmocka_unit_test(rays_meet_what_lies_on_them),
                                     cmocka_unit_test(rays_pass_over_what_points_against_them),
                                     cmocka_unit_test(empty_and_stopped)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
