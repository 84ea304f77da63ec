// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>

#include <BRepTools_Modifier.hxx>
#include <BRepTools_TrsfModification.hxx>
#include <BRep_TEdge.hxx>
#include <BRep_TFace.hxx>
#include <BRep_TVertex.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dConvert.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopExp.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <gp_GTrsf2d.hxx>
#include <gp_Trsf.hxx>
#include <gp_Trsf2d.hxx>

#include "mesher/cad/cad.h"
#include "mesher/cad/cad_shape.h"

namespace {

const int fineness = 10; // powers of two that the B-rep's unit is less than that of lengths

// Coordinates and parameters that are lengths are multiplied, those that are angles or free stay as they are.
struct ParameterScale {
  double u, v; // of the surface
  double t;    // of the edge's curve
};

// The curve whose point at scale.t * t is that of `curve` at t, multiplied by scale.u and scale.v. Only products with
// these numbers come in, wherever the curve is a spline, parallel to an axis, or all three numbers are alike.
Handle(Geom2d_Curve)
    scaled_pcurve(const Handle(Geom2d_Curve) & curve, double first, double last, const ParameterScale &scale) {
  gp_Trsf2d even;
  even.SetScale(gp_Pnt2d(0, 0), scale.u);
  if (scale.u == scale.v && curve->ParametricTransformation(even) == scale.t) {
    return Handle(Geom2d_Curve)::DownCast(curve->Transformed(even));
  }
  Handle(Geom2d_Line) line = Handle(Geom2d_Line)::DownCast(curve);
  if (!line.IsNull()) {
    gp_Pnt2d at = line->Location();
    gp_Dir2d along = line->Direction();
    if ((along.Y() == 0 && scale.u == scale.t) || (along.X() == 0 && scale.v == scale.t)) {
      return new Geom2d_Line(gp_Pnt2d(scale.u * at.X(), scale.v * at.Y()), along);
    }
  }
  Handle(Geom2d_BSplineCurve) spline = Handle(Geom2d_BSplineCurve)::DownCast(curve->Copy());
  if (spline.IsNull()) spline = Geom2dConvert::CurveToBSplineCurve(new Geom2d_TrimmedCurve(curve, first, last));
  for (int i = 1; i <= spline->NbPoles(); i++) {
    gp_Pnt2d pole = spline->Pole(i);
    spline->SetPole(i, gp_Pnt2d(scale.u * pole.X(), scale.v * pole.Y()));
  }
  TColStd_Array1OfReal knots(1, spline->NbKnots());
  spline->Knots(knots);
  for (int i = 1; i <= spline->NbKnots(); i++) knots(i) *= scale.t;
  spline->SetKnots(knots);
  return spline;
}

// The library scales surfaces, curves and points by products alone, but makes the curves in (u,v) anew, off by its
// rounding and of another kind, and takes tolerances for 1e-7 at the least: here they are scaled like the others.
class Scaling : public BRepTools_TrsfModification {
public:
  explicit Scaling(const gp_Trsf &transformation) : BRepTools_TrsfModification(transformation) {}

  Standard_Boolean NewSurface(const TopoDS_Face &face, Handle(Geom_Surface) & made, TopLoc_Location &location,
                              Standard_Real &tolerance, Standard_Boolean &turn_wires,
                              Standard_Boolean &turn_face) override {
    if (!BRepTools_TrsfModification::NewSurface(face, made, location, tolerance, turn_wires, turn_face)) return false;
    tolerance = Handle(BRep_TFace)::DownCast(face.TShape())->Tolerance() * Trsf().ScaleFactor();
    return true;
  }

  Standard_Boolean NewCurve(const TopoDS_Edge &edge, Handle(Geom_Curve) & made, TopLoc_Location &location,
                            Standard_Real &tolerance) override {
    if (!BRepTools_TrsfModification::NewCurve(edge, made, location, tolerance)) return false;
    tolerance = edge_tolerance(edge);
    return true;
  }

  Standard_Boolean NewPoint(const TopoDS_Vertex &vertex, gp_Pnt &made, Standard_Real &tolerance) override {
    if (!BRepTools_TrsfModification::NewPoint(vertex, made, tolerance)) return false;
    tolerance = Handle(BRep_TVertex)::DownCast(vertex.TShape())->Tolerance() * Trsf().ScaleFactor();
    return true;
  }

  Standard_Boolean NewCurve2d(const TopoDS_Edge &edge, const TopoDS_Face &face, const TopoDS_Edge &,
                              const TopoDS_Face &, Handle(Geom2d_Curve) & made, Standard_Real &tolerance) override {
    double first, last, first_in_space, last_in_space;
    TopLoc_Location location;
    Handle(Geom2d_Curve) old = BRep_Tool::CurveOnSurface(edge, face, first, last);
    if (old.IsNull()) return false;
    gp_GTrsf2d of_surface = BRep_Tool::Surface(face, location)->ParametricTransformation(Trsf());
    Handle(Geom_Curve) in_space = BRep_Tool::Curve(edge, first_in_space, last_in_space);
    double along = in_space.IsNull() ? 1 : in_space->ParametricTransformation(Trsf());
    made = scaled_pcurve(old, first, last, {of_surface.Value(1, 1), of_surface.Value(2, 2), along});
    tolerance = edge_tolerance(edge);
    return true;
  }

private:
  double edge_tolerance(const TopoDS_Edge &edge) {
    return Handle(BRep_TEdge)::DownCast(edge.TShape())->Tolerance() * Trsf().ScaleFactor();
  }
};

} // namespace

TopoDS_Shape cw_cad_scaled_shape(const TopoDS_Shape &shape, int power) {
  gp_Trsf transformation;
  transformation.SetScale(gp_Pnt(0, 0, 0), std::ldexp(1.0, power));
  Handle(Scaling) scaling = new Scaling(transformation);
  BRepTools_Modifier modifier(shape, scaling);
  if (!modifier.IsDone()) throw Standard_Failure("the solid cannot be scaled");
  return modifier.ModifiedShape(shape);
}

CwStatus cw_cad_rescale(CwCad *cad, double unit) {
  // The model has 256 to 512 units of the B-rep from then on: what the library takes for near follows the model too.
  const int power = std::ilogb(cad->metres / unit) + fineness;
  cad->metres = std::ldexp(cad->metres, -power);
  cad->unit = std::ldexp(1, -fineness);
  try {
    cad->solid = cw_cad_scaled_shape(cad->solid, power);
    cw_cad_map_parts(cad);
    cad->face.clear();
    cad->edge.clear();
    return cw_cad_read_parts(cad);
  } catch (const Standard_Failure &failure) {
    const char *text = failure.GetMessageString();
    return CW_FAIL(CW_ERR_LIBRARY, "%s: OpenCASCADE failed: %s", cad->path.c_str(), text ? text : "?");
  }
}
