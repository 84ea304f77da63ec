// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/page_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/json_read.h"
#include "pipeline/report/format.h"
#include "pipeline/report/html.h"
#include "pipeline/report/plot.h"
#include "pipeline/report/quantity.h"

// A plain value of the key, or a list of them, in the unit that quantities of that name are shown in.
static void value_text(FILE *page, const char *key, json_t *value) {
  char text[CW_FORMAT_SIZE];
  if (json_is_integer(value))
    fputs(cw_format_count(json_integer_value(value), text), page);
  else if (json_is_real(value))
    fputs(cw_format_number(json_real_value(value) * cw_quantity_unit(key)->scale, 5, text), page);
  else if (json_is_string(value))
    cw_html_text(page, "", json_string_value(value), "");
  else if (json_is_boolean(value))
    fputs(json_is_true(value) ? "yes" : "no", page);
  else if (json_is_array(value))
    for (size_t k = 0; k < json_array_size(value); k++) {
      fputs(k ? ", " : "", page);
      value_text(page, key, json_array_get(value, k));
    }
  else
    fputs("\342\200\223", page);
}

static int is_table(json_t *value) {
  return json_is_array(value) && json_array_size(value) && json_is_object(json_array_get(value, 0));
}

static int is_plain(json_t *value) {
  return !json_is_object(value) && !json_is_array(value);
}

// An array of alike objects as a table.
static void object_table(FILE *page, json_t *array) {
  const char *key;
  json_t *member, *row, *first = json_array_get(array, 0);
  char stem[CW_STEM_SIZE];
  size_t k;
  fputs("<table class=\"plain\"><tr>", page);
  json_object_foreach(first, key, member) {
    fprintf(page, "<th%s>", json_is_number(member) ? " class=\"n\"" : "");
    cw_quantity_stem(key, stem);
    cw_html_label(page, "", stem, "");
    if (*cw_quantity_unit(key)->unit) fprintf(page, ", %s", cw_quantity_unit(key)->unit);
    fputs("</th>", page);
  }
  fputs("</tr>\n", page);
  json_array_foreach(array, k, row) {
    fputs("<tr>", page);
    json_object_foreach(first, key, member) {
      json_t *value = json_object_get(row, key);
      fprintf(page, "<td%s>", json_is_number(value) ? " class=\"n\"" : "");
      value_text(page, key, value);
      fputs("</td>", page);
    }
    fputs("</tr>\n", page);
  }
  fputs("</table>\n", page);
}

// The plain values of an object, one a row.
static void value_table(FILE *page, json_t *object) {
  const char *key;
  json_t *value;
  char stem[CW_STEM_SIZE];
  fputs("<table class=\"plain\">", page);
  json_object_foreach(object, key, value) {
    if (!is_plain(value)) continue;
    cw_quantity_stem(key, stem);
    cw_html_label(page, "<tr><td>", stem, "</td><td class=\"n\">");
    value_text(page, key, value);
    fprintf(page, "</td><td>%s</td></tr>\n", cw_quantity_unit(key)->unit);
  }
  fputs("</table>\n", page);
}

static void result_tables(FILE *page, json_t *results) {
  const char *key;
  json_t *value;
  value_table(page, results);
  fputs("<div class=\"grid\">\n", page);
  json_object_foreach(results, key, value) {
    if (is_plain(value) || (json_is_array(value) && !is_table(value))) continue;
    fprintf(page, "<div%s>", json_is_array(value) ? " class=\"wide\"" : "");
    cw_html_label(page, "<h3>", key, "</h3>\n");
    if (is_table(value))
      object_table(page, value);
    else
      value_table(page, value);
    fputs("</div>\n", page);
  }
  fputs("</div>\n", page);
}

CwStatus cw_page_export(FILE *page, const CwReportData *data) {
  if (!data->record[2]) {
    fputs("<p>This run has not been exported: <code>export/record.json</code> is not there.</p>\n", page);
    return CW_OK;
  }
  fputs("<p>What the exporter counted and measured while it wrote the files of the solvers.</p>\n", page);
  result_tables(page, json_object_get(data->record[2], "results"));
  return CW_OK;
}

// Steps that bear the same name (the passes of the mesher) become one.
typedef struct {
  const char *name;
  double seconds[CW_STAGES];
  int times;
} Step;

