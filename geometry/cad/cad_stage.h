// SPDX-License-Identifier: AGPL-3.0-or-later
// The geometry stage of a pump from CAD files: from the case to RUN/geometry, with the same files as a designed pump
// but for design.json and its pictures; and faces_sheet.csv.
#pragma once

#include "pipeline/case.h"
#include "pipeline/record.h"
#include "pipeline/stage_args.h"

#ifdef __cplusplus
extern "C" {
#endif

// Writes all files but record.json, which is the caller's. Where the rules of the case fail, faces_sheet.csv is there.
CwStatus cw_cad_stage(const CwStageArgs *args, const CwCase *table, CwRecord *record);

#ifdef __cplusplus
}
#endif
