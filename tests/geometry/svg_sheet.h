// SPDX-License-Identifier: AGPL-3.0-or-later
// A picture of the geometry stage as its reader sees it: lines, arrow heads, circles and texts of an SVG file, px, in
// their order. In a program with a test folder (tests/test_folder.h).
#pragma once

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "geometry/design.h"
#include "pipeline/status.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

// What picture.c calls wall, blade, thin or axis, and flow.
#define SVG_WALL "#1f2933"
#define SVG_BLADE "#0b5c8a"
#define SVG_THIN "#7b8794"
#define SVG_FLOW "#b8450c"

typedef enum { SVG_LINE, SVG_CHAIN, SVG_AREA, SVG_HEAD, SVG_CIRCLE, SVG_TEXT } SvgKind; // a chain line is an axis

typedef struct {
  SvgKind kind;
  char colour[8];
  int count;      // of points; of a circle and a text 1, of an arrow's head 3, the first its tip
  double (*x)[2]; // y down
  double radius;  // of a circle
  char align;     // of a text at its point: 's'tarts, 'm'iddle, 'e'nds
  char text[200]; // as written, with entities
} SvgItem;

typedef struct {
  double width, height;
  int count;
  SvgItem *item;
} SvgSheet;

static inline double svg_number(const char *line, const char *key) {
  const char *at = strstr(line, key);
  if (!at) fail_msg("no %s in %s", key, line);
  return atof(at + strlen(key));
}

static inline void svg_points(const char *list, SvgItem *item) {
  int used;
  double x, y;
  item->x = calloc(strlen(list), sizeof *item->x);
  assert_non_null(item->x);
  for (; sscanf(list, "%lf,%lf%n", &x, &y, &used) == 2; list += used, item->count++)
    item->x[item->count][0] = x, item->x[item->count][1] = y;
}

static inline SvgItem svg_item(const char *line) {
  SvgItem item = {.kind = SVG_TEXT};
  const char *points = strstr(line, "points=\""), *colour = strstr(line, "stroke=\"");
  if (!colour) colour = strstr(line, "fill=\"");
  assert_non_null(colour);
  snprintf(item.colour, sizeof item.colour, "%s", strchr(colour, '"') + 1);
  if (points) {
    svg_points(points + strlen("points=\""), &item);
    item.kind = !strncmp(line, "<polyline", 9) ? SVG_LINE : strstr(line, "fill=\"#d6e8f2\"") ? SVG_AREA : SVG_HEAD;
    if (item.kind == SVG_LINE && strstr(line, "stroke-dasharray")) item.kind = SVG_CHAIN;
    return item;
  }
  const int circle = !strncmp(line, "<circle", 7);
  item.x = calloc(1, sizeof *item.x);
  assert_non_null(item.x);
  item.count = 1;
  item.x[0][0] = svg_number(line, circle ? "cx=\"" : "x=\"");
  item.x[0][1] = svg_number(line, circle ? "cy=\"" : "y=\"");
  if (circle) {
    item.kind = SVG_CIRCLE;
    item.radius = svg_number(line, " r=\"");
    return item;
  }
  const char *begin = strchr(line, '>') + 1;
  item.align = strstr(line, "text-anchor=\"")[strlen("text-anchor=\"")];
  snprintf(item.text, sizeof item.text, "%.*s", (int)strcspn(begin, "<"), begin);
  return item;
}

// Widths of the signs from ' ' to '~' in Helvetica, thousandths of its size (Adobe's font metrics).
static inline double svg_text_width(const char *text) {
  static const short width[] = {278,  278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278,
                                556,  556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556,
                                1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778,
                                667,  778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556,
                                333,  556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556,
                                556,  556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584};
  const double size = 13;
  double sum = 0;
  for (const unsigned char *c = (const unsigned char *)text; *c; c++)
    if (*c >= ' ' && *c <= '~') sum += width[*c - ' '] * 1e-3 * size;
  return sum;
}

// Left, right, top and bottom of a text.
static inline void svg_text_box(const SvgItem *item, double box[4]) {
  const double wide = svg_text_width(item->text), share = item->align == 's' ? 0 : item->align == 'm' ? 0.5 : 1;
  box[0] = item->x[0][0] - share * wide;
  box[1] = box[0] + wide;
  box[2] = item->x[0][1] - 10;
  box[3] = item->x[0][1] + 3;
}

