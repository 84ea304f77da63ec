// SPDX-License-Identifier: AGPL-3.0-or-later
// Smoothing of the extrusion directions beside concave creases and tilted constraints.
#pragma once

#include "mesher/layers/layer_columns.h"
#include "pipeline/status.h"

// Tilts the columns beside concave creases and tilted constraints for the thicknesses t. The first time it sets every
// column that they reach, later those that the change of thicknesses concerns. Collective.
CwStatus cw_smooth_directions(CwLayerWork *work);
void cw_smoothing_free(struct CwSmoothing **smoothing);
