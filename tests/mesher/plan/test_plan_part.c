// SPDX-License-Identifier: AGPL-3.0-or-later
// A box of 4 x 2 x 1 about which all is known: its open ends, work on its walls, three samples, points of edges.
#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/plan/plan_model.h"
#include "surfaces.h"
#include "tests/unit_test.h"

static const double HIGH[3] = {4, 2, 1};
static const double DENSITY[3] = {100, 3, 5}; // of walls across x, y, z; but those across x are open

enum { SAMPLES = 3, EDGES = 8 };
static CwPlanSample sample[SAMPLES] = {{{1.5, 0.5, 0.25}, 10, 1}, {{1.0, 1.5, 0.5}, 20, 2}, {{3.5, 1.0, 0.75}, 40, 4}};
// Beside the plane x = 1.5: what reaches it, by one of its three lengths, is of both sides.
static CwPlanEdgePoint edge[EDGES] = {
    {.x = {1, 0, 0}, .room = 0.25, .touch = 0.25, .half = 0.25},
    {.x = {1.25, 0, 0}, .room = 0.25},
    {.x = {1.25, 0, 0}, .room = 0.125},
    {.x = {1.5, 2, 1}},
    {.x = {1.75, 0, 0}, .room = 0.25},
    {.x = {1.75, 2, 0}, .touch = 0.25},
    {.x = {1.75, 0, 1}, .half = 0.25},
    {.x = {1.75, 2, 1}, .room = 0.125, .touch = 0.125, .half = 0.125},
};

typedef struct {
  Surface surface;
  CwBackground background;
  CwPlanModel model;
  CwPlanPart whole;
} Box;

static void check(CwStatus status) {
  if (status != CW_OK) fail_msg("%s", cw_fail_message());
}

// The axis across which a triangle of the box lies.
static int axis_of(const Surface *surface, int32_t t) {
  const int32_t *corner = surface->triangle[t];
  for (int k = 0; k < 3; k++) {
    const double at = surface->x[corner[0]][k];
    if (at == surface->x[corner[1]][k] && at == surface->x[corner[2]][k]) return k;
  }
  fail_msg("triangle %d lies across no axis", t);
  return -1;
}

static void take_surface(Box *box) {
  const Surface *s = &box->surface;
  box->background = (CwBackground){
      .point_count = s->point_count, .triangle_count = s->triangle_count, .x = s->x, .triangle = s->triangle};
  box->model.background = &box->background;
  box->model.wall = calloc((size_t)s->triangle_count, sizeof *box->model.wall);
  box->model.triangle = calloc((size_t)s->triangle_count, sizeof *box->model.triangle);
  assert_true(box->model.wall && box->model.triangle);
}

static void make_box(Box *box) {
  const double low[3] = {0, 0, 0};
  memset(box, 0, sizeof *box);
  surface_box(&box->surface, low, HIGH, 1, 63, 0);
  take_surface(box);
  for (int32_t t = 0; t < box->surface.triangle_count; t++) {
    const int axis = axis_of(&box->surface, t);
    box->model.wall[t] = axis != 0;
    box->model.triangle[t].density = DENSITY[axis];
  }
  box->model.sample_count = SAMPLES;
  box->model.sample = sample;
  box->model.edge_count = EDGES;
  box->model.edge = edge;
  check(cw_plan_part_whole(&box->model, &box->whole));
}

static void free_box(Box *box) {
  cw_plan_part_free(&box->whole);
  free(box->model.wall);
  free(box->model.triangle);
  surface_free(&box->surface);
}

// The area of a piece: half of the sum of the cross products of its corners, seen from the origin.
static double area_of(const CwPieces *pieces, int32_t i) {
  double sum[3] = {0, 0, 0}, cross[3];
  const int32_t first = pieces->start[i], count = pieces->start[i + 1] - first;
  for (int32_t k = 0; k < count; k++) {
    cw_cross(pieces->corner[first + k], pieces->corner[first + (k + 1) % count], cross);
    for (int c = 0; c < 3; c++) sum[c] += cross[c];
  }
  return cw_norm(sum) / 2;
}

// Pieces of walls alone, each with its corners on the plane of its triangle and in the cell, and its own work; gives
// the sum.
static double check_pieces(const Box *box, const CwPlanPart *part, const double low[3], const double high[3]) {
  const CwPieces *pieces = &part->pieces;
  double work = 0;
  assert_int_equal(pieces->start[0], 0);
  for (int32_t i = 0; i < pieces->count; i++) {
    const int32_t t = pieces->triangle[i];
    const int axis = axis_of(&box->surface, t);
    assert_int_not_equal(axis, 0);
    assert_true(pieces->start[i + 1] - pieces->start[i] >= 3);
    for (int32_t c = pieces->start[i]; c < pieces->start[i + 1]; c++) {
      assert_near(pieces->corner[c][axis], box->surface.x[box->surface.triangle[t][0]][axis], 1e-15);
      for (int k = 0; k < 3; k++)
        assert_true(pieces->corner[c][k] > low[k] - 1e-12 && pieces->corner[c][k] < high[k] + 1e-12);
    }
    assert_near(pieces->work[i], DENSITY[axis] * area_of(pieces, i), 1e-12);
    work += pieces->work[i];
  }
  return work;
}

