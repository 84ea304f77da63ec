// SPDX-License-Identifier: AGPL-3.0-or-later
// What the page says of the solved flow: figures, history and y+.
#include "tests/pipeline/page_text.h"

static CwCase table = {.operating_point.head = 12};

// The results of a settled flow; the last report lacks a torque.
static const char solve[] =
    "{'seconds': 75.5, 'results': {'iterations': 1234, 'settled': true, 'head_m': 11.52345, 'head_scatter_m': 0.123,"
    " 'torque_n_m': 7.5, 'torque_scatter_n_m': 0.25, 'shaft_power_w': 1125, 'hydraulic_efficiency': 0.8125,"
    " 'npsh_inception_m': 2.75, 'curve': [],"
    " 'history': {'iteration': [10, 20, 40], 'head_m': [8, 11, 14], 'torque_n_m': [5, 6, null],"
    " 'residual_p': [1, 0.1, 0.0001], 'residual_u': [0.1, 0.01, 0.001]},"
    " 'y_plus': {'hub': {'least': 0.5, 'mean': 12.345, 'most': 400}, 'shroud': {'least': 1, 'mean': 2, 'most': 3},"
    " 'tongue': {'least': 4, 'mean': 5, 'most': 6}}}}";

static const char design[] = "{'predicted_head_m': 12.5, 'hydraulic_efficiency': 0.84}";

static CwReportData data_of(const char *text) {
  return (CwReportData){.table = &table, .run = "RUN", .solve = text ? json_of(text) : NULL, .is_solved = 1};
}

static json_t *results_of(const CwReportData *data) {
  return json_object_get(data->solve, "results");
}

static void figures_stand_beside_the_design(void **state) {
  CwReportData data = data_of(solve);
  data.design = json_of(design);
  char *page = page_of(cw_page_solve, &data);
  assert_holds(page, "head and torque have settled after 1234 iterations (75.5 s).");
  assert_row(page, "Head|11.52|0.12|12.5|m");
  assert_row(page, "Shaft torque|7.5|0.25||N&#8239;m");
  assert_row(page, "Shaft power|1.125|||kW");
  assert_row(page, "Hydraulic efficiency|81.25||84|%");
  assert_row(page, "NPSH at inception|2.75|||m");
  free(page);
  // Less is known of another pump, and it has not come to rest.
  json_decref(data.design);
  data.design = NULL;
  json_object_del(results_of(&data), "hydraulic_efficiency");
  json_object_del(results_of(&data), "npsh_inception_m");
  json_object_del(results_of(&data), "head_scatter_m");
  json_object_set_new(results_of(&data), "settled", json_false());
  page = page_of(cw_page_solve, &data);
  assert_holds(page, "head and torque have <b>not settled</b> after");
  assert_row(page, "Head|11.52|||m");
  assert_null(strstr(page, "Hydraulic efficiency"));
  assert_null(strstr(page, "NPSH at inception"));
  free(page);
  json_decref(data.solve);
}

// The lines of a chart before its caption, as numbers of their places.
static int places(const char *page, const char *caption, int line, double at[8][2]) {
  const char *end = strstr(page, caption), *begin = page;
  int count = 0, used;
  char command;
  assert_non_null(end);
  for (const char *next = page; (next = strstr(next, "<figure")) && next < end; next++) begin = next;
  for (int k = 0; k <= line; k++) {
    begin = strstr(begin, " d=\"");
    if (!begin || begin > end) return 0;
    begin += 4;
  }
  for (; sscanf(begin, "%c%lf %lf%n", &command, &at[count][0], &at[count][1], &used) == 3; count++) begin += used;
  return count;
}

// Heads 8, 11 and 14 m after 10, 20 and 40 iterations; two torques; residuals by their powers of ten.
static void the_history_is_drawn(void **state) {
  CwReportData data = data_of(solve);
  double at[8][2], other[8][2];
  char *page = page_of(cw_page_solve, &data);
  assert_int_equal(places(page, "<b>Head.</b>", 0, at), 3);
  assert_near((at[1][0] - at[0][0]) / (at[2][0] - at[0][0]), 1. / 3, 2e-3);
  assert_near((at[1][1] - at[0][1]) / (at[2][1] - at[0][1]), 0.5, 2e-3);
  assert_true(at[2][1] < at[0][1]);
  assert_int_equal(places(page, "<b>Shaft torque.</b>", 0, at), 2);
  assert_int_equal(places(page, "<b>Residuals.</b>", 0, at), 3);
  assert_int_equal(places(page, "<b>Residuals.</b>", 1, other), 3);
  assert_near((at[1][1] - at[0][1]) / (at[2][1] - at[0][1]), 0.25, 2e-3);
  assert_near((other[1][1] - other[0][1]) / (other[2][1] - other[0][1]), 0.5, 2e-3);
  assert_near(other[0][1], at[1][1], 0.02);           // both 0.1
  assert_int_equal(count_in(page, "class=\"m\""), 2); // the head that is asked, and 1e-4
  free(page);
  // One report is no line.
  json_object_set_new(results_of(&data), "history",
                      json_of("{'iteration': [10], 'head_m': [8], 'torque_n_m': [5], 'residual_p': [1], "
                              "'residual_u': [1]}"));
  page = page_of(cw_page_solve, &data);
  assert_null(strstr(page, "<svg"));
  free(page);
  json_decref(data.solve);
}

