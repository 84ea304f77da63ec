// SPDX-License-Identifier: AGPL-3.0-or-later
// A step in the floor of a block, with a fillet that a coarse mesh leaves out.
#pragma once

#include <cmath>
#include <vector>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

static const double step_radius = 0.5e-3; // m

// Fluid: 40 x 20 x 20 mm, less a step of half the length and 8 mm, whose foot or crest is rounded.
inline TopoDS_Shape filleted_step(bool crest) {
  const double r = 1e3 * step_radius, s = r * (1 - std::sqrt(0.5));
  const gp_Pnt from = crest ? gp_Pnt(20 - r, 0, 8) : gp_Pnt(20, 0, r);
  const gp_Pnt middle = crest ? gp_Pnt(20 - s, 0, 8 - s) : gp_Pnt(20 + s, 0, s);
  const gp_Pnt to = crest ? gp_Pnt(20, 0, 8 - r) : gp_Pnt(20 + r, 0, 0);
  std::vector<gp_Pnt> line = {to};
  if (crest) line.push_back(gp_Pnt(20, 0, 0));
  line.insert(line.end(), {gp_Pnt(40, 0, 0), gp_Pnt(40, 0, 20), gp_Pnt(0, 0, 20), gp_Pnt(0, 0, 8)});
  if (!crest) line.push_back(gp_Pnt(20, 0, 8));
  line.push_back(from);
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(from, middle, to).Value()));
  for (size_t i = 0; i + 1 < line.size(); i++) wire.Add(BRepBuilderAPI_MakeEdge(line[i], line[i + 1]));
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()), gp_Vec(0, 20, 0)).Shape();
}
