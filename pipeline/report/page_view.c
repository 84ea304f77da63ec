// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/page_parts.h"

#include <math.h>
#include <stdlib.h>

#include "pipeline/report/html.h"
#include "pipeline/report/picture_list.h"
#include "pipeline/report/page_texts.h"

enum { LATTICE = 65535, SCALE_COLOURS = 256 };

// The box of all points, and the step of a lattice of 16 bits along its longest side.
static double lattice_of(const CwView *view, double least[3]) {
  double most[3] = {-INFINITY, -INFINITY, -INFINITY}, side = 0;
  for (int i = 0; i < 3; i++) least[i] = INFINITY;
  for (int k = 0; k < view->part_count; k++) {
    for (int32_t p = 0; p < view->part[k].point_count; p++) {
      for (int i = 0; i < 3; i++) {
        least[i] = fmin(least[i], view->part[k].points[p][i]);
        most[i] = fmax(most[i], view->part[k].points[p][i]);
      }
    }
  }
  for (int i = 0; i < 3; i++) {
    side = fmax(side, most[i] - least[i]);
    if (!isfinite(least[i])) least[i] = 0; // parts without points
  }
  return side / LATTICE;
}

static CwStatus write_points(FILE *page, const CwViewPart *part, const double least[3], double step) {
  CwStatus status = CW_OK;
  unsigned char *bytes = NULL;
  CW_NEW(bytes, 6 * part->point_count);
  for (int32_t p = 0; p < part->point_count; p++) {
    for (int i = 0; i < 3; i++) {
      unsigned at = (unsigned)fmin(fmax((part->points[p][i] - least[i]) / step + 0.5, 0), LATTICE);
      bytes[6 * p + 2 * i] = (unsigned char)(at & 255);
      bytes[6 * p + 2 * i + 1] = (unsigned char)(at >> 8);
    }
  }
  cw_html_base64(page, bytes, 6 * (size_t)part->point_count);
done:
  free(bytes);
  return status;
}

static CwStatus write_corners(FILE *page, const CwViewPart *part, int width) {
  CwStatus status = CW_OK;
  unsigned char *bytes = NULL;
  size_t made = 0;
  CW_NEW(bytes, (size_t)(3 * width) * (size_t)part->triangle_count);
  for (int32_t t = 0; t < part->triangle_count; t++)
    for (int k = 0; k < 3; k++)
      for (int b = 0; b < width; b++) bytes[made++] = (unsigned char)((unsigned)part->corners[t][k] >> (8 * b) & 255);
  cw_html_base64(page, bytes, made);
done:
  free(bytes);
  return status;
}

static unsigned colour_of(const CwMesh *mesh, const CwViewPart *part) {
  const CwModelPatch *patch = &mesh->patches[part->patch];
  return cw_patch_colour(patch->name, part->patch - mesh->domains[patch->domain].first_patch);
}

static CwStatus write_part(FILE *page, const CwMesh *mesh, const CwView *view, int index, const double least[3],
                           double step) {
  CwStatus status = CW_OK;
  const CwViewPart *part = &view->part[index];
  int wide = part->point_count > LATTICE + 1;
  fprintf(page, "%s{\"shown\":%d,\"colour\":%u,\"wide\":%d,\n\"points\":\"", index ? "," : "",
          cw_view_shown(mesh, part), colour_of(mesh, part), wide);
  CW_TRY(write_points(page, part, least, step));
  fputs("\",\n\"corners\":\"", page);
  CW_TRY(write_corners(page, part, wide ? 4 : 2));
  fputs("\",\n\"values\":[", page);
  for (int q = 0; q < CW_VIEW_QUANTITIES; q++) {
    fputs(q ? ",\"" : "\"", page);
    if (part->values[q]) cw_html_base64(page, part->values[q], (size_t)part->point_count);
    fputs("\"", page);
  }
  fputs("]}\n", page);
done:
  return status;
}

static CwStatus write_data(FILE *page, const CwMesh *mesh, const CwView *view, int suction) {
  CwStatus status = CW_OK;
  unsigned char scale[3 * SCALE_COLOURS];
  double least[3], step = lattice_of(view, least);
  for (int k = 0; k < SCALE_COLOURS; k++) {
    uint32_t colour = cw_colour_scale((double)k / (SCALE_COLOURS - 1));
    for (int c = 0; c < 3; c++) scale[3 * k + c] = (unsigned char)(colour >> (16 - 8 * c) & 255);
  }
  fputs("<script type=\"application/json\" id=\"view-data\">{", page);
  fprintf(page, "\"step\":%.9g,\"least\":[%.9g,%.9g,%.9g],\"suction\":%d,\"scale\":\"", isfinite(step) ? step : 0,
          least[0], least[1], least[2], suction);
  cw_html_base64(page, scale, sizeof scale);
  fputs("\",\"parts\":[\n", page);
  for (int k = 0; k < view->part_count; k++) CW_TRY(write_part(page, mesh, view, k, least, step));
  fputs("]}</script>\n", page);
done:
  return status;
}

