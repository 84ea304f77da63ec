// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/stage_view.h"

#include <stdio.h>
#include <string.h>

#include "mesher/network/network_audit.h"
#include "mesher/plan/plan_audit.h"
#include "mesher/size/size_audit.h"
#include "pipeline/log.h"

static const char *const NAMES[CW_STAGE_COUNT] = {"",        "size",   "decomposition", "curves",
                                                  "surface", "layers", "interfaces"};

CwStatus cw_stage_of(const char *name, CwStage *stage) {
  CwStatus status = CW_OK;
  *stage = CW_STAGE_NONE;
  for (int s = CW_STAGE_NONE + 1; s < CW_STAGE_COUNT; s++) {
    if (!strcmp(name, NAMES[s])) *stage = (CwStage)s;
  }
  CW_REQUIRE(*stage != CW_STAGE_NONE, CW_ERR_USAGE,
             "--stop-after: %s is no stage; allowed: size, decomposition, curves, surface, layers, interfaces", name);
done:
  return status;
}

static CwStatus write_product(const CwMeshRun *run, int d, CwStage stage) {
  CwStatus status = CW_OK;
  const CwDomain *domain = &run->domain[d];
  char path[4096];
  snprintf(path, sizeof path, "%s/mesh/%s-%s.vtk", run->run_path, run->domain[d].name, NAMES[stage]);
  if (stage == CW_STAGE_SIZE) CW_TRY(cw_size_vtk(domain->size, &domain->background, path));
  if (stage == CW_STAGE_DECOMPOSITION) CW_TRY(cw_plan_vtk(&domain->plan, &domain->background, path));
  if (stage == CW_STAGE_CURVES) CW_TRY(cw_network_vtk(&domain->network, path));
  if (stage == CW_STAGE_SURFACE) CW_TRY(cw_surface_mesh_vtk(&domain->surface, path));
  if (stage == CW_STAGE_LAYERS) CW_TRY(cw_layers_vtk(&domain->layers, domain->surface.region, path));
  if (stage == CW_STAGE_INTERFACES) CW_TRY(cw_interfaces_vtk(&domain->interfaces, path));
  cw_log(run->context.log, "%s: written", path);
done:
  return status;
}

CwStatus cw_stage_view(CwMeshRun *run, CwStage stage) {
  CwStatus status = CW_OK;
  if (run->stop_after != stage) goto done;
  run->stopped = 1;
  for (int d = 0; run->vtk && run->rank == 0 && d < run->model.domain_count; d++) CW_TRY(write_product(run, d, stage));
  cw_log(run->context.log, "ended after the stage %s, as asked; there is no mesh", NAMES[stage]);
done:
  return status;
}
