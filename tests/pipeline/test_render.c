// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/report/camera.h"
#include "pipeline/report/render.h"
#include "tests/pipeline/png_surface.h"
#include "tests/unit_test.h"

enum { WHITE = 0xffffff, RED = 0xc02010, BLUE = 0x1040c0, BLACK = 0x000000 };

static const CwPaint red = {.colour = RED, .group = 1}, blue = {.colour = BLUE, .group = 2};

static int count_colour(const CwCanvas *canvas, uint32_t colour) {
  int count = 0;
  for (int i = 0; i < canvas->columns * canvas->rows; i++)
    count += (canvas->group[i] ? canvas->colour[i] : canvas->background) == colour;
  return count;
}

static uint32_t sample(const CwCanvas *canvas, double x, double y) {
  int place = (int)(y * CW_RENDER_SAMPLES) * canvas->columns + (int)(x * CW_RENDER_SAMPLES);
  return canvas->group[place] ? canvas->colour[place] : canvas->background;
}

static void triangle_fills_its_area(void **state) {
  CwCanvas canvas;
  assert_int_equal(cw_render_start(20, 10, WHITE, 0, &canvas), CW_OK);
  // Legs of 8 px are 16 samples: the centres within are those of 1 + ... + 16, the hypotenuse's with them.
  const double p[3][3] = {{2, 1, 0}, {10, 1, 0}, {2, 9, 0}};
  cw_render_triangle(&canvas, p, &red);
  assert_int_equal(count_colour(&canvas, RED), 16 * 17 / 2);
  assert_int_equal(sample(&canvas, 2.2, 1.2), RED);
  assert_int_equal(sample(&canvas, 1.8, 1.2), WHITE);
  assert_int_equal(sample(&canvas, 8, 7), WHITE);
  cw_render_free(&canvas);
}

static void neighbours_leave_no_gap_and_turn_does_not_matter(void **state) {
  CwCanvas canvas;
  assert_int_equal(cw_render_start(30, 30, WHITE, 1, &canvas), CW_OK);
  const double corner[4][3] = {{3.3, 4.1, 0}, {27.7, 2.9, 0}, {25.2, 26.6, 0}, {1.9, 22.4, 0}};
  const double middle[3] = {13.37, 14.91, 0};
  for (int k = 0; k < 4; k++) {
    double p[3][3];
    int turned = k & 1; // every other triangle the other way round
    memcpy(p[0], middle, sizeof middle);
    memcpy(p[1 + turned], corner[k], sizeof middle);
    memcpy(p[2 - turned], corner[(k + 1) % 4], sizeof middle);
    cw_render_triangle(&canvas, p, &red);
  }
  for (double y = 6; y < 21; y += 0.5) {
    for (double x = 6; x < 24; x += 0.5) assert_int_equal(sample(&canvas, x, y), RED);
  }
  cw_render_free(&canvas);
}

static void nearer_triangle_wins_with_a_depth_buffer(void **state) {
  const double near[3][3] = {{0, 0, 5}, {10, 0, 5}, {0, 10, 5}}, far[3][3] = {{0, 0, 1}, {10, 0, 1}, {0, 10, 1}};
  // Goes through the far one along the line x + y = 5.
  const double slant[3][3] = {{0, 0, -4}, {10, 0, 6}, {0, 10, 6}};
  for (int depth = 0; depth < 2; depth++) {
    CwCanvas canvas;
    assert_int_equal(cw_render_start(10, 10, WHITE, depth, &canvas), CW_OK);
    cw_render_triangle(&canvas, near, &red);
    cw_render_triangle(&canvas, far, &blue);
    assert_int_equal(sample(&canvas, 2, 2), depth ? RED : BLUE);
    cw_render_free(&canvas);
  }
  CwCanvas canvas;
  assert_int_equal(cw_render_start(10, 10, WHITE, 1, &canvas), CW_OK);
  cw_render_triangle(&canvas, far, &red);
  cw_render_triangle(&canvas, slant, &blue);
  assert_int_equal(sample(&canvas, 1, 1), RED);
  assert_int_equal(sample(&canvas, 4, 4), BLUE);
  cw_render_free(&canvas);
}

