// SPDX-License-Identifier: AGPL-3.0-or-later
// What the page says of the run: the export's figures, times, warnings.
#include "tests/pipeline/page_text.h"

#define DASH "\342\200\223"
#define GAP "\342\200\257" // between groups of three digits

// Plain values in the units of their names, objects and tables under headings, lists of values not by themselves.
static void figures_of_the_export_are_tables(void **state) {
  CwReportData data = {
      .record = {[CW_STAGE_OF_EXPORT] = json_of(
                     "{'results': {'cells': 1234567, 'volume_m3': 0.00025012345, 'is_old': false, 'model': 'k & e',"
                     " 'nothing': null, 'headlines': ['a', 'b'],"
                     " 'rotor': {'points': 12, 'least_angle_deg': 7.1234567, 'inner': {'deep': 1}},"
                     " 'patches': [{'name': 'hub', 'area_m2': 0.5, 'on': [1, 2.5, 'x'], 'is_wall': true},"
                     " {'name': 'lid', 'on': [], 'is_wall': false}]}}")}};
  char *page = page_of(cw_page_export, &data);
  assert_row(page, "Cells|1" GAP "234" GAP "567|");
  assert_row(page, "Volume|250.12|cm&sup3;");
  assert_row(page, "Is old|no|");
  assert_row(page, "Model|k &amp; e|");
  assert_row(page, "Nothing|" DASH "|");
  assert_holds(page, "<div><h3>Rotor</h3>\n");
  assert_row(page, "Points|12|");
  assert_row(page, "Least angle|7.1235|&deg;");
  assert_holds(page, "<div class=\"wide\"><h3>Patches</h3>\n");
  assert_row(page, "Name|Area, mm&sup2;|On|Is wall");
  assert_row(page, "hub|500" GAP "000|1, 2.5, x|yes");
  assert_row(page, "lid|" DASH "||no"); // the area is not there
  assert_null(strstr(page, "Headlines"));
  assert_null(strstr(page, "Inner"));
  assert_int_equal(count_in(page, "<tr>"), 5 + 2 + 3);
  free(page);
  json_decref(data.record[CW_STAGE_OF_EXPORT]);
  data.record[CW_STAGE_OF_EXPORT] = NULL;
  page = page_of(cw_page_export, &data);
  assert_holds(page, "has not been exported");
  assert_null(strstr(page, "<table"));
  free(page);
}

static const char geometry[] =
    "{'seconds': 3, 'peak_memory_bytes': 1048576, 'warnings': ['a < b', 'c'],"
    " 'steps': [{'name': 'rotor', 'seconds': 1.5, 'items': 62, 'unit': 'faces'}, {'name': 'surface', 'seconds': 1}]}";
static const char mesh[] =
    "{'seconds': 80.4, 'peak_memory_bytes': 2.5e9, 'warnings': [],"
    " 'steps': [{'name': 'surface', 'seconds': 1, 'items': 9, 'unit': 'faces'}, {'name': 'fill', 'seconds': 6, "
    "'items': 5},"
    " {'name': 'surface', 'seconds': 2, 'items': 10, 'unit': 'faces'}, {'name': 'surface', 'seconds': 1.5}]}";
static const char export[] = "{'seconds': 120, 'peak_memory_bytes': 12, 'warnings': ['d'], 'steps': []}";

static void stages_have_their_times(void **state) {
  CwReportData data = {.record = {json_of(geometry), json_of(mesh), json_of(export)}};
  char *page = page_of(cw_page_times, &data);
  assert_row(page, "geometry|3 s|1.05 MB|2");
  assert_row(page, "mesh|80.4 s|2.5 GB|0");
  assert_row(page, "export|2 min 00 s|12 B|1");
  assert_row(page, "together|3 min 23 s||");
  assert_int_equal(count_in(page, "export</text>"), 1); // its key
  free(page);
  json_decref(data.record[CW_STAGE_OF_EXPORT]);
  data.record[CW_STAGE_OF_EXPORT] = NULL;
  page = page_of(cw_page_times, &data);
  assert_row(page, "export|not run||");
  assert_row(page, "together|83.4 s||");
  assert_int_equal(count_in(page, "export</text>"), 0);
  free(page);
  json_decref(data.record[0]);
  json_decref(data.record[1]);
}

// Passes of one name are one bar, of 4.5 s; a stage has its own steps, though another has one of the same name.
static void steps_are_added_up(void **state) {
  CwReportData data = {.record = {json_of(geometry), json_of(mesh)}};
  double bar[4][4];
  char *page = page_of(cw_page_times, &data);
  assert_holds(page, ">geometry: rotor<");
  assert_holds(page, ">geometry: surface<");
  assert_holds(page, ">mesh: surface<");
  assert_holds(page, ">mesh: fill<");
  assert_holds(page, ">1.5 s, 62 faces<");
  assert_holds(page, ">1 s<");
  assert_holds(page, ">6 s<");             // of five what is not told
  assert_holds(page, ">4.5 s, 3 passes<"); // the last pass tells no number
  assert_int_equal(bars_of(page, "#7a9e87", bar), 2);
  assert_near(bar[0][2] / bar[1][2], 1.5, 1e-3);
  const double second = bar[1][2];
  assert_int_equal(bars_of(page, "#4f8fc0", bar), 2);
  assert_near(bar[0][2] / second, 4.5, 2e-3);
  assert_near(bar[1][2] / second, 6, 2e-3);
  free(page);
  json_decref(data.record[0]);
  data.record[0] = json_of("{'steps': [{'name': 'a', 'seconds': 1, 'items': 1000000, 'unit': 'cells'},"
                           " {'name': 'a', 'seconds': 2, 'items': 2000000, 'unit': 'cells'}]}");
  page = page_of(cw_page_times, &data);
  assert_holds(page, ">3 s, 2" GAP "000" GAP "000 cells, 2 passes<");
  free(page);
  json_decref(data.record[0]);
  json_decref(data.record[1]);
}

static void warnings_are_all_told(void **state) {
  CwReportData data = {.record = {json_of(geometry), json_of(mesh), json_of(export)},
                       .solve = json_of("{'warnings': ['drifts']}")};
  char *page = page_of(cw_page_warnings, &data);
  assert_holds(page, "<div class=\"warn\"><b>geometry:</b> a &lt; b</div>\n"
                     "<div class=\"warn\"><b>geometry:</b> c</div>\n"
                     "<div class=\"warn\"><b>export:</b> d</div>\n");
  assert_int_equal(count_in(page, "class=\"warn\""), 3); // the flow is not of this export
  free(page);
  data.is_solved = 1;
  page = page_of(cw_page_warnings, &data);
  assert_holds(page, "<div class=\"warn\"><b>solve:</b> drifts</div>\n");
  assert_int_equal(count_in(page, "class=\"warn\""), 4);
  assert_null(strstr(page, "No stage"));
  free(page);
  for (int s = 0; s < CW_STAGES; s++) json_object_set_new(data.record[s], "warnings", json_array());
  json_object_set_new(data.solve, "warnings", json_array());
  page = page_of(cw_page_warnings, &data);
  assert_string_equal(page, "<div class=\"fine\">No stage had anything to warn of.</div>\n");
  free(page);
  for (int s = 0; s < CW_STAGES; s++) json_decref(data.record[s]);
  json_decref(data.solve);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(figures_of_the_export_are_tables),
      cmocka_unit_test(stages_have_their_times),
      cmocka_unit_test(steps_are_added_up),
      cmocka_unit_test(warnings_are_all_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
