// SPDX-License-Identifier: AGPL-3.0-or-later
// What the files of the boundary share: division of curves into mesh edges, outlines of open patches and
// interfaces, new nodes.
#pragma once

#include "mesher/boundary/boundary.h"
#include "mesher/network/plane_map.h"
#include "mesher/surface/patch_task.h"

// Places that divide the way between two places, `length` (m) long, so that each edge is as long as the size at its
// place asks, as evenly as whole numbers allow; *count includes both ends. Caller frees *place. At least `least` edges.
CwStatus cw_divide_by_size(double (*size_at)(const void *context, double place), const void *context, double from,
                           double to, double length, int32_t least, int32_t *count, double **place);

// The same of a curve: arc lengths, between two of them.
CwStatus cw_curve_divide(const CwBoundaryInput *in, const CwCurve *curve, double from, double to, int32_t least,
                         int32_t *count, double **place);

// The outline of an interface in the coordinates of its plane.
CwStatus cw_boundary_interface_outline(const CwNodeTable *nodes, const CwInterfaceOutline *interface,
                                       const CwPlaneMap *map, CwPatchOutline *outline);

// The outline of an open patch in its (u,v): the marched open edge, and free curves on it.
CwStatus cw_boundary_open_patch_outline(const CwBoundaryInput *in, const CwWallCurves *curves,
                                        const CwFreeCurves *free_curves, int32_t face, CwPatchOutline *outline);

// Links the nodes inside curve `first` and inside its periodic images, which are divided alike.
CwStatus cw_image_link_curves(const CwPeriodicImages *images, int32_t first, const CwCurveNodes *curve,
                              CwNodeImages *nodes);
