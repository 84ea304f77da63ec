// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/flat_places.h"

#include <math.h>

#include "mesher/policy.h"

// What region r of domain d lacks; 0 where it is not flat, or not the first of its images.
static double lacks(const CwMeshRun *run, int d, int32_t r) {
  const CwDomain *domain = &run->domain[d];
  const CwRegionSummary *made = &run->summary[d][r];
  double wanted = fmin(cw_policy.flat_angle, made->dihedral_allowed), least = made->quality.dihedral_least;
  int first = cw_image_region_first(&domain->images, &domain->plan, r) == r;
  return first && least < wanted ? 1 - least / wanted : 0;
}

double cw_flat_deficit(const CwMeshRun *run, int32_t *count) {
  double deficit = 0;
  *count = 0;
  for (int d = 0; d < run->model.domain_count; d++) {
    for (int32_t r = 0; r < run->domain[d].plan.region_count; r++) {
      double of = lacks(run, d, r);
      deficit += of;
      *count += of > 0;
    }
  }
  return deficit;
}

CwStatus cw_finer_at_flat(CwMeshRun *run) {
  CwStatus status = CW_OK;
  for (int d = 0; d < run->model.domain_count; d++) {
    for (int32_t r = 0; r < run->domain[d].plan.region_count; r++) {
      if (lacks(run, d, r) > 0)
        CW_TRY(cw_finer_places_add(&run->domain[d], d, run->summary[d][r].quality.flattest_at, &run->finer));
    }
  }
done:
  return status;
}
