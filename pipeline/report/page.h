// SPDX-License-Identifier: AGPL-3.0-or-later
// The page: everything that is known of a run, as one HTML file that refers to nothing outside itself.
#pragma once

#include <stdio.h>

#include "pipeline/report/report_data.h"

CwStatus cw_page_write(FILE *page, const CwReportData *data);
