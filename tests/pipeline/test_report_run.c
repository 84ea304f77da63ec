// SPDX-License-Identifier: AGPL-3.0-or-later
// cutwater-report on a run of two boxes: one page, whole or not at all, and one line where something is
// wrong.
// Modules without a test of their own that it runs: drawing, page_curve, page_design, page_mesh, page_pictures,
// page_run, page_solve, page_view, picture_list, pictures, region_read.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "pipeline/atomic_file.h"
#include "pipeline/report/page.h"
#include "pipeline/report/page_parts.h"
#include "pipeline/sealed_json.h"
#include "pipeline/stage_files.h"
#include "tests/pipeline/box_run.h"
#include "tests/seal_run.h"

static char *read_in_run(const char *name) {
  return read_whole(in_test_folder(name), NULL);
}

static int there(const char *name) {
  return access(in_test_folder(name), F_OK) == 0;
}

// Whether nothing half-written lies beside the page.
static int is_clean(void) {
  char command[200];
  snprintf(command, sizeof command, "! ls -A '%s/report' | grep -q '^\\.part-'", test_folder);
  return system(command) == 0;
}

// clang-format off
#define DOMAIN(name, patch) \
  "{\"layers\":3,\"name\":\"" name "\",\"points\":8,\"tetrahedra\":0,\"prisms\":2,\"mesh_volume_m3\":1.6e-5," \
  "\"tetrahedron_aspect_class\":[0,0,0,0,0,0,0,0]," \
  "\"least_dihedral_bins\":[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0]," \
  "\"prism_scaled_jacobian_bins\":[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,2,0]," \
  "\"layer_coverage\":[{\"patch\":\"" patch "\",\"wall_faces\":40,\"full_thickness_faces\":30," \
  "\"first_height_met_faces\":39,\"first_height_asked_m\":2.5e-4,\"first_height_target_m\":2.2e-4," \
  "\"y_plus\":24,\"mean_thickness_m\":1.5e-3," \
  "\"least_thickness_m\":1e-3,\"thinned_by_gap_faces\":10,\"thinned_by_gradation_faces\":0," \
  "\"thinned_by_repair_faces\":0}],\"region_list\":[{\"region\":1,\"seconds\":0.5}]}"
// clang-format on

static int make_run(void **state) {
  if (make_test_folder(state)) return -1;
  assert_int_equal(cw_make_directory(in_test_folder("geometry")), CW_OK);
  assert_int_equal(cw_make_directory(in_test_folder("mesh")), CW_OK);
  write_in_run("geometry/design.json", "{\"predicted_head_m\":12.87,\"interface_radius_m\":0.101,\"blade_count\":6,"
                                       "\"outlet_diameter_m\":0.2,\"base_diameter_m\":0.204,"
                                       "\"outlet_blade_angle_deg\":39.116,\"throat_area_m2\":8.6647e-4,"
                                       "\"sources\":{\"throat_area_m2\":\"constant <K>\"}}");
  write_record("geometry/record.json", "{\"stage\":\"geometry\",\"seconds\":2,\"peak_memory_bytes\":1048576,\"steps\":"
                                       "[{\"name\":\"rotor\",\"seconds\":1.5,\"items\":62,\"unit\":\"faces\"}],"
                                       "\"warnings\":[\"skewed & sharp\"],\"results\":{}}");
  write_in_run("geometry/velocity_triangles.svg", "<svg width=\"9\" height=\"9\"><!-- triangles --></svg>");
  write_record("mesh/record.json",
               "{\"stage\":\"mesh\",\"seconds\":3,\"peak_memory_bytes\":2097152,\"steps\":"
               "[{\"name\":\"surface\",\"seconds\":1,\"items\":9,\"unit\":\"faces\"},"
               "{\"name\":\"surface\",\"seconds\":1.25,\"items\":9,\"unit\":\"faces\"}],"
               "\"warnings\":[],\"results\":{\"ranks\":2,\"asked_cells\":5,\"headlines\":[\"laminar <flow>\"],"
               "\"domains\":[" DOMAIN("rotor", "hub") "," DOMAIN("stator", "volute") "]}}");
  write_in_run("mesh/manifest.json", MANIFEST);
  write_region("rotor", 0.03, 0.101, 7);
  write_region("stator", 0.101, 0.14, 7);
  return seal_run(test_folder);
}

