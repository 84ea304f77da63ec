// SPDX-License-Identifier: AGPL-3.0-or-later
// What to change in a case whose geometry is refused: the fewest keys, and a value that was tried and works.
//
// Most pumps given by their duty alone can be built, so leaving keys out of the case leads to one that works. First
// each key alone is left out, those that the refusal names before others; of a number the value nearest to the given
// one is then looked for between it and the computed or default one; taken as it is, not giving way to another. Where
// no key alone helps, keys are left out one after another until the pump can be built, and those that were not needed
// are put back. Where that does not help either, one key that the case leaves open is given, 5 to 50 % beside the value
// that the design has chosen, the least change first: those that the refusal names, D2, b3, z and D1; after all of them
// the speed.
#pragma once

#include <stddef.h>

#include "geometry/design.h"
#include "pipeline/case.h"
#include "pipeline/status.h"

// Whether the geometry of a case can be made; `design` is that of the case, on failure as far as it came.
typedef CwStatus (*CwRemedyTrial)(const CwCase *table, CwDesign *design);

// Looks for a change of `table`, which was refused with `message`, and writes it to `text`: "impeller.wrap_angle_deg:
// 120 works" or "it works without impeller.wrap_angle_deg". Returns whether one was found within 60 trials; failures of
// trials are cleared.
int cw_remedy_find(const CwCase *table, const char *message, CwRemedyTrial trial, char *text, size_t size);
