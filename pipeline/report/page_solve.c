// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/page_parts.h"

#include <math.h>
#include <stdlib.h>

#include "pipeline/json_read.h"
#include "pipeline/report/format.h"
#include "pipeline/report/html.h"
#include "pipeline/report/plot.h"

enum { ITERATION, HEAD, TORQUE, RESIDUAL_P, RESIDUAL_U, COLUMNS };

typedef struct {
  int count; // reports
  double *column[COLUMNS];
} History;

static CwStatus read_column(json_t *history, const char *where, const char *key, int count, double **column) {
  CwStatus status = CW_OK;
  json_t *list;
  CW_TRY(cw_json_array(history, where, key, &list));
  CW_REQUIRE(json_array_size(list) == (size_t)count, CW_ERR_INPUT, "%s: '%s' has %zu values; it must have %d", where,
             key, json_array_size(list), count);
  CW_NEW(*column, count);
  for (int k = 0; k < count; k++) {
    json_t *value = json_array_get(list, (size_t)k);
    (*column)[k] = json_is_number(value) ? json_number_value(value) : NAN;
  }
done:
  return status;
}

static CwStatus history_read(json_t *results, const char *where, History *history) {
  CwStatus status = CW_OK;
  static const char *const keys[COLUMNS] = {"iteration", "head_m", "torque_n_m", "residual_p", "residual_u"};
  json_t *object, *list;
  CW_TRY(cw_json_object(results, where, "history", &object));
  CW_TRY(cw_json_array(object, where, keys[ITERATION], &list));
  history->count = (int)json_array_size(list);
  for (int k = 0; k < COLUMNS; k++) CW_TRY(read_column(object, where, keys[k], history->count, &history->column[k]));
done:
  return status;
}

static void row(FILE *page, const char *name, double value, double scatter, double design, const char *unit) {
  char text[CW_FORMAT_SIZE];
  fprintf(page, "<tr><td>%s</td><td class=\"n\">%s</td>", name, cw_format_number(value, 4, text));
  fprintf(page, "<td class=\"n\">%s</td>", isfinite(scatter) ? cw_format_number(scatter, 2, text) : "");
  fprintf(page, "<td class=\"n\">%s</td><td>%s</td></tr>\n", isfinite(design) ? cw_format_number(design, 4, text) : "",
          unit);
}

static void result_table(FILE *page, const CwReportData *data, json_t *results) {
  double efficiency = cw_json_real(results, "hydraulic_efficiency");
  fputs("<table class=\"plain\"><tr><th></th><th class=\"n\">solved</th><th class=\"n\">&plusmn;</th>"
        "<th class=\"n\">design</th><th></th></tr>\n",
        page);
  row(page, "Head", cw_json_real(results, "head_m"), cw_json_real(results, "head_scatter_m"),
      cw_json_real(data->design, "predicted_head_m"), "m");
  row(page, "Shaft torque", cw_json_real(results, "torque_n_m"), cw_json_real(results, "torque_scatter_n_m"), NAN,
      "N&#8239;m");
  row(page, "Shaft power", cw_json_real(results, "shaft_power_w") * 1e-3, NAN, NAN, "kW");
  if (isfinite(efficiency))
    row(page, "Hydraulic efficiency", 100 * efficiency, NAN, 100 * cw_json_real(data->design, "hydraulic_efficiency"),
        "%");
  if (isfinite(cw_json_real(results, "npsh_inception_m")))
    row(page, "NPSH at inception", cw_json_real(results, "npsh_inception_m"), NAN, NAN, "m");
  fputs("</table>\n", page);
}

static void history_plots(FILE *page, const History *history, double asked) {
  const CwPlotSeries head = {"head, m", 0x0b5c8a, history->column[HEAD]};
  const CwPlotSeries torque = {"shaft torque, N m", 0x0b5c8a, history->column[TORQUE]};
  const CwPlotSeries residual[] = {{"pressure", 0x0b5c8a, history->column[RESIDUAL_P]},
                                   {"velocity, greatest component", 0xd9a24e, history->column[RESIDUAL_U]}};
  CwLinePlot plots[] = {{.axis = "head, m",
                         .series = &head,
                         .series_count = 1,
                         .mark = asked,
                         .caption = "<b>Head.</b> The broken line is the head that the case asks."},
                        {.axis = "shaft torque, N m",
                         .series = &torque,
                         .series_count = 1,
                         .mark = NAN,
                         .caption = "<b>Shaft torque.</b>"},
                        {.axis = "initial residual",
                         .series = residual,
                         .series_count = 2,
                         .logarithmic = 1,
                         .mark = 1e-4,
                         .caption = "<b>Residuals.</b> The broken line is 1e-4."}};
  fputs("<div class=\"grid\">\n", page);
  for (size_t k = 0; k < sizeof plots / sizeof *plots; k++) {
    plots[k].x_axis = "iteration";
    plots[k].x = history->column[ITERATION];
    plots[k].count = history->count;
    plots[k].width = 560;
    cw_plot_lines(page, &plots[k]);
  }
  fputs("</div>\n", page);
}