// Runs the program by itself or by a launcher; returns its exit status and what it said.
static int report_by(const char *launcher, char said[4000]) {
  char command[600];
  snprintf(command, sizeof command, "%s %s/cutwater-report --case %s --run %s 2>&1", launcher, CUTWATER_BIN_DIR, CASE,
           test_folder);
  FILE *pipe = popen(command, "r");
  assert_non_null(pipe);
  size_t length = fread(said, 1, 3999, pipe);
  said[length] = '\0';
  int status = pclose(pipe);
  assert_true(WIFEXITED(status));
  return WEXITSTATUS(status);
}

static int report(char said[4000]) {
  return report_by("", said);
}

static void fails(int code, const char *message) {
  char said[4000];
  int status = report(said);
  if (status != code || !strstr(said, message)) fail_msg("exit status %d and: %s", status, said);
  const char *error = strstr(said, "cutwater-report: error: "); // one line, the last
  assert_non_null(error);
  assert_ptr_equal(strchr(error, '\n'), said + strlen(said) - 1);
  assert_false(there("report/index.html"));
  assert_true(is_clean());
}

static void holds(const char *page, const char *text) {
  if (!strstr(page, text)) fail_msg("not in the page: %s", text);
}

// Wherever `page` holds `start`, it goes on as `whole`; and it does so somewhere.
static void every(const char *page, const char *start, const char *whole) {
  int count = 0;
  for (const char *at = page; (at = strstr(at, start)); at++, count++) {
    if (strncmp(at, whole, strlen(whole))) fail_msg("in the page: %.60s", at);
  }
  assert_true(count > 0);
}

// Each chapter has one link before it, and each link its chapter.
static void links_lead_to_chapters(const char *page) {
  char id[40], wanted[80];
  int links = 0, chapters = 0;
  for (const char *at = page; (at = strstr(at, "<h2 id=\"")); at++, chapters++) {
    assert_int_equal(sscanf(at, "<h2 id=\"%39[^\"]", id), 1);
    snprintf(wanted, sizeof wanted, "<a href=\"#%s\">", id);
    holds(page, wanted);
  }
  const char *end = strstr(page, "</nav>");
  for (const char *at = page; (at = strstr(at, "<a href=\"#")) && at < end; at++, links++) {
    assert_int_equal(sscanf(at, "<a href=\"#%39[^\"]", id), 1);
    snprintf(wanted, sizeof wanted, " id=\"%s\"", id);
    holds(page, wanted);
  }
  assert_true(chapters > 0);
  assert_int_equal(links, chapters + 1); // the first leads to the top
}

static int count_of(const char *page, const char *text) {
  int count = 0;
  for (const char *at = page; (at = strstr(at, text)); at++) count++;
  return count;
}

static void page_tells_all_and_stands_alone(void **state) {
  char said[4000];
  if (report(said) != 0) fail_msg("%s", said);
  char *page = read_in_run("report/index.html");
  assert_non_null(page);
  assert_true(there("report/record.json"));
  assert_true(is_clean());
  holds(page, "<b>1 + 1</b><span>regions of rotor and stator</span>");
  holds(page, "<b>4</b><span>cells; 5 asked, -20.00");
  holds(page, "12.87&#8239;m");
  holds(page, ">866<span>.47</span>"); // throat area in mm2
  holds(page, "constant &lt;K&gt;");   // its source
  holds(page, "<svg width=\"9\" height=\"9\"><!-- triangles --></svg>");
  holds(page, "<figcaption><b>Velocity triangles</b></figcaption>");
  links_lead_to_chapters(page);
  assert_int_equal(count_of(page, "<figure"), count_of(page, "</figure>"));
  assert_int_equal(count_of(page, "<table"), count_of(page, "</table>"));
  holds(page, ">97.5 %<"); // first heights met
  holds(page, "<p>Layers on every wall face: rotor 3, stator 3; 5 asked. ");
  const char *headline = strstr(page, "laminar &lt;flow&gt;");
  assert_non_null(headline);
  assert_true(headline < strstr(page, "<h2"));
  const char *remarks = strstr(page, "<summary>Geometry: 1 warning</summary>");
  assert_true(remarks && remarks < strstr(page, "<h2"));
  holds(page, "mesh: surface</text>");
  holds(page, "2.25 s, 9 faces, 2 passes"); // two passes added up
  holds(page, "geometry:</b> skewed &amp; sharp");
  holds(page, "has not been exported");
  holds(page, "Not drawn: the mesh has no such patch."); // no leading edge
  // Nothing outside: all sources are data, all links lead into the page, the one address is the name of SVG.
  every(page, "src=\"", "src=\"data:image/png;base64,iVBORw0KGgo");
  every(page, "href=\"", "href=\"#");
  every(page, "http", "http://www.w3.org/2000/svg");
  // Two scripts, the page's own: the data of the picture that turns, and its viewer.
  assert_null(strstr(page, "<script src"));
  holds(page, "<figure id=\"view\"");
  holds(page, "id=\"view-data\">{\"step\":");
  holds(page, "getContext(\"webgl\"");
  assert_null(strstr(page, "nan"));
  // The same bytes each time.
  assert_int_equal(report(said), 0);
  char *again = read_in_run("report/index.html");
  assert_string_equal(page, again);
  free(again);
  // And with two ranks that draw a region each, or a third that has none.
  static const char *const launchers[] = {"mpirun -q --oversubscribe -n 2", "mpirun -q --oversubscribe -n 3"};
  for (int k = 0; k < 2; k++) {
    if (report_by(launchers[k], said) != 0) fail_msg("%s", said);
    again = read_in_run("report/index.html");
    assert_true(strcmp(page, again) == 0);
    free(again);
  }
  free(page);
}

