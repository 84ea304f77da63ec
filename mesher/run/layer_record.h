// SPDX-License-Identifier: AGPL-3.0-or-later
// What the mesher's record tells of the layer top, and the warning where volumes jump across it.
#ifndef CUTWATER_MESHER_RUN_LAYER_RECORD_H
#define CUTWATER_MESHER_RUN_LAYER_RECORD_H

#include <jansson.h>

#include "mesher/region/layer_ratio.h"

// Adds the figures of the layer top over a patch to its entry of layer_coverage.
void cw_put_layer_ratio(const CwLayerRatio *ratio, json_t *patch);

// Warns, in one line, of the patches of `coverage` (the domain's layer_coverage) over which more than 5 % of the faces
// of the layer top exceed CW_RATIO_FAIR, any exceeds CW_RATIO_MOST or any has a small weight, and names the key to
// change. `layers`: their number.
void cw_warn_of_layers(const char *domain, int layers, const json_t *coverage);

#endif
