// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bad_cases.h"
#include "pipeline/case_read.h"
#include "pipeline/case_schema.h"
#include "pipeline/wall_group.h"
#include "tests/test_folder.h"
#include "tests/whole_file.h"

static const double pi = 3.14159265358979323846;

static const char *const good[] = {
    "name: test",                // 1
    "operating_point:",          // 2
    "  flow_rate_m3_per_h: 25",  // 3
    "  head_m: 10",              // 4
    "  speed_rpm: 1450",         // 5
    "impeller:",                 // 6
    "  priority: wrap",          // 7
    "  blade_count: 6",          // 8
    "  inlet_diameter_mm: 74",   // 9
    "  outlet_diameter_mm: 200", // 10
    "  outlet_width_mm: 8",      // 11
    "  wrap_angle_deg: 71",      // 12
    "volute:",                   // 13
    "  base_diameter_mm: 204",   // 14
    "  inlet_width_mm: 12",      // 15
    "walls:",                    // 16
    "  layer_count: 5",          // 17
    "  growth_ratio: 1.2",       // 18
    "mesh:",                     // 19
    "  cells: 1000000",          // 20
};
enum { GOOD_COUNT = sizeof good / sizeof *good };

static char path[sizeof test_folder + 100];

static int make_path(void **state) {
  if (make_test_folder(state)) return -1;
  strcpy(path, in_test_folder("case.yaml"));
  return 0;
}

// Writes the good case with line `line` (1-based) replaced; "" removes it, line 0 changes nothing.
static void write_changed(int line, const char *replacement) {
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  for (int i = 0; i < GOOD_COUNT; ++i) {
    const char *text = i + 1 == line ? replacement : good[i];
    if (*text) fprintf(file, "%s\n", text);
  }
  assert_int_equal(fclose(file), 0);
}

// Whether reading fails as it should; prints how it does not.
static int is_refused(const char *expected) {
  CwCase table, before;
  char whole[1200];
  memset(&table, 7, sizeof table);
  memcpy(&before, &table, sizeof table);
  cw_fail_clear();
  CwStatus status = cw_case_read(path, &table);
  snprintf(whole, sizeof whole, "%s:%s", path, expected);
  int fine = status == CW_ERR_INPUT && !strcmp(cw_fail_message(), whole) && !memcmp(&table, &before, sizeof table);
  if (!fine) print_error("expected %s\ngot %d %s\n", whole, status, cw_fail_message());
  return fine;
}

static void bad_cases_are_refused_at_their_place(void **state) {
  int wrong = 0;
  for (size_t i = 0; i < sizeof bad_cases / sizeof *bad_cases; ++i) {
    write_changed(bad_cases[i].line, bad_cases[i].replacement);
    wrong += !is_refused(bad_cases[i].expected);
  }
  assert_int_equal(wrong, 0);
}

static void whole_files_that_are_no_case(void **state) {
  static const struct {
    const char *text, *expected;
  } files[] = {
      {"", "1:1: case file: it is empty; allowed: the keys of docs/case-reference.md"},
      {"# nothing\n\n", "1:1: case file: it is empty; allowed: the keys of docs/case-reference.md"},
      {"~\n", "1:1: case file: it is not a mapping; allowed: the keys of docs/case-reference.md"},
      {"\n- a\n- b\n", "2:1: case file: it is not a mapping; allowed: the keys of docs/case-reference.md"},
      {"just words\n", "1:1: case file: it is not a mapping; allowed: the keys of docs/case-reference.md"},
      {"name: x\n", "1:1: operating_point.flow_rate_m3_per_h: the key is missing; allowed: 0.001 to 1000000 m3/h"},
      {"{}\n", "1:1: name: the key is missing; allowed: 1 to 32 letters, digits, _ and -, a letter first"},
  };
  for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
    write_text(path, files[i].text);
    assert_true(is_refused(files[i].expected));
  }
  write_whole(path, "name: a\0b\n", 10);
  assert_true(is_refused("1:8: case file: byte 0x00 is no text; allowed: UTF-8 text"));
}

static void huge_file_is_refused(void **state) {
  size_t size = (1 << 20) + 1;
  char *text = malloc(size);
  assert_non_null(text);
  memset(text, '#', size);
  write_whole(path, text, size);
  free(text);
  assert_true(is_refused("1:1: case file: it is too large; allowed: at most 1 MiB"));
}

static void deep_nesting_is_refused(void **state) {
  char text[20000] = "mesh: ";
  memset(text + 6, '[', sizeof text - 7);
  write_text(path, text);
  CwCase table;
  assert_int_equal(cw_case_read(path, &table), CW_ERR_INPUT);
}

static void files_that_cannot_be_read(void **state) {
  CwCase table;
  assert_int_equal(cw_case_read("/nowhere/case.yaml", &table), CW_ERR_IO);
  assert_string_equal(cw_fail_message(), "/nowhere/case.yaml: the case file cannot be read: No such file or directory");
  assert_int_equal(cw_case_read("/", &table), CW_ERR_IO);
  assert_string_equal(cw_fail_message(), "/: this is a folder; allowed: a case file in YAML");
}

