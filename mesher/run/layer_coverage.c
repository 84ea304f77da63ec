// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/layer_coverage.h"

#include <math.h>

#include "mesher/common/vec.h"
#include "mesher/layers/layers_normal.h"
#include "mesher/layers/thin_prism.h"
#include "mesher/policy.h"
#include "mesher/thickness/even_columns.h"
#include "mesher/thickness/layer_thickness.h"

// Adds the prisms over a wall triangle that are thin for their length, or sheared: of small determinants.
static void count_thin(const CwDomain *domain, int32_t t, CwLayerCoverage *of) {
  const CwColumnTargets *targets = &domain->targets;
  const int32_t *corner = domain->layers.triangle[t];
  double determinant[CW_LAYERS_MOST], first[3];
  for (int k = 0; k < 3; k++) first[k] = domain->layers.first_height[corner[k]];
  cw_column_determinants(targets, &domain->surface, &domain->layers, t, first, determinant);
  for (int k = 0; k < targets->layer_count; k++) {
    if (determinant[k] >= CW_SMALL_DETERMINANT) continue;
    double wanted = cw_thin_prism_wanted(determinant[k]);
    of->thin++;
    if (wanted <= of->thin_wanted) continue;
    of->thin_wanted = wanted;
    cw_copy(domain->surface.x[corner[0]], of->thin_at);
  }
}

int cw_domain_first_is_met(const CwDomain *domain, int32_t vertex) {
  const CwColumnTargets *targets = &domain->targets;
  double fraction[CW_LAYERS_MOST + 1];
  double first = cw_layer_fractions(domain->layers.thickness[vertex], domain->layers.first_height[vertex],
                                    targets->layer_count, targets->growth[vertex], fraction);
  return fabs(first / targets->first_height[vertex] - 1) <= CW_FIRST_HEIGHT_TOLERANCE;
}

int cw_domain_is_sharp(const CwDomain *domain) {
  return sin(domain->sharp.angle / 2 * CW_DEGREE) < (1 - CW_FIRST_HEIGHT_TOLERANCE) * cw_policy.upright_cosine;
}

void cw_domain_coverage(const CwDomain *domain, int32_t region, CwLayerCoverage *coverage) {
  const CwColumnTargets *targets = &domain->targets;
  for (int32_t i = domain->surface.region_start[region]; i < domain->surface.region_start[region + 1]; i++) {
    int32_t t = domain->surface.region_triangle[i];
    CwLayerCoverage *of = &coverage[cw_cad_face_patch(domain->cad, domain->surface.face[t])];
    int full = 1, met = 1, worst = 0, why = 0, pinched = cw_layers_pinched(&domain->layers, t);
    for (int k = 0; k < 3; k++) {
      int32_t v = domain->layers.triangle[t][k];
      double thickness = domain->layers.thickness[v];
      full &= thickness >= 0.99 * targets->target[v];
      int reason = domain->layers.reason[v];
      if (reason > worst) worst = reason;
      if (!cw_domain_first_is_met(domain, v)) {
        // Where one corner is beside a sharp edge, or where layers taper, room about the others would not do.
        int settled = why == CW_LAYER_SHARPNESS || why == CW_LAYER_TAPER;
        if (!settled && (reason == CW_LAYER_SHARPNESS || reason == CW_LAYER_TAPER || reason > why)) why = reason;
        met = 0;
      }
      of->thickness += thickness / 3;
      of->least = of->faces == 0 && k == 0 ? thickness : fmin(of->least, thickness);
    }
    of->faces++;
    of->full += full;
    of->first_met += met;
    of->reason[full ? 0 : worst]++;
    if (!met) of->missed[why]++;
    of->without += pinched == 3;
    if (pinched == 0) count_thin(domain, t, of);
  }
}