static void check_list(int32_t count, const int32_t *list, int32_t wanted_count, const int32_t *wanted) {
  assert_int_equal(count, wanted_count);
  for (int32_t i = 0; i < count; i++) assert_int_equal(list[i], wanted[i]);
}

// Work on walls: 2 sides of 4 with 3 each, floor and lid of 8 with 5 each; 7 of the samples.
static void the_whole_has_all_walls(void **state) {
  Box box;
  const double low[3] = {0, 0, 0};
  const int32_t all[] = {0, 1, 2, 3, 4, 5, 6, 7};
  make_box(&box);
  assert_near(check_pieces(&box, &box.whole, low, HIGH), 24 + 80, 1e-12);
  assert_near(box.whole.work, 24 + 80 + 7, 1e-12);
  assert_near(box.whole.volume, 70, 1e-12);
  check_list(box.whole.sample_count, box.whole.sample, SAMPLES, all);
  check_list(box.whole.edge_count, box.whole.edge, EDGES, all);
  assert_near(box.whole.box.low[0], 1, 0);
  assert_near(box.whole.box.low[1], 0.5, 0);
  assert_near(box.whole.box.high[0], 3.5, 0);
  assert_near(box.whole.box.high[2], 0.75, 0);
  free_box(&box);
}

// At x = 1.5 there is a sample, which is of the negative side alone.
static void a_plane_shares_all_out(void **state) {
  Box box;
  CwPlanPart part[2];
  const CwPlane plane = {{1, 0, 0}, 1.5};
  const double low[2][3] = {{0, 0, 0}, {1.5, 0, 0}}, high[2][3] = {{1.5, 2, 1}, {4, 2, 1}};
  const int32_t before[] = {0, 1}, behind[] = {2}, near_before[] = {0, 1, 2, 3, 4, 5, 6},
                near_behind[] = {1, 3, 4, 5, 6, 7};
  make_box(&box);
  for (int side = 0; side < 2; side++) check(cw_plan_part_clip(&box.model, &box.whole, &plane, side, &part[side]));
  assert_near(check_pieces(&box, &part[0], low[0], high[0]), 9 + 30, 1e-12);
  assert_near(check_pieces(&box, &part[1], low[1], high[1]), 15 + 50, 1e-12);
  assert_near(part[0].work, 9 + 30 + 3, 1e-12);
  assert_near(part[1].work, 15 + 50 + 4, 1e-12);
  assert_near(part[0].volume, 30, 1e-12);
  assert_near(part[1].volume, 40, 1e-12);
  check_list(part[0].sample_count, part[0].sample, 2, before);
  check_list(part[1].sample_count, part[1].sample, 1, behind);
  check_list(part[0].edge_count, part[0].edge, 7, near_before);
  check_list(part[1].edge_count, part[1].edge, 6, near_behind);
  assert_near(part[0].box.high[0], 1.5, 0);
  assert_near(part[0].box.high[1], 1.5, 0);
  assert_near(part[1].box.low[1], 1, 0);
  for (int side = 0; side < 2; side++) cw_plan_part_free(&part[side]);
  free_box(&box);
}

// Before x + y = 2.5 floor and lid have a trapezoid of 2.5 and 0.5 by 2, the walls across y the same lengths by 1.
static void a_slant_plane_cuts_trapezoids(void **state) {
  Box box;
  CwPlanPart part[2];
  const double s = sqrt(0.5), low[3] = {0, 0, 0};
  const CwPlane plane = {{s, s, 0}, 2.5 * s};
  make_box(&box);
  for (int side = 0; side < 2; side++) {
    check(cw_plan_part_clip(&box.model, &box.whole, &plane, side, &part[side]));
    for (int32_t c = 0; c < part[side].pieces.start[part[side].pieces.count]; c++) {
      const double off = cw_plane_distance(&plane, part[side].pieces.corner[c]);
      assert_true(side ? off > -1e-12 : off < 1e-12);
    }
  }
  assert_near(check_pieces(&box, &part[0], low, HIGH), 2 * 3 * 5 + 3 * 3, 1e-12);
  assert_near(check_pieces(&box, &part[1], low, HIGH), 2 * 5 * 5 + 5 * 3, 1e-12);
  for (int side = 0; side < 2; side++) cw_plan_part_free(&part[side]);
  free_box(&box);
}

