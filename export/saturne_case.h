// SPDX-License-Identifier: AGPL-3.0-or-later
// code_saturne/: a frozen rotor on pump.cgns for code_saturne 6.
#pragma once

#include "export/assembly.h"
#include "pipeline/case.h"

// Writes the script, its README.md and the sources that set code_saturne up. CW_ERR_IO.
CwStatus cw_saturne_case_write(const char *folder, const CwCase *table, const CwAssembly *assembly);
