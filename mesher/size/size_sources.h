// SPDX-License-Identifier: AGPL-3.0-or-later
// What asks for a size, and where: patch sizes and curvature all over the surface, gaps, narrow faces, short
// edges.
#pragma once

#include "mesher/cad/background.h"
#include "mesher/cad/cad.h"
#include "mesher/cad/scanlines.h"
#include "mesher/size/size_grid.h"
#include "pipeline/case.h"
#include "pipeline/status.h"

typedef struct {
  const CwCad *cad;
  const CwBackground *background;
  const CwMeshTable *table;
  const double *patch_size;     // relative, by patch
  double base_size;             // m
  const double *open_edge_size; // m, by patch, or NULL: see CwSizeLimits
} CwSizeInput;

// What the seeds of all faces follow from: rays through the domain, its creases, and a grid to seed one face at
// a time on.
typedef struct CwSizeSurface CwSizeSurface;

// The grid the seeds are for is that of cw_size_surface_grid. The input is copied; what it points to must
// outlive the surface.
CwStatus cw_size_surface_make(const CwSizeInput *input, CwSizeSurface **surface);
void cw_size_surface_free(CwSizeSurface **surface);

// The grid over the domain, without values; every rank comes to the same one.
void cw_size_surface_grid(const CwSizeInput *input, CwSizeGrid *grid);

// Seeds of one face, packed (malloc'd): min(patch size, curvature, gap) all over it. Curvature asks for at
// least two fifths of the patch size. A gap is seen by a ray along the inward normal that leaves the domain
// through a facing triangle; walls that meet in a crease there are not a gap.
CwStatus cw_size_seed_face(CwSizeSurface *surface, int face, void **bytes, int64_t *byte_count);

// Lowers the nodes of the grid by packed seeds; the order of faces does not matter. Of a seed counts
// `share`, but no less than open edges are granted of it or, where it is longer, of `base` (m), and no more than
// `most`.
void cw_size_take_seeds(CwSizeGrid *grid, const void *bytes, double share, double base, double most);

// The same for those CAD edges that are creases: the length of a short one, and the width of the face between two that
// have no vertex in common.
CwStatus cw_size_seed_creases(CwSizeSurface *surface, void **bytes, int64_t *byte_count);
// Seeds `grid` with these.
CwStatus cw_size_seed_edges(const CwSizeInput *input, CwSizeGrid *grid);

// Lines through the domain, one in each square of the grid's cells across x.
CwStatus cw_size_surface_lines(const CwSizeSurface *surface, CwScanlines *lines);

// Seeds `grid` with the sizes that open edges of walls allow, along them.
void cw_size_seed_open_edges(const CwSizeInput *input, CwSizeGrid *grid);
// The mean along the open edges of what they allow over the sizes of `wanted`; 0 without open edges.
double cw_size_open_edges_ask(const CwSizeInput *input, const CwSizeGrid *wanted);