// Three planes one after the other: each of the eight cells has the walls of its own box.
static void parts_are_divided_again(void **state) {
  Box box;
  const CwPlane plane[3] = {{{1, 0, 0}, 1.3}, {{0, 1, 0}, 0.7}, {{0, 0, 1}, 0.45}};
  make_box(&box);
  for (int cell = 0; cell < 8; cell++) {
    CwPlanPart part[3];
    double low[3], high[3];
    for (int k = 0; k < 3; k++) {
      const int side = cell >> k & 1;
      check(cw_plan_part_clip(&box.model, k > 0 ? &part[k - 1] : &box.whole, &plane[k], side, &part[k]));
      low[k] = side ? plane[k].offset : 0;
      high[k] = side ? HIGH[k] : plane[k].offset;
    }
    const double x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    assert_near(check_pieces(&box, &part[2], low, high), 3 * x * z + 5 * x * y, 1e-12);
    for (int k = 0; k < 3; k++) cw_plan_part_free(&part[k]);
  }
  free_box(&box);
}

// Beside the box the one side has all of it and the other nothing.
static void a_plane_beside_leaves_one_side_empty(void **state) {
  Box box;
  CwPlanPart part[2];
  const CwPlane plane = {{1, 0, 0}, 5};
  make_box(&box);
  for (int side = 0; side < 2; side++) check(cw_plan_part_clip(&box.model, &box.whole, &plane, side, &part[side]));
  assert_int_equal(part[0].pieces.count, box.whole.pieces.count);
  assert_near(part[0].work, box.whole.work, 0);
  assert_int_equal(part[0].edge_count, EDGES);
  assert_int_equal(part[1].pieces.count, 0);
  assert_int_equal(part[1].sample_count, 0);
  assert_int_equal(part[1].edge_count, 0);
  assert_near(part[1].work, 0, 0);
  assert_near(part[1].volume, 0, 0);
  assert_true(part[1].box.low[0] > part[1].box.high[0]);
  for (int side = 0; side < 2; side++) cw_plan_part_free(&part[side]);
  free_box(&box);
}

// Of a triangle round a circle of radius 1 each tangent cuts a corner off, which makes one more of it. The area is that
// of a polygon round the circle: the tangent of half the angle between neighbours, summed. A piece of as many corners
// as a piece may have cannot be cut.
static void a_piece_has_so_many_corners_at_most(void **state) {
  enum { CUTS = CW_CLIP_MAX - 3 };
  Box box = {0};
  CwPlanPart part[2];
  double wanted = 3 * tan(M_PI / 3);
  for (int k = 0; k < 3; k++) {
    const double x[3] = {2 * cos(2 * M_PI * k / 3), 2 * sin(2 * M_PI * k / 3), 0};
    surface_point(&box.surface, x);
  }
  surface_triangle(&box.surface, 0, 1, 2);
  take_surface(&box);
  box.model.wall[0] = 1;
  box.model.triangle[0].density = 10;
  check(cw_plan_part_whole(&box.model, &part[0]));
  // Sides touch the circle at 60, 180 and 300 degrees; tangents lie at even steps in the third from -60 to 60 degrees.
  for (int i = 1; i <= CUTS; i++) {
    const double step = 2 * M_PI / 3 / (CUTS + 1), angle = -M_PI / 3 + i * step;
    const CwPlane tangent = {{cos(angle), sin(angle), 0}, 1};
    check(cw_plan_part_clip(&box.model, &part[0], &tangent, 0, &part[1]));
    cw_plan_part_free(&part[0]);
    part[0] = part[1];
    assert_int_equal(part[0].pieces.start[1], 3 + i);
    const double left = M_PI / 3 - angle; // to the next side; behind are steps
    wanted = 2 * tan(M_PI / 3) + i * tan(step / 2) + tan(left / 2);
    assert_near(part[0].work, 10 * wanted, 1e-12 * 10 * wanted);
  }
  const CwPlane last = {{1, 0, 0}, 0.5};
  assert_int_equal(cw_plan_part_clip(&box.model, &part[0], &last, 0, &part[1]), CW_ERR_MESH);
  assert_non_null(strstr(cw_fail_message(), "more than 32 corners"));
  assert_null(part[1].pieces.corner);
  assert_int_equal(part[1].pieces.count, 0);
  cw_fail_clear();
  cw_plan_part_free(&part[0]);
  free_box(&box);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_whole_has_all_walls),
      cmocka_unit_test(a_plane_shares_all_out),
      cmocka_unit_test(a_slant_plane_cuts_trapezoids),
      cmocka_unit_test(parts_are_divided_again),
      cmocka_unit_test(a_plane_beside_leaves_one_side_empty),
      cmocka_unit_test(a_piece_has_so_many_corners_at_most),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
