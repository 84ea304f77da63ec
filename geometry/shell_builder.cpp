// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/shell_builder.hpp"

#include <algorithm>
#include <memory>

#include <BRep_Builder.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Wire.hxx>

static const double least_tolerance = Precision::Confusion();
// In model units, of edges and vertices: the deviation of curves on surfaces is sampled, and its peaks lie between the
// samples.
static const double least_edge_tolerance = 1e-5;

int CwShellBuilder::vertex(const gp_Pnt &point) {
  TopoDS_Vertex vertex;
  BRep_Builder().MakeVertex(vertex, point, least_tolerance);
  vertices.push_back(vertex);
  points.push_back(point);
  return (int)vertices.size() - 1;
}

int CwShellBuilder::edge(const Handle(Geom_Curve) & curve, double first, double last, int begin, int end) {
  BRep_Builder builder;
  Edge edge = {{}, curve, first, last, begin, end};
  builder.MakeEdge(edge.edge, curve, least_tolerance);
  builder.Add(edge.edge, vertices[begin].Oriented(TopAbs_FORWARD));
  builder.Add(edge.edge, vertices[end].Oriented(TopAbs_REVERSED));
  builder.Range(edge.edge, first, last);
  edge.deviation = std::max(curve->Value(first).Distance(points[begin]), curve->Value(last).Distance(points[end]));
  edges.push_back(edge);
  return (int)edges.size() - 1;
}

int CwShellBuilder::pole(double first, double last, int vertex) {
  BRep_Builder builder;
  Edge edge = {{}, {}, first, last, vertex, vertex};
  builder.MakeEdge(edge.edge);
  builder.Degenerated(edge.edge, Standard_True);
  builder.Add(edge.edge, vertices[vertex].Oriented(TopAbs_FORWARD));
  builder.Add(edge.edge, vertices[vertex].Oriented(TopAbs_REVERSED));
  edges.push_back(edge);
  return (int)edges.size() - 1;
}

// Parameters at which a curve is held against its surface: even ones, and some between the knots of both splines, where
// the peaks of their deviation are.
static std::vector<double> samples_of(const Handle(Geom_Curve) & curve, const Handle(Geom2d_Curve) & on_surface,
                                      double first, double last) {
  const int even = 100, between = 8;
  std::vector<double> knots = {first, last}, samples;
  if (const Handle(Geom_BSplineCurve) spline = Handle(Geom_BSplineCurve)::DownCast(curve); !spline.IsNull())
    for (int i = 1; i <= spline->NbKnots(); i++) knots.push_back(spline->Knot(i));
  if (const Handle(Geom2d_BSplineCurve) spline = Handle(Geom2d_BSplineCurve)::DownCast(on_surface); !spline.IsNull())
    for (int i = 1; i <= spline->NbKnots(); i++) knots.push_back(spline->Knot(i));
  std::sort(knots.begin(), knots.end());
  for (int i = 0; i <= even; i++) samples.push_back(first + (last - first) * i / even);
  for (size_t i = 0; i + 1 < knots.size(); i++)
    for (int k = 0; k < between; k++) samples.push_back(knots[i] + (knots[i + 1] - knots[i]) * k / between);
  samples.erase(std::remove_if(samples.begin(), samples.end(), [&](double t) { return t < first || t > last; }),
                samples.end());
  std::sort(samples.begin(), samples.end());
  return samples;
}

void CwShellBuilder::face(const Handle(Geom_Surface) & surface, std::vector<std::vector<CwEdgeUse>> loops, bool outward,
                          const char *patch, CwPatchKind kind, const std::string &name) {
  BRep_Builder builder;
  CwSolidFace made;
  double twice_area = 0;
  for (const std::vector<CwEdgeUse> &loop : loops)
    for (const CwEdgeUse &use : loop) {
      Edge &edge = edges[use.edge];
      gp_Pnt2d last;
      bool begun = false;
      for (double t : samples_of(edge.curve, use.curve, edge.first, edge.last)) {
        const gp_Pnt2d uv = use.curve->Value(t);
        const gp_Pnt at = edge.curve.IsNull() ? points[edge.begin] : edge.curve->Value(t);
        edge.deviation = std::max(edge.deviation, at.Distance(surface->Value(uv.X(), uv.Y())));
        if (begun) twice_area += (use.forward ? 1 : -1) * (last.X() * uv.Y() - last.Y() * uv.X());
        last = uv;
        begun = true;
      }
    }
  builder.MakeFace(made.face, surface, least_tolerance);
  for (std::vector<CwEdgeUse> &loop : loops) {
    // A forward face has its fluid-side loops counter-clockwise in the parameter plane.
    if (twice_area < 0) {
      std::reverse(loop.begin(), loop.end());
      for (CwEdgeUse &use : loop) use.forward = !use.forward;
    }
    add_loop(loop, outward, name, made.face);
  }
  made.face.Orientation(outward ? TopAbs_FORWARD : TopAbs_REVERSED);
  made.patch = patch;
  made.kind = kind;
  made.name = name;
  faces.push_back(made);
}

void CwShellBuilder::add_loop(const std::vector<CwEdgeUse> &loop, bool outward, const std::string &name,
                              TopoDS_Face &face) {
  BRep_Builder builder;
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  for (size_t i = 0; i < loop.size(); i++) {
    const CwEdgeUse &use = loop[i], &next = loop[(i + 1) % loop.size()];
    Edge &edge = edges[use.edge];
    if ((use.forward ? edge.end : edge.begin) != (next.forward ? edges[next.edge].begin : edges[next.edge].end))
      throw Standard_Failure(("open loop on face " + name + " after edge " + std::to_string(i)).c_str());
    builder.UpdateEdge(edge.edge, use.curve, face, least_tolerance);
    if (edge.curve.IsNull()) builder.Range(edge.edge, face, edge.first, edge.last);
    builder.Add(wire, edge.edge.Oriented(use.forward ? TopAbs_FORWARD : TopAbs_REVERSED));
    (use.forward == outward ? edge.forward_uses : edge.reversed_uses)++;
  }
  wire.Closed(Standard_True);
  builder.Add(face, wire);
}

CwSolid *CwShellBuilder::finish(const char *domain, double unit) {
  BRep_Builder builder;
  for (size_t i = 0; i < edges.size(); i++) {
    Edge &edge = edges[i];
    if (edge.curve.IsNull() ? edge.forward_uses + edge.reversed_uses != 1
                            : edge.forward_uses != 1 || edge.reversed_uses != 1)
      throw Standard_Failure(("edge " + std::to_string(i) + " is not shared by two faces in opposite senses").c_str());
    const double tolerance = std::max(least_edge_tolerance, 2 * edge.deviation);
    builder.UpdateEdge(edge.edge, tolerance);
    builder.SameParameter(edge.edge, Standard_True);
    builder.SameRange(edge.edge, Standard_True);
    for (int v : {edge.begin, edge.end}) builder.UpdateVertex(vertices[v], tolerance);
  }
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  for (const CwSolidFace &face : faces) builder.Add(shell, face.face);
  shell.Closed(Standard_True);
  std::unique_ptr<CwSolid> result(new CwSolid);
  result->domain = domain;
  result->unit = unit;
  builder.MakeSolid(result->solid);
  builder.Add(result->solid, shell);
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(result->solid, TopAbs_FACE, map);
  for (int i = 1; i <= map.Extent(); i++) {
    const auto found =
        std::find_if(faces.begin(), faces.end(), [&](const CwSolidFace &face) { return face.face.IsSame(map(i)); });
    result->faces.push_back(*found);
    result->faces.back().face = TopoDS::Face(map(i));
  }
  return result.release();
}