static void only_the_asked_edges_are_drawn(void **state) {
  CwCanvas canvas;
  CwPaint paint = {.colour = RED, .edge_colour = BLACK, .group = 1, .edges = 1, .edge_width = 1, .edge_strength = 1};
  const double p[3][3] = {{2, 2, 0}, {18, 2, 0}, {2, 18, 0}};
  assert_int_equal(cw_render_start(20, 20, WHITE, 0, &canvas), CW_OK);
  cw_render_triangle(&canvas, p, &paint);
  assert_int_equal(sample(&canvas, 8, 2), BLACK); // corner 0 to 1
  assert_int_equal(sample(&canvas, 2, 8), RED);
  assert_int_equal(sample(&canvas, 8, 4), RED);
  paint.edges = 4; // corner 2 to 0
  cw_render_triangle(&canvas, p, &paint);
  assert_int_equal(sample(&canvas, 8, 2), RED);
  assert_int_equal(sample(&canvas, 2, 8), BLACK);
  // A square drawn as a polygon has no diagonal.
  const double square[4][3] = {{2, 2, 0}, {18, 2, 0}, {18, 18, 0}, {2, 18, 0}};
  cw_render_polygon(&canvas, square, 4, &paint);
  for (double t = 5; t < 16; t += 0.5) assert_int_equal(sample(&canvas, t, t), RED);
  assert_int_equal(sample(&canvas, 10, 2), BLACK);
  assert_int_equal(sample(&canvas, 17.9, 10), BLACK);
  assert_int_equal(sample(&canvas, 10, 17.9), BLACK);
  assert_int_equal(sample(&canvas, 2, 10), BLACK);
  cw_render_free(&canvas);
}

// Corners that all but coincide take no line from the edges beside them.
static void short_edges_keep_their_neighbours(void **state) {
  CwCanvas canvas;
  const CwPaint paint = {.colour = RED, .edge_colour = BLACK, .group = 1, .edge_width = 1, .edge_strength = 1};
  const double p[6][3] = {{2, 2, 0}, {2 + 1e-7, 2, 0}, {18, 2, 0}, {18, 2 + 1e-9, 0}, {18, 18, 0}, {2, 18, 0}};
  for (int turn = 0; turn < 6; turn++) {
    for (int back = 0; back < 2; back++) {
      double corner[6][3];
      for (int k = 0; k < 6; k++) memcpy(corner[k], p[((back ? 5 - k : k) + turn) % 6], sizeof corner[k]);
      assert_int_equal(cw_render_start(20, 20, WHITE, 0, &canvas), CW_OK);
      cw_render_polygon(&canvas, (const double(*)[3])corner, 6, &paint);
      assert_int_equal(sample(&canvas, 10, 2), BLACK);
      assert_int_equal(sample(&canvas, 17.9, 10), BLACK);
      assert_int_equal(sample(&canvas, 10, 17.9), BLACK);
      assert_int_equal(sample(&canvas, 2, 10), BLACK);
      assert_int_equal(sample(&canvas, 10, 10), RED);
      assert_int_equal(sample(&canvas, 1, 10), WHITE);
      cw_render_free(&canvas);
    }
  }
}

