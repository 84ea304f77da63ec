// SPDX-License-Identifier: AGPL-3.0-or-later
// Reads the case file. Every stage reads and validates it once, against the one schema in case_schema.c.
#pragma once

#include "pipeline/case.h"

#ifdef __cplusplus
extern "C" {
#endif

// Reads and validates `path`, a YAML file of at most 1 MiB. A file that cannot be read fails with CW_ERR_IO,
// bad input with CW_ERR_INPUT and "FILE:LINE:COLUMN: KEY: what is wrong with VALUE; allowed: ...". Then
// *table stays as it was.
CwStatus cw_case_read(const char *path, CwCase *table);
// Frees what a case with solids from CAD files holds; one without holds nothing.
void cw_case_free(CwCase *table);

#ifdef __cplusplus
}
#endif
