// SPDX-License-Identifier: AGPL-3.0-or-later
// How the files of the hydraulic design set a quantity of `design` together with where it comes from.
#ifndef CUTWATER_GEOMETRY_DESIGN_SOURCE_H
#define CUTWATER_GEOMETRY_DESIGN_SOURCE_H

#include "geometry/design.h"

// Takes the case's value where it is given, else the computed one, and notes which.
#define TAKE(member, given, computed, text)                                                                            \
  do {                                                                                                                 \
    const double take_given = (given);                                                                                 \
    design->member = cw_case_given(take_given) ? take_given : (computed);                                              \
    design->source[CW_DESIGN_##member] = cw_case_given(take_given) ? "case" : (text);                                  \
  } while (0)
#define SET(member, value, text)                                                                                       \
  do {                                                                                                                 \
    design->member = (value);                                                                                          \
    design->source[CW_DESIGN_##member] = (text);                                                                       \
  } while (0)

#endif
