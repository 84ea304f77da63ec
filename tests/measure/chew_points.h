// SPDX-License-Identifier: AGPL-3.0-or-later
// Delaunay refinement of one region by circumcentres (L. P. Chew, 1989; J. R. Shewchuk, 1998) against the size field,
// on the project's Delaunay kernel. The mesh is that of all points, in the convex hull: interface triangles are in it
// as long as their spheres are empty, and the last step recovers what is missing of the fixed ones. Layer top and open
// patches are fixed: a centre near them, or in their spheres, is left out, as in a fill. A centre in the sphere of an
// interface triangle is put aside, and the triangle's split is asked for.
#pragma once

#include "chew_interfaces.h"
#include "mesher/cad/rays.h"
#include "mesher/common/box_tree.h"
#include "mesher/fill/delaunay.h"
#include "mesher/fill/fill_reach.h"
#include "mesher/region/region_boundary.h"

// When a tetrahedron is refined.
typedef struct {
  double radius; // of its sphere, in h: greater ones are
  double ratio;  // of its radius to its shortest edge: so are greater ones
} CwChewBounds;

enum { CW_CHEW_SPLIT = -2 }; // source of the first split; the others count down

// Tetrahedra, by number and corners.
typedef struct {
  int32_t tet;
  uint32_t print;
} CwChewTet;

// A point of an interface that was split: by the numbers of both.
typedef struct {
  int32_t interface, point;
} CwChewSplit;

// The fields are the region's boundary, the trees that say what is near a place, the mesh, and what a round asks for.
typedef struct {
  int32_t region;
  CwRegionBoundary inner; // with the interfaces as planned
  CwRays *rays;           // of that
  double across;          // longer than any way through it, m
  CwReachBox *box;        // of the fixed triangles
  CwReachBall *ball;
  CwBoxTree fixed;
  CwTetMesh mesh;     // source: node of `inner`; from its node_count on, points of the refinement; -2 - k: split k
  CwChewSplit *split; // in the order in which they came
  int32_t split_count, split_space;
  CwDelaunayInsertion *insertion;
  uint32_t *judged; // of each tetrahedron: the print of that which was judged there last
  int32_t judged_space;
  CwChewSphere *sphere; // of this round's interfaces
  int32_t sphere_count, sphere_space;
  uint8_t *sphere_asked;
  CwBoxTree spheres;
  CwChewTet *deferred; // whose centres lie in spheres that can be split
  int32_t deferred_count, deferred_space;
  CwChewAsked *asked; // one point for each sphere
  int32_t asked_count, asked_space;
} CwChewRegion;

CwStatus cw_chew_region_open(const CwRegionInput *from, int32_t region, CwChewRegion *made);
void cw_chew_region_close(CwChewRegion *region);

// The points of splits of interface `index`, from number `first` of its points on.
CwStatus cw_chew_region_add(CwChewRegion *region, const CwChewInterface *interface, int32_t index, int32_t first);

// Refines until every tetrahedron is within the bounds or its centre cannot be had, against the spheres of
// interface[0..count) that the region has. Fills `asked`. Deterministic.
CwStatus cw_chew_region_refine(const CwRegionInput *from, const CwChewBounds *bounds, int32_t count,
                               const CwChewInterface *interface, CwChewRegion *region);
