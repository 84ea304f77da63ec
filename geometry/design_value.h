// SPDX-License-Identifier: AGPL-3.0-or-later
// Quantities of a design as people read them and as files store them.
#pragma once

#include <stddef.h>

#include "geometry/design.h"

// One quantity as it is shown and stored.
typedef struct {
  const char *text, *unit; // as people read it, with its unit
  double shown;            // in that unit
  double asked;            // the same: of the case, where it gave way; else NAN
  char key[64];
  double stored; // in the key's unit
} CwDesignValue;

CwDesignValue cw_hydraulic_design_value(const CwDesign *design, CwDesignQuantity quantity);

// One line for a person: what the quantity is, its value with a unit, and where it comes from.
void cw_hydraulic_design_row(const CwDesign *design, CwDesignQuantity quantity, char *line, size_t size);
