// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/stator_builder.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRep_Tool.hxx>
#include <ElSLib.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Line.hxx>
#include <gp_Ax2.hxx>

#include "geometry/bspline_fit.hpp"
#include "geometry/shell_builder.hpp"

namespace {

// A curve in a plane, line for line and circle for circle, as OpenCASCADE has it of an edge without one.
Handle(Geom2d_Curve)
    curve_in_plane(const Handle(Geom_Curve) & curve, double a, double b, const Handle(Geom_Surface) & plane) {
  return BRep_Tool::CurveOnPlane(BRepBuilderAPI_MakeEdge(curve, a, b).Edge(), plane, TopLoc_Location(), a, b);
}

// (u,v) of a point on a cylinder or cone; u lies in [0, 2 pi).
gp_Pnt2d parameters(const GeomAdaptor_Surface &surface, const gp_Pnt &p) {
  double u = 0, v = 0;
  switch (surface.GetType()) {
  case GeomAbs_Cylinder:
    ElSLib::Parameters(surface.Cylinder(), p, u, v);
    break;
  case GeomAbs_Cone:
    ElSLib::Parameters(surface.Cone(), p, u, v);
    break;
  default:
    throw std::logic_error("an edge without a border on a free surface");
  }
  return gp_Pnt2d(u, v);
}

} // namespace

int LoopBuilder::vertex(const gp_Pnt &point) {
  vertices_.push_back(point);
  return int(vertices_.size()) - 1;
}

int LoopBuilder::edge(const Handle(Geom_Curve) & curve, double a, double b, int start, int end) {
  edges_.push_back({curve, a, b, start, end});
  return int(edges_.size()) - 1;
}

int LoopBuilder::line(int start, int end) {
  gp_Vec along(vertices_[start], vertices_[end]);
  return edge(new Geom_Line(vertices_[start], gp_Dir(along)), 0, along.Magnitude(), start, end);
}

int LoopBuilder::arc(int start, int end, double sweep) {
  const gp_Pnt &p = vertices_[start];
  gp_Ax2 frame(gp_Pnt(0, 0, p.Z()), gp::DZ(), gp_Dir(p.X(), p.Y(), 0));
  return edge(new Geom_Circle(frame, std::hypot(p.X(), p.Y())), 0, sweep, start, end);
}

void LoopBuilder::face(const Handle(Geom_Surface) & surface, const std::vector<LoopEdge> &loop, const char *patch,
                       CwPatchKind kind) {
  Face face = {surface, loop, std::vector<bool>(loop.size()), patch, kind};
  // The direction of each edge follows from the vertex that it shares with the next one.
  const Edge &first = edges_[loop[0].edge], &second = edges_[loop[1].edge];
  int at = first.end == second.start || first.end == second.end ? first.start : first.end;
  for (size_t i = 0; i < loop.size(); i++) {
    const Edge &edge = edges_[loop[i].edge];
    if (edge.start != at && edge.end != at)
      throw std::logic_error("a loop of patch " + face.patch + " is open at its edge " + std::to_string(i));
    face.forward[i] = edge.start == at;
    at = face.forward[i] ? edge.end : edge.start;
  }
  faces_.push_back(face);
}

// Whether each face's loop must be turned round so that every edge is run through once each way.
std::vector<bool> LoopBuilder::turned_loops() const {
  struct Use {
    int face;
    bool forward;
  };
  std::vector<std::vector<Use>> uses(edges_.size());
  for (size_t f = 0; f < faces_.size(); f++)
    for (size_t i = 0; i < faces_[f].loop.size(); i++)
      uses[faces_[f].loop[i].edge].push_back({int(f), bool(faces_[f].forward[i])});
  for (size_t e = 0; e < uses.size(); e++)
    if (uses[e].size() != 2 || uses[e][0].face == uses[e][1].face)
      throw std::logic_error("edge " + std::to_string(e) + " does not lie between two faces");

  std::vector<bool> turned(faces_.size()), reached(faces_.size());
  std::vector<int> stack = {0};
  reached[0] = true;
  while (!stack.empty()) {
    int f = stack.back();
    stack.pop_back();
    for (const LoopEdge &use : faces_[f].loop) {
      const std::vector<Use> &pair = uses[use.edge];
      const Use &here = pair[0].face == f ? pair[0] : pair[1], &there = pair[0].face == f ? pair[1] : pair[0];
      bool turn = turned[f] != (here.forward == there.forward);
      if (reached[there.face] && turned[there.face] != turn) throw std::logic_error("the faces cannot be oriented");
      if (reached[there.face]) continue;
      reached[there.face] = true;
      turned[there.face] = turn;
      stack.push_back(there.face);
    }
  }
  if (std::count(reached.begin(), reached.end(), false)) throw std::logic_error("the faces do not hang together");
  return turned;
}

CwSolid *LoopBuilder::build(const char *domain, const gp_Trsf &motion, bool first_outward) const {
  CwShellBuilder shell;
  for (const gp_Pnt &point : vertices_) shell.vertex(point.Transformed(motion));
  for (const Edge &edge : edges_)
    shell.edge(Handle(Geom_Curve)::DownCast(edge.curve->Transformed(motion)), edge.a, edge.b, edge.start, edge.end);

  std::vector<bool> turned = turned_loops();
  std::map<std::string, int> faces_of_patch, named;
  for (const Face &face : faces_) faces_of_patch[face.patch]++;
  bool flip = false; // whether the loops run clockwise as seen from outside
  for (size_t f = 0; f < faces_.size(); f++) {
    const Face &face = faces_[f];
    GeomAdaptor_Surface adaptor(face.surface);
    std::vector<CwEdgeUse> loop;
    double area = 0; // twice the loop's signed area in the parameter plane
    for (size_t i = 0; i < face.loop.size(); i++) {
      const LoopEdge &use = face.loop[i];
      const Edge &edge = edges_[use.edge];
      Handle(Geom2d_Curve) curve;
      if (use.border)
        curve = cw_bspline_line_2d(edge.a, edge.b, use.border->first, use.border->second);
      else if (adaptor.GetType() == GeomAbs_Plane)
        curve = curve_in_plane(edge.curve, edge.a, edge.b, face.surface);
      else
        curve = cw_bspline_curve_2d(curve_points_, edge.a, edge.b,
                                    [&](double t) { return parameters(adaptor, edge.curve->Value(t)); });
      gp_Pnt2d before = curve->Value(edge.a);
      for (int k = 1; k <= 32; k++) {
        gp_Pnt2d here = curve->Value(edge.a + k * (edge.b - edge.a) / 32);
        area += (face.forward[i] ? 1 : -1) * (before.X() * here.Y() - here.X() * before.Y());
        before = here;
      }
      loop.push_back({use.edge, bool(face.forward[i]), curve});
    }
    bool outward = (area > 0) != turned[f];
    if (f == 0) flip = outward != first_outward;
    std::string name = face.patch;
    if (faces_of_patch[face.patch] > 1) name += "_" + std::to_string(++named[face.patch]);
    // A motion leaves the curves in the parameter plane as they are.
    shell.face(Handle(Geom_Surface)::DownCast(face.surface->Transformed(motion)), loop, outward != flip,
               face.patch.c_str(), face.kind, name);
  }
  return shell.finish(domain, unit_);
}
