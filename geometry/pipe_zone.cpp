// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/pipe_zone.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include <BRep_Tool.hxx>
#include <Geom_Circle.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Plane.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <gp_Ax3.hxx>
#include <gp_Trsf.hxx>

#include "geometry/stator_builder.hpp"
#include "pipeline/significant.h"

namespace {

const double SAME_POINT = Precision::Confusion();

std::vector<CwSolidFace *> faces_of(CwSolid &solid, const std::string &patch) {
  std::vector<CwSolidFace *> found;
  for (CwSolidFace &face : solid.faces)
    if (face.patch == patch) found.push_back(&face);
  if (found.empty()) throw std::runtime_error("no patch " + patch);
  return found;
}

// The plane's normal, out of the solid.
gp_Dir outward_of(const CwSolidFace &face) {
  const Handle(Geom_Plane) plane = Handle(Geom_Plane)::DownCast(BRep_Tool::Surface(face.face));
  if (plane.IsNull()) throw std::runtime_error("patch " + face.patch + " is not flat");
  const gp_Ax3 at = plane->Position();
  const gp_Dir normal = at.Direct() ? at.Direction() : at.Direction().Reversed();
  return face.face.Orientation() == TopAbs_REVERSED ? normal.Reversed() : normal;
}

// The prism over flat faces, without walls between them.
class Prism {
public:
  Prism(const std::vector<CwSolidFace *> &ends, double unit, double length) : builder(PLANE_CURVE, unit) {
    const gp_Dir out = outward_of(*ends[0]);
    along = gp_Vec(out) * cw_multiple(length / unit, -26);
    for (const CwSolidFace *end : ends) {
      std::vector<int> loop;
      for (TopExp_Explorer at(end->face, TopAbs_EDGE); at.More(); at.Next())
        loop.push_back(rod(TopoDS::Edge(at.Current())));
      loops.push_back(loop);
    }
  }

  CwSolid *build(const CwSolidFace &end, const CwPipeZoneNames &names) {
    const gp_Dir out(along);
    double largest = 0;
    for (const Rod &rod : rods)
      if (!rod.circle.IsNull()) largest = std::max(largest, rod.circle->Radius());
    face(gp_Ax3(near_point(), out.Reversed()), 0, names.side, CW_PATCH_INTERFACE);
    for (const Rod &rod : rods)
      if (!rod.circle.IsNull()) wall(rod, rod.circle->Radius() < largest - SAME_POINT ? names.core : names.wall);
    face(gp_Ax3(near_point().Translated(along), out), 1, end.patch.c_str(), end.kind);
    return builder.build(names.domain, gp_Trsf(), true);
  }

private:
  // A piece of the outline with its copy at the far end: an arc or, between the sectors of a ring, a line from rim to
  // rim.
  struct Rod {
    Handle(Geom_Circle) circle; // null of a line
    double first;
    int edge[2], start, end; // edges near and far; places of their ends in `line`
  };
  LoopBuilder builder;
  gp_Vec along;
  std::vector<int> vertex[2], line; // near and far, and the lines between them
  std::vector<Rod> rods;
  std::vector<std::vector<int>> loops; // of rods

  gp_Pnt near_point() const {
    return builder.point(vertex[0][0]);
  }

  // Place of a near point among the vertices, which is made where there is none.
  int place_of(const gp_Pnt &point) {
    for (size_t v = 0; v < vertex[0].size(); v++)
      if (builder.point(vertex[0][v]).Distance(point) < SAME_POINT) return int(v);
    vertex[0].push_back(builder.vertex(point));
    vertex[1].push_back(builder.vertex(point.Translated(along)));
    line.push_back(-1);
    return int(line.size()) - 1;
  }

  int rod(const TopoDS_Edge &piece) {
    double first, last;
    const Handle(Geom_Curve) near = BRep_Tool::Curve(piece, first, last);
    Rod made = {
        Handle(Geom_Circle)::DownCast(near), first, {}, place_of(near->Value(first)), place_of(near->Value(last))};
    for (size_t i = 0; i < rods.size(); i++) // a line between two sectors
      if (made.circle.IsNull() && rods[i].circle.IsNull() &&
          std::minmax(made.start, made.end) == std::minmax(rods[i].start, rods[i].end))
        return int(i);
    for (int far = 0; far < 2; far++) {
      const Handle(Geom_Curve) curve = Handle(Geom_Curve)::DownCast(near->Copy());
      curve->Translate(far ? along : gp_Vec(0, 0, 0));
      made.edge[far] = builder.edge(curve, first, last, vertex[far][made.start], vertex[far][made.end]);
    }
    rods.push_back(made);
    return int(rods.size()) - 1;
  }

  void face(const gp_Ax3 &axes, int far, const char *patch, CwPatchKind kind) {
    for (const std::vector<int> &loop : loops) {
      std::vector<LoopEdge> edges;
      for (int i : loop) edges.push_back(rods[i].edge[far]);
      builder.face(new Geom_Plane(axes), edges, patch, kind);
    }
  }

  void wall(const Rod &rod, const char *patch) {
    for (int place : {rod.start, rod.end})
      if (line[place] < 0) line[place] = builder.line(vertex[0][place], vertex[1][place]);
    // The cylinder's angles count from a little before the arc, in the arc's own sense.
    const gp_Pnt centre = rod.circle->Location();
    const gp_Dir from(gp_Vec(centre, rod.circle->Value(rod.first - U_MARGIN)));
    builder.face(
        new Geom_CylindricalSurface(gp_Ax3(centre, rod.circle->Axis().Direction(), from), rod.circle->Radius()),
        {rod.edge[0], line[rod.end], rod.edge[1], line[rod.start]}, patch);
  }
};

} // namespace

CwStatus cw_pipe_zone_make(CwSolid *neighbour, const char *end, double length, const CwPipeZoneNames *names,
                           CwSolid **pipe) {
  *pipe = nullptr;
  return cw_solid_guard(CW_ERR_GEOMETRY, names->domain, "", [&] {
    const std::vector<CwSolidFace *> ends = faces_of(*neighbour, end);
    *pipe = Prism(ends, neighbour->unit, length).build(*ends[0], *names);
    for (size_t i = 0; i < ends.size(); i++) {
      ends[i]->patch = names->neighbour_side;
      ends[i]->name = ends[i]->patch + (ends.size() > 1 ? "_" + std::to_string(i + 1) : "");
      ends[i]->kind = CW_PATCH_INTERFACE;
    }
    return CW_OK;
  });
}
