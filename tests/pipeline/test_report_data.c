// SPDX-License-Identifier: AGPL-3.0-or-later
// What the report reads of a run, what it refuses, and what the pictures take from it.
#include "pipeline/report/report_data.h"

#include <math.h>

#include "pipeline/atomic_file.h"
#include "pipeline/sealed_json.h"
#include "pipeline/stage_files.h"
#include "tests/pipeline/box_run.h"
#include "tests/seal_run.h"

static CwCase table;
static char run[sizeof test_folder];

static const char design[] = "{\"blade_count\": 6, \"outlet_diameter_m\": 0.2, \"interface_radius_m\": 0.101, "
                             "\"base_diameter_m\": 0.206}";
static const char stage[] = "{\"stage\": \"%s\", \"seconds\": 2, \"peak_memory_bytes\": 1024, \"steps\": [{\"name\": "
                            "\"a\", \"seconds\": 1.5}], \"warnings\": [], \"results\": {\"domains\": [{\"name\": "
                            "\"rotor\"}, {\"name\": \"stator\"}]}}";

static void write_stage(const char *name) {
  char text[600], path[40];
  snprintf(text, sizeof text, stage, name);
  assert_int_equal(cw_make_directory(in_test_folder(name)), CW_OK);
  snprintf(path, sizeof path, "%s/record.json", name);
  write_record(path, text);
}

static int make_run(void **state) {
  if (make_test_folder(state) || cw_case_read(CASE, &table) != CW_OK) return -1;
  snprintf(run, sizeof run, "%s", test_folder);
  write_stage("geometry");
  write_stage("mesh");
  write_in_run("geometry/design.json", design);
  write_in_run("mesh/manifest.json", MANIFEST);
  return seal_run(test_folder);
}

static CwReportData read_run(void) {
  CwReportData data;
  if (cw_report_data_read(run, &table, &data) != CW_OK) fail_msg("%s", cw_fail_message());
  return data;
}

static void assert_refused(CwStatus wanted, const char *message) {
  CwReportData data;
  assert_int_equal(cw_report_data_read(run, &table, &data), wanted);
  if (!strstr(cw_fail_message(), message)) fail_msg("no '%s' in: %s", message, cw_fail_message());
  cw_fail_clear();
  cw_report_data_free(&data);
  assert_null(data.run);
}

// Puts a value (JSON; NULL: none) at a key of a stage's record, which stays sealed.
static void change(const char *name, const char *key, const char *value) {
  json_t *record;
  char path[60];
  snprintf(path, sizeof path, "%s/record.json", name);
  assert_int_equal(cw_sealed_json_read(in_test_folder(path), &record), CW_OK);
  if (value)
    json_object_set_new(record, key, json_loads(value, JSON_DECODE_ANY, NULL));
  else
    json_object_del(record, key);
  json_object_del(record, "digest");
  assert_int_equal(cw_sealed_json_write(record, in_test_folder(path)), CW_OK);
  json_decref(record);
}

static void what_the_stages_wrote_is_there(void **state) {
  CwReportData data = read_run();
  assert_string_equal(data.run, run);
  assert_ptr_equal(data.table, &table);
  assert_int_equal(json_integer_value(json_object_get(data.design, "blade_count")), 6);
  assert_non_null(data.record[0]);
  assert_non_null(data.record[1]);
  assert_null(data.record[CW_STAGE_OF_EXPORT]);
  assert_null(data.solve);
  assert_false(data.is_solved || data.flow.present);
  assert_int_equal(data.mesh.domain_count, 2);
  assert_int_equal(data.mesh.patch_count, 8);
  cw_report_data_free(&data);
  assert_int_equal(remove(in_test_folder("geometry/design.json")), 0); // no generator made the pump
  data = read_run();
  assert_null(data.design);
  cw_report_data_free(&data);
}

