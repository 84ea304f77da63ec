// SPDX-License-Identifier: AGPL-3.0-or-later
// The wanted edge length as those who mesh by it ask for it.
#ifndef CUTWATER_MESHER_COMMON_SIZE_AT_H
#define CUTWATER_MESHER_COMMON_SIZE_AT_H

// Wanted edge length at x, m.
typedef double (*CwSizeAt)(const void *context, const double x[3]);

#endif
