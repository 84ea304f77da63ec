// SPDX-License-Identifier: AGPL-3.0-or-later
// The characteristic curve: what solve/record.json tells of each operating point (pipeline/solve/solve.py), beside the
// design's prediction.
#ifndef CUTWATER_PIPELINE_REPORT_PAGE_CURVE_H
#define CUTWATER_PIPELINE_REPORT_PAGE_CURVE_H

#include <stdio.h>

#include "pipeline/report/report_data.h"

// The part of the solved flow that shows the characteristic curve, the array 'curve' of the results in file `where`;
// nothing for less than two points. CW_ERR_INPUT.
CwStatus cw_page_curve(FILE *page, const CwReportData *data, const char *where, json_t *points);

#endif
