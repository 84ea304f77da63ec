// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/heal.h"

#include <cmath>
#include <cstdio>
#include <optional>

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <ShapeFix_FixSmallFace.hxx>
#include <ShapeFix_Shape.hxx>
#include <ShapeFix_ShapeTolerance.hxx>
#include <ShapeFix_Wireframe.hxx>
#include <TopoDS_Compound.hxx>

#include "geometry/cad/cad_part.hpp"
#include "geometry/cad/face_distance.hpp"
#include "geometry/cad/sewing.hpp"
#include "geometry/cad/solid_fault.hpp"
#include "pipeline/log.h"

namespace {

double volume_of(const TopoDS_Shape &shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

// The solid of a shape that holds one; else all of it, so that none is lost.
TopoDS_Shape one_solid(const TopoDS_Shape &shape) {
  TopExp_Explorer at(shape, TopAbs_SOLID);
  if (!at.More()) return shape;
  const TopoDS_Shape first = at.Current();
  at.Next();
  return at.More() ? shape : first;
}

TopoDS_Shape sewn(const TopoDS_Shape &shape, double tolerance) {
  const CwSewn made = cw_cad_sew({shape}, tolerance);
  BRep_Builder builder;
  TopoDS_Compound all;
  builder.MakeCompound(all);
  for (const TopoDS_Shape &solid : made.solids) builder.Add(all, solid);
  return made.solids.empty() ? shape : one_solid(all);
}

TopoDS_Shape fixed(const TopoDS_Shape &shape, double tolerance) {
  ShapeFix_Shape fix(shape);
  fix.SetPrecision(tolerance);
  fix.SetMaxTolerance(CW_LARGEST_TOLERANCE * tolerance);
  fix.Perform();
  return one_solid(fix.Shape());
}

// A copy without tolerances above the largest allowed: files give greater ones than their edges and faces need.
TopoDS_Shape limited(const TopoDS_Shape &shape, double tolerance) {
  const TopoDS_Shape copy = BRepBuilderAPI_Copy(shape).Shape();
  ShapeFix_ShapeTolerance().LimitTolerance(copy, 0, CW_LARGEST_TOLERANCE * tolerance);
  return copy;
}

// Edges and faces smaller than the tolerance go.
TopoDS_Shape without_small(const TopoDS_Shape &shape, double tolerance) {
  const Handle(ShapeFix_Wireframe) wires = new ShapeFix_Wireframe(shape);
  wires->SetPrecision(tolerance);
  wires->SetMaxTolerance(CW_LARGEST_TOLERANCE * tolerance);
  wires->ModeDropSmallEdges() = Standard_True;
  wires->FixSmallEdges();
  wires->FixWireGaps();
  ShapeFix_FixSmallFace faces;
  faces.Init(wires->Shape());
  faces.SetPrecision(tolerance);
  faces.SetMaxTolerance(CW_LARGEST_TOLERANCE * tolerance);
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

// Area of all faces; none where one of them is invalid, for its area says nothing.
std::optional<double> area_of(const TopoDS_Shape &shape) {
  for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next())
    if (!BRepCheck_Analyzer(at.Current()).IsValid()) return {};
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(shape, properties);
  return std::fabs(properties.Mass());
}

// What is unsound in a solid after mending. Its faces must have the area that they had, but for what closing gaps along
// their edges explains: a void that is filled shows by that, whichever way the given faces look.
CwSolidFault fault_of(const TopoDS_Shape &given, const TopoDS_Shape &mended, double tolerance) {
  const CwSolidFault fault = cw_cad_solid_fault(mended, tolerance);
  if (!fault.what.empty() || mended.IsSame(given)) return fault;
  const std::optional<double> before = area_of(given), after = area_of(mended);
  GProp_GProps edges;
  BRepGProp::LinearProperties(given, edges);
  if (!before || !after || std::fabs(*after - *before) <= tolerance * edges.Mass()) return fault;
  char what[80];
  snprintf(what, sizeof what, "its faces have %.4g times the area that they had", *after / *before);
  return {what, {}, {}};
}

// The face of the part that a fault is of, from 0, or the nearest to its place: sewn edges are of no face any more. -1:
// it is of the whole.
int face_of(const CwCadPart &part, const CwSolidFault &fault) {
  const TopTools_IndexedMapOfShape faces = cw_cad_faces(part.solid);
  if (fault.on.IsNull() || !fault.at) return -1;
  for (int f = 1; f <= faces.Extent(); f++) {
    TopTools_IndexedMapOfShape parts;
    TopExp::MapShapes(faces(f), parts);
    if (parts.Contains(fault.on)) return f - 1;
  }
  CwFaceDistance distance(part.solid);
  int nearest = -1;
  double reach = INFINITY;
  for (int f = 0; f < faces.Extent(); f++) {
    const double far = distance.at(f, *fault.at, reach);
    if (far < reach) reach = far, nearest = f;
  }
  return nearest;
}

// "face 12 'LID': what at (x, y, z) mm, open by 0.1 mm", of part p.
std::string told(const CwCadParts &parts, int p, const CwSolidFault &fault, const CwCadFrame &frame) {
  const CwCadPart &part = parts.part[p];
  const int face = face_of(part, fault);
  std::string text;
  if (face >= 0) {
    int number = face + 1;
    for (int before = 0; before < p; before++) number += (int)parts.part[before].origin.size();
    const std::string &name = part.origin[face].name;
    text = "face " + std::to_string(number) + (name.empty() ? "" : " '" + name + "'") + ": ";
  }
  text += fault.what;
  if (fault.at) text += " " + cw_cad_place(*fault.at, parts.unit, frame);
  char by[40] = "";
  if (fault.gap >= 0) snprintf(by, sizeof by, ", open by %.3g mm", fault.gap * parts.unit * 1e3);
  return text + by;
}

// With the fault of the given solid; of one with open edges with what sewing leaves open, or makes of it.
CwStatus refuse(double tolerance, const CwCadFrame &frame, const CwCadParts &parts, const CwSolidFault &first,
                const CwSolidFault &last, CwCadFault &of_all) {
  const CwCadPart &part = parts.part[of_all.part];
  const CwSolidFault left = first.open ? cw_cad_solid_fault(sewn(part.solid, tolerance), tolerance) : first;
  const CwSolidFault &shown = left.open ? left : first;
  const gp_Pnt at = shown.at.value_or(gp_Pnt());
  of_all = {shown.at.has_value(), of_all.part, {at.X() * parts.unit, at.Y() * parts.unit, at.Z() * parts.unit}};
  std::string mended;
  if (first.open && !left.open) mended = "; sewn, " + told(parts, of_all.part, left.what.empty() ? last : left, frame);
  return CW_FAIL(CW_ERR_GEOMETRY,
                 "cad.domains.%s: the solid cannot be healed within %.3g mm: %s%s%s%s; allowed: one closed, valid "
                 "solid; mend it in CAD, or try a greater cad.tolerance_mm",
                 part.domain.c_str(), tolerance * parts.unit * 1e3, part.from.c_str(), part.from.empty() ? "" : ", ",
                 told(parts, of_all.part, shown, frame).c_str(), mended.c_str());
}

CwStatus heal_part(double tolerance, const CwCadFrame &frame, CwLog *log, CwCadParts &parts, CwCadFault &of_all) {
  CwCadPart &part = parts.part[of_all.part];
  const TopoDS_Shape given = part.solid;
  const auto fault = [&](const TopoDS_Shape &solid) { return fault_of(given, solid, tolerance); };
  const CwSolidFault first = fault(given);
  CwSolidFault last = first;
  TopoDS_Shape solid = given;
  if (!last.what.empty()) solid = limited(given, tolerance), last = fault(solid);
  if (!last.what.empty()) solid = fixed(given, tolerance), last = fault(solid);
  if (!last.what.empty()) solid = fixed(sewn(given, tolerance), tolerance), last = fault(solid);
  if (!last.what.empty()) return refuse(tolerance, frame, parts, first, last, of_all);
  if (has_small_edge(solid, tolerance)) {
    const TopoDS_Shape whole = solid;
    solid = without_small(solid, tolerance);
    if (!fault(solid).what.empty()) solid = fixed(solid, tolerance);
    if (!fault(solid).what.empty()) solid = whole;
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
  const std::string what = first.what.empty() ? "" : ": " + told(parts, of_all.part, first, frame);
  cw_cad_replace(solid, part);
  cw_log(log, "%s: healed%s", part.domain.c_str(), what.c_str());
  return CW_OK;
}

} // namespace

CwStatus cw_cad_heal(double tolerance, const CwCadFrame *frame, CwLog *log, CwCadParts *parts, CwCadFault *fault) {
  *fault = CwCadFault();
  for (CwCadPart &part : parts->part) {
    fault->part = (int)(&part - parts->part.data());
    const CwStatus status =
        cw_cad_guard("cad.domains." + part.domain, [&] { return heal_part(tolerance, *frame, log, *parts, *fault); });
    if (status != CW_OK) return status;
  }
  return CW_OK;
}
