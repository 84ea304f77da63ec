// SPDX-License-Identifier: AGPL-3.0-or-later
// Compares a design with both families of correlations and with usual limits, and says where they disagree. Nothing
// here is an error: the case's table is the law.
#pragma once

#include "geometry/design.h"

enum { CW_DESIGN_REMARK_LIMIT = 32 };

typedef struct {
  int count;
  char text[CW_DESIGN_REMARK_LIMIT][320]; // one line each
} CwDesignRemarks;

void cw_design_check(const CwDesign *design, CwDesignRemarks *remarks);
