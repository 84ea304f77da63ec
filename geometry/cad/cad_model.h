// SPDX-License-Identifier: AGPL-3.0-or-later
// What the patches of a pump from CAD files are to mesher and solver: the flow along each wall, from the operating
// point and from radii and areas as measured; groups; what turns; interfaces. Fills the model of pipeline/model.h.
//
// Speeds: at the wheel the mean of w1 and w2, with u2 at the wheel's radius, Q over the area of its interface, and the
// swirl that the head needs (Euler, at a hydraulic efficiency of 0.85), and w1 at the mean eye of those through which
// water enters the wheel; downstream of it the swirl at the interface; in pipes the flow over the area of the opening.
// Each wheel has its own radii and its share of the operating point (cad_wheel.h); what stands still has those of the
// wheel beside it. Blades, hubs and shrouds of what stands still have the speed of its other walls, of guide wheels as
// of side chambers. Between two blades the pitch at the outlet counts, with splitters.
#pragma once

#include "geometry/cad/cad_interface.h"
#include "pipeline/model.h"

#ifdef __cplusplus
extern "C" {
#endif

// The model of unit `unit`, m. Free with cw_model_free(), also after a failure; zeroed `model` on entry. CW_ERR_INPUT
// where the pump has no inlet or no outlet, a wheel has no wall, no interface or no second opening, or no water
// leads to a part.
CwStatus cw_cad_model_make(const CwCase *table, const CwSurvey *survey, const CwFacePatches *patches,
                           int interface_count, const CwCadInterface *interfaces, int blade_count, double unit,
                           CwModel *model);

#ifdef __cplusplus
}
#endif
