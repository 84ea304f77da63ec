// SPDX-License-Identifier: AGPL-3.0-or-later
// The skeleton of a domain's mesh: all surfaces, each made once and shared by what lies on both sides.
//
//   wall        triangles on the CAD walls, cut at the dividing planes
//   front       the wall moved to the outer ends of the layers: same triangles, same numbers
//   cap         triangles on inlet, outlet and rotor/stator interface, inside the marched rim
//   interface   triangles on the dividing planes, inside the marched cut curves (paper, section 2.2)
//
// Nodes 0 .. wall_count-1 stand on the front, one over each wall vertex; the others lie on free curves, caps and
// interfaces.
#ifndef CUTWATER_MESHER_SKELETON_SKELETON_H
#define CUTWATER_MESHER_SKELETON_SKELETON_H

#include "mesher/common/polygons.h"
#include "mesher/layers/layers.h"
#include "mesher/network/network.h"
#include "mesher/network/orbit.h"
#include "mesher/surface/patch_mesh.h"

// The surface or curve that holds the column of a wall vertex on a rim or on a dividing plane.
typedef enum { CW_GUIDE_NONE, CW_GUIDE_PLANE, CW_GUIDE_CAP, CW_GUIDE_CURVE } CwGuideKind;

typedef struct {
  CwGuideKind kind;
  int32_t index; // plan node, CAD face or curve of the network
} CwGuide;

// One outline on a dividing plane: an interface between two regions.
typedef struct {
  int32_t node;         // plan node of its plane
  int32_t corner_count; // of all loops
  int32_t loop_count;
  int32_t *loop_start; // loop_count + 1
  int32_t *corner;     // skeleton nodes
  // Set when the inner surfaces are merged:
  int32_t free_start, free_count;         // its inner nodes, as planned
  int32_t triangle_start, triangle_count; // its triangles as planned,
  int32_t refined_start, refined_count;   // and by the rule of region numbers
} CwInterfaceOutline;

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

  int32_t wall_count, wall_capacity;
  double (*wall_x)[3];
  CwGuide *guide;
  int32_t *corner_vertex; // wall vertex of each corner of the network, or -1
  int32_t wall_triangle_count;
  int32_t (*wall_triangle)[3], *wall_face, *wall_region;
  int32_t *region_wall_start, *region_wall; // wall triangles of each region, ascending
  int32_t *wall_source;                     // the wall triangle that this one is a copy of, turned; or itself
  double (*front)[3], *height;
  uint8_t *reason;

  int32_t node_count, node_capacity;
  double (*node_x)[3];
  uint8_t *on_plane;    // node (and its column) is shared by regions
  int32_t *corner_node; // skeleton node of each corner, or -1

  int32_t tight_count; // places where layers leave no room for a free curve, or front and free curves cross
  double (*tight)[3];

  int32_t cap_triangle_count;
  int32_t (*cap_triangle)[3], *cap_face, *cap_region;
  int32_t outline_count;
  CwInterfaceOutline *outline;
  int32_t interface_triangle_count;
  int32_t (*interface_triangle)[3], (*interface_region)[2]; // normal from region [0] to region [1]
  // The interfaces before the rule of region numbers (interface_rule.h); NULL without it.
  int32_t planned_triangle_count;
  int32_t (*planned_triangle)[3], (*planned_region)[2];
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
// Outcome: CW_OUTCOME_THIN where layers leave no room for that, with all places in skeleton->tight;
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
