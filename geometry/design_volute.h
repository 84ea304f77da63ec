// SPDX-License-Identifier: AGPL-3.0-or-later
// The volute of a hydraulic design: what the case gives of it, and the rest by correlations.
#pragma once

#include "geometry/design.h"
#include "pipeline/case.h"
#include "pipeline/status.h"

// Sets the design's volute and its quantities; the wheel's are known, and D3 and b3. Where the usual volute has no
// solution, open dimensions yield. Fails with CW_ERR_DESIGN and one line.
CwStatus cw_design_volute(const CwVoluteTable *given, CwDesign *design);
