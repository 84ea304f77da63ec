// SPDX-License-Identifier: AGPL-3.0-or-later
// The rotor's fluid as one closed solid: suction pipe, hub with nut, shroud, blades, interface. Built
// directly from shared edges, without booleans; all faces of revolution are split into one sector a blade, so
// that no face has a seam or a degenerate edge.
#pragma once

#include "geometry/design.h"
#include "geometry/solid.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Builds the rotor of a design in the model unit of its D2. Free with cw_solid_free(). Fails with CW_ERR_DESIGN where
// the blade has no solution and with CW_ERR_GEOMETRY where the solid cannot be built or is not valid.
CwStatus cw_rotor_build(const CwDesign *design, CwSolid **rotor);

#ifdef __cplusplus
}
#endif
