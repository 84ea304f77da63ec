// SPDX-License-Identifier: AGPL-3.0-or-later
// Counts, regions, quality and layers of a mesh of three domains, as tables and charts.
#include "tests/pipeline/page_text.h"

#define DASH "\342\200\223"

enum { ROTOR, STATOR, SUCTION, DOMAINS, REGIONS = 4, PATCHES = 3 };

static CwCase table;
static CwMeshRegion regions[REGIONS];
static CwModelPatch patches[PATCHES];
static CwReportData data;

// What the mesher's record has of a domain, beside what a test adds.
static const char record[] =
    "{'results': {'domains': ["
    "{'name': 'rotor', 'points': 50, 'layers': 5, 'mesh_volume_m3': 1.2345e-4, 'solid_volume_m3': 1.25e-4,"
    " 'volume_error': -0.0124, 'least_cell_volume_m3': 2e-12, 'region_balance': 1.25, 'interfaces': 2,"
    " 'region_prediction_error': 0.127, 'colours': 3,"
    " 'patches': [{'name': 'hub_nut', 'kind': 'wall', 'area_m2': 0.0125}, {'name': 'inlet', 'kind': 'inlet',"
    " 'area_m2': 0.004}], 'region_list': [{'seconds': 2.5}, {}],"
    " 'tetrahedron_aspect_mean': 1.75, 'tetrahedron_aspect_max': 6.5, 'least_dihedral_deg': 11.5,"
    " 'greatest_dihedral_deg': 151.25, 'tetrahedra_beside_planes': {'mean_ratio_mean': 0.75},"
    " 'tetrahedra_apart': {'mean_ratio_mean': 0.875}, 'prism_least_scaled_jacobian': 0.25},"
    "{'name': 'stator', 'points': 70, 'layers': 4, 'patches': []},"
    "{'name': 'suction', 'points': 9, 'layers': 5, 'patches': [{'name': 'pipe', 'kind': 'wall', 'area_m2': 0.5}]}]}}";

// Two regions of the rotor, one each of the others; 100 and 300, 200 and 40 cells.
static int make_data(void **state) {
  static const CwMeshRegion all[REGIONS] = {
      {.domain = ROTOR, .region = 1, .tetrahedra = 60, .prisms = 40, .triangles = 12, .quads = 3},
      {.domain = ROTOR, .region = 2, .tetrahedra = 250, .prisms = 30, .pyramids = 20, .triangles = 8},
      {.domain = STATOR, .region = 1, .tetrahedra = 150, .prisms = 50, .quads = 7},
      {.domain = SUCTION, .region = 1, .prisms = 40, .triangles = 1}};
  static const CwModelPatch wall[PATCHES] = {
      {.name = "hub_nut", .kind = CW_PATCH_WALL, .group = CW_GROUP_HUB_SHROUD, .y_plus_asked = NAN},
      {.name = "blade", .kind = CW_PATCH_WALL, .group = CW_GROUP_BLADE, .y_plus_asked = NAN},
      {.name = "pipe", .kind = CW_PATCH_WALL, .group = CW_GROUP_PIPE, .domain = SUCTION, .y_plus_asked = 7}};
  memcpy(regions, all, sizeof all);
  memcpy(patches, wall, sizeof wall);
  table = (CwCase){.walls = {.hub_shroud = {.y_plus = 30, .first_height = NAN},
                             .blade = {.y_plus = 1, .first_height = 2e-5},
                             .pipe = {.y_plus = 40, .first_height = NAN}}};
  data = (CwReportData){.table = &table, .run = "RUN", .record = {NULL, json_of(record)}};
  data.mesh = (CwMesh){.domain_count = DOMAINS,
                       .domains = {{.name = "rotor", .region_count = 2, .patch_count = 2},
                                   {.name = "stator", .first_region = 2, .region_count = 1, .first_patch = 2},
                                   {.name = "suction", .first_region = 3, .region_count = 1, .first_patch = 2}},
                       .region_count = REGIONS,
                       .regions = regions,
                       .patch_count = PATCHES,
                       .patches = patches};
  return 0;
}

static int free_data(void **state) {
  for (int s = 0; s < CW_STAGES; s++) json_decref(data.record[s]);
  return 0;
}

static json_t *domain_of(int d) {
  return json_array_get(json_object_get(json_object_get(data.record[1], "results"), "domains"), (size_t)d);
}

