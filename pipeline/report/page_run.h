// SPDX-License-Identifier: AGPL-3.0-or-later
// Parts of the page on the run: what was exported, times and memory, warnings. Each writes what stands under its
// heading.
#ifndef CUTWATER_PIPELINE_REPORT_PAGE_RUN_H
#define CUTWATER_PIPELINE_REPORT_PAGE_RUN_H

#include <stdio.h>

#include "pipeline/report/report_data.h"

CwStatus cw_page_export(FILE *page, const CwReportData *data);
CwStatus cw_page_times(FILE *page, const CwReportData *data);
CwStatus cw_page_warnings(FILE *page, const CwReportData *data);

#endif
