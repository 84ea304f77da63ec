// SPDX-License-Identifier: AGPL-3.0-or-later
// How the layers meet the tetrahedra: across each face of the layer top, the ratio of the volumes of the two cells, the
// greater over the less, and OpenFOAM's weight of the face.
#pragma once

#include <stdint.h>

#include "mesher/region/region_file.h"

#ifdef __cplusplus
extern "C" {
#endif

// Policy: volumes may change by 4 across 95 % of the faces and by 10 across any.
#define CW_RATIO_FAIR 4.0
#define CW_RATIO_MOST 10.0

enum { CW_RATIO_BINS = 80 };

typedef struct {
  int64_t faces;
  int64_t bin[CW_RATIO_BINS];      // faces by ratio; bin b ends at 2^((b + 1) / 8), the last has no end
  int64_t thin_over_fair;          // faces over CW_RATIO_FAIR whose prism is the lesser cell
  int64_t thick_over_fair;         // faces over CW_RATIO_FAIR whose prism is the greater cell
  int64_t over_most;               // faces over CW_RATIO_MOST
  int64_t small_weight;            // faces of a weight below CW_SMALL_WEIGHT (pipeline/mesh/cell.h)
  double greatest, greatest_at[3]; // greatest ratio; centre of its face
} CwLayerRatio;

// Adds the wall faces of a region to ratio[patch], which has `patches` rows. The weight of the face between two cells
// is the lesser distance of their centres from its plane over the sum of both. Fails with CW_ERR_FAULT where a column
// of `layers` prisms has no tetrahedron on its end.
CwStatus cw_layer_ratio(const CwRegionMesh *mesh, int layers, int patches, CwLayerRatio *ratio);

// Adds what another region has counted.
void cw_layer_ratio_add(CwLayerRatio *sum, const CwLayerRatio *of);

// The ratio that `share` of the faces do not exceed, from above: the end of the bin it lies in, at most the greatest.
// 0 without faces.
double cw_layer_ratio_quantile(const CwLayerRatio *ratio, double share);

#ifdef __cplusplus
}
#endif
