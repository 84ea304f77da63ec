// SPDX-License-Identifier: AGPL-3.0-or-later
// The wanted edge length as those who mesh by it ask for it.
#pragma once

// Wanted edge length at x, m. Any thread, several at a time.
typedef double (*CwSizeAt)(const void *context, const double x[3]);
