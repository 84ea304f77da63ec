// SPDX-License-Identifier: AGPL-3.0-or-later
// One part of the domain seen along one direction: for every place along it the work below, the area of the section,
// the sharpest wall and the CAD edges that a plane there would graze. One pass over the part serves all offsets. Of one
// plane alone the same is had for less.
#pragma once

#include "mesher/plan/plan_model.h"

enum { CW_PROFILE_BINS = 256 };

typedef struct {
  double low, width;                 // m: bin b covers low + b width .. low + (b + 1) width
  double below[CW_PROFILE_BINS + 1]; // cells below the start of each bin
  double area[CW_PROFILE_BINS];      // m2, of the section, mean over the bin
  double worst[CW_PROFILE_BINS];     // least sqrt(1 - (n.m)^2) over the walls in the bin, layers included
  double cut[CW_PROFILE_BINS]; // of the nearest CAD edge it runs along, or end of one: 1 within half of its room, 0 at
                               // the room
} CwPlanProfile;

// From about samples_most of the part's samples, or all of fewer. Fails with nothing: a part without extent along the
// direction has width 0 and is of no use.
void cw_plan_profile(const CwPlanModel *model, const CwPlanPart *part, const double direction[3], int32_t samples_most,
                     CwPlanProfile *profile);

// Cells below a place, and the place below which so many cells are.
double cw_profile_below(const CwPlanProfile *profile, double place);
double cw_profile_place(const CwPlanProfile *profile, double cells);

int cw_profile_bin(const CwPlanProfile *profile, double place);

// What a plane meets: as in a bin of the profile.
typedef struct {
  double worst, cut;
} CwPlanPlace;

// Of one plane, where it lies on the positive side of `end` (NULL: everywhere).
CwPlanPlace cw_plan_place(const CwPlanModel *model, const CwPlanPart *part, const CwPlane *plane, const CwPlane *end);
// Of a plane with normal n, 0 where it crosses the CAD edge at this point of it, 1 where it runs along.
double cw_plan_along_edge(const CwPlanModel *model, int32_t e, const double n[3]);
// A plane that does not do, unless no other is there either: no sum of faults (plan_cost.h) is as much.
#define CW_PLAN_UNFIT 1e3

// How near one plane, where it lies on the positive side of `end` (NULL: everywhere), comes to an edge that it runs
// along: 0 where there is room for triangles between both, 1 where both are one; CW_PLAN_UNFIT where it crosses the end
// of a left-out face.
double cw_plan_touch(const CwPlanModel *model, const CwPlanPart *part, const CwPlane *plane, const CwPlane *end);
// The same of all planes with normal n at the places low, low + step, ...
void cw_plan_touches(const CwPlanModel *model, const CwPlanPart *part, const double n[3], double low, double step,
                     int32_t count, double *touch);
CwPlanPlace cw_profile_at(const CwPlanProfile *profile, int bin);
