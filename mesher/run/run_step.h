// SPDX-License-Identifier: AGPL-3.0-or-later
// One step of the mesher over all ranks: its tasks, their results, and what the record keeps of them.
#ifndef CUTWATER_MESHER_RUN_RUN_STEP_H
#define CUTWATER_MESHER_RUN_RUN_STEP_H

#include "mesher/run/mesh_steps.h"

// Arrays of results of all domains, freed with their contents.
typedef struct {
  int32_t count[CW_DOMAINS_MOST];
  void **bytes[CW_DOMAINS_MOST];
} CwResults;

CwStatus cw_results_make(CwResults *results, int domains, const int32_t *count);
void cw_results_free(CwResults *results);

// Runs a step over tasks of all domains; collective. Results: bytes[d][i] for task index i of domain d; seconds[d][i]
// likewise where seconds is given. after: as in CwSchedule.
CwStatus cw_run_step(CwMeshRun *run, const char *name, const char *unit, CwMeshStep body, int32_t count,
                     const CwMeshTask *task, const int32_t *after, void ***bytes, double **seconds);

// CAD faces of each domain.
void cw_face_counts(const CwMeshRun *run, int32_t count[CW_DOMAINS_MOST]);

// One task for each wall face of all domains, or for each of the others; of periodic images the first alone. Their
// costs: predicted triangles. Caller frees.
CwStatus cw_face_tasks(const CwMeshRun *run, int walls, int32_t *count, CwMeshTask **tasks);

#endif