static void long_path_leaves_room_for_the_message(void **state) {
  char far[3000];
  memset(far, 'a', sizeof far);
  far[sizeof far - 1] = '\0';
  CwCase table;
  assert_int_equal(cw_case_read(far, &table), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "File name too long"));
  assert_memory_equal(cw_fail_message(), "...aaa", 6);
}

static void good_case_is_read_in_si(void **state) {
  CwCase table;
  write_changed(0, "");
  assert_int_equal(cw_case_read(path, &table), CW_OK);
  assert_string_equal(table.name, "test");
  assert_true(table.operating_point.flow_rate == 25.0 / 3600);
  assert_true(table.operating_point.head == 10);
  assert_true(fabs(table.operating_point.speed - 1450 * 2 * pi / 60) < 1e-12);
  assert_true(table.impeller.inlet_diameter == 0.074);
  assert_true(table.impeller.outlet_diameter == 0.2);
  assert_true(fabs(table.impeller.wrap_angle - 71 * pi / 180) < 1e-15);
  assert_int_equal(table.impeller.blade_count, 6);
  assert_int_equal(table.mesh.cells, 1000000);
  assert_int_equal(table.impeller.priority, CW_PRIORITY_WRAP);
  // Left out: a default, or for the hydraulic design to compute.
  assert_true(table.operating_point.inlet_pressure == 101325);
  assert_true(table.fluid.density == 998.2);
  assert_true(table.fluid.kinematic_viscosity == 1.004e-6);
  assert_int_equal(table.walls.y_plus_at, CW_Y_PLUS_AT_CELL_CENTRE);
  assert_true(table.mesh.gradation == 0.25);
  assert_true(fabs(table.mesh.curvature_angle - pi / 9) < 1e-15);
  assert_int_equal(table.mesh.cells_per_region, 0);
  assert_false(cw_case_given(table.impeller.hub_diameter));
  assert_false(cw_case_given(table.impeller.outlet_blade_angle));
  assert_false(cw_case_given(table.volute.throat_area));
  assert_false(cw_case_given(table.walls.total_thickness));
}

// Automatic keys are open by the word as when left out.
static void automatic_keys(void **state) {
  CwCase table, left_out;
  cw_case_defaults(&left_out);
  assert_int_equal(left_out.walls.layer_count, 0);
  assert_false(cw_case_given(left_out.walls.growth_ratio));
  assert_false(cw_case_given(left_out.walls.pipe.y_plus));
  assert_true(cw_walls_auto(&left_out.walls));
  write_changed(17, "  layer_count: auto\n  y_plus_blade: auto");
  assert_int_equal(cw_case_read(path, &table), CW_OK);
  assert_int_equal(table.walls.layer_count, 0);
  assert_false(cw_case_given(table.walls.blade.y_plus));
  write_changed(18, "  growth_ratio: auto\n  y_plus_blade: 1\n  y_plus_hub_shroud: 2\n  y_plus_volute: 3\n"
                    "  first_height_pipe_um: 4");
  assert_int_equal(cw_case_read(path, &table), CW_OK);
  assert_false(cw_case_given(table.walls.growth_ratio));
  assert_false(cw_walls_auto(&table.walls));
}

// A key takes any unit of its quantity: 8 in = 203.2 mm, 100 US gal/min = 100 * 231 in3/min = 6.30902e-3 m3/s,
// 30 ft = 9.144 m, 25 Hz = 50 pi rad/s.
static void units_of_other_systems(void **state) {
  static const struct {
    int line;
    const char *text;
    size_t offset;
    double expected;
  } rows[] = {
      {10, "  outlet_diameter_in: 8", offsetof(CwCase, impeller.outlet_diameter), 0.2032},
      {3, "  flow_rate_gpm: 100", offsetof(CwCase, operating_point.flow_rate),
       100 * 231 * 0.0254 * 0.0254 * 0.0254 / 60},
      {4, "  head_ft: 30", offsetof(CwCase, operating_point.head), 9.144},
      {5, "  speed_hz: 25", offsetof(CwCase, operating_point.speed), 50 * 3.14159265358979323846},
  };
  for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
    CwCase table;
    double value;
    write_changed(rows[i].line, rows[i].text);
    assert_int_equal(cw_case_read(path, &table), CW_OK);
    memcpy(&value, (const char *)&table + rows[i].offset, sizeof value);
    if (fabs(value / rows[i].expected - 1) > 1e-14) fail_msg("%s is read as %.17g", rows[i].text, value);
  }
}

