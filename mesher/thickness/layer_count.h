// SPDX-License-Identifier: AGPL-3.0-or-later
// How many layers lead from the first height to the size of the tetrahedra: continuity of volume across the layer top.
//
//   A prism a third as tall as the regular tetrahedron on it has its volume. Where the growth is left open, columns
//   grow until the last prism has half of that: volumes may change by 4, and the factors of 2 on both sides are left to
//   tetrahedra that are not regular. Layers are enough where the last prism can have a third of it.
#pragma once

#include "pipeline/case.h"

// Of the tetrahedron's thickness, that of the last layer: what columns grow to, what is enough, and the most where the
// case gives the growth.
#define CW_LAST_LAYER (1.0 / 6)
#define CW_LAST_LAYER_ENOUGH (1.0 / 9)
#define CW_LAST_LAYER_GIVEN 1.0
#define CW_REGULAR_HEIGHT 0.81649658092772603273 // of a regular tetrahedron over its edge: sqrt(2/3)

// The least number of layers, from 1 to CW_LAYERS_MOST, of which the last is tall enough where edges are `size`
// long; the first is `first` tall (m) and each of the others up to `growth` times as tall as the one before.
int cw_layer_count(double first, double growth, double size);

// The most layers, at least 1, that grow so from the first and together are no taller than `thickness` (m).
int cw_layer_count_fitting(double first, double growth, double thickness);

// The least number of layers that is enough for layer_count_share of the faces; needing[n]: faces that need n.
int cw_layer_count_for(const double needing[CW_LAYERS_MOST + 1]);
