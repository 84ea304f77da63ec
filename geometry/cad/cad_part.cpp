// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/cad_part.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>

#include <BRepAdaptor_Curve.hxx>
#include <BRepAlgoAPI_Splitter.hxx>
#include <BRepBndLib.hxx>
#include <BRepClass_FaceClassifier.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Surface.hxx>
#include <gp_Vec2d.hxx>

#include "geometry/cad/face_distance.hpp"
#include "geometry/solid.hpp"

static const double CLOSEST = 1e-9; // of the extent in the parameters: how near to an edge the inside is looked for

// A point inside the face beside the middle of an edge: across it, by steps that halve. False where there is none.
static bool point_beside_edge(const TopoDS_Face &face, gp_Pnt2d &uv) {
  double u0, u1, v0, v1;
  BRepTools::UVBounds(face, u0, u1, v0, v1);
  const double extent = std::max(u1 - u0, v1 - v0);
  for (TopExp_Explorer at(face, TopAbs_EDGE); at.More(); at.Next()) {
    double first, last;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(TopoDS::Edge(at.Current()), face, first, last);
    gp_Pnt2d middle;
    gp_Vec2d along;
    if (!curve.IsNull()) curve->D1((first + last) / 2, middle, along);
    if (!(along.Magnitude() > 0)) continue;
    const gp_Vec2d across = gp_Vec2d(-along.Y(), along.X()) / along.Magnitude();
    for (double step = extent / 2; step > CLOSEST * extent; step /= 2)
      for (const double side : {step, -step}) {
        uv = middle.Translated(across * side);
        if (BRepClass_FaceClassifier(face, uv, CLOSEST * extent).State() == TopAbs_IN) return true;
      }
  }
  return false;
}

bool cw_cad_inner_point(const TopoDS_Face &face, gp_Pnt &point) {
  for (int n = 2; n <= 32; n *= 2) {
    const std::vector<gp_Pnt> points = cw_cad_inner_points(face, n, 1);
    if (points.empty()) continue;
    point = points[0];
    return true;
  }
  gp_Pnt2d uv;
  if (!point_beside_edge(face, uv)) return false;
  point = BRep_Tool::Surface(face)->Value(uv.X(), uv.Y());
  return true;
}

CwStatus cw_cad_guard(const std::string &what, const std::function<CwStatus()> &run) {
  return cw_solid_guard(CW_ERR_GEOMETRY, what, "OpenCASCADE: ", run);
}

void cw_cad_carry(const std::vector<CwCadPart> &from, CwCadPart &part, double within) {
  const TopTools_IndexedMapOfShape map = cw_cad_faces(part.solid);
  std::vector<TopTools_IndexedMapOfShape> olds;
  std::deque<CwFaceDistance> distance;
  for (const CwCadPart &of : from) olds.push_back(cw_cad_faces(of.solid)), distance.emplace_back(of.solid);
  part.origin.assign(map.Extent(), {});
  for (int i = 1; i <= map.Extent(); i++) {
    const CwCadFaceOrigin *best = nullptr;
    for (size_t k = 0; k < from.size(); k++)
      if (olds[k].Contains(map(i))) best = &from[k].origin[olds[k].FindIndex(map(i)) - 1];
    gp_Pnt at;
    double nearest = INFINITY;
    if (!best && cw_cad_inner_point(TopoDS::Face(map(i)), at)) {
      for (size_t k = 0; k < from.size(); k++)
        for (int f = 0; f < olds[k].Extent(); f++) {
          const double far = distance[k].at(f, at, nearest);
          if (far < nearest) nearest = far, best = &from[k].origin[f];
        }
      if (nearest > within) best = nullptr;
    }
    if (best) part.origin[i - 1] = *best;
  }
}

void cw_cad_replace(const TopoDS_Shape &solid, CwCadPart &part) {
  const CwCadPart before = part;
  part.solid = solid;
  cw_cad_carry({before}, part);
}

std::vector<TopoDS_Shape> cw_cad_split(const TopoDS_Shape &solid, const TopTools_ListOfShape &tools, double fuzzy) {
  TopTools_ListOfShape arguments;
  arguments.Append(solid);
  BRepAlgoAPI_Splitter splitter;
  splitter.SetArguments(arguments);
  splitter.SetTools(tools);
  splitter.SetFuzzyValue(fuzzy);
  splitter.SetNonDestructive(Standard_True);
  splitter.Build();
  std::vector<TopoDS_Shape> solids;
  if (!splitter.HasErrors())
    for (TopExp_Explorer at(splitter.Shape(), TopAbs_SOLID); at.More(); at.Next()) solids.push_back(at.Current());
  return solids;
}

std::vector<gp_Pnt> cw_cad_edge_points(const TopoDS_Edge &edge, int steps) {
  const BRepAdaptor_Curve curve(edge);
  const double first = curve.FirstParameter(), last = curve.LastParameter();
  std::vector<gp_Pnt> points;
  for (int i = 0; i <= steps; i++) points.push_back(curve.Value(first + (last - first) * i / steps));
  return points;
}

std::vector<gp_Pnt> cw_cad_inner_points(const TopoDS_Face &face, int along, size_t most) {
  double u0, u1, v0, v1;
  std::vector<gp_Pnt> points;
  BRepTools::UVBounds(face, u0, u1, v0, v1);
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  for (int i = 1; i < along; i++) {
    for (int j = 1; j < along && points.size() < most; j++) {
      const gp_Pnt2d uv(u0 + (u1 - u0) * i / along, v0 + (v1 - v0) * j / along);
      BRepClass_FaceClassifier classifier(face, uv, 1e-7);
      if (classifier.State() == TopAbs_IN) points.push_back(surface->Value(uv.X(), uv.Y()));
    }
  }
  return points;
}

std::array<double, 6> cw_cad_box(const TopoDS_Shape &shape) {
  Bnd_Box bounds;
  std::array<double, 6> box;
  BRepBndLib::Add(shape, bounds, Standard_False);
  bounds.Get(box[0], box[1], box[2], box[3], box[4], box[5]);
  return box;
}

std::string cw_cad_place(const gp_Pnt &at, double unit, const CwCadFrame &frame) {
  double x[3] = {at.X() * unit, at.Y() * unit, at.Z() * unit};
  char text[80];
  cw_cad_frame_to_file(&frame, x, x);
  snprintf(text, sizeof text, "at (%.3f, %.3f, %.3f) mm", 1e3 * x[0], 1e3 * x[1], 1e3 * x[2]);
  return text;
}
