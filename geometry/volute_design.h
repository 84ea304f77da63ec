// SPDX-License-Identifier: AGPL-3.0-or-later
// The design of the volute; see volute.h for its shape and names.
#pragma once

#include "geometry/volute.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Designs the volute. Fails with CW_ERR_DESIGN and one line that names the quantity and its allowed range.
CwStatus cw_volute_design(const CwVoluteInput *input, CwVolute *volute);

#ifdef __cplusplus
}
#endif