static void what_lies_outside_is_left_out(void **state) {
  CwCanvas canvas;
  assert_int_equal(cw_render_start(10, 10, WHITE, 1, &canvas), CW_OK);
  const double beside[3][3] = {{20, 0, 0}, {30, 0, 0}, {20, 10, 0}}, line[3][3] = {{0, 0, 0}, {5, 5, 0}, {9, 9, 0}};
  const double nan[3][3] = {{NAN, 0, 0}, {30, 0, 0}, {20, 10, 0}};
  const double around[3][3] = {{-1e6, -1e6, 0}, {3e6, -1e6, 0}, {-1e6, 3e6, 0}};
  const double between[3][3] = {{5.1, 5, 0}, {5.2, 5, 0}, {5.1, 9, 0}};
  assert_false(cw_render_meets(&canvas, beside, 3));
  assert_false(cw_render_meets(&canvas, nan, 3));
  assert_false(cw_render_meets(&canvas, between, 3));
  assert_false(cw_render_meets(&canvas, around, 0));
  assert_true(cw_render_meets(&canvas, around, 3));
  cw_render_triangle(&canvas, beside, &red);
  cw_render_triangle(&canvas, line, &red);
  cw_render_triangle(&canvas, nan, &red);
  assert_int_equal(count_colour(&canvas, WHITE), 20 * 20);
  cw_render_triangle(&canvas, around, &red);
  assert_int_equal(count_colour(&canvas, RED), 20 * 20);
  cw_render_free(&canvas);
}

static void outlines_follow_groups_and_depth_steps(void **state) {
  CwCanvas canvas;
  const double left[4][3] = {{2, 2, 0}, {10, 2, 0}, {10, 18, 0}, {2, 18, 0}};
  const double right[4][3] = {{10, 2, 0}, {18, 2, 8}, {18, 18, 8}, {10, 18, 0}}; // slanted, no step
  const double front[4][3] = {{4, 8, 6}, {8, 8, 6}, {8, 12, 6}, {4, 12, 6}};
  assert_int_equal(cw_render_start(20, 20, WHITE, 1, &canvas), CW_OK);
  cw_render_polygon(&canvas, left, 4, &red);
  cw_render_polygon(&canvas, right, 4, &blue);
  cw_render_polygon(&canvas, front, 4, &red);
  cw_render_outline(&canvas, BLACK, 3);
  assert_int_not_equal(sample(&canvas, 10, 5), BLUE);  // other group
  assert_int_not_equal(sample(&canvas, 7.9, 10), RED); // step of the front
  assert_int_equal(sample(&canvas, 6, 10), RED);
  assert_int_equal(sample(&canvas, 14, 10), BLUE);
  assert_int_equal(sample(&canvas, 1, 10), WHITE);
  cw_render_erase(&canvas, 2);
  assert_int_equal(sample(&canvas, 14, 10), WHITE);
  assert_int_equal(sample(&canvas, 6, 10), RED);
  cw_render_free(&canvas);
}

// Random triangles, some of one depth, on one canvas and in turn on three that are then merged from the middle one out.
static void merged_canvases_are_as_one(void **state) {
  for (int depth = 0; depth < 2; depth++) {
    CwCanvas one, part[3];
    unsigned random = 1;
    assert_int_equal(cw_render_start(40, 60, WHITE, depth, &one), CW_OK);
    assert_int_equal(cw_render_keep_velocity(&one), CW_OK);
    for (int k = 0; k < 3; k++) {
      assert_int_equal(cw_render_start(40, 60, WHITE, depth, &part[k]), CW_OK);
      assert_int_equal(cw_render_keep_velocity(&part[k]), CW_OK);
      for (int t = 0; t < 200; t++) {
        double p[3][3];
        for (int i = 0; i < 9; i++) {
          random = 1664525 * random + 1013904223; // D. Knuth and H. Lewis's
          p[i / 3][i % 3] = i % 3 == 2 ? (random >> 24) % 3 : (random >> 20) % 20 + 10 * k;
        }
        if (t % 3 == 0) p[1][2] = p[2][2] = p[0][2];
        const CwPaint paint = {
            .colour = random >> 8, .group = (uint16_t)(1 + t + 200 * k), .velocity = {(float)t, (float)k}};
        cw_render_triangle(&one, p, &paint);
        cw_render_triangle(&part[k], p, &paint);
      }
    }
    assert_in_range(part[0].bottom, 30, 80);
    assert_in_range(part[2].top, 40, 80);
    cw_render_merge(&part[1], &part[0], 0);
    cw_render_merge(&part[1], &part[2], 1);
    for (int i = 0; i < one.columns * one.rows; i++) {
      assert_int_equal(one.group[i], part[1].group[i]);
      if (one.group[i]) assert_int_equal(one.colour[i], part[1].colour[i]);
    }
    int moving = 0;
    for (int i = 0; i < one.width * one.height; i++) {
      for (int c = 0; c < 2; c++) assert_true(one.velocity[i][c] == part[1].velocity[i][c]);
      const int sample = CW_RENDER_SAMPLES * (i / one.width * one.columns + i % one.width);
      if (!one.group[sample]) continue;
      assert_int_equal(one.group[sample], 1 + one.velocity[i][0] + 200 * one.velocity[i][1]); // by the last paint
      moving++;
    }
    assert_true(moving > 500);
    for (int k = 0; k < 3; k++) cw_render_free(&part[k]);
    cw_render_free(&one);
  }
}