static void set(int d, const char *key, const char *text) {
  json_object_set_new(domain_of(d), key, json_of(text));
}

static void counts_are_sums_over_regions(void **state) {
  char *page = page_of(cw_page_counts, &data);
  assert_row(page, "|Rotor|Stator|Suction|Together");
  assert_row(page, "Tetrahedra|310|150|0|460");
  assert_row(page, "Prisms|70|50|40|160");
  assert_row(page, "Pyramids|20|0|0|20");
  assert_row(page, "Cells|400|200|40|640");
  assert_row(page, "Boundary triangles|20|0|1|21");
  assert_row(page, "Boundary quadrilaterals|3|7|0|10");
  assert_row(page, "Points|50|70|9|129");
  assert_row(page, "Regions|2|1|1|4");
  assert_row(page, "Of all cells|123.45|" DASH "|" DASH "|cm&sup3;");
  assert_row(page, "Of the solid|125|" DASH "|" DASH "|cm&sup3;");
  assert_row(page, "Difference|\342\210\2221.24|" DASH "|" DASH "|%");
  assert_row(page, "Least cell|0.002|" DASH "|" DASH "|mm&sup3;");
  assert_row(page, "rotor|Hub nut|wall|12\342\200\257500"); // of a domain the first patch tells its name
  assert_row(page, "|Inlet|inlet|4000");
  assert_row(page, "suction|Pipe|wall|500\342\200\257000");
  free(page);
  json_object_del(domain_of(STATOR), "points");
  assert_page_fails(cw_page_counts, &data, "RUN/mesh/record.json: domain stator: 'points'");
}

// Where the line across the bars stands, in the first chart.
static double mark_of(const char *page) {
  double at = NAN;
  for (const char *line = page; (line = strstr(line, "<line ")) && isnan(at); line++) {
    const char *class = strstr(line, "class=\"");
    if (class && !strncmp(class, "class=\"m\"", 9)) at = atof(line + strlen("<line x1=\""));
  }
  return at;
}

// Of the rotor's regions: 40 and 30 prisms, 60 and 270 other cells; their mean is 200 cells.
static void regions_are_balanced_in_a_chart(void **state) {
  double prisms[4][4], others[4][4];
  char colour[10];
  char *page = page_of(cw_page_regions, &data);
  assert_int_equal(count_in(page, "Cells and meshing time of each region of the "), 3);
  assert_holds(page, ">rotor 1<");
  assert_holds(page, ">100, 2.5 s<");
  assert_holds(page, ">rotor 2<");
  assert_holds(page, ">300<"); // no time is told of it
  assert_holds(page, ">suction 1<");
  assert_holds(page, ">200<"); // the stator's
  assert_holds(page, ">40<");
  snprintf(colour, sizeof colour, "#%06x", (unsigned)cw_domain_colour(ROTOR, 0));
  assert_int_equal(bars_of(page, colour, prisms), 2);
  snprintf(colour, sizeof colour, "#%06x", (unsigned)cw_domain_colour(ROTOR, 1));
  assert_int_equal(bars_of(page, colour, others), 2);
  assert_near(others[0][2] / prisms[0][2], 60. / 40, 2e-3);
  assert_near(others[1][2] / prisms[0][2], 270. / 40, 5e-3);
  assert_near(prisms[1][2] / prisms[0][2], 30. / 40, 2e-3);
  assert_near((mark_of(page) - prisms[0][0]) / (prisms[1][2] + others[1][2]), 200. / 300, 3e-3);
  assert_row(page, "Largest region over mean|1.25|" DASH "|" DASH "|");
  assert_row(page, "Largest error of the predicted share|13|" DASH "|" DASH "|%");
  assert_row(page, "Interface polygons|2|" DASH "|" DASH "|");
  assert_row(page, "Colours of the region numbers|3|" DASH "|" DASH "|");
  free(page);
}

// The counts of an array of so many bins, all 0 but those at `at` and `other`.
static void set_bins(int d, const char *key, int bins, int at, int count, int other, int more) {
  json_t *array = json_array();
  for (int k = 0; k < bins; k++) json_array_append_new(array, json_integer(k == at ? count : k == other ? more : 0));
  json_object_set_new(domain_of(d), key, array);
}

