// SPDX-License-Identifier: AGPL-3.0-or-later
// Columns are turned, then thinned, until all prisms and the layer top are valid.
#pragma once

#include "mesher/common/box_tree.h"
#include "mesher/layers/layer_columns.h"
#include "mesher/parallel/outcome.h"
#include "pipeline/status.h"

// Makes prisms and layer top valid; fills `top`. *rounds: how many that took. Takes the tree of walls
// and obstacles over. Outcome: that of cw_layers_kind_at with the place where no rounds do. Collective.
CwStatus cw_layers_repair(CwLayerWork *work, CwBoxTree *tree, double (*top)[3], int32_t *rounds, CwOutcome *outcome);
