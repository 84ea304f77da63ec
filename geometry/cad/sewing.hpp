// SPDX-License-Identifier: AGPL-3.0-or-later
// Solids of faces that stand edge to edge. OpenCASCADE's sewing makes closed shells; one that lies inside of another
// bounds a void of it, whichever way its faces look, and one inside of that a solid again.
#pragma once

#include <vector>

#include <TopoDS_Edge.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Pnt.hxx>

struct CwSewn {
  int faces = 0;                    // that there were
  std::vector<TopoDS_Shape> solids; // where edges stay open, one of all shells
  std::vector<TopoDS_Edge> open;    // edges of one face alone
};

// Sews all faces of the shapes. `gap`: largest that is closed, in the unit of the shapes.
CwSewn cw_cad_sew(const std::vector<TopoDS_Shape> &shapes, double gap);

// How far an open edge lies from the other ones, and where it is farthest from them. Below 0 where it is the only one.
struct CwOpening {
  double gap = -1;
  gp_Pnt at;
};
CwOpening cw_cad_opening(const TopoDS_Edge &edge, const std::vector<TopoDS_Edge> &open);
