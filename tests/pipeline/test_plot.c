// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/report/plot.h"
#include "tests/unit_test.h"

static char *drawn(void (*draw)(FILE *, const CwPlot *), const CwPlot *plot) {
  char *text = NULL;
  size_t size = 0;
  FILE *page = open_memstream(&text, &size);
  draw(page, plot);
  fclose(page);
  return text;
}

// The boxes of one colour, keys of the legend (12 x 12) left out.
static int boxes(const char *text, const char *colour, double box[][4]) {
  int count = 0;
  for (const char *at = text; (at = strstr(at, "<rect ")); at++) {
    char fill[16];
    double b[4];
    assert_int_equal(sscanf(at, "<rect x=\"%lf\" y=\"%lf\" width=\"%lf\" height=\"%lf\" fill=\"%7s", &b[0], &b[1],
                            &b[2], &b[3], fill),
                     5);
    if (!strcmp(fill, colour) && !(b[2] == 12 && b[3] == 12)) memcpy(box[count++], b, sizeof b);
  }
  return count;
}

static void steps_are_round(void **state) {
  assert_near(cw_plot_step(1), 0.2, 1e-12);
  assert_near(cw_plot_step(19), 2, 1e-12);
  assert_near(cw_plot_step(47), 5, 1e-12);
  assert_near(cw_plot_step(0.08), 0.01, 1e-12);
  assert_near(cw_plot_step(0), 1, 0);
  assert_near(cw_plot_step(NAN), 1, 0);
  for (double most = 1e-4; most < 1e6; most *= 1.37) {
    double ticks = most / cw_plot_step(most);
    assert_true(ticks > 3.999 && ticks < 10.001);
  }
}

static void columns_are_as_high_as_their_values(void **state) {
  static const CwPlotCategory category[] = {{.label = "a < b"}, {.label = "c"}};
  const double first[] = {10, 35}, second[] = {20, NAN};
  const CwPlotSeries series[] = {{"first & last", 0x112233, first}, {"second", 0x445566, second}};
  CwPlot plot = {.axis = "% of all",
                 .category = category,
                 .count = 2,
                 .series = series,
                 .series_count = 2,
                 .decimals = 1,
                 .width = 400,
                 .caption = "a <b>caption</b>"};
  double box[8][4];
  char *text = drawn(cw_plot_columns, &plot);
  assert_int_equal(boxes(text, "#112233", box), 2);
  assert_near(box[1][3] / box[0][3], 3.5, 1e-3);
  assert_near(box[0][1] + box[0][3], box[1][1] + box[1][3], 0.02); // on one base line
  double height = box[0][3];
  assert_int_equal(boxes(text, "#445566", box), 1); // no value, no column
  assert_near(box[0][3], 2 * height, 0.02);
  assert_near(height, 200 * 10 / 35.0, 0.01); // the axis ends at 35 = 7 steps of 5
  assert_non_null(strstr(text, ">a &lt; b<"));
  assert_non_null(strstr(text, ">first &amp; last<"));
  assert_non_null(strstr(text, ">35.0<"));
  assert_non_null(strstr(text, ">% of all<"));
  assert_non_null(strstr(text, "<figcaption>a <b>caption</b></figcaption></figure>"));
  assert_null(strstr(text, "nan"));
  free(text);
}

// Where the words, between > and <, begin; 0 where they are not.
static double note_place(const char *text, const char *words) {
  double place = 0;
  for (const char *at = text; (at = strstr(at, "<text x=\"")); at++) {
    const char *shown = strchr(at, '>');
    if (shown && !strncmp(shown, words, strlen(words))) place = atof(at + strlen("<text x=\""));
  }
  return place;
}

