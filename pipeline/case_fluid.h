// SPDX-License-Identifier: AGPL-3.0-or-later
// Density, viscosity and vapour pressure of the fluid where the case gives its temperature instead: those of water.
#pragma once

#include "pipeline/case.h"
#include "pipeline/case_check.h"

// Sets what the case leaves out of `table->fluid`: with a temperature density and viscosity of water there; in any case
// the vapour pressure, of water at the temperature or at 20 degrees Celsius. `places`: one a key of the schema. Fails
// with CW_ERR_INPUT and one line where a given density or viscosity is not that of water at the given temperature.
CwStatus cw_case_fluid(const char *path, const CwCasePlace *places, CwCase *table);
