// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "geometry/hydraulic_design.h"
#include "geometry/picture.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

// Each picture is whole, has no undefined number and no point outside its sheet.
static void check(CwStatus (*draw)(const CwDesign *, const char *), const CwDesign *design, const char *words) {
  const char *path = in_test_folder("picture.svg");
  if (draw(design, path) != CW_OK) fail_msg("%s", cw_fail_message());
  char *text = read_whole(path, NULL);
  unlink(path);
  assert_int_equal(strncmp(text, "<svg ", 5), 0);
  assert_string_equal(text + strlen(text) - 7, "</svg>\n");
  assert_null(strstr(text, "nan"));
  assert_null(strstr(text, "inf"));
  assert_non_null(strstr(text, words));
  double width = 0, height = 0;
  assert_int_equal(sscanf(strstr(text, "viewBox"), "viewBox=\"0 0 %lf %lf", &width, &height), 2);
  int points = 0;
  for (const char *list = text; (list = strstr(list, "points=\"")) != NULL;) {
    list += 8;
    double x, y;
    int used;
    while (sscanf(list, "%lf,%lf%n", &x, &y, &used) == 2) {
      assert_true(x >= 0 && x <= width && y >= 0 && y <= height);
      list += used;
      points++;
    }
  }
  assert_true(points > 10);
  free(text);
}

static void pictures(void **state) {
  const CwCase table = paper();
  const CwDesign design = design_of(&table);
  check(cw_picture_meridional, &design, "D2 = 200.0 mm");
  check(cw_picture_blade_plan, &design, "wrap 71.0, beta1");
  check(cw_picture_velocity_triangles, &design, "u = 15.18");
  check(cw_picture_blade_angle, &design, "mid-span");
  check(cw_picture_volute_sections, &design, "360 deg: ");
  check(cw_picture_volute_plan, &design, "D3 = 204.0 mm; throat 890 mm2");
}

// gamma = 0.98 (1 - 0.8091/3.505) = 0.754: the slip is 0.246 15.18 = 3.74 m/s, whatever the blades block.
static void slip_is_that_of_the_slip_factor(void **state) {
  const CwCase table = paper();
  const CwDesign design = design_of(&table);
  const double slip = (1 - design.slip_factor) * design.impeller_tip_speed;
  char words[40];
  assert_near(slip, 3.74, 0.02);
  snprintf(words, sizeof words, "slip %.2f", slip);
  check(cw_picture_velocity_triangles, &design, words);
}

// The blades end at the outlet diameter, by the circle of the interface's radius.
static void blades_end_at_the_outlet_diameter(void **state) {
  const CwCase table = paper();
  const CwDesign design = design_of(&table);
  double centre[2], circle, x, y, most = 0;
  int used;
  assert_int_equal(cw_picture_blade_plan(&design, in_test_folder("blades.svg")), CW_OK);
  char *text = read_whole(in_test_folder("blades.svg"), NULL);
  unlink(in_test_folder("blades.svg"));
  assert_int_equal(
      sscanf(strstr(text, "<circle"), "<circle cx=\"%lf\" cy=\"%lf\" r=\"%lf", centre, centre + 1, &circle), 3);
  for (const char *list = text; (list = strstr(list, "<polygon fill=\"#d6e8f2\""));)
    for (list = strstr(list, "points=\"") + 8; sscanf(list, "%lf,%lf%n", &x, &y, &used) == 2; list += used)
      most = fmax(most, hypot(x - centre[0], y - centre[1]) / circle * design.interface_radius);
  assert_true(fabs(most / (design.outlet_diameter / 2) - 1) < 1e-3);
  free(text);
}

// How far down the last text stands that begins so, px.
static double height_of_text(const char *svg, const char *start) {
  const char *found = NULL;
  double y = NAN;
  for (const char *at = svg; (at = strstr(at, start)); at++) found = at;
  assert_non_null(found);
  while (strncmp(found, "<text", 5)) found--;
  assert_int_equal(sscanf(found, "<text x=\"%*f\" y=\"%lf", &y), 1);
  return y;
}

// Of the outlet's triangle, the last: the name of w stands above u, below which that of u stands alone.
static void names_of_arrows_stand_apart(void **state) {
  const CwCase table = paper();
  const CwDesign design = design_of(&table);
  assert_int_equal(cw_picture_velocity_triangles(&design, in_test_folder("names.svg")), CW_OK);
  char *text = read_whole(in_test_folder("names.svg"), NULL);
  unlink(in_test_folder("names.svg"));
  assert_true(height_of_text(text, ">w = ") < height_of_text(text, ">u = ") - 20);
  free(text);
}

static void text_is_escaped(void **state) {
  CwPicture picture = {0};
  assert_int_equal(cw_picture_begin(&picture, in_test_folder("escape.svg"), 10, 10), CW_OK);
  cw_picture_text(&picture, CW_TEXT_LEFT, 1, 1, "%s", "a<b & c>d");
  assert_int_equal(cw_picture_end(&picture), CW_OK);
  char *text = read_whole(in_test_folder("escape.svg"), NULL);
  assert_non_null(strstr(text, "a&lt;b &amp; c&gt;d"));
  free(text);
  unlink(in_test_folder("escape.svg"));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(pictures), cmocka_unit_test(slip_is_that_of_the_slip_factor),
                                     cmocka_unit_test(blades_end_at_the_outlet_diameter),
                                     cmocka_unit_test(names_of_arrows_stand_apart), cmocka_unit_test(text_is_escaped)};
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
