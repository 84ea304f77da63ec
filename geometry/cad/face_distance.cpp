// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/face_distance.hpp"

#include <algorithm>
#include <cmath>

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Precision.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>

std::set<int> cw_cad_numbers(const TopoDS_Shape &shape, TopAbs_ShapeEnum kind, const TopTools_IndexedMapOfShape &all) {
  std::set<int> found;
  for (TopExp_Explorer at(shape, kind); at.More(); at.Next()) found.insert(all.FindIndex(at.Current()) - 1);
  return found;
}

CwFaceDistance::Face::Face(const TopoDS_Face &of)
    : surface(of, Standard_False), outline(of, std::max(BRep_Tool::Tolerance(of), Precision::PConfusion())) {
  const double tolerance = std::min(BRep_Tool::Tolerance(of), Precision::Confusion());
  double u[2], v[2];
  BRepTools::UVBounds(of, u[0], u[1], v[0], v[1]);
  nearest.SetFlag(Extrema_ExtFlag_MIN);
  nearest.Initialize(surface, u[0], u[1], v[0], v[1], std::max(surface.UResolution(tolerance), Precision::PConfusion()),
                     std::max(surface.VResolution(tolerance), Precision::PConfusion()));
}

CwFaceDistance::CwFaceDistance(const TopoDS_Shape &solid) {
  TopExp::MapShapes(solid, TopAbs_FACE, faces);
  TopExp::MapShapes(solid, TopAbs_EDGE, edges);
  TopExp::MapShapes(solid, TopAbs_VERTEX, vertices);
  face.resize(faces.Extent());
  box.resize(faces.Extent());
  edge.resize(edges.Extent());
  for (int e = 0; e < edges.Extent(); e++) BRepBndLib::Add(edges(e + 1), edge[e].box, Standard_False);
  for (int f = 1; f <= faces.Extent(); f++) {
    BRepBndLib::Add(faces(f), box[f - 1], Standard_False);
    edges_of.push_back(cw_cad_numbers(faces(f), TopAbs_EDGE, edges));
    vertices_of.push_back(cw_cad_numbers(faces(f), TopAbs_VERTEX, vertices));
  }
}

double CwFaceDistance::at(int number, const gp_Pnt &point, double reach) {
  Bnd_Box place;
  place.Add(point);
  if (box[number].Distance(place) >= reach) return reach;
  if (!face[number]) face[number].reset(new Face(TopoDS::Face(faces(number + 1))));
  Face &of = *face[number];
  of.nearest.Perform(point);
  for (int i = 1; of.nearest.IsDone() && i <= of.nearest.NbExt(); i++) {
    const double distance = std::sqrt(of.nearest.SquareDistance(i));
    double u, v;
    of.nearest.Point(i).Parameter(u, v);
    if (distance < reach && of.outline.Perform(gp_Pnt2d(u, v)) != TopAbs_OUT) reach = distance;
  }
  for (const int v : vertices_of[number])
    reach = std::min(reach, point.Distance(BRep_Tool::Pnt(TopoDS::Vertex(vertices(v + 1)))));
  for (const int e : edges_of[number]) {
    if (edge[e].box.Distance(place) >= reach || BRep_Tool::Degenerated(TopoDS::Edge(edges(e + 1)))) continue;
    if (!edge[e].nearest) {
      edge[e].nearest.reset(new BRepExtrema_ExtPC);
      edge[e].nearest->Initialize(TopoDS::Edge(edges(e + 1)));
    }
    edge[e].nearest->Perform(BRepBuilderAPI_MakeVertex(point).Vertex());
    for (int i = 1; edge[e].nearest->IsDone() && i <= edge[e].nearest->NbExt(); i++)
      reach = std::min(reach, std::sqrt(edge[e].nearest->SquareDistance(i)));
  }
  return reach;
}
