// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/page_parts.h"

#include <math.h>

#include "pipeline/json_read.h"
#include "pipeline/report/format.h"
#include "pipeline/report/plot.h"

enum { POINTS_MOST = CW_LIST_MOST };
static const double AT_DESIGN = 5e-4; // share of the flow within which a point is the operating point (case_points.h)

enum { HEAD, POWER, EFFICIENCY, NPSH, QUANTITIES };

// Of each: its key in a point, and in the design that which holds at the operating point alone; the unit of the record
// in that of the page.
static const struct {
  const char *key, *design_key;
  double unit;
  const char *axis;
} quantity[QUANTITIES] = {{"head_m", NULL, 1, "head, m"},
                          {"shaft_power_w", "shaft_power_w", 1e-3, "shaft power, kW"},
                          {"hydraulic_efficiency", "hydraulic_efficiency", 100, "hydraulic efficiency, %"},
                          {"npsh_inception_m", "npsh_required_m", 1, "NPSH, m"}};

typedef struct {
  int count;
  double flow[POINTS_MOST];                                                // m3/h
  double solved[QUANTITIES][POINTS_MOST], design[QUANTITIES][POINTS_MOST]; // in the unit of the axis; NAN: none
} Curve;

// The design's head away from its point, for the hydraulic efficiency there (Euler's equation with a slip that does not
// depend on the flow): c_u2 falls with the share q of the flow as u2 f - (u2 f - c_u2) q, f the slip factor.
static double design_head(const json_t *design, double share) {
  const double most = cw_json_real(design, "slip_factor") * cw_json_real(design, "impeller_tip_speed_m_per_s");
  const double swirl = cw_json_real(design, "outlet_swirl_speed_m_per_s");
  return cw_json_real(design, "predicted_head_m") * (most - (most - swirl) * share) / swirl;
}

static CwStatus curve_read(json_t *points, const char *where, const json_t *design, Curve *curve) {
  CwStatus status = CW_OK;
  curve->count = (int)json_array_size(points);
  CW_REQUIRE(curve->count <= POINTS_MOST, CW_ERR_INPUT, "%s: 'curve' has %d points; allowed: at most %d", where,
             curve->count, POINTS_MOST);
  for (int k = 0; k < curve->count; k++) {
    const json_t *point = json_array_get(points, (size_t)k);
    const double share = cw_json_real(point, "flow_share");
    curve->flow[k] = cw_json_real(point, "flow_m3_per_h");
    for (int q = 0; q < QUANTITIES; q++) {
      const int here = quantity[q].design_key && fabs(share - 1) < AT_DESIGN;
      curve->solved[q][k] = quantity[q].unit * cw_json_real(point, quantity[q].key);
      curve->design[q][k] = here ? quantity[q].unit * cw_json_real(design, quantity[q].design_key) : NAN;
    }
    curve->design[HEAD][k] = design_head(design, share);
    CW_REQUIRE(isfinite(curve->flow[k]) && isfinite(curve->solved[HEAD][k]) &&
                   (k == 0 || curve->flow[k] > curve->flow[k - 1]),
               CW_ERR_INPUT, "%s: point %d of 'curve' has no head, or a flow not above that of the one before it",
               where, k + 1);
  }
done:
  return status;
}

static int some(const double *value, int count) {
  for (int k = 0; k < count; k++)
    if (isfinite(value[k])) return 1;
  return 0;
}

// One chart; what is told of the design stands in the caption where the design has it.
static void plot(FILE *page, const Curve *curve, int q, double mark, const char *caption, const char *of_design) {
  const CwPlotSeries series[] = {{"solved", 0x0b5c8a, curve->solved[q]}, {"design", 0xd9a24e, curve->design[q]}};
  const int designed = some(curve->design[q], curve->count);
  char text[600];
  if (!some(curve->solved[q], curve->count)) return;
  snprintf(text, sizeof text, "%s%s", caption, designed ? of_design : "");
  cw_plot_lines(page, &(CwLinePlot){.axis = quantity[q].axis,
                                    .x_axis = "flow rate, m3/h",
                                    .x = curve->flow,
                                    .count = curve->count,
                                    .series = series,
                                    .series_count = designed ? 2 : 1,
                                    .dots = 1,
                                    .mark = mark,
                                    .width = 560,
                                    .caption = text});
}

static void plots(FILE *page, const Curve *curve, const CwReportData *data) {
  const double available = cw_json_real(data->design, "npsh_available_m");
  fputs("<div class=\"grid\">\n", page);
  plot(page, curve, HEAD, data->table->operating_point.head,
       "<b>Head.</b> The broken line is the head that the case asks.",
       " The design's is Euler's with slip, times its hydraulic efficiency at the operating point.");
  plot(page, curve, POWER, NAN, "<b>Shaft power</b> of the torque on the walls that turn.",
       " The design predicts one point: the head that the case asks, with leakage and disk friction, which are not "
       "solved.");
  plot(page, curve, EFFICIENCY, NAN, "<b>Hydraulic efficiency.</b>",
       " The design predicts one point, the operating point, by correlation with water.");
  plot(page, curve, NPSH, available,
       isfinite(available) ? "<b>NPSH</b> at the inception of cavitation. The broken line is the NPSH that the inlet "
                             "pressure makes available."
                           : "<b>NPSH</b> at the inception of cavitation.",
       " The design predicts one point, the NPSH required at the operating point (3 % loss of head, below inception).");
  fputs("</div>\n", page);
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
    const double values[] = {curve->flow[k],
                             cw_json_real(point, "flow_share"),
                             curve->solved[HEAD][k],
                             cw_json_real(point, "head_scatter_m"),
                             curve->design[HEAD][k],
                             curve->solved[POWER][k],
                             curve->solved[EFFICIENCY][k],
                             curve->solved[NPSH][k]};
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
  fputs("<h3>Characteristic curve</h3>\n", page);
  plots(page, &curve, data);
  table(page, &curve, points);
done:
  return status;
}
