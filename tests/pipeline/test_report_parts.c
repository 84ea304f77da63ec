// SPDX-License-Identifier: AGPL-3.0-or-later
// Numbers, pieces of HTML, cuts through cells and the survey of the boundary.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "pipeline/report/cut.h"
#include "pipeline/report/drawing.h"
#include "pipeline/report/format.h"
#include "pipeline/report/html.h"
#include "pipeline/report/picture_list.h"
#include "pipeline/report/quantity.h"
#include "pipeline/report/report_data.h"
#include "pipeline/report/survey.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

#define GAP "\342\200\257"
#define MINUS "\342\210\222"

static void numbers_read_well(void **state) {
  char text[CW_FORMAT_SIZE];
  assert_string_equal(cw_format_count(0, text), "0");
  assert_string_equal(cw_format_count(9999, text), "9999");
  assert_string_equal(cw_format_count(145000000, text), "145" GAP "000" GAP "000");
  assert_string_equal(cw_format_count(-12345, text), MINUS "12" GAP "345");
  assert_string_equal(cw_format_number(12.8692, 4, text), "12.87");
  assert_string_equal(cw_format_number(74, 5, text), "74");
  assert_string_equal(cw_format_number(0.00218, 2, text), "0.0022");
  assert_string_equal(cw_format_number(-0.5, 3, text), MINUS "0.5");
  assert_string_equal(cw_format_number(123456.7, 3, text),
                      "123" GAP "457"); // no digit before the point is lost
  assert_string_equal(cw_format_number(1.004e-6, 5, text), "1.004" GAP "\303\227" GAP "10\342\201\273\342\201\266");
  assert_string_equal(cw_format_number(9.9996, 4, text), "10");
  assert_string_equal(cw_format_number(NAN, 4, text), "\342\200\223");
  assert_string_equal(cw_format_si(301551, 3, text), "302" GAP "k");
  assert_string_equal(cw_format_si(999700, 3, text), "1" GAP "M");
  assert_string_equal(cw_format_si(42, 3, text), "42");
  assert_string_equal(cw_format_si(2.2e-4, 3, text), "220" GAP "\302\265");
  assert_string_equal(cw_format_seconds(0.0123, text), "0.012 s");
  assert_string_equal(cw_format_seconds(58.42, text), "58.4 s");
  assert_string_equal(cw_format_seconds(245, text), "4 min 05 s");
  assert_string_equal(cw_format_seconds(11220, text), "3 h 07 min");
  assert_string_equal(cw_format_bytes(107495424, text), "107 MB");
  assert_string_equal(cw_format_bytes(1e9, text), "1 GB");
  assert_string_equal(cw_format_bytes(999.4e6, text), "999 MB");
  assert_string_equal(cw_format_percent(1, text), "100 %");
  assert_string_equal(cw_format_percent(0.999999, text), "99.99 %"); // not all
  assert_string_equal(cw_format_percent(0.316, text), "31.6 %");
  assert_string_equal(cw_format_percent(0, text), "0 %");
  assert_string_equal(cw_format_percent(NAN, text), "\342\200\223");
}

// One of each unit in what it is shown in.
static void quantities_have_their_units(void **state) {
  static const struct {
    const char *key, *stem, *unit;
    double shown; // of 1 in the unit of the key
  } wanted[] = {{"flow_rate_m3_per_s", "flow_rate", "m&sup3;/h", 3600},
                {"flow_m3_per_h", "flow", "m&sup3;/h", 1},
                {"kinematic_viscosity_m2_per_s", "kinematic_viscosity", "m&sup2;/s", 1},
                {"angular_speed_rad_per_s", "angular_speed", "rad/s", 1},
                {"inlet_blade_speed_m_per_s", "inlet_blade_speed", "m/s", 1},
                {"theoretical_head_m", "theoretical_head", "m", 1},
                {"wrap_angle_deg", "wrap_angle", "&deg;", 1},
                {"throat_area_m2", "throat_area", "mm&sup2;", 1e6},
                {"least_cell_volume_m3", "least_cell_volume", "mm&sup3;", 1e9},
                {"solid_volume_m3", "solid_volume", "cm&sup3;", 1e6},
                {"outlet_diameter_m", "outlet_diameter", "mm", 1e3},
                {"shaft_power_w", "shaft_power", "W", 1},
                {"vapour_pressure_pa", "vapour_pressure", "Pa", 1},
                {"blade_count", "blade_count", "", 1}};
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
    char stem[CW_STEM_SIZE];
    const CwQuantityUnit *unit = cw_quantity_unit(wanted[i].key);
    cw_quantity_stem(wanted[i].key, stem);
    assert_string_equal(stem, wanted[i].stem);
    assert_string_equal(unit->unit, wanted[i].unit);
    assert_near(unit->scale, wanted[i].shown, 0);
  }
}