static void write_box(FILE *page, const CwMesh *mesh, const CwView *view, int index) {
  const CwViewPart *part = &view->part[index];
  fprintf(page, "<label><input type=\"checkbox\" data-part=\"%d\"%s><i style=\"background:#%06x\"></i>", index,
          cw_view_shown(mesh, part) ? " checked" : "", colour_of(mesh, part));
  cw_html_label(page, "", mesh->patches[part->patch].name, "</label>\n");
}

static void write_boxes(FILE *page, const CwMesh *mesh, const CwView *view) {
  fputs("<div class=\"parts\">\n", page);
  for (int d = 0; d < mesh->domain_count; d++) {
    cw_html_label(page, "<fieldset><legend>", mesh->domains[d].name,
                  "</legend><button type=\"button\" data-zone>all or none</button>\n");
    for (int k = 0; k < view->part_count; k++)
      if (mesh->patches[view->part[k].patch].domain == d) write_box(page, mesh, view, k);
    fputs("</fieldset>\n", page);
  }
  fputs("</div>\n", page);
}

static void write_controls(FILE *page, const CwView *view) {
  fputs("<div class=\"controls\">\n<span><button type=\"button\" data-view=\"home\">Home</button>"
        "<button type=\"button\" data-view=\"suction\">Suction side</button>"
        "<button type=\"button\" data-view=\"back\">Drive side</button>"
        "<button type=\"button\" data-view=\"side\">Side</button></span>\n"
        "<span class=\"cut off\"><label>Cut <select name=\"cut\"><option value=\"\">none</option>"
        "<option value=\"x\">across x</option><option value=\"y\">across y</option>"
        "<option value=\"z\">across z (the axis)</option></select></label>"
        "<input type=\"range\" name=\"place\" min=\"0\" max=\"1000\" value=\"500\" aria-label=\"place of the cut\">"
        "<label><input type=\"checkbox\" name=\"flip\"> other side</label></span>\n",
        page);
  if (view->quantity_count) {
    fputs("<label>Colour <select name=\"colour\"><option value=\"-1\">patches</option>", page);
    for (int q = 0; q < view->quantity_count; q++)
      fprintf(page, "<option value=\"%d\">%s</option>", q, view->quantity[q].name);
    fputs("</select></label>\n", page);
  }
  fputs("</div>\n", page);
  for (int q = 0; q < view->quantity_count; q++) {
    fprintf(page, "<div data-bar=\"%d\" hidden>", q);
    cw_colour_bar(page, &view->quantity[q].span, view->quantity[q].label);
    fputs("</div>\n", page);
  }
}

CwStatus cw_page_view(FILE *page, const CwReportData *data) {
  CwStatus status = CW_OK;
  const CwMesh *mesh = &data->mesh;
  const CwView *view = &data->view;
  int32_t triangles = 0;
  if (view->part_count == 0) goto done;
  for (int k = 0; k < view->part_count; k++) triangles += view->part[k].triangle_count;
  fprintf(page, "<figure id=\"view\" class=\"turning\" data-triangles=\"%d\">\n", (int)triangles);
  fputs("<canvas tabindex=\"0\" role=\"img\" aria-label=\"the pump, to be turned\"></canvas>\n"
        "<div class=\"lacking\" hidden>This picture turns in browsers with WebGL; this one has none, or it is switched "
        "off.</div>\n<noscript><div class=\"lacking\">This picture needs JavaScript.</div></noscript>\n",
        page);
  write_controls(page, view);
  write_boxes(page, mesh, view);
  fprintf(page,
          "<figcaption><b>The pump, to be turned.</b> Drag or arrow keys: turn; wheel, two fingers or + and &minus;: "
          "zoom; with Shift, the right button or two fingers: shift. The walls, inlet and outlet of the mesh%s "
          "%d triangles.</figcaption>\n",
          view->decimated ? ", decimated to" : ":", (int)triangles);
  CW_TRY(write_data(page, mesh, view, cw_report_suction(data)));
  fprintf(page, "<script>\n%s</script>\n</figure>\n", cw_page_viewer);
done:
  return status;
}