// The page without its pictures, as it is checked before they are drawn. The caller frees it.
static char *page_without_pictures(void) {
  CwCase table;
  CwReportData data;
  char *page = NULL;
  size_t size = 0;
  assert_int_equal(cw_case_read(CASE, &table), CW_OK);
  assert_int_equal(cw_report_data_read(test_folder, &table, &data), CW_OK);
  FILE *stream = open_memstream(&page, &size);
  assert_int_equal(cw_page_write(stream, &data), CW_OK);
  fclose(stream);
  cw_report_data_free(&data);
  return page;
}

static void tables_tell_what_was_asked(void **state) {
  char *page = page_without_pictures();
  holds(page, "<td>Difference from the correlations that is warned of, share</td>");
  assert_null(strstr(page, "Warn share")); // its key
  // y+ and first height, each as asked and as made.
  holds(page, "<tr><td>Hub</td><td class=\"n\">30<span></span></td><td class=\"n\">24<span></span></td>"
              "<td class=\"n\">250<span></span></td><td class=\"n\">220<span></span></td><td class=\"n\">97.5 %</td>");
  free(page);
}

static void blades_are_told_where_passages_are_equal(void **state) {
  char *page = page_without_pictures(), *manifest = read_in_run("mesh/manifest.json");
  holds(page, "Centrifugal pump, 6 blades, D<sub>2</sub>");
  free(page);
  *strchr(strstr(manifest, "\"blade_count\""), '6') = '1';
  write_in_run("mesh/manifest.json", manifest);
  free(manifest);
  page = page_without_pictures();
  holds(page, "Centrifugal pump, D<sub>2</sub>");
  free(page);
}

static void export_figures_are_shown(void **state) {
  assert_int_equal(cw_make_directory(in_test_folder("export")), CW_OK);
  write_record("export/record.json", "{\"stage\":\"export\",\"seconds\":1,\"peak_memory_bytes\":1,\"steps\":[],"
                                     "\"warnings\":[],\"results\":{\"cells\":4,\"rotor\":{\"volume_m3\":0.00025012345},"
                                     "\"interfaces\":[{\"domains\":[\"rotor\",\"stator\"],\"faces\":[7,8]}],"
                                     "\"patches\":[{\"name\":\"hub\",\"triangles\":12345}]}}");
  assert_int_equal(seal_run(test_folder), 0);
  char *page = page_without_pictures();
  holds(page, "<tr><td>Volume</td><td class=\"n\">250.12</td><td>cm&sup3;</td></tr>"); // five digits
  holds(page, "<h3>Patches</h3>");
  holds(page, "<td>rotor, stator</td><td>7, 8</td>");
  holds(page, "12\342\200\257345");
  assert_null(strstr(page, "flow rate m3 per h")); // the record's case is not shown as a result
  assert_null(strstr(page, "has not been exported"));
  free(page);
}

static int times(const char *text, const char *words) {
  int count = 0;
  for (; (text = strstr(text, words)); text++) count++;
  return count;
}