// A duty point is enough.
static void duty_point_alone(void **state) {
  static const char text[] = "name: a\noperating_point: {flow_rate_m3_per_h: 25, head_m: 10, speed_rpm: 1450}\n";
  CwCase table;
  write_text(path, text);
  assert_int_equal(cw_case_read(path, &table), CW_OK);
  assert_int_equal(table.impeller.blade_count, 0);
  assert_int_equal(table.impeller.priority, CW_PRIORITY_AUTO);
  assert_false(cw_case_given(table.impeller.outlet_diameter));
}

static void counts_of_cells_take_a_suffix(void **state) {
  CwCase table;
  write_changed(20, "  cells: 1.5M\n  cells_per_region: 200k");
  assert_int_equal(cw_case_read(path, &table), CW_OK);
  assert_int_equal(table.mesh.cells, 1500000);
  assert_int_equal(table.mesh.cells_per_region, 200000);
}

static void formats_are_chosen_in_a_list(void **state) {
  CwCase table;
  write_changed(20, "  cells: 1M\nexport: {formats: [fluent, cgns]}\nopenfoam: {labels: 64}");
  assert_int_equal(cw_case_read(path, &table), CW_OK);
  assert_int_equal(table.output.formats, 1 << CW_FORMAT_FLUENT | 1 << CW_FORMAT_CGNS);
  assert_int_equal(table.output.foam_labels, CW_INTEGERS_64);
  assert_int_equal(table.output.cgns_integers, CW_INTEGERS_AUTO);
  write_changed(20, "  cells: 1M\nexport: {formats: openfoam}");
  assert_int_equal(cw_case_read(path, &table), CW_OK);
  assert_int_equal(table.output.formats, 1 << CW_FORMAT_OPENFOAM);
  write_changed(20, "  cells: 1M\nexport: {formats: [cgns, star]}");
  assert_true(is_refused("21:26: export.formats: star is not one of the choices; allowed: a list of one or more of "
                         "cgns, openfoam, cfx, fluent or code_saturne"));
  write_changed(20, "  cells: 1M\nexport: {formats: []}");
  assert_true(is_refused("21:20: export.formats: the list has no value; allowed: a list of one or more of cgns, "
                         "openfoam, cfx, fluent or code_saturne"));
}

static void forms_that_yaml_allows(void **state) {
  static const BadCase fine[] = {
      {1, "%YAML 1.2\n---\nname: 'test'", NULL}, // directive, document start, quoted name
      {1, "\xef\xbb\xbfname: test", NULL},       // byte order mark
      {1, "name: test # caf\xc3\xa9", NULL},     // comment in UTF-8
      {4, "  head_m: +1.0e+1", NULL},
      {4, "  head_m: 10.", NULL},
      {4, "  \"head_m\": &h 10", NULL},
      {20, "  {cells: 20000,\n   size_pipe: .5}", NULL},
      {20, "  cells: 1000000\n...", NULL},
      {15, "  inlet_width_mm: 8", NULL}, // b3 = b2 is allowed
      {4, "  head_m: 10\r", NULL},
      {8, "  blade_count: 3", NULL},
      {8, "  blade_count: 9", NULL},
      {12, "  wrap_angle_deg: 71\n  hub_diameter_mm: 74e-3\n",
       "13:20: impeller.hub_diameter_mm: 74e-3 is out of "
       "range; allowed: 0.1 to 10000 mm"},
  };
  for (size_t i = 0; i < sizeof fine / sizeof *fine; ++i) {
    CwCase table;
    write_changed(fine[i].line, fine[i].replacement);
    if (fine[i].expected) {
      assert_true(is_refused(fine[i].expected));
      continue;
    }
    if (cw_case_read(path, &table) != CW_OK) fail_msg("%s: %s", fine[i].replacement, cw_fail_message());
  }
}

static void case_of_the_paper_is_valid(void **state) {
  CwCase table;
  if (cw_case_read(CUTWATER_SOURCE_DIR "/cases/paper/case.yaml", &table) != CW_OK) fail_msg("%s", cw_fail_message());
  assert_string_equal(table.name, "paper");
  assert_true(table.volute.base_diameter == 0.204);
  assert_true(fabs(table.walls.roughness - 25e-6) < 1e-18);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bad_cases_are_refused_at_their_place),
      cmocka_unit_test(whole_files_that_are_no_case),
      cmocka_unit_test(huge_file_is_refused),
      cmocka_unit_test(deep_nesting_is_refused),
      cmocka_unit_test(files_that_cannot_be_read),
      cmocka_unit_test(long_path_leaves_room_for_the_message),
      cmocka_unit_test(good_case_is_read_in_si),
      cmocka_unit_test(automatic_keys),
      cmocka_unit_test(units_of_other_systems),
      cmocka_unit_test(duty_point_alone),
      cmocka_unit_test(counts_of_cells_take_a_suffix),
      cmocka_unit_test(formats_are_chosen_in_a_list),
      cmocka_unit_test(forms_that_yaml_allows),
      cmocka_unit_test(case_of_the_paper_is_valid),
  };
  return cmocka_run_group_tests(tests, make_path, clear_test_folder);
}
