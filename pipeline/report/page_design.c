// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/page_parts.h"

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/case_schema.h"
#include "pipeline/json_read.h"
#include "pipeline/report/format.h"
#include "pipeline/report/html.h"
#include "pipeline/report/quantity.h"

static const char *unit_text(const char *suffix) {
  static const struct {
    const char *suffix, *text;
  } pretty[] = {{"m3_per_h", "m&sup3;/h"}, {"kg_per_m3", "kg/m&sup3;"}, {"m2_per_s", "m&sup2;/s"},
                {"deg", "&deg;"},          {"mm2", "mm&sup2;"},         {"um", "&micro;m"}};
  for (size_t k = 0; k < sizeof pretty / sizeof *pretty; k++) {
    if (!strcmp(suffix, pretty[k].suffix)) return pretty[k].text;
  }
  const CwUnit *unit = cw_unit_find(suffix);
  return unit ? unit->text : "";
}

// Keys of the case that do not read as words; NULL: others.
static const char *plain_name(const char *key) {
  static const struct {
    const char *key, *name;
  } plain[] = {{"time_step_deg", "turn in one time step of the transient run"},
               {"correlations", "correlations by"},
               {"slip", "slip model"},
               {"warn_share", "difference from the correlations that is warned of, share"},
               {"priority", "what goes first where the table asks too much"},
               {"rotation", "rotation, seen from the drive"},
               {"through_shaft_diameter_mm", "shaft through the inlet (0: none), diameter"},
               {"leading_edge_ratio", "leading edge ellipse, along to across"},
               {"thickest_at", "blade thickest at this share of its length"},
               {"lean_deg", "lean of the trailing edge"},
               {"splitter_start", "splitters begin at this share of the length"},
               {"splitter_position", "splitters at this share of the pitch"},
               {"suction_pipe_zone", "zone of the suction pipe"},
               {"discharge_pipe_zone", "zone of the discharge pipe"},
               {"area_law", "law by which sections grow"},
               {"section", "shape of the sections"},
               {"roughness_um", "sand grain roughness"},
               {"treatment", "wall function"},
               {"y_plus_at", "y+ is asked at"},
               {"layer_count", "prism layers"},
               {"growth_ratio", "growth of layers, at most"},
               {"sweep", "layers with another number of cells"},
               {"cells_per_region", "cells of a region, about"},
               {"least_regions", "regions of a domain, at least"},
               {"fill", "tetrahedra by"},
               {"periodic_impeller", "one passage of the impeller for all"},
               {"gradation", "growth of the cell size over distance, at most"},
               {"curvature_angle_deg", "turn of a curved wall across an edge, at most"},
               {"cells_across_gap", "cells across a gap, at least"},
               {"size_blade", "cell size on blades over the base size"},
               {"size_hub_shroud", "cell size on hub and shroud over the base size"},
               {"size_volute", "cell size in the volute over the base size"},
               {"size_pipe", "cell size in pipes over the base size"},
               {"size_interface", "cell size on interfaces over the base size"},
               {"integers", "bits of integers"},
               {"processors", "folders that the mesh is divided into"},
               {"labels", "bits of labels"}};
  for (size_t k = 0; k < sizeof plain / sizeof *plain; k++)
    if (!strcmp(key, plain[k].key)) return plain[k].name;
  return NULL;
}

// What is left open stands among the derived dimensions, or follows from others.
static int has_row(const CwCaseKey *key, const CwCase *table) {
  if (!*key->section || key->type == CW_KEY_NAME) return 0;
  double value = cw_case_key_value(key, table);
  const int may_be_open = key->presence == CW_KEY_COMPUTED || key->presence == CW_KEY_OPTIONAL;
  return !may_be_open || !(isnan(value) || value == key->fallback);
}

static void input_row(FILE *page, size_t index, const CwCase *table) {
  const CwCaseKey *key = &cw_case_keys[index];
  char stem[CW_STEM_SIZE], number[CW_FORMAT_SIZE];
  size_t length;
  cw_unit_of_key(key->key, &length);
  snprintf(stem, sizeof stem, "%.*s", (int)length, key->key);
  double value = cw_case_key_value(key, table);
  int automatic = key->presence == CW_KEY_AUTO && (isnan(value) || value == key->fallback);
  const char *origin = table->given[index] ? "case file" : automatic || value == key->fallback ? "default" : "computed";
  cw_quantity_start(page, stem, plain_name(key->key));
  if (key->type == CW_KEY_CHOICE || key->type == CW_KEY_CHOICES) {
    char chosen[CW_KEY_ALLOWED_SIZE];
    cw_case_key_chosen(key, value, chosen);
    cw_html_label(page, "<td class=\"n\">", chosen, "<span></span></td>");
  } else if (automatic) {
    cw_html_number_cell(page, "auto");
  } else if (key->type == CW_KEY_INT64) {
    cw_html_number_cell(page, cw_format_count((int64_t)value, number));
  } else {
    cw_html_number_cell(page, cw_format_number(value, 6, number));
  }
  fprintf(page, "<td>%s</td><td class=\"q o\">%s</td></tr>\n", unit_text(key->unit), origin);
}