// Ends of the ranges of y+: of resolved walls, of the viscous sublayer, of the buffer layer and of the logarithmic
// layer (H. Schlichting and K. Gersten, Boundary-Layer Theory).
static const double y_plus_end[] = {1, 5, 30, 300, INFINITY};
enum { Y_PLUS_RANGES = sizeof y_plus_end / sizeof *y_plus_end };

// The share of a wall's faces in each range.
static void y_plus_shares(FILE *page, const CwFlow *flow, const char *patch) {
  const CwFoamValues *values = flow->present ? cw_foam_field_patch(&flow->y_plus, patch) : NULL;
  const int64_t count = !values ? 0 : values->bytes ? values->count : 1;
  int64_t within[Y_PLUS_RANGES] = {0};
  char text[CW_FORMAT_SIZE];
  for (int64_t k = 0; k < count; k++) {
    double value;
    int range = 0;
    cw_foam_field_value(&flow->y_plus, values, k, &value);
    while (value > y_plus_end[range]) range++;
    within[range]++;
  }
  for (int range = 0; range < Y_PLUS_RANGES; range++)
    fprintf(page, "</td><td class=\"n\">%s",
            cw_format_percent(count ? (double)within[range] / (double)count : NAN, text));
}

static void y_plus_table(FILE *page, const CwFlow *flow, json_t *walls) {
  const char *patch;
  json_t *wall;
  char text[CW_FORMAT_SIZE];
  if (json_object_size(walls) == 0) return;
  fputs("<h3>y+ of the solution</h3>\n<table class=\"plain\"><tr><th>Patch</th><th class=\"n\">least</th>"
        "<th class=\"n\">mean</th><th class=\"n\">greatest</th><th class=\"n\">faces with<br>up to 1</th>"
        "<th class=\"n\"><br>1 to 5</th><th class=\"n\"><br>5 to 30</th><th class=\"n\"><br>30 to 300</th>"
        "<th class=\"n\"><br>over 300</th></tr>\n",
        page);
  json_object_foreach(walls, patch, wall) {
    cw_html_label(page, "<tr><td>", patch, "");
    static const char *const keys[] = {"least", "mean", "most"};
    for (int k = 0; k < 3; k++)
      fprintf(page, "</td><td class=\"n\">%s", cw_format_number(cw_json_real(wall, keys[k]), 3, text));
    y_plus_shares(page, flow, patch);
    fputs("</td></tr>\n", page);
  }
  fputs("</table>\n", page);
}

CwStatus cw_page_solve(FILE *page, const CwReportData *data) {
  CwStatus status = CW_OK;
  History history = {0};
  json_t *results = json_object_get(data->solve, "results"), *curve;
  char where[4096], text[CW_FORMAT_SIZE], more[CW_FORMAT_SIZE];
  int64_t iterations;
  if (!data->solve) {
    fputs("<p>The flow of this run has not been solved (<code>make solve</code>).</p>\n", page);
    goto done;
  }
  snprintf(where, sizeof where, "%s/solve/record.json", data->run);
  CW_TRY(cw_json_count(results, where, "iterations", &iterations));
  if (!data->is_solved) {
    fputs("<p>The flow was solved on another export: solve it again (<code>make solve</code>).</p>\n", page);
    goto done;
  }
  CW_TRY(history_read(results, where, &history));
  fprintf(page, "<p>Steady flow with a frozen rotor, by OpenFOAM: head and torque %s after %s iterations (%s).</p>\n",
          json_is_true(json_object_get(results, "settled")) ? "have settled" : "have <b>not settled</b>",
          cw_format_count(iterations, text), cw_format_seconds(cw_json_real(data->solve, "seconds"), more));
  result_table(page, data, results);
  if (history.count > 1) history_plots(page, &history, data->table->operating_point.head);
  CW_TRY(cw_json_array(results, where, "curve", &curve));
  CW_TRY(cw_page_curve(page, data, where, curve));
  if (data->flow.present) {
    fputs("<h3>Fields</h3>\n", page);
    cw_page_picture_list(page, data, CW_SECTION_FLOW);
  }
  y_plus_table(page, &data->flow, json_object_get(results, "y_plus"));
done:
  for (int k = 0; k < COLUMNS; k++) free(history.column[k]);
  return status;
}
