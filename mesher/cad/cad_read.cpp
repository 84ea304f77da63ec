// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>
#include <cstring>
#include <fstream>
#include <iostream>

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <BinTools.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>

#include "mesher/cad/cad_shape.h"
#include "mesher/common/model_unit.h"

static bool is_binary(const char *path) {
  char head[64] = {0};
  std::ifstream file(path, std::ios::binary);
  file.read(head, sizeof head - 1);
  return std::strstr(head, "Open CASCADE Topology") != nullptr;
}

static bool read_file(const char *path, TopoDS_Shape &shape) {
  bool read = false;
  std::streambuf *out = std::cout.rdbuf(nullptr); // the reader has words of its own for a damaged file
  try {
    BRep_Builder builder;
    read = is_binary(path) ? BinTools::Read(shape, path) : BRepTools::Read(shape, path, builder);
  } catch (const Standard_Failure &) { // so the binary reader, of a file cut short
  }
  std::cout.rdbuf(out);
  return read && !shape.IsNull();
}

void cw_cad_map_parts(CwCad *cad) {
  cad->face_map.Clear();
  cad->edge_map.Clear();
  cad->vertex_map.Clear();
  TopExp::MapShapes(cad->solid, TopAbs_FACE, cad->face_map);
  for (TopExp_Explorer at(cad->solid, TopAbs_EDGE); at.More(); at.Next())
    if (!BRep_Tool::Degenerated(TopoDS::Edge(at.Current()))) cad->edge_map.Add(at.Current());
  TopExp::MapShapes(cad->solid, TopAbs_VERTEX, cad->vertex_map);
}

CwStatus cw_cad_read_shape(const char *path, CwCad *cad) {
  if (!std::ifstream(path).good()) return CW_FAIL(CW_ERR_IO, "%s: cannot be read", path);
  TopoDS_Shape shape;
  if (!read_file(path, shape)) return CW_FAIL(CW_ERR_INPUT, "%s: is not a B-rep file of OpenCASCADE", path);

  int solids = 0;
  for (TopExp_Explorer it(shape, TopAbs_SOLID); it.More(); it.Next(), solids++) cad->solid = it.Current();
  if (solids != 1) return CW_FAIL(CW_ERR_INPUT, "%s: holds %d solids; it must hold one", path, solids);
  BRepTools::Clean(cad->solid); // a stored triangulation is not ours
  cad->path = path;
  cw_cad_map_parts(cad);
  return CW_OK;
}

static CwCadKnots knots_of(const TColStd_Array1OfReal &intervals) {
  CwCadKnots knots;
  for (int i = intervals.Lower(); i <= intervals.Upper(); i++) knots.knot.push_back(intervals.Value(i));
  return knots;
}

static CwCadKnots knots_along(const Adaptor3d_Surface &surface, bool along_u) {
  int count = along_u ? surface.NbUIntervals(GeomAbs_CN) : surface.NbVIntervals(GeomAbs_CN);
  double first = along_u ? surface.FirstUParameter() : surface.FirstVParameter();
  if (Precision::IsInfinite(first)) return CwCadKnots();
  TColStd_Array1OfReal intervals(1, count + 1);
  along_u ? surface.UIntervals(intervals, GeomAbs_CN) : surface.VIntervals(intervals, GeomAbs_CN);
  return knots_of(intervals);
}

template <class Curve> static CwCadKnots knots_of_curve(Curve &curve) {
  if (curve.GetType() != GeomAbs_BSplineCurve) return CwCadKnots();
  TColStd_Array1OfReal intervals(1, curve.NbIntervals(GeomAbs_CN) + 1);
  curve.Intervals(intervals, GeomAbs_CN);
  return knots_of(intervals);
}

static CwStatus edge_failure(const CwCad *cad, const TopoDS_Edge &edge, int face, const char *what) {
  TopoDS_Vertex vertex = TopExp::FirstVertex(edge);
  gp_Pnt p = vertex.IsNull() ? gp_Pnt() : BRep_Tool::Pnt(vertex);
  const double x[3] = {p.X() * cad->unit, p.Y() * cad->unit, p.Z() * cad->unit};
  return CW_FAIL(CW_ERR_INPUT, "%s: face '%s': the edge at (%.3f, %.3f, %.3f) mm %s", cad->path.c_str(),
                 face >= 0 ? cad->table.face[face].name : "?", CW_MM(x), what);
}

CwStatus cw_cad_face_failure(const CwCad *cad, int face, const Standard_Failure &failure) {
  const char *text = failure.GetMessageString();
  TopExp_Explorer corner(cad->face_map(face + 1), TopAbs_VERTEX);
  gp_Pnt p = corner.More() ? BRep_Tool::Pnt(TopoDS::Vertex(corner.Current())) : gp_Pnt();
  const double x[3] = {p.X() * cad->unit, p.Y() * cad->unit, p.Z() * cad->unit};
  return CW_FAIL(
      CW_ERR_GEOMETRY,
      "%s: face '%s' of %s, with a corner at (%.3f, %.3f, %.3f) mm, cannot be evaluated everywhere; allowed: "
      "surfaces with a normal everywhere, such as splines in place of offsets; OpenCASCADE: %s",
      cad->path.c_str(), cad->table.face[face].name, cad->table.patch[cad->table.face[face].patch].name, CW_MM(x),
      text && *text ? text : "failed without a word");
}