static void hollows_are_dark_and_slanted_planes_are_not(void **state) {
  CwCanvas canvas;
  const double floor[4][3] = {{0, 0, 0}, {40, 0, 40}, {40, 40, 40}, {0, 40, 0}};
  assert_int_equal(cw_render_start(40, 40, WHITE, 1, &canvas), CW_OK);
  cw_render_polygon(&canvas, floor, 4, &red);
  cw_render_occlusion(&canvas, 6, 1);
  assert_int_equal(count_colour(&canvas, RED), 80 * 80);
  // A groove: two slopes that meet at x = 20.
  const double down[4][3] = {{0, 0, 50}, {20, 0, 30}, {20, 40, 30}, {0, 40, 50}};
  const double up[4][3] = {{20, 0, 30}, {40, 0, 50}, {40, 40, 50}, {20, 40, 30}};
  cw_render_polygon(&canvas, down, 4, &red);
  cw_render_polygon(&canvas, up, 4, &red);
  cw_render_occlusion(&canvas, 6, 1);
  assert_true((sample(&canvas, 20, 20) >> 16) < 0.8 * (RED >> 16));
  assert_int_equal(sample(&canvas, 10, 20), RED);
  cw_render_free(&canvas);
}

static void png_holds_the_averaged_picture(void **state) {
  CwCanvas canvas;
  CwPng png;
  // The edge runs through the middle of the pixels of column 5: half white, half red.
  const double half[4][3] = {{0, 0, 0}, {5.5, 0, 0}, {5.5, 40, 0}, {0, 40, 0}};
  assert_int_equal(cw_render_start(60, 40, WHITE, 0, &canvas), CW_OK);
  cw_render_polygon(&canvas, half, 4, &red);
  assert_int_equal(cw_render_png(&canvas, NULL, &png), CW_OK);
  cairo_surface_t *surface = png_surface(&png);
  assert_int_equal(cairo_image_surface_get_width(surface), 60);
  assert_int_equal(cairo_image_surface_get_height(surface), 40);
  assert_int_equal(png_pixel(surface, 4, 0), RED);
  assert_int_equal(png_pixel(surface, 6, 0), WHITE);
  assert_int_equal(png_pixel(surface, 5, 0), 0xe09088); // (0xc0 + 0xff) / 2 and so on, rounded up
  cairo_surface_destroy(surface);
  // With a scale bar there is ink at the lower left, and the bytes are the same each time.
  CwAnnotation annotation = {.metres_per_pixel = 1e-3,
                             .axis_count = 1,
                             .axis = {{"x", {1, 0}}},
                             .frame_count = 1,
                             .frame = {{"a", 30, 5, 10, 10}}};
  CwPng marked, again;
  assert_int_equal(cw_render_png(&canvas, &annotation, &marked), CW_OK);
  assert_int_equal(cw_render_png(&canvas, &annotation, &again), CW_OK);
  assert_int_equal(marked.size, again.size);
  assert_memory_equal(marked.bytes, again.bytes, marked.size);
  assert_true(marked.size != png.size || memcmp(marked.bytes, png.bytes, png.size) != 0);
  cw_png_free(&png);
  cw_png_free(&marked);
  cw_png_free(&again);
  cw_render_free(&canvas);
}

