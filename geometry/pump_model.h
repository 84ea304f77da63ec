// SPDX-License-Identifier: AGPL-3.0-or-later
// What the pump's patches are to mesher and solver: groups of walls and sizes, the flow along each wall, what turns,
// and the figures that a solver starts from. Fills the model of pipeline/model.h.
#pragma once

#include "geometry/pump.h"
#include "pipeline/model.h"

// The model of a built pump. Free with cw_model_free(), also after a failure; zeroed `model` on entry.
CwStatus cw_pump_model(const CwDesign *design, const CwPump *pump, CwModel *model);