static CwStatus read_face(CwCad *cad, int index) {
  const TopoDS_Face &shape = TopoDS::Face(cad->face_map(index + 1));
  CwCadFace &face = cad->face[index];
  face.surface.Load(BRep_Tool::Surface(shape));
  const GeomAdaptor_Surface &surface = face.surface;
  GeomAbs_SurfaceType type = surface.GetType();
  bool swept = type == GeomAbs_SurfaceOfRevolution || type == GeomAbs_SurfaceOfExtrusion;
  if (type == GeomAbs_BSplineSurface || type == GeomAbs_OffsetSurface || swept) {
    face.u_knots = knots_along(surface, true);
    face.v_knots = knots_along(surface, false);
  }
  face.u_range[0] = surface.IsUPeriodic() ? -INFINITY : surface.FirstUParameter();
  face.u_range[1] = surface.IsUPeriodic() ? INFINITY : surface.LastUParameter();
  face.v_range[0] = surface.IsVPeriodic() ? -INFINITY : surface.FirstVParameter();
  face.v_range[1] = surface.IsVPeriodic() ? INFINITY : surface.LastVParameter();
  // A forward face of a solid has its natural normal out of it, unless the solid is inside out as a whole.
  face.reversed = shape.Orientation() == TopAbs_REVERSED;
  face.pole = CwCadPole();
  if (cw_cad_pole_find(shape, surface, cad->vertex_map, face.pole)) return CW_OK;
  TopExp_Explorer edge(shape, TopAbs_EDGE);
  while (!BRep_Tool::Degenerated(TopoDS::Edge(edge.Current()))) edge.Next();
  return edge_failure(cad, TopoDS::Edge(edge.Current()), index,
                      "is degenerate (a point), and so is another, or it is oblique; split the face between them");
}

static CwStatus read_edge(CwCad *cad, int index, const TopTools_ListOfShape &faces) {
  TopoDS_Edge shape = TopoDS::Edge(cad->edge_map(index + 1).Oriented(TopAbs_FORWARD));
  CwCadEdge &edge = cad->edge[index];
  int first = faces.IsEmpty() ? -1 : cad->face_map.FindIndex(faces.First()) - 1;
  if (faces.Extent() != 2) return edge_failure(cad, shape, first, "does not have two faces; each edge needs two");
  edge.face[0] = first;
  edge.face[1] = cad->face_map.FindIndex(faces.Last()) - 1;
  if (edge.face[0] == edge.face[1]) {
    return edge_failure(cad, shape, first, "is a seam; split the face so that each edge has two different faces");
  }
  Handle(Geom_Curve) curve = BRep_Tool::Curve(shape, edge.range[0], edge.range[1]);
  if (curve.IsNull()) return edge_failure(cad, shape, first, "has no curve in space");
  edge.curve.Load(curve);
  edge.knots = knots_of_curve(edge.curve);
  for (int side = 0; side < 2; side++) {
    double range[2];
    const TopoDS_Face &face = TopoDS::Face(cad->face_map(edge.face[side] + 1));
    Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(shape, face, range[0], range[1]);
    if (pcurve.IsNull()) return edge_failure(cad, shape, edge.face[side], "has no curve in (u,v) of that face");
    edge.pcurve[side].Load(pcurve);
    edge.pcurve_knots[side] = knots_of_curve(edge.pcurve[side]);
  }
  TopoDS_Vertex begin, end;
  TopExp::Vertices(shape, begin, end);
  if (begin.IsNull() || end.IsNull()) return edge_failure(cad, shape, first, "has no vertex at one of its ends");
  edge.vertex[0] = cad->vertex_map.FindIndex(begin) - 1;
  edge.vertex[1] = cad->vertex_map.FindIndex(end) - 1;
  return CW_OK;
}

CwStatus cw_cad_read_parts(CwCad *cad) {
  cad->face.resize(cad->face_map.Extent());
  for (int f = 0; f < cad->face_map.Extent(); f++) {
    CwStatus status;
    try {
      status = read_face(cad, f);
    } catch (const Standard_Failure &failure) {
      status = cw_cad_face_failure(cad, f, failure);
    }
    if (status != CW_OK) return status;
  }

  cad->vertex.clear();
  for (int v = 1; v <= cad->vertex_map.Extent(); v++)
    cad->vertex.push_back(BRep_Tool::Pnt(TopoDS::Vertex(cad->vertex_map(v))));
  TopTools_IndexedDataMapOfShapeListOfShape edge_faces;
  TopExp::MapShapesAndAncestors(cad->solid, TopAbs_EDGE, TopAbs_FACE, edge_faces);
  cad->edge.resize(cad->edge_map.Extent());
  for (int e = 0; e < cad->edge_map.Extent(); e++) {
    CwStatus status = read_edge(cad, e, edge_faces.FindFromKey(cad->edge_map(e + 1)));
    if (status != CW_OK) return status;
  }
  return CW_OK;
}
