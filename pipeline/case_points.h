// SPDX-License-Identifier: AGPL-3.0-or-later
// The points of the characteristic curve: flow rates at which the solvers' files have a set-up each.
#pragma once

#include "pipeline/case.h"

enum { CW_POINT_NAME_SIZE = 24 };

typedef struct {
  char name[CW_POINT_NAME_SIZE]; // in the solvers' files: "q0800" where the share is 0.8; of one case all differ
  double flow;                   // m3/s
  double share;                  // of the flow of the operating point
} CwCasePoint;

// The points of the case [out], by ascending flow where the case is valid; their number. 0.6, 0.8, 1 and 1.2 times the
// flow of the operating point where the case names none.
int cw_case_points(const CwCase *table, CwCasePoint points[CW_LIST_MOST]);
