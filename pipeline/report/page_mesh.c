// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/page_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/json_read.h"
#include "pipeline/mesh/layer_reason.h"
#include "pipeline/report/format.h"
#include "pipeline/report/html.h"
#include "pipeline/report/picture_list.h"
#include "pipeline/report/plot.h"
#include "pipeline/wall_group.h"

enum { ASPECT_CLASSES = 8, DIHEDRAL_BINS = 18, JACOBIAN_BINS = 20, BINS_MOST = 20 };
enum { DIHEDRAL_SHOWN = 8 }; // least dihedral angles end at that of the regular tetrahedron, 70.5 degrees
enum { DOMAINS_MOST = CW_DOMAINS_MOST };
static const uint32_t paper_colour = 0x9aa5b1;

static void count_cell(FILE *page, int64_t count) {
  char text[CW_FORMAT_SIZE];
  fprintf(page, "<td class=\"n\">%s</td>", cw_format_count(count, text));
}

static void number_cell(FILE *page, double value, int significant) {
  char text[CW_FORMAT_SIZE];
  cw_html_number_cell(page, cw_format_number(value, significant, text));
}

// A domain's name with a capital.
static void write_name(FILE *page, const CwReportData *data, int d) {
  const char *name = data->mesh.domains[d].name;
  fprintf(page, "%c%s", name[0] >= 'a' && name[0] <= 'z' ? name[0] - 'a' + 'A' : name[0], name + 1);
}

// The head of a table with a column a domain, up to and without what follows these columns.
static void domain_heads(FILE *page, const CwReportData *data, const char *class_name) {
  for (int d = 0; d < data->mesh.domain_count; d++) {
    fprintf(page, "<th class=\"%s\">", class_name);
    write_name(page, data, d);
    fputs("</th>", page);
  }
}

static void figure_row(FILE *page, const CwReportData *data, const char *label, const char *unit, json_t *const *domain,
                       const char *key, double scale, int significant) {
  fprintf(page, "<tr><td>%s</td>", label);
  for (int d = 0; d < data->mesh.domain_count; d++)
    number_cell(page, cw_json_real(domain[d], key) * scale, significant);
  fprintf(page, "<td>%s</td></tr>\n", unit);
}

// The same of an object of the domain.
static void inner_row(FILE *page, const CwReportData *data, const char *label, const char *unit, json_t *const *domain,
                      const char *object, const char *key, int significant) {
  json_t *inner[DOMAINS_MOST];
  for (int d = 0; d < data->mesh.domain_count; d++) inner[d] = json_object_get(domain[d], object);
  figure_row(page, data, label, unit, inner, key, 1, significant);
}

static void count_row(FILE *page, const CwReportData *data, const char *row, const char *label, const int64_t *count) {
  int64_t all = 0;
  fprintf(page, "%s<td>%s</td>", row, label);
  for (int d = 0; d < data->mesh.domain_count; d++) {
    count_cell(page, count[d]);
    all += count[d];
  }
  count_cell(page, all);
  fputs("</tr>\n", page);
}

