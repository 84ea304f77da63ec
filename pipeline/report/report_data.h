// SPDX-License-Identifier: AGPL-3.0-or-later
// All that is known of a run: what its stages wrote, and the pictures.
#pragma once

#include <jansson.h>

#include "pipeline/case.h"
#include "pipeline/report/pictures.h"

enum { CW_STAGES = 3 };

// All that the page is made of.
typedef struct {
  const CwCase *table;
  char *run;
  json_t *design;            // geometry/design.json; NULL: no generator made the pump
  json_t *record[CW_STAGES]; // geometry, mesh, export, each with its results; the last may be NULL
  json_t *solve;             // solve/record.json with its results, or NULL
  int is_solved;             // whether that flow is of the files of this export
  CwMesh mesh;
  CwReportPictures pictures;
  CwView view;
  CwFlow flow;
} CwReportData;

enum { CW_STAGE_OF_EXPORT = 2 };
extern const char *const cw_report_stage[CW_STAGES]; // names of the folders

// Reads the files of `run` (all but the region files and those of the export) and checks that they are of this case.
// CW_ERR_IO, CW_ERR_INPUT. Free with cw_report_data_free, also after a failure.
CwStatus cw_report_data_read(const char *run, const CwCase *table, CwReportData *data);
void cw_report_data_free(CwReportData *data);

// -1 or 1: the sign of z on the suction side, by the geometry's record where it says so, else by the rotation.
int cw_report_suction(const CwReportData *data);

// What the pictures need of case and design. CW_ERR_INPUT.
CwStatus cw_report_sizes(const CwReportData *data, CwPumpSizes *sizes);

// What the results of the mesh record have of each domain of the mesh [out]. CW_ERR_INPUT where they are of others.
CwStatus cw_report_mesh_domains(const CwReportData *data, json_t *domain[CW_DOMAINS_MOST]);
