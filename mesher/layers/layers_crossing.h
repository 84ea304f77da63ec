// SPDX-License-Identifier: AGPL-3.0-or-later
// Where the layer top of the layers crosses itself, the wall or an open patch, and the wall itself: kept up to date as
// columns move.
#pragma once

#include "mesher/common/box_tree.h"
#include "mesher/layers/layer_columns.h"
#include "mesher/parallel/outcome.h"

// Two triangles that cross; kinds are 0 layer top, 1 wall, 2 open patches.
typedef struct {
  int32_t f, g, kind_f, kind_g;
} CwLayerPair;

typedef struct {
  const CwLayerWork *work;
  int32_t item_count;
  const double (*moved_to)[3]; // the layer top, that of the last search
  CwBoxTree fixed;             // of the triangles of wall and open patches; may be given
  CwBoxTree top;               // of those of the layer top, in the order of `fixed`
  uint8_t *active;             // triangles that moved
  int32_t *list, list_count;
  int searched; // a first time
  int32_t pair_count, pair_capacity;
  CwLayerPair *pair; // layer top with layer top, wall or open patch; wall with wall, looked for once
} CwLayerCrossing;

CwStatus cw_layers_crossing_make(const CwLayerWork *work, CwLayerCrossing *crossing); // zeroed before
void cw_layers_crossing_free(CwLayerCrossing *crossing);
// Brings the pairs up to date with the layer top; moved: vertices that moved since the last time; the first time all
// those not known to be clear of one another. Collective.
CwStatus cw_layers_crossing_find(CwLayerCrossing *crossing, const double (*top)[3], const uint8_t *moved);
// Whether thinner columns can get clear of what they cross; outcome: that of cw_layers_kind_at where not.
void cw_layers_crossing_judge(const CwLayerCrossing *crossing, CwOutcome *outcome);
