// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/measure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Geom_Curve.hxx>
#include <ShapeAnalysis_ShapeTolerance.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <gp.hxx>
#include <gp_Vec.hxx>

#include "geometry/edge_angle.hpp"
#include "geometry/solid.hpp"

namespace {

// Of a face's part of the volume, by adaptive quadrature. With the fixed order that is OpenCASCADE's default, hub and
// shroud between seams or many windings are up to 0.1 % off, as much as the limit of the whole rotor.
const double volume_error = 1e-4;

CwStatus guarded(const CwSolid *solid, const std::function<void()> &work) {
  return cw_solid_guard(CW_ERR_GEOMETRY, solid->domain + " cannot be measured", "", [&] {
    work();
    return CW_OK;
  });
}

const CwSolidFace &face_named(const CwSolid *solid, const std::string &name) {
  for (const CwSolidFace &face : solid->faces)
    if (face.name == name) return face;
  throw Standard_Failure(("no face named " + name).c_str());
}

bool has_patch(const CwSolid *solid, const std::string &patch) {
  return std::any_of(solid->faces.begin(), solid->faces.end(),
                     [&](const CwSolidFace &face) { return face.patch == patch; });
}

bool has_face(const CwSolid *solid, const std::string &name) {
  return std::any_of(solid->faces.begin(), solid->faces.end(),
                     [&](const CwSolidFace &face) { return face.name == name; });
}

bool named(const CwSolidFace &face, const char *part) {
  return face.name.find(part) != std::string::npos;
}

// Whether two faces of the rotor that meet should be tangent there.
bool should_be_smooth(const CwSolidFace &a, const CwSolidFace &b) {
  const auto pair = [&](const char *one, const char *other) {
    return (a.patch == one && b.patch == other) || (a.patch == other && b.patch == one);
  };
  const bool a_root = named(a, "_root"), b_root = named(b, "_root");
  const bool a_wall = a.patch == "hub" || a.patch == "shroud", b_wall = b.patch == "hub" || b.patch == "shroud";
  if ((a_root && b_wall) || (b_root && a_wall)) return true;
  if (a.patch == "blade_trailing_edge" && b.patch == a.patch) // bevel and cut meet in an edge
    return a_root != b_root && named(a, "bevel") == named(b, "bevel");
  return a.patch == b.patch || pair("blade_leading_edge", "blade_pressure") ||
         pair("blade_leading_edge", "blade_suction") || pair("shroud", "suction_pipe") || pair("hub", "hub_nut") ||
         pair("hub", "hub_shaft");
}

bool is_blade(const CwSolidFace &face) {
  return face.patch.compare(0, 6, "blade_") == 0;
}

CwMeasuredAngle measured_angle(const CwSolid *solid, double angle, const gp_Pnt &at) {
  return {angle, {at.X() * solid->unit, at.Y() * solid->unit, at.Z() * solid->unit}};
}

// Point of a face of blade 1 at mid-span: v = 0.5 at the given u of its parameter plane.
gp_Pnt mid_span(const CwSolid *rotor, const char *name, double u) {
  return BRep_Tool::Surface(face_named(rotor, name).face)->Value(u, 0.5);
}

// Shortest edge and narrowest face. A face's area is taken as that of its boundary's vector area, half the
// integral of x cross dx, which no face undercuts.
void measure_smallness(const CwSolid *solid, CwMeasuredSolid *measured) {
  const int samples = 24;
  measured->shortest_edge = measured->narrowest_face = HUGE_VAL;
  for (size_t i = 0; i < solid->faces.size(); i++) {
    const TopoDS_Face &face = solid->faces[i].face;
    double around = 0;
    gp_Vec area(0, 0, 0);
    for (TopExp_Explorer explorer(face, TopAbs_EDGE); explorer.More(); explorer.Next()) {
      double first, last, length = 0;
      const TopoDS_Edge edge = TopoDS::Edge(explorer.Current());
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
      gp_Pnt before = curve->Value(first);
      gp_Vec swept(0, 0, 0);
      for (int k = 1; k <= samples; k++) {
        const gp_Pnt next = curve->Value(first + (last - first) * k / samples);
        swept += gp_Vec(gp::Origin(), before).Crossed(gp_Vec(gp::Origin(), next));
        length += next.Distance(before);
        before = next;
      }
      area += swept * (edge.Orientation() == TopAbs_REVERSED ? -0.5 : 0.5);
      around += length;
      if (length * solid->unit < measured->shortest_edge) {
        measured->shortest_edge = length * solid->unit;
        measured->shortest_of = (int)i;
      }
    }
    const double width = area.Magnitude() / (around / 2) * solid->unit;
    if (width < measured->narrowest_face) {
      measured->narrowest_face = width;
      measured->narrowest = (int)i;
    }
  }
}

// The sharpest edges and the sharpest corner.
void measure_sharpness(const CwSolid *solid, CwMeasuredSolid *measured) {
  measured->fluid_edge.angle = measured->wall_edge.angle = measured->corner.angle = HUGE_VAL;
  cw_edge_angles(*solid, nullptr, [&](const CwEdgeAngle &found) {
    for (int wall : {0, 1}) {
      CwMeasuredAngle &least = wall ? measured->wall_edge : measured->fluid_edge;
      const double angle = wall ? 2 * M_PI - found.angle : found.angle;
      if (angle >= least.angle) continue;
      least = measured_angle(solid, angle, found.at);
      for (int k : {0, 1}) (wall ? measured->wall_edge_of : measured->fluid_edge_of)[k] = found.face[k];
    }
  });
  cw_corner_angles(*solid, [&](const CwCornerAngle &found) {
    if (found.angle >= measured->corner.angle) return;
    measured->corner = measured_angle(solid, found.angle, found.at);
    measured->corner_of = found.face;
  });
}

double polar(const gp_Pnt &point) {
  return std::atan2(point.Y(), point.X());
}

double angle_between(double from, double to) {
  double angle = to - from;
  while (angle < 0) angle += 2 * M_PI;
  return angle;
}

struct Extent {
  double least_r = HUGE_VAL, largest_r = 0, least_z = HUGE_VAL, largest_z = -HUGE_VAL, area = 0;
};

// Over the vertices and the middles of the edges of a patch.
Extent extent(const CwSolid *solid, const std::string &patch) {
  Extent extent;
  for (const CwSolidFace &face : solid->faces) {
    if (face.patch != patch) continue;
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(face.face, properties);
    extent.area += properties.Mass() * solid->unit * solid->unit;
    for (TopExp_Explorer explorer(face.face, TopAbs_EDGE); explorer.More(); explorer.Next()) {
      double first, last;
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(explorer.Current()), first, last);
      for (int i = 0; i <= 4; i++) {
        const gp_Pnt point = curve->Value(first + (last - first) * i / 4);
        const double r = std::hypot(point.X(), point.Y()) * solid->unit, z = point.Z() * solid->unit;
        extent.least_r = std::min(extent.least_r, r);
        extent.largest_r = std::max(extent.largest_r, r);
        extent.least_z = std::min(extent.least_z, z);
        extent.largest_z = std::max(extent.largest_z, z);
      }
    }
  }
  if (extent.largest_r == 0) throw Standard_Failure(("no patch " + patch).c_str());
  return extent;
}

