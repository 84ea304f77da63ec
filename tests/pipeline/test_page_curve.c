// SPDX-License-Identifier: AGPL-3.0-or-later
// The characteristic curve as a table and as charts.
#include "pipeline/report/page_parts.h"
#include "tests/pipeline/page_text.h"

static CwCase table = {.operating_point.head = 12};
static CwReportData data = {.table = &table};
static json_t *points; // of the curve

static CwStatus curve(FILE *page, const CwReportData *of) {
  return cw_page_curve(page, of, "solve/record.json", points);
}

static char *page_with(const char *text) {
  points = json_of(text);
  char *page = page_of(curve, &data);
  json_decref(points);
  return page;
}

static void fails_with(const char *text, const char *message) {
  points = json_of(text);
  assert_page_fails(curve, &data, message);
  json_decref(points);
}

// u2 f = 16 m/s, of which the flow takes 4 at the operating point: c_u2 = 16 - 4 q, and the head goes with it from 12 m
// at q = 1.
static const char design[] = "{'impeller_tip_speed_m_per_s': 20, 'slip_factor': 0.8, 'outlet_swirl_speed_m_per_s': 12,"
                             "'predicted_head_m': 12, 'hydraulic_efficiency': 0.9, 'shaft_power_w': 1500,"
                             "'npsh_required_m': 2.5, 'npsh_available_m': 9}";

static const char three[] =
    "[{'flow_m3_per_h': 10, 'flow_share': 0.5, 'head_m': 13.5, 'head_scatter_m': 0.1234, 'shaft_power_w': 800,"
    "  'hydraulic_efficiency': 0.6, 'npsh_inception_m': 3, 'settled': true},"
    " {'flow_m3_per_h': 20, 'flow_share': 1, 'head_m': 11.5, 'shaft_power_w': 1250, 'hydraulic_efficiency': 0.875,"
    "  'npsh_inception_m': 4, 'settled': false},"
    " {'flow_m3_per_h': 25, 'flow_share': 1.25, 'head_m': 10, 'head_scatter_m': 0.5, 'settled': true}]";

static void each_point_has_its_row(void **state) {
  data.design = json_of(design);
  char *page = page_with(three);
  assert_row(page, "10|0.5|13.5|0.12|14|0.8|60|3|");
  assert_row(page, "20|1|11.5||12|1.25|87.5|4|not settled");
  assert_row(page, "25|1.25|10|0.5|11||||");
  assert_int_equal(count_in(page, "<tr>"), 4);
  free(page);
  json_decref(data.design);
  data.design = NULL; // no generator made the pump
  page = page_with(three);
  assert_row(page, "10|0.5|13.5|0.12||0.8|60|3|");
  free(page);
}

// Where a circle stands, one after the other, from a caption's chart.
static int circles(const char *page, const char *caption, double at[8][2]) {
  const char *end = strstr(page, caption), *begin = page;
  int count = 0;
  if (!end) return -1;
  for (const char *next = page; (next = strstr(next, "<figure")) && next < end; next++) begin = next;
  for (; (begin = strstr(begin, "<circle")) && begin < end; begin++, count++)
    assert_int_equal(sscanf(begin, "<circle cx=\"%lf\" cy=\"%lf\"", &at[count][0], &at[count][1]), 2);
  return count;
}

