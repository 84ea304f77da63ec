// SPDX-License-Identifier: AGPL-3.0-or-later
// The stator's B-rep: interface cylinder, neck, step to b3, volute, tongue, diffuser and discharge pipe as
// one closed solid, built directly from analytic and B-spline surfaces with shared edges; no booleans, no
// seams.
#pragma once

#include "geometry/solid.h"
#include "geometry/volute.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Builds the solid in the model unit (m, see solid.h) and checks it as stator_check.hpp says. Its patches:
// stator_interface, neck, step, volute, tongue (nose and flank), diffuser, discharge, outlet. Fails with
// CW_ERR_GEOMETRY and one line that says what does not fit. Freed by cw_solid_free().
CwStatus cw_stator_build(const CwVolute *volute, double unit, CwSolid **stator);

#ifdef __cplusplus
}
#endif
