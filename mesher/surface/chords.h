// SPDX-License-Identifier: AGPL-3.0-or-later
// Chords of curves in a parameter plane: whether the polygons that replace the curves lie to one another as the curves
// do. Curves that meet at their ends only are replaced by chords that may cross, coincide, or pass on the wrong side of
// a point, where a chord is longer than the gap beside it. Halving the chord whose curve bends away from it restores
// the order: chords converge to curves that do not cross.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

enum { CW_CHORD_SAMPLES = 9 }; // places of the curve along a chord, its ends included

// The lens of a chord is the area between it and its curve.
typedef struct {
  int32_t point[2];               // its ends: equal numbers are one point
  int given;                      // 1: cannot be halved
  double uv[CW_CHORD_SAMPLES][2]; // the curve from end to end
  double deviation;               // greatest distance of the curve from the chord, in space
} CwChord;

// Sets halve[i] to 1 for chords to be halved, to 0 for the others:
// - a chord with an end of another chord in its lens, or on it;
// - of two chords that cross, or that have both ends in common, the one with the greater deviation.
// Where none is set the chords lie as their curves do. Deterministic.
CwStatus cw_chords_to_halve(int32_t count, const CwChord *chord, uint8_t *halve);
