// SPDX-License-Identifier: AGPL-3.0-or-later
// A solid with plane faces, of points and loops.
#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Shell.hxx>
#include <gp_Ax3.hxx>
#include <gp_Pln.hxx>

// Each face a loop of points, anticlockwise seen from outside.
inline TopoDS_Shape polyhedron(const std::vector<gp_Pnt> &point, const std::vector<std::vector<int>> &loops) {
  std::vector<TopoDS_Vertex> vertex;
  std::map<std::pair<int, int>, TopoDS_Edge> edges;
  TopoDS_Shell shell;
  BRep_Builder builder;
  builder.MakeShell(shell);
  for (const gp_Pnt &p : point) vertex.push_back(BRepBuilderAPI_MakeVertex(p));
  for (const std::vector<int> &loop : loops) {
    BRepBuilderAPI_MakeWire wire;
    gp_Vec normal(0, 0, 0);
    const gp_Pnt &from = point[loop[0]];
    for (size_t i = 0; i < loop.size(); i++) {
      const int a = loop[i], b = loop[(i + 1) % loop.size()];
      TopoDS_Edge &edge = edges[std::minmax(a, b)];
      if (edge.IsNull()) edge = BRepBuilderAPI_MakeEdge(vertex[a], vertex[b]);
      wire.Add(edge);
      normal += gp_Vec(from, point[a]).Crossed(gp_Vec(from, point[b]));
    }
    const gp_Pln plane(gp_Ax3(from, gp_Dir(normal), gp_Dir(gp_Vec(from, point[loop[1]]))));
    builder.Add(shell, BRepBuilderAPI_MakeFace(plane, wire.Wire(), true).Face());
  }
  shell.Closed(true);
  return BRepBuilderAPI_MakeSolid(shell).Solid();
}
