// SPDX-License-Identifier: AGPL-3.0-or-later
// Builds a closed solid from vertices, edges with given curves, and faces as loops of edges on given surfaces.
#ifndef CUTWATER_GEOMETRY_STATOR_BUILDER_HPP
#define CUTWATER_GEOMETRY_STATOR_BUILDER_HPP

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <TopoDS_Solid.hxx>
#include <gp_Pnt.hxx>
#include <gp_Pnt2d.hxx>

// An edge in a face's loop. Where the edge is straight in the parameter plane, `border` holds the (u,v) of its two
// ends, in the order of its curve; else its curve there is interpolated (only on planes, cylinders and cones).
struct EdgeUse {
  int edge;
  std::optional<std::pair<gp_Pnt2d, gp_Pnt2d>> border;
  EdgeUse(int edge_) : edge(edge_) {}
  EdgeUse(int edge_, double u0, double v0, double u1, double v1)
      : edge(edge_), border(std::make_pair(gp_Pnt2d(u0, v0), gp_Pnt2d(u1, v1))) {}
};

struct FaceName {
  std::string patch, kind, name;
};

struct BuiltSolid {
  TopoDS_Solid solid;
  std::vector<FaceName> faces; // in the order of TopExp::MapShapes
  double volume;               // mm3
  double largest_tolerance;    // mm
};

class SolidBuilder {
public:
  int vertex(const gp_Pnt &point);
  // The curve over [a, b] must run from vertex `start` to vertex `end`.
  int edge(const Handle(Geom_Curve) &curve, double a, double b, int start, int end);
  int line(int start, int end);
  // Arc about +z in a plane of constant z, of the radius of its ends, from `start` on to the angle `sweep`.
  int arc(int start, int end, double sweep);
  // Each face needs a surface of its own. The loop may begin at any edge and run either way round. Faces of a patch
  // are named by their order: "volute_1", or "outlet" where a patch has a single face.
  void face(const Handle(Geom_Surface) &surface, const std::vector<EdgeUse> &loop, const char *patch,
            const char *kind = "wall");

  gp_Pnt point(int vertex) const { return vertices_[vertex]; }

  // Orients all faces alike, with normals out of the solid, and checks the result. Throws std::runtime_error with a
  // message for a person where the solid is not closed or not valid, or a tolerance reaches 1e-3 mm.
  BuiltSolid build() const;

private:
  struct Edge {
    Handle(Geom_Curve) curve;
    double a, b;
    int start, end;
  };
  struct Face {
    Handle(Geom_Surface) surface;
    std::vector<EdgeUse> loop;
    std::vector<bool> forward; // per edge of the loop
    std::string patch, kind;
  };
  std::vector<bool> orient() const;

  std::vector<gp_Pnt> vertices_;
  std::vector<Edge> edges_;
  std::vector<Face> faces_;
};

#endif
