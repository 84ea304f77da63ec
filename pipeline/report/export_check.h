// SPDX-License-Identifier: AGPL-3.0-or-later
// Whether the files of an export are as it has written them, so that what the page tells of them holds. They may be as
// large as the mesh itself: all ranks read their share of them while pictures are drawn.
#pragma once

#include <jansson.h>

#include "pipeline/parallel/ranks.h"
#include "pipeline/status.h"

typedef struct CwExportCheck CwExportCheck;

// Begins to read what the record of RUN/export tells of. `run`, `record` and `ranks` last until the end. CW_ERR_INPUT
// where it was made from another mesh than lies there, CW_ERR_MEMORY, CW_ERR_LIBRARY where there is no thread; what is
// wrong with the files is told at the end.
CwStatus cw_export_check_begin(const char *run, json_t *record, const CwRanks *ranks, CwExportCheck **check);
// Waits for it. CW_ERR_IO, CW_ERR_INPUT as cw_stage_files_check(), on all ranks alike. Collective.
CwStatus cw_export_check_end(CwExportCheck *check);
// Without an end too; NULL is fine.
void cw_export_check_free(CwExportCheck **check);
