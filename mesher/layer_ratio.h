// SPDX-License-Identifier: AGPL-3.0-or-later
// How the layers meet the tetrahedra: the height of the last layer over that of the tetrahedron that stands on it.
#ifndef CUTWATER_MESHER_LAYER_RATIO_H
#define CUTWATER_MESHER_LAYER_RATIO_H

#include <stdint.h>

#include "mesher/region_file.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_RATIO_BINS = 8 };
// Upper ends of the bins; the last has none. 0.5 to 1.5 is fair: the bins from 2 up to 5.
extern const double cw_ratio_ends[CW_RATIO_BINS - 1];

// Counts the wall faces of each patch by the ratio of the heights, normal to the face between them: volume of the last prism
// over that face's area, and three times the volume of the tetrahedron over it. Adds to bin[patch][], which has `patches`
// rows. Fails with CW_ERR_MESH where a column of `layers` prisms has no tetrahedron on its end.
CwStatus cw_layer_ratio(const CwRegionMesh *mesh, int layers, int patches, int64_t (*bin)[CW_RATIO_BINS]);

#ifdef __cplusplus
}
#endif
#endif
