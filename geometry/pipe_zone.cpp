// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/pipe_zone.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <BRep_Tool.hxx>
#include <Geom_Circle.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Plane.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <gp_Ax3.hxx>
#include <gp_Trsf.hxx>

#include "geometry/stator_builder.hpp"

namespace {

const int PLANE_CURVE = 49;   // points of a curve in a plane's or cylinder's parameters
const double U_MARGIN = 0.1;  // rad: keeps the faces of cylinders off u = 0, where u jumps
const double SAME_POINT = 1e-7; // mm

struct Arc {
  Handle(Geom_Circle) circle;
  double first, last;
};

CwSolidFace &single_face(CwSolid &solid, const std::string &patch) {
  CwSolidFace *found = nullptr;
  for (CwSolidFace &face : solid.faces) {
    if (face.patch != patch)
      continue;
    if (found)
      throw std::runtime_error("patch " + patch + " has more than one face");
    found = &face;
  }
  if (!found)
    throw std::runtime_error("no patch " + patch);
  return *found;
}

std::vector<Arc> outline_of(const CwSolidFace &face) {
  std::vector<Arc> arcs;
  for (TopExp_Explorer at(face.face, TopAbs_EDGE); at.More(); at.Next()) {
    Arc arc;
    arc.circle = Handle(Geom_Circle)::DownCast(
        BRep_Tool::Curve(TopoDS::Edge(at.Current()), arc.first, arc.last));
    if (arc.circle.IsNull())
      throw std::runtime_error("the outline of patch " + face.patch + " is no circle");
    arcs.push_back(arc);
  }
  return arcs;
}

// The plane's normal, out of the solid.
gp_Dir outward_of(const CwSolidFace &face) {
  const Handle(Geom_Plane) plane = Handle(Geom_Plane)::DownCast(BRep_Tool::Surface(face.face));
  if (plane.IsNull())
    throw std::runtime_error("patch " + face.patch + " is not flat");
  const gp_Ax3 at = plane->Position();
  const gp_Dir normal = at.Direct() ? at.Direction() : at.Direction().Reversed();
  return face.face.Orientation() == TopAbs_REVERSED ? normal.Reversed() : normal;
}

int vertex_at(LoopBuilder &builder, std::vector<int> &vertices, const gp_Pnt &point) {
  for (int v : vertices)
    if (builder.point(v).Distance(point) < SAME_POINT)
      return v;
  vertices.push_back(builder.vertex(point));
  return vertices.back();
}

CwSolid *build(const CwSolidFace &end, double length, const CwPipeZoneNames &names) {
  LoopBuilder builder(PLANE_CURVE);
  const std::vector<Arc> arcs = outline_of(end);
  const gp_Dir out = outward_of(end);
  const gp_Vec along = gp_Vec(out) * length;
  const gp_Pnt centre = arcs[0].circle->Location();
  const double radius = arcs[0].circle->Radius();
  std::vector<int> ring[2], line;
  std::vector<LoopEdge> disc[2];
  struct Side {
    int arc[2], start, end;
  };
  std::vector<Side> sides;
  for (const Arc &arc : arcs) {
    Side side = {};
    for (int far = 0; far < 2; far++) {
      const Handle(Geom_Circle) circle = Handle(Geom_Circle)::DownCast(arc.circle->Copy());
      circle->Translate(far ? along : gp_Vec(0, 0, 0));
      const int v[2] = {vertex_at(builder, ring[far], circle->Value(arc.first)),
                        vertex_at(builder, ring[far], circle->Value(arc.last))};
      side.arc[far] = builder.edge(circle, arc.first, arc.last, v[0], v[1]);
      disc[far].push_back(side.arc[far]);
      for (int k = 0; k < 2; k++)
        (k ? side.end : side.start) = int(std::find(ring[far].begin(), ring[far].end(), v[k]) - ring[far].begin());
    }
    sides.push_back(side);
  }
  for (size_t v = 0; v < ring[0].size(); v++)
    line.push_back(builder.line(ring[0][v], ring[1][v]));
  builder.face(new Geom_Plane(gp_Ax3(centre, out.Reversed())), disc[0], names.side, "interface");
  for (size_t i = 0; i < arcs.size(); i++) {
    // The cylinder's angles count from a little before the arc, in the arc's own sense.
    const gp_Dir axis = arcs[i].circle->Axis().Direction();
    const gp_Dir from(gp_Vec(centre, arcs[i].circle->Value(arcs[i].first - U_MARGIN)));
    builder.face(new Geom_CylindricalSurface(gp_Ax3(centre, axis, from), radius),
                 {sides[i].arc[0], line[sides[i].end], sides[i].arc[1], line[sides[i].start]}, names.wall);
  }
  builder.face(new Geom_Plane(gp_Ax3(centre.Translated(along), out)), disc[1], end.patch.c_str(),
               end.kind.c_str());
  return builder.build(names.domain, gp_Trsf(), true);
}

} // namespace

CwStatus cw_pipe_zone_make(CwSolid *neighbour, const char *end, double length, const CwPipeZoneNames *names,
                           CwSolid **pipe) {
  CwStatus status = CW_OK;
  *pipe = nullptr;
  try {
    CwSolidFace &face = single_face(*neighbour, end);
    *pipe = build(face, 1e3 * length, *names);
    face.patch = face.name = names->neighbour_side;
    face.kind = "interface";
  } catch (const Standard_Failure &failure) {
    status = CW_FAIL(CW_ERR_GEOMETRY, "%s: %s", names->domain, failure.GetMessageString());
  } catch (const std::exception &failure) {
    status = CW_FAIL(CW_ERR_GEOMETRY, "%s: %s", names->domain, failure.what());
  }
  return status;
}
