// SPDX-License-Identifier: AGPL-3.0-or-later
// The data of the picture that turns, as the browser reads them, and its controls.
#include "pipeline/report/colour_scale.h"
#include "pipeline/report/page_texts.h"
#include "tests/pipeline/page_text.h"

static CwCase table = {.impeller.rotation = CW_ROTATION_COUNTER_CLOCKWISE};
static CwModelPatch patches[] = {{.name = "shroud", .kind = CW_PATCH_WALL},
                                 {.name = "hub_nut", .kind = CW_PATCH_WALL},
                                 {.name = "odd_wall", .kind = CW_PATCH_WALL, .domain = 1},
                                 {.name = "outlet", .kind = CW_PATCH_OUTLET, .domain = 1}};
static const CwMesh mesh = {.domain_count = 2,
                            .domains = {{.name = "rotor", .rotating = 1, .patch_count = 2},
                                        {.name = "stator", .first_patch = 2, .patch_count = 2}},
                            .patch_count = 4,
                            .patches = patches};

// The bytes of a text in base 64 (RFC 4648), and how many.
static size_t decoded(const char *text, unsigned char *bytes) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  unsigned held = 0;
  int bits = 0;
  size_t count = 0;
  for (; *text && *text != '='; text++) {
    const char *digit = strchr(digits, *text);
    assert_non_null(digit);
    held = held << 6 | (unsigned)(digit - digits);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes[count++] = (unsigned char)(held >> bits & 255);
  }
  return count;
}

// What the page hands to the browser.
static json_t *data_of(const char *page) {
  const char *from = strstr(page, "id=\"view-data\">"), *to = from ? strstr(from, "</script>") : NULL;
  json_error_t error;
  assert_non_null(to);
  from += strlen("id=\"view-data\">");
  json_t *data = json_loadb(from, (size_t)(to - from), 0, &error);
  if (!data) fail_msg("line %d: %s", error.line, error.text);
  return data;
}

static const char *text_in(const json_t *object, const char *key) {
  const char *text = json_string_value(json_object_get(object, key));
  assert_non_null(text);
  return text;
}

static json_t *part_in(const json_t *data, size_t part) {
  return json_array_get(json_object_get(data, "parts"), part);
}

static double points[2][4][3] = {{{-0.1, 0, 0.02}, {0.1, 0.05, 0.02}, {0, 0.123, -0.01}, {0.3, 0.4, 0.5}},
                                 {{0.05, -0.2, 0}, {0.2, 0.1, 0.01}, {0.2, 0.1, 0.02}}};
static int32_t corners[2][3][3] = {{{0, 1, 2}, {2, 1, 3}, {0, 2, 3}}, {{2, 0, 1}}};
static unsigned char values[] = {0, 128, 255, 7};

// The second has values of the first quantity. Patches: the hub's nut and a wall that no one knows.
static void make_parts(CwViewPart part[2]) {
  for (int k = 0; k < 2; k++)
    part[k] = (CwViewPart){.patch = k + 1,
                           .point_count = k ? 3 : 4,
                           .triangle_count = k ? 1 : 3,
                           .points = points[k],
                           .corners = corners[k]};
  part[1].values[0] = values;
}

