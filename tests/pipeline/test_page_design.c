// SPDX-License-Identifier: AGPL-3.0-or-later
// The design table, what follows from it, and its drawings.
#include "pipeline/atomic_file.h"
#include "pipeline/case_schema.h"
#include "tests/pipeline/page_text.h"
#include "tests/test_folder.h"
#include "tests/whole_file.h"

#define GAP "\342\200\257" // between groups of three digits
#define MINUS "\342\210\222"

static CwCase table;

static void give(const char *section, const char *key, double value) {
  const int index = cw_case_key_find(section, key);
  assert_true(index >= 0);
  cw_case_key_set(&cw_case_keys[index], value, &table);
  table.given[index] = 1;
}

// Each value with its unit and where it is from: the file, the default, or the design, which has put it there.
static void each_key_says_where_it_is_from(void **state) {
  const CwReportData data = {.table = &table};
  cw_case_defaults(&table);
  give("operating_point", "flow_rate_m3_per_h", 25);
  give("operating_point", "head_m", 10);
  give("operating_point", "speed_rpm", 1450);
  give("impeller", "blade_count", 6);
  give("impeller", "lean_deg", 0); // the default, but given
  give("mesh", "cells", 2500000);
  give("walls", "y_plus_blade", 30);
  table.impeller.outlet_diameter = 0.2; // computed
  table.output.formats = 1 << CW_FORMAT_CGNS | 1 << CW_FORMAT_FLUENT;
  table.walls.roughness = 25e-6;
  char *page = page_of(cw_page_input, &data);
  assert_row(page, "Flow rate|Q|25|m&sup3;/h|case file");
  assert_row(page, "Head|H|10|m|case file");
  assert_row(page, "Speed||1450|rpm|case file");
  assert_row(page, "Turn in one time step of the transient run||1|&deg;|default");
  assert_row(page, "Density||998.2|kg/m&sup3;|default");
  assert_row(page, "Kinematic viscosity||1.004" GAP "\303\227" GAP "10\342\201\273\342\201\266|m&sup2;/s|default");
  assert_row(page, "Blade count|z|6||case file");
  assert_row(page, "Outlet diameter|D2|200|mm|computed");
  assert_row(page, "Lean of the trailing edge||0|&deg;|case file");
  assert_row(page, "Sand grain roughness||25|&micro;m|computed"); // not the default, and not given
  assert_row(page, "What goes first where the table asks too much||Auto||default");
  assert_row(page, "Cells||2" GAP "500" GAP "000||case file");
  assert_row(page, "y+ blade||30||case file");
  assert_row(page, "Prism layers||auto||default");
  assert_row(page, "Growth of layers, at most||auto||default");
  assert_row(page, "Formats||[cgns, fluent]||computed");
  free(page);
}

// What is left open to the design has no row, nor has the name; each section stands once, in the order of the keys.
static void open_keys_have_no_row(void **state) {
  const CwReportData data = {.table = &table};
  static const char *const sections[] = {"Operating point", "Fluid", "Design", "Impeller", "Volute", "Walls", "Mesh"};
  char heading[100];
  cw_case_defaults(&table);
  snprintf(table.name, sizeof table.name, "my_pump");
  give("operating_point", "flow_rate_m3_per_h", 25);
  char *page = page_of(cw_page_input, &data);
  const char *before = page;
  for (size_t i = 0; i < sizeof sections / sizeof *sections; i++) {
    snprintf(heading, sizeof heading, "<tr class=\"s\"><td colspan=\"5\">%s</td></tr>\n", sections[i]);
    assert_int_equal(count_in(page, heading), 1);
    assert_true(strstr(page, heading) > before || i == 0);
    before = strstr(page, heading);
  }
  static const char *const open[] = {
      ">Blade count<",   ">Outlet diameter<", ">Test head<",       ">Flow shares<", ">Base diameter<",
      "Splitters begin", ">Total thickness",  "Cells of a region", "my_pump",       ">Name<"};
  for (size_t i = 0; i < sizeof open / sizeof *open; i++)
    if (strstr(page, open[i])) fail_msg("'%s' in the page", open[i]);
  assert_int_equal(count_in(page, "<table>"), count_in(page, "</table>"));
  assert_int_equal(count_in(page, ">case file<"), 1);
  free(page);
}

