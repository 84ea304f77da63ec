// SPDX-License-Identifier: AGPL-3.0-or-later
// The picture that turns in the browser (viewer.js): the boundary of the mesh but its interfaces, by patch, decimated
// to a size that does not depend on that of the mesh.
#pragma once

#include "pipeline/mesh/region_read.h"
#include "pipeline/parallel/ranks.h"
#include "pipeline/report/colour_scale.h"
#include "pipeline/report/simplify.h"

enum { CW_VIEW_QUANTITIES = CW_SIMPLIFY_VALUES };

// One patch with its own points.
typedef struct {
  int patch; // of the mesh
  int32_t point_count, triangle_count;
  double (*points)[3];
  int32_t (*corners)[3];
  unsigned char *values[CW_VIEW_QUANTITIES]; // shares of the colour scale, 0 to 255; NULL: none
} CwViewPart;

typedef struct {
  const char *name, *label; // HTML; label: with unit
  CwColourSpan span;
} CwViewQuantity;

typedef struct {
  CwSimplifier *simplifier[CW_DOMAINS_MOST]; // while the faces come
  CwViewPart *part;
  int part_count;
  CwViewQuantity quantity[CW_VIEW_QUANTITIES];
  int quantity_count;
  int decimated; // whether the parts have fewer triangles than the mesh
} CwView;

// `size`: a length of the pump, such as its outlet radius, m. Zeroed `view` on entry; free it with cw_view_free, also
// after a failure. CW_ERR_MEMORY.
CwStatus cw_view_start(const CwMesh *mesh, double size, CwView *view);
// Takes the boundary faces of a region, with shares of the colour scale of each quantity by face, triangles before
// quadrilaterals (NULL: none). CW_ERR_MEMORY.
CwStatus cw_view_add(CwView *view, const CwMesh *mesh, const CwRegionData *cells,
                     double *const share[CW_VIEW_QUANTITIES]);
// Rank 0 gets the faces of all ranks. Collective. CW_ERR_MEMORY.
CwStatus cw_view_join(CwView *view, const CwMesh *mesh, const CwRanks *ranks);
// Makes the parts. CW_ERR_MEMORY.
CwStatus cw_view_finish(CwView *view, const CwMesh *mesh);
void cw_view_free(CwView *view);

// Whether a part is to be seen at first: of the rotor what the page's first picture shows, and no inlets and outlets.
int cw_view_shown(const CwMesh *mesh, const CwViewPart *part);
