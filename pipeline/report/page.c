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

static const char style[] =
    ":root{--ink:#1f2933;--soft:#5f6c7b;--line:#dde3e9;--blue:#0b5c8a;--ground:#f6f8fa}\n"
    "*{box-sizing:border-box}\n"
    "html{scroll-behavior:smooth}\n"
    "body{margin:0;color:var(--ink);background:#fff;font:15px/1.5 'Helvetica "
    "Neue',Helvetica,Arial,'Liberation Sans',"
    "sans-serif;font-variant-numeric:tabular-nums}\n"
    "nav{position:fixed;top:0;left:0;bottom:0;width:214px;padding:34px 20px;background:var(--ground);"
    "border-right:1px solid var(--line);overflow:auto;font-size:14px}\n"
    "nav b{display:block;margin-bottom:14px;letter-spacing:.02em}\n"
    "nav a{display:block;padding:4px 0;color:var(--soft);text-decoration:none}\n"
    "nav a:hover{color:var(--blue)}\n"
    "main{margin-left:214px;padding:40px 52px 90px;max-width:1334px}\n"
    "h1{font-size:34px;font-weight:600;line-height:1.2;margin:0 0 6px}\n"
    "h2{font-size:22px;font-weight:600;margin:62px 0 10px;padding-top:14px;border-top:2px solid var(--ink)}\n"
    "h3{font-size:16px;font-weight:600;margin:30px 0 8px}\n"
    "p{max-width:78ch;margin:8px 0 14px}\n"
    ".lead{color:var(--soft);font-size:17px;margin:0 0 26px}\n"
    ".tiles{display:grid;grid-template-columns:repeat(4,1fr);border-top:1px solid var(--line);"
    "border-left:1px solid var(--line);margin:0 0 30px}\n"
    ".tiles div{padding:14px 16px 12px;border-right:1px solid var(--line);border-bottom:1px solid "
    "var(--line)}\n"
    ".tiles b{display:block;font-size:25px;font-weight:600;line-height:1.25}\n"
    ".tiles span{color:var(--soft);font-size:13px;line-height:1.35;display:block}\n"
    "table{border-collapse:collapse;margin:10px 0 20px;font-size:14px}\n"
    "th{text-align:left;font-weight:600;color:var(--soft);font-size:13px;border-bottom:1px solid var(--ink);"
    "padding:4px 18px 5px 0;vertical-align:bottom}\n"
    "td{padding:3px 18px 3px 0;border-bottom:1px solid var(--line);vertical-align:top}\n"
    "th.n,td.n{text-align:right;white-space:nowrap}\n"
    "td.n span{display:inline-block;min-width:3.1em;text-align:left}\n"
    "th.p{padding-right:calc(18px + 3.1em)}\n"
    "table.plain td.n span{min-width:0}\n"
    "tr.s td{font-weight:600;padding-top:16px;border-bottom:1px solid var(--soft)}\n"
    "tr.t td{font-weight:600;border-top:1px solid var(--ink)}\n"
    "td.q{color:var(--soft)}\n"
    "td.o{white-space:nowrap}\n"
    ".columns{columns:2;column-gap:52px}.columns table{width:100%;break-inside:avoid;margin-top:0}\n"
    ".grid{display:grid;grid-template-columns:repeat(2,minmax(0,1fr));gap:30px 34px;margin:18px 0}\n"
    ".wide{grid-column:1/-1}\n"
    "sub,sup{line-height:0;font-size:75%}a{color:var(--blue)}\n"
    "figure{margin:0}figure img{display:block;width:100%;height:auto;border:1px solid var(--line)}\n"
    "figure svg{max-width:100%;height:auto}\n"
    ".drawing{margin:18px 0 30px}.drawing svg{display:block;border:1px solid var(--line)}\n"
    "figcaption{margin-top:8px;font-size:14px;color:var(--soft);max-width:88ch}figcaption "
    "b{color:var(--ink)}\n"
    ".key{margin:5px 0 0;font-size:13px;color:var(--soft);display:flex;flex-wrap:wrap;gap:2px 16px}\n"
    ".key i{display:inline-block;width:11px;height:11px;margin-right:6px;border:1px solid rgba(0,0,0,.25);"
    "vertical-align:-1px}\n"
    ".lacking{border:1px dashed var(--line);padding:40px 20px;color:var(--soft)}\n"
    ".warn{border-left:3px solid #c77700;background:#fdf6ea;padding:8px 14px;margin:8px 0;max-width:100ch}\n"
    ".fine{border-left:3px solid #3d8b5a;background:#eff7f2;padding:8px 14px;margin:8px 0;max-width:100ch}\n"
    "svg.plot{display:block;margin:6px 0 4px;font-family:inherit;overflow:visible}\n"
    ".plot .g{stroke:#e3e8ed}.plot .a{stroke:#7b8794}.plot .m{stroke:#b3261e;stroke-dasharray:4 3}\n"
    ".plot .t,.plot .x{font-size:12px;fill:#5f6c7b}.plot "
    ".v{font-size:10.5px;fill:#3e4c59;paint-order:stroke;stroke:#fff;stroke-width:3px;stroke-linejoin:round}"
    "\n"
    ".plot .c,.plot .k{font-size:12.5px;fill:#1f2933}\n"
    "@media(max-width:1000px){nav{position:static;width:auto;border:0}main{margin:0;padding:20px}"
    ".tiles{grid-template-columns:1fr "
    "1fr}.grid,.columns{display:block;columns:1}.grid>*{margin-bottom:26px}}\n"
    "@media print{nav{display:none}main{margin:0;padding:0;max-width:none}h2{break-after:avoid}"
    "figure,table{break-inside:avoid}}\n";

typedef CwStatus (*Part)(FILE *page, const CwReportData *data);

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

// What the mesher tells before all else.
static void headlines(FILE *page, json_t *results) {
  size_t k;
  json_t *text;
  json_array_foreach(json_object_get(results, "headlines"), k, text) {
    fputs("<div class=\"warn\">", page);
    cw_html_text(page, json_string_value(text));
    fputs("</div>\n", page);
  }
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
  headlines(page, results);
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
  fprintf(page, "</title>\n<style>\n%s</style>\n</head>\n<body>\n<nav><b>Cutwater report</b>\n", style);
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
