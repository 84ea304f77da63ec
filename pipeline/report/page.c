// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/page.h"

#include <math.h>

#include "pipeline/json_read.h"
#include "pipeline/report/format.h"
#include "pipeline/report/html.h"
#include "pipeline/report/page_parts.h"
#include "pipeline/report/page_texts.h"

static const struct {
  const char *id, *heading;
  CwStatus (*part)(FILE *page, const CwReportData *data); // NULL: an introduction and the pictures of a section
  int of_design;                                          // 1: left out where no generator made the pump
  const char *introduction;
  CwPictureSection section;
} parts[] = {
    {"turn", "The pump in three dimensions", .part = cw_page_view},
    {"input", "Design table", .part = cw_page_input, .of_design = 1},
    {"design", "Derived dimensions", .part = cw_page_design, .of_design = 1},
    {"drawings", "Design drawings", .part = cw_page_design_pictures, .of_design = 1},
    {"geometry", "Geometry",
     .introduction = "Drawn from the boundary faces of the finished mesh, coloured by patch. All pictures of this page "
                     "are turned alike: along the axis or obliquely they look from the suction side with x up, so that "
                     "the discharge leads to the right (to the left where the impeller turns clockwise, seen from the "
                     "drive); across the axis and close by, the suction side is up.",
     .section = CW_SECTION_GEOMETRY},
    {"counts", "Mesh counts", .part = cw_page_counts},
    {"regions", "Regions", .part = cw_page_regions},
    {"surface", "Surface mesh",
     .introduction = "Close views of the wall faces with their edges; every node lies on the exact surface.",
     .section = CW_SECTION_SURFACE},
    {"volume", "Volume mesh",
     .introduction = "True sections: each polygon is the cut of the plane through one cell, so tetrahedra look more "
                     "uneven than they are. Red frames are the close views that follow.",
     .section = CW_SECTION_CUT},
    {"quality", "Cell quality", .part = cw_page_quality},
    {"layers", "Prism layers", .part = cw_page_layers},
    {"export", "Export", .part = cw_page_export},
    {"solve", "Solved flow", .part = cw_page_solve},
    {"times", "Times and memory", .part = cw_page_times},
    {"warnings", "Warnings", .part = cw_page_warnings},
};
enum { PARTS = sizeof parts / sizeof *parts };

static void tile(FILE *page, const char *value, const char *unit, const char *label) {
  fprintf(page, "<div><b>%s%s%s</b><span>%s</span></div>\n", value, *unit ? "&#8239;" : "", unit, label);
}

static void regions_tile(FILE *page, const CwMesh *mesh) {
  fputs("<div><b>", page);
  for (int d = 0; d < mesh->domain_count; d++) fprintf(page, "%s%d", d ? " + " : "", mesh->domains[d].region_count);
  fputs("</b><span>regions of ", page);
  for (int d = 0; d < mesh->domain_count; d++) {
    const char *before = d == 0 ? "" : d == mesh->domain_count - 1 ? " and " : ", ";
    fprintf(page, "%s%s", before, mesh->domains[d].name);
  }
  fputs("</span></div>\n", page);
}

// What the stages tell before all else; the geometry, whose warnings are few, all of them in one box to be opened.
static void headlines(FILE *page, const CwReportData *data) {
  size_t k;
  json_t *text, *remarks = json_object_get(data->record[0], "warnings");
  for (int s = 0; s < CW_STAGES; s++) {
    json_array_foreach(json_object_get(json_object_get(data->record[s], "results"), "headlines"), k, text) {
      cw_html_text(page, "<div class=\"warn\">", json_string_value(text), "</div>\n");
    }
  }
  if (json_array_size(remarks) == 0) return;
  fprintf(page, "<details class=\"warn\"><summary>Geometry: %zu warning%s</summary><ul>\n", json_array_size(remarks),
          json_array_size(remarks) == 1 ? "" : "s");
  json_array_foreach(remarks, k, text) {
    cw_html_text(page, "<li>", json_string_value(text), "</li>\n");
  }
  fputs("</ul></details>\n", page);
}

static CwStatus title(FILE *page, const CwReportData *data) {
  CwStatus status = CW_OK;
  char text[CW_FORMAT_SIZE], more[CW_FORMAT_SIZE], label[200], where[4096];
  int64_t cells = 0, tets = 0, prisms = 0, asked;
  double seconds = 0, mesh_seconds = cw_json_real(data->record[1], "seconds"), memory = 0;
  json_t *results = json_object_get(data->record[1], "results");
  const CwCase *table = data->table;
  snprintf(where, sizeof where, "%s/mesh/record.json: results", data->run);
  CW_TRY(cw_json_count(results, where, "asked_cells", &asked));
  for (int r = 0; r < data->mesh.region_count; r++) {
    const CwMeshRegion *region = &data->mesh.regions[r];
    tets += region->tetrahedra;
    prisms += region->prisms;
    cells += cw_mesh_region_cells(region);
  }
  for (int s = 0; s < CW_STAGES; s++) {
    if (!data->record[s]) continue;
    seconds += cw_json_real(data->record[s], "seconds");
    memory = fmax(memory, cw_json_real(data->record[s], "peak_memory_bytes"));
  }
  cw_html_text(page, "<h1>Pump ", table->name, "");
  fprintf(page, ": from %s to mesh</h1>\n<p class=\"lead\">", data->design ? "design table" : "solids");
  fputs("Centrifugal pump, ", page);
  if (data->mesh.flow.blade_count > 1) // else its passages are not equal
    fprintf(page, "%d blades, ", data->mesh.flow.blade_count);
  fprintf(page, "D<sub>2</sub>&#8239;=&#8239;%s&#8239;mm; ",
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
  regions_tile(page, &data->mesh);
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
  cw_html_text(page, "", data->table->name, "");
  fprintf(page, "</title>\n<style>\n%s</style>\n</head>\n<body>\n<nav><b>Cutwater report</b>\n", cw_page_style);
  fputs("<a href=\"#top\">Overview</a>\n", page);
  for (int k = 0; k < PARTS; k++)
    if (data->design || !parts[k].of_design) fprintf(page, "<a href=\"#%s\">%s</a>\n", parts[k].id, parts[k].heading);
  fputs("</nav>\n<main id=\"top\">\n", page);
  CW_TRY(title(page, data));
  for (int k = 0; k < PARTS; k++) {
    if (!data->design && parts[k].of_design) continue;
    fprintf(page, "<h2 id=\"%s\">%s</h2>\n", parts[k].id, parts[k].heading);
    if (parts[k].part) {
      CW_TRY(parts[k].part(page, data));
    } else {
      fprintf(page, "<p>%s</p>\n", parts[k].introduction);
      cw_page_picture_list(page, data, parts[k].section);
    }
  }
  fputs("</main>\n</body>\n</html>\n", page);
done:
  return status;
}
