// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/stator_builder.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Line.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <ElSLib.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Ax2.hxx>

#include "geometry/stator_spline.hpp"

namespace {

const int CURVE_POINTS = 49;          // of an interpolated curve in the parameter plane
const double LARGEST_TOLERANCE = 1e-3; // mm

// (u,v) of a point on a plane, cylinder or cone; u of the latter two lies in [0, 2 pi).
gp_Pnt2d parameters(const GeomAdaptor_Surface &surface, const gp_Pnt &p) {
  double u = 0, v = 0;
  switch (surface.GetType()) {
  case GeomAbs_Plane:
    ElSLib::Parameters(surface.Plane(), p, u, v);
    break;
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

// Largest distance between a curve and the image of its curve in the parameter plane.
double deviation(const Handle(Geom_Curve) &curve, const Handle(Geom_Surface) &surface,
                 const Handle(Geom2d_BSplineCurve) &plane_curve, double a, double b) {
  const int samples = 211; // falls between the points of interpolation
  double worst = 0;
  for (int i = 0; i <= samples; i++) {
    double t = a + i * (b - a) / samples;
    gp_Pnt2d uv = plane_curve->Value(t);
    worst = std::max(worst, curve->Value(t).Distance(surface->Value(uv.X(), uv.Y())));
  }
  return worst;
}

} // namespace

int SolidBuilder::vertex(const gp_Pnt &point) {
  vertices_.push_back(point);
  return int(vertices_.size()) - 1;
}

int SolidBuilder::edge(const Handle(Geom_Curve) &curve, double a, double b, int start, int end) {
  edges_.push_back({curve, a, b, start, end});
  return int(edges_.size()) - 1;
}

int SolidBuilder::line(int start, int end) {
  gp_Vec along(vertices_[start], vertices_[end]);
  return edge(new Geom_Line(vertices_[start], gp_Dir(along)), 0, along.Magnitude(), start, end);
}

int SolidBuilder::arc(int start, int end, double sweep) {
  const gp_Pnt &p = vertices_[start];
  gp_Ax2 frame(gp_Pnt(0, 0, p.Z()), gp::DZ(), gp_Dir(p.X(), p.Y(), 0));
  return edge(new Geom_Circle(frame, std::hypot(p.X(), p.Y())), 0, sweep, start, end);
}

void SolidBuilder::face(const Handle(Geom_Surface) &surface, const std::vector<EdgeUse> &loop, const char *patch,
                        const char *kind) {
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
std::vector<bool> SolidBuilder::orient() const {
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
    for (const EdgeUse &use : faces_[f].loop) {
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

BuiltSolid SolidBuilder::build() const {
  BRep_Builder builder;
  std::vector<bool> turned = orient();
  std::vector<TopoDS_Vertex> vertices(vertices_.size());
  for (size_t i = 0; i < vertices.size(); i++) builder.MakeVertex(vertices[i], vertices_[i], 1e-7);

  std::vector<TopoDS_Edge> edges(edges_.size());
  for (size_t i = 0; i < edges.size(); i++) {
    const Edge &edge = edges_[i];
    builder.MakeEdge(edges[i], edge.curve, 1e-7);
    builder.Add(edges[i], vertices[edge.start].Oriented(TopAbs_FORWARD));
    builder.Add(edges[i], vertices[edge.end].Oriented(TopAbs_REVERSED));
    builder.Range(edges[i], edge.a, edge.b);
    double gap = std::max(edge.curve->Value(edge.a).Distance(vertices_[edge.start]),
                          edge.curve->Value(edge.b).Distance(vertices_[edge.end]));
    builder.UpdateVertex(vertices[edge.start], std::max(1e-7, 1.1 * gap));
    builder.UpdateVertex(vertices[edge.end], std::max(1e-7, 1.1 * gap));
  }

  std::map<std::string, int> faces_of_patch, named;
  for (const Face &face : faces_) faces_of_patch[face.patch]++;
  std::vector<TopoDS_Face> faces(faces_.size());
  std::vector<FaceName> names(faces_.size());
  for (size_t f = 0; f < faces_.size(); f++) {
    const Face &face = faces_[f];
    GeomAdaptor_Surface adaptor(face.surface);
    builder.MakeFace(faces[f], face.surface, 1e-7);
    TopoDS_Wire wire;
    builder.MakeWire(wire);
    double area = 0;
    for (size_t i = 0; i < face.loop.size(); i++) {
      const EdgeUse &use = face.loop[i];
      const Edge &edge = edges_[use.edge];
      Handle(Geom2d_BSplineCurve) plane_curve;
      if (use.border)
        plane_curve = straight_plane_curve(edge.a, edge.b, use.border->first, use.border->second);
      else
        plane_curve = spline_plane_curve(CURVE_POINTS, edge.a, edge.b,
                                         [&](double t) { return parameters(adaptor, edge.curve->Value(t)); });
      double off = deviation(edge.curve, face.surface, plane_curve, edge.a, edge.b);
      double tolerance = std::max(1e-7, 1.1 * off);
      builder.UpdateEdge(edges[use.edge], plane_curve, faces[f], tolerance);
      builder.UpdateVertex(vertices[edge.start], tolerance);
      builder.UpdateVertex(vertices[edge.end], tolerance);
      // Twice the loop's signed area in the parameter plane.
      gp_Pnt2d before = plane_curve->Value(edge.a);
      double sign = face.forward[i] ? 1 : -1;
      for (int k = 1; k <= 32; k++) {
        gp_Pnt2d here = plane_curve->Value(edge.a + k * (edge.b - edge.a) / 32);
        area += sign * (before.X() * here.Y() - here.X() * before.Y());
        before = here;
      }
    }
    // A wire is stored counter-clockwise in (u,v); the face is reversed where its loop runs the other way.
    bool reversed = area < 0;
    for (size_t i = 0; i < face.loop.size(); i++) {
      size_t k = reversed ? face.loop.size() - 1 - i : i;
      bool forward = face.forward[k] != reversed;
      builder.Add(wire, edges[face.loop[k].edge].Oriented(forward ? TopAbs_FORWARD : TopAbs_REVERSED));
    }
    wire.Closed(true);
    builder.Add(faces[f], wire);
    faces[f].Orientation(reversed != turned[f] ? TopAbs_REVERSED : TopAbs_FORWARD);
    names[f] = {face.patch, face.kind, face.patch};
    if (faces_of_patch[face.patch] > 1) names[f].name += "_" + std::to_string(++named[face.patch]);
  }
  for (size_t i = 0; i < edges.size(); i++) {
    builder.SameParameter(edges[i], true);
    builder.SameRange(edges[i], true);
  }

  BuiltSolid built;
  for (int attempt = 0; attempt < 2; attempt++) {
    TopoDS_Shell shell;
    builder.MakeShell(shell);
    for (TopoDS_Face &face : faces) builder.Add(shell, face);
    shell.Closed(true);
    builder.MakeSolid(built.solid);
    builder.Add(built.solid, shell);
    GProp_GProps properties;
    BRepGProp::VolumeProperties(built.solid, properties, 1e-6);
    built.volume = properties.Mass();
    if (built.volume > 0) break;
    for (TopoDS_Face &face : faces) face.Reverse();
  }

  built.largest_tolerance = 0;
  for (const TopoDS_Edge &edge : edges)
    built.largest_tolerance = std::max(built.largest_tolerance, BRep_Tool::Tolerance(edge));
  for (size_t i = 0; i < vertices.size(); i++) {
    double tolerance = BRep_Tool::Tolerance(vertices[i]);
    built.largest_tolerance = std::max(built.largest_tolerance, tolerance);
    if (tolerance < LARGEST_TOLERANCE) continue;
    char text[200];
    snprintf(text, sizeof text, "the faces miss each other by %.2g mm at (%.3f, %.3f, %.3f) mm; allowed: %g mm", tolerance,
             vertices_[i].X(), vertices_[i].Y(), vertices_[i].Z(), LARGEST_TOLERANCE);
    throw std::runtime_error(text);
  }
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(built.solid, TopAbs_FACE, map);
  built.faces.resize(faces.size());
  for (size_t f = 0; f < faces.size(); f++) {
    built.faces[map.FindIndex(faces[f]) - 1] = names[f];
    if (!BRepCheck_Analyzer(faces[f]).IsValid())
      throw std::runtime_error("face " + names[f].name + " crosses itself or its edges do not fit");
  }
  if (!BRepCheck_Analyzer(built.solid).IsValid()) throw std::runtime_error("the solid is not valid");
  return built;
}
