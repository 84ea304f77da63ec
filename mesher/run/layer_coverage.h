// SPDX-License-Identifier: AGPL-3.0-or-later
// What the layers over a patch came to, against what was asked of them.
#pragma once

#include "mesher/run/domain.h"

// How the layers of a patch cover it, as far as it bounds one region.
typedef struct {
  int64_t faces, full, first_met;   // wall faces; with the full thickness; with the first height
  int64_t reason[CW_LAYER_REASONS]; // by CwLayerReason: why not the full thickness; [0]: it is
  int64_t missed[CW_LAYER_REASONS]; // why not the first height
  int64_t without;                  // faces without any layer
  double thickness, least;          // sum over the faces, least of all, m
  int64_t thin;                     // prisms whose determinant checkMesh calls small (thin_prism)
  double thin_wanted;               // how many times as tall the thinnest would have to be
  double thin_at[3];                // and a corner of its wall triangle, m
} CwLayerCoverage;
#define CW_FIRST_HEIGHT_TOLERANCE 0.1 // share by which a first layer may be off

// Whether the first layer at a wall vertex is as high as asked, within the tolerance.
int cw_domain_first_is_met(const CwDomain *domain, int32_t vertex);

// Whether walls meet in an edge so sharp that first heights beside it are missed, of which is told before.
int cw_domain_is_sharp(const CwDomain *domain);

// Of all patches, zeroed before.
void cw_domain_coverage(const CwDomain *domain, int32_t region, CwLayerCoverage *coverage);
