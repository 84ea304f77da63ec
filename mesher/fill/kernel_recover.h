// SPDX-License-Identifier: AGPL-3.0-or-later
// Brings boundary triangles that the Delaunay mesh does not have into it, by flips.
#ifndef CUTWATER_MESHER_FILL_KERNEL_RECOVER_H
#define CUTWATER_MESHER_FILL_KERNEL_RECOVER_H

#include "mesher/fill/kernel_facets.h"
#include "mesher/fill/kernel_flips.h"

#ifdef __cplusplus
extern "C" {
#endif

// What is to be recovered: the edge of the first two points, or the face of all three.
typedef struct {
  const CwTetMesh *mesh;
  int32_t point[3];
} CwRecoveryGoal;

typedef struct {
  CwFlips flips;
  const CwFacets *facets;
  CwRecoveryGoal goal;
  uint32_t random;
} CwRecovery;

// `recovery` must stay where it is until it is freed.
CwStatus cw_recovery_make(CwTetMesh *mesh, const CwFacets *facets, uint32_t seed, CwRecovery *recovery);
void cw_recovery_free(CwRecovery *recovery);
// By flips alone, with `tries` searches, each deeper than the last but one. *found is 0 where that is not enough.
CwStatus cw_recovery_edge(CwRecovery *recovery, int32_t a, int32_t b, int tries, int *found);
// The face whose edges are there.
CwStatus cw_recovery_face(CwRecovery *recovery, const int32_t corner[3], int tries, int *found);

// Takes the missing ones of *facets, edges first; facets that are there stay. Those that cannot be recovered
// stay missing. `inner` and missing_count of *facets, which cw_facets_locate has found, are kept true. Another `round`
// tries other flips. Adds what was flipped to *flips. Deterministic.
CwStatus cw_kernel_recover(CwTetMesh *mesh, CwFacets *facets, int round, int64_t *flips);

#ifdef __cplusplus
}
#endif
#endif
