// SPDX-License-Identifier: AGPL-3.0-or-later
// Steps of the skeleton that know its orbits (orbit.h).
#ifndef CUTWATER_MESHER_SKELETON_ORBIT_SKELETON_H
#define CUTWATER_MESHER_SKELETON_ORBIT_SKELETON_H

#include "mesher/layers/layers.h"
#include "mesher/skeleton/skeleton.h"

// Makes the turned copies of curve `first`, which is divided. Ends are those of `corner_node`, nodes between them lie
// at *x (which `add` may move) and are made by `add`.
typedef CwStatus (*CwAddCurveNode)(CwSkeleton *skeleton, const CwCurve *curve, const double x[3], int32_t *node);
CwStatus cw_orbit_copy_curve(CwSkeleton *skeleton, int32_t first, const int32_t *corner_node, double (*const *x)[3],
                             CwAddCurveNode add);

// Finds the orbits of the outlines on all planes. Outcome: CW_OUTCOME_ASYMMETRIC where they are not symmetric.
CwStatus cw_orbit_outlines(CwSkeleton *skeleton, CwOutcome *outcome);

// The layers of the whole wall `input` of a skeleton with orbits: grown over the first of each orbit with what stands
// near them, copied, and checked as copied. Collective. Outcome: CW_OUTCOME_ASYMMETRIC where no symmetric front is
// found, CW_OUTCOME_REPLAN where no column leaves the wall on a plane.
CwStatus cw_orbit_layers(const CwSkeleton *skeleton, const CwLayerInput *input, CwLayers *layers, CwOutcome *outcome);

// The least of the members of the orbit of wall vertex v that are on first faces (is_first), -1 where none is.
int32_t cw_orbit_first_member(const CwSkeletonOrbits *orbits, const uint8_t *is_first, int32_t v);

// Makes the wall triangles that are copies anew, from those that they are copies of.
void cw_orbit_copy_triangles(CwSkeleton *skeleton);

#endif
