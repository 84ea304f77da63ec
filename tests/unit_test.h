// SPDX-License-Identifier: AGPL-3.0-or-later
// cmocka with the headers that it needs before it, for C and C++. In C++ it comes last: its macros have names of the
// C++ library.
#ifndef CUTWATER_TESTS_UNIT_TEST_H
#define CUTWATER_TESTS_UNIT_TEST_H

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
#endif
