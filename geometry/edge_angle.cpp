// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/edge_angle.hpp"

#include <cmath>

#include <BRep_Tool.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <gp_Pnt2d.hxx>
#include <gp_Vec.hxx>
#include <gp_Vec2d.hxx>

namespace {

const int SAMPLES = 40;    // of an edge
const double FLAT = 1e-12; // sine of the angle between both derivatives under which a surface has no normal

// Normal out of the solid, and the tangent of the edge with the face on its left, seen from outside.
struct Side {
  gp_Pnt at;
  gp_Vec normal, tangent;
};

// At the parameter t of an edge as it stands in its face: its orientation there includes that of the face. False where
// the edge has no tangent, or the face no tangent plane.
bool side_at(const TopoDS_Edge &edge, const TopoDS_Face &face, double t, Side &side) {
  double first, last;
  gp_Pnt2d uv;
  gp_Vec2d duv;
  gp_Vec xu, xv;
  const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
  if (curve.IsNull()) return false;
  curve->D1(t, uv, duv);
  BRep_Tool::Surface(face)->D1(uv.X(), uv.Y(), side.at, xu, xv);
  side.normal = xu.Crossed(xv);
  side.tangent = xu * duv.X() + xv * duv.Y();
  if (!(side.normal.Magnitude() > FLAT * xu.Magnitude() * xv.Magnitude()) || !(side.tangent.Magnitude() > 0))
    return false;
  side.normal.Normalize();
  side.tangent.Normalize();
  if (face.Orientation() == TopAbs_REVERSED) side.normal.Reverse();
  if (edge.Orientation() == TopAbs_REVERSED) side.tangent.Reverse();
  return true;
}

double angle_between(const Side &a, const Side &b) {
  const gp_Vec into_a = a.normal.Crossed(a.tangent), into_b = b.normal.Crossed(b.tangent);
  const double angle = into_a.Angle(into_b);
  return into_b.Dot(a.normal) < 0 ? angle : 2 * M_PI - angle;
}

TopoDS_Edge edge_in_face(const TopoDS_Shape &edge, const TopoDS_Face &face) {
  for (TopExp_Explorer at(face, TopAbs_EDGE); at.More(); at.Next())
    if (at.Current().IsSame(edge)) return TopoDS::Edge(at.Current());
  return TopoDS_Edge();
}

// The end of an edge at which the face's loop arrives, or from which it goes on.
bool side_at_end(const TopoDS_Edge &edge, const TopoDS_Face &face, bool arrives, Side &side) {
  double first, last;
  BRep_Tool::Range(edge, first, last);
  return side_at(edge, face, arrives == (edge.Orientation() != TopAbs_REVERSED) ? last : first, side);
}

} // namespace

void cw_edge_angles(const CwSolid &solid, const CwFacePair &wanted,
                    const std::function<void(const CwEdgeAngle &)> &use) {
  TopTools_DataMapOfShapeInteger number; // of a face
  TopTools_IndexedDataMapOfShapeListOfShape faces_of;
  for (size_t i = 0; i < solid.faces.size(); i++) number.Bind(solid.faces[i].face, (int)i);
  TopExp::MapShapesAndAncestors(solid.solid, TopAbs_EDGE, TopAbs_FACE, faces_of);
  for (int i = 1; i <= faces_of.Extent(); i++) {
    CwEdgeAngle found = {{number.Find(faces_of(i).First()), number.Find(faces_of(i).Last())}, 0, gp_Pnt()};
    const CwSolidFace &a = solid.faces[found.face[0]], &b = solid.faces[found.face[1]];
    if (found.face[0] == found.face[1] || (wanted && !wanted(a, b) && !wanted(b, a))) continue;
    const TopoDS_Edge in_a = edge_in_face(faces_of.FindKey(i), a.face),
                      in_b = edge_in_face(faces_of.FindKey(i), b.face);
    double first, last;
    BRep_Tool::Range(in_a, first, last);
    for (int k = 0; k <= SAMPLES; k++) {
      const double t = first + (last - first) * k / SAMPLES;
      Side of_a, of_b;
      if (!side_at(in_a, a.face, t, of_a) || !side_at(in_b, b.face, t, of_b)) continue;
      found.angle = angle_between(of_a, of_b);
      found.at = of_a.at;
      use(found);
    }
  }
}

double cw_edge_angle(const TopoDS_Edge &edge, const TopoDS_Face &a, const TopoDS_Face &b) {
  double first, last;
  Side of_a, of_b;
  BRep_Tool::Range(edge, first, last);
  const double t = (first + last) / 2;
  if (!side_at(edge_in_face(edge, a), a, t, of_a) || !side_at(edge_in_face(edge, b), b, t, of_b)) return M_PI;
  return angle_between(of_a, of_b);
}

void cw_corner_angles(const CwSolid &solid, const std::function<void(const CwCornerAngle &)> &use) {
  for (size_t i = 0; i < solid.faces.size(); i++) {
    const TopoDS_Face &face = solid.faces[i].face;
    for (TopExp_Explorer wires(face, TopAbs_WIRE); wires.More(); wires.Next()) {
      std::vector<TopoDS_Edge> loop;
      for (BRepTools_WireExplorer at(TopoDS::Wire(wires.Current()), face); at.More(); at.Next())
        loop.push_back(at.Current());
      for (size_t k = 0; k < loop.size(); k++) {
        Side before, behind;
        if (!side_at_end(loop[k], face, true, before) || !side_at_end(loop[(k + 1) % loop.size()], face, false, behind))
          continue;
        const gp_Vec back = -before.tangent;
        double angle = behind.tangent.Angle(back);
        if (behind.tangent.Crossed(back).Dot(before.normal) < 0) angle = 2 * M_PI - angle;
        use({(int)i, angle, before.at});
      }
    }
  }
}
