// SPDX-License-Identifier: AGPL-3.0-or-later
// What the files of the skeleton share: division of curves into mesh edges, outlines of caps and
// interfaces, new nodes.
#ifndef CUTWATER_MESHER_SKELETON_SKELETON_CURVES_H
#define CUTWATER_MESHER_SKELETON_SKELETON_CURVES_H

#include "mesher/network/plane_map.h"
#include "mesher/skeleton/skeleton.h"
#include "mesher/surface/patch_task.h"

// Places (arc lengths) that divide a curve between two lengths so that each edge is as long as the size field asks,
// as evenly as whole numbers allow; *count includes both ends. Caller frees *place. At least `least` edges.
CwStatus cw_curve_divide(const CwSkeleton *skeleton, const CwCurve *curve, double from, double to, int32_t least,
                         int32_t *count, double **place);

// The outline of an interface in the coordinates of its plane.
CwStatus cw_skeleton_interface_outline(const CwSkeleton *skeleton, const CwInterfaceOutline *interface,
                                       const CwPlaneMap *map, CwPatchOutline *outline);

// The outline of a cap in its (u,v): the marched rim, and free curves on it.
CwStatus cw_skeleton_cap_outline(const CwSkeleton *skeleton, int32_t face, CwPatchOutline *outline);

CwStatus cw_skeleton_add_node(CwSkeleton *skeleton, const double x[3], int on_plane, int32_t *node);

#endif
