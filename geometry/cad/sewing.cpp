// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/sewing.hpp"

#include <cmath>

#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <ShapeFix_Shell.hxx>
#include <TopoDS_Compound.hxx>

#include "geometry/cad/cad_part.hpp"

namespace {

// What a closed shell bounds by itself.
struct Body {
  TopoDS_Solid solid;
  double volume;
  gp_Pnt at;       // on its shell
  int holders = 0; // how many others it lies in
  int holder = -1; // the smallest of them
};

bool in_box(const std::array<double, 6> &box, const gp_Pnt &at) {
  for (int i = 0; i < 3; i++)
    if (at.Coord(i + 1) < box[i] || at.Coord(i + 1) > box[3 + i]) return false;
  return true;
}

// With faces that all look to the same side.
TopoDS_Shell oriented(const TopoDS_Shell &shell) {
  ShapeFix_Shell fix;
  return fix.FixFaceOrientation(shell) && fix.NbShells() == 1 ? fix.Shell() : shell;
}

Body body_of(const TopoDS_Shell &shell) {
  Body body = {BRepBuilderAPI_MakeSolid(oriented(shell)).Solid(), 0, {}};
  BRepLib::OrientClosedSolid(body.solid);
  GProp_GProps properties;
  BRepGProp::VolumeProperties(body.solid, properties);
  body.volume = std::fabs(properties.Mass());
  const TopExp_Explorer face(body.solid, TopAbs_FACE), corner(body.solid, TopAbs_VERTEX);
  if (!cw_cad_inner_point(TopoDS::Face(face.Current()), body.at) && corner.More())
    body.at = BRep_Tool::Pnt(TopoDS::Vertex(corner.Current()));
  return body;
}

void find_holders(double gap, std::vector<Body> &bodies) {
  for (size_t k = 0; k < bodies.size() && bodies.size() > 1; k++) {
    const std::array<double, 6> box = cw_cad_box(bodies[k].solid);
    BRepClass3d_SolidClassifier classifier(bodies[k].solid);
    for (Body &body : bodies) {
      if (&body == &bodies[k] || body.volume > bodies[k].volume || !in_box(box, body.at)) continue;
      classifier.Perform(body.at, gap);
      if (classifier.State() != TopAbs_IN) continue;
      body.holders++;
      if (body.holder < 0 || bodies[k].volume < bodies[body.holder].volume) body.holder = (int)k;
    }
  }
}

TopoDS_Shape shell_of(const TopoDS_Solid &solid) {
  return TopExp_Explorer(solid, TopAbs_SHELL).Current();
}

// Every second shell from outside inward is a void.
std::vector<TopoDS_Shape> nested(const std::vector<Body> &bodies) {
  std::vector<TopoDS_Shape> solids;
  BRep_Builder builder;
  for (size_t k = 0; k < bodies.size(); k++) {
    if (bodies[k].holders % 2) continue;
    TopoDS_Solid solid;
    builder.MakeSolid(solid);
    builder.Add(solid, shell_of(bodies[k].solid));
    for (const Body &body : bodies)
      if (body.holders % 2 && body.holder == (int)k) builder.Add(solid, shell_of(body.solid).Reversed());
    solids.push_back(solid);
  }
  return solids;
}

// A face that is closed by itself, as a sphere is, comes without a shell.
std::vector<TopoDS_Shell> shells_of(const TopoDS_Shape &sewn) {
  std::vector<TopoDS_Shell> shells;
  for (TopExp_Explorer at(sewn, TopAbs_SHELL); at.More(); at.Next()) shells.push_back(TopoDS::Shell(at.Current()));
  for (TopExp_Explorer at(sewn, TopAbs_FACE, TopAbs_SHELL); at.More(); at.Next()) {
    BRep_Builder builder;
    TopoDS_Shell shell;
    builder.MakeShell(shell);
    builder.Add(shell, at.Current());
    shell.Closed(Standard_True);
    shells.push_back(shell);
  }
  return shells;
}

} // namespace

CwSewn cw_cad_sew(const std::vector<TopoDS_Shape> &shapes, double gap) {
  CwSewn sewn;
  BRepBuilderAPI_Sewing sewing(gap);
  for (const TopoDS_Shape &shape : shapes)
    for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next(), sewn.faces++) sewing.Add(at.Current());
  if (!sewn.faces) return sewn;
  sewing.Perform();
  for (int i = 1; i <= sewing.NbFreeEdges(); i++) sewn.open.push_back(sewing.FreeEdge(i));
  const std::vector<TopoDS_Shell> shells = shells_of(sewing.SewedShape());
  if (!sewn.open.empty()) {
    BRep_Builder builder;
    TopoDS_Solid solid;
    builder.MakeSolid(solid);
    for (const TopoDS_Shell &shell : shells) builder.Add(solid, shell);
    sewn.solids = {solid};
    return sewn;
  }
  std::vector<Body> bodies;
  for (const TopoDS_Shell &shell : shells) bodies.push_back(body_of(shell));
  find_holders(gap, bodies);
  sewn.solids = nested(bodies);
  return sewn;
}

CwOpening cw_cad_opening(const TopoDS_Edge &edge, const std::vector<TopoDS_Edge> &open) {
  constexpr int steps = 4;
  CwOpening opening;
  BRep_Builder builder;
  TopoDS_Compound others;
  builder.MakeCompound(others);
  for (const TopoDS_Edge &other : open)
    if (!other.IsSame(edge)) builder.Add(others, other);
  const std::vector<gp_Pnt> points = cw_cad_edge_points(edge, steps);
  opening.at = points[steps / 2];
  if (others.NbChildren() == 0) return opening;
  for (const gp_Pnt &point : points) {
    const BRepExtrema_DistShapeShape distance(BRepBuilderAPI_MakeVertex(point).Vertex(), others);
    if (distance.IsDone() && distance.Value() > opening.gap) opening = {distance.Value(), point};
  }
  return opening;
}
