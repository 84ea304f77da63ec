// SPDX-License-Identifier: AGPL-3.0-or-later
// The hydraulic design: from the case's table to every dimension of the pump. What the table leaves open
// (NAN) is computed by a named correlation; what it gives is taken as it is. SI units: m, rad, s, kg.
//
// A table may be over-determined: wrap angle, outlet blade angle and head need not fit one another. The
// case's priority says which is the law; the others are predicted, and their residuals reported. Where D2 is
// open it is solved so that the predicted head is the one asked.
#pragma once

#include "geometry/design.h"
#include "pipeline/case.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Source of a wrap that is less than the blade angles ask for.
#define CW_WRAP_WITHIN_A_REVOLUTION "greatest with which no passage winds round the axis"

// Computes the design of a case. Fails with CW_ERR_DESIGN where it has no solution (for instance blade angles
// outside 12 to 60 degrees), with the value and the allowed range.
CwStatus cw_hydraulic_design(const CwCase *table, CwDesign *design);

#ifdef __cplusplus
}
#endif
