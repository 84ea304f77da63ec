// SPDX-License-Identifier: AGPL-3.0-or-later
// The steps that run as tasks, each of one domain.
#pragma once

#include "mesher/run/run_state.h"

// A task of one domain.
typedef struct {
  int32_t domain, index;
  double cost;
} CwMeshTask;

// The steps that run as tasks; each a CwTask body over run->domain[task.domain].
typedef CwStatus (*CwMeshStep)(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size);
CwStatus cw_step_background(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size);
CwStatus cw_step_seed(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size);
CwStatus cw_step_size(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size);
CwStatus cw_step_wall(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size);
// An open patch, or after all faces an interface polygon.
CwStatus cw_step_interface(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size);
CwStatus cw_step_rule(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size);
// Makes the region, or takes it up from its file where an earlier run left it whole; the summary tells of a damaged
// file, and of a region whose layers have to become thinner. A periodic image is made of its first. CW_ERR_FAULT where
// a region that was made fails its audit.
CwStatus cw_step_region(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size);

// How many regions a region stands for: itself and its periodic images.
int32_t cw_region_copies(const CwDomain *domain, int32_t region);
