// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/heal.h"

#include <cmath>
#include <optional>

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <ShapeAnalysis_ShapeTolerance.hxx>
#include <ShapeFix_FixSmallFace.hxx>
#include <ShapeFix_Shape.hxx>
#include <ShapeFix_ShapeTolerance.hxx>
#include <ShapeFix_Wireframe.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>

#include "geometry/cad/cad_part.hpp"
#include "pipeline/log.h"

namespace {

// Greatest tolerance of a sound part, over the gap that is closed.
const double LARGEST_TOLERANCE = 10;

std::optional<gp_Pnt> place_of(const TopoDS_Shape &shape) {
  for (TopExp_Explorer at(shape, TopAbs_VERTEX); at.More(); at.Next())
    return BRep_Tool::Pnt(TopoDS::Vertex(at.Current()));
  return {};
}

double volume_of(const TopoDS_Shape &shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

// What is unsound in a shape: "" where nothing is.
struct Fault {
  std::string what;
  std::optional<gp_Pnt> place;
};

Fault open_edge(const TopoDS_Shape &shape) {
  TopTools_IndexedDataMapOfShapeListOfShape faces;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces);
  int open = 0;
  Fault fault;
  for (int i = 1; i <= faces.Extent(); i++) {
    const TopoDS_Edge &edge = TopoDS::Edge(faces.FindKey(i));
    if (BRep_Tool::Degenerated(edge) || faces(i).Extent() == 2) continue;
    if (faces(i).Extent() == 1 && BRep_Tool::IsClosed(edge, TopoDS::Face(faces(i).First()))) continue;
    if (!open++) fault.place = place_of(edge);
    fault.what = std::to_string(open) + " edges do not lie between two faces, one";
  }
  return fault;
}

Fault invalid_part(const TopoDS_Shape &shape) {
  BRepCheck_Analyzer analyzer(shape);
  if (analyzer.IsValid()) return {};
  const TopAbs_ShapeEnum kinds[] = {TopAbs_VERTEX, TopAbs_EDGE, TopAbs_WIRE, TopAbs_FACE};
  static const char *const names[] = {"a vertex", "an edge", "the outline of a face", "a face"};
  for (int k = 3; k >= 0; k--)
    for (TopExp_Explorer at(shape, kinds[k]); at.More(); at.Next())
      if (!analyzer.IsValid(at.Current()))
        return {std::string(names[k]) + " is invalid or crosses itself", place_of(at.Current())};
  return {"its shells do not bound a volume", {}};
}

Fault fault_of(const TopoDS_Shape &shape, double tolerance) {
  int solids = 0;
  for (TopExp_Explorer at(shape, TopAbs_SOLID); at.More(); at.Next()) solids++;
  if (solids != 1) return {"it makes " + std::to_string(solids) + " solids", {}};
  Fault fault = open_edge(shape);
  if (fault.what.empty()) fault = invalid_part(shape);
  if (!fault.what.empty()) return fault;
  ShapeAnalysis_ShapeTolerance measure;
  const double largest = measure.Tolerance(shape, 1);
  if (largest > LARGEST_TOLERANCE * tolerance) {
    const Handle(TopTools_HSequenceOfShape) where = measure.OverTolerance(shape, LARGEST_TOLERANCE * tolerance);
    return {"edges and faces fit one another within no less than " +
                std::to_string((int)std::ceil(largest / tolerance)) +
                " times the tolerance (allowed: " + std::to_string((int)LARGEST_TOLERANCE) + ")",
            where.IsNull() || where->IsEmpty() ? std::nullopt : place_of(where->Value(1))};
  }
  if (!(std::fabs(volume_of(shape)) > 0)) return {"it has no volume", {}};
  return {};
}

TopoDS_Shape one_solid(const TopoDS_Shape &shape) {
  TopExp_Explorer at(shape, TopAbs_SOLID);
  return at.More() ? at.Current() : shape;
}

TopoDS_Shape sewn(const TopoDS_Shape &shape, double tolerance) {
  BRepBuilderAPI_Sewing sewing(tolerance);
  for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next()) sewing.Add(at.Current());
  sewing.Perform();
  TopExp_Explorer shell(sewing.SewedShape(), TopAbs_SHELL);
  if (!shell.More()) return shape;
  return BRepBuilderAPI_MakeSolid(TopoDS::Shell(shell.Current())).Solid();
}

TopoDS_Shape fixed(const TopoDS_Shape &shape, double tolerance) {
  ShapeFix_Shape fix(shape);
  fix.SetPrecision(tolerance);
  fix.SetMaxTolerance(LARGEST_TOLERANCE * tolerance);
  fix.Perform();
  return one_solid(fix.Shape());
}

