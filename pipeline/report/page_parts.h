// SPDX-License-Identifier: AGPL-3.0-or-later
// The parts of the page: each writes what stands under its heading.
#pragma once

#include <stdio.h>

#include "pipeline/report/report_data.h"

// The picture that turns: <figure id="view"> with its controls, its data and its script. Nothing for a view without
// parts.
CwStatus cw_page_view(FILE *page, const CwReportData *data);

// The design: the table, what follows from it, and its drawings.
CwStatus cw_page_input(FILE *page, const CwReportData *data);
CwStatus cw_page_design(FILE *page, const CwReportData *data);
CwStatus cw_page_design_pictures(FILE *page, const CwReportData *data);

// The mesh.
CwStatus cw_page_counts(FILE *page, const CwReportData *data);
CwStatus cw_page_regions(FILE *page, const CwReportData *data);
CwStatus cw_page_quality(FILE *page, const CwReportData *data);
CwStatus cw_page_layers(FILE *page, const CwReportData *data);

// The run: what was exported, the solved flow, times and memory, warnings.
CwStatus cw_page_export(FILE *page, const CwReportData *data);
CwStatus cw_page_solve(FILE *page, const CwReportData *data);
CwStatus cw_page_times(FILE *page, const CwReportData *data);
CwStatus cw_page_warnings(FILE *page, const CwReportData *data);

// Of the solved flow: the characteristic curve, the array 'curve' of the results in file `where`, beside the design's
// prediction; nothing for less than two points. CW_ERR_INPUT.
CwStatus cw_page_curve(FILE *page, const CwReportData *data, const char *where, json_t *points);

// Of any part: the pictures of a section that the pump has, two in a row, with captions and legends.
void cw_page_picture_list(FILE *page, const CwReportData *data, CwPictureSection section);