static void lengths_of_scale_bars_are_round(void **state) {
  assert_near(cw_render_round_length(0.0734), 0.05, 1e-12);
  assert_near(cw_render_round_length(0.0499), 0.02, 1e-12);
  assert_near(cw_render_round_length(1.999), 1, 1e-12);
  assert_near(cw_render_round_length(0.02), 0.02, 1e-12);
  assert_near(cw_render_round_length(3e-7), 2e-7, 1e-18);
}

// A square of 6 px, and beside it what is left of a rectangle that it covers in part.
static void groups_have_their_middles(void **state) {
  CwCanvas canvas;
  CwGroupMiddle middle[3] = {{0}};
  const double behind[4][3] = {{2, 2, 0}, {12, 2, 0}, {12, 8, 0}, {2, 8, 0}};
  const double before[4][3] = {{2, 2, 0}, {8, 2, 0}, {8, 8, 0}, {2, 8, 0}};
  assert_int_equal(cw_render_start(20, 12, WHITE, 0, &canvas), CW_OK);
  cw_render_polygon(&canvas, behind, 4, &blue);
  cw_render_polygon(&canvas, before, 4, &red);
  assert_int_equal(cw_render_middles(&canvas, 3, middle), CW_OK);
  assert_near(middle[0].depth, 3, 0);
  assert_near(middle[0].x, 5, 0.3);
  assert_near(middle[0].y, 5, 0.3);
  assert_near(middle[1].depth, 2, 0);
  assert_near(middle[1].x, 10, 0.3);
  assert_near(middle[1].y, 5, 1.3);
  assert_near(middle[2].depth, 0, 0);
  cw_render_free(&canvas);
}

static void camera_projects_and_fits(void **state) {
  CwCamera camera = {.width = 200, .height = 100, .metres_per_pixel = 0.01};
  double pixel[3];
  // From -z with x up: y points to the right.
  cw_camera_turn(&camera, (double[3]){0, 0, -3}, (double[3]){2, 0, -1});
  cw_camera_project(&camera, (double[3]){0.1, 0.2, 0.3}, pixel);
  assert_near(pixel[0], 120, 1e-9);
  assert_near(pixel[1], 40, 1e-9);
  assert_near(pixel[2], -0.3, 1e-12);
  CwCameraReach reach = {0};
  cw_camera_reach(&camera, (double[3]){1, 2, 5}, &reach);
  cw_camera_reach(&camera, (double[3]){3, 6, -5}, &reach);
  cw_camera_fit(&camera, &reach, 10);
  // 4 m over 180 px, 2 m over 80 px: the height decides.
  assert_near(camera.metres_per_pixel, 0.025, 1e-12);
  cw_camera_project(&camera, (double[3]){3, 4, 0}, pixel);
  assert_near(pixel[0], 100, 1e-9);
  assert_near(pixel[1], 10, 1e-9);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(triangle_fills_its_area),
      cmocka_unit_test(neighbours_leave_no_gap_and_turn_does_not_matter),
      cmocka_unit_test(nearer_triangle_wins_with_a_depth_buffer),
      cmocka_unit_test(only_the_asked_edges_are_drawn),
      cmocka_unit_test(short_edges_keep_their_neighbours),
      cmocka_unit_test(what_lies_outside_is_left_out),
      cmocka_unit_test(outlines_follow_groups_and_depth_steps),
      cmocka_unit_test(merged_canvases_are_as_one),
      cmocka_unit_test(hollows_are_dark_and_slanted_planes_are_not),
      cmocka_unit_test(png_holds_the_averaged_picture),
      cmocka_unit_test(lengths_of_scale_bars_are_round),
      cmocka_unit_test(groups_have_their_middles),
      cmocka_unit_test(camera_projects_and_fits),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