CwStatus cw_page_counts(FILE *page, const CwReportData *data) {
  CwStatus status = CW_OK;
  static const struct {
    const char *label;
    size_t member;
  } rows[] = {{"Tetrahedra", offsetof(CwMeshRegion, tetrahedra)},
              {"Prisms", offsetof(CwMeshRegion, prisms)},
              {"Pyramids", offsetof(CwMeshRegion, pyramids)},
              {"Boundary triangles", offsetof(CwMeshRegion, triangles)},
              {"Boundary quadrilaterals", offsetof(CwMeshRegion, quads)}};
  json_t *domain[DOMAINS_MOST];
  char where[4096];
  int64_t cells[DOMAINS_MOST] = {0}, points[DOMAINS_MOST], regions[DOMAINS_MOST];
  CW_TRY(cw_report_mesh_domains(data, domain));
  fputs("<div class=\"grid\">\n<div><table class=\"plain\"><tr><th></th>", page);
  domain_heads(page, data, "n");
  fputs("<th class=\"n\">Together</th></tr>\n", page);
  for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
    int64_t sum[DOMAINS_MOST] = {0};
    for (int r = 0; r < data->mesh.region_count; r++) {
      const CwMeshRegion *region = &data->mesh.regions[r];
      int64_t count;
      memcpy(&count, (const char *)region + rows[k].member, sizeof count);
      sum[region->domain] += count;
      if (k < 3) cells[region->domain] += count;
    }
    count_row(page, data, "<tr>", rows[k].label, sum);
    if (k == 2) count_row(page, data, "<tr class=\"t\">", "Cells", cells);
  }
  for (int d = 0; d < data->mesh.domain_count; d++) {
    snprintf(where, sizeof where, "%s/mesh/record.json: domain %s", data->run, data->mesh.domains[d].name);
    CW_TRY(cw_json_count(domain[d], where, "points", &points[d]));
    regions[d] = data->mesh.domains[d].region_count;
  }
  count_row(page, data, "<tr>", "Points", points);
  count_row(page, data, "<tr>", "Regions", regions);
  fputs("</table>\n<h3>Volume</h3>\n<table><tr><th></th>", page);
  domain_heads(page, data, "n p");
  fputs("<th>Unit</th></tr>\n", page);
  figure_row(page, data, "Of all cells", "cm&sup3;", domain, "mesh_volume_m3", 1e6, 6);
  figure_row(page, data, "Of the solid", "cm&sup3;", domain, "solid_volume_m3", 1e6, 6);
  figure_row(page, data, "Difference", "%", domain, "volume_error", 100, 3);
  figure_row(page, data, "Least cell", "mm&sup3;", domain, "least_cell_volume_m3", 1e9, 3);
  fputs("</table></div>\n<div><table><tr><th>Domain</th><th>Patch</th><th>Kind</th><th class=\"n p\">Area, "
        "mm&sup2;</th></tr>\n",
        page);
  for (int d = 0; d < data->mesh.domain_count; d++) {
    size_t k;
    json_t *patch, *patches = json_object_get(domain[d], "patches");
    json_array_foreach(patches, k, patch) {
      fprintf(page, "<tr><td>%s</td>", k ? "" : data->mesh.domains[d].name);
      cw_html_label(page, "<td>", json_string_value(json_object_get(patch, "name")), "</td>");
      cw_html_text(page, "<td class=\"q\">", json_string_value(json_object_get(patch, "kind")), "</td>");
      number_cell(page, cw_json_real(patch, "area_m2") * 1e6, 5);
      fputs("</tr>\n", page);
    }
  }
  fputs("</table></div>\n</div>\n", page);
done:
  return status;
}

// One bar a region: tetrahedra and prisms; the mean as a line.
static CwStatus balance_chart(FILE *page, const CwReportData *data, int d, json_t *domain) {
  CwStatus status = CW_OK;
  const CwMeshDomain *mesh = &data->mesh.domains[d];
  int count = mesh->region_count;
  double *tets = NULL, *prisms = NULL, sum = 0;
  char text[CW_FORMAT_SIZE], caption[120];
  CwPlotCategory *category = NULL;
  json_t *list = json_object_get(domain, "region_list");
  CW_NEW(tets, count);
  CW_NEW(prisms, count);
  CW_NEW(category, count);
  for (int r = 0; r < count; r++) {
    const CwMeshRegion *region = &data->mesh.regions[mesh->first_region + r];
    double cells = (double)cw_mesh_region_cells(region);
    tets[r] = (double)(region->tetrahedra + region->pyramids) * 1e-3;
    prisms[r] = (double)region->prisms * 1e-3;
    sum += cells;
    CwPlotCategory *own = &category[r];
    snprintf(own->label, sizeof own->label, "%s %d", mesh->name, region->region);
    snprintf(own->note, sizeof own->note, "%s", cw_format_si(cells, 3, text));
    double seconds = cw_json_real(json_array_get(list, (size_t)r), "seconds");
    if (isfinite(seconds)) {
      size_t used = strlen(own->note);
      snprintf(own->note + used, sizeof own->note - used, ", %.30s", cw_format_seconds(seconds, text));
    }
  }
  snprintf(caption, sizeof caption, "Cells and meshing time of each region of the %s.", mesh->name);
  CwPlotSeries series[2] = {{"prisms", cw_domain_colour(d, 0), prisms}, {"tetrahedra", cw_domain_colour(d, 1), tets}};
  CwPlot plot = {.axis = "thousand cells; dashed: mean of the domain",
                 .category = category,
                 .count = count,
                 .series = series,
                 .series_count = 2,
                 .mark = sum / count * 1e-3,
                 .width = 560,
                 .caption = caption};
  cw_plot_bars(page, &plot);
done:
  free(tets);
  free(prisms);
  free(category);
  return status;
}

