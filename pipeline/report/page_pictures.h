// SPDX-License-Identifier: AGPL-3.0-or-later
// The pictures of a section on the page.
#ifndef CUTWATER_PIPELINE_REPORT_PAGE_PICTURES_H
#define CUTWATER_PIPELINE_REPORT_PAGE_PICTURES_H

#include <stdio.h>

#include "pipeline/report/report_data.h"

// Those that the pump has, two in a row, with captions and legends.
void cw_page_picture_list(FILE *page, const CwReportData *data, CwPictureSection section);

#endif
