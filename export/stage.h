// SPDX-License-Identifier: AGPL-3.0-or-later
// The export stage: a meshed run in, RUN/export with record.json and what export.formats asks out.
#pragma once

#include "pipeline/parallel/ranks.h"
#include "pipeline/case.h"

// Collective. What it writes takes its final name only when all of it is whole; on failure nothing stays
// behind. `reads`: the stages whose files it reads, NULL behind the last.
CwStatus cw_export_run(const CwCase *table, const char *run, const char *const *reads, const CwRanks *ranks);