static void each_figure_has_its_source(void **state) {
  CwReportData data = {
      .design = json_of("{'flow_rate_m3_per_s': 0.00694444444, 'blade_count': 6, 'throat_area_m2': 8.6647e-4,"
                        " 'head_residual_m': 1e-13, 'wrap_residual_deg': -2.5, 'odd': 3,"
                        " 'inlet_blade_angle_deg': 23.456789, 'notes': 'text',"
                        " 'sources': {'throat_area_m2': 'constant <K>', 'blade_count': 'the case'},"
                        " 'names': {'odd': 'what is odd'},"
                        " 'measured': {'blade_count': 6, 'throat_area_m2': 9e-4, 'tongue': {'angle_deg': 12.3456789},"
                        " 'note': 'none', 'outlet': {'width_m': 3}}}")};
  char *page = page_of(cw_page_design, &data);
  assert_row(page, "Flow rate|Q|25|m&sup3;/h|");
  assert_row(page, "Blade count|z|6||the case");
  assert_row(page, "Throat area||866.47|mm&sup2;|constant &lt;K&gt;");
  assert_row(page, "Head residual||0|m|"); // what rounding leaves
  assert_row(page, "Wrap residual||" MINUS "2.5|&deg;|");
  assert_row(page, "What is odd||3||");
  assert_holds(page, "<tr class=\"s\"><td colspan=\"5\">Duty and specific speed</td></tr>\n<tr><td>Blade count");
  assert_holds(page, "<tr class=\"s\"><td colspan=\"5\">Blade</td></tr>\n<tr><td>Inlet blade angle");
  assert_null(strstr(page, "Notes"));
  const char *measured = strstr(page, "<h3>Measured on the solids as built</h3>");
  assert_non_null(measured);
  assert_row(measured, "Throat area||900|mm&sup2;");
  assert_row(measured, "Tongue||12.346|&deg;");
  assert_null(strstr(measured, "class=\"s\""));
  assert_int_equal(count_in(measured, "<tr>"), 4);
  free(page);
  json_object_del(data.design, "measured");
  page = page_of(cw_page_design, &data);
  assert_null(strstr(page, "Measured"));
  free(page);
  json_decref(data.design);
}

// By name, each in a figure; what is no picture stays out.
static void drawings_stand_in_their_order(void **state) {
  char run[sizeof test_folder];
  snprintf(run, sizeof run, "%s", test_folder);
  const CwReportData data = {.run = run};
  free(page_that(cw_page_design_pictures, &data, CW_ERR_IO)); // no such folder
  assert_non_null(strstr(cw_fail_message(), "/geometry: cannot be read"));
  cw_fail_clear();
  assert_int_equal(cw_make_directory(in_test_folder("geometry")), CW_OK);
  write_text(in_test_folder("geometry/notes.txt"), "<svg>notes</svg>");
  write_text(in_test_folder("geometry/.part.svg"), "<svg>part</svg>");
  write_text(in_test_folder("geometry/a"), "<svg>short</svg>");
  write_text(in_test_folder("geometry/.svg"), "<svg>nameless</svg>");
  char *page = page_of(cw_page_design_pictures, &data);
  assert_string_equal(page, "<p>The geometry stage left no drawings.</p>\n");
  free(page);
  static const char *const names[] = {"velocity_triangles", "blade", "meridian", "volute", "sections"},
                           *const labels[] = {"Blade", "Meridian", "Sections", "Velocity triangles", "Volute"};
  char path[60], text[60], whole[1000] = "";
  for (int k = 0; k < 5; k++) {
    snprintf(path, sizeof path, "geometry/%s.svg", names[k]);
    snprintf(text, sizeof text, "<?xml?>\n<svg>%c</svg>\n", names[k][1]);
    write_text(in_test_folder(path), text);
    snprintf(whole + strlen(whole), sizeof whole - strlen(whole),
             "<figure class=\"drawing\"><svg>%c</svg>\n<figcaption><b>%s</b></figcaption></figure>\n", labels[k][1],
             labels[k]);
  }
  page = page_of(cw_page_design_pictures, &data);
  assert_string_equal(page, whole);
  free(page);
  write_text(in_test_folder("geometry/open.svg"), "<svg>");
  assert_page_fails(cw_page_design_pictures, &data, "geometry/open.svg: not a whole SVG");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_key_says_where_it_is_from),
      cmocka_unit_test(open_keys_have_no_row),
      cmocka_unit_test(each_figure_has_its_source),
      cmocka_unit_test(drawings_stand_in_their_order),
  };
  return cmocka_run_group_tests(tests, make_test_folder, clear_test_folder);
}
