// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/stator_check.hpp"

#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <string>

#include <BRepCheck_Analyzer.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Surface.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <gp_Pnt2d.hxx>
#include <gp_Vec.hxx>
#include <gp_Vec2d.hxx>

namespace {

const double LARGEST_TOLERANCE = 1e-3;                       // model units
const double LEAST_FLUID_ANGLE = 66, LEAST_SOLID_ANGLE = 75; // degrees
const int SAMPLES = 24;                                      // of an edge

// BRepCheck alone passes gaps that inflated tolerances cover.
void check_tolerances(const CwSolid &stator) {
  const double mm = 1e3 * stator.unit;
  TopTools_IndexedMapOfShape vertices;
  TopExp::MapShapes(stator.solid, TopAbs_VERTEX, vertices);
  for (int i = 1; i <= vertices.Extent(); i++) {
    const TopoDS_Vertex &vertex = TopoDS::Vertex(vertices(i));
    double tolerance = BRep_Tool::Tolerance(vertex);
    if (tolerance < LARGEST_TOLERANCE) continue;
    gp_Pnt p = BRep_Tool::Pnt(vertex);
    char text[200];
    snprintf(text, sizeof text, "its faces miss each other by %.2g mm at (%.3f, %.3f, %.3f) mm; allowed: %g mm",
             mm * tolerance, mm * p.X(), mm * p.Y(), mm * p.Z(), mm * LARGEST_TOLERANCE);
    throw std::runtime_error(text);
  }
}

struct Side {
  gp_Pnt point;
  gp_Vec normal, into; // out of the fluid; along the face away from the edge
};

// At the parameter t of an edge as it stands in its face.
Side side_at(const TopoDS_Edge &edge, const TopoDS_Face &face, double t) {
  double first, last;
  gp_Pnt2d uv;
  gp_Vec2d duv;
  gp_Vec xu, xv;
  Side side;
  BRep_Tool::CurveOnSurface(edge, face, first, last)->D1(t, uv, duv);
  BRep_Tool::Surface(face)->D1(uv.X(), uv.Y(), side.point, xu, xv);
  side.normal = xu.Crossed(xv);
  gp_Vec tangent = xu * duv.X() + xv * duv.Y();
  if (face.Orientation() == TopAbs_REVERSED) side.normal.Reverse();
  if (edge.Orientation() == TopAbs_REVERSED) tangent.Reverse();
  side.into = side.normal.Crossed(tangent);
  return side;
}

void check_angles(const CwSolid &stator) {
  const double mm = 1e3 * stator.unit;
  std::map<const void *, const CwSolidFace *> by_shape;
  for (const CwSolidFace &face : stator.faces) by_shape[face.face.TShape().get()] = &face;
  TopTools_IndexedDataMapOfShapeListOfShape faces_of;
  TopExp::MapShapesAndAncestors(stator.solid, TopAbs_EDGE, TopAbs_FACE, faces_of);
  for (int i = 1; i <= faces_of.Extent(); i++) {
    const CwSolidFace *face[2] = {by_shape.at(faces_of(i).First().TShape().get()),
                                  by_shape.at(faces_of(i).Last().TShape().get())};
    TopoDS_Edge edge[2];
    for (int k = 0; k < 2; k++)
      for (TopExp_Explorer at(face[k]->face, TopAbs_EDGE); at.More(); at.Next())
        if (at.Current().IsSame(faces_of.FindKey(i))) edge[k] = TopoDS::Edge(at.Current());
    double first, last;
    BRep_Tool::Range(edge[0], first, last);
    for (int k = 0; k <= SAMPLES; k++) {
      double t = first + (last - first) * k / SAMPLES;
      Side a = side_at(edge[0], face[0]->face, t), b = side_at(edge[1], face[1]->face, t);
      double angle = a.into.Angle(b.into) * 180 / M_PI;
      if (b.into.Dot(a.normal) >= 0) angle = 360 - angle;
      if (angle >= LEAST_FLUID_ANGLE && 360 - angle >= LEAST_SOLID_ANGLE) continue;
      bool fluid = angle < LEAST_FLUID_ANGLE;
      char text[240];
      snprintf(text, sizeof text,
               "%s and %s meet through the %s at %.1f deg at (%.1f, %.1f, %.1f) mm; allowed: at least %g deg",
               face[0]->name.c_str(), face[1]->name.c_str(), fluid ? "fluid" : "solid", fluid ? angle : 360 - angle,
               mm * a.point.X(), mm * a.point.Y(), mm * a.point.Z(), fluid ? LEAST_FLUID_ANGLE : LEAST_SOLID_ANGLE);
      throw std::runtime_error(text);
    }
  }
}

} // namespace

void cw_stator_check(const CwSolid &stator) {
  check_tolerances(stator);
  for (const CwSolidFace &face : stator.faces)
    if (!BRepCheck_Analyzer(face.face).IsValid())
      throw std::runtime_error("face " + face.name + " crosses itself or its edges do not fit");
  if (!BRepCheck_Analyzer(stator.solid).IsValid()) throw std::runtime_error("the solid is not valid");
  check_angles(stator);
}