CwStatus cw_page_regions(FILE *page, const CwReportData *data) {
  CwStatus status = CW_OK;
  json_t *domain[DOMAINS_MOST];
  CW_TRY(cw_report_mesh_domains(data, domain));
  fputs("<p>Each domain is divided by planes into regions that are meshed on their own; the mesh is the same for any "
        "number of ranks. Where passages of the impeller are equal, their regions are periodic images of the first's, "
        "which takes less time.</p>\n",
        page);
  cw_page_picture_list(page, data, CW_SECTION_DECOMPOSITION);
  fputs("<h3>Balance</h3>\n<div class=\"grid\">\n", page);
  for (int d = 0; d < data->mesh.domain_count; d++) CW_TRY(balance_chart(page, data, d, domain[d]));
  fputs("</div>\n<table><tr><th></th>", page);
  domain_heads(page, data, "n p");
  fputs("<th></th></tr>\n", page);
  figure_row(page, data, "Largest region over mean", "", domain, "region_balance", 1, 3);
  figure_row(page, data, "Largest error of the predicted share", "%", domain, "region_prediction_error", 100, 2);
  figure_row(page, data, "Interface polygons", "", domain, "interfaces", 1, 9);
  figure_row(page, data, "Colours of the region numbers", "", domain, "colours", 1, 9);
  fputs("</table>\n", page);
done:
  return status;
}

// Reads `count` counts of an array and turns them into shares of their sum, in percent.
static CwStatus shares(const CwReportData *data, json_t *domain, const char *key, int count, double *share) {
  CwStatus status = CW_OK;
  json_t *array = json_object_get(domain, key);
  const char *name = json_string_value(json_object_get(domain, "name"));
  double sum = 0;
  CW_REQUIRE(json_is_array(array) && json_array_size(array) == (size_t)count, CW_ERR_INPUT,
             "%s/mesh/record.json: '%s' of domain %s must be an array of %d counts", data->run, key, name ? name : "?",
             count);
  for (int k = 0; k < count; k++) {
    share[k] = json_number_value(json_array_get(array, (size_t)k));
    sum += share[k];
  }
  for (int k = 0; k < count; k++) share[k] = sum > 0 ? 100 * share[k] / sum : NAN;
done:
  return status;
}

static void quality_table(FILE *page, const CwReportData *data, json_t *const *domain) {
  fputs("<table><tr><th></th>", page);
  domain_heads(page, data, "n p");
  fputs("<th></th></tr>\n", page);
  figure_row(page, data, "Tetrahedra: longest over shortest edge, mean", "2.98 in the paper", domain,
             "tetrahedron_aspect_mean", 1, 4);
  figure_row(page, data, "Tetrahedra: longest over shortest edge, greatest", "8.8 in the paper", domain,
             "tetrahedron_aspect_max", 1, 4);
  figure_row(page, data, "Tetrahedra: least dihedral angle", "&deg;", domain, "least_dihedral_deg", 1, 4);
  figure_row(page, data, "Tetrahedra: greatest dihedral angle", "&deg;", domain, "greatest_dihedral_deg", 1, 5);
  inner_row(page, data, "Tetrahedra beside partition planes: mean ratio, mean", "1 is regular", domain,
            "tetrahedra_beside_planes", "mean_ratio_mean", 3);
  inner_row(page, data, "Other tetrahedra: mean ratio, mean", "", domain, "tetrahedra_apart", "mean_ratio_mean", 3);
  figure_row(page, data, "Prisms: least scaled Jacobian", "", domain, "prism_least_scaled_jacobian", 1, 3);
  json_t *results = json_object_get(data->record[2], "results"), *exported[DOMAINS_MOST];
  if (results) {
    for (int d = 0; d < data->mesh.domain_count; d++) {
      exported[d] = json_object_get(results, data->mesh.domains[d].name);
    }
    figure_row(page, data, "All cells: greatest non-orthogonality", "&deg;, by the exporter", exported,
               "greatest_non_orthogonality_deg", 1, 4);
    figure_row(page, data, "All cells: mean non-orthogonality", "&deg;, by the exporter", exported,
               "mean_non_orthogonality_deg", 1, 4);
  }
  fputs("</table>\n", page);
}