static void bars_are_stacked_and_noted(void **state) {
  static const CwPlotCategory category[] = {{"one", "30 s"}, {"two", "60 s"}};
  const double first[] = {10, 20}, second[] = {20, 40};
  const CwPlotSeries series[] = {{"p", 0x112233, first}, {"q", 0x445566, second}};
  CwPlot plot = {.axis = "s",
                 .category = category,
                 .count = 2,
                 .series = series,
                 .series_count = 2,
                 .mark = 45,
                 .width = 500,
                 .caption = "a <b>caption</b>"};
  double p[4][4], q[4][4];
  char *text = drawn(cw_plot_bars, &plot);
  assert_int_equal(boxes(text, "#112233", p), 2);
  assert_int_equal(boxes(text, "#445566", q), 2);
  for (int k = 0; k < 2; k++) {
    assert_near(q[k][2], 2 * p[k][2], 0.02);
    assert_near(q[k][0], p[k][0] + p[k][2], 0.02);
    assert_near(q[k][1], p[k][1], 0);
  }
  assert_near(p[1][2], 2 * p[0][2], 0.02);
  // The line at 45 stands at three quarters of the longest bar, which is 60.
  double at = 0;
  for (const char *line = text; (line = strstr(line, "<line ")); line++) {
    const char *class = strstr(line, "class=\"");
    if (class && !strncmp(class, "class=\"m\"", 9)) at = atof(line + strlen("<line x1=\""));
  }
  assert_near(at, p[1][0] + 0.75 * (p[1][2] + q[1][2]), 0.06);
  assert_true(note_place(text, ">60 s<") > q[1][0] + q[1][2]);
  free(text);
  plot.mark = 32; // just behind the first bar: its note stands behind the line
  text = drawn(cw_plot_bars, &plot);
  assert_true(note_place(text, ">30 s<") > p[1][0] + 32.0 / 60 * (p[1][2] + q[1][2]));
  free(text);
}

static void an_empty_plot_is_a_plot(void **state) {
  const CwPlotSeries series[] = {{"none", 0x112233, NULL}};
  CwPlot plot = {
      .axis = "s", .count = 0, .series = series, .series_count = 1, .width = 300, .caption = "a <b>caption</b>"};
  for (int k = 0; k < 2; k++) {
    char *text = drawn(k ? cw_plot_bars : cw_plot_columns, &plot);
    assert_int_equal(strncmp(text, "<figure><svg ", 13), 0);
    assert_non_null(strstr(text, "</svg>"));
    assert_null(strstr(text, "nan"));
    assert_null(strstr(text, "inf"));
    free(text);
  }
}

// Lines over the iteration, without a mark.
static CwLinePlot plot_of(const double *x, int count, const CwPlotSeries *series, int series_count) {
  return (CwLinePlot){.axis = "m",
                      .x_axis = "iteration",
                      .x = x,
                      .count = count,
                      .series = series,
                      .series_count = series_count,
                      .mark = NAN,
                      .width = 400,
                      .caption = "a <b>caption</b>"};
}

static char *drawn_lines(const CwLinePlot *plot) {
  static char *text;
  static size_t size;
  FILE *page = open_memstream(&text, &size);
  cw_plot_lines(page, plot);
  fclose(page);
  return text;
}

// The places of the first path; 'L' or 'M' in `command`.
static int path_places(const char *text, char *command, double (*place)[2]) {
  int count = 0, used;
  const char *at = strstr(text, " d=\"");
  assert_non_null(at);
  for (at += 4; sscanf(at, "%c%lf %lf%n", &command[count], &place[count][0], &place[count][1], &used) == 3; count++)
    at += used;
  return count;
}

// A straight line stays straight, ends at the edges of the frame, and goes up where its values do.
static void lines_stand_where_their_values_are(void **state) {
  const double x[] = {10, 20, 40}, value[] = {11, 12, 14};
  const CwPlotSeries series = {"head", 0x112233, value};
  CwLinePlot plot = plot_of(x, 3, &series, 1);
  char *text = drawn_lines(&plot), command[8];
  double p[8][2];
  assert_int_equal(path_places(text, command, p), 3);
  assert_near((p[1][0] - p[0][0]) / (p[2][0] - p[0][0]), 1.0 / 3, 0.002);
  assert_near((p[1][1] - p[0][1]) / (p[2][1] - p[0][1]), 1.0 / 3, 0.002);
  assert_true(p[2][1] < p[0][1]);
  assert_null(strstr(text, "class=\"m\""));
  free(text);
  plot.mark = 10; // below all values: the axis reaches it, and the line moves up
  text = drawn_lines(&plot);
  double q[8][2];
  assert_int_equal(path_places(text, command, q), 3);
  assert_non_null(strstr(text, "class=\"m\""));
  assert_true(q[0][1] < p[0][1]);
  free(text);
}

