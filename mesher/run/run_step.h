// SPDX-License-Identifier: AGPL-3.0-or-later
// One step of the mesher over all ranks: its tasks, their results, and what the record keeps of them.
#pragma once

#include "mesher/parallel/groups.h"
#include "mesher/run/mesh_steps.h"

// Arrays of results of all domains, freed with their contents.
typedef struct {
  int32_t count[CW_DOMAINS_MOST];
  void **bytes[CW_DOMAINS_MOST];
  int shared;                        // 1: they may lie once on each host: nobody takes one over where `memory` is set
  int (*in_vain)(const void *bytes); // as in CwSchedule
  CwHostMemory *memory;              // where they do; NULL: each has its own
} CwResults;

CwStatus cw_results_make(CwResults *results, int domains, const int32_t *count);
void cw_results_free(CwResults *results);
// The same, but for where they lie on each host: the caller's, who goes on reading them. NULL: each had its own.
CwHostMemory *cw_results_keep(CwResults *results);

// Every rank finds sizes, planes and curves for itself, with mathematical libraries that round differently from one
// kind of processor to another. Collective; CW_ERR_LIBRARY where they, or the `size` bytes of `also`, are not the same
// on all ranks.
CwStatus cw_run_alike(const CwMeshRun *run, const void *also, size_t size);

// Runs a step over tasks of all domains, which are alike on all ranks; collective. results->bytes[d][i] for task index
// i of domain d; seconds[d][i] likewise where seconds is given. after: as in CwSchedule.
CwStatus cw_run_step(CwMeshRun *run, const char *name, const char *unit, CwMeshStep body, int32_t count,
                     const CwMeshTask *task, const int32_t *after, CwResults *results, double **seconds);

typedef struct CwDomainWork CwDomainWork;

// What work on the walls of a domain is given: results of a step that it merges, NULL: none.
typedef struct {
  CwMeshRun *run;
  const CwResults *results;
  const CwDomainWork *of;
} CwMerging;

// Work on the walls of all domains side by side, whose products come to lie once on each host.
struct CwDomainWork {
  const char *step; // in the profiler
  double own;       // of the work, what no thread takes from another
  double copied;    // of that on a wall triangle, what one takes that is a periodic image
  // As those of CwGroupWork; given: a CwMerging.
  CwStatus (*work)(void *given, const CwContext *context, int32_t domain, CwOutcome *outcome);
  CwStatus (*hand)(void *given, const CwGroupHand *hand);
};

// outcome: of each domain. Collective.
CwStatus cw_run_domains(CwMeshRun *run, const CwDomainWork *of, const CwResults *results,
                        CwOutcome outcome[CW_DOMAINS_MOST]);

// CAD faces of each domain.
void cw_face_counts(const CwMeshRun *run, int32_t count[CW_DOMAINS_MOST]);

// One task for each wall face of all domains, or for each of the others; of periodic images the first alone. Their
// costs: predicted triangles. Caller frees.
CwStatus cw_face_tasks(const CwMeshRun *run, int walls, int32_t *count, CwMeshTask **tasks);