// Red, green and blue, no more; neither pale nor dark; neighbours in number differ in one of them by a fifth at least.
static void regions_have_colours_of_their_own(void **state) {
  for (int index = 0; index < 200; index++) {
    uint32_t colour = cw_region_colour(index), next = cw_region_colour(index + 1);
    int most = 0;
    assert_true(colour <= 0xffffff);
    for (int c = 0; c < 24; c += 8) {
      int value = (int)(colour >> c & 255), other = (int)(next >> c & 255);
      assert_in_range(value, 128, 240);
      if (abs(value - other) > most) most = abs(value - other);
    }
    assert_true(most > 51);
  }
}

static void html_is_escaped_and_encoded(void **state) {
  char *text = NULL;
  size_t size = 0;
  FILE *page = open_memstream(&text, &size);
  cw_html_text(page, "<b>", "<a & \"b\">", "</b>");
  cw_html_text(page, "<i>", NULL, "</i>");
  cw_html_label(page, "", "|outlet_width", "");
  cw_html_label(page, "", "outlet_width", "");
  cw_html_label(page, "", "y_plus_blade", "");
  cw_html_label(page, "", "|", "");
  cw_html_label(page, "", "npsh_required", "");
  cw_html_label(page, "", "predicted_head_wiesner", "");
  cw_html_label(page, "", "guelich", "");
  cw_html_number_cell(page, "12.87");
  cw_html_number_cell(page, "74");
  for (size_t n = 0; n < 4; n++) cw_html_base64(page, (const unsigned char *)"Man", n);
  cw_html_base64(page, (const unsigned char *)"\377\373\360", 3);
  fclose(page);
  assert_string_equal(text, "<b>&lt;a &amp; &quot;b&quot;&gt;</b><i></i>|outlet widthOutlet widthy<sup>+</sup> blade"
                            "|NPSH requiredPredicted head WiesnerG&uuml;lich"
                            "<td class=\"n\">12<span>.87</span></td><td class=\"n\">74<span></span></td>"
                            "TQ==TWE=TWFu//vw");
  free(text);
}

static CwStatus embed(const char *content, char **text) {
  const char *path = in_test_folder("drawing.svg");
  size_t size = 0;
  write_text(path, content);
  FILE *page = open_memstream(text, &size);
  CwStatus status = cw_html_svg_file(page, path);
  fclose(page);
  unlink(path);
  return status;
}

static void drawings_are_embedded_alone(void **state) {
  char *text;
  assert_int_equal(embed("<?xml version=\"1.0\"?>\n<svg width=\"3\"><rect/></svg>\n<!-- end -->", &text), CW_OK);
  assert_string_equal(text, "<svg width=\"3\"><rect/></svg>\n");
  free(text);
  static const char *const refused[] = {"", "<html></html>", "<svg width=\"3\"><rect/>",
                                        "<svg><script>x</script></svg>",
                                        "<svg><image href=\"http://a.b/c.png\"/></svg>"};
  for (size_t k = 0; k < sizeof refused / sizeof *refused; k++) {
    assert_int_equal(embed(refused[k], &text), CW_ERR_INPUT);
    assert_string_equal(text, "");
    free(text);
  }
}

