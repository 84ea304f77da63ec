// SPDX-License-Identifier: AGPL-3.0-or-later
// A part of the report's page as text, and the rows of its tables without their tags.
#pragma once

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/report/page_parts.h"
#include "tests/unit_test.h"

typedef CwStatus (*PagePart)(FILE *page, const CwReportData *data);

// What a part writes where it has to end with `wanted`; the caller frees it.
static inline char *page_that(PagePart part, const CwReportData *data, CwStatus wanted) {
  static char *text; // GCC takes what is returned for a pointer to it
  static size_t size;
  FILE *page = open_memstream(&text, &size);
  const CwStatus status = part(page, data);
  fclose(page);
  if (status != wanted) fail_msg("status %d: %s", (int)status, cw_fail_message());
  return text;
}

static inline char *page_of(PagePart part, const CwReportData *data) {
  return page_that(part, data, CW_OK);
}

static inline void assert_page_fails(PagePart part, const CwReportData *data, const char *message) {
  free(page_that(part, data, CW_ERR_INPUT));
  if (!strstr(cw_fail_message(), message)) fail_msg("no '%s' in: %s", message, cw_fail_message());
  cw_fail_clear();
}

static inline void assert_holds(const char *page, const char *words) {
  if (!strstr(page, words)) fail_msg("no '%s' in:\n%s", words, page);
}

static inline int count_in(const char *page, const char *words) {
  int count = 0;
  for (; (page = strstr(page, words)); page++) count++;
  return count;
}

// The next row of a table: the texts of its cells without tags, a bar between two cells. Returns what stands behind it,
// or NULL.
static inline const char *next_row(const char *page, char row[1000]) {
  const char *at = strstr(page, "<tr"), *end = at ? strstr(at, "</tr>") : NULL;
  size_t used = 0;
  int cells = 0;
  if (!end) return NULL;
  while (at < end) {
    assert_true(used < 999);
    if (*at != '<') {
      row[used++] = *at++;
      continue;
    }
    if ((!strncmp(at, "<td", 3) || !strncmp(at, "<th", 3)) && cells++) row[used++] = '|';
    at = strchr(at, '>') + 1;
  }
  row[used] = '\0';
  return end + 1;
}

// That some row has these cells.
static inline void assert_row(const char *page, const char *wanted) {
  char row[1000];
  for (const char *at = page; (at = next_row(at, row));)
    if (!strcmp(row, wanted)) return;
  fail_msg("no row '%s' in:\n%s", wanted, page);
}

// The bars of a colour (x, y, width, height), in their order; not the box of the key.
static inline int bars_of(const char *page, const char *colour, double bar[][4]) {
  int count = 0;
  for (const char *at = page; (at = strstr(at, "<rect ")); at++) {
    char fill[16];
    double b[4];
    if (sscanf(at, "<rect x=\"%lf\" y=\"%lf\" width=\"%lf\" height=\"%lf\" fill=\"%7s", &b[0], &b[1], &b[2], &b[3],
               fill) != 5)
      continue;
    if (!strcmp(fill, colour) && !(b[2] == 12 && b[3] == 12)) memcpy(bar[count++], b, sizeof b);
  }
  return count;
}

// JSON of a test, in which ' stands for ".
static inline json_t *json_of(const char *text) {
  char *quoted = strdup(text);
  json_error_t error;
  for (char *c = quoted; *c; c++)
    if (*c == '\'') *c = '"';
  json_t *json = json_loads(quoted, 0, &error);
  if (!json) fail_msg("%s: %s", error.text, quoted);
  free(quoted);
  return json;
}
