// SPDX-License-Identifier: AGPL-3.0-or-later
// Sutherland-Hodgman clipping of polygons by planes (paper, section 2.1), exact in the sense that the two sides of a
// plane get the same points, bit for bit.
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  double normal[3]; // unit
  double offset;    // plane: normal . x = offset
} CwPlane;

enum { CW_CLIP_MAX = 32 }; // corners of a clipped polygon

// Signed distance of x to the plane, m.
double cw_plane_distance(const CwPlane *plane, const double x[3]);

// Keeps the part of the convex polygon on the side normal . x <= offset (inside of the window edge). The four cases of
// an edge are the paper's: out-in gives the crossing and the second end, in-in the second end, in-out the crossing,
// out-out nothing. A corner on the plane counts as inside and is kept as it is. A crossing is always computed in
// one order of the two ends, so that both sides of the plane, and both triangles at an edge, get the same bits.
// Returns the number of corners of `result` (0 where nothing is left).
int cw_clip_polygon(const CwPlane *plane, int count, const double (*corner)[3], double (*result)[3]);

// The plane turned round, for the other side.
CwPlane cw_plane_flipped(const CwPlane *plane);

#ifdef __cplusplus
}
#endif