// Points lie on a lattice of 16 bits along the longest side of all of them, 0.6 m from -0.2 to 0.4 along y: no further
// off than half of its step.
static void the_browser_gets_the_points(void **state) {
  CwViewPart part[2];
  unsigned char bytes[100];
  make_parts(part);
  const CwReportData data = {.table = &table, .mesh = mesh, .view = {.part = part, .part_count = 2}};
  char *page = page_of(cw_page_view, &data);
  json_t *read = data_of(page);
  const double step = json_number_value(json_object_get(read, "step"));
  assert_near(step, 0.6 / 65535, 1e-13);
  for (size_t k = 0; k < 2; k++) {
    assert_int_equal(decoded(text_in(part_in(read, k), "points"), bytes), 6 * part[k].point_count);
    for (int p = 0; p < part[k].point_count; p++)
      for (int i = 0; i < 3; i++) {
        const double least = json_number_value(json_array_get(json_object_get(read, "least"), (size_t)i));
        const int at = bytes[6 * p + 2 * i] | bytes[6 * p + 2 * i + 1] << 8; // the lower byte first
        assert_near(least + step * at, points[k][p][i], 0.501 * step);
      }
    assert_int_equal(decoded(text_in(part_in(read, k), "corners"), bytes), 6 * part[k].triangle_count);
    for (int t = 0; t < part[k].triangle_count; t++)
      for (int c = 0; c < 3; c++)
        assert_int_equal(bytes[6 * t + 2 * c] | bytes[6 * t + 2 * c + 1] << 8, corners[k][t][c]);
    assert_int_equal(json_integer_value(json_object_get(part_in(read, k), "wide")), 0);
  }
  json_decref(read);
  free(page);
}

static void the_browser_gets_values_and_colours(void **state) {
  CwViewPart part[2];
  unsigned char bytes[800];
  make_parts(part);
  CwReportData data = {.table = &table, .mesh = mesh, .view = {.part = part, .part_count = 2}};
  char *page = page_of(cw_page_view, &data);
  json_t *read = data_of(page);
  assert_int_equal(json_array_size(json_object_get(read, "parts")), 2);
  for (size_t k = 0; k < 2; k++) {
    const json_t *list = json_object_get(part_in(read, k), "values");
    assert_int_equal(json_array_size(list), CW_VIEW_QUANTITIES);
    assert_int_equal(decoded(json_string_value(json_array_get(list, 0)), bytes), k ? 3 : 0);
    if (k) assert_memory_equal(bytes, values, 3);
    assert_string_equal(json_string_value(json_array_get(list, 1)), "");
    assert_int_equal(json_integer_value(json_object_get(part_in(read, k), "shown")), 1);
  }
  assert_int_equal(json_integer_value(json_object_get(part_in(read, 0), "colour")), cw_patch_colour("hub_nut", 1));
  assert_int_equal(json_integer_value(json_object_get(part_in(read, 1), "colour")), cw_region_colour(0));
  assert_int_equal(decoded(text_in(read, "scale"), bytes), 3 * 256);
  for (int k = 0; k < 256; k++)
    assert_int_equal(bytes[3 * k] << 16 | bytes[3 * k + 1] << 8 | bytes[3 * k + 2], cw_colour_scale(k / 255.));
  assert_int_equal(json_integer_value(json_object_get(read, "suction")), -1);
  json_decref(read);
  free(page);
  table.impeller.rotation = CW_ROTATION_CLOCKWISE;
  page = page_of(cw_page_view, &data);
  read = data_of(page);
  assert_int_equal(json_integer_value(json_object_get(read, "suction")), 1);
  json_decref(read);
  free(page);
  table.impeller.rotation = CW_ROTATION_COUNTER_CLOCKWISE;
}

// With more points than 16 bits can number, corners have 32.
static void many_points_have_wide_corners(void **state) {
  enum { MANY = 65537 };
  static double many[MANY][3];
  static int32_t last[1][3] = {{MANY - 1, 0, 300}};
  unsigned char bytes[20];
  for (int k = 0; k < MANY; k++) many[k][0] = k;
  for (int wide = 0; wide < 2; wide++) {
    CwViewPart part = {.patch = 2, .point_count = MANY - !wide, .triangle_count = 1, .points = many, .corners = last};
    last[0][0] = part.point_count - 1;
    const CwReportData data = {.table = &table, .mesh = mesh, .view = {.part = &part, .part_count = 1}};
    char *page = page_of(cw_page_view, &data);
    json_t *read = data_of(page);
    assert_int_equal(json_integer_value(json_object_get(part_in(read, 0), "wide")), wide);
    assert_int_equal(decoded(text_in(part_in(read, 0), "corners"), bytes), wide ? 12 : 6);
    for (int c = 0; c < 3; c++) {
      int corner = 0;
      for (int b = wide ? 3 : 1; b >= 0; b--) corner = corner << 8 | bytes[(wide ? 4 : 2) * c + b];
      assert_int_equal(corner, last[0][c]);
    }
    json_decref(read);
    free(page);
  }
}

