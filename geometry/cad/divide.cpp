// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/divide.h"

#include <cmath>

#include <BRep_Tool.hxx>
#include <ShapeUpgrade_ShapeDivideAngle.hxx>
#include <ShapeUpgrade_ShapeDivideClosed.hxx>
#include <TopExp_Explorer.hxx>

#include "geometry/cad/cad_part.hpp"
#include "pipeline/log.h"

namespace {

int seams(const TopoDS_Shape &shape, TopoDS_Edge *first, int *face) {
  const TopTools_IndexedMapOfShape faces = cw_cad_faces(shape);
  int count = 0;
  for (int i = 1; i <= faces.Extent(); i++)
    for (TopExp_Explorer at(faces(i), TopAbs_EDGE); at.More(); at.Next()) {
      const TopoDS_Edge &edge = TopoDS::Edge(at.Current());
      if (BRep_Tool::Degenerated(edge) || !BRep_Tool::IsClosed(edge, TopoDS::Face(faces(i)))) continue;
      if (!count++) *first = edge, *face = i;
    }
  return count;
}

int poles(const TopoDS_Shape &shape, TopoDS_Edge *first, int *face) {
  const TopTools_IndexedMapOfShape faces = cw_cad_faces(shape);
  int count = 0;
  for (int i = 1; i <= faces.Extent(); i++)
    for (TopExp_Explorer at(faces(i), TopAbs_EDGE); at.More(); at.Next()) {
      if (!BRep_Tool::Degenerated(TopoDS::Edge(at.Current()))) continue;
      if (!count++) *first = TopoDS::Edge(at.Current()), *face = i;
    }
  return count;
}

CwStatus fail_at(const CwCadPart &part, const CwCadFrame &frame, double unit, const TopoDS_Edge &edge, int face,
                 const char *what) {
  const TopoDS_Vertex vertex = TopExp::FirstVertex(edge);
  const gp_Pnt at = vertex.IsNull() ? gp_Pnt() : BRep_Tool::Pnt(vertex);
  double x[3] = {at.X() * unit, at.Y() * unit, at.Z() * unit};
  cw_cad_frame_to_file(&frame, x, x);
  return CW_FAIL(CW_ERR_GEOMETRY,
                 "cad.domains.%s: face %d '%s' %s at (%.3f, %.3f, %.3f) mm; allowed: faces with edges "
                 "all around; split it in CAD",
                 part.domain.c_str(), face, part.origin[face - 1].name.c_str(), what, 1e3 * x[0], 1e3 * x[1],
                 1e3 * x[2]);
}

void replace(CwCadPart &part, const TopoDS_Shape &shape) {
  TopExp_Explorer solid(shape, TopAbs_SOLID);
  if (!solid.More()) throw Standard_Failure("the division leaves no solid");
  const CwCadPart before = part;
  part.solid = solid.Current();
  cw_cad_carry({before}, part);
}

CwStatus divide_part(int pieces, const CwCadFrame &frame, double unit, CwCadPart &part) {
  TopoDS_Edge edge;
  int face = 0;
  const int before = cw_cad_faces(part.solid).Extent();
  if (seams(part.solid, &edge, &face)) {
    ShapeUpgrade_ShapeDivideClosed divide(part.solid);
    divide.SetNbSplitPoints(std::max(pieces, 2) - 1);
    divide.Perform();
    replace(part, divide.Result());
  }
  const int after = cw_cad_faces(part.solid).Extent();
  if (after != before)
    cw_log("%s: closed faces divided, %d faces where the file has %d", part.domain.c_str(), after, before);
  if (seams(part.solid, &edge, &face)) return fail_at(part, frame, unit, edge, face, "stays closed upon itself");
  if (poles(part.solid, &edge, &face)) return fail_at(part, frame, unit, edge, face, "has a pole");
  return CW_OK;
}

} // namespace

CwStatus cw_cad_divide(const int *pieces, const CwCadFrame *frame, CwCadParts *parts) {
  for (size_t i = 0; i < parts->part.size(); i++) {
    CwCadPart &part = parts->part[i];
    const CwStatus status =
        cw_cad_guard("cad.domains." + part.domain, [&] { return divide_part(pieces[i], *frame, parts->unit, part); });
    if (status != CW_OK) return status;
  }
  return CW_OK;
}
