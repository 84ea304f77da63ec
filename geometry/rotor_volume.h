// SPDX-License-Identifier: AGPL-3.0-or-later
// The volume of the rotor's fluid by a second route, which knows nothing of the B-rep: the meridian's solid of
// revolution, less the blades by tables of their sections, less the root fillets by Pappus.
#pragma once

#include "geometry/design.h"
#include "pipeline/status.h"

// Fails as cw_meridian_make() and cw_blade_section().
CwStatus cw_rotor_volume(const CwDesign *design, double *volume);