// A box for each part, under its zone, and what can be chosen.
static void parts_can_be_switched(void **state) {
  CwViewPart part[4];
  make_parts(part);
  part[2] = (CwViewPart){.patch = 3};
  part[3] = (CwViewPart){.patch = 0};
  char line[300];
  CwReportData data = {.table = &table, .mesh = mesh, .view = {.part = part, .part_count = 4}};
  char *page = page_of(cw_page_view, &data);
  assert_holds(page, "<figure id=\"view\" class=\"turning\" data-triangles=\"4\">");
  assert_holds(page, "inlet and outlet of the mesh: 4 triangles.");
  assert_null(strstr(page, "decimated"));
  const char *rotor = strstr(page, "<legend>Rotor</legend>"), *stator = strstr(page, "<legend>Stator</legend>");
  assert_true(rotor && stator && rotor < stator);
  static const struct {
    int patch, checked;
    const char *label;
  } boxes[] = {{1, 1, "Hub nut"}, {2, 1, "Odd wall"}, {3, 0, "Outlet"}, {0, 0, "Shroud"}};
  for (int k = 0; k < 4; k++) {
    const int in_stator = boxes[k].patch >= 2;
    snprintf(line, sizeof line,
             "<label><input type=\"checkbox\" data-part=\"%d\"%s><i style=\"background:#%06x\"></i>%s</label>\n", k,
             boxes[k].checked ? " checked" : "",
             (unsigned)cw_patch_colour(patches[boxes[k].patch].name, boxes[k].patch - 2 * in_stator), boxes[k].label);
    assert_holds(page, line);
    assert_int_equal(strstr(page, line) > stator, in_stator);
  }
  assert_null(strstr(page, "name=\"colour\"")); // nothing was solved
  assert_holds(page, cw_page_viewer);
  free(page);
  data.view.decimated = 1;
  data.view.quantity_count = 2;
  data.view.quantity[0] = (CwViewQuantity){"pressure", "pressure, kPa", {0, 8, 0}};
  data.view.quantity[1] = (CwViewQuantity){"y+", "y<sup>+</sup>", {1, 100, 1}};
  page = page_of(cw_page_view, &data);
  assert_holds(page, "of the mesh, decimated to 4 triangles.");
  assert_holds(page, "<option value=\"-1\">patches</option><option value=\"0\">pressure</option>"
                     "<option value=\"1\">y+</option></select>");
  assert_holds(page, "<div data-bar=\"0\" hidden>");
  assert_holds(page, "<div data-bar=\"1\" hidden>");
  free(page);
}

// Parts without a point do no harm; without parts there is no picture.
static void empty_views_are_whole(void **state) {
  CwViewPart part = {.patch = 2};
  CwReportData data = {.table = &table, .mesh = mesh, .view = {.part = &part, .part_count = 1}};
  char *page = page_of(cw_page_view, &data);
  json_t *read = data_of(page);
  assert_near(json_number_value(json_object_get(read, "step")), 0, 0);
  assert_string_equal(text_in(part_in(read, 0), "points"), "");
  json_decref(read);
  free(page);
  data.view.part_count = 0;
  page = page_of(cw_page_view, &data);
  assert_string_equal(page, "");
  free(page);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_browser_gets_the_points),   cmocka_unit_test(the_browser_gets_values_and_colours),
      cmocka_unit_test(many_points_have_wide_corners), cmocka_unit_test(parts_can_be_switched),
      cmocka_unit_test(empty_views_are_whole),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