// Heads: of the solution 13.5, 11.5 and 10 m, of the design 14, 12 and 11, one straight line; the others have one point
// of the design, at the operating point.
static void charts_show_the_points(void **state) {
  double at[8][2];
  data.design = json_of(design);
  char *page = page_with(three);
  assert_int_equal(circles(page, "<b>Head.</b>", at), 6);
  const double metre = (at[2][1] - at[0][1]) / 3.5; // px, downwards
  assert_true(metre > 0);
  assert_near(at[1][1] - at[0][1], 2 * metre, 0.03);
  for (int k = 0; k < 3; k++) {
    assert_near(at[3 + k][0], at[k][0], 0);
    assert_near(at[3 + k][1] - at[0][1], (13.5 - (double[]){14, 12, 11}[k]) * metre, 0.03);
  }
  assert_near((at[1][0] - at[0][0]) / (at[2][0] - at[0][0]), 10. / 15, 1e-3);
  assert_int_equal(circles(page, "<b>Shaft power</b>", at), 2 + 1);
  assert_near(at[2][0], at[1][0], 0);
  // 0.8, 1.25 and 1.5 kW.
  assert_near((at[2][1] - at[0][1]) / (at[1][1] - at[0][1]), 0.7 / 0.45, 1e-3);
  assert_int_equal(circles(page, "<b>Hydraulic efficiency.</b>", at), 2 + 1);
  assert_near((at[2][1] - at[0][1]) / (at[1][1] - at[0][1]), 0.3 / 0.275, 1e-3);
  assert_int_equal(circles(page, "<b>NPSH</b>", at), 2 + 1);
  assert_near(at[2][0], at[1][0], 0); // that of the design stands at q = 1, at 2.5 m beside 3 and 4
  assert_near((at[2][1] - at[0][1]) / (at[1][1] - at[0][1]), -0.5, 2e-3);
  assert_int_equal(count_in(page, "class=\"m\""), 2); // the asked head and the NPSH that is available
  assert_int_equal(count_in(page, "The design predicts one point"), 3);
  assert_int_equal(count_in(page, ">design</text>"), 4);
  free(page);
  json_decref(data.design);
  data.design = NULL;
  page = page_with(three);
  assert_int_equal(circles(page, "<b>Head.</b>", at), 3);
  assert_int_equal(circles(page, "<b>NPSH</b>", at), 2);
  assert_int_equal(count_in(page, ">design</text>"), 0);
  assert_int_equal(count_in(page, "The design"), 0);
  assert_int_equal(count_in(page, "makes available"), 0);
  assert_int_equal(count_in(page, "class=\"m\""), 1);
  free(page);
}

// A point within half a thousandth of the flow is the operating point.
static void the_operating_point_is_known_by_its_share(void **state) {
  static const struct {
    const char *share;
    int designed;
  } shares[] = {{"0.9996", 1}, {"1.0004", 1}, {"0.9994", 0}, {"1.0006", 0}};
  char text[300];
  double at[8][2];
  data.design = json_of(design);
  for (int i = 0; i < 4; i++) {
    snprintf(text, sizeof text,
             "[{'flow_m3_per_h': 10, 'flow_share': 0.5, 'head_m': 13, 'shaft_power_w': 900},"
             "{'flow_m3_per_h': 20, 'flow_share': %s, 'head_m': 12, 'shaft_power_w': 950}]",
             shares[i].share);
    char *page = page_with(text);
    assert_int_equal(circles(page, "<b>Shaft power</b>", at), 2 + shares[i].designed);
    // What was not solved at all has no chart.
    assert_int_equal(circles(page, "<b>Hydraulic efficiency.</b>", at), -1);
    free(page);
  }
  json_decref(data.design);
  data.design = NULL;
}

static void less_than_two_points_are_no_curve(void **state) {
  char *page = page_with("[]");
  assert_string_equal(page, "");
  free(page);
  page = page_with("[{'flow_m3_per_h': 10, 'head_m': 3}]");
  assert_string_equal(page, "");
  free(page);
}

static void wrong_curves_are_told(void **state) {
  char many[1000] = "[", *end = many + 1;
  fails_with("[{'flow_m3_per_h': 10, 'head_m': 3}, {'flow_m3_per_h': 10, 'head_m': 2}]",
             "solve/record.json: point 2 of 'curve' has no head, or a flow not above that of the one before it");
  fails_with("[{'flow_m3_per_h': 10, 'head_m': 3}, {'flow_m3_per_h': 11}]", "point 2 of 'curve'");
  fails_with("[{'head_m': 3}, {'flow_m3_per_h': 11, 'head_m': 2}]", "point 1 of 'curve'");
  for (int k = 0; k <= CW_LIST_MOST; k++) // one more than a case may ask for
    end += sprintf(end, "%s{'flow_m3_per_h': %d, 'head_m': 9}", k ? ", " : "", 10 + k);
  strcpy(end, "]");
  fails_with(many, "'curve' has 13 points; allowed: at most 12");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_point_has_its_row),
      cmocka_unit_test(charts_show_the_points),
      cmocka_unit_test(the_operating_point_is_known_by_its_share),
      cmocka_unit_test(less_than_two_points_are_no_curve),
      cmocka_unit_test(wrong_curves_are_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
