// SPDX-License-Identifier: AGPL-3.0-or-later
// The stator's B-rep: interface cylinder, neck, step to b3, volute, tongue, diffuser and discharge pipe as one closed
// solid, built directly from analytic and B-spline surfaces with shared edges; no booleans, no seams.
#ifndef CUTWATER_GEOMETRY_STATOR_H
#define CUTWATER_GEOMETRY_STATOR_H

#include "geometry/volute_design.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CwStator CwStator;

// Builds and checks the solid: closed, valid by OpenCASCADE's check, largest tolerance below 1e-3 mm. Fails with
// CW_ERR_GEOMETRY and one line that says what does not fit, or CW_ERR_LIBRARY. The caller frees *stator.
CwStatus cw_stator_build(const CwVolute *volute, CwStator **stator);
void cw_stator_free(CwStator **stator);

// Faces in the order of TopExp::MapShapes, 0-based here. The patch is one of stator_interface, neck, step, volute,
// tongue, diffuser, discharge, outlet; the kind is wall, interface or outlet; the name is unique ("volute_2").
int cw_stator_face_count(const CwStator *stator);
const char *cw_stator_face_patch(const CwStator *stator, int face);
const char *cw_stator_face_kind(const CwStator *stator, int face);
const char *cw_stator_face_name(const CwStator *stator, int face);

double cw_stator_volume(const CwStator *stator);            // m3
double cw_stator_largest_tolerance(const CwStator *stator); // m

#ifdef __cplusplus
}
#endif
#endif
