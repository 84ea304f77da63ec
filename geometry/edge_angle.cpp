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

const int SAMPLES = 40; // of an edge

// Normal out of the solid, and the tangent of the edge with the face on its left, seen from outside.
struct Side {
  gp_Pnt at;
  gp_Vec normal, tangent;
};

// At the parameter t of an edge as it stands in its face: its orientation there includes that of the face.
Side side_at(const TopoDS_Edge &edge, const TopoDS_Face &face, double t) {
  double first, last;
  gp_Pnt2d uv;
  gp_Vec2d duv;
  gp_Vec xu, xv;
  Side side;
  BRep_Tool::CurveOnSurface(edge, face, first, last)->D1(t, uv, duv);
  BRep_Tool::Surface(face)->D1(uv.X(), uv.Y(), side.at, xu, xv);
  side.normal = xu.Crossed(xv).Normalized();
  side.tangent = (xu * duv.X() + xv * duv.Y()).Normalized();
  if (face.Orientation() == TopAbs_REVERSED) side.normal.Reverse();
  if (edge.Orientation() == TopAbs_REVERSED) side.tangent.Reverse();
  return side;
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
Side side_at_end(const TopoDS_Edge &edge, const TopoDS_Face &face, bool arrives) {
  double first, last;
  BRep_Tool::Range(edge, first, last);
  return side_at(edge, face, arrives == (edge.Orientation() != TopAbs_REVERSED) ? last : first);
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
      const Side side = side_at(in_a, a.face, t);
      found.angle = angle_between(side, side_at(in_b, b.face, t));
      found.at = side.at;
      use(found);
    }
  }
}

void cw_corner_angles(const CwSolid &solid, const std::function<void(const CwCornerAngle &)> &use) {
  for (size_t i = 0; i < solid.faces.size(); i++) {
    const TopoDS_Face &face = solid.faces[i].face;
    for (TopExp_Explorer wires(face, TopAbs_WIRE); wires.More(); wires.Next()) {
      std::vector<TopoDS_Edge> loop;
      for (BRepTools_WireExplorer at(TopoDS::Wire(wires.Current()), face); at.More(); at.Next())
        loop.push_back(at.Current());
      for (size_t k = 0; k < loop.size(); k++) {
        const Side before = side_at_end(loop[k], face, true);
        const Side behind = side_at_end(loop[(k + 1) % loop.size()], face, false);
        const gp_Vec back = -before.tangent;
        double angle = behind.tangent.Angle(back);
        if (behind.tangent.Crossed(back).Dot(before.normal) < 0) angle = 2 * M_PI - angle;
        use({(int)i, angle, before.at});
      }
    }
  }
}
