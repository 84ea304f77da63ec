// SPDX-License-Identifier: AGPL-3.0-or-later
// design.json: every derived dimension with its unit in its key, where it comes from, and what was measured.
#pragma once

#include <jansson.h>

#include "geometry/design.h"
#include "geometry/pump.h"
#include "pipeline/status.h"

// The measured values as a JSON object: lengths in m, angles in degrees. NULL where memory is out.
json_t *cw_measured_json(const CwMeasuredPump *measured);

// Writes the design and the measured values, whole or not at all.
CwStatus cw_design_file_write(const CwDesign *design, const CwMeasuredPump *measured, const char *path);
