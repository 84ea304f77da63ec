// SPDX-License-Identifier: AGPL-3.0-or-later
// Sub-division of a column of the layer envelope into layers: fractions of its thickness from first height, count and
// growth.
#pragma once

#include "pipeline/case.h"

// First height of a layer for a y+ target (m): y = y+ nu / u_tau, u_tau = U sqrt(Cf/2), Cf = 0.026 Re^(-1/7),
// Re = U L / nu; twice that where y+ is counted at the cell centre (`at_centre`).
double cw_first_height(double y_plus, double velocity, double length, double kinematic_viscosity, int at_centre);

// Total thickness of `count` layers from `first` with growth ratio `growth`, m.
double cw_layer_thickness(double first, int count, double growth);

// Policy: of an automatic y+ and an automatic number of layers the number grows first, up to this, then y+ up to the
// end of the log layer, then the number again.
enum { CW_LAYER_COUNT_USUAL = 6 };

// The least growth ratio of `count` layers, in columns too short for even ones: least_growth, or more where there are
// more than the usual number, whose last layer is no smaller a part of the first than among so many.
double cw_layer_growth_least(int count);

// The height of the lowest column that has its first height, over that: its layers grow by cw_layer_growth_least().
double cw_layer_lowest(int count);

// Fractions f[0] = 0 < f[1] < ... < f[count] = 1 of a column of thickness `thickness`. Holds `first` and solves the
// growth ratio: in columns too short for even layers it is below 1, the outer layers give way. Where it would exceed
// `growth_max`, or fall below cw_layer_growth_least(), it stays there and the first height follows the column. Returns
// the first height it came to, m.
double cw_layer_fractions(double thickness, double first, int count, double growth_max, double *fraction);

// The share of the column that the last of these layers takes.
double cw_layer_last(double thickness, double first, int count, double growth_max);
