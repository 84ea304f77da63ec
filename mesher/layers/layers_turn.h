// SPDX-License-Identifier: AGPL-3.0-or-later
// How good the prisms about a column are, and the search for a better direction of it.
#pragma once

#include "mesher/layers/layer_columns.h"

// Quality (prism_quality.h) of the prism over triangle f with column ends `top`.
double cw_layers_prism_quality(const CwLayerWork *work, int32_t f, const double (*top)[3]);
// How good the column of v is: by the worst prism around it, and where all are good by their layer top and shear too;
// no more than `floor` where one is no better, not looking at the others. *first: which of them is looked at first, and
// then the one that was the worst: most other directions fail there too.
double cw_layers_around(const CwLayerWork *work, int32_t v, const double (*top)[3], double floor, int32_t *first);
// How good the column of v is, as cw_layers_around tells.
typedef double (*CwLayerJudge)(const CwLayerWork *work, int32_t v, const double (*top)[3], double floor,
                               int32_t *first);
// Tries directions of the column of v near the present one; keeps the best. finely: also small steps, and the direction
// to the middle of the ends around, of which a vertex on a seam has half.
void cw_layers_turn(CwLayerWork *work, int32_t v, double (*top)[3], CwLayerJudge judge, int finely);

// What the layer top over triangle f counts beside its prism.
double cw_layers_top_quality(const CwLayerWork *work, int32_t f, const double (*top)[3]);
// What it costs that the columns of triangle f lean: prism_good where no determinant of a prism is small and there is
// room for three good cells between the layer top and what holds its edge.
double cw_layers_lean_quality(const CwLayerWork *work, int32_t f, const double (*top)[3]);
