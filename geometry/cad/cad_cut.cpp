// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/cad_cut.h"

#include <algorithm>
#include <cmath>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <gp_Ax1.hxx>

#include "geometry/cad/cad_part.hpp"

namespace {

const double millimetre = 1e-3; // m
const double ON_SURFACE = 1e-6; // of the body's extent: faces that lie farther from all of the file are the cut's
const int STEPS = 5;            // along an edge, that tell whether it goes round the axis
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

// The edges of a body that go round the axis, as points (r, z) in m of its meridian.
std::vector<gp_XY> edges_round(const CwCadFrame &frame, const TopoDS_Shape &body, double within) {
  std::vector<gp_XY> corners;
  for (TopExp_Explorer at(body, TopAbs_EDGE); at.More(); at.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(at.Current());
    if (BRep_Tool::Degenerated(edge)) continue;
    std::vector<gp_XY> seen;
    for (const gp_Pnt &point : cw_cad_edge_points(edge, STEPS)) {
      double x[3] = {point.X() * millimetre, point.Y() * millimetre, point.Z() * millimetre};
      cw_cad_frame_from_file(&frame, x, x);
      seen.emplace_back(std::hypot(x[0], x[1]), x[2]);
    }
    const bool round =
        std::all_of(seen.begin(), seen.end(), [&](const gp_XY &of) { return (of - seen[0]).Modulus() <= within; });
    if (round) corners.push_back(seen[0]);
  }
  return corners;
}

// Moves each piece of a meridian onto the nearest of the corners that it passes within the tolerance: all of it, or
// where it ends beside the corner that end. Returns the greatest distance.
double snap(const std::vector<gp_XY> &corners, double tolerance, std::vector<gp_XY> &points) {
  double most = 0;
  for (size_t i = 1; i < points.size(); i++) {
    const gp_XY along = points[i] - points[i - 1];
    gp_XY off;
    double nearest = tolerance, share = 0;
    for (const gp_XY &corner : corners) {
      const double t = std::clamp((corner - points[i - 1]) * along / along.SquareModulus(), 0., 1.);
      const gp_XY way = corner - (points[i - 1] + t * along);
      if (way.Modulus() <= nearest) nearest = way.Modulus(), off = way, share = t;
    }
    if (share < 1) points[i - 1] += off;
    if (share > 0) points[i] += off;
    most = std::max(most, off.Modulus());
  }
  return most;
}

TopoDS_Shape surface_of(const std::vector<gp_XY> &points, const CwCadFrame &frame) {
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

std::vector<CwCadBody> pieces_of(const CwCadCut &cut, const CwCadFrame &frame, double tolerance, CwLog *log,
                                 const CwCadBody &body) {
  TopTools_ListOfShape tools;
  const std::array<double, 6> box = cw_cad_box(body.solid);
  const double extent = std::max({box[3] - box[0], box[4] - box[1], box[5] - box[2]});
  std::vector<gp_XY> points = meridian(cut, frame, body.solid);
  const double within = ON_SURFACE * extent * millimetre;
  const double off = snap(edges_round(frame, body.solid, within), tolerance, points);
  if (off > within)
    cw_log(log, "cad.cut is %.3g mm beside an edge of %s, and is moved onto it", 1e3 * off, body.name.c_str());
  tools.Append(surface_of(points, frame));
  std::vector<std::pair<double, TopoDS_Shape>> solids;
  for (const TopoDS_Shape &solid : cw_cad_split(body.solid, tools))
    solids.emplace_back(distance_of(solid, frame), solid);
  if (solids.size() < 2) return {body};
  std::stable_sort(solids.begin(), solids.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
  std::vector<CwCadBody> pieces;
  const CwCadPart whole = {"", body.solid, body.origin};
  for (const auto &[distance, solid] : solids) {
    CwCadPart piece = {"", solid, {}};
    cw_cad_carry({whole}, piece, ON_SURFACE * extent);
    const std::string number = "_" + std::to_string(pieces.size() + 1);
    pieces.push_back({body.file, body.name + number, body.instance + number, solid, piece.origin});
  }
  return pieces;
}

} // namespace

CwStatus cw_cad_cut(const CwCaseCad *cad, const CwCadFrame *frame, double tolerance, CwLog *log, CwCadBodies *bodies) {
  if (!cad->cut.count && !(cad->cut.radius > 0)) return CW_OK;
  return cw_cad_guard("cad.cut", [&]() -> CwStatus {
    std::vector<CwCadBody> all;
    for (const CwCadBody &body : bodies->body)
      for (const CwCadBody &piece : pieces_of(cad->cut, *frame, tolerance, log, body)) all.push_back(piece);
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
