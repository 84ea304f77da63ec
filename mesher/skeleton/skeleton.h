// SPDX-License-Identifier: AGPL-3.0-or-later
// The skeleton of a domain's mesh: all surfaces, each made once and shared by what lies on both sides.
//
//   wall        triangles on the CAD walls, cut at the dividing planes
//   front       the wall moved to the outer ends of the layers: same triangles, same numbers
//   cap         triangles on inlet, outlet and rotor/stator interface, inside the marched rim
//   interface   triangles on the dividing planes, inside the marched cut curves (paper, section 2.2)
//
// Each kind is a product of its own: SurfaceMesh (surface_mesh.h), Layers (layers.h), Interfaces (interfaces.h).
#ifndef CUTWATER_MESHER_SKELETON_SKELETON_H
#define CUTWATER_MESHER_SKELETON_SKELETON_H

#include "mesher/common/polygons.h"
#include "mesher/layers/layers.h"
#include "mesher/network/network.h"
#include "mesher/network/orbit.h"
#include "mesher/skeleton/interfaces.h"
#include "mesher/skeleton/surface_mesh.h"
#include "mesher/surface/patch_mesh.h"

// A CAD edge whose division is given: parameters of its points but for corners of the network, ascending.
typedef struct {
  int32_t edge, count;
  double *t;
} CwSkeletonRim;

typedef struct {
  const CwCad *cad;
  const CwPlan *plan;
  CwNetwork network;
  CwSkeletonOrbits orbits;
  int32_t rim_count;
  CwSkeletonRim *rim; // of edges shared with another domain, by cw_couple_rims
  CwSizeAt size_at;
  const void *size;
  double *largest; // m, by patch: wall triangles larger than with such edges are halved (patch_mesh.h); NULL: none

  CwSurfaceMesh surface;   // cw_skeleton_wall_curves, cw_skeleton_merge_walls; cw_skeleton_grow flips edges
  CwLayers layers;         // cw_skeleton_grow
  CwInterfaces interfaces; // cw_skeleton_free_curves, cw_skeleton_merge_inner, cw_interface_rule_merge
} CwSkeleton;

// Where the solid has a symmetry that the plan has too, each orbit of faces, curves, caps and interfaces is meshed once
// and copied (orbit.h): tasks are only the first of each orbit, and the results of the others are NULL.

// Discretises all wall curves; makes their vertices. The network must be made, and the rims be coupled. Collective.
CwStatus cw_skeleton_wall_curves(CwSkeleton *skeleton);

// Meshes the wall face `face` (any rank); the result is a byte buffer for cw_skeleton_merge_walls.
CwStatus cw_skeleton_mesh_wall(const CwSkeleton *skeleton, int32_t face, void **bytes, int64_t *size);
// Joins the meshes of all wall faces (bytes[face]; NULL for caps). Collective.
CwStatus cw_skeleton_merge_walls(CwSkeleton *skeleton, void *const *bytes);

// Grows the envelope of the layers to `target` heights (m, per wall vertex) and sets the front; for its shape columns
// are thinned down to `least` (NULL: 0), and for the determinants of their layers turned (division NULL: not).
// Collective: all ranks work on it and have the same result. Outcome: CW_OUTCOME_ASYMMETRIC where no symmetric front is
// found, CW_OUTCOME_REPLAN where no column leaves the wall on a plane.
CwStatus cw_skeleton_grow(CwSkeleton *skeleton, const CwBackground *background, const double *target,
                          const double *least, const CwLayerDivision *division, CwOutcome *outcome);

// Discretises the free curves between the ends of the layers; finds the interface polygons on every plane.
// Outcome: CW_OUTCOME_THIN where layers leave no room for that, with all places in skeleton->interfaces.tight;
// CW_OUTCOME_ASYMMETRIC where the polygons are not symmetric.
CwStatus cw_skeleton_free_curves(CwSkeleton *skeleton, CwOutcome *outcome);

// Meshes cap face or interface outline `index`; results for cw_skeleton_merge_inner.
CwStatus cw_skeleton_mesh_cap(const CwSkeleton *skeleton, int32_t face, void **bytes, int64_t *size);
CwStatus cw_skeleton_mesh_interface(const CwSkeleton *skeleton, int32_t outline, void **bytes, int64_t *size);
CwStatus cw_skeleton_merge_inner(CwSkeleton *skeleton, void *const *cap_bytes, void *const *interface_bytes);

void cw_skeleton_free(CwSkeleton *skeleton);

// Pairs of regions that share an interface, each once, smaller index first; caller frees.
CwStatus cw_skeleton_adjacency(const CwSkeleton *skeleton, int32_t *pair_count, int32_t (**pair)[2]);

int cw_face_is_wall(const CwCad *cad, int32_t face);

#endif
