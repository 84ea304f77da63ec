// SPDX-License-Identifier: AGPL-3.0-or-later
// Small pieces of an HTML page. Errors of the stream are found when the file is committed.
#pragma once

#include <stddef.h>
#include <stdio.h>

#include "pipeline/status.h"

// Writes text (NULL: none) with & < > " ' escaped, between two pieces of HTML.
void cw_html_text(FILE *page, const char *before, const char *text, const char *after);
// The same of a key: underscores become blanks, the first letter a capital, y_plus the sign for it.
void cw_html_label(FILE *page, const char *before, const char *key, const char *after);
void cw_html_base64(FILE *page, const unsigned char *bytes, size_t size);

// A right-aligned table cell with the decimal points of a column in line.
void cw_html_number_cell(FILE *page, const char *number);

// Writes the <svg> element of a file, without what stands before it. CW_ERR_INPUT where there is none, or it
// is not whole, or holds scripts or references.
CwStatus cw_html_svg_file(FILE *page, const char *path);