// Each member of a record that the page takes from it.
static void wrong_records_are_told(void **state) {
  static const struct {
    const char *key, *value, *message;
  } wrong[] = {{"stage", "\"mesh\"", "'stage' is mesh; it must be geometry"},
               {"stage", NULL, "'stage'"},
               {"seconds", "-1", "'seconds' must be a number from 0"},
               {"seconds", NULL, "'seconds' must be a number from 0"},
               {"peak_memory_bytes", "\"much\"", "'peak_memory_bytes' must be a number from 0"},
               {"steps", "{}", "'steps'"},
               {"steps", "[{\"seconds\": 1}]", "'name'"},
               {"steps", "[{\"name\": \"b\", \"seconds\": 1}, {\"name\": \"a\", \"seconds\": -0.5}]",
                "'seconds' of step 'a' must be a number from 0"},
               {"warnings", "3", "'warnings'"},
               {"results", "[]", "'results'"}};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    char *whole = read_whole(in_test_folder("geometry/record.json"), NULL);
    change("geometry", wrong[i].key, wrong[i].value);
    assert_refused(CW_ERR_INPUT, wrong[i].message);
    write_in_run("geometry/record.json", whole);
    free(whole);
  }
  char *text = read_whole(in_test_folder("mesh/record.json"), NULL);
  *strstr(text, "1024") = '2';
  write_in_run("mesh/record.json", text);
  free(text);
  assert_refused(CW_ERR_IO, "mesh/record.json: is not as the stage wrote it");
  assert_int_equal(remove(in_test_folder("mesh/record.json")), 0);
  assert_refused(CW_ERR_IO, "mesh/record.json");
}

// An export is optional, but of this case.
static void an_export_is_of_this_case(void **state) {
  write_stage("export");
  assert_int_equal(seal_run(test_folder), 0);
  CwReportData data = read_run();
  assert_non_null(data.record[CW_STAGE_OF_EXPORT]);
  cw_report_data_free(&data);
  table.impeller.outlet_diameter *= 1.01;
  assert_refused(CW_ERR_INPUT, "export: made with impeller.outlet_diameter_mm");
}

static void write_solve(json_t *made_from) {
  json_t *record = json_pack("{s:o,s:[],s:{}}", "made_from", made_from, "warnings", "results");
  assert_int_equal(cw_sealed_json_write(record, in_test_folder("solve/record.json")), CW_OK);
  json_decref(record);
}

// A solved flow counts where it was made from the files of the export that is there.
static void a_flow_is_of_the_export(void **state) {
  json_t *made_from;
  assert_int_equal(cw_make_directory(in_test_folder("solve")), CW_OK);
  write_solve(json_object()); // and nothing was exported
  CwReportData data = read_run();
  assert_non_null(data.solve);
  assert_false(data.is_solved);
  cw_report_data_free(&data);
  write_stage("export");
  write_in_run("export/pump.cgns", "a mesh");
  assert_int_equal(seal_run(test_folder), 0);
  data = read_run();
  assert_false(data.is_solved);
  cw_report_data_free(&data);
  assert_int_equal(cw_stage_files_read(test_folder, (const char *const[]){"export", NULL}, &made_from), CW_OK);
  write_solve(made_from);
  data = read_run();
  assert_true(data.is_solved);
  assert_false(data.flow.present); // no fields
  cw_report_data_free(&data);
  write_in_run("export/pump.cgns", "another mesh");
  assert_int_equal(seal_run(test_folder), 0);
  data = read_run();
  assert_false(data.is_solved);
  cw_report_data_free(&data);
}

