// SPDX-License-Identifier: AGPL-3.0-or-later
// A short hand over CwShellBuilder: faces are loops of edges in any order of run; their senses, curves in the
// parameter plane and names are worked out here.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <gp_Pnt.hxx>
#include <gp_Pnt2d.hxx>
#include <gp_Trsf.hxx>

#include "geometry/solid.hpp"

enum { PLANE_CURVE = 49 };   // usual points of a curve in the parameter plane
const double U_MARGIN = 0.1; // rad: keeps the faces of cylinders and cones off u = 0, where u jumps

// An edge in a face's loop. Where the edge is straight in the parameter plane, `border` holds the (u,v) of
// its two ends, in the order of its curve; else its curve there is interpolated (only on planes, cylinders
// and cones).
struct LoopEdge {
  int edge;
  std::optional<std::pair<gp_Pnt2d, gp_Pnt2d>> border;
  LoopEdge(int edge_) : edge(edge_) {}
  LoopEdge(int edge_, double u0, double v0, double u1, double v1)
      : edge(edge_), border(std::make_pair(gp_Pnt2d(u0, v0), gp_Pnt2d(u1, v1))) {}
};

class LoopBuilder {
public:
  // Curves in the parameter plane are interpolated at so many points. The model unit in m.
  LoopBuilder(int curve_points, double unit) : curve_points_(curve_points), unit_(unit) {}
  int vertex(const gp_Pnt &point);
  // The curve over [a, b] must run from vertex `start` to vertex `end`.
  int edge(const Handle(Geom_Curve) & curve, double a, double b, int start, int end);
  int line(int start, int end);
  // Arc about the z axis in a plane of constant z, from `start` on to the angle `sweep`.
  int arc(int start, int end, double sweep);
  // Each face needs a surface of its own. The loop may begin at any edge and run either way round. Faces of a
  // patch are named by their order: "volute_1"; or "outlet" where a patch has a single face.
  void face(const Handle(Geom_Surface) & surface, const std::vector<LoopEdge> &loop, const char *patch,
            CwPatchKind kind = CW_PATCH_WALL);

  gp_Pnt point(int vertex) const {
    return vertices_[vertex];
  }

  // Makes the solid, moved by `motion`. `first_outward`: the natural normal of the face given first points
  // out of it. Throws Standard_Failure or std::exception with the reason. The caller frees the solid.
  CwSolid *build(const char *domain, const gp_Trsf &motion, bool first_outward) const;

private:
  struct Edge {
    Handle(Geom_Curve) curve;
    double a, b;
    int start, end;
  };
  struct Face {
    Handle(Geom_Surface) surface;
    std::vector<LoopEdge> loop;
    std::vector<bool> forward; // per edge of the loop
    std::string patch;
    CwPatchKind kind;
  };
  std::vector<bool> turned_loops() const;

  const int curve_points_;
  const double unit_;
  std::vector<gp_Pnt> vertices_;
  std::vector<Edge> edges_;
  std::vector<Face> faces_;
};
