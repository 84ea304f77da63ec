// SPDX-License-Identifier: AGPL-3.0-or-later
// One value of the case file: from its text to a number in the unit of its key, and the words for what is
// wrong.
#pragma once

#include "pipeline/case_schema.h"

enum { CW_SHOWN_SIZE = 64, CW_WRONG_SIZE = 400 };

// Copies `text` for a message: control characters as blanks, cut at 48 bytes between characters, "" as
// (nothing).
void cw_show(const char *text, char shown[CW_SHOWN_SIZE]);

// Reads a finite decimal number that fills the whole text. Returns NULL, or what is wrong in a few words. Hexadecimal
// and octal numbers, infinities, nan, a decimal comma, a leading zero and anything behind the number are wrong.
const char *cw_number_text_read(const char *text, double *number);

// Reads a count as people write it: 500000, 500k, 2M, 1.5M, 2G. Returns NULL, or what is wrong: it must be whole and
// not negative.
const char *cw_count_text_read(const char *text, double *count);

// Reads `text` (plain: without quotes in the file), in `unit` (of cw_case_key_find_in()), into the key's field; of
// several choices it is added to those that are there. On failure writes "VALUE is wrong; allowed: ..." to `wrong` and
// returns 0; else returns 1.
int cw_case_value_read(const CwCaseKey *key, const CwUnit *unit, const char *text, int plain, CwCase *table,
                       char wrong[CW_WRONG_SIZE]);

// Writes what is wrong with `name`, which is no key of `section` ("" for the top of the file), to `wrong`: a
// key with another unit, a key of another section, or the nearest key. `text` is its value, or NULL when it
// is no scalar.
void cw_case_key_unknown(const char *section, const char *name, const char *text, char wrong[CW_WRONG_SIZE]);
