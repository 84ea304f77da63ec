// SPDX-License-Identifier: AGPL-3.0-or-later
// The interfaces of a domain as Chew's algorithm has them (L. P. Chew, N. Chrisochoides, F. Sukup, Parallel constrained
// Delaunay meshing, 1997): triangulations that both regions split. Each rank holds those of its regions. A split
// follows from the interface and from the points of both regions that encroach upon it, which they send one another, so
// that both sides get the same bits without a further message.
#pragma once

#include "mesher/network/plane_map.h"
#include "mesher/region/region_input.h"
#include "mesher/surface/patch_task.h"

typedef struct {
  int32_t region[2]; // triangles have their normal from the first to the second
  CwPlaneMap map;
  CwPatchOutline outline;              // edges of the interface, and the points as planned
  int32_t point_count, triangle_count; // the outline's points, then the inserted ones
  double (*uv)[2], (*x)[3];
  int32_t (*triangle)[3]; // counter-clockwise in (u,v)
  uint8_t *final;         // of each triangle, 1: encroached, and no point can be had there
} CwChewInterface;

// The smallest spheres of the triangles, 5 % larger, in which no region puts a point.
typedef struct {
  double centre[3], radius;
  int32_t interface, triangle;
} CwChewSphere;

// A point of a region that encroaches upon a triangle of an interface; travels between ranks as bytes.
typedef struct {
  double x[3];
  int32_t interface, region;
} CwChewAsked;

// The constrained Delaunay triangulation of interface `index` as planned: outline and free points.
CwStatus cw_chew_interface_make(const CwRegionInput *from, int32_t index, CwChewInterface *interface);
void cw_chew_interface_free(CwChewInterface *interface);

// Appends the spheres of all triangles. [in,out] sphere, count, space.
CwStatus cw_chew_interface_spheres(const CwChewInterface *interface, int32_t index, CwChewSphere **sphere,
                                   int32_t *count, int32_t *space);

// Splits triangles at the centres of their circles until no asked point lies in a sphere, or no centre can be had
// (encroach.h). Points come last. [in] asked: in an order that is the same for both regions. [out] added.
CwStatus cw_chew_interface_split(const CwRegionInput *from, int32_t count, const CwChewAsked *asked,
                                 CwChewInterface *interface, int32_t *added);
