// SPDX-License-Identifier: AGPL-3.0-or-later
// Angles of a solid as built: between faces along the edges, and between the edges of a face at its corners.
#pragma once

#include <functional>

#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Pnt.hxx>

#include "geometry/solid.hpp"

// At a place of an edge between two faces of the solid, through its inside, rad: over pi where the wall is a wedge.
struct CwEdgeAngle {
  int face[2];
  double angle;
  gp_Pnt at;
};

// At a vertex of a face, between its two edges there, through the face, rad.
struct CwCornerAngle {
  int face;
  double angle;
  gp_Pnt at;
};

using CwFacePair = std::function<bool(const CwSolidFace &, const CwSolidFace &)>;

// Calls `use` for places along each edge whose faces satisfy `wanted`, in either order; an empty one: along all.
void cw_edge_angles(const CwSolid &solid, const CwFacePair &wanted,
                    const std::function<void(const CwEdgeAngle &)> &use);

// The angle in the middle of an edge of two faces; pi where one of them has no tangent plane there.
double cw_edge_angle(const TopoDS_Edge &edge, const TopoDS_Face &a, const TopoDS_Face &b);

// Calls `use` for each corner of each face.
void cw_corner_angles(const CwSolid &solid, const std::function<void(const CwCornerAngle &)> &use);
