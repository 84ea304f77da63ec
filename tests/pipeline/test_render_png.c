// SPDX-License-Identifier: AGPL-3.0-or-later
// What is written over a picture, pixel by pixel as cairo reads it back.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/report/render.h"
#include "tests/pipeline/png_surface.h"
#include "tests/unit_test.h"

enum { WIDTH = 300, HEIGHT = 200, WHITE = 0xffffff, GREY = 0x707880 };

static uint32_t pixels[HEIGHT][WIDTH];

// Draws the annotation over a canvas, and reads the picture.
static void draw_on(const CwCanvas *canvas, const CwAnnotation *annotation) {
  CwPng png;
  assert_int_equal(cw_render_png(canvas, annotation, &png), CW_OK);
  cairo_surface_t *surface = png_surface(&png);
  assert_int_equal(cairo_image_surface_get_width(surface), WIDTH);
  assert_int_equal(cairo_image_surface_get_height(surface), HEIGHT);
  for (int j = 0; j < HEIGHT; j++)
    for (int i = 0; i < WIDTH; i++) pixels[j][i] = png_pixel(surface, i, j);
  cairo_surface_destroy(surface);
  cw_png_free(&png);
}

// On a white picture.
static void draw_alone(const CwAnnotation *annotation) {
  CwCanvas canvas;
  assert_int_equal(cw_render_start(WIDTH, HEIGHT, WHITE, 0, &canvas), CW_OK);
  draw_on(&canvas, annotation);
  cw_render_free(&canvas);
}

// The box of all pixels that are darker than half, from `least` to `most`; 0 where there are none.
static int box_of_ink(int least[2], int most[2]) {
  int count = 0;
  for (int j = 0; j < HEIGHT; j++)
    for (int i = 0; i < WIDTH; i++) {
      if ((pixels[j][i] >> 8 & 255) >= 128) continue;
      const int at[2] = {i, j};
      for (int k = 0; k < 2; k++) {
        if (!count || at[k] < least[k]) least[k] = at[k];
        if (!count || at[k] > most[k]) most[k] = at[k];
      }
      count++;
    }
  return count;
}

static void nothing_is_written_unasked(void **state) {
  int least[2], most[2];
  const CwAnnotation empty = {0};
  draw_alone(&empty);
  assert_int_equal(box_of_ink(least, most), 0);
  draw_alone(NULL);
  assert_int_equal(box_of_ink(least, most), 0);
}

// The longest round length up to 0.22 of the width: of 66 mm 50, of 132 mm 100, of 26.4 mm 20.
static void the_scale_bar_is_as_long_as_it_says(void **state) {
  static const double metres_per_pixel[] = {1e-3, 2e-3, 4e-4}, metres[] = {0.05, 0.1, 0.02};
  for (int k = 0; k < 3; k++) {
    const CwAnnotation bar = {.metres_per_pixel = metres_per_pixel[k]};
    int least[2], most[2];
    draw_alone(&bar);
    assert_true(box_of_ink(least, most) > 50);
    // From 16 px at the left, on a line 16 px over the lower edge.
    const int end = 16 + (int)(metres[k] / metres_per_pixel[k] + 0.5), line = HEIGHT - 16;
    for (int i = 18; i < end - 1; i++) assert_true((pixels[line - 1][i] & 255) < 128 || (pixels[line][i] & 255) < 128);
    assert_in_range(least[0], 14, 16);
    assert_in_range(most[1], line - 1, line + 1);
    for (int i = end + 2; i < WIDTH; i++) assert_int_equal(pixels[line][i] & 255, 255);
    assert_true((pixels[line - 3][end] & 255) < 200 || (pixels[line - 3][end - 1] & 255) < 200); // the tick at its end
    assert_true((pixels[line - 3][16] & 255) < 200 || (pixels[line - 3][15] & 255) < 200);
  }
}

// Arrows 30 px long from 62 px before the lower right corner, with a name behind the head; none along the view.
static void axes_point_along_their_directions(void **state) {
  static const struct {
    double direction[2];
    int right, up; // which way the ink reaches
  } axes[] = {{{1, 0}, 1, 0}, {{-1, 0}, -1, 0}, {{0, -1}, 0, 1}, {{0, 1}, 0, -1}};
  const int x = WIDTH - 62, y = HEIGHT - 62;
  for (int k = 0; k < 4; k++) {
    const CwAnnotation one = {.axis = {{"x", {axes[k].direction[0], axes[k].direction[1]}}}, .axis_count = 1};
    int least[2], most[2];
    draw_alone(&one);
    assert_true(box_of_ink(least, most) > 30);
    const int reach[2][2] = {{x - least[0], most[0] - x}, {most[1] - y, y - least[1]}}; // left, right; down, up
    for (int a = 0; a < 2; a++) {
      const int towards = a ? axes[k].up : axes[k].right;
      if (towards > 0) assert_true(reach[a][1] > 35 && reach[a][1] < 60 && reach[a][0] < 10);
      if (towards < 0) assert_true(reach[a][0] > 35 && reach[a][0] < 60 && reach[a][1] < 10);
      if (towards == 0) assert_true(reach[a][0] < 12 && reach[a][1] < 12);
    }
  }
  // Half as long where it is seen at 60 degrees.
  const CwAnnotation half = {.axis = {{"", {0.5, 0}}}, .axis_count = 1},
                     along = {.axis = {{"z", {0.05, 0}}}, .axis_count = 1};
  int least[2], most[2];
  draw_alone(&half);
  assert_true(box_of_ink(least, most) > 10);
  assert_in_range(most[0], x + 15, x + 22);
  draw_alone(&along);
  assert_int_equal(box_of_ink(least, most), 0);
}

