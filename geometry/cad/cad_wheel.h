// SPDX-License-Identifier: AGPL-3.0-or-later
// The wheels of a pump from CAD files, as measured: each is what rotates and is joined by interfaces to the rest of it.
// Several on one axis share the operating point. A wheel from which water comes to an inlet and to an outlet by no
// other wheel works in parallel with others of its kind: all the head, an equal part of the flow. Others are stages in
// series: all the flow, the head in the ratio of their u2 squared.
#pragma once

#include "geometry/cad/cad_interface.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  int part;            // the first of it
  double radius;       // of its blades, where it has none of all of it, m
  double reach, width; // of its outlet, the interface with what stands still that lies farthest out, m; 0: none
  double eye_area;     // through which water enters it, from outside or from what comes before; 0: not known, m2
  int eyes;
  int openings;                  // inlets, outlets and surfaces of its interfaces
  int blades;                    // side by side at its outlet, splitters among them
  double flow_share, head_share; // of the operating point
} CwCadWheel;

typedef struct {
  int count, largest;
  CwCadWheel *wheel; // in the order of their first parts
  int *of_part;      // of a part that stands still the wheel whose interface with it reaches farthest, else the largest
} CwCadWheels;

// `passages`: equal ones of all that rotates. A part that rotates must be there. Free also after a failure.
CwStatus cw_cad_wheels_make(const CwCaseCad *cad, const CwSurvey *survey, const CwFacePatches *patches,
                            int interface_count, const CwCadInterface *interfaces, int passages, CwCadWheels *wheels);
void cw_cad_wheels_free(CwCadWheels *wheels);

// Sets of faces that hang together by edges. [in,out] first: of each face its number, then the least of its set; -1: it
// takes no part. Returns how many sets there are.
int cw_cad_join_faces(const CwSurvey *survey, int *first);

// Whether the water in a part has not yet been through a wheel: it has an inlet and no outlet.
int cw_cad_is_before(const CwFacePatches *patches, int part);

#ifdef __cplusplus
}
#endif
