// SPDX-License-Identifier: AGPL-3.0-or-later
// The part of the page on the solved flow: what stands under its heading.
#ifndef CUTWATER_PIPELINE_REPORT_PAGE_SOLVE_H
#define CUTWATER_PIPELINE_REPORT_PAGE_SOLVE_H

#include <stdio.h>

#include "pipeline/report/report_data.h"

CwStatus cw_page_solve(FILE *page, const CwReportData *data);

#endif
