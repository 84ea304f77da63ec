// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/page.h"

#include <math.h>

#include "pipeline/json_read.h"
#include "pipeline/report/format.h"
#include "pipeline/report/html.h"
#include "pipeline/report/page_design.h"
#include "pipeline/report/page_mesh.h"
#include "pipeline/report/page_pictures.h"
#include "pipeline/report/page_run.h"
#include "pipeline/report/page_solve.h"
#include "pipeline/report/page_texts.h"
#include "pipeline/report/page_view.h"

typedef CwStatus (*Part)(FILE *page, const CwReportData *data);

static CwStatus turning_picture(FILE *page, const CwReportData *data) {
  return cw_page_view(page, &data->mesh, &data->view);
}

static CwStatus geometry_pictures(FILE *page, const CwReportData *data) {
  fputs("<p>Drawn from the boundary faces of the finished mesh, coloured by patch.</p>\n", page);
  cw_page_picture_list(page, data, CW_SECTION_GEOMETRY);
  return CW_OK;
}

static CwStatus surface_pictures(FILE *page, const CwReportData *data) {
  fputs("<p>Close views of the wall faces with their edges; every node lies on the exact surface.</p>\n", page);
  cw_page_picture_list(page, data, CW_SECTION_SURFACE);
  return CW_OK;
}

static CwStatus cut_pictures(FILE *page, const CwReportData *data) {
  fputs("<p>True sections: each polygon is the cut of the plane through one cell, so tetrahedra look more "
        "uneven than "
        "they are. Red frames are the close views that follow.</p>\n",
        page);
  cw_page_picture_list(page, data, CW_SECTION_CUT);
  return CW_OK;
}

static const struct {
  const char *id, *heading;
  Part part;
  int of_design; // 1: left out where no generator made the pump
} parts[] = {
    {"turn", "The pump in three dimensions", turning_picture, 0},
    {"input", "Design table", cw_page_input, 1},
    {"design", "Derived dimensions", cw_page_design, 1},
    {"drawings", "Design drawings", cw_page_design_pictures, 1},
    {"geometry", "Geometry", geometry_pictures, 0},
    {"counts", "Mesh counts", cw_page_counts, 0},
    {"regions", "Regions", cw_page_regions, 0},
    {"surface", "Surface mesh", surface_pictures, 0},
    {"volume", "Volume mesh", cut_pictures, 0},
    {"quality", "Cell quality", cw_page_quality, 0},
    {"layers", "Prism layers", cw_page_layers, 0},
    {"export", "Export", cw_page_export, 0},
    {"solve", "Solved flow", cw_page_solve, 0},
    {"times", "Times and memory", cw_page_times, 0},
    {"warnings", "Warnings", cw_page_warnings, 0},
};
enum { PARTS = sizeof parts / sizeof *parts };

static void tile(FILE *page, const char *value, const char *unit, const char *label) {
  fprintf(page, "<div><b>%s%s%s</b><span>%s</span></div>\n", value, *unit ? "&#8239;" : "", unit, label);
}

// What the stages tell before all else; the geometry, whose warnings are few, all of them in one box to be opened.
static void headlines(FILE *page, const CwReportData *data) {
  size_t k;
  json_t *text, *remarks = json_object_get(data->record[0], "warnings");
  for (int s = 0; s < CW_STAGES; s++) {
    json_array_foreach(json_object_get(json_object_get(data->record[s], "results"), "headlines"), k, text) {
      fputs("<div class=\"warn\">", page);
      cw_html_text(page, json_string_value(text));
      fputs("</div>\n", page);
    }
  }
  if (json_array_size(remarks) == 0) return;
  fprintf(page, "<details class=\"warn\"><summary>Geometry: %zu warning%s</summary><ul>\n", json_array_size(remarks),
          json_array_size(remarks) == 1 ? "" : "s");
  json_array_foreach(remarks, k, text) {
    fputs("<li>", page);
    cw_html_text(page, json_string_value(text));
    fputs("</li>\n", page);
  }
  fputs("</ul></details>\n", page);
}