CwStatus cw_page_input(FILE *page, const CwReportData *data) {
  const char *section = NULL;
  fputs("<p>What the case file asks for, with the operating point. Keys that it leaves to the hydraulic design stand "
        "under <a href=\"#design\">derived dimensions</a>.</p>\n<div class=\"columns\">\n",
        page);
  for (size_t k = 0; k < cw_case_key_count; k++) {
    const CwCaseKey *key = &cw_case_keys[k];
    if (!has_row(key, data->table)) continue;
    if (!section || strcmp(section, key->section)) {
      if (section) fputs("</table>\n", page);
      section = key->section;
      cw_html_label(page, "<table><tr class=\"s\"><td colspan=\"5\">", section, "</td></tr>\n");
    }
    input_row(page, k, data->table);
  }
  fputs("</table>\n</div>\n", page);
  return CW_OK;
}

// The keys of the design that begin a part of it, in their order.
static const struct {
  const char *key, *title;
} parts[] = {{"blade_count", "Duty and specific speed"},
             {"shaft_power_w", "Shaft, main dimensions and meridian"},
             {"inlet_blade_angle_deg", "Blade"},
             {"impeller_tip_speed_m_per_s", "Velocity triangles, slip and head"},
             {"inlet_throat_width_m", "Throats and NPSH"},
             {"base_diameter_m", "Volute, diffuser and discharge"},
             {"relative_speed_m_per_s", "Speeds that walls are meshed for, and volumes"}};

// A flat list of numbers in JSON as table rows.
static void design_rows(FILE *page, json_t *object, json_t *sources, json_t *names) {
  const char *key;
  json_t *value;
  char stem[CW_STEM_SIZE], number[CW_FORMAT_SIZE];
  json_object_foreach(object, key, value) {
    if (!json_is_number(value)) continue;
    for (size_t k = 0; sources && k < sizeof parts / sizeof *parts; k++) {
      if (!strcmp(key, parts[k].key)) fprintf(page, "<tr class=\"s\"><td colspan=\"5\">%s</td></tr>\n", parts[k].title);
    }
    const CwQuantityUnit *unit = cw_quantity_unit(key);
    double real = json_number_value(value) * unit->scale;
    cw_quantity_stem(key, stem);
    cw_quantity_start(page, stem, json_string_value(json_object_get(names, key)));
    cw_html_number_cell(page, json_is_integer(value)
                                  ? cw_format_count(json_integer_value(value), number)
                                  : cw_format_number(fabs(real) < 1e-9 ? 0 : real, 5, number)); // residuals
    fprintf(page, "<td>%s</td>", unit->unit);
    if (sources) {
      cw_html_text(page, "<td class=\"q\">", json_string_value(json_object_get(sources, key)), "</td>");
    }
    fputs("</tr>\n", page);
  }
}

CwStatus cw_page_design(FILE *page, const CwReportData *data) {
  json_t *sources = json_object_get(data->design, "sources"), *measured = json_object_get(data->design, "measured");
  fputs("<p>Every dimension and figure of the hydraulic design with the correlation it comes from.</p>\n"
        "<table><tr><th>Quantity</th><th></th><th class=\"n p\">Value</th><th>Unit</th><th>Source</th></tr>\n",
        page);
  design_rows(page, data->design, json_is_object(sources) ? sources : NULL, json_object_get(data->design, "names"));
  fputs("</table>\n", page);
  if (!json_is_object(measured)) return CW_OK;
  fputs("<h3>Measured on the solids as built</h3>\n<table><tr><th>Quantity</th><th></th><th class=\"n p\">Value</th>"
        "<th>Unit</th></tr>\n",
        page);
  design_rows(page, measured, NULL, NULL);
  const char *key;
  json_t *value;
  char number[CW_FORMAT_SIZE];
  json_object_foreach(measured, key, value) {
    double angle = cw_json_real(value, "angle_deg");
    if (isnan(angle)) continue;
    cw_quantity_start(page, key, NULL);
    cw_html_number_cell(page, cw_format_number(angle, 5, number));
    fputs("<td>&deg;</td></tr>\n", page);
  }
  fputs("</table>\n", page);
  return CW_OK;
}

static int is_svg(const struct dirent *entry) {
  size_t length = strlen(entry->d_name);
  return length > 4 && entry->d_name[0] != '.' && !strcmp(entry->d_name + length - 4, ".svg");
}

CwStatus cw_page_design_pictures(FILE *page, const CwReportData *data) {
  CwStatus status = CW_OK;
  char folder[4096], path[4400], name[300];
  struct dirent **entry = NULL;
  snprintf(folder, sizeof folder, "%s/geometry", data->run);
  int count = scandir(folder, &entry, is_svg, alphasort);
  CW_REQUIRE(count >= 0, CW_ERR_IO, "%s: cannot be read: %s", folder, strerror(errno));
  if (count == 0) fputs("<p>The geometry stage left no drawings.</p>\n", page);
  for (int k = 0; k < count; k++) {
    snprintf(path, sizeof path, "%s/%s", folder, entry[k]->d_name);
    snprintf(name, sizeof name, "%.*s", (int)strlen(entry[k]->d_name) - 4, entry[k]->d_name);
    fputs("<figure class=\"drawing\">", page);
    CW_TRY(cw_html_svg_file(page, path));
    cw_html_label(page, "<figcaption><b>", name, "</b></figcaption></figure>\n");
  }
done:
  for (int k = 0; k < count; k++) free(entry[k]);
  free(entry);
  return status;
}