// A face with an edge that does not lie on two faces in opposite senses; null: the solid is closed.
const CwSolidFace *open_face(const CwSolid *solid) {
  TopTools_IndexedDataMapOfShapeListOfShape faces_of;
  TopExp::MapShapesAndAncestors(solid->solid, TopAbs_EDGE, TopAbs_FACE, faces_of);
  for (int i = 1; i <= faces_of.Extent(); i++) {
    const TopoDS_Edge edge = TopoDS::Edge(faces_of.FindKey(i));
    int sense = 0;
    for (const TopoDS_Shape &face : faces_of(i))
      for (TopExp_Explorer explorer(face, TopAbs_EDGE); explorer.More(); explorer.Next())
        if (explorer.Current().IsSame(edge)) sense += explorer.Current().Orientation() == TopAbs_FORWARD ? 1 : -1;
    if (!BRep_Tool::Degenerated(edge) && faces_of(i).Extent() == 2 && !faces_of(i).First().IsSame(faces_of(i).Last()) &&
        sense == 0)
      continue;
    return &*std::find_if(solid->faces.begin(), solid->faces.end(),
                          [&](const CwSolidFace &face) { return face.face.IsSame(faces_of(i).First()); });
  }
  return nullptr;
}

// Whether the solid is sound, and what is wrong where it is not.
void measure_soundness(const CwSolid *solid, CwMeasuredSolid *measured) {
  const CwSolidFace *open = open_face(solid);
  std::string fault = cw_solid_fault(*solid);
  measured->valid = fault.empty() && measured->volume > 0;
  measured->closed = !open;
  if (fault.empty() && !measured->valid) fault = "it is inside out";
  if (open) fault = "face " + open->name + " has an edge that no other face shares in the other sense";
  snprintf(measured->fault, sizeof measured->fault, "%s", fault.c_str());
  ShapeAnalysis_ShapeTolerance tolerance;
  const double largest = tolerance.Tolerance(solid->solid, 1);
  measured->largest_tolerance = largest * solid->unit;
  measured->loosest = 0;
  for (size_t i = 0; i < solid->faces.size(); i++)
    if (tolerance.Tolerance(solid->faces[i].face, 1) >= largest) measured->loosest = (int)i;
}

} // namespace

