// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/passages.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_Section.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepClass_FaceClassifier.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom2d_Curve.hxx>
#include <Precision.hxx>
#include <ShapeConstruct_ProjectCurveOnSurface.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <gp_Circ.hxx>

#include "geometry/cad/cad_part.hpp"
#include "geometry/cad/images.hpp"
#include "geometry/shell_builder.hpp"

namespace {

const double BEYOND = 2;    // of the greatest coordinate: how far the meridians reach
const double SAME = 1e-7;   // model units: curves that are periodic images already
const double EXACT = 1e-10; // model units: images that differ by the rounding of a file's numbers
const double DISC = 0.5;    // of the way from the axis to the outline of a face: the disc that meridians leave out
enum { SAMPLES = 5, OUTLINE_STEPS = 40, ANGLES = 48, BESIDE = 2 };

// Whether the axis goes through a plane face, at right angles.
bool meets_axis(const TopoDS_Face &face) {
  const GeomAdaptor_Surface surface(BRep_Tool::Surface(face));
  if (surface.GetType() != GeomAbs_Plane) return false;
  const gp_Pln plane = surface.Plane();
  if (std::fabs(plane.Axis().Direction().Z()) < 1 - Precision::Angular()) return false;
  BRepClass_FaceClassifier classifier(face, gp_Pnt(0, 0, plane.Location().Z()), Precision::Confusion());
  return classifier.State() == TopAbs_IN;
}

// Points along the outline of a face.
std::vector<std::vector<gp_Pnt>> outline_of(const TopoDS_Face &face) {
  std::vector<std::vector<gp_Pnt>> points;
  for (TopExp_Explorer at(face, TopAbs_EDGE); at.More(); at.Next())
    points.push_back(cw_cad_edge_points(TopoDS::Edge(at.Current()), OUTLINE_STEPS));
  return points;
}

// Least and greatest distance of the outline from the axis.
std::pair<double, double> radii_of(const TopoDS_Face &face) {
  std::pair<double, double> radii(INFINITY, 0);
  for (const std::vector<gp_Pnt> &edge : outline_of(face))
    for (const gp_Pnt &at : edge) {
      radii.first = std::min(radii.first, std::hypot(at.X(), at.Y()));
      radii.second = std::max(radii.second, std::hypot(at.X(), at.Y()));
    }
  return radii;
}

// Faces that are their own images, but for round discs: those need no cut, and meridians would meet in them.
std::vector<TopoDS_Face> faces_to_cut(const CwImagesOfSolid &images) {
  std::vector<TopoDS_Face> found;
  for (int f = 0; f < images.faces.Extent(); f++) {
    const TopoDS_Face &face = TopoDS::Face(images.faces(f + 1));
    if (!images.is_fixed(f)) continue;
    const auto [least, most] = radii_of(face);
    if (!meets_axis(face) || most - least > SAME * most) found.push_back(face);
  }
  return found;
}

// The angle of the first meridian: where least of the faces' outlines runs beside it, all turned into one passage, so
// that it meets blades at steep angles and no corners.
double free_angle(const std::vector<TopoDS_Face> &faces, int count) {
  const double pitch = 2 * M_PI / count;
  std::vector<double> beside(ANGLES), outline(ANGLES);
  for (const TopoDS_Face &face : faces)
    for (const std::vector<gp_Pnt> &edge : outline_of(face))
      for (size_t i = 1; i < edge.size(); i++) {
        const double angle = std::fmod(std::atan2(edge[i].Y(), edge[i].X()) + 2 * M_PI, pitch);
        outline[std::min((int)(ANGLES * angle / pitch), ANGLES - 1)] += edge[i].Distance(edge[i - 1]);
      }
  for (int i = 0; i < ANGLES; i++)
    for (int k = -BESIDE; k <= BESIDE; k++) beside[i] += outline[(i + k + ANGLES) % ANGLES];
  return pitch * (std::min_element(beside.begin(), beside.end()) - beside.begin() + 0.5) / ANGLES;
}

// A meridian from a radius on.
TopoDS_Face half_plane(const TopoDS_Shape &solid, double angle, double radius) {
  double most = 0;
  for (const double x : cw_cad_box(solid)) most = std::max(most, std::fabs(x));
  most *= BEYOND;
  const gp_Ax3 axes(gp::Origin(), gp_Dir(-std::sin(angle), std::cos(angle), 0),
                    gp_Dir(std::cos(angle), std::sin(angle), 0));
  return BRepBuilderAPI_MakeFace(gp_Pln(axes), radius, most, -most, most).Face();
}

void add_turned(const TopoDS_Edge &edge, int from, const CwImagesOfSolid &images, TopTools_ListOfShape &tools) {
  double first, last;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
  for (int k = from; k < images.count; k++)
    tools.Append(
        BRepBuilderAPI_MakeEdge(Handle(Geom_Curve)::DownCast(curve->Transformed(images.turn(k))), first, last).Edge());
}

void cut(const TopTools_ListOfShape &tools, CwCadPart &part) {
  if (tools.IsEmpty()) return;
  const std::vector<TopoDS_Shape> solids = cw_cad_split(part.solid, tools);
  if (solids.size() == 1) cw_cad_replace(solids[0], part);
}

bool is_on_meridian(const TopoDS_Edge &edge) {
  const std::vector<gp_Pnt> points = cw_cad_edge_points(edge, SAMPLES);
  for (const gp_Pnt &at : points)
    if (std::fabs(points[0].X() * at.Y() - points[0].Y() * at.X()) > SAME * std::hypot(at.X(), at.Y())) return false;
  return true;
}

bool is_revolved(const TopoDS_Face &face) {
  const GeomAdaptor_Surface surface(BRep_Tool::Surface(face));
  gp_Ax1 axis;
  switch (surface.GetType()) {
  case GeomAbs_Plane:
    axis = gp_Ax1(gp::Origin(), surface.Plane().Axis().Direction());
    break;
  case GeomAbs_Cylinder:
    axis = surface.Cylinder().Axis();
    break;
  case GeomAbs_Cone:
    axis = surface.Cone().Axis();
    break;
  case GeomAbs_Torus:
    axis = surface.Torus().Axis();
    break;
  case GeomAbs_Sphere:
    return std::hypot(surface.Sphere().Location().X(), surface.Sphere().Location().Y()) < SAME;
  case GeomAbs_SurfaceOfRevolution:
    axis = surface.AxeOfRevolution();
    break;
  default:
    return false;
  }
  return axis.Direction().IsParallel(gp::DZ(), Precision::Angular()) &&
         std::hypot(axis.Location().X(), axis.Location().Y()) < SAME;
}

// Where a seam ends at a blade, one passage has an edge between two faces of revolution and the others have none: it is
// cut into them as well.
void repeat_seams(const CwImagesOfSolid &images, CwCadPart &part) {
  TopTools_IndexedDataMapOfShapeListOfShape faces_of;
  TopTools_ListOfShape tools;
  TopExp::MapShapesAndAncestors(part.solid, TopAbs_EDGE, TopAbs_FACE, faces_of);
  for (int e = 1; e <= faces_of.Extent(); e++) {
    const TopoDS_Edge &edge = TopoDS::Edge(faces_of.FindKey(e));
    bool revolved = !BRep_Tool::Degenerated(edge) && is_on_meridian(edge);
    for (TopTools_ListIteratorOfListOfShape face(faces_of(e)); face.More() && revolved; face.Next())
      revolved = is_revolved(TopoDS::Face(face.Value()));
    if (revolved) add_turned(edge, 1, images, tools);
  }
  cut(tools, part);
}

// Cuts faces that are their own images along a meridian of each passage; off the axis, where it goes through one.
void cut_meridians(const std::vector<TopoDS_Face> &faces, const CwImagesOfSolid &images, CwCadPart &part) {
  TopTools_ListOfShape tools;
  const double angle = free_angle(faces, images.count);
  for (const TopoDS_Face &face : faces) {
    const double radius = meets_axis(face) ? DISC * radii_of(face).first : 0;
    if (radius > 0) {
      const gp_Ax2 axes(gp_Pnt(0, 0, BRepAdaptor_Surface(face).Plane().Location().Z()), gp::DZ());
      add_turned(BRepBuilderAPI_MakeEdge(gp_Circ(axes, radius), angle, angle + 2 * M_PI / images.count).Edge(), 0,
                 images, tools);
    }
    BRepAlgoAPI_Section section(face, half_plane(part.solid, angle, radius));
    for (TopExp_Explorer at(section.Shape(), TopAbs_EDGE); at.More(); at.Next())
      add_turned(TopoDS::Edge(at.Current()), 0, images, tools);
  }
  cut(tools, part);
}

// Makes the solid anew from periodic images of the first faces, edges and vertices.
class Copies {
public:
  explicit Copies(const CwImagesOfSolid &images) : images(images) {}
  TopoDS_Shape make(double unit);

private:
  using Loops = std::vector<std::vector<CwEdgeUse>>;
  const CwImagesOfSolid &images;
  CwShellBuilder builder;
  std::vector<std::vector<int>> vertex, edge; // in the builder: of the first of a set, by turns

