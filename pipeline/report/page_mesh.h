// SPDX-License-Identifier: AGPL-3.0-or-later
// Parts of the page on the mesh. Each writes what stands under its heading.
#ifndef CUTWATER_PIPELINE_REPORT_PAGE_MESH_H
#define CUTWATER_PIPELINE_REPORT_PAGE_MESH_H

#include <stdio.h>

#include "pipeline/report/report_data.h"

CwStatus cw_page_counts(FILE *page, const CwReportData *data);
CwStatus cw_page_regions(FILE *page, const CwReportData *data);
CwStatus cw_page_quality(FILE *page, const CwReportData *data);
CwStatus cw_page_layers(FILE *page, const CwReportData *data);

#endif