// A copy without tolerances above the largest allowed: files give greater ones than their edges and faces need.
TopoDS_Shape limited(const TopoDS_Shape &shape, double tolerance) {
  const TopoDS_Shape copy = BRepBuilderAPI_Copy(shape).Shape();
  ShapeFix_ShapeTolerance().LimitTolerance(copy, 0, LARGEST_TOLERANCE * tolerance);
  return copy;
}

// Edges and faces smaller than the tolerance go.
TopoDS_Shape without_small(const TopoDS_Shape &shape, double tolerance) {
  const Handle(ShapeFix_Wireframe) wires = new ShapeFix_Wireframe(shape);
  wires->SetPrecision(tolerance);
  wires->SetMaxTolerance(LARGEST_TOLERANCE * tolerance);
  wires->ModeDropSmallEdges() = Standard_True;
  wires->FixSmallEdges();
  wires->FixWireGaps();
  ShapeFix_FixSmallFace faces;
  faces.Init(wires->Shape());
  faces.SetPrecision(tolerance);
  faces.SetMaxTolerance(LARGEST_TOLERANCE * tolerance);
  faces.Perform();
  return one_solid(faces.FixShape());
}

bool has_small_edge(const TopoDS_Shape &shape, double tolerance) {
  for (TopExp_Explorer at(shape, TopAbs_EDGE); at.More(); at.Next()) {
    if (BRep_Tool::Degenerated(TopoDS::Edge(at.Current()))) continue;
    GProp_GProps properties;
    BRepGProp::LinearProperties(at.Current(), properties);
    if (properties.Mass() < tolerance) return true;
  }
  return false;
}

CwStatus heal_part(double tolerance, const CwCadFrame &frame, CwLog *log, double unit, CwCadPart &part,
                   CwCadFault &of_all) {
  const TopoDS_Shape given = part.solid;
  const Fault first = fault_of(given, tolerance);
  Fault fault = first;
  TopoDS_Shape solid = given;
  if (!fault.what.empty()) solid = limited(given, tolerance), fault = fault_of(solid, tolerance);
  if (!fault.what.empty()) solid = fixed(given, tolerance), fault = fault_of(solid, tolerance);
  if (!fault.what.empty()) solid = fixed(sewn(given, tolerance), tolerance), fault = fault_of(solid, tolerance);
  if (!fault.what.empty()) {
    const gp_Pnt at = first.place.value_or(gp_Pnt());
    of_all = {first.place.has_value(), of_all.part, {at.X() * unit, at.Y() * unit, at.Z() * unit}};
    return CW_FAIL(CW_ERR_GEOMETRY,
                   "cad.domains.%s: the solid cannot be healed within %.3g mm: %s%s; allowed: a closed, "
                   "valid solid; mend it in CAD, or try a greater cad.tolerance_mm",
                   part.domain.c_str(), tolerance * unit * 1e3, first.what.c_str(),
                   first.place ? (" " + cw_cad_place(at, unit, frame)).c_str() : "");
  }
  if (has_small_edge(solid, tolerance)) {
    const TopoDS_Shape whole = solid;
    solid = without_small(solid, tolerance);
    if (!fault_of(solid, tolerance).what.empty()) solid = fixed(solid, tolerance);
    if (!fault_of(solid, tolerance).what.empty()) solid = whole;
  }
  if (volume_of(solid) < 0) {
    TopoDS_Solid turned = TopoDS::Solid(solid);
    BRepLib::OrientClosedSolid(turned);
    solid = turned;
  }
  if (solid.IsSame(given)) { // the same faces, perhaps reversed
    part.solid = solid;
    return CW_OK;
  }
  cw_cad_replace(solid, part);
  cw_log(log, "%s: healed%s%s", part.domain.c_str(), first.what.empty() ? "" : ": ", first.what.c_str());
  return CW_OK;
}

} // namespace

CwStatus cw_cad_heal(double tolerance, const CwCadFrame *frame, CwLog *log, CwCadParts *parts, CwCadFault *fault) {
  *fault = CwCadFault();
  for (CwCadPart &part : parts->part) {
    fault->part = (int)(&part - parts->part.data());
    const CwStatus status = cw_cad_guard("cad.domains." + part.domain,
                                         [&] { return heal_part(tolerance, *frame, log, parts->unit, part, *fault); });
    if (status != CW_OK) return status;
  }
  return CW_OK;
}
