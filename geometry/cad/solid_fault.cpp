// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/solid_fault.hpp"

#include <cmath>

#include <BRepCheck_Analyzer.hxx>
#include <BRepCheck_ListOfStatus.hxx>
#include <BRepCheck_Result.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <ShapeAnalysis_ShapeTolerance.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>

#include "geometry/cad/cad_part.hpp"
#include "geometry/cad/sewing.hpp"

namespace {

std::optional<gp_Pnt> place_of(const TopoDS_Shape &shape) {
  for (TopExp_Explorer at(shape, TopAbs_VERTEX); at.More(); at.Next())
    return BRep_Tool::Pnt(TopoDS::Vertex(at.Current()));
  return {};
}

CwSolidFault open_edge(const TopoDS_Shape &shape) {
  TopTools_IndexedDataMapOfShapeListOfShape faces;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces);
  std::vector<TopoDS_Edge> open; // of one face
  int count = 0;
  CwSolidFault fault;
  for (int i = 1; i <= faces.Extent(); i++) {
    const TopoDS_Edge &edge = TopoDS::Edge(faces.FindKey(i));
    if (BRep_Tool::Degenerated(edge) || faces(i).Extent() == 2) continue;
    if (faces(i).Extent() == 1 && BRep_Tool::IsClosed(edge, TopoDS::Face(faces(i).First()))) continue;
    if (faces(i).Extent() == 1) open.push_back(edge);
    if (!count++) fault = {"", place_of(edge), edge, -1, true};
  }
  if (!count) return {};
  fault.what = std::to_string(count) + " edges do not lie between two faces, one";
  if (open.empty() || !open[0].IsSame(fault.on)) return fault;
  const CwOpening opening = cw_cad_opening(open[0], open);
  fault.at = opening.at;
  fault.gap = opening.gap;
  return fault;
}

const char *words_of(BRepCheck_Status status) {
  switch (status) {
  case BRepCheck_SelfIntersectingWire:
    return "crosses itself";
  case BRepCheck_IntersectingWires:
    return "has outlines that cross";
  case BRepCheck_InvalidImbricationOfWires:
    return "has an inner outline outside of the outer one";
  case BRepCheck_NotClosed:
    return "is not closed";
  case BRepCheck_UnorientableShape:
  case BRepCheck_BadOrientation:
  case BRepCheck_BadOrientationOfSubshape:
    return "is turned the wrong way";
  case BRepCheck_InvalidPointOnCurve:
  case BRepCheck_InvalidPointOnCurveOnSurface:
  case BRepCheck_InvalidPointOnSurface:
  case BRepCheck_InvalidCurveOnSurface:
  case BRepCheck_InvalidCurveOnClosedSurface:
  case BRepCheck_InvalidSameParameterFlag:
    return "lies off its curve or face by more than its tolerance";
  case BRepCheck_RedundantEdge:
  case BRepCheck_RedundantWire:
  case BRepCheck_RedundantFace:
    return "stands twice";
  default:
    return "is invalid";
  }
}

// What is wrong with a shape by itself or in a face of it; NULL: nothing.
const char *defect_of(const BRepCheck_Analyzer &analyzer, const TopoDS_Shape &shape, const TopoDS_Shape &face) {
  const Handle(BRepCheck_Result) &result = analyzer.Result(shape);
  if (result.IsNull()) return nullptr;
  for (const BRepCheck_Status status : result->Status())
    if (status != BRepCheck_NoError) return words_of(status);
  if (!result->IsStatusOnShape(face)) return nullptr;
  for (const BRepCheck_Status status : result->StatusOnShape(face))
    if (status != BRepCheck_NoError) return words_of(status);
  return nullptr;
}

// The least part of the first unsound face that something is wrong with.
CwSolidFault invalid_part(const TopoDS_Shape &shape) {
  static const struct {
    TopAbs_ShapeEnum kind;
    const char *name;
  } kinds[] = {
      {TopAbs_VERTEX, "a vertex"}, {TopAbs_EDGE, "an edge"}, {TopAbs_WIRE, "the outline"}, {TopAbs_FACE, "it"}};
  const BRepCheck_Analyzer analyzer(shape);
  if (analyzer.IsValid()) return {};
  for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next()) {
    if (analyzer.IsValid(face.Current())) continue;
    for (const auto &[kind, name] : kinds)
      for (TopExp_Explorer at(face.Current(), kind); at.More(); at.Next())
        if (const char *defect = defect_of(analyzer, at.Current(), face.Current()))
          return {std::string(name) + " " + defect, place_of(at.Current()), at.Current()};
    return {"it is invalid", place_of(face.Current()), face.Current()};
  }
  return {"its shells do not bound a volume", {}, {}};
}

} // namespace

CwSolidFault cw_cad_solid_fault(const TopoDS_Shape &shape, double tolerance) {
  std::vector<TopoDS_Shape> solids;
  for (TopExp_Explorer at(shape, TopAbs_SOLID); at.More(); at.Next()) solids.push_back(at.Current());
  if (solids.size() != 1)
    return {"it makes " + std::to_string(solids.size()) + " solids" + (solids.empty() ? "" : ", one"),
            solids.empty() ? std::nullopt : place_of(solids[1]),
            {}};
  CwSolidFault fault = open_edge(shape);
  if (fault.what.empty()) fault = invalid_part(shape);
  if (!fault.what.empty()) return fault;
  ShapeAnalysis_ShapeTolerance measure;
  const double largest = measure.Tolerance(shape, 1), allowed = CW_LARGEST_TOLERANCE * tolerance;
  if (largest > allowed) {
    const Handle(TopTools_HSequenceOfShape) where = measure.OverTolerance(shape, allowed);
    const TopoDS_Shape on = where.IsNull() || where->IsEmpty() ? TopoDS_Shape() : where->Value(1);
    return {"edges and faces fit one another within no less than " +
                std::to_string((int)std::ceil(largest / tolerance)) +
                " times the tolerance (allowed: " + std::to_string((int)CW_LARGEST_TOLERANCE) + ")",
            on.IsNull() ? std::nullopt : place_of(on), on};
  }
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  if (!(std::fabs(properties.Mass()) > 0)) return {"it has no volume", {}, {}};
  return {};
}
