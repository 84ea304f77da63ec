// SPDX-License-Identifier: AGPL-3.0-or-later
// The boundary of a domain's mesh: all surfaces, each made once and shared by what lies on both sides.
//
//   wall        triangles on the CAD walls, cut at the partition planes
//   layer top   the wall moved to the outer ends of the layers: same triangles, same numbers
//   open patch  triangles on inlet, outlet and rotor/stator interface, inside the marched open edge
//   interface   triangles on the partition planes, inside the marched cut curves (paper, section 2.2)
//
// Each kind is a product of its own: SurfaceMesh (surface_mesh.h), Layers (layers.h), Interfaces (interfaces.h).
#ifndef CUTWATER_MESHER_BOUNDARY_BOUNDARY_H
#define CUTWATER_MESHER_BOUNDARY_BOUNDARY_H

#include "mesher/boundary/interfaces.h"
#include "mesher/boundary/surface_mesh.h"
#include "mesher/common/polygons.h"
#include "mesher/layers/layers.h"
#include "mesher/network/network.h"
#include "mesher/network/periodic_images.h"
#include "mesher/surface/patch_mesh.h"

// A CAD edge whose division is given: parameters of its points but for corners of the network, ascending.
typedef struct {
  int32_t edge, count;
  double *t;
} CwDividedEdge;

typedef struct {
  const CwCad *cad;
  const CwPlan *plan;
  CwNetwork network;
  CwPeriodicImages images;
  int32_t open_edge_count;
  CwDividedEdge *open_edge; // of edges shared with another domain, by cw_couple_open_edges
  CwSizeAt size_at;
  const void *size;
  double *largest; // m, by patch: wall triangles larger than with such edges are halved (patch_mesh.h); NULL: none

  CwWallCurves wall_curves; // cw_wall_curves_make
  CwSurfaceMesh surface;    // cw_surface_mesh_make
  CwLayers layers;          // cw_boundary_grow
  CwInterfaces interfaces;  // cw_boundary_free_curves, cw_boundary_merge_inner, cw_interface_rule_merge
} CwBoundary;

// Where the solid has a symmetry that the plan has too, each set of periodic images of faces, curves, open patches and
// interfaces is meshed once and copied (periodic_images.h): tasks are only the first of each image set, and the results
// of the others are NULL.

// Divides all wall curves. The network must be made, and the open edges be coupled. Collective.
CwStatus cw_wall_curves_make(const CwBoundary *boundary, CwWallCurves *curves);

// Meshes the wall face `face` (any rank); the result is a byte buffer for cw_surface_mesh_make.
CwStatus cw_boundary_mesh_wall(const CwBoundary *boundary, int32_t face, void **bytes, int64_t *size);
// Joins the meshes of all wall faces (bytes[face]; NULL for open patches). Collective.
CwStatus cw_surface_mesh_make(const CwBoundary *boundary, void *const *bytes, CwSurfaceMesh *surface);

// Grows the layer envelope to `target` thicknesses (m, per wall vertex) and sets the layer top; for its shape columns
// are thinned down to `least` (NULL: 0), and for the determinants of their layers turned (division NULL: not).
// Collective: all ranks work on it and have the same result. Outcome: CW_OUTCOME_ASYMMETRIC where no symmetric layer
// top is found, CW_OUTCOME_REPLAN where no column leaves the wall on a plane.
CwStatus cw_boundary_grow(const CwBoundary *boundary, const CwBackground *background, const double *target,
                          const double *least, const CwLayerDivision *division, CwLayers *layers, CwOutcome *outcome);

// Discretises the free curves between the ends of the layers; finds the interface polygons on every plane.
// Outcome: CW_OUTCOME_THIN where layers leave no room for that, with all places in interfaces->tight;
// CW_OUTCOME_ASYMMETRIC where the polygons are not symmetric.
CwStatus cw_boundary_free_curves(const CwBoundary *boundary, CwInterfaces *interfaces, CwOutcome *outcome);

// Meshes open patch or interface outline `index`; results for cw_boundary_merge_inner.
CwStatus cw_boundary_mesh_open_patch(const CwBoundary *boundary, int32_t face, void **bytes, int64_t *size);
CwStatus cw_boundary_mesh_interface(const CwBoundary *boundary, int32_t outline, void **bytes, int64_t *size);
CwStatus cw_boundary_merge_inner(const CwBoundary *boundary, void *const *open_patch_bytes,
                                 void *const *interface_bytes, CwInterfaces *interfaces);

// Brings x to the nearest point of what holds the column of a wall vertex: a plane, an open patch, a curve. `uv`: where
// on the open patch the search begins; else not read.
void cw_boundary_hold(const CwBoundary *boundary, CwConstraint constraint, const double uv[2], double x[3]);

void cw_boundary_free(CwBoundary *boundary);

// Pairs of regions that share an interface, each once, smaller index first; caller frees.
CwStatus cw_boundary_adjacency(const CwBoundary *boundary, int32_t *pair_count, int32_t (**pair)[2]);

#endif