// Columns of each domain's shares in the bins of the array `key` (`bins` of them, of which plot->count are shown), with
// the paper's beside them where they are given.
static CwStatus bins_chart(FILE *page, const CwReportData *data, json_t *const *domain, const char *key, int bins,
                           CwPlot plot, const double *paper) {
  CwStatus status = CW_OK;
  double share[DOMAINS_MOST][BINS_MOST];
  CwPlotSeries series[DOMAINS_MOST + 1];
  int domains = data->mesh.domain_count;
  for (int d = 0; d < domains; d++) {
    CW_TRY(shares(data, domain[d], key, bins, share[d]));
    series[d] = (CwPlotSeries){data->mesh.domains[d].name, cw_domain_colour(d, 0), share[d]};
  }
  if (paper) {
    series[domains] = (CwPlotSeries){"the paper, Table 1, proposed algorithm (21 M cells)", paper_colour, paper};
  }
  plot.series = series;
  plot.series_count = domains + (paper != NULL);
  cw_plot_columns(page, &plot);
done:
  return status;
}

CwStatus cw_page_quality(FILE *page, const CwReportData *data) {
  CwStatus status = CW_OK;
  static const CwPlotCategory aspects[ASPECT_CLASSES] = {{.label = "1\342\200\2231.5"}, {.label = "1.5\342\200\2232"},
                                                         {.label = "2\342\200\2233"},   {.label = "3\342\200\2234"},
                                                         {.label = "4\342\200\2235"},   {.label = "5\342\200\2237"},
                                                         {.label = "7\342\200\22310"},  {.label = "> 10"}};
  // The paper's Table 1, proposed algorithm.
  static const double paper[ASPECT_CLASSES] = {4.0, 43.1, 30.5, 10.1, 8.2, 3.0, 1.1, NAN};
  CwPlotCategory bins[BINS_MOST] = {0};
  json_t *domain[DOMAINS_MOST];
  CW_TRY(cw_report_mesh_domains(data, domain));
  quality_table(page, data, domain);
  CW_TRY(bins_chart(page, data, domain, "tetrahedron_aspect_class", ASPECT_CLASSES,
                    (CwPlot){.axis = "% of the tetrahedra",
                             .category_axis = "longest edge over shortest edge",
                             .category = aspects,
                             .count = ASPECT_CLASSES,
                             .decimals = 1,
                             .width = 980,
                             .caption = "<b>Aspect ratio of the tetrahedra</b> in the classes of the paper's Table 1; "
                                        "1 is the regular tetrahedron."},
                    paper));
  fputs("<div class=\"grid\">\n", page);
  for (int k = 0; k < DIHEDRAL_SHOWN; k++) {
    snprintf(bins[k].label, sizeof bins[k].label, "%d\342\200\223%d", 10 * k, 10 * k + 10);
  }
  CW_TRY(bins_chart(page, data, domain, "least_dihedral_bins", DIHEDRAL_BINS,
                    (CwPlot){.axis = "% of the tetrahedra",
                             .category_axis = "least dihedral angle, degrees",
                             .category = bins,
                             .count = DIHEDRAL_SHOWN,
                             .decimals = 1,
                             .width = 560,
                             .caption = "<b>Least dihedral angle</b> of each tetrahedron; 70.5&deg; is the regular "
                                        "one."},
                    NULL));
  for (int k = 0; k < JACOBIAN_BINS; k++) {
    snprintf(bins[k].label, sizeof bins[k].label, k % 4 == 0 ? "%.1f" : "", k / 20.0);
  }
  CW_TRY(bins_chart(page, data, domain, "prism_scaled_jacobian_bins", JACOBIAN_BINS,
                    (CwPlot){.axis = "% of the prisms",
                             .category_axis = "scaled Jacobian, from",
                             .category = bins,
                             .count = JACOBIAN_BINS,
                             .decimals = -1,
                             .width = 560,
                             .caption = "<b>Scaled Jacobian of the prisms</b>, least of six corners; 1 is the right "
                                        "prism on an equilateral triangle, 0 and below is inverted."},
                    NULL));
  fputs("</div>\n", page);
done:
  return status;
}

// Wall faces of a patch by what holds their thickness back; of CW_LAYER_FULL those that have all of it. NAN: not told.
static double coverage(const json_t *patch, int reason) {
  char key[CW_LAYER_KEY_SIZE];
  return cw_json_real(patch, reason ? cw_layer_reason_key("thinned", reason, key) : "full_thickness_faces");
}

