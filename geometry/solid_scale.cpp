// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/solid_scale.hpp"

#include <cmath>

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dConvert.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Conic.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopTools_DataMapOfShapeShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <gp.hxx>
#include <gp_GTrsf2d.hxx>
#include <gp_Trsf.hxx>
#include <gp_Trsf2d.hxx>

namespace {

class Scaler {
public:
  explicit Scaler(double by) : factor(by) {
    motion.SetScale(gp::Origin(), by);
  }
  TopoDS_Face face(const TopoDS_Face &old);

private:
  const double factor;
  gp_Trsf motion;
  BRep_Builder builder;
  TopTools_DataMapOfShapeShape made; // vertices and edges, forward

  TopoDS_Vertex vertex(const TopoDS_Vertex &old);
  TopoDS_Edge edge(const TopoDS_Edge &old);
  double curve_scale(const TopoDS_Edge &old) const;
  // `plane`: what the scale does to the surface's parameters; `by`: to the edge's, from first to last.
  Handle(Geom2d_Curve)
      curve(const Handle(Geom2d_Curve) & old, const gp_GTrsf2d &plane, double by, double first, double last) const;
};

// Of the parameter of an edge; 1 of a degenerate one.
double Scaler::curve_scale(const TopoDS_Edge &old) const {
  double first, last;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(old, first, last);
  return curve.IsNull() ? 1 : curve->ParametricTransformation(motion);
}

TopoDS_Vertex Scaler::vertex(const TopoDS_Vertex &old) {
  if (!made.IsBound(old)) {
    TopoDS_Vertex fresh;
    builder.MakeVertex(fresh, BRep_Tool::Pnt(old).Transformed(motion), factor * BRep_Tool::Tolerance(old));
    made.Bind(old, fresh);
  }
  return TopoDS::Vertex(made(old).Oriented(old.Orientation()));
}

TopoDS_Edge Scaler::edge(const TopoDS_Edge &old) {
  if (!made.IsBound(old)) {
    TopoDS_Edge fresh;
    double first, last;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(old, first, last);
    if (curve.IsNull()) BRep_Tool::Range(old, first, last);
    const double by = curve_scale(old);
    builder.MakeEdge(fresh);
    if (curve.IsNull())
      builder.Degenerated(fresh, Standard_True);
    else
      builder.UpdateEdge(fresh, Handle(Geom_Curve)::DownCast(curve->Transformed(motion)), 0);
    builder.UpdateEdge(fresh, factor * BRep_Tool::Tolerance(old));
    for (TopoDS_Iterator at(old.Oriented(TopAbs_FORWARD)); at.More(); at.Next())
      builder.Add(fresh, vertex(TopoDS::Vertex(at.Value())));
    builder.Range(fresh, by * first, by * last);
    builder.SameParameter(fresh, Standard_True);
    builder.SameRange(fresh, Standard_True);
    made.Bind(old, fresh);
  }
  return TopoDS::Edge(made(old).Oriented(old.Orientation()));
}

// Lines and conics stay what they are where the scale leaves them so; others become splines.
Handle(Geom2d_Curve) Scaler::curve(const Handle(Geom2d_Curve) & old, const gp_GTrsf2d &plane, double by, double first,
                                   double last) const {
  const auto point = [&](const gp_Pnt2d &uv) { return gp_Pnt2d(plane.Transformed(uv.XY())); };
  const Handle(Geom2d_TrimmedCurve) part = Handle(Geom2d_TrimmedCurve)::DownCast(old);
  const Handle(Geom2d_Curve) whole = part.IsNull() ? old : part->BasisCurve();
  const double u = plane.Value(1, 1), v = plane.Value(2, 2);
  if (const Handle(Geom2d_Line) line = Handle(Geom2d_Line)::DownCast(whole); !line.IsNull()) {
    const gp_Dir2d along = line->Direction();
    const double none = Precision::Angular();
    if ((u == by || std::fabs(along.X()) < none) && (v == by || std::fabs(along.Y()) < none))
      return new Geom2d_Line(point(line->Location()), along);
  }
  gp_Trsf2d even;
  even.SetScale(gp_Pnt2d(), u);
  if (u == v && whole->IsKind(STANDARD_TYPE(Geom2d_Conic)) && whole->ParametricTransformation(even) == by)
    return Handle(Geom2d_Curve)::DownCast(whole->Transformed(even));
  Handle(Geom2d_BSplineCurve) spline = Handle(Geom2d_BSplineCurve)::DownCast(whole->Copy());
  if (spline.IsNull()) spline = Geom2dConvert::CurveToBSplineCurve(new Geom2d_TrimmedCurve(whole, first, last));
  for (int i = 1; i <= spline->NbPoles(); i++) spline->SetPole(i, point(spline->Pole(i)));
  TColStd_Array1OfReal knots(1, spline->NbKnots());
  for (int i = 1; i <= spline->NbKnots(); i++) knots(i) = by * spline->Knot(i);
  spline->SetKnots(knots);
  return spline;
}

TopoDS_Face Scaler::face(const TopoDS_Face &old) {
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(old);
  const gp_GTrsf2d plane = surface->ParametricTransformation(motion);
  const TopoDS_Face forward = TopoDS::Face(old.Oriented(TopAbs_FORWARD));
  TopoDS_Face fresh;
  builder.MakeFace(fresh, Handle(Geom_Surface)::DownCast(surface->Transformed(motion)),
                   factor * BRep_Tool::Tolerance(old));
  for (TopoDS_Iterator wires(forward); wires.More(); wires.Next()) {
    TopoDS_Wire wire;
    builder.MakeWire(wire);
    for (TopoDS_Iterator edges(wires.Value()); edges.More(); edges.Next()) {
      const TopoDS_Edge &at = TopoDS::Edge(edges.Value());
      const TopoDS_Edge scaled = edge(at);
      double first, last;
      const Handle(Geom2d_Curve) on_surface = BRep_Tool::CurveOnSurface(at, forward, first, last);
      const Handle(Geom2d_Curve) made_flat = curve(on_surface, plane, curve_scale(at), first, last);
      builder.UpdateEdge(scaled, made_flat, fresh, BRep_Tool::Tolerance(scaled));
      builder.Add(wire, scaled);
    }
    wire.Closed(Standard_True);
    builder.Add(fresh, wire);
  }
  return TopoDS::Face(fresh.Oriented(old.Orientation()));
}

} // namespace

CwSolid cw_solid_scaled(const CwSolid &solid, double factor) {
  BRep_Builder builder;
  Scaler scaler(factor);
  TopoDS_Shell shell;
  CwSolid scaled = {solid.domain, solid.unit / factor, TopoDS_Solid(), solid.faces};
  builder.MakeShell(shell);
  for (CwSolidFace &face : scaled.faces) {
    face.face = scaler.face(face.face);
    builder.Add(shell, face.face);
  }
  shell.Closed(Standard_True);
  builder.MakeSolid(scaled.solid);
  builder.Add(scaled.solid, shell);
  return scaled;
}
