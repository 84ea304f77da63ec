// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/run_thinning.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/log.h"

enum { ATTEMPTS = 3 };
static const double FIRST_REACH = 4; // wanted lengths about a failure in which layers are thinned; doubled each time

// Gives all turned copies of a column the least height of them.
static void thin_alike(const CwSkeleton *skeleton, double *most_height) {
  const CwSkeletonOrbits *orbits = &skeleton->orbits;
  for (int32_t v = 0; orbits->symmetry && v < skeleton->wall_count; v++) {
    if (cw_orbit_node_turns(orbits, v) > 0) continue;
    double least = most_height[v];
    for (int32_t at = cw_orbit_node(orbits, v, 1); at >= 0 && at != v; at = cw_orbit_node(orbits, at, 1)) {
      least = fmin(least, most_height[at]);
    }
    most_height[v] = least;
    for (int32_t at = cw_orbit_node(orbits, v, 1); at >= 0 && at != v; at = cw_orbit_node(orbits, at, 1)) {
      most_height[at] = least;
    }
  }
}

static CwStatus start_thinning(CwMeshRun *run, int d) {
  CwStatus status = CW_OK;
  int32_t count = run->domain[d].skeleton.wall_count;
  if (run->most_height[d]) goto done;
  CW_NEW(run->most_height[d], count);
  for (int32_t v = 0; v < count; v++) run->most_height[d][v] = INFINITY;
done:
  return status;
}

CwStatus cw_thin_tight(CwMeshRun *run, int attempt) {
  CwStatus status = CW_OK;
  for (int d = 0; d < run->domains.count; d++) {
    const CwSkeleton *skeleton = &run->domain[d].skeleton;
    if (skeleton->tight_count == 0) continue;
    double at[3];
    for (int k = 0; k < 3; k++) at[k] = 1e3 * skeleton->tight[0][k];
    CW_REQUIRE(
        attempt < ATTEMPTS, CW_ERR_MESH,
        "%s: near (%.3f, %.3f, %.3f) mm the layers fill a line of two dividing planes or cross it, after %d attempts "
        "with thinner layers",
        run->domain[d].name, at[0], at[1], at[2], ATTEMPTS);
    if (run->rank == 0) {
      cw_log_warn(
          "%s: near (%.3f, %.3f, %.3f) mm the layers fill a line of two dividing planes or cross it; tried again "
          "with thinner layers there",
          run->domain[d].name, at[0], at[1], at[2]);
    }
    CW_TRY(start_thinning(run, d));
    for (int32_t i = 0; i < skeleton->tight_count; i++) {
      CwRegionFailure place = {.failed = 1};
      memcpy(place.at, skeleton->tight[i], sizeof place.at);
      cw_region_failure_thin(skeleton, -1, &place, FIRST_REACH * (double)(1 << attempt), run->most_height[d]);
    }
    thin_alike(skeleton, run->most_height[d]);
  }
  run->retries++;
done:
  return status;
}

CwStatus cw_thin_columns(CwMeshRun *run, int attempt) {
  CwStatus status = CW_OK;
  for (int d = 0; d < run->domains.count; d++) {
    const CwSkeleton *skeleton = &run->domain[d].skeleton;
    for (int32_t r = 0; r < run->domain[d].plan.region_count; r++) {
      const CwRegionFailure *failure = &run->summary[d][r].failure;
      char place[160] = "no place is known";
      if (!failure->failed) continue;
      if (!failure->everywhere) {
        snprintf(place, sizeof place, "at %s, (%.3f, %.3f, %.3f) mm", failure->patch, 1e3 * failure->at[0],
                 1e3 * failure->at[1], 1e3 * failure->at[2]);
      }
      CW_REQUIRE(attempt < ATTEMPTS, CW_ERR_MESH,
                 "%s region %d, %s: not filled after %d attempts with thinner layers: %s; its boundary is in "
                 "%s/mesh/failed-%s-%04d.vtk",
                 run->domain[d].name, r + 1, place, ATTEMPTS, failure->message, run->run_path, run->domain[d].name,
                 r + 1);
      if (run->rank == 0) {
        cw_log_warn("%s region %d, %s: %s; tried again with thinner layers there", run->domain[d].name, r + 1, place,
                    failure->message);
      }
      CW_TRY(start_thinning(run, d));
      cw_region_failure_thin(skeleton, r, failure, FIRST_REACH * (double)(1 << attempt), run->most_height[d]);
    }
    if (run->most_height[d]) thin_alike(skeleton, run->most_height[d]);
  }
  run->retries++;
done:
  return status;
}

void cw_end_thinning(CwMeshRun *run) {
  for (int d = 0; d < run->domains.count; d++) {
    free(run->most_height[d]);
    run->most_height[d] = NULL;
  }
}
