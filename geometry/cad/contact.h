// SPDX-License-Identifier: AGPL-3.0-or-later
// Where parts touch: faces that coincide with faces of another part, wholly or in part, however they are cut there.
// Found by points inside the faces, so that it needs no boolean operation.
#pragma once

#include "geometry/cad/survey.h"
#include "pipeline/log.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  int part;     // that the face touches; -1: none
  double share; // of the face's points that touch it
  int other;    // a face of that part that it touches, into CwSurvey.face
  double gap;   // of its other points that face that part nearby the greatest distance, m; 0: none does
  double at[3]; // where that is
} CwContact;

// One contact for each face of the survey; `contact` holds face_count of them. `tolerance`: greatest distance, m.
// CW_ERR_GEOMETRY where a face touches two parts, or runs along one at a gap that is greater, but for the wheel's size
// so small that it must be meant to touch: with its size and place in the file.
CwStatus cw_contact_find(const CwCadParts *parts, const CwSurvey *survey, const CwCadFrame *frame, const CwCaseCad *cad,
                         double tolerance, CwContact *contact);

// Whether a face stands before a sample of another part: faces that only share an edge come as near as those that
// coincide.
int cw_contact_faces(const CwSurvey *survey, const CwSurveySample *sample, int other);

// Cuts the faces that touch another part with a share of theirs along the outline of the other's faces, so that each
// touches wholly or not at all. Edges of both that lie within two tolerances are one: that far apart are those of faces
// which meet at 60 degrees or more, each off by one. *cut: how many there were. Faces are counted anew after it.
CwStatus cw_contact_imprint(const CwSurvey *survey, const CwContact *contact, double tolerance, CwLog *log,
                            CwCadParts *parts, int *cut);

#ifdef __cplusplus
}
#endif
