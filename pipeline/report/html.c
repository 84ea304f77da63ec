// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/html.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "pipeline/file_digest.h"

// A character of a text, not its end.
static void escaped(FILE *page, char c) {
  static const char signs[] = "&<>\"'";
  static const char *const escapes[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
  const char *sign = strchr(signs, c);
  if (sign)
    fputs(escapes[sign - signs], page);
  else
    fputc(c, page);
}

void cw_html_text(FILE *page, const char *before, const char *text, const char *after) {
  fputs(before, page);
  for (; text && *text; text++) escaped(page, *text);
  fputs(after, page);
}

static void label(FILE *page, const char *key) {
  const char *c = key;
  if (!strncmp(key, "y_plus", 6)) {
    fputs("y<sup>+</sup>", page);
    c += 6;
  }
  // Names and abbreviations, which keys have in small letters.
  static const char *const words[] = {"NPSH", "Wiesner", "Pfleiderer", "Guelich", "CGNS", "OpenFOAM", "CFX"};
  for (; *c; c++) {
    int starts = c == key || c[-1] == '_';
    for (size_t k = 0; starts && k < sizeof words / sizeof *words; k++) {
      size_t length = strlen(words[k]);
      if (strncasecmp(c, words[k], length) || (c[length] && c[length] != '_')) continue;
      fputs(!strcmp(words[k], "Guelich") ? "G&uuml;lich" : words[k], page);
      c += length;
      break;
    }
    if (!*c) break;
    escaped(page, *c == '_' ? ' ' : c == key ? (char)toupper((unsigned char)*c) : *c);
  }
}

void cw_html_label(FILE *page, const char *before, const char *key, const char *after) {
  fputs(before, page);
  if (key) label(page, key);
  fputs(after, page);
}

void cw_html_base64(FILE *page, const unsigned char *bytes, size_t size) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (size_t i = 0; i < size; i += 3) {
    unsigned long three = (unsigned long)bytes[i] << 16;
    if (i + 1 < size) three |= (unsigned long)bytes[i + 1] << 8;
    if (i + 2 < size) three |= bytes[i + 2];
    fputc(digits[three >> 18], page);
    fputc(digits[(three >> 12) & 63], page);
    fputc(i + 1 < size ? digits[(three >> 6) & 63] : '=', page);
    fputc(i + 2 < size ? digits[three & 63] : '=', page);
  }
}

void cw_html_number_cell(FILE *page, const char *number) {
  const char *point = strchr(number, '.');
  int whole = point ? (int)(point - number) : (int)strlen(number);
  fprintf(page, "<td class=\"n\">%.*s<span>%s</span></td>", whole, number, point ? point : "");
}

CwStatus cw_html_svg_file(FILE *page, const char *path) {
  CwStatus status = CW_OK;
  char *text = NULL;
  size_t size;
  CW_TRY(cw_file_text(path, &text, &size));
  const char *start = strstr(text, "<svg"), *end = start ? strstr(start, "</svg>") : NULL;
  CW_REQUIRE(start && end, CW_ERR_INPUT, "%s: not a whole SVG picture", path);
  CW_REQUIRE(!strstr(start, "<script") && !strstr(start, "href=") && !strstr(start, "url("), CW_ERR_INPUT,
             "%s: holds scripts or references; a picture must stand alone", path);
  fwrite(start, 1, (size_t)(end - start) + strlen("</svg>"), page);
  fputc('\n', page);
done:
  free(text);
  return status;
}
