// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/run_thinning.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/network/periodic_images.h"
#include "mesher/common/model_unit.h"
#include "mesher/policy.h"
#include "pipeline/log.h"

enum { ATTEMPTS = 3 }; // on one plan

// Gives all periodic images of a column the least thickness of them.
static void thin_alike(const CwDomain *domain, double *most_thickness) {
  const CwPeriodicImages *images = &domain->images;
  const CwNodeImages *nodes = &domain->surface.images;
  for (int32_t v = 0; images->symmetry && v < domain->surface.vertex_count; v++) {
    if (cw_image_node_turns(nodes, v) > 0) continue;
    double least = INFINITY;
    for (int32_t at = v; at >= 0; at = cw_image_after(nodes, at, v)) least = fmin(least, most_thickness[at]);
    for (int32_t at = v; at >= 0; at = cw_image_after(nodes, at, v)) most_thickness[at] = least;
  }
}

static CwStatus start_thinning(CwMeshRun *run, int d) {
  CwStatus status = CW_OK;
  int32_t count = run->domain[d].surface.vertex_count;
  if (run->most_thickness[d]) goto done;
  CW_NEW(run->most_thickness[d], count);
  for (int32_t v = 0; v < count; v++) run->most_thickness[d][v] = INFINITY;
done:
  return status;
}

void cw_thin_places_free(CwThinPlaces *places) {
  free(places->place);
  memset(places, 0, sizeof *places);
}

static CwStatus add_place(int32_t domain, int32_t region, const CwRegionFailure *failure, CwThinPlaces *places) {
  CwStatus status = CW_OK;
  CW_GROW(places->place, places->capacity, places->count + 1);
  places->place[places->count++] = (CwThinPlace){domain, region, *failure};
done:
  return status;
}

CwStatus cw_thin_places_on_planes(const CwMeshRun *run, const CwOutcome *why, CwThinPlaces *places) {
  CwStatus status = CW_OK;
  const CwFreeCurves *free_curves = &run->domain[why->domain].free_curves;
  CwRegionFailure failure = {.failed = 1, .patch = "partition plane"};
  snprintf(failure.message, sizeof failure.message, "%.*s", (int)sizeof failure.message - 1, why->reason);
  for (int32_t i = 0; i < free_curves->tight_count; i++) {
    memcpy(failure.at, free_curves->tight[i], sizeof failure.at);
    CW_TRY(add_place(why->domain, -1, &failure, places));
  }
done:
  return status;
}

CwStatus cw_thin_places_in_regions(const CwMeshRun *run, CwThinPlaces *places) {
  CwStatus status = CW_OK;
  for (int d = 0; d < run->model.domain_count; d++) {
    for (int32_t r = 0; r < run->domain[d].plan.region_count; r++) {
      const CwRegionFailure *failure = &run->summary[d][r].failure;
      if (failure->failed) CW_TRY(add_place(d, r, failure, places));
    }
  }
done:
  return status;
}

// "rotor region 3, at shroud, (x, y, z) mm: message".
static void describe(const CwMeshRun *run, const CwThinPlace *place, size_t size, char *text) {
  const CwRegionFailure *failure = &place->failure;
  char region[24] = "", at[160] = "no place is known";
  if (place->region >= 0) snprintf(region, sizeof region, " region %d", place->region + 1);
  if (!failure->everywhere) {
    snprintf(at, sizeof at, "at %s, (%.3f, %.3f, %.3f) mm", failure->patch, CW_MM(failure->at));
  }
  snprintf(text, size, "%s%s, %s: %s", run->domain[place->domain].name, region, at, failure->message);
}

// Where the boundary of a failed region lies for a look.
static void describe_file(const CwMeshRun *run, const CwThinPlace *place, size_t size, char *text) {
  text[0] = '\0';
  if (place->region < 0) return;
  snprintf(text, size, "; its boundary is in %s/mesh/failed-%s-%04d.vtk", run->run_path,
           run->domain[place->domain].name, place->region + 1);
}

// Of the places on the planes of a domain the first speaks for all.
static int is_told(const CwThinPlaces *places, int32_t i) {
  const CwThinPlace *place = &places->place[i];
  return i == 0 || place->region >= 0 || place[-1].region >= 0 || place[-1].domain != place->domain;
}

// Lowers the columns about a place within `reach` times h.
static CwStatus lower(CwMeshRun *run, const CwThinPlace *place, double reach) {
  CwStatus status = CW_OK;
  int d = place->domain;
  CW_TRY(start_thinning(run, d));
  const CwRegionInput from = cw_domain_region_input(&run->domain[d], NULL);
  cw_region_failure_thin(&from, place->region, &place->failure, reach, run->most_thickness[d]);
done:
  return status;
}

CwStatus cw_thin(CwMeshRun *run, const CwThinPlaces *places, int attempt, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  char text[800], file[4200];
  for (int32_t i = 0; i < places->count; i++) {
    const CwThinPlace *place = &places->place[i];
    int d = place->domain;
    describe(run, place, sizeof text, text);
    describe_file(run, place, sizeof file, file);
    outcome->domain = d;
    CW_END_UNLESS(attempt < ATTEMPTS, outcome, CW_OUTCOME_REPLAN, NULL,
                  "%s; after %d attempts with thinner layers, at last within %.0f edge lengths%s", text, ATTEMPTS,
                  cw_policy.thin_reach * (double)(1 << (ATTEMPTS - 1)), file);
    if (run->rank == 0 && is_told(places, i))
      cw_log(run->context.log, "%s; tried again with thinner layers there", text);
    CW_TRY(lower(run, place, cw_policy.thin_reach * (double)(1 << attempt)));
  }
  for (int d = 0; d < run->model.domain_count; d++) {
    if (run->most_thickness[d]) thin_alike(&run->domain[d], run->most_thickness[d]);
  }
  run->retries++;
done:
  return status;
}

void cw_end_thinning(CwMeshRun *run) {
  for (int d = 0; d < run->model.domain_count; d++) {
    free(run->most_thickness[d]);
    run->most_thickness[d] = NULL;
  }
}
