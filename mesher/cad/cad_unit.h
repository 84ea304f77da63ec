// SPDX-License-Identifier: AGPL-3.0-or-later
// The unit of the B-rep files of a folder.
#pragma once

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Reads the unit, m, from GEOMETRY_DIR/model.json; 1 mm, as of most CAD files, where there is no such file. Fails with
// CW_ERR_IO or CW_ERR_INPUT where the file says nothing of it.
CwStatus cw_cad_unit_read(const char *geometry_dir, double *unit);

#ifdef __cplusplus
}
#endif