static CwStatus coverage_chart(FILE *page, const CwReportData *data, json_t *const *list) {
  CwStatus status = CW_OK;
  static const char *const names[CW_LAYER_REASONS] = {"full thickness",       "thinned by a sharp edge",
                                                      "tapered to nothing",   "thinned by a gap",
                                                      "thinned by gradation", "thinned by repair"};
  static const uint32_t colours[CW_LAYER_REASONS] = {0x5f9e7c, 0x9a86b8, 0x8a6f5a, 0xe0b653, 0x8db4da, 0xc8665a};
  size_t count = 0, row = 0;
  double *share[CW_LAYER_REASONS] = {NULL};
  CwPlotCategory *category = NULL;
  CwPlotSeries series[CW_LAYER_REASONS];
  for (int d = 0; d < data->mesh.domain_count; d++) count += json_array_size(list[d]);
  CW_NEW(category, count);
  for (int s = 0; s < CW_LAYER_REASONS; s++) {
    CW_NEW(share[s], count);
    series[s] = (CwPlotSeries){names[s], colours[s], share[s]};
  }
  for (int d = 0; d < data->mesh.domain_count; d++) {
    size_t k;
    json_t *patch;
    json_array_foreach(list[d], k, patch) {
      const char *name = json_string_value(json_object_get(patch, "patch"));
      double faces = cw_json_real(patch, "wall_faces");
      for (int s = 0; s < CW_LAYER_REASONS; s++) share[s][row] = faces > 0 ? 100 * coverage(patch, s) / faces : 0;
      snprintf(category[row].label, sizeof category[row].label, "%s", name ? name : "");
      for (char *c = category[row].label; *c; c++) {
        if (*c == '_') *c = ' ';
      }
      row++;
    }
  }
  CwPlot plot = {.axis = "% of the wall faces",
                 .category = category,
                 .count = (int)count,
                 .series = series,
                 .series_count = CW_LAYER_REASONS,
                 .limit = 100,
                 .width = 980,
                 .caption = "<b>Thickness of the layers</b> by patch: share of wall faces with the full thickness, and "
                            "why the others are thinner."};
  cw_plot_bars(page, &plot);
done:
  for (int s = 0; s < CW_LAYER_REASONS; s++) free(share[s]);
  free(category);
  return status;
}

static void share_cell(FILE *page, double part, double whole) {
  char text[CW_FORMAT_SIZE];
  fprintf(page, "<td class=\"n\">%s</td>", whole > 0 ? cw_format_percent(part / whole, text) : "&ndash;");
}

// The wall faces of a patch that are `what`, for each reason.
static void reason_cells(FILE *page, const json_t *patch, const char *what) {
  char key[CW_LAYER_KEY_SIZE];
  for (int s = CW_LAYER_FULL + 1; s < CW_LAYER_REASONS; s++)
    count_cell(page, json_integer_value(json_object_get(patch, cw_layer_reason_key(what, s, key))));
}

// Thickness of the layers on a patch, and why columns are thinner.
static void thickness_cells(FILE *page, const CwReportData *data, json_t *patch, double faces) {
  count_cell(page, (long long)faces);
  share_cell(page, coverage(patch, CW_LAYER_FULL), faces);
  number_cell(page, cw_json_real(patch, "mean_thickness_m") * 1e3, 3);
  number_cell(page, cw_json_real(patch, "least_thickness_m") * 1e3, 3);
  reason_cells(page, patch, "thinned");
}

// What is asked of a wall; NAN: no y+.
static double asked_y_plus(const CwReportData *data, const json_t *patch) {
  const char *name = json_string_value(json_object_get(patch, "patch"));
  const int p = name ? cw_mesh_patch_find(&data->mesh, name) : -1;
  if (p < 0) return NAN;
  const CwWallGroup asked = cw_patch_walls(&data->table->walls, &data->mesh.patches[p]);
  return cw_case_given(asked.first_height) ? NAN : asked.y_plus;
}

// The first layer as asked and as made, the last against the tetrahedra.
static void height_cells(FILE *page, const CwReportData *data, json_t *patch, double faces) {
  number_cell(page, asked_y_plus(data, patch), 3);
  number_cell(page, cw_json_real(patch, "y_plus"), 3);
  number_cell(page, cw_json_real(patch, "first_height_asked_m") * 1e6, 4);
  number_cell(page, cw_json_real(patch, "first_height_target_m") * 1e6, 4);
  share_cell(page, cw_json_real(patch, "first_height_met_faces"), faces);
  reason_cells(page, patch, "first_height_missed");
  share_cell(page, faces - cw_json_real(patch, "thin_last_layer_faces") - cw_json_real(patch, "thick_last_layer_faces"),
             faces);
  number_cell(page, cw_json_real(patch, "volume_ratio_95_percent"), 3);
  number_cell(page, cw_json_real(patch, "volume_ratio_greatest"), 3);
}