// Of eight faces of the hub two have a y+ up to 1, one each up to 5 and 30, three up to 300, one more. All faces of the
// shroud have 30.5, and the tongue has none.
static void y_plus_is_counted_by_its_ranges(void **state) {
  static const double hub[] = {0.25, 1, 1.01, 30, 30.01, 299, 300, 300.01};
  CwFoamValues patches[] = {{.patch = "shroud", .uniform = {30.5}},
                            {.patch = "hub", .bytes = (const char *)hub, .count = 8}};
  CwReportData data = data_of(solve);
  data.flow = (CwFlow){.present = 1, .y_plus = {.components = 1, .scalar_size = 8, .patch = patches, .patch_count = 2}};
  char *page = page_of(cw_page_solve, &data);
  assert_row(page, "Hub|0.5|12.3|400|25.0 %|12.5 %|12.5 %|37.5 %|12.5 %");
  assert_row(page, "Shroud|1|2|3|0 %|0 %|0 %|100 %|0 %");
  assert_row(page, "Tongue|4|5|6|\342\200\223|\342\200\223|\342\200\223|\342\200\223|\342\200\223");
  assert_holds(page, "<h3>Fields</h3>");
  free(page);
  // Fields of another flow are not counted.
  data.flow.present = 0;
  page = page_of(cw_page_solve, &data);
  assert_row(page, "Hub|0.5|12.3|400|\342\200\223|\342\200\223|\342\200\223|\342\200\223|\342\200\223");
  assert_null(strstr(page, "<h3>Fields</h3>"));
  free(page);
  json_object_set_new(results_of(&data), "y_plus", json_object());
  page = page_of(cw_page_solve, &data);
  assert_null(strstr(page, "y+ of the solution"));
  free(page);
  json_decref(data.solve);
}

static void the_curve_follows(void **state) {
  CwReportData data = data_of(solve);
  json_object_set_new(
      results_of(&data), "curve",
      json_of("[{'flow_m3_per_h': 10, 'head_m': 13}, {'flow_m3_per_h': 20, 'head_m': 12, 'settled': true}]"));
  char *page = page_of(cw_page_solve, &data);
  assert_holds(page, "<h3>Characteristic curve</h3>");
  assert_row(page, "20||12||||||");
  free(page);
  json_decref(data.solve);
}

static void what_was_not_solved_is_told(void **state) {
  CwReportData data = data_of(NULL);
  char *page = page_of(cw_page_solve, &data);
  assert_holds(page, "has not been solved");
  free(page);
  data = data_of(solve);
  data.is_solved = 0; // on these files
  page = page_of(cw_page_solve, &data);
  assert_holds(page, "was solved on another export");
  assert_null(strstr(page, "<table"));
  free(page);
  json_decref(data.solve);
}

static void wrong_records_are_told(void **state) {
  static const char *const wrong[][3] = {
      {"iterations", NULL, "RUN/solve/record.json: 'iterations'"},
      {"iterations", "[]", "RUN/solve/record.json: 'iterations'"},
      {"history", NULL, "RUN/solve/record.json: 'history'"},
      {"curve", "{}", "RUN/solve/record.json: 'curve'"},
      {"history", "{'iteration': [1, 2], 'head_m': [1, 2], 'torque_n_m': [1], 'residual_p': [], 'residual_u': []}",
       "'torque_n_m' has 1 values; it must have 2"},
      {"history", "{'iteration': [1, 2], 'head_m': 3}", "'head_m'"}};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    CwReportData data = data_of(solve);
    if (wrong[i][1])
      json_object_set_new(results_of(&data), wrong[i][0], json_of(wrong[i][1]));
    else
      json_object_del(results_of(&data), wrong[i][0]);
    assert_page_fails(cw_page_solve, &data, wrong[i][2]);
    json_decref(data.solve);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(figures_stand_beside_the_design), cmocka_unit_test(the_history_is_drawn),
      cmocka_unit_test(y_plus_is_counted_by_its_ranges), cmocka_unit_test(the_curve_follows),
      cmocka_unit_test(what_was_not_solved_is_told),     cmocka_unit_test(wrong_records_are_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
