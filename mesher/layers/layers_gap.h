// SPDX-License-Identifier: AGPL-3.0-or-later
// How thick columns may be: room before other walls and obstacles, concave places, gradation between neighbours.
#pragma once

#include "mesher/common/box_tree.h"
#include "mesher/layers/layer_columns.h"
#include "pipeline/status.h"

// A tree of all triangles, those of the walls first, then the obstacles. Sets `curve`. Collective.
CwStatus cw_gap_tree_make(CwLayerWork *work, CwBoxTree *tree);
// How thick the column of v may be where another wall (`sides` 2: layers on both) or an open patch (1) stands `way`
// before it, m: gap_share or free_share of the way, and no more than leaves `core` (m) to the tetrahedra between; but
// as much as makes its last prism no smaller than 1 / core_ratio of a tetrahedron across what is left, and as much as
// keeps the first layer.
double cw_layers_room(const CwLayerWork *work, int32_t v, int sides, double way, double core);
// t = min(most, room before walls and obstacles) for the columns as they stand, with its reason; keeps the gaps for the
// next call. Collective.
CwStatus cw_layers_limit_by_gap(CwLayerWork *work, CwBoxTree *tree);
// The same limits where the end of a column, or what stands around it, comes nearer to another part of the layer top
// than a tetrahedron between them is high: past an edge of the wall no ray along a column sees what its neighbours
// stand before. tree: of the triangles of the layer top, the walls' first; lowered: gets 1 for the columns made
// thinner, else 0; *any: whether there are some. Collective.
CwStatus cw_layers_limit_by_top(CwLayerWork *work, const CwBoxTree *tree, const double (*top)[3], uint8_t *lowered,
                                int *any);
// Sets `most`: the target, but in a concave place, where columns side by side lean to one another, 0.6 of the thickness
// at which they would meet. Beside a concave crease the smoothing keeps them apart, and nothing is limited. Collective.
CwStatus cw_layers_limit_by_concavity(CwLayerWork *work);
// Lowers thicknesses until |dt| <= 0.3 length along every edge, the lesser of its lengths on the wall and at the lower
// thickness. lowered: vertices lowered since that last held; NULL: any. Collective.
CwStatus cw_layers_grade(CwLayerWork *work, const uint8_t *lowered);
// Where the slope begins that limits the column of v: from each vertex that is limited by its neighbours to that of
// them which limits it, and on. v itself where none does.
int32_t cw_layers_slope_foot(const CwLayerWork *work, int32_t v);
