// SPDX-License-Identifier: AGPL-3.0-or-later
// Root of a function of one variable.
#pragma once

typedef double (*CwRootFunction)(double x, const void *context);

// Root of f in [a, b] by false position with the Illinois rule; NAN where f has one sign at both ends, or no
// value at one of them.
double cw_root_find(CwRootFunction f, const void *context, double a, double b);