// Only a designed pump has a predicted head away from its point, and one point of the rest.
static void the_curve_has_the_heads_that_there_are(void **state) {
  CwCase table = {.operating_point.head = 10};
  json_t *points = json_loads("[{\"flow_m3_per_h\":20,\"flow_share\":0.8,\"head_m\":12,\"shaft_power_w\":900,"
                              "\"hydraulic_efficiency\":0.7,\"npsh_inception_m\":2},"
                              "{\"flow_m3_per_h\":25,\"flow_share\":1,\"head_m\":11,\"shaft_power_w\":1000,"
                              "\"hydraulic_efficiency\":0.75,\"npsh_inception_m\":3}]",
                              0, NULL);
  json_t *design = json_loads("{\"impeller_tip_speed_m_per_s\":15,\"slip_factor\":0.8,\"hydraulic_efficiency\":0.9,"
                              "\"outlet_swirl_speed_m_per_s\":9,\"predicted_head_m\":10,\"shaft_power_w\":1100,"
                              "\"npsh_required_m\":1,\"npsh_available_m\":10}",
                              0, NULL);
  for (int designed = 0; designed < 2; designed++) {
    const CwReportData data = {.table = &table, .design = designed ? design : NULL};
    char *page = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&page, &size);
    assert_int_equal(cw_page_curve(stream, &data, "x", points), CW_OK);
    fclose(stream);
    holds(page, ">solved</text>");
    assert_int_equal(strstr(page, ">design</text>") != NULL, designed);
    assert_int_equal(strstr(page, "The design's is Euler's") != NULL, designed);
    // The charts of head, power, efficiency and NPSH, the last three with one point of the design.
    assert_int_equal(times(page, "<svg class=\"plot\""), 4);
    assert_int_equal(times(page, "<circle"), designed ? 13 : 8);
    assert_int_equal(times(page, "The design predicts one point"), designed ? 3 : 0);
    assert_int_equal(times(page, "makes available"), designed);
    assert_int_equal(times(page, "class=\"m\""), 1 + designed); // asked head, and available NPSH
    if (designed) holds(page, "<td class=\"n\">10</td>");       // the design's head at its point
    free(page);
  }
  json_decref(points);
  json_decref(design);
}

// The record of a flow that was solved on an export of these files.
static void write_solve(json_t *made_from) {
  json_t *record = json_pack("{s:o,s:f,s:[s],s:{s:i}}", "made_from", made_from, "seconds", 1.0, "warnings", "it drifts",
                             "results", "iterations", 300);
  assert_int_equal(cw_sealed_json_write(record, in_test_folder("solve/record.json")), CW_OK);
  json_decref(record);
}

static void a_flow_of_another_export_is_not_told(void **state) {
  json_t *made_from;
  assert_int_equal(cw_make_directory(in_test_folder("export")), CW_OK);
  assert_int_equal(cw_make_directory(in_test_folder("solve")), CW_OK);
  write_record("export/record.json", "{\"stage\":\"export\",\"seconds\":1,\"peak_memory_bytes\":1,\"steps\":[],"
                                     "\"warnings\":[],\"results\":{\"cells\":4}}");
  assert_int_equal(seal_run(test_folder), 0);
  write_solve(json_pack("{s:s}", "export", "12"));
  char *page = page_without_pictures();
  holds(page, "The flow was solved on another export: solve it again");
  assert_null(strstr(page, "it drifts"));
  free(page);
  // Of this one it is told; what else the record must have is looked for.
  assert_int_equal(cw_stage_files_read(test_folder, (const char *const[]){"export", NULL}, &made_from), CW_OK);
  write_solve(made_from);
  fails(CW_ERR_INPUT, "solve/record.json: 'history' must be there and an object");
  char *text = read_in_run("solve/record.json");
  *strstr(text, "300") = '2';
  write_in_run("solve/record.json", text);
  free(text);
  fails(CW_ERR_IO, "solve/record.json: is not as the stage wrote it");
}

// Files of a stage that are not those it wrote, or not those that a later one was made from.
static void files_that_do_not_belong_together_are_told(void **state) {
  char first[300];
  assert_int_equal(cw_make_directory(in_test_folder("export")), CW_OK);
  write_in_run("export/pump.cgns", "a mesh, for whoever looks at its digest alone");
  write_record("export/record.json", "{\"stage\":\"export\",\"seconds\":1,\"peak_memory_bytes\":1,\"steps\":[],"
                                     "\"warnings\":[],\"results\":{\"cells\":4,\"interfaces\":[],\"patches\":[]}}");
  assert_int_equal(seal_run(test_folder), 0);
  write_in_run("export/pump.cgns", "a mesh, for whoever looks at its digest alon");
  fails(CW_ERR_IO, "export/pump.cgns: is not as cutwater-export wrote it: damaged or replaced; run cutwater-export");
  write_in_run("export/pump.cgns", "a mesh, for whoever looks at its digest alone");
  write_in_run("geometry/velocity_triangles.svg", "<svg></svg>");
  fails(CW_ERR_IO, "geometry/velocity_triangles.svg: is not as cutwater-geometry wrote it");
  // The geometry is made again and another one: the mesh is not of it.
  char *mesh_record = read_in_run("mesh/record.json");
  assert_int_equal(seal_run(test_folder), 0);
  write_in_run("mesh/record.json", mesh_record);
  free(mesh_record);
  snprintf(first, sizeof first, "%s/mesh: was made from other files than lie in %s/geometry; run cutwater-mesh again",
           test_folder, test_folder);
  fails(CW_ERR_INPUT, first);
  // A record that was changed by hand.
  assert_int_equal(seal_run(test_folder), 0);
  char *text = read_in_run("geometry/record.json");
  *strstr(text, "1.5") = '2';
  write_in_run("geometry/record.json", text);
  free(text);
  fails(CW_ERR_IO, "geometry/record.json: is not as the stage wrote it");
}