  const TopoDS_Edge &old_edge(int e) const {
    return TopoDS::Edge(images.edges(e + 1));
  }
  int vertex_number(const TopoDS_Shape &shape) const {
    return images.vertices.FindIndex(shape) - 1;
  }
  // The copy, in the builder, in the place that `turns` turns take an item to.
  int copy_of(const std::vector<std::vector<int>> &copies, const CwImageSet &set, int item, int turns) const {
    return copies[set.first[item]][(set.turns[item] + turns) % images.count];
  }
  Handle(Geom_Curve) copied_curve(int first, int turns, double range[2]) const;
  void add_vertices();
  void add_edges();
  CwEdgeUse use_of(const TopoDS_Edge &used, const TopoDS_Face &face) const;
  Loops loops_of(int f) const;
  void add_face(int f, const Loops &loops);
};

Handle(Geom_Curve) Copies::copied_curve(int first, int turns, double range[2]) const {
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(old_edge(first), range[0], range[1]);
  return Handle(Geom_Curve)::DownCast(curve->Transformed(images.turn(turns)));
}

void Copies::add_vertices() {
  vertex.resize(images.vertices.Extent());
  for (int v = 0; v < images.vertices.Extent(); v++) {
    if (images.vertex.first[v] != v) continue;
    const gp_Pnt point = BRep_Tool::Pnt(TopoDS::Vertex(images.vertices(v + 1)));
    if (images.vertex.next[v] == v) { // one for all turns, on the axis
      vertex[v].assign(images.count, builder.vertex(gp_Pnt(0, 0, point.Z())));
      continue;
    }
    for (int k = 0; k < images.count; k++) vertex[v].push_back(builder.vertex(point.Transformed(images.turn(k))));
  }
}

void Copies::add_edges() {
  edge.resize(images.edges.Extent());
  for (int e = 0; e < images.edges.Extent(); e++) {
    if (images.edge.first[e] != e) continue;
    const TopoDS_Edge forward = TopoDS::Edge(old_edge(e).Oriented(TopAbs_FORWARD));
    const int begin = vertex_number(TopExp::FirstVertex(forward)), end = vertex_number(TopExp::LastVertex(forward));
    for (int k = 0; k < images.count; k++) {
      double range[2];
      if (BRep_Tool::Degenerated(forward)) {
        BRep_Tool::Range(forward, range[0], range[1]);
        edge[e].push_back(builder.pole(range[0], range[1], copy_of(vertex, images.vertex, begin, k)));
        continue;
      }
      const Handle(Geom_Curve) curve = copied_curve(e, k, range);
      edge[e].push_back(builder.edge(curve, range[0], range[1], copy_of(vertex, images.vertex, begin, k),
                                     copy_of(vertex, images.vertex, end, k)));
    }
  }
}

// A curve that a projection has made, in the period of the one that it takes the place of.
void shift_to(const gp_Pnt2d &at, const gp_Pnt2d &wanted, const Geom_Surface &surface, Geom2d_Curve &curve) {
  gp_Vec2d shift(at, wanted);
  shift.SetX(surface.IsUPeriodic() ? surface.UPeriod() * std::round(shift.X() / surface.UPeriod()) : 0);
  shift.SetY(surface.IsVPeriodic() ? surface.VPeriod() * std::round(shift.Y() / surface.VPeriod()) : 0);
  if (shift.Magnitude() > 0) curve.Translate(shift);
}

// How a first face, forward, uses the copy in the place of one of its edges; `edge` of it is that edge's number.
CwEdgeUse Copies::use_of(const TopoDS_Edge &used, const TopoDS_Face &face) const {
  double range[2], own[2];
  const int e = images.edges.FindIndex(used) - 1;
  if (BRep_Tool::Degenerated(used))
    return {e, used.Orientation() == TopAbs_FORWARD,
            BRep_Tool::CurveOnSurface(TopoDS::Edge(old_edge(e).Oriented(TopAbs_FORWARD)), face, own[0], own[1])};
  const Handle(Geom_Curve) copy = copied_curve(images.edge.first[e], images.edge.turns[e], range);
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(old_edge(e), own[0], own[1]);
  const gp_Pnt at = copy->Value(range[0] + (range[1] - range[0]) / 3);
  const bool alike = at.Distance(curve->Value(own[0] + (own[1] - own[0]) / 3)) <=
                     at.Distance(curve->Value(own[1] - (own[1] - own[0]) / 3));
  const bool forward = (used.Orientation() == TopAbs_FORWARD) == alike;
  const Handle(Geom2d_Curve) old =
      BRep_Tool::CurveOnSurface(TopoDS::Edge(old_edge(e).Oriented(TopAbs_FORWARD)), face, own[0], own[1]);
  if (old.IsNull()) throw Standard_Failure("an edge has no curve on its face");
  bool same = alike && std::fabs(range[0] - own[0]) + std::fabs(range[1] - own[1]) <= Precision::PConfusion();
  for (int i = 0; i <= SAMPLES && same; i++) {
    const double t = range[0] + (range[1] - range[0]) * i / SAMPLES;
    same = copy->Value(t).Distance(curve->Value(t)) <= SAME;
  }
  if (same) return {e, forward, old};
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  ShapeConstruct_ProjectCurveOnSurface projector;
  projector.Init(surface, Precision::Confusion());
  Handle(Geom_Curve) onto = copy;
  Handle(Geom2d_Curve) made;
  if (!projector.Perform(onto, range[0], range[1], made) || made.IsNull())
    throw Standard_Failure("an edge cannot be brought onto its face");
  shift_to(made->Value((range[0] + range[1]) / 2), old->Value((own[0] + own[1]) / 2), *surface.get(), *made.get());
  return {e, forward, made};
}

// The loops of a first face, with the numbers of its edges.
Copies::Loops Copies::loops_of(int f) const {
  const TopoDS_Face face = TopoDS::Face(images.faces(f + 1).Oriented(TopAbs_FORWARD));
  Loops loops;
  for (TopExp_Explorer wire(face, TopAbs_WIRE); wire.More(); wire.Next()) {
    loops.emplace_back();
    for (BRepTools_WireExplorer at(TopoDS::Wire(wire.Current()), face); at.More(); at.Next())
      loops.back().push_back(use_of(at.Current(), face));
  }
  return loops;
}

// `loops`: of the first face of its set.
void Copies::add_face(int f, const Loops &loops) {
  const int first = images.face.first[f], turns = images.face.turns[f];
  const TopoDS_Face face = TopoDS::Face(images.faces(first + 1));
  Loops turned = loops;
  for (std::vector<CwEdgeUse> &loop : turned)
    for (CwEdgeUse &use : loop) use.edge = copy_of(edge, images.edge, use.edge, turns);
  builder.face(Handle(Geom_Surface)::DownCast(BRep_Tool::Surface(face)->Transformed(images.turn(turns))), turned,
               face.Orientation() == TopAbs_FORWARD, "", CW_PATCH_WALL, std::to_string(f + 1));
}

// Faces stay in the order of the given solid.
TopoDS_Shape Copies::make(double unit) {
  std::map<int, Loops> loops;
  add_vertices();
  add_edges();
  for (int f = 0; f < images.faces.Extent(); f++)
    if (images.face.first[f] == f) loops[f] = loops_of(f);
  for (int f = 0; f < images.faces.Extent(); f++) add_face(f, loops[images.face.first[f]]);
  const std::unique_ptr<CwSolid> solid(builder.finish("", unit));
  return solid->solid;
}

// Why the part stays as it is, "" where it is symmetric now; *off: by how much its faces moved, at most.
std::string make_symmetric(int count, double tolerance, double unit, CwCadPart &part, double *off) {
  CwImagesOfSolid images;
  CwCadPart made = part;
  std::string why = images.find(made.solid, count, tolerance, unit);
  if (!why.empty()) {
    repeat_seams(images, made);
    if (!images.find(made.solid, count, tolerance, unit).empty()) return why; // of the solid as it was
    why = "";
  }
  const std::vector<TopoDS_Face> faces = faces_to_cut(images);
  if (faces.empty() && images.off <= EXACT && made.solid.IsSame(part.solid)) return "";
  if (!faces.empty()) {
    cut_meridians(faces, images, made);
    why = images.find(made.solid, count, tolerance, unit);
    if (!why.empty()) return why;
    if (!faces_to_cut(images).empty()) return "a face of revolution cannot be cut";
  }
  images.choose();
  const TopoDS_Shape copies = Copies(images).make(unit);
  if (!BRepCheck_Analyzer(copies).IsValid()) return "periodic images make no valid solid";
  cw_cad_replace(copies, made);
  part = made;
  *off = images.off;
  return "";
}

} // namespace

CwStatus cw_cad_passages(int part, int count, double tolerance, CwLog *log, CwCadParts *parts) {
  CwCadPart &of = parts->part[part];
  return cw_cad_guard("cad.domains." + of.domain, [&] {
    std::string why;
    double off = 0;
    try {
      why = make_symmetric(count, tolerance, parts->unit, of, &off);
    } catch (const Standard_Failure &failure) {
      why = "OpenCASCADE: " + cw_solid_failure_text(failure);
    }
    if (why.empty())
      cw_log(log, "%s: %d faces, periodic images of those of one of %d passages, %.2g mm off those of the file at most",
             of.domain.c_str(), (int)of.origin.size(), count, 1e3 * parts->unit * off);
    else
      cw_log(log, "%s: %s; it will be meshed whole, not one of %d passages; cad.tolerance_mm is %.3g",
             of.domain.c_str(), why.c_str(), count, 1e3 * parts->unit * tolerance);
    return CW_OK;
  });
}
