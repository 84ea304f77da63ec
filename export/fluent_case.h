// SPDX-License-Identifier: AGPL-3.0-or-later
// fluent/: what stands beside pump.msh.
#pragma once

#include "export/assembly.h"
#include "pipeline/case.h"

// Writes README.md: the zones of the mesh and what a set-up of the case asks of them. CW_ERR_IO.
CwStatus cw_fluent_case_write(const char *folder, const CwCase *table, const CwAssembly *assembly);
