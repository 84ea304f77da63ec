// SPDX-License-Identifier: AGPL-3.0-or-later
// The main dimensions, the meridian and the mid-span blade angles of the wheel for its head. What the case leaves open
// yields to what it gives:
//
//   D2 open              meets the head, with an outlet blade angle of 18 to 32 deg; within a given D3, with a
//                        greater one
//   D2 given, b2 open    beta2 meets the head; where 12 to 60 deg do not, b2 does
//   cylindrical blades   begin as far out as they stand on hub and shroud, where the leading edge is open
#pragma once

#include "geometry/design.h"
#include "geometry/meridian.h"
#include "pipeline/case.h"
#include "pipeline/status.h"

// Whether the predicted head is the one asked.
int cw_design_meets_head(const CwDesign *design);

// design: [in] duty, specific speeds, efficiencies and the kinds that the case chooses; [out] the wheel and its
// predicted head. Fails with CW_ERR_DESIGN and one line that names the keys to change.
CwStatus cw_impeller_design(const CwCase *table, CwMeridian *meridian, CwDesign *design);