static void set_quality(void) {
  for (int d = 0; d < DOMAINS; d++) {
    set_bins(d, "tetrahedron_aspect_class", 8, 1, d == SUCTION ? 0 : 30, 2, d == SUCTION ? 0 : 10);
    set_bins(d, "least_dihedral_bins", 18, 3, 1, 7, d == ROTOR ? 1 : 7);
    set_bins(d, "prism_scaled_jacobian_bins", 20, 19, 8, 0, 2);
  }
}

static void quality_is_in_shares(void **state) {
  set_quality();
  char *page = page_of(cw_page_quality, &data);
  assert_row(page, "Tetrahedra: longest over shortest edge, mean|1.75|" DASH "|" DASH "|2.98 in the paper");
  assert_row(page, "Tetrahedra: longest over shortest edge, greatest|6.5|" DASH "|" DASH "|8.8 in the paper");
  assert_row(page, "Tetrahedra: least dihedral angle|11.5|" DASH "|" DASH "|&deg;");
  assert_row(page, "Tetrahedra: greatest dihedral angle|151.25|" DASH "|" DASH "|&deg;");
  assert_row(page, "Tetrahedra beside partition planes: mean ratio, mean|0.75|" DASH "|" DASH "|1 is regular");
  assert_row(page, "Other tetrahedra: mean ratio, mean|0.875|" DASH "|" DASH "|");
  assert_row(page, "Prisms: least scaled Jacobian|0.25|" DASH "|" DASH "|");
  assert_null(strstr(page, "by the exporter"));
  assert_holds(page, ">75.0<"); // % of 1.5 to 2, over its column
  assert_holds(page, ">25.0<");
  assert_holds(page, ">43.1<"); // the paper's
  // Columns of eight classes of the aspect, eight bins of the angle that are shown, and twenty of the Jacobian.
  double bar[40][4];
  char colour[10];
  snprintf(colour, sizeof colour, "#%06x", (unsigned)cw_domain_colour(ROTOR, 0));
  assert_int_equal(bars_of(page, colour, bar), 8 + 8 + 20);
  assert_near(bar[1][3] / bar[2][3], 3, 0.01);
  assert_near(bar[8 + 3][3], bar[8 + 7][3], 0.02);
  assert_near(bar[16 + 19][3] / bar[16][3], 4, 0.01);
  assert_near(bar[0][3] + bar[3][3] + bar[8][3] + bar[17][3], 0, 0);
  snprintf(colour, sizeof colour, "#%06x", (unsigned)cw_domain_colour(STATOR, 0));
  assert_int_equal(bars_of(page, colour, bar), 8 + 8 + 20);
  assert_near(bar[8 + 7][3] / bar[8 + 3][3], 7, 0.02);
  snprintf(colour, sizeof colour, "#%06x", (unsigned)cw_domain_colour(SUCTION, 0));
  assert_int_equal(bars_of(page, colour, bar), 8 + 20); // no tetrahedra, no columns of their aspect
  assert_holds(page, ">70" DASH "80<");
  assert_null(strstr(page, ">80" DASH "90<"));
  assert_null(strstr(page, "nan")); // the suction has no tetrahedra
  free(page);
  data.record[CW_STAGE_OF_EXPORT] =
      json_of("{'results': {'rotor': {'greatest_non_orthogonality_deg': 68.75, 'mean_non_orthogonality_deg': 20.5},"
              " 'suction': {'greatest_non_orthogonality_deg': 30}}}");
  page = page_of(cw_page_quality, &data);
  assert_row(page, "All cells: greatest non-orthogonality|68.75|" DASH "|30|&deg;, by the exporter");
  assert_row(page, "All cells: mean non-orthogonality|20.5|" DASH "|" DASH "|&deg;, by the exporter");
  free(page);
  set_bins(STATOR, "least_dihedral_bins", 17, 0, 1, 1, 1);
  assert_page_fails(cw_page_quality, &data,
                    "RUN/mesh/record.json: 'least_dihedral_bins' of domain stator must be an array of 18 counts");
}

