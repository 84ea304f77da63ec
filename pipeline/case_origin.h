// SPDX-License-Identifier: AGPL-3.0-or-later
// Of which case the files of a stage were made. Every stage keeps in its record the keys that the pump follows from;
// the next ones refuse a folder of another pump. Keys that only mesh and solver follow from may change in between.
#pragma once

#include <jansson.h>

#include "pipeline/case.h"
#include "pipeline/status.h"

// The case's name and every key that the design and its solids follow from, by path ("impeller.blade_count"), values in
// the units of the keys; keys that were left out are not there. A new reference; NULL where memory is out.
json_t *cw_case_origin(const CwCase *table);

// Holds RUN/STAGE/record.json against the case. CW_ERR_IO where the record is not there (the stage has not run, or did
// not end well), CW_ERR_INPUT with the first key that differs where the stage ran for another case.
CwStatus cw_case_origin_check(const CwCase *table, const char *run, const char *stage);
