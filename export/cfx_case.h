// SPDX-License-Identifier: AGPL-3.0-or-later
// The set-up of the paper for ANSYS CFX, in its command language, on pump.cgns.
#pragma once

#include "export/assembly.h"
#include "pipeline/case.h"

// Writes the set-up into `folder`. One rank calls it. CW_ERR_IO.
CwStatus cw_cfx_case_write(const char *folder, const CwCase *table, const CwAssembly *assembly);