static void set_layers(void) {
  set(ROTOR, "layer_coverage",
      "[{'patch': 'hub_nut', 'wall_faces': 200, 'full_thickness_faces': 150, 'thinned_by_sharpness_faces': 18,"
      " 'thinned_by_taper_faces': 2, 'thinned_by_gap_faces': 15, 'thinned_by_gradation_faces': 10, "
      "'thinned_by_repair_faces': 5,"
      " 'mean_thickness_m': 1.5e-3, 'least_thickness_m': 2.5e-4, 'y_plus': 24, 'first_height_asked_m': 2.5e-4,"
      " 'first_height_target_m': 2.25e-4, 'first_height_met_faces': 190, 'first_height_missed_by_sharpness_faces': 4,"
      " 'first_height_missed_by_taper_faces': 2,"
      " 'first_height_missed_by_gap_faces': 3, 'first_height_missed_by_gradation_faces': 2,"
      " 'first_height_missed_by_repair_faces': 1, 'thin_last_layer_faces': 6, 'thick_last_layer_faces': 4,"
      " 'volume_ratio_95_percent': 3.25, 'volume_ratio_greatest': 7.5},"
      " {'patch': 'blade', 'wall_faces': 100, 'full_thickness_faces': 100, 'first_height_met_faces': 50}]");
  set(STATOR, "layer_coverage", "[]");
  set(SUCTION, "layer_coverage",
      "[{'patch': 'pipe', 'wall_faces': 100, 'first_height_met_faces': 60, 'y_plus': 7}, {'patch': 'lid',"
      " 'wall_faces': 0}]");
}

// 300 of 400 faces met their first height. What is asked of a wall: of its group, of the patch itself, nothing where a
// height is asked.
static void layers_are_told_by_patch(void **state) {
  set_layers();
  char *page = page_of(cw_page_layers, &data);
  assert_holds(page, "<p>Layers on every wall face: rotor 5, stator 4, suction 5; as many as lead to the size");
  assert_holds(page, "it is met on 75.0 % of the wall faces");
  assert_row(page, "Hub nut|200|75.0 %|1.5|0.25|18|2|15|10|5");
  assert_row(page, "Hub nut|30|24|250|225|95.0 %|4|2|3|2|1|95.0 %|3.25|7.5");
  assert_row(page, "Blade|" DASH "|" DASH "|" DASH "|" DASH "|50.0 %|0|0|0|0|0|" DASH "|" DASH "|" DASH);
  assert_row(page, "Pipe|7|7|" DASH "|" DASH "|60.0 %|0|0|0|0|0|" DASH "|" DASH "|" DASH);
  assert_row(page, "Lid|0|&ndash;|" DASH "|" DASH "|0|0|0|0|0"); // no face, no share
  assert_int_equal(count_in(page, "<td colspan=\"10\">Suction</td>"), 1);
  assert_int_equal(count_in(page, "<td colspan=\"14\">Stator</td>"), 1);
  // The chart: of the hub's nut 75 % full, then 9, 1, 7.5, 5 and 2.5 % thinned.
  static const char *const colours[] = {"#5f9e7c", "#9a86b8", "#8a6f5a", "#e0b653", "#8db4da", "#c8665a"};
  static const double wanted[] = {75, 9, 1, 7.5, 5, 2.5};
  double bar[6][4][4];
  for (int s = 0; s < 6; s++) assert_true(bars_of(page, colours[s], bar[s]) >= 1);
  for (int s = 0; s < 6; s++) assert_near(bar[s][0][2] / bar[0][0][2], wanted[s] / 75, 1e-3);
  assert_near(bar[0][1][2] / bar[0][0][2], 100. / 75, 1e-3); // the blade
  assert_holds(page, ">hub nut<");
  free(page);
  table.walls.layer_count = 6;
  page = page_of(cw_page_layers, &data);
  assert_holds(page, "suction 5; 6 asked. ");
  free(page);
  json_object_del(domain_of(SUCTION), "layer_coverage");
  assert_page_fails(cw_page_layers, &data, "RUN/mesh/record.json: domain suction: 'layer_coverage'");
}

static void domains_of_another_mesh_are_told(void **state) {
  const PagePart parts[] = {cw_page_counts, cw_page_regions, cw_page_quality, cw_page_layers};
  set_quality();
  set_layers();
  json_object_set_new(domain_of(STATOR), "name", json_string("casing"));
  for (int k = 0; k < 4; k++)
    assert_page_fails(parts[k], &data, "RUN/mesh/record.json: results: domain 2 is 'casing'; it must be 'stator'");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(counts_are_sums_over_regions, make_data, free_data),
      cmocka_unit_test_setup_teardown(regions_are_balanced_in_a_chart, make_data, free_data),
      cmocka_unit_test_setup_teardown(quality_is_in_shares, make_data, free_data),
      cmocka_unit_test_setup_teardown(layers_are_told_by_patch, make_data, free_data),
      cmocka_unit_test_setup_teardown(domains_of_another_mesh_are_told, make_data, free_data),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
