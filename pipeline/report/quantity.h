// SPDX-License-Identifier: AGPL-3.0-or-later
// Quantities of the JSON files: a key such as `throat_area_m2` has a name, perhaps a symbol, and a unit to
// show it in.
#pragma once

#include <stdio.h>

enum { CW_STEM_SIZE = 80 };

typedef struct {
  const char *end;  // what the key ends in
  const char *unit; // HTML; "" for none
  double scale;     // from the unit of the key
} CwQuantityUnit;

// The unit of a key; never NULL. Lengths are shown in mm, but heads in m.
const CwQuantityUnit *cw_quantity_unit(const char *key);

// The key without its unit.
void cw_quantity_stem(const char *key, char stem[CW_STEM_SIZE]);

// Starts a table row with the cells of name and symbol. Where `name` is NULL the stem stands for it.
void cw_quantity_start(FILE *page, const char *stem, const char *name);
