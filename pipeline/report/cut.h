// SPDX-License-Identifier: AGPL-3.0-or-later
// Where a plane, or another surface, goes through the cells of a mesh.
#pragma once

#include "pipeline/mesh/region_items.h"

enum { CW_CUT_CORNERS = 9 }; // no more than a cell has edges

// A plane with an orthonormal frame in it: u x v = normal.
typedef struct {
  double origin[3], u[3], v[3], normal[3];
} CwCutPlane;

// Distance of `x` from the plane, positive to the side of the normal, m.
double cw_cut_distance(const CwCutPlane *plane, const double x[3]);

// The polygon in which the plane cuts a cell with `count` corners (4 tetrahedron, 5 pyramid, 6 prism, CGNS
// order) at x[k] with distances s[k]: corners (u, v) counter-clockwise, their number returned; 0 where it
// does not cut. A corner on the plane counts to the positive side, so that of two cells with a face in the
// plane one is cut.
int cw_cut_cell(const CwCutPlane *plane, int count, const double *const *x, const double *s,
                double polygon[CW_CUT_CORNERS][2]);

typedef struct {
  int32_t cell; // of the region, as cell.h numbers them
  int corners;
  double polygon[CW_CUT_CORNERS][2];
} CwCutCell;

typedef struct {
  CwCutCell *cells; // ascending by `cell`
  int64_t count, capacity;
} CwRegionCut;

// Adds to `cut`, zeroed on entry, the cells of a region that a surface cuts, with their polygons in the frame of
// `plane`. `distance`: of each point from the surface; cells with a point of none, NAN, are left out. Free with
// cw_region_cut_free, also after a failure. CW_ERR_MEMORY.
CwStatus cw_cut_region(const CwCutPlane *plane, const CwRegionData *cells, const double *distance, CwRegionCut *cut);
void cw_region_cut_free(CwRegionCut *cut);
