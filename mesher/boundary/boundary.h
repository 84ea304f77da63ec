// SPDX-License-Identifier: AGPL-3.0-or-later
// The boundary of a domain's mesh: all surfaces, each made once and shared by what lies on both sides.
//
//   wall        triangles on the CAD walls, cut at the partition planes
//   layer top   the wall moved to the outer ends of the layers: same triangles, same numbers
//   open patch  triangles on inlet, outlet and rotor/stator interface, inside the marched open edge
//   interface   triangles on the partition planes, inside the marched cut curves (paper, section 2.2)
//
// Each kind is a product of its own: WallCurves (wall_curves.h), SurfaceMesh (surface_mesh.h),
// Layers (layers.h), FreeCurves (free_curves.h), Interfaces (interfaces.h).
#pragma once

#include "mesher/boundary/free_curves.h"
#include "mesher/boundary/interfaces.h"
#include "mesher/boundary/surface_mesh.h"
#include "mesher/common/polygons.h"
#include "mesher/layers/layers.h"
#include "mesher/layers/pinched.h"
#include "mesher/network/network.h"
#include "mesher/network/periodic_images.h"
#include "mesher/parallel/context.h"
#include "mesher/surface/patch_mesh.h"

// What the surfaces of a domain follow from: finished products, which outlive them.
typedef struct {
  const CwCad *cad;
  const CwPlan *plan;
  const CwNetwork *network;
  const CwPeriodicImages *images;
  CwSizeAt size_at;
  const void *size;
  const CwPinched *pinched; // NULL: none
} CwBoundaryInput;

// A CAD edge whose division is given: parameters of its points but for corners of the network, ascending.
typedef struct {
  int32_t edge, count;
  double *t;
} CwDividedEdge;

// Edges shared with another domain (coupled_edges.h).
typedef struct {
  int32_t count, capacity;
  CwDividedEdge *edge;
} CwOpenEdges;

void cw_open_edges_free(CwOpenEdges *edges);

// Each stage reads the products before it and makes the next; where the solid has a symmetry that the plan has too,
// each set of periodic images of faces, curves, open patches and interfaces is meshed once and copied
// (periodic_images.h): tasks are only the first of each image set, and the results of the others are NULL.

// Divides all wall curves. Collective.
CwStatus cw_wall_curves_make(const CwContext *context, const CwBoundaryInput *in, const CwOpenEdges *edges,
                             CwWallCurves *curves);

// Meshes the wall face `face` (any rank); the result is a byte buffer for cw_surface_mesh_make. Triangles larger than
// an equilateral one on edges of `largest` (m; 0: none) are halved where shorter edges are wanted.
CwStatus cw_surface_mesh_face(const CwBoundaryInput *in, const CwWallCurves *curves, int32_t face, double largest,
                              void **bytes, int64_t *size);
// Joins the meshes of all wall faces (bytes[face]; NULL for open patches). Collective. Outcome: that of the first face
// without a mesh; CW_OUTCOME_REPLAN where a triangle reaches over a partition plane.
CwStatus cw_surface_mesh_make(const CwContext *context, const CwBoundaryInput *in, const CwWallCurves *curves,
                              void *const *bytes, CwSurfaceMesh *surface, CwOutcome *outcome);

// Grows the layer envelope to `target` thicknesses (m, per wall vertex) and sets the layer top; for its shape columns
// are thinned down to `least` (NULL: 0), and for the determinants of their layers turned (division NULL: not).
// Collective: all ranks work on it and have the same result. Outcome: that of cw_layers_make, CW_OUTCOME_ASYMMETRIC
// where no symmetric layer top is found.
CwStatus cw_boundary_grow(const CwContext *context, const CwBoundaryInput *in, const CwWallCurves *curves,
                          const CwSurfaceMesh *surface, const CwBackground *background, const double *target,
                          const double *least, const CwLayerDivision *division, CwLayers *layers, CwOutcome *outcome);

// Discretises the free curves between the ends of the layers; finds the interface polygons on every plane.
// Outcome: CW_OUTCOME_THIN where layers leave no room for that, with all places in free_curves->tight;
// CW_OUTCOME_ASYMMETRIC where the polygons are not symmetric.
CwStatus cw_free_curves_make(const CwBoundaryInput *in, const CwWallCurves *curves, const CwSurfaceMesh *surface,
                             const CwLayers *layers, CwFreeCurves *free_curves, CwOutcome *outcome);

// Meshes an open patch, or the polygon of outline `index` (any rank); results for cw_interfaces_make.
CwStatus cw_interfaces_open_patch(const CwBoundaryInput *in, const CwWallCurves *curves,
                                  const CwFreeCurves *free_curves, int32_t face, void **bytes, int64_t *size);
CwStatus cw_interfaces_polygon(const CwBoundaryInput *in, const CwFreeCurves *free_curves, int32_t index, void **bytes,
                               int64_t *size);
// Joins these. Takes nodes and outlines over: free_curves is empty after. Outcome: that of the first open patch without
// a mesh, or CW_OUTCOME_REPLAN where an interface has none.
CwStatus cw_interfaces_make(const CwBoundaryInput *in, CwFreeCurves *free_curves, void *const *open_patch_bytes,
                            void *const *interface_bytes, CwInterfaces *interfaces, CwOutcome *outcome);

// Brings x to the nearest point of what holds the column of a wall vertex: a plane, an open patch, a curve. `uv`: where
// on the open patch the search begins; else not read.
void cw_boundary_hold(const CwBoundaryInput *in, CwConstraint constraint, const double uv[2], double x[3]);

// Pairs of the domain's `regions` regions that share an interface, each once, smaller index first; caller frees.
CwStatus cw_interfaces_adjacency(const CwInterfaces *interfaces, int32_t regions, int32_t *pair_count,
                                 int32_t (**pair)[2]);
