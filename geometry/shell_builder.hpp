// SPDX-License-Identifier: AGPL-3.0-or-later
// Builds a closed solid from explicit vertices, shared edges and faces with their parameter curves: no
// booleans, no sewing. Tolerances are measured, not asked for.
#pragma once

#include <string>
#include <vector>

#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <gp_Pnt.hxx>

#include "geometry/solid.hpp"

// One edge in the loop of a face. `forward`: along the edge's own direction. The parameter curve has the
// parameter of the edge's curve.
struct CwEdgeUse {
  int edge;
  bool forward;
  Handle(Geom2d_Curve) curve;
};

class CwShellBuilder {
public:
  int vertex(const gp_Pnt &point);
  // An edge of `curve` from parameter `first` at vertex `begin` to `last` at `end`.
  int edge(const Handle(Geom_Curve) & curve, double first, double last, int begin, int end);
  // The side of one face that is a single point; used by that face alone.
  int pole(double first, double last, int vertex);
  // A face with one loop, given in order, in any sense. `outward`: the surface's natural normal (du x dv)
  // points out of the solid. Each face needs a surface of its own.
  void face(const Handle(Geom_Surface) & surface, const std::vector<CwEdgeUse> &loop, bool outward, const char *patch,
            CwPatchKind kind, const std::string &name) {
    face(surface, std::vector<std::vector<CwEdgeUse>>{loop}, outward, patch, kind, name);
  }
  // The same with holes: all loops have the fluid on the same side.
  void face(const Handle(Geom_Surface) & surface, std::vector<std::vector<CwEdgeUse>> loops, bool outward,
            const char *patch, CwPatchKind kind, const std::string &name);
  // Makes the solid of all that was given in the model unit (m), or throws Standard_Failure with the reason.
  CwSolid *finish(const char *domain, double unit);

private:
  void add_loop(const std::vector<CwEdgeUse> &loop, bool outward, const std::string &name, TopoDS_Face &face);
  struct Edge {
    TopoDS_Edge edge;
    Handle(Geom_Curve) curve; // null of a pole
    double first, last;
    int begin, end;
    double deviation = 0;
    int forward_uses = 0, reversed_uses = 0;
  };
  std::vector<TopoDS_Vertex> vertices;
  std::vector<gp_Pnt> points;
  std::vector<Edge> edges;
  std::vector<CwSolidFace> faces;
};
