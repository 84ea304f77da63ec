// SPDX-License-Identifier: AGPL-3.0-or-later
// Parts of the page on the design: the table, what follows from it, and its drawings. Each writes what stands under
// its heading.
#ifndef CUTWATER_PIPELINE_REPORT_PAGE_DESIGN_H
#define CUTWATER_PIPELINE_REPORT_PAGE_DESIGN_H

#include <stdio.h>

#include "pipeline/report/report_data.h"

CwStatus cw_page_input(FILE *page, const CwReportData *data);
CwStatus cw_page_design(FILE *page, const CwReportData *data);
CwStatus cw_page_design_pictures(FILE *page, const CwReportData *data);

#endif
