// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/solid_scale.hpp"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_BezierCurve.hxx>
#include <Geom2d_Circle.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_Curve.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <Geom_Surface.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopExp.hxx>
#include <TopTools_DataMapOfShapeShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <gp.hxx>
#include <gp_Trsf.hxx>

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
  gp_Pnt2d point(const Handle(Geom_Surface) & surface, const gp_Pnt2d &uv) const;
  Handle(Geom2d_Curve) curve(const Handle(Geom2d_Curve) & old, const Handle(Geom_Surface) & surface, double by) const;
};

// A line has its length as parameter, all other curves a number.
bool has_length(const TopoDS_Edge &edge) {
  double first, last;
  return !Handle(Geom_Line)::DownCast(BRep_Tool::Curve(edge, first, last)).IsNull();
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
    const double by = has_length(old) ? factor : 1;
    builder.MakeEdge(fresh, Handle(Geom_Curve)::DownCast(curve->Transformed(motion)),
                     factor * BRep_Tool::Tolerance(old));
    for (TopoDS_Iterator at(old.Oriented(TopAbs_FORWARD)); at.More(); at.Next())
      builder.Add(fresh, vertex(TopoDS::Vertex(at.Value())));
    builder.Range(fresh, by * first, by * last);
    builder.SameParameter(fresh, Standard_True);
    builder.SameRange(fresh, Standard_True);
    made.Bind(old, fresh);
  }
  return TopoDS::Edge(made(old).Oriented(old.Orientation()));
}

// A plane has lengths as both parameters, cylinder and cone as the second, the others none.
gp_Pnt2d Scaler::point(const Handle(Geom_Surface) & surface, const gp_Pnt2d &uv) const {
  if (surface->IsKind(STANDARD_TYPE(Geom_Plane))) return gp_Pnt2d(factor * uv.X(), factor * uv.Y());
  if (surface->IsKind(STANDARD_TYPE(Geom_CylindricalSurface)) || surface->IsKind(STANDARD_TYPE(Geom_ConicalSurface)))
    return gp_Pnt2d(uv.X(), factor * uv.Y());
  return uv;
}

// `by`: factor of the curve's parameter. Lines in the parameter plane run along an axis, or lie in a plane.
Handle(Geom2d_Curve) Scaler::curve(const Handle(Geom2d_Curve) & old, const Handle(Geom_Surface) & surface,
                                   double by) const {
  const Handle(Geom2d_Curve) fresh = Handle(Geom2d_Curve)::DownCast(old->Copy());
  if (const Handle(Geom2d_Line) line = Handle(Geom2d_Line)::DownCast(fresh); !line.IsNull()) {
    line->SetLocation(point(surface, line->Location()));
  } else if (const Handle(Geom2d_Circle) circle = Handle(Geom2d_Circle)::DownCast(fresh); !circle.IsNull()) {
    circle->SetLocation(point(surface, circle->Location()));
    circle->SetRadius(factor * circle->Radius());
  } else if (const Handle(Geom2d_BezierCurve) bezier = Handle(Geom2d_BezierCurve)::DownCast(fresh); !bezier.IsNull()) {
    for (int i = 1; i <= bezier->NbPoles(); i++) bezier->SetPole(i, point(surface, bezier->Pole(i)));
  } else if (const Handle(Geom2d_BSplineCurve) spline = Handle(Geom2d_BSplineCurve)::DownCast(fresh);
             !spline.IsNull()) {
    for (int i = 1; i <= spline->NbPoles(); i++) spline->SetPole(i, point(surface, spline->Pole(i)));
    TColStd_Array1OfReal knots(1, spline->NbKnots());
    for (int i = 1; i <= spline->NbKnots(); i++) knots(i) = by * spline->Knot(i);
    spline->SetKnots(knots);
  } else {
    throw Standard_Failure("a curve in a parameter plane that cannot be scaled");
  }
  return fresh;
}

TopoDS_Face Scaler::face(const TopoDS_Face &old) {
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(old);
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
      builder.UpdateEdge(scaled, curve(on_surface, surface, has_length(at) ? factor : 1), fresh,
                         BRep_Tool::Tolerance(scaled));
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
