// SPDX-License-Identifier: AGPL-3.0-or-later
// The page: everything that is known of a run, as one HTML file that refers to nothing outside itself.
#ifndef CUTWATER_PIPELINE_REPORT_PAGE_H
#define CUTWATER_PIPELINE_REPORT_PAGE_H

#include <jansson.h>
#include <stdio.h>

#include "pipeline/case.h"
#include "pipeline/report/pictures.h"

enum { CW_STAGES = 3 };

// All that the page is made of.
typedef struct {
  const CwCase *table;
  char *run;
  json_t *design;            // geometry/design.json
  json_t *record[CW_STAGES]; // geometry, mesh, export; the last may be NULL
  json_t *solve;             // solve/record.json, or NULL
  CwMesh mesh;
  CwReportPictures pictures;
} CwReportData;

extern const char *const cw_report_stage[CW_STAGES]; // names of the folders

// Reads the files of `run` (all but the region files) and checks that they are of this case. CW_ERR_IO,
// CW_ERR_INPUT. Free with cw_report_data_free, also after a failure.
CwStatus cw_report_data_read(const char *run, const CwCase *table, CwReportData *data);
void cw_report_data_free(CwReportData *data);

// What the pictures need of case and design. CW_ERR_INPUT.
CwStatus cw_report_sizes(const CwReportData *data, CwPumpSizes *sizes);

CwStatus cw_page_write(FILE *page, const CwReportData *data);

// Its parts after the title, in the order of the page. Each begins with its heading.
CwStatus cw_page_input(FILE *page, const CwReportData *data);
CwStatus cw_page_design(FILE *page, const CwReportData *data);
CwStatus cw_page_design_pictures(FILE *page, const CwReportData *data);
CwStatus cw_page_counts(FILE *page, const CwReportData *data);
CwStatus cw_page_regions(FILE *page, const CwReportData *data);
CwStatus cw_page_quality(FILE *page, const CwReportData *data);
CwStatus cw_page_layers(FILE *page, const CwReportData *data);
CwStatus cw_page_export(FILE *page, const CwReportData *data);
CwStatus cw_page_solve(FILE *page, const CwReportData *data);

// The part of the solved flow that shows the characteristic curve, the array 'curve' of the results in file `where`;
// nothing for less than two points. CW_ERR_INPUT.
CwStatus cw_page_curve(FILE *page, const CwReportData *data, const char *where, json_t *points);
CwStatus cw_page_times(FILE *page, const CwReportData *data);
CwStatus cw_page_warnings(FILE *page, const CwReportData *data);

// Shared by the parts.
void cw_page_picture_list(FILE *page, const CwReportData *data, CwPictureSection section);
// "results" of the mesh record, and its entry of domain `d` after a check of its name.
CwStatus cw_page_mesh_results(const CwReportData *data, json_t **results);
CwStatus cw_page_mesh_domain(const CwReportData *data, int d, json_t **domain);

#endif