static const CwCutPlane plane_z = {{0, 0, 0.25}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

static double area_of(int count, double polygon[][2]) {
  double area = 0;
  for (int k = 0; k < count; k++) {
    const double *a = polygon[k], *b = polygon[(k + 1) % count];
    area += 0.5 * (a[0] * b[1] - b[0] * a[1]);
  }
  return area;
}

static int cut(const CwCutPlane *plane, int count, const double (*x)[3], double polygon[CW_CUT_CORNERS][2]) {
  const double *corner[6];
  double s[6];
  for (int k = 0; k < count; k++) {
    corner[k] = x[k];
    s[k] = cw_cut_distance(plane, x[k]);
  }
  return cw_cut_cell(plane, count, corner, s, polygon);
}

static void cuts_have_the_right_areas(void **state) {
  double polygon[CW_CUT_CORNERS][2];
  // The unit tetrahedron at z = 1/4: a triangle of legs 3/4. All corners' areas are counter-clockwise, so
  // positive.
  const double tet[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  assert_int_equal(cut(&plane_z, 4, tet, polygon), 3);
  assert_near(area_of(3, polygon), 9.0 / 32, 1e-12);
  // Through the middles of four edges of a regular tetrahedron in a cube: a square.
  const double regular[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  const CwCutPlane middle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  assert_int_equal(cut(&middle, 4, regular, polygon), 4);
  assert_near(area_of(4, polygon), 2, 1e-12);
  // A pyramid of base 1 and height 1 at z = 1/4: a square of side 3/4.
  const double pyramid[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
  assert_int_equal(cut(&plane_z, 5, pyramid, polygon), 4);
  assert_near(area_of(4, polygon), 9.0 / 16, 1e-12);
  // A prism along and across its axis.
  const double prism[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  assert_int_equal(cut(&plane_z, 6, prism, polygon), 3);
  assert_near(area_of(3, polygon), 0.5, 1e-12);
  const CwCutPlane across = {{0.25, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  assert_int_equal(cut(&across, 6, prism, polygon), 4);
  assert_near(area_of(4, polygon), 0.75, 1e-12);
  const CwCutPlane beside = {{0, 0, 2}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  assert_int_equal(cut(&beside, 6, prism, polygon), 0);
}

static void a_face_in_the_plane_is_cut_once(void **state) {
  double polygon[CW_CUT_CORNERS][2];
  const CwCutPlane floor = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double over[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double under[4][3] = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}};
  assert_int_equal(cut(&floor, 4, over, polygon), 0);
  assert_int_equal(cut(&floor, 4, under, polygon), 3);
  assert_near(area_of(3, polygon), 0.5, 1e-12);
}

// Where the plane goes through corners of a cell, no corner of the cut stands twice.
static void corners_in_the_plane_stand_once(void **state) {
  double polygon[CW_CUT_CORNERS][2];
  const CwCutPlane across = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  // One corner behind, two in the plane, one before it.
  const double tet[4][3] = {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  assert_int_equal(cut(&across, 4, tet, polygon), 3);
  assert_near(area_of(3, polygon), 0.5, 1e-12);
  // Only an edge in the plane, or only a corner: no area, no cut.
  const double edge[4][3] = {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 1, 1}};
  assert_int_equal(cut(&across, 4, edge, polygon), 0);
  const double corner[4][3] = {{-1, 0, 0}, {-1, 1, 0}, {0, 0, 1}, {-1, 1, 1}};
  assert_int_equal(cut(&across, 4, corner, polygon), 0);
}

// A pyramid on a prism, which lies on a tetrahedron: planes between them, and a point without a distance.
static void cut_cells_of_a_region_are_listed(void **state) {
  double x[][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0, 0, -1}, {0, -1, 0.5}};
  int32_t tetrahedron[][4] = {{0, 2, 1, 6}}, pyramid[][5] = {{0, 1, 4, 3, 7}}, prism[][6] = {{0, 1, 2, 3, 4, 5}};
  const CwRegionData cells = {.point_count = 8,
                              .points = x,
                              .tetrahedron_count = 1,
                              .pyramid_count = 1,
                              .prism_count = 1,
                              .tetrahedra = tetrahedron,
                              .pyramids = pyramid,
                              .prisms = prism};
  static const struct {
    double z;
    int without; // a point, or -1
    int count;
    int32_t cell[2];
    double area[2];
  } wanted[] = {{0.25, -1, 2, {1, 2}, {0.375, 0.5}}, {0.25, 7, 1, {2}, {0.5}}, {0.25, 0, 0, {0}, {0}},
                {-0.5, -1, 1, {0}, {0.125}},         {2, -1, 0, {0}, {0}},     {-2, -1, 0, {0}, {0}}};
  for (size_t k = 0; k < sizeof wanted / sizeof *wanted; k++) {
    const CwCutPlane plane = {{0, 0, wanted[k].z}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double distance[8];
    CwRegionCut cut = {0};
    for (int i = 0; i < 8; i++) distance[i] = i == wanted[k].without ? NAN : cw_cut_distance(&plane, x[i]);
    assert_int_equal(cw_cut_region(&plane, &cells, distance, &cut), CW_OK);
    assert_int_equal(cut.count, wanted[k].count);
    for (int i = 0; i < wanted[k].count; i++) {
      assert_int_equal(cut.cells[i].cell, wanted[k].cell[i]);
      assert_near(area_of(cut.cells[i].corners, cut.cells[i].polygon), wanted[k].area[i], 1e-12);
    }
    cw_region_cut_free(&cut);
  }
}

// Two blades' trailing edges as one triangle each, on opposite sides; the far corner of a discharge at
// azimuth 90 deg.
static void survey_finds_places(void **state) {
  double x[][3] = {{0.1, 0, -0.004},      {0.1, 0.003, 0.004},  {0.1, -0.003, 0.004}, {-0.1, 0, -0.004},
                   {-0.1, -0.003, 0.004}, {-0.1, 0.003, 0.004}, {0, 0.3, 0.02},       {0.001, 0.3, -0.02},
                   {-0.001, 0.29, 0},     {0.05, 0, -0.01},     {0, 0.05, -0.01},     {0.0, -0.05, -0.01}};
  int32_t triangle[][3] = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}}, patch[] = {0, 0, 1, 2};
  CwModelPatch names[] = {{.name = "blade_trailing_edge", .kind = CW_PATCH_WALL},
                          {.name = "outlet", .kind = CW_PATCH_OUTLET},
                          {.name = "shroud", .kind = CW_PATCH_WALL}};
  CwMesh mesh = {.patch_count = 3, .patches = names};
  CwRegionData cells = {
      .point_count = 12, .triangle_count = 4, .points = x, .triangles = triangle, .triangle_patch = patch};
  CwPumpSizes sizes = {2, 0.05, 0.1, 0.101, 0.102, -1};
  CwSurvey *survey = malloc(sizeof *survey);
  double middle[3], radius, z_least, z_most, z;
  cw_survey_start(survey, &sizes);
  assert_int_equal(cw_survey_place(survey, CW_PLACE_TRAILING_EDGE, middle), 0);
  assert_int_equal(cw_survey_wall(survey, CW_WALL_SHROUD, 0.02, &z), 0);
  assert_int_equal(cw_survey_add(survey, &mesh, &cells), CW_OK);
  assert_int_equal(cw_survey_place(survey, CW_PLACE_TRAILING_EDGE, middle),
                   1); // one blade, not the mean of both
  assert_near(fabs(middle[0]), 0.1, 1e-9);
  assert_near(middle[1], 0, 1e-9);
  assert_near(middle[2], 0.004 / 3, 1e-9);
  assert_int_equal(cw_survey_place(survey, CW_PLACE_TONGUE, middle), 0);
  // Midway between two blades is at 90 deg from both.
  assert_near(fabs(sin(cw_survey_meridional_azimuth(survey))), 1, 1e-9);
  assert_int_equal(cw_survey_meridional_reach(survey, M_PI / 2, &radius, &z_least, &z_most), 1);
  assert_near(radius, hypot(0.001, 0.3), 1e-9);
  assert_near(z_least, -0.02, 1e-12);
  assert_near(z_most, 0.02, 1e-12);
  assert_int_equal(cw_survey_wall(survey, CW_WALL_SHROUD, 0.05 / 3, &z), 1);
  assert_near(z, -0.01, 1e-12);
  assert_false(cw_survey_has_span(survey));
  // Midway between walls: a hub at z = 0.02 of the same radius, over a shroud at -0.01.
  assert_true(isnan(cw_survey_span(survey, 0.5, (double[]){0.01, 0.01, 0}))); // no hub yet
  for (int k = 9; k < 12; k++) x[k][2] = 0.02;
  snprintf(names[2].name, sizeof names[2].name, "hub");
  assert_int_equal(cw_survey_add(survey, &mesh, &cells), CW_OK);
  assert_true(cw_survey_has_span(survey));
  assert_near(cw_survey_span(survey, 0.5, (double[]){0, 0.05 / 3, 0.03}), 0.025, 1e-12);
  // Hub at 0.02, shroud at -0.01: the surfaces near them, where the list of pictures has them.
  assert_near(cw_survey_span(survey, cw_plane_span(CW_PLANE_NEAR_HUB), (double[]){0, 0.05 / 3, 0.03}), 0.013, 1e-12);
  assert_near(cw_survey_span(survey, cw_plane_span(CW_PLANE_NEAR_SHROUD), (double[]){0, 0.05 / 3, 0.03}), 0.037, 1e-12);
  assert_true(isnan(cw_plane_span(CW_PLANE_Z0)));
  assert_true(isnan(cw_survey_span(survey, 0.5, (double[]){0.09, 0, 0})));
  // Of leading edges those of whole blades count: the larger face, further out, is a splitter's.
  names[0] = (CwModelPatch){.name = "blade_leading_edge", .kind = CW_PATCH_WALL};
  x[0][0] = 0.04;
  x[1][0] = x[2][0] = 0.041;
  cw_survey_start(survey, &sizes);
  assert_int_equal(cw_survey_add(survey, &mesh, &cells), CW_OK);
  assert_int_equal(cw_survey_place(survey, CW_PLACE_LEADING_EDGE, middle), 1);
  assert_near(middle[0], 0.122 / 3, 1e-9);
  free(survey);
}

// Along the axis and obliquely all pictures look from the suction side, wherever that lies, with x up; across the axis
// and close by, that side is up.
static void pictures_are_turned_alike(void **state) {
  const CwMesh mesh = {0};
  CwSurvey *survey = malloc(sizeof *survey);
  for (int suction = -1; suction <= 1; suction += 2) {
    const CwPumpSizes sizes = {6, 0.05, 0.1, 0.101, 0.102, suction};
    cw_survey_start(survey, &sizes);
    for (int k = 0; k < cw_picture_list_count; k++) {
      const CwPictureSpec *spec = &cw_picture_list[k];
      const int close = spec->target == CW_TARGET_PLACE && spec->plane == CW_PLANE_NONE;
      CwDrawing *drawing = calloc(1, sizeof *drawing);
      cw_drawing_start(spec, &mesh, survey, drawing);
      const CwCamera *camera = &drawing->camera;
      if (close || spec->plane == CW_PLANE_MERIDIONAL) {
        assert_true(suction * camera->up[2] > 0.4);
      } else {
        assert_true(suction * camera->towards[2] > 0.4);
        assert_true(camera->up[0] > 0.4);
        assert_true(-suction * camera->right[1] > 0.9);
      }
      free(drawing);
    }
  }
  free(survey);
}

// The rotation tells it of a designed pump, the geometry's record of one from CAD files.
static void the_suction_side_is_known(void **state) {
  CwCase table = {.impeller.rotation = CW_ROTATION_COUNTER_CLOCKWISE};
  CwReportData data = {.table = &table};
  assert_int_equal(cw_report_suction(&data), -1);
  table.impeller.rotation = CW_ROTATION_CLOCKWISE;
  assert_int_equal(cw_report_suction(&data), 1);
  for (int side = -1; side <= 1; side += 2) {
    data.record[0] = json_pack("{s:{s:i}}", "results", "suction_side", side);
    assert_int_equal(cw_report_suction(&data), side);
    json_decref(data.record[0]);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(numbers_read_well),
      cmocka_unit_test(quantities_have_their_units),
      cmocka_unit_test(regions_have_colours_of_their_own),
      cmocka_unit_test(html_is_escaped_and_encoded),
      cmocka_unit_test(drawings_are_embedded_alone),
      cmocka_unit_test(cuts_have_the_right_areas),
      cmocka_unit_test(a_face_in_the_plane_is_cut_once),
      cmocka_unit_test(corners_in_the_plane_stand_once),
      cmocka_unit_test(cut_cells_of_a_region_are_listed),
      cmocka_unit_test(survey_finds_places),
      cmocka_unit_test(pictures_are_turned_alike),
      cmocka_unit_test(the_suction_side_is_known),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
