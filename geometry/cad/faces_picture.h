// SPDX-License-Identifier: AGPL-3.0-or-later
// A picture of the faces of one part, each with its number as faces_sheet.csv has it: seen from four sides from
// outside, and from the same sides with the near faces taken away. SVG with shaded views in it.
#pragma once

#include "geometry/cad/survey.h"

#ifdef __cplusplus
extern "C" {
#endif

// Faces with room for it have their number in each view, all others where most of them is seen; those that no view
// shows are listed below. Of a face without triangles its edges are drawn. `place`, in the pump's coordinates, m, is
// marked in each view where it is not NULL.
CwStatus cw_faces_picture_write(const CwSurvey *survey, int part, const char *title, const double *place,
                                const char *path);

#ifdef __cplusplus
}
#endif
