// SPDX-License-Identifier: AGPL-3.0-or-later
// Interface polygons (paper, section 2.2): from the marked edges on a partition plane to all simple loops, the minimal
// polygon set, and the holes of each polygon.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Polygons of a planar straight-line graph. Loop l of polygon p: `corner[loop_start[l] .. loop_start[l+1])`, for l in
// [polygon_start[p], polygon_start[p+1]); the first loop of a polygon is its outer one, counter-clockwise, the others
// are holes, clockwise.
typedef struct {
  int32_t polygon_count, loop_count;
  int32_t *polygon_start; // polygon_count + 1
  int32_t *loop_start;    // loop_count + 1
  int32_t *corner;        // point numbers
} CwPolygons;

// The bounded faces of the graph whose inner points count as inside: a point is inside when a ray from it crosses an
// odd number of edges with `boundary` set (walls and open patches); the other edges (lines of other partition planes)
// only divide. Edges cross nowhere but at their ends. Fails with CW_ERR_MESH and the place (coordinates of the open
// end) where a boundary edge chain does not close.
CwStatus cw_polygons_find(int32_t point_count, const double (*point)[2], int32_t edge_count, const int32_t (*edge)[2],
                          const uint8_t *boundary, CwPolygons *polygons);
void cw_polygons_free(CwPolygons *polygons);

// Finds edges that cross others elsewhere than at their ends: *crossing_count of them, the ends of a pair one after the
// other in (*crossing)[4] as point numbers (malloc'd).
CwStatus cw_polygons_crossings(int32_t point_count, const double (*point)[2], int32_t edge_count,
                               const int32_t (*edge)[2], int32_t *crossing_count, int32_t (**crossing)[4]);

#ifdef __cplusplus
}
#endif
