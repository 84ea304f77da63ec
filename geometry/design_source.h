// SPDX-License-Identifier: AGPL-3.0-or-later
// How the files of the hydraulic design set a quantity of `design` together with where it comes from.
#pragma once

#include <math.h>

#include "geometry/design.h"

// The family's value of a quantity with the design so far; its formula goes to `source`, which SET and TAKE read after
// the value.
#define CORRELATED(quantity) cw_correlation(design->correlations, quantity, design, &source)

#define SET(member, value, text)                                                                                       \
  do {                                                                                                                 \
    design->member = (value);                                                                                          \
    design->source[CW_DESIGN_##member] = (text);                                                                       \
    design->asked[CW_DESIGN_##member] = NAN;                                                                           \
  } while (0)

// A given value that cannot be had gives way to `value`; a word, by which it is taken, where both are the same. The
// text begins with the key.
#define GIVE_WAY(member, value, given, text)                                                                           \
  do {                                                                                                                 \
    const double given_up = (given);                                                                                   \
    SET(member, value, text);                                                                                          \
    design->asked[CW_DESIGN_##member] = given_up;                                                                      \
  } while (0)

// Takes the case's value where it is given, else the computed one, and notes which.
#define TAKE(member, given, computed, text)                                                                            \
  do {                                                                                                                 \
    const double take_given = (given);                                                                                 \
    SET(member, cw_case_given(take_given) ? take_given : (computed), cw_case_given(take_given) ? "case" : (text));     \
  } while (0)
