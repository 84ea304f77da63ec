// SPDX-License-Identifier: AGPL-3.0-or-later
// Numbers without their last digits, which rounding made. Two numbers that differ by rounding alone become one, but for
// a chance of one in thousands; so does what is computed from them.
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

// The nearest number of 34 significant bits, ten decimal digits: off by a share of 6e-11 at most. A power of two times
// x gives that power times the result; infinities and NAN stay.
double cw_significant(double x);

// The nearest multiple of 2^power: for numbers that rounding may make of 0 too. Infinities and NAN stay.
double cw_multiple(double x, int power);

#ifdef __cplusplus
}
#endif
