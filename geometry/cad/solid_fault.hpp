// SPDX-License-Identifier: AGPL-3.0-or-later
// What is unsound in a solid, and where: open edges, what OpenCASCADE's BRepCheck finds, tolerances.
#pragma once

#include <optional>
#include <string>

#include <TopoDS_Shape.hxx>
#include <gp_Pnt.hxx>

// Greatest tolerance of a sound solid, over the gap that is closed.
constexpr double CW_LARGEST_TOLERANCE = 10;

struct CwSolidFault {
  std::string what; // of the face or the whole; "" where the solid is sound
  std::optional<gp_Pnt> at;
  TopoDS_Shape on;   // vertex, edge, outline or face; null where it is of the whole
  double gap = -1;   // of an open edge to the next one, in the unit of the solid; below 0: not known
  bool open = false; // an edge does not lie between two faces
};

// The first fault. `tolerance`: largest gap that is closed, in the unit of the solid. A shape of no or several solids
// is unsound.
CwSolidFault cw_cad_solid_fault(const TopoDS_Shape &shape, double tolerance);