static void domains_of_another_mesh_are_told(void **state) {
  char *text = read_in_run("mesh/record.json"), *changed = read_in_run("mesh/record.json");
  memcpy(strstr(changed, "\"stator\""), "\"status\"", 8);
  write_in_run("mesh/record.json", changed);
  assert_int_equal(seal_run(test_folder), 0);
  fails(CW_ERR_INPUT, "mesh/record.json: results: domain 2 is 'status'; it must be 'stator'");
  write_in_run("mesh/record.json", text);
  assert_int_equal(seal_run(test_folder), 0);
  free(text);
  free(changed);
}

static void missing_files_are_named(void **state) {
  static const char *const names[] = {"geometry/design.json", "geometry/record.json", "mesh/record.json",
                                      "mesh/manifest.json", "mesh/stator-0001.h5"};
  for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
    assert_int_equal(rename(in_test_folder(names[k]), in_test_folder("aside")), 0);
    fails(CW_ERR_IO, names[k]);
    assert_int_equal(rename(in_test_folder("aside"), in_test_folder(names[k])), 0);
  }
}

static void wrong_content_is_named(void **state) {
  static const struct {
    const char *file, *text, *message;
  } wrong[] = {
      {"mesh/manifest.json", "{\"format\":1,", "mesh/manifest.json:1:"},
      {"mesh/manifest.json", "{\"format\":1}", "'format' must be 3"},
      {"mesh/manifest.json", "{\"format\":3,\"domains\":[]}", "'domains' is empty"},
      {"geometry/design.json", "[]", "object"},
      {"geometry/design.json", "{}", "blade_count"},
      {"geometry/design.json", "{\"blade_count\":6}", "outlet_diameter_m"},
      {"geometry/record.json", "{\"stage\":\"mesh\"}", "'stage' is mesh"},
      {"mesh/record.json",
       "{\"stage\":\"mesh\",\"seconds\":1,\"peak_memory_bytes\":1,\"steps\":[],\"warnings\":[],"
       "\"results\":{}}",
       "'asked_cells'"},
      {"mesh/record.json", "{\"case\":{}}", "mesh: made with name: (left out), the case file has paper"},
      {"geometry/velocity_triangles.svg", "<svg>", "not a whole SVG"},
  };
  for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
    assert_int_equal(rename(in_test_folder(wrong[k].file), in_test_folder("aside")), 0);
    (strstr(wrong[k].text, "\"stage\"") ? write_record : write_in_run)(wrong[k].file, wrong[k].text);
    assert_int_equal(seal_run(test_folder), 0);
    fails(CW_ERR_INPUT, wrong[k].message);
    assert_int_equal(rename(in_test_folder("aside"), in_test_folder(wrong[k].file)), 0);
  }
  write_in_run("mesh/rotor-0001.h5", "no HDF5");
  assert_int_equal(seal_run(test_folder), 0);
  fails(CW_ERR_IO, "mesh/rotor-0001.h5: is missing, damaged or cut short");
  write_region("rotor", 0.03, 0.101, 7);
  fails(CW_ERR_INPUT, "mesh/rotor-0001.h5: is not the file that the manifest tells of");
  write_region("rotor", 0.03, 0.101, 8);
  assert_int_equal(seal_run(test_folder), 0);
  fails(CW_ERR_INPUT, "'prisms': entry 10 is 8; allowed 0 to 7");
}

int main(void) {
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(page_tells_all_and_stands_alone, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(tables_tell_what_was_asked, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(blades_are_told_where_passages_are_equal, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(export_figures_are_shown, make_run, clear_test_folder),
      cmocka_unit_test(the_curve_has_the_heads_that_there_are),
      cmocka_unit_test_setup_teardown(a_flow_of_another_export_is_not_told, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(files_that_do_not_belong_together_are_told, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(domains_of_another_mesh_are_told, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(missing_files_are_named, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(wrong_content_is_named, make_run, clear_test_folder),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
