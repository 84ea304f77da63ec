// SPDX-License-Identifier: AGPL-3.0-or-later
// Standard bores of pipes: the nominal sizes of ISO 6708 from DN 15 to DN 4000, taken as bores; below and beyond them
// the preferred numbers R10 of ISO 3 (10, 12.5, 16, 20, 25, 31.5, 40, 50, 63, 80 and so on by powers of ten). No size
// is without a bore.
#pragma once

// The smallest standard bore that is not less than `least`, m; least > 0. One step of the series multiplies the area
// by at most 1.78.
double cw_standard_bore(double least);