static void layer_rows(FILE *page, const CwReportData *data, json_t *const *list, int columns,
                       void (*cells)(FILE *, const CwReportData *, json_t *, double)) {
  for (int d = 0; d < data->mesh.domain_count; d++) {
    size_t k;
    json_t *patch;
    fprintf(page, "<tr class=\"s\"><td colspan=\"%d\">", columns);
    write_name(page, data, d);
    fputs("</td></tr>\n", page);
    json_array_foreach(list[d], k, patch) {
      cw_html_label(page, "<tr><td>", json_string_value(json_object_get(patch, "patch")), "</td>");
      cells(page, data, patch, cw_json_real(patch, "wall_faces"));
      fputs("</tr>\n", page);
    }
  }
}

CwStatus cw_page_layers(FILE *page, const CwReportData *data) {
  CwStatus status = CW_OK;
  json_t *domain[DOMAINS_MOST], *list[DOMAINS_MOST];
  char where[4096], text[CW_FORMAT_SIZE];
  double all = 0, met = 0;
  CW_TRY(cw_report_mesh_domains(data, domain));
  for (int d = 0; d < data->mesh.domain_count; d++) {
    snprintf(where, sizeof where, "%s/mesh/record.json: domain %s", data->run, data->mesh.domains[d].name);
    CW_TRY(cw_json_array(domain[d], where, "layer_coverage", &list[d]));
    for (size_t k = 0; k < json_array_size(list[d]); k++) {
      all += fmax(cw_json_real(json_array_get(list[d], k), "wall_faces"), 0);
      met += fmax(cw_json_real(json_array_get(list[d], k), "first_height_met_faces"), 0);
    }
  }
  fputs("<p>Layers on every wall face: ", page);
  for (int d = 0; d < data->mesh.domain_count; d++)
    fprintf(page, "%s%s %d", d ? ", " : "", data->mesh.domains[d].name, (int)cw_json_real(domain[d], "layers"));
  if (data->table->walls.layer_count > 0)
    fprintf(page, "; %d asked", data->table->walls.layer_count);
  else
    fputs("; as many as lead to the size of the tetrahedra", page);
  fprintf(page,
          ". The first height is asked itself or follows from the y<sup>+</sup> asked of the wall. Where it does not "
          "fit the passage, or the flow is laminar, layers are made for another. Within 10&#8239;%% it is met on %s of "
          "the wall faces.</p>\n",
          cw_format_percent(met / all, text));
  CW_TRY(coverage_chart(page, data, list));
  fputs("<table><tr><th>Patch</th><th class=\"n\">Wall faces</th>"
        "<th class=\"n\">Full<br>thickness</th><th class=\"n p\">Thickness,<br>mean, mm</th>"
        "<th class=\"n p\">least, mm</th><th class=\"n\">Thinned by<br>sharp edge</th><th class=\"n\"><br>taper</th>"
        "<th class=\"n\"><br>gap</th><th class=\"n\"><br>gradation</th><th class=\"n\"><br>repair</th></tr>\n",
        page);
  layer_rows(page, data, list, 10, thickness_cells);
  fputs(
      "</table>\n<p>The volume ratio is that of the last prism of a column and the tetrahedron on it, the greater over "
      "the less.</p>\n"
      "<table><tr><th>Patch</th><th class=\"n p\">y<sup>+</sup><br>asked</th><th class=\"n p\"><br>made for</th>"
      "<th class=\"n p\">First height, &micro;m<br>asked</th><th class=\"n p\"><br>made for</th>"
      "<th class=\"n\"><br>met</th>"
      "<th class=\"n\">Missed by<br>sharp edge</th><th class=\"n\"><br>taper</th><th class=\"n\"><br>gap</th>"
      "<th class=\"n\"><br>gradation</th><th class=\"n\"><br>repair</th>"
      "<th class=\"n\">Volume ratio<br>up to 4</th><th class=\"n p\"><br>95&#8239;% up to</th>"
      "<th class=\"n p\"><br>greatest</th></tr>\n",
      page);
  layer_rows(page, data, list, 14, height_cells);
  fputs("</table>\n", page);
done:
  return status;
}
