// SPDX-License-Identifier: AGPL-3.0-or-later
// What no key can tell alone: values of a whole case that contradict each other.
#pragma once

#include "pipeline/case_schema.h"

// Where the file gives a key, 1-based. A key left out has `given` 0 and the place of its section.
typedef struct {
  int given;
  int line, column; // of the value
} CwCasePlace;

// Checks the whole table; `places` holds one place a key of the schema, in its order. Fails with CW_ERR_INPUT
// and "FILE:LINE:COLUMN: KEY: VALUE contradicts ...; allowed: ..." at the first contradiction.
CwStatus cw_case_check(const char *path, const CwCase *table, const CwCasePlace *places);

// Checks openfoam.processors against the number of cells, which the command line may change after the case is read.
// CW_ERR_INPUT, naming `path`, where parts would have fewer than two cells.
CwStatus cw_case_check_parts(const char *path, const CwCase *table);