static int is_red(int i, int j) {
  return (pixels[j][i] >> 16 & 255) > (pixels[j][i] >> 8 & 255) + 60;
}

// A red frame, its letter at the right of it.
static void frames_are_red(void **state) {
  const CwAnnotation frame = {.frame = {{"a", 50, 40, 60, 30}}, .frame_count = 1};
  int least[2], most[2];
  draw_alone(&frame);
  for (int i = 52; i < 108; i++) {
    assert_true(is_red(i, 40) || is_red(i, 39));
    assert_true(is_red(i, 70) || is_red(i, 69));
    assert_false(is_red(i, 55)); // hollow
  }
  for (int j = 42; j < 68; j++) {
    assert_true(is_red(50, j) || is_red(49, j));
    assert_true(is_red(110, j) || is_red(109, j));
  }
  for (int j = 0; j < HEIGHT; j++)
    for (int i = 0; i < WIDTH; i++)
      if (i < 47 || i > 113 || j < 37 || j > 73) assert_false(is_red(i, j));
  for (int j = 36; j < 74; j++) // ink alone
    for (int i = 47; i < 114; i++) pixels[j][i] = WHITE;
  assert_true(box_of_ink(least, most) > 5);
  assert_true(least[0] >= 114 && most[0] < 135 && least[1] > 36 && most[1] < 60);
}

// A text stands with its middle where it is asked.
static void labels_stand_in_the_middle(void **state) {
  static const char *const texts[] = {"8", "17", "108"};
  for (int k = 0; k < 3; k++) {
    CwLabel label = {.x = 120, .y = 90};
    int least[2], most[2];
    strcpy(label.text, texts[k]);
    const CwAnnotation one = {.label = &label, .label_count = 1};
    draw_alone(&one);
    assert_true(box_of_ink(least, most) > 10);
    assert_near(0.5 * (least[0] + most[0] + 1), 120, 1.6);
    assert_near(0.5 * (least[1] + most[1] + 1), 90, 1.6);
    assert_in_range(most[1] - least[1], 8, 16);
  }
}

// A grey canvas with a flow over all of it.
static void start_flow(CwCanvas *canvas, float right, float down) {
  const CwPaint paint = {.colour = GREY, .group = 1, .velocity = {right, down}};
  const double p[4][3] = {{0, 0, 0}, {WIDTH, 0, 0}, {WIDTH, HEIGHT, 0}, {0, HEIGHT, 0}};
  assert_int_equal(cw_render_start(WIDTH, HEIGHT, WHITE, 0, canvas), CW_OK);
  assert_int_equal(cw_render_keep_velocity(canvas), CW_OK);
  cw_render_polygon(canvas, p, 4, &paint);
}

static int light_at(int i, int j) {
  return (pixels[j][i] & 255) > 0x80 + 30;
}

// In a parallel flow lines are straight, about so far apart, and arrow heads widen against the flow.
static void streamlines_follow_the_flow(void **state) {
  for (int turn = 0; turn < 4; turn++) {
    CwCanvas canvas;
    const int vertical = turn % 2, back = turn / 2;
    const float v = back ? -3 : 3;
    start_flow(&canvas, vertical ? 0 : v, vertical ? v : 0);
    const CwAnnotation lines = {.streamlines_apart = 20};
    draw_on(&canvas, &lines);
    cw_render_free(&canvas);
    // Runs of light pixels across the flow, in the mean along it: lines lie about 20 px apart, less than twice that,
    // and nothing joins them.
    const int across = vertical ? WIDTH : HEIGHT, along = vertical ? HEIGHT : WIDTH;
    double count = 0;
    for (int l = 0; l < along; l++)
      for (int a = 0, before = 0; a < across; a++) {
        const int light = vertical ? light_at(a, l) : light_at(l, a);
        count += (double)(light && !before) / along;
        before = light;
      }
    assert_true(count > 0.5 * across / 20 && count < 1.1 * across / 20);
    // The heads: how wide a line is, upstream and downstream of its widest place.
    int widest = 0, place = 0;
    for (int l = along / 4; l < along - along / 4; l++) {
      int light = 0;
      for (int a = 0; a < across; a++) light += vertical ? light_at(a, l) : light_at(l, a);
      if (light > widest) widest = light, place = l;
    }
    assert_true(widest > 2 * count);
    int sides[2] = {0, 0};
    for (int step = 1; step < 7; step++)
      for (int side = 0; side < 2; side++) {
        const int l = place + (side ? step : -step);
        for (int a = 0; a < across; a++) sides[side] += vertical ? light_at(a, l) : light_at(l, a);
      }
    assert_true(back ? sides[0] > sides[1] : sides[1] > sides[0]); // from the widest place on it narrows downstream
  }
}

// Streamlines are there only where they are asked, and where the canvas has velocities.
static void a_flow_without_lines_is_a_picture(void **state) {
  CwCanvas canvas;
  const CwAnnotation none = {0}, lines = {.streamlines_apart = 20};
  start_flow(&canvas, 1, 0);
  draw_on(&canvas, &none);
  for (int j = 0; j < HEIGHT; j++)
    for (int i = 0; i < WIDTH; i++) assert_int_equal(pixels[j][i], GREY);
  cw_render_free(&canvas);
  draw_alone(&lines);
  for (int j = 0; j < HEIGHT; j++)
    for (int i = 0; i < WIDTH; i++) assert_int_equal(pixels[j][i], WHITE);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(nothing_is_written_unasked),        cmocka_unit_test(the_scale_bar_is_as_long_as_it_says),
      cmocka_unit_test(axes_point_along_their_directions), cmocka_unit_test(frames_are_red),
      cmocka_unit_test(labels_stand_in_the_middle),        cmocka_unit_test(streamlines_follow_the_flow),
      cmocka_unit_test(a_flow_without_lines_is_a_picture),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
