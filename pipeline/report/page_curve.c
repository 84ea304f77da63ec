// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/page_parts.h"

#include <math.h>

#include "pipeline/json_read.h"
#include "pipeline/report/format.h"
#include "pipeline/report/plot.h"

enum { POINTS_MOST = CW_LIST_MOST };

typedef struct {
  int count;
  double flow[POINTS_MOST], head[POINTS_MOST], power[POINTS_MOST], efficiency[POINTS_MOST]; // m3/h, m, kW, %
  double design_head[POINTS_MOST];
} Curve;

// The design's head away from its point, for the hydraulic efficiency there (Euler's equation with a slip that does not
// depend on the flow): c_u2 falls with the share q of the flow as u2 f - (u2 f - c_u2) q, f the slip factor.
static double design_head(const json_t *design, double share) {
  const double u2 = cw_json_real(design, "impeller_tip_speed_m_per_s");
  const double most = cw_json_real(design, "slip_factor") * u2;
  const double swirl = most - (most - cw_json_real(design, "outlet_swirl_speed_m_per_s")) * share;
  return cw_json_real(design, "hydraulic_efficiency") * u2 * swirl / CW_GRAVITY;
}

static CwStatus curve_read(json_t *points, const char *where, const json_t *design, Curve *curve) {
  CwStatus status = CW_OK;
  curve->count = (int)json_array_size(points);
  CW_REQUIRE(curve->count <= POINTS_MOST, CW_ERR_INPUT, "%s: 'curve' has %d points; allowed: at most %d", where,
             curve->count, POINTS_MOST);
  for (int k = 0; k < curve->count; k++) {
    const json_t *point = json_array_get(points, (size_t)k);
    curve->flow[k] = cw_json_real(point, "flow_m3_per_h");
    curve->head[k] = cw_json_real(point, "head_m");
    curve->power[k] = 1e-3 * cw_json_real(point, "shaft_power_w");
    curve->efficiency[k] = 100 * cw_json_real(point, "hydraulic_efficiency");
    curve->design_head[k] = design_head(design, cw_json_real(point, "flow_share"));
    CW_REQUIRE(isfinite(curve->flow[k]) && isfinite(curve->head[k]) && (k == 0 || curve->flow[k] > curve->flow[k - 1]),
               CW_ERR_INPUT, "%s: point %d of 'curve' has no head, or a flow not above that of the one before it",
               where, k + 1);
  }
done:
  return status;
}

static void plot(FILE *page, const Curve *curve, const char *axis, const CwPlotSeries *series, int count, double mark,
                 const char *caption) {
  cw_plot_lines(page, &(CwLinePlot){.axis = axis,
                                    .x_axis = "flow rate, m3/h",
                                    .x = curve->flow,
                                    .count = curve->count,
                                    .series = series,
                                    .series_count = count,
                                    .mark = mark,
                                    .width = 560,
                                    .caption = caption});
}

static void table(FILE *page, const Curve *curve, json_t *points) {
  char text[CW_FORMAT_SIZE];
  fputs("<table class=\"plain\"><tr><th class=\"n\">flow, m&sup3;/h</th><th class=\"n\">share</th>"
        "<th class=\"n\">head, m</th><th class=\"n\">&plusmn;</th><th class=\"n\">design, m</th>"
        "<th class=\"n\">power, kW</th><th class=\"n\">efficiency, %</th>"
        "<th class=\"n\">NPSH at inception, m</th><th></th></tr>\n",
        page);
  enum { SCATTER = 3 }; // its column
  for (int k = 0; k < curve->count; k++) {
    const json_t *point = json_array_get(points, (size_t)k);
    const double values[] = {curve->flow[k],        cw_json_real(point, "flow_share"),
                             curve->head[k],        cw_json_real(point, "head_scatter_m"),
                             curve->design_head[k], curve->power[k],
                             curve->efficiency[k],  cw_json_real(point, "npsh_inception_m")};
    fputs("<tr>", page);
    for (size_t c = 0; c < sizeof values / sizeof *values; c++)
      fprintf(page, "<td class=\"n\">%s</td>",
              isfinite(values[c]) ? cw_format_number(values[c], c == SCATTER ? 2 : 4, text) : "");
    fprintf(page, "<td>%s</td></tr>\n", json_is_true(json_object_get(point, "settled")) ? "" : "not settled");
  }
  fputs("</table>\n", page);
}

CwStatus cw_page_curve(FILE *page, const CwReportData *data, const char *where, json_t *points) {
  CwStatus status = CW_OK;
  Curve curve = {0};
  if (json_array_size(points) < 2) goto done;
  CW_TRY(curve_read(points, where, data->design, &curve));
  const CwPlotSeries heads[] = {{"solved", 0x0b5c8a, curve.head}, {"design", 0xd9a24e, curve.design_head}};
  const CwPlotSeries power = {NULL, 0x0b5c8a, curve.power}, efficiency = {NULL, 0x0b5c8a, curve.efficiency};
  fputs("<h3>Characteristic curve</h3>\n<div class=\"grid\">\n", page);
  plot(page, &curve, "head, m", heads, data->design ? 2 : 1, data->table->operating_point.head,
       data->design ? "<b>Head.</b> The broken line is the head that the case asks; the design's is Euler's with slip, "
                      "times its hydraulic efficiency at the operating point."
                    : "<b>Head.</b> The broken line is the head that the case asks.");
  plot(page, &curve, "shaft power, kW", &power, 1, NAN, "<b>Shaft power.</b>");
  plot(page, &curve, "hydraulic efficiency, %", &efficiency, 1, NAN, "<b>Hydraulic efficiency.</b>");
  fputs("</div>\n", page);
  table(page, &curve, points);
done:
  return status;
}
