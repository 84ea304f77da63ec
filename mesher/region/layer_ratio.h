// SPDX-License-Identifier: AGPL-3.0-or-later
// How the layers meet the tetrahedra: the height of the last layer over that of the tetrahedron that stands on it.
#ifndef CUTWATER_MESHER_REGION_LAYER_RATIO_H
#define CUTWATER_MESHER_REGION_LAYER_RATIO_H

#include <stdint.h>

#include "mesher/heights/column_heights.h"
#include "mesher/region/region_file.h"

#ifdef __cplusplus
extern "C" {
#endif

// Bins of the ratio that end at 0.25, 0.5, 0.75, 1, 1.25, 1.5 and 2; the last has no end. 0.5 to 1.5 is fair: the bins
// from 2 up to 5.
enum { CW_RATIO_BINS = 8 };

typedef struct {
  int64_t bin[CW_RATIO_BINS];
  // Faces that are not cramped and where the column can end in a fair layer: the first is no higher than one and a half
  // of the tetrahedron, and the last, as much taller as its column could be, comes to half of it. And fair ones among
  // them.
  int64_t within, fair_within;
} CwLayerRatio;

// Counts the wall faces of each patch by the ratio of the heights, normal to the face between them: volume of the last
// prism over that face's area, and three times the volume of the tetrahedron over it. Adds to ratio[patch], which has
// `patches` rows; wall[i] belongs to the i-th triangle with a prism. Fails with CW_ERR_MESH where a column of `layers`
// prisms has no tetrahedron on its end.
CwStatus cw_layer_ratio(const CwRegionMesh *mesh, int layers, const CwRatioWall *wall, int patches,
                        CwLayerRatio *ratio);

#ifdef __cplusplus
}
#endif
#endif