// Nothing lies outside of the sheet, and no text on another.
static inline void svg_check(const SvgSheet *sheet) {
  for (int i = 0; i < sheet->count; i++) {
    const SvgItem *item = &sheet->item[i];
    for (int k = 0; k < item->count; k++) {
      const double *x = item->x[k], r = item->radius;
      if (!(x[0] >= r && x[0] <= sheet->width - r && x[1] >= r && x[1] <= sheet->height - r))
        fail_msg("item %d '%s' leaves the sheet at %g, %g", i, item->text, x[0], x[1]);
    }
    if (item->kind != SVG_TEXT) continue;
    double a[4], b[4];
    svg_text_box(item, a);
    if (!(a[0] >= 0 && a[1] <= sheet->width && a[2] >= 0 && a[3] <= sheet->height))
      fail_msg("'%s' leaves the sheet of %g px: %g to %g", item->text, sheet->width, a[0], a[1]);
    for (int k = 0; k < i; k++) {
      if (sheet->item[k].kind != SVG_TEXT) continue;
      svg_text_box(&sheet->item[k], b);
      if (fmin(a[1], b[1]) > fmax(a[0], b[0]) && fmin(a[3], b[3]) > fmax(a[2], b[2]))
        fail_msg("'%s' stands on '%s'", item->text, sheet->item[k].text);
    }
  }
}

// Draws and reads; to be freed.
static inline SvgSheet svg_drawn(CwStatus (*draw)(const CwDesign *, const char *), const CwDesign *design) {
  const char *path = in_test_folder("picture.svg");
  if (draw(design, path) != CW_OK) fail_msg("%s", cw_fail_message());
  char *text = read_whole(path, NULL), *rest = NULL;
  SvgSheet sheet = {0};
  unlink(path);
  assert_int_equal(sscanf(strstr(text, "viewBox"), "viewBox=\"0 0 %lf %lf", &sheet.width, &sheet.height), 2);
  assert_null(strstr(text, "nan"));
  assert_null(strstr(text, "inf"));
  sheet.item = calloc(strlen(text) / 20, sizeof *sheet.item);
  assert_non_null(sheet.item);
  for (char *line = strtok_r(text, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest))
    if (strncmp(line, "<svg", 4) && strncmp(line, "<rect", 5) && strncmp(line, "</svg", 5))
      sheet.item[sheet.count++] = svg_item(line);
  free(text);
  svg_check(&sheet);
  return sheet;
}

static inline void svg_free(SvgSheet *sheet) {
  for (int i = 0; i < sheet->count; i++) free(sheet->item[i].x);
  free(sheet->item);
}

// How many of a kind and a colour there are; NULL: any.
static inline int svg_count(const SvgSheet *sheet, SvgKind kind, const char *colour) {
  int count = 0;
  for (int i = 0; i < sheet->count; i++)
    count += sheet->item[i].kind == kind && (!colour || !strcmp(sheet->item[i].colour, colour));
  return count;
}

// The n-th of them, from 0.
static inline const SvgItem *svg_nth(const SvgSheet *sheet, SvgKind kind, const char *colour, int n) {
  for (int i = 0; i < sheet->count; i++)
    if (sheet->item[i].kind == kind && (!colour || !strcmp(sheet->item[i].colour, colour)) && n-- == 0)
      return &sheet->item[i];
  fail_msg("there are fewer lines of the kind %d", kind);
  return NULL;
}

// The one text that is this, printf style.
static inline const SvgItem *svg_text(const SvgSheet *sheet, const char *format, ...) {
  const SvgItem *found = NULL;
  char wanted[200];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(wanted, sizeof wanted, format, arguments);
  va_end(arguments);
  for (int i = 0; i < sheet->count; i++) {
    if (sheet->item[i].kind != SVG_TEXT || strcmp(sheet->item[i].text, wanted)) continue;
    if (found) fail_msg("'%s' stands twice", wanted);
    found = &sheet->item[i];
  }
  if (!found) fail_msg("no text '%s'", wanted);
  return found;
}

// Whether any text holds these words.
static inline int svg_says(const SvgSheet *sheet, const char *words) {
  int found = 0;
  for (int i = 0; i < sheet->count; i++) found |= sheet->item[i].kind == SVG_TEXT && strstr(sheet->item[i].text, words);
  return found;
}

static inline double svg_distance(const double a[2], const double b[2]) {
  return hypot(b[0] - a[0], b[1] - a[1]);
}

// px per m: of the scale bar, the first of three lines before its length.
static inline double svg_scale(const SvgSheet *sheet) {
  for (int i = 3; i < sheet->count; i++) {
    int used = 0;
    double mm;
    const SvgItem *item = &sheet->item[i];
    if (item->kind != SVG_TEXT || sscanf(item->text, "%lf mm%n", &mm, &used) != 1 || item->text[used] || !used)
      continue;
    return svg_distance(item[-3].x[0], item[-3].x[1]) / (mm * 1e-3);
  }
  fail_msg("no scale bar");
  return 0;
}
