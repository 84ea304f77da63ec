// SPDX-License-Identifier: AGPL-3.0-or-later
// Which prisms are to be repaired, and which of their columns are to give way.
#pragma once

#include "mesher/layers/layer_columns.h"

// How good prism f with column ends `top` is, for the repair: its quality (prism_quality.h) and that of its layer top,
// which is to be the rounder in channels, as long as one of the columns can still give way; then that of a prism that
// is sound counts as prism_good. What is good but for its shear is prism_good: such columns are turned once more at the
// end, but never thinned. A prism that is no worse than its columns have to lean counts as good: it does not become
// better with less thickness.
double cw_layers_judge(const CwLayerWork *work, int32_t f, const double (*top)[3]);

// Whether prism f is one that columns keep their first height for.
int cw_layers_is_sound(const CwLayerWork *work, int32_t f, const double (*top)[3]);

// The columns of prism f of which less would make it better, alone: 1 in helps[k]. All, where none does that can still
// give way. sound: what cw_layers_is_sound tells; its layer top counts then, and columns keep their least thickness.
void cw_layers_helped_by(const CwLayerWork *work, int32_t f, const double (*top)[3], int sound, int helps[3]);
