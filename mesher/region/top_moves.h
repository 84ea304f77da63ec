// SPDX-License-Identifier: AGPL-3.0-or-later
// Moves of the layer top where tetrahedra on it are flat, as far as the prisms under it allow.
#pragma once

#include "mesher/region/region_file.h"

// Moves points of the layer top, and of the tetrahedra on them, where the least quality of the tetrahedra round a point
// (cw_tet_quality, or less where checkMesh calls the determinant small) is below search_wanted and becomes greater. A
// point of the layer top goes where its prisms stay as good as they are or as layers ask for (prism_quality.h), and the
// last layer as high but for what edges may change from one to the next (slope). The lower points of its column stay,
// so its first height does, and a single layer stays whole; so do points that regions share and those on patches.
// `layers`: of each column. *moved: points that were.
CwStatus cw_top_moves(int layers, CwRegionMesh *mesh, int32_t *moved);
