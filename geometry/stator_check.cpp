// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/stator_check.hpp"

#include <cmath>

#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>

#include "geometry/edge_angle.hpp"

namespace {

const double LARGEST_TOLERANCE = 1e-3;                       // model units
const double LEAST_FLUID_ANGLE = 66, LEAST_SOLID_ANGLE = 75; // degrees

// BRepCheck alone passes gaps that inflated tolerances cover.
void check_tolerances(const CwSolid &stator) {
  const double mm = 1e3 * stator.unit;
  TopTools_IndexedMapOfShape vertices;
  TopExp::MapShapes(stator.solid, TopAbs_VERTEX, vertices);
  for (int i = 1; i <= vertices.Extent(); i++) {
    const TopoDS_Vertex &vertex = TopoDS::Vertex(vertices(i));
    double tolerance = BRep_Tool::Tolerance(vertex);
    if (tolerance < LARGEST_TOLERANCE) continue;
    gp_Pnt p = BRep_Tool::Pnt(vertex);
    cw_solid_refuse("its faces miss each other by %.2g mm at (%.3f, %.3f, %.3f) mm; allowed: %g mm", mm * tolerance,
                    mm * p.X(), mm * p.Y(), mm * p.Z(), mm * LARGEST_TOLERANCE);
  }
}

void check_angles(const CwSolid &stator) {
  const double mm = 1e3 * stator.unit;
  cw_edge_angles(stator, nullptr, [&](const CwEdgeAngle &found) {
    const double angle = found.angle * 180 / M_PI;
    if (angle >= LEAST_FLUID_ANGLE && 360 - angle >= LEAST_SOLID_ANGLE) return;
    const bool fluid = angle < LEAST_FLUID_ANGLE;
    cw_solid_refuse("%s and %s meet through the %s at %.1f deg at (%.1f, %.1f, %.1f) mm; allowed: at least %g deg",
                    stator.faces[found.face[0]].name.c_str(), stator.faces[found.face[1]].name.c_str(),
                    fluid ? "fluid" : "solid", fluid ? angle : 360 - angle, mm * found.at.X(), mm * found.at.Y(),
                    mm * found.at.Z(), fluid ? LEAST_FLUID_ANGLE : LEAST_SOLID_ANGLE);
  });
}

} // namespace

void cw_stator_check(const CwSolid &stator) {
  check_tolerances(stator);
  const std::string fault = cw_solid_fault(stator);
  if (!fault.empty()) cw_solid_refuse("%s", fault.c_str());
  check_angles(stator);
}