// Blades with their splitters; leading edges of whole blades lie up to a tenth outside of the larger of both radii.
static void sizes_are_those_of_the_design(void **state) {
  CwReportData data = read_run();
  CwPumpSizes sizes;
  assert_int_equal(cw_report_sizes(&data, &sizes), CW_OK);
  assert_int_equal(sizes.blade_count, 6);
  assert_true(isinf(sizes.leading_radius));
  assert_near(sizes.outlet_radius, 0.1, 1e-15);
  assert_near(sizes.interface_radius, 0.101, 1e-15);
  assert_near(sizes.base_radius, 0.103, 1e-15);
  assert_int_equal(sizes.suction, -1); // counter-clockwise, seen from the drive
  json_object_set_new(data.design, "splitter_count", json_integer(6));
  json_object_set_new(data.design, "leading_edge_radius_hub_m", json_real(0.04));
  json_object_set_new(data.design, "leading_edge_radius_shroud_m", json_real(0.05));
  assert_int_equal(cw_report_sizes(&data, &sizes), CW_OK);
  assert_int_equal(sizes.blade_count, 12);
  assert_near(sizes.leading_radius, 0.055, 1e-15);
  json_object_set_new(data.design, "leading_edge_radius_hub_m", json_real(0.06));
  assert_int_equal(cw_report_sizes(&data, &sizes), CW_OK);
  assert_near(sizes.leading_radius, 0.066, 1e-15);
  static const char *const keys[] = {"blade_count", "outlet_diameter_m", "interface_radius_m", "base_diameter_m"};
  for (int k = 0; k < 4; k++) {
    json_t *value = json_incref(json_object_get(data.design, keys[k]));
    json_object_set_new(data.design, keys[k], json_real(-1));
    assert_int_equal(cw_report_sizes(&data, &sizes), CW_ERR_INPUT);
    assert_non_null(strstr(cw_fail_message(), "/geometry/design.json: "));
    assert_non_null(strstr(cw_fail_message(), keys[k]));
    cw_fail_clear();
    json_object_set_new(data.design, keys[k], value);
  }
  cw_report_data_free(&data);
}

// Without a design those of the model: the first cylinder between zones, else the wheel itself; its suction side is
// that of the record.
static void sizes_of_a_drawn_pump_are_those_of_the_model(void **state) {
  CwModelInterface interfaces[] = {
      {{0, 0}, CW_SURFACE_PLANE, 0.3}, {{0, 0}, CW_SURFACE_CYLINDER, 0.11}, {{0, 0}, CW_SURFACE_CYLINDER, 0.05}};
  json_t *record = json_pack("{s:{s:i}}", "results", "suction_side", 1);
  CwReportData data = {.table = &table, .record = {record}};
  CwPumpSizes sizes;
  data.mesh =
      (CwMesh){.interfaces = interfaces, .interface_count = 3, .flow = {.blade_count = 5, .reference_length = 0.2}};
  assert_int_equal(cw_report_sizes(&data, &sizes), CW_OK);
  assert_int_equal(sizes.blade_count, 5);
  assert_true(isinf(sizes.leading_radius));
  assert_near(sizes.outlet_radius, 0.1, 1e-15);
  assert_near(sizes.interface_radius, 0.11, 0);
  assert_near(sizes.base_radius, 0.11, 0);
  assert_int_equal(sizes.suction, 1);
  data.mesh.interface_count = 1;
  assert_int_equal(cw_report_sizes(&data, &sizes), CW_OK);
  assert_near(sizes.interface_radius, 0.1, 1e-15);
  json_decref(record);
}

static void domains_are_those_of_the_mesh(void **state) {
  CwReportData data = read_run();
  json_t *domain[CW_DOMAINS_MOST];
  assert_int_equal(cw_report_mesh_domains(&data, domain), CW_OK);
  assert_string_equal(json_string_value(json_object_get(domain[0], "name")), "rotor");
  assert_string_equal(json_string_value(json_object_get(domain[1], "name")), "stator");
  strcpy(data.mesh.domains[1].name, "casing");
  assert_int_equal(cw_report_mesh_domains(&data, domain), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "/mesh/record.json: results: domain 2 is 'stator'; it must be 'casing'"));
  cw_fail_clear();
  strcpy(data.mesh.domains[1].name, "stator");
  json_array_remove(json_object_get(json_object_get(data.record[1], "results"), "domains"), 1);
  assert_int_equal(cw_report_mesh_domains(&data, domain), CW_ERR_INPUT);
  cw_fail_clear();
  cw_report_data_free(&data);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(what_the_stages_wrote_is_there, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(wrong_records_are_told, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(an_export_is_of_this_case, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(a_flow_is_of_the_export, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(sizes_are_those_of_the_design, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(sizes_of_a_drawn_pump_are_those_of_the_model, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(domains_are_those_of_the_mesh, make_run, clear_test_folder),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
