// SPDX-License-Identifier: AGPL-3.0-or-later
// The orbits of a skeleton whose solid and plan have a symmetry: of its corners, curves, nodes and interface outlines.
// The first of each orbit is made, the others are copies of it, turned, with the same numbers on both sides of every
// seam.
#ifndef CUTWATER_MESHER_NETWORK_ORBIT_H
#define CUTWATER_MESHER_NETWORK_ORBIT_H

#include "mesher/cad/symmetry.h"
#include "mesher/network/network.h"

typedef struct {
  const CwSymmetry *symmetry; // NULL: none, every item stands for itself
  CwOrbits corner, curve, outline;
  // Of each node: where one turn takes it, -1: nowhere (it lies inside of a fixed face); turns from the first.
  int32_t node_capacity, *node_next, *node_turns;
} CwSkeletonOrbits;

// Finds the orbits of corners and curves and makes each the turned copy of its first. Outcome: CW_OUTCOME_ASYMMETRIC
// where the network is not symmetric: where a plane grazes something, the passages may have been traced differently.
CwStatus cw_orbit_network(CwNetwork *network, CwSkeletonOrbits *orbits, CwOutcome *outcome);
void cw_orbit_free(CwSkeletonOrbits *orbits);

// Notes that one turn takes `node` to `next`, which is `turns` turns from the first of its orbit.
CwStatus cw_orbit_link(CwSkeletonOrbits *orbits, int32_t node, int32_t next, int32_t turns);
int32_t cw_orbit_node(const CwSkeletonOrbits *orbits, int32_t node, int32_t turns);
int32_t cw_orbit_node_turns(const CwSkeletonOrbits *orbits, int32_t node);

// Copies to be made of an item, itself included, and the `turns`-th of them; without symmetry 1 and itself. A copy that
// is not the first has turns.
static inline int32_t cw_orbit_copies(const CwSkeletonOrbits *orbits, const CwOrbits *of, int32_t item) {
  return orbits->symmetry ? cw_orbits_size(of, orbits->symmetry->count, item) : 1;
}
static inline int32_t cw_orbit_turns(const CwSkeletonOrbits *orbits, const CwOrbits *of, int32_t item) {
  return orbits->symmetry ? of->turns[item] : 0;
}
int32_t cw_orbit_face_copies(const CwSkeletonOrbits *orbits, int32_t face);
int32_t cw_orbit_face(const CwSkeletonOrbits *orbits, int32_t face, int32_t turns);
void cw_orbit_point(const CwSkeletonOrbits *orbits, int32_t turns, const double x[3], double turned[3]);
int32_t cw_orbit_region(const CwSkeletonOrbits *orbits, const CwPlan *plan, int32_t region, int32_t turns);
int32_t cw_orbit_region_first(const CwSkeletonOrbits *orbits, const CwPlan *plan, int32_t region);

#endif