static size_t gather_steps(const CwReportData *data, Step *step, CwPlotCategory *category) {
  size_t count = 0;
  for (int s = 0; s < CW_STAGES; s++) {
    json_t *list = json_object_get(data->record[s], "steps"), *item;
    size_t first = count, k;
    json_array_foreach(list, k, item) {
      const char *name = json_string_value(json_object_get(item, "name"));
      const char *unit = json_string_value(json_object_get(item, "unit"));
      char seconds[CW_FORMAT_SIZE], items[CW_FORMAT_SIZE];
      size_t at = first;
      while (at < count && strcmp(step[at].name, name)) at++;
      CwPlotCategory *of = &category[at];
      if (at == count) {
        step[count++] = (Step){.name = name, .seconds = {NAN, NAN, NAN}};
        step[at].seconds[s] = 0;
        snprintf(of->label, sizeof of->label, "%s: %s", cw_report_stage[s], name);
      }
      step[at].times++;
      step[at].seconds[s] += cw_json_real(item, "seconds");
      double number = cw_json_real(item, "items");
      snprintf(of->note, sizeof of->note, "%s", cw_format_seconds(step[at].seconds[s], seconds));
      size_t used = strlen(of->note);
      if (isfinite(number) && unit)
        used += (size_t)snprintf(of->note + used, sizeof of->note - used, ", %s %s",
                                 cw_format_count((int64_t)number, items), unit);
      if (step[at].times > 1 && used < sizeof of->note)
        snprintf(of->note + used, sizeof of->note - used, ", %d passes", step[at].times);
    }
  }
  return count;
}

CwStatus cw_page_times(FILE *page, const CwReportData *data) {
  CwStatus status = CW_OK;
  static const uint32_t colours[CW_STAGES] = {0x7a9e87, 0x4f8fc0, 0xd9a24e};
  Step *step = NULL;
  double *value[CW_STAGES] = {NULL}, sum = 0;
  CwPlotCategory *category = NULL;
  char text[CW_FORMAT_SIZE];
  size_t most = 0, count;
  CwPlotSeries series[CW_STAGES];
  for (int s = 0; s < CW_STAGES; s++) most += json_array_size(json_object_get(data->record[s], "steps"));
  CW_NEW(step, most);
  CW_NEW(category, most);
  count = gather_steps(data, step, category);
  for (int s = 0; s < CW_STAGES; s++) {
    CW_NEW(value[s], count);
    for (size_t k = 0; k < count; k++) value[s][k] = step[k].seconds[s];
    series[s] = (CwPlotSeries){cw_report_stage[s], colours[s], value[s]};
  }
  fputs("<table class=\"plain\"><tr><th>Stage</th><th class=\"n\">Time</th><th class=\"n\">Peak memory</th>"
        "<th class=\"n\">Warnings</th></tr>\n",
        page);
  for (int s = 0; s < CW_STAGES; s++) {
    if (!data->record[s]) {
      fprintf(page, "<tr><td>%s</td><td class=\"n\">not run</td><td></td><td></td></tr>\n", cw_report_stage[s]);
      continue;
    }
    double seconds = cw_json_real(data->record[s], "seconds");
    sum += seconds;
    fprintf(page, "<tr><td>%s</td><td class=\"n\">%s</td>", cw_report_stage[s], cw_format_seconds(seconds, text));
    fprintf(page, "<td class=\"n\">%s</td>", cw_format_bytes(cw_json_real(data->record[s], "peak_memory_bytes"), text));
    fprintf(page, "<td class=\"n\">%zu</td></tr>\n", json_array_size(json_object_get(data->record[s], "warnings")));
  }
  fprintf(page, "<tr class=\"t\"><td>together</td><td class=\"n\">%s</td><td></td><td></td></tr>\n</table>\n",
          cw_format_seconds(sum, text));
  cw_plot_bars(page, &(CwPlot){.axis = "seconds",
                               .category = category,
                               .count = (int)count,
                               .series = series,
                               .series_count = data->record[2] ? 3 : 2,
                               .width = 980,
                               .caption = "<b>Time of each step.</b> Steps that the mesher repeats to meet the asked "
                                          "number of cells are added up."});
done:
  free(step);
  free(category);
  for (int s = 0; s < CW_STAGES; s++) free(value[s]);
  return status;
}

// Returns their number.
static size_t warnings_of(FILE *page, const char *stage, json_t *record) {
  size_t k;
  json_t *warning, *list = json_object_get(record, "warnings");
  json_array_foreach(list, k, warning) {
    fprintf(page, "<div class=\"warn\"><b>%s:</b> ", stage);
    cw_html_text(page, "", json_string_value(warning), "</div>\n");
  }
  return json_array_size(list);
}

CwStatus cw_page_warnings(FILE *page, const CwReportData *data) {
  size_t count = 0;
  for (int s = 0; s < CW_STAGES; s++) count += warnings_of(page, cw_report_stage[s], data->record[s]);
  if (data->is_solved) count += warnings_of(page, "solve", data->solve);
  if (!count) fputs("<div class=\"fine\">No stage had anything to warn of.</div>\n", page);
  return CW_OK;
}
