// SPDX-License-Identifier: AGPL-3.0-or-later
// cmocka with the headers that it needs before it, for C and C++. In C++ it comes last: its macros have names of the
// C++ library.
#pragma once

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif
#include <cmocka.h>
#ifdef __cplusplus
}
#endif

// cmocka's own comparison is in float.
#define assert_near(value, wanted, tolerance)                                                                          \
  do {                                                                                                                 \
    const double value_ = (value), wanted_ = (wanted);                                                                 \
    if (!(fabs(value_ - wanted_) <= (tolerance))) fail_msg("%s: %.17g, not %.17g", #value, value_, wanted_);           \
  } while (0)
