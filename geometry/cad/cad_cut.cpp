// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/cad_cut.h"

#include <algorithm>
#include <cmath>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <GProp_GProps.hxx>
#include <gp_Ax1.hxx>

#include "geometry/cad/cad_part.hpp"

namespace {

const double millimetre = 1e-3; // m
const double ON_SURFACE = 1e-6; // of the body's extent: faces that lie farther from all of the file are the cut's
const double BEYOND = 2;        // of the body's extent: how far a cylinder reaches past it

gp_Pnt at_file(const CwCadFrame &frame, double r, double z) {
  double x[3] = {r, 0, z};
  cw_cad_frame_to_file(&frame, x, x);
  return gp_Pnt(x[0] / millimetre, x[1] / millimetre, x[2] / millimetre);
}

// The meridian of the cut, (r, z) in m: a cylinder's as long as it takes to part the body.
std::vector<gp_XY> meridian(const CwCadCut &cut, const CwCadFrame &frame, const TopoDS_Shape &body) {
  std::vector<gp_XY> points;
  for (int i = 0; i < cut.count; i++) points.emplace_back(cut.meridian[i][0], cut.meridian[i][1]);
  if (!points.empty()) return points;
  const std::array<double, 6> box = cw_cad_box(body);
  double middle[3], extent = 0;
  for (int i = 0; i < 3; i++) {
    middle[i] = (box[i] + box[i + 3]) / 2 * millimetre;
    extent += (box[i + 3] - box[i]) * millimetre;
  }
  cw_cad_frame_from_file(&frame, middle, middle);
  return {{cut.radius, middle[2] - BEYOND * extent}, {cut.radius, middle[2] + BEYOND * extent}};
}

TopoDS_Shape surface_of(const CwCadCut &cut, const CwCadFrame &frame, const TopoDS_Shape &body) {
  const std::vector<gp_XY> points = meridian(cut, frame, body);
  BRepBuilderAPI_MakeWire wire;
  for (size_t i = 1; i < points.size(); i++)
    wire.Add(BRepBuilderAPI_MakeEdge(at_file(frame, points[i - 1].X(), points[i - 1].Y()),
                                     at_file(frame, points[i].X(), points[i].Y()))
                 .Edge());
  const double *axis = frame.axis[2];
  return BRepPrimAPI_MakeRevol(wire.Wire(), gp_Ax1(at_file(frame, 0, 0), gp_Dir(axis[0], axis[1], axis[2]))).Shape();
}

// Mean distance of a solid's water from the axis, by its centre's distance and its spread about it.
double distance_of(const TopoDS_Shape &solid, const CwCadFrame &frame) {
  GProp_GProps properties;
  const gp_Pnt origin = at_file(frame, 0, 0);
  BRepGProp::VolumeProperties(solid, properties);
  const double *axis = frame.axis[2];
  return std::sqrt(properties.MomentOfInertia(gp_Ax1(origin, gp_Dir(axis[0], axis[1], axis[2]))) / properties.Mass());
}

std::vector<CwCadBody> pieces_of(const CwCadCut &cut, const CwCadFrame &frame, const CwCadBody &body) {
  TopTools_ListOfShape tools;
  tools.Append(surface_of(cut, frame, body.solid));
  std::vector<std::pair<double, TopoDS_Shape>> solids;
  for (const TopoDS_Shape &solid : cw_cad_split(body.solid, tools))
    solids.emplace_back(distance_of(solid, frame), solid);
  if (solids.size() < 2) return {body};
  std::stable_sort(solids.begin(), solids.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
  std::vector<CwCadBody> pieces;
  const CwCadPart whole = {"", body.solid, body.origin};
  const std::array<double, 6> box = cw_cad_box(body.solid);
  const double extent = std::max({box[3] - box[0], box[4] - box[1], box[5] - box[2]});
  for (const auto &[distance, solid] : solids) {
    CwCadPart piece = {"", solid, {}};
    cw_cad_carry({whole}, piece, ON_SURFACE * extent);
    const std::string number = "_" + std::to_string(pieces.size() + 1);
    pieces.push_back({body.file, body.name + number, body.instance + number, solid, piece.origin});
  }
  return pieces;
}

} // namespace

CwStatus cw_cad_cut(const CwCaseCad *cad, const CwCadFrame *frame, CwCadBodies *bodies) {
  if (!cad->cut.count && !(cad->cut.radius > 0)) return CW_OK;
  return cw_cad_guard("cad.cut", [&]() -> CwStatus {
    std::vector<CwCadBody> all;
    for (const CwCadBody &body : bodies->body)
      for (const CwCadBody &piece : pieces_of(cad->cut, *frame, body)) all.push_back(piece);
    if (all.size() == bodies->body.size())
      return CW_FAIL(
          CW_ERR_INPUT,
          "cad.cut: the surface parts no solid of %s; allowed: a radius between the wheel and its casing, or "
          "points [r, z] of a meridian that runs from wall to wall, z from axis.point_mm along the axis",
          cad->files.text[0]);
    bodies->body = all;
    return CW_OK;
  });
}
