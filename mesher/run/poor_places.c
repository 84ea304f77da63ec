// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/poor_places.h"

#include <math.h>

#include "mesher/common/vec.h"
#include "mesher/policy.h"
#include "mesher/run/layer_coverage.h"

static const double PLACES_APART = 2; // h, of those where first heights are missed: one reaches about as far

static double wanted_of(const CwRegionSummary *made) {
  return fmin(cw_policy.flat_angle, made->dihedral_allowed);
}

// What region r of domain d lacks; 0 where it is not flat, or not the first of its images.
static double lacks_angle(const CwMeshRun *run, int d, int32_t r) {
  const CwDomain *domain = &run->domain[d];
  const CwRegionSummary *made = &run->summary[d][r];
  double wanted = wanted_of(made), least = made->quality.flattest;
  int first = cw_image_region_first(&domain->images, &domain->plan, r) == r;
  return first && least < wanted ? 1 - least / wanted : 0;
}

// Of a patch that is not told of beforehand.
static int is_judged(const CwDomain *domain, int patch) {
  return domain->patch[patch].kind == CW_PATCH_WALL && domain->patch_target[patch].first.source != CW_FIRST_FITTED;
}

// How many times missed_share of the domain's faces miss their first height, beyond the first time; but for those
// where layers taper, and those beside sharp edges, where it has any: of these is told beforehand too. Round edges are
// as sharp where edges of the mesh are long.
static double lacks_first_heights(const CwMeshRun *run, int d) {
  const CwDomain *domain = &run->domain[d];
  double faces = 0, missed = 0;
  int sharp = cw_domain_is_sharp(domain);
  for (int p = 0; p < run->model.domain[d].patch_count; p++) {
    for (int32_t r = 0; is_judged(domain, p) && r < domain->plan.region_count; r++) {
      const CwLayerCoverage *of = &run->summary[d][r].coverage[p];
      faces += of->faces;
      missed += of->faces - of->first_met - of->missed[CW_LAYER_TAPER] - (sharp ? of->missed[CW_LAYER_SHARPNESS] : 0);
    }
  }
  return faces > 0 ? fmax(missed / (cw_policy.missed_share * faces) - 1, 0) : 0;
}

// Of one domain.
static double deficit_of(const CwMeshRun *run, int d, int32_t *count) {
  double deficit = lacks_first_heights(run, d);
  *count += deficit > 0;
  for (int32_t r = 0; r < run->domain[d].plan.region_count; r++) {
    double of = lacks_angle(run, d, r);
    deficit += of;
    *count += of > 0;
  }
  return deficit;
}

double cw_poor_deficit(const CwMeshRun *run, int32_t *count) {
  double deficit = 0;
  *count = 0;
  for (int d = 0; d < run->model.domain_count; d++) deficit += deficit_of(run, d, count);
  return deficit;
}

void cw_poor_domains(const CwMeshRun *run, int32_t lacks[CW_DOMAINS_MOST]) {
  for (int d = 0; d < run->model.domain_count; d++) {
    int32_t count = 0;
    lacks[d] = deficit_of(run, d, &count) > 0;
  }
}

// Asks for shorter edges at the vertex x unless a place of this round, of which `before` were there, is near.
static CwStatus add_apart(CwMeshRun *run, int d, const double x[3], int32_t before) {
  CwStatus status = CW_OK;
  const CwDomain *domain = &run->domain[d];
  double apart = PLACES_APART * cw_size_at(domain->size, x);
  for (int32_t i = before; i < run->finer.count; i++) {
    const CwFinerPlace *place = &run->finer.place[i];
    if (place->domain == d && cw_distance(place->point.x, x) < apart) goto done;
  }
  CW_TRY(cw_finer_places_add(domain, d, x, &run->finer));
done:
  return status;
}

CwStatus cw_finer_at_poor(CwMeshRun *run) {
  CwStatus status = CW_OK;
  int32_t before = run->finer.count;
  for (int d = 0; d < run->model.domain_count; d++) {
    const CwDomain *domain = &run->domain[d];
    const double near = cw_nearly_flat_angle() / cw_policy.flat_angle; // times what is wanted
    int heights = lacks_first_heights(run, d) > 0, sharp = cw_domain_is_sharp(domain);
    for (int32_t r = 0; r < domain->plan.region_count; r++) {
      const CwRegionSummary *made = &run->summary[d][r];
      if (lacks_angle(run, d, r) == 0) continue;
      for (int32_t i = 0; i < made->quality.flat_count; i++)
        if (made->quality.flat[i].flatness < near * wanted_of(made))
          CW_TRY(add_apart(run, d, made->quality.flat[i].x, before));
    }
    for (int32_t t = 0; heights && t < domain->surface.triangle_count; t++) {
      const CwSurfaceMesh *surface = &domain->surface;
      if (surface->source[t] != t || !is_judged(domain, cw_cad_face_patch(domain->cad, surface->face[t]))) continue;
      for (int k = 0; k < 3; k++) {
        int32_t v = domain->layers.triangle[t][k];
        const int reason = domain->layers.reason[v];
        if (reason == CW_LAYER_TAPER || (sharp && reason == CW_LAYER_SHARPNESS)) continue;
        if (!cw_domain_first_is_met(domain, v)) CW_TRY(add_apart(run, d, surface->x[v], before));
      }
    }
  }
done:
  return status;
}