CwStatus cw_measure_solid(const CwSolid *solid, CwMeasuredSolid *measured) {
  return guarded(solid, [&] {
    GProp_GProps properties;
    BRepGProp::VolumeProperties(solid->solid, properties, volume_error);
    measured->face_count = (int)solid->faces.size();
    measured->volume = properties.Mass() * solid->unit * solid->unit * solid->unit;
    measure_soundness(solid, measured);
    measure_smallness(solid, measured);
    measure_sharpness(solid, measured);
  });
}

CwStatus cw_measure_rotor(const CwSolid *rotor, CwMeasuredRotor *measured) {
  return guarded(rotor, [&] {
    const Extent inlet = extent(rotor, has_patch(rotor, "rotor_to_suction") ? "rotor_to_suction" : "inlet"),
                 interface = extent(rotor, "rotor_interface");
    measured->inlet_diameter = 2 * inlet.largest_r;
    measured->inlet_area = inlet.area;
    measured->interface_radius = interface.largest_r;
    measured->interface_area = interface.area;
    measured->outlet_width = interface.largest_z - interface.least_z;
    // The suction side's surface goes on to D2 under the bevel: the mean line ends half-way between both
    // corners.
    const gp_Pnt nose = mid_span(rotor, "blade_leading_edge_1", 0.5);
    const gp_Pnt pressure = mid_span(rotor, "blade_pressure_1", 1), suction = mid_span(rotor, "blade_suction_1", 1);
    double outlet = std::hypot(pressure.X(), pressure.Y());
    const double thickness = angle_between(polar(suction), polar(pressure));
    measured->wrap_angle = angle_between(polar(suction) + thickness / 2, polar(nose));
    // A rounded trailing edge goes on to its foremost point.
    for (int i = 1; i < 100 && has_face(rotor, "blade_trailing_edge_1"); i++) {
      const gp_Pnt tip = mid_span(rotor, "blade_trailing_edge_1", i / 100.0);
      const double r = std::hypot(tip.X(), tip.Y());
      if (r > outlet * (1 + 1e-6)) measured->wrap_angle = angle_between(polar(tip), polar(nose));
      outlet = std::max(outlet, r);
    }
    measured->outlet_diameter = 2 * outlet * rotor->unit;
    measured->kink.angle = 0;
    cw_edge_angles(*rotor, should_be_smooth, [&](const CwEdgeAngle &found) {
      const double kink = std::fabs(found.angle - M_PI);
      if (kink > measured->kink.angle) measured->kink = measured_angle(rotor, kink, found.at);
    });
    measured->hub_crease.angle = measured->shroud_crease.angle = HUGE_VAL;
    measured->trailing_edge.angle = 0;
    for (const char *wall : {"hub", "shroud"}) {
      CwMeasuredAngle &least = wall[0] == 'h' ? measured->hub_crease : measured->shroud_crease;
      cw_edge_angles(
          *rotor, [&](const CwSolidFace &a, const CwSolidFace &b) { return is_blade(a) && b.patch == wall; },
          [&](const CwEdgeAngle &found) {
            if (found.angle < least.angle) least = measured_angle(rotor, found.angle, found.at);
          });
    }
    cw_edge_angles(
        *rotor,
        [&](const CwSolidFace &a, const CwSolidFace &b) { return a.patch == "blade_trailing_edge" && is_blade(b); },
        [&](const CwEdgeAngle &found) {
          if (found.angle > measured->trailing_edge.angle)
            measured->trailing_edge = measured_angle(rotor, found.angle, found.at);
        });
  });
}

CwStatus cw_measure_stator(const CwSolid *stator, CwMeasuredStator *measured) {
  return guarded(stator, [&] {
    const Extent interface = extent(stator, "stator_interface"), step = extent(stator, "step");
    measured->interface_radius = interface.largest_r;
    measured->interface_area = interface.area;
    measured->base_diameter = 2 * step.least_r;
    measured->inlet_width = step.largest_z - step.least_z;
  });
}