static CwStatus title(FILE *page, const CwReportData *data) {
  CwStatus status = CW_OK;
  char text[CW_FORMAT_SIZE], more[CW_FORMAT_SIZE], label[200], where[4096];
  int64_t cells = 0, tets = 0, prisms = 0, asked;
  double seconds = 0, mesh_seconds = cw_json_real(data->record[1], "seconds"), memory = 0;
  json_t *results;
  const CwCase *table = data->table;
  snprintf(where, sizeof where, "%s/mesh/record.json: results", data->run);
  CW_TRY(cw_report_mesh_results(data, &results));
  CW_TRY(cw_json_count(results, where, "asked_cells", &asked));
  for (int r = 0; r < data->mesh.region_count; r++) {
    const CwMeshRegion *region = &data->mesh.regions[r];
    tets += region->tetrahedra;
    prisms += region->prisms;
    cells += region->tetrahedra + region->prisms + region->pyramids;
  }
  for (int s = 0; s < CW_STAGES; s++) {
    if (!data->record[s]) continue;
    seconds += cw_json_real(data->record[s], "seconds");
    memory = fmax(memory, cw_json_real(data->record[s], "peak_memory_bytes"));
  }
  fputs("<h1>Pump ", page);
  cw_html_text(page, table->name);
  fprintf(page, ": from %s to mesh</h1>\n<p class=\"lead\">", data->design ? "design table" : "solids");
  fprintf(page, "Centrifugal pump, %d blades, D<sub>2</sub>&#8239;=&#8239;%s&#8239;mm; ", data->mesh.flow.blade_count,
          cw_format_number(data->mesh.flow.reference_length * 1e3, 4, text));
  fprintf(page, "Q&#8239;=&#8239;%s&#8239;m&sup3;/h, ",
          cw_format_number(table->operating_point.flow_rate * 3600, 4, text));
  fprintf(page, "H&#8239;=&#8239;%s&#8239;m ", cw_format_number(table->operating_point.head, 4, text));
  fprintf(page, "at %s&#8239;rpm.</p>\n", cw_format_number(table->operating_point.speed * 30 / M_PI, 5, text));
  fputs("<div class=\"tiles\">\n", page);
  snprintf(label, sizeof label, "cells; %s asked, %+.2f&#8239;%%", cw_format_count(asked, more),
           asked ? 100 * ((double)cells / (double)asked - 1) : 0);
  tile(page, cw_format_count(cells, text), "", label);
  snprintf(label, sizeof label, "tetrahedra, %s of all cells", cw_format_percent((double)tets / (double)cells, more));
  tile(page, cw_format_count(tets, text), "", label);
  snprintf(label, sizeof label, "prisms, %s of all cells", cw_format_percent((double)prisms / (double)cells, more));
  tile(page, cw_format_count(prisms, text), "", label);
  size_t used = 0, named = (size_t)snprintf(label, sizeof label, "regions of ");
  for (int d = 0, last = data->mesh.domain_count - 1; d <= last && used < sizeof text && named < sizeof label; d++) {
    used += (size_t)snprintf(text + used, sizeof text - used, d ? " + %d" : "%d", data->mesh.domains[d].region_count);
    named += (size_t)snprintf(label + named, sizeof label - named, "%s%s",
                              d == 0      ? ""
                              : d == last ? " and "
                                          : ", ",
                              data->mesh.domains[d].name);
  }
  tile(page, text, "", label);
  snprintf(label, sizeof label, "predicted head; %s&#8239;m asked",
           cw_format_number(table->operating_point.head, 4, more));
  if (data->design) tile(page, cw_format_number(cw_json_real(data->design, "predicted_head_m"), 4, text), "m", label);
  snprintf(label, sizeof label, "whole run%s", data->record[2] ? ", geometry to export" : ", not exported yet");
  tile(page, cw_format_seconds(seconds, text), "", label);
  int64_t ranks = json_integer_value(json_object_get(results, "ranks"));
  snprintf(label, sizeof label, "cells/s of the mesher on %lld rank%s; %s of the whole run", (long long)ranks,
           ranks == 1 ? "" : "s", cw_format_si((double)cells / seconds, 3, more));
  tile(page, cw_format_si((double)cells / mesh_seconds, 3, text), "", label);
  tile(page, cw_format_bytes(memory, text), "", "peak memory, all ranks together");
  fputs("</div>\n", page);
  headlines(page, data);
  cw_page_picture_list(page, data, CW_SECTION_TITLE);
done:
  return status;
}

CwStatus cw_page_write(FILE *page, const CwReportData *data) {
  CwStatus status = CW_OK;
  fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>Cutwater: ",
        page);
  cw_html_text(page, data->table->name);
  fprintf(page, "</title>\n<style>\n%s</style>\n</head>\n<body>\n<nav><b>Cutwater report</b>\n", cw_page_style);
  fputs("<a href=\"#top\">Overview</a>\n", page);
  for (int k = 0; k < PARTS; k++)
    if (data->design || !parts[k].of_design)
      fprintf(page, "<a href=\"#%s\">%s</a>\n", parts[k].id, parts[k].heading);
  fputs("</nav>\n<main id=\"top\">\n", page);
  CW_TRY(title(page, data));
  for (int k = 0; k < PARTS; k++) {
    if (!data->design && parts[k].of_design) continue;
    fprintf(page, "<h2 id=\"%s\">%s</h2>\n", parts[k].id, parts[k].heading);
    CW_TRY(parts[k].part(page, data));
  }
  fputs("</main>\n</body>\n</html>\n", page);
done:
  return status;
}
