// SPDX-License-Identifier: AGPL-3.0-or-later
// The units that keys of the case file may end in.
#pragma once

#include <stddef.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

// Units that a key may end in. `value` SI units are value * numerator / denominator: a quotient, so that 74
// mm is the double nearest to 0.074 m.
typedef struct {
  const char *suffix;   // as in keys: "m3_per_h"
  const char *text;     // as people write it: "m3/h"
  const char *quantity; // "length"
  double numerator, denominator;
} CwUnit;

// The unit of a suffix, or NULL.
const CwUnit *cw_unit_find(const char *suffix);

// The unit that `key` ends in, or NULL; `*stem` is the length of the key without it ("wrap_angle_deg": 10).
const CwUnit *cw_unit_of_key(const char *key, size_t *stem);

// Writes the table of units as docs/case-reference.md holds it.
void cw_units_markdown(FILE *stream);

#ifdef __cplusplus
}
#endif