// Also where they differ by rounding alone: one place or one value stands in the middle, between ticks.
static void one_place_stands_in_the_middle(void **state) {
  const double x[][2] = {{1, 1}, {1, 1 + 4e-16}, {0, 0}, {2e4, 2e4}}, value[] = {5, 5 + 8e-16};
  for (int k = 0; k < 4; k++) {
    for (int count = 1; count <= 2; count++) {
      const CwPlotSeries series = {"head", 0x112233, value};
      const CwLinePlot plot = plot_of(x[k], count, &series, 1);
      char *text = drawn_lines(&plot), command[8];
      double p[8][2], frame[4];
      assert_int_equal(path_places(text, command, p), count);
      assert_int_equal(sscanf(strstr(text, "<line "), "<line x1=\"%lf\" y1=\"%lf\" x2=\"%lf\" y2=\"%lf\"", &frame[0],
                              &frame[1], &frame[2], &frame[3]),
                       4);
      assert_near(p[count - 1][0], 0.5 * (frame[0] + frame[2]), 0.06);
      assert_true(strlen(text) < 6000);
      free(text);
    }
  }
}

static void logarithmic_lines_have_a_gap_at_zero(void **state) {
  const double x[] = {1, 2, 3, 4}, value[] = {1, 0, 0.01, 0.0001};
  const CwPlotSeries series = {"p", 0x112233, value};
  CwLinePlot plot = plot_of(x, 4, &series, 1);
  plot.logarithmic = 1;
  char *text = drawn_lines(&plot), command[8];
  double p[8][2];
  assert_int_equal(path_places(text, command, p), 3);
  assert_int_equal(command[1], 'M'); // begins anew behind the gap
  assert_int_equal(command[2], 'L');
  assert_near((p[1][1] - p[0][1]) / (p[2][1] - p[0][1]), 0.5, 0.01); // two of four decades
  assert_null(strstr(text, "<circle"));
  free(text);
}

// Also of a series of one value, which is no line.
static void values_that_are_marked_have_a_dot_each(void **state) {
  const double x[] = {10, 20, 40}, value[] = {11, 12, 14}, alone[] = {NAN, 14, NAN};
  const CwPlotSeries series[] = {{"solved", 0x112233, value}, {"design", 0x445566, alone}};
  CwLinePlot plot = plot_of(x, 3, series, 2);
  plot.dots = 1;
  char *text = drawn_lines(&plot), command[8], *at = text;
  double p[8][2], dot[4][2];
  assert_int_equal(path_places(text, command, p), 3);
  for (int k = 0; k < 4; k++) {
    assert_non_null(at = strstr(at, "<circle "));
    assert_int_equal(sscanf(at++, "<circle cx=\"%lf\" cy=\"%lf\"", &dot[k][0], &dot[k][1]), 2);
  }
  assert_null(strstr(at, "<circle "));
  assert_memory_equal(dot, p, 3 * sizeof *p);
  assert_near(dot[3][0], p[1][0], 0);
  assert_near(dot[3][1], p[2][1], 0);
  free(text);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(steps_are_round),
      cmocka_unit_test(columns_are_as_high_as_their_values),
      cmocka_unit_test(bars_are_stacked_and_noted),
      cmocka_unit_test(an_empty_plot_is_a_plot),
      cmocka_unit_test(lines_stand_where_their_values_are),
      cmocka_unit_test(one_place_stands_in_the_middle),
      cmocka_unit_test(logarithmic_lines_have_a_gap_at_zero),
      cmocka_unit_test(values_that_are_marked_have_a_dot_each),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
