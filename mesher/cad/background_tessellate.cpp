// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/background_tessellate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <vector>

#include <BRepMesh_Context.hxx>
#include <BRepMesh_DelaunayBaseMeshAlgo.hxx>
#include <BRepMesh_DelaunayDeflectionControlMeshAlgo.hxx>
#include <BRepMesh_MeshAlgoFactory.hxx>
#include <BRepMesh_NURBSRangeSplitter.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <IMeshData_Edge.hxx>
#include <IMeshData_Model.hxx>
#include <Message_ProgressRange.hxx>
#include <Poly_Triangulation.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>

#include "mesher/cad/cad_shape.h"
#include "mesher/common/model_unit.h"

struct CwTessellation {
  const CwCad *cad;
  Handle(BRepMesh_Context) context;
  std::map<const TopoDS_TShape *, std::vector<int>> model_edges; // the model's edges of each kind
  std::vector<std::vector<int>> face_edge;                       // edges of each face, ascending
};

namespace {

const double POINTS_FOR_AREA = 2e-4; // per deflection squared: of a face that bends both ways, by that of its box

// A face as it travels between ranks: head, nodes, triangles, and for each of its edges, ascending, number, count of
// nodes and the nodes in the order of the edge's parameter.
struct Head {
  int32_t nodes, triangles;
};

struct Node {
  double uv[2], x[3]; // x: of nodes on edges only where the face is the first of the edge
};

struct Block {
  Head head;
  const Node *node;
  const int32_t (*triangle)[3];
  const int32_t *side; // the edges not yet read
};

Block block_of(const void *bytes) {
  Block block;
  memcpy(&block.head, bytes, sizeof block.head);
  block.node = (const Node *)((const char *)bytes + sizeof block.head);
  block.triangle = (const int32_t(*)[3])(block.node + block.head.nodes);
  block.side = (const int32_t *)(block.triangle + block.head.triangles);
  return block;
}

struct Weld {
  std::vector<std::array<double, 3>> x;
  std::vector<std::array<int32_t, 3>> triangle;
  std::vector<int32_t> face;
  std::vector<std::array<double, 6>> uv;
  std::vector<Block> block;
  // Point of each node of each face; -1: not met yet.
  std::vector<std::vector<int32_t>> node;
};

int32_t add_point(Weld &weld, const double x[3]) {
  weld.x.push_back({x[0], x[1], x[2]});
  return (int32_t)weld.x.size() - 1;
}

// Gives the nodes of edge `e` one point each, in both faces.
CwStatus weld_edge(const CwCad *cad, int e, Weld &weld) {
  const CwCadEdge &edge = cad->edge[e];
  std::vector<int32_t> point;
  for (int side = 0; side < 2; side++) {
    int face = edge.face[side];
    Block &block = weld.block[face];
    int32_t count = block.side[1];
    const int32_t *node = block.side + 2;
    if (side == 1 && count != (int32_t)point.size()) {
      double x[3];
      cw_cad_vertex_point(cad, edge.vertex[0], x);
      return CW_FAIL(CW_ERR_GEOMETRY,
                     "faces '%s' and '%s': the tessellations do not match along their edge at (%.3f, %.3f, %.3f) mm",
                     cw_cad_face_name(cad, edge.face[0]), cw_cad_face_name(cad, edge.face[1]), CW_MM(x));
    }
    if (side == 0) {
      point.push_back(edge.vertex[0]);
      for (int32_t i = 1; i + 1 < count; i++) point.push_back(add_point(weld, block.node[node[i]].x));
      point.push_back(edge.vertex[1]);
    }
    for (int32_t i = 0; i < count; i++) weld.node[face][node[i]] = point[i];
    block.side = node + count;
  }
  return CW_OK;
}

void add_face(const CwCad *cad, int face, Weld &weld) {
  const Block &block = weld.block[face];
  std::vector<int32_t> &node = weld.node[face];
  const int vertex = cad->face[face].pole.vertex;
  for (int32_t n = 0; vertex >= 0 && n < block.head.nodes; n++)
    if (block.node[n].uv[0] == 0 && block.node[n].uv[1] == 0) node[n] = vertex;
  for (int32_t t = 0; t < block.head.triangles; t++) {
    std::array<int32_t, 3> corner;
    std::array<double, 6> uv;
    for (int k = 0; k < 3; k++) {
      int32_t n = block.triangle[t][k];
      if (node[n] < 0) node[n] = add_point(weld, block.node[n].x);
      uv[2 * k] = block.node[n].uv[0];
      uv[2 * k + 1] = block.node[n].uv[1];
      corner[k] = node[n];
    }
    // The library closes slits with triangles between two nodes of one vertex; they fold away in the weld.
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
    weld.triangle.push_back(corner);
    weld.face.push_back(face);
    weld.uv.push_back(uv);
  }
}

CwStatus hand_over(const Weld &weld, CwBackground *background) {
  CwStatus status = CW_OK;
  size_t points = weld.x.size(), triangles = weld.triangle.size();
  background->point_count = (int32_t)points;
  background->triangle_count = (int32_t)triangles;
  background->x = (double(*)[3])calloc(points + 1, sizeof *background->x);
  background->triangle = (int32_t(*)[3])calloc(triangles + 1, sizeof *background->triangle);
  background->face = (int32_t *)calloc(triangles + 1, sizeof *background->face);
  background->uv = (double(*)[3][2])calloc(triangles + 1, sizeof *background->uv);
  CW_REQUIRE(background->x && background->triangle && background->face && background->uv, CW_ERR_MEMORY,
             "out of memory: %zu background triangles", triangles);
  memcpy(background->x, weld.x.data(), points * sizeof *background->x);
  memcpy(background->triangle, weld.triangle.data(), triangles * sizeof *background->triangle);
  memcpy(background->face, weld.face.data(), triangles * sizeof *background->face);
  memcpy(background->uv, weld.uv.data(), triangles * sizeof *background->uv);
done:
  return status;
}

CwStatus start(const CwCad *cad, double deflection, double angle, CwTessellation &made) {
  IMeshTools_Parameters parameters;
  parameters.Deflection = parameters.DeflectionInterior = deflection / cad->unit;
  parameters.Angle = angle;
  parameters.AngleInterior = 2 * angle;
  parameters.MinSize = std::max(IMeshTools_Parameters::RelMinSize() * parameters.Deflection, Precision::Confusion());
  made.cad = cad;
  BRepTools::Clean(cad->solid);
  made.context = new BRepMesh_Context;
  made.context->SetShape(cad->solid);
  made.context->ChangeParameters() = parameters;
  if (!made.context->BuildModel() || !made.context->DiscretizeEdges() || !made.context->HealModel() ||
      !made.context->PreProcessModel()) {
    return CW_FAIL(CW_ERR_LIBRARY, "solid of face '%s': OpenCASCADE failed to divide the edges",
                   cw_cad_face_name(cad, 0));
  }
  const Handle(IMeshData_Model) &model = made.context->GetModel();
  for (int i = 0; i < model->EdgesNb(); i++) {
    made.model_edges[model->GetEdge(i)->GetEdge().TShape().get()].push_back(i);
  }
  made.face_edge.resize(cad->face.size());
  for (int e = 0; e < (int)cad->edge.size(); e++) {
    for (int face : cad->edge[e].face) made.face_edge[face].push_back(e);
  }
  return CW_OK;
}

// The divided curve of an edge on a face of the model. Of faces that are one but for their place, and of edges of that
// kind, the library may know one alone.
IMeshData::IPCurveHandle pcurve_of(const CwTessellation &tessellation, int e, const IMeshData::IFaceHandle &face) {
  const TopoDS_Shape &shape = tessellation.cad->edge_map(e + 1);
  IMeshData::IPCurveHandle found;
  for (int i : tessellation.model_edges.at(shape.TShape().get())) {
    IMeshData::IEdgeHandle edge = tessellation.context->GetModel()->GetEdge(i);
    for (int k = 0; k < edge->PCurvesNb(); k++) {
      if (edge->GetPCurve(k)->GetFace() != face.get()) continue;
      if (edge->GetEdge().IsSame(shape)) return edge->GetPCurve(k);
      found = edge->GetPCurve(k);
    }
  }
  return found;
}

// The library's way for B-spline surfaces, but for the cells of the grid in which it looks for circles: it takes about
// sqrt(n) along each side, and the circles of slender triangles, as those of a volute are in (u,v), fill hundreds of
// them each. Of the square root of that the triangles are the same, and take a tenth of the time.
using UsualSplineWay =
    BRepMesh_DelaunayDeflectionControlMeshAlgo<BRepMesh_NURBSRangeSplitter, BRepMesh_DelaunayBaseMeshAlgo>;
class SplineWay : public UsualSplineWay {
protected:
  std::pair<Standard_Integer, Standard_Integer> getCellsCount(const Standard_Integer nodes) override {
    const auto usual = UsualSplineWay::getCellsCount(nodes);
    return {(int)std::ceil(std::sqrt(usual.first)), (int)std::ceil(std::sqrt(usual.second))};
  }
};

// How the library triangulates a face; null where it cannot.
Handle(IMeshTools_MeshAlgo) way_of(const IMeshData::IFaceHandle &face, const IMeshTools_Parameters &parameters) {
  const GeomAbs_SurfaceType type = face->GetSurface()->GetType();
  if (type == GeomAbs_BSplineSurface) return new SplineWay;
  return BRepMesh_MeshAlgoFactory().GetAlgo(type, parameters);
}

// The model's face of a face of the solid, triangulated; null where that fails.
IMeshData::IFaceHandle triangulate(const CwTessellation &tessellation, const TopoDS_Face &shape) {
  const Handle(IMeshData_Model) &model = tessellation.context->GetModel();
  TopLoc_Location location;
  for (int i = 0; i < model->FacesNb(); i++) {
    IMeshData::IFaceHandle face = model->GetFace(i);
    if (!face->GetFace().IsPartner(shape)) continue;
    Handle(IMeshTools_MeshAlgo) way = way_of(face, tessellation.context->GetParameters());
    if (face->IsSet(IMeshData_Failure) || way.IsNull()) break;
    if (BRep_Tool::Triangulation(shape, location).IsNull())
      way->Perform(face, tessellation.context->GetParameters(), Message_ProgressRange());
    return face;
  }
  return IMeshData::IFaceHandle();
}

// Nodes of the triangulation along the edges of the face; the points of those edges of which it is the first. False
// where the library has not divided an edge on it.
bool take_sides(const CwTessellation &tessellation, int face, const IMeshData::IFaceHandle &model_face,
                std::vector<Node> &node, std::vector<int32_t> &side) {
  const CwCad *cad = tessellation.cad;
  for (int e : tessellation.face_edge[face]) {
    IMeshData::IPCurveHandle along = pcurve_of(tessellation, e, model_face);
    if (along.IsNull()) return false;
    side.push_back(e);
    side.push_back(along->ParametersNb());
    for (int i = 0; i < along->ParametersNb(); i++) {
      int32_t n = along->GetIndex(i) - 1;
      side.push_back(n);
      if (cad->edge[e].face[0] == face) cw_cad_edge_point(cad, e, along->GetParameter(i), node[n].x, nullptr);
    }
  }
  return true;
}

CwStatus make_face(const CwTessellation &tessellation, int face, void **bytes, int64_t *byte_count) {
  const CwCad *cad = tessellation.cad;
  const TopoDS_Face &shape = TopoDS::Face(cad->face_map(face + 1));
  IMeshData::IFaceHandle model_face = triangulate(tessellation, shape);
  TopLoc_Location location;
  Handle(Poly_Triangulation) made = BRep_Tool::Triangulation(shape, location);
  if (model_face.IsNull() || made.IsNull() || !made->HasUVNodes() || made->NbTriangles() == 0) {
    return CW_FAIL(CW_ERR_GEOMETRY, "face '%s' cannot be tessellated", cw_cad_face_name(cad, face));
  }
  std::vector<Node> node(made->NbNodes());
  std::vector<int32_t> side;
  std::vector<std::array<int32_t, 3>> triangle(made->NbTriangles());
  for (int n = 0; n < made->NbNodes(); n++) {
    gp_Pnt2d parameter = made->UVNode(n + 1);
    node[n] = {{parameter.X(), parameter.Y()}, {0, 0, 0}};
    if (cad->face[face].pole.is) cad->face[face].pole.to_plane(node[n].uv);
    cw_cad_face_point(cad, face, node[n].uv, node[n].x, nullptr, nullptr);
  }
  for (int t = 0; t < made->NbTriangles(); t++) {
    int n[3];
    made->Triangle(t + 1).Get(n[0], n[1], n[2]);
    if (cw_cad_face_reversed(cad, face)) std::swap(n[1], n[2]);
    for (int k = 0; k < 3; k++) triangle[t][k] = n[k] - 1;
  }
  if (!take_sides(tessellation, face, model_face, node, side)) {
    return CW_FAIL(CW_ERR_GEOMETRY, "face '%s': an edge cannot be tessellated", cw_cad_face_name(cad, face));
  }
  Head head = {(int32_t)node.size(), (int32_t)triangle.size()};
  size_t nodes = node.size() * sizeof node[0], triangles = triangle.size() * sizeof triangle[0],
         sides = side.size() * sizeof side[0];
  char *block = (char *)malloc(sizeof head + nodes + triangles + sides);
  if (!block) return CW_FAIL(CW_ERR_MEMORY, "out of memory: %d background triangles", head.triangles);
  memcpy(block, &head, sizeof head);
  memcpy(block + sizeof head, node.data(), nodes);
  memcpy(block + sizeof head + nodes, triangle.data(), triangles);
  memcpy(block + sizeof head + nodes + triangles, side.data(), sides);
  *bytes = block;
  *byte_count = (int64_t)(sizeof head + nodes + triangles + sides);
  return CW_OK;
}

CwStatus weld_faces(const CwCad *cad, void *const *bytes, CwBackground *background) {
  Weld weld;
  size_t points = (size_t)cw_cad_vertex_count(cad), triangles = 0;
  for (int f = 0; f < cw_cad_face_count(cad); f++) {
    weld.block.push_back(block_of(bytes[f]));
    weld.node.emplace_back(weld.block[f].head.nodes, -1);
    points += (size_t)weld.block[f].head.nodes;
    triangles += (size_t)weld.block[f].head.triangles;
  }
  weld.x.reserve(points);
  weld.triangle.reserve(triangles);
  weld.face.reserve(triangles);
  weld.uv.reserve(triangles);
  for (int v = 0; v < cw_cad_vertex_count(cad); v++) {
    double x[3];
    cw_cad_vertex_point(cad, v, x);
    add_point(weld, x);
  }
  for (int e = 0; e < cw_cad_edge_count(cad); e++) {
    CwStatus status = weld_edge(cad, e, weld);
    if (status != CW_OK) return status;
  }
  for (int f = 0; f < cw_cad_face_count(cad); f++) add_face(cad, f, weld);
  return hand_over(weld, background);
}

template <typename Work> CwStatus guarded(Work work) {
  try {
    return work();
  } catch (const Standard_Failure &failure) {
    const char *text = failure.GetMessageString();
    return CW_FAIL(CW_ERR_LIBRARY, "OpenCASCADE failed to tessellate: %s", text ? text : "?");
  } catch (const std::exception &failure) {
    return CW_FAIL(CW_ERR_LIBRARY, "the tessellation failed: %s", failure.what());
  }
}

} // namespace

CwStatus cw_tessellation_start(const CwCad *cad, double deflection, double angle, CwTessellation **tessellation) {
  CwTessellation *made = nullptr;
  CwStatus status = guarded([&] {
    made = new CwTessellation;
    return start(cad, deflection, angle, *made);
  });
  if (status != CW_OK) cw_tessellation_free(&made);
  *tessellation = made;
  return status;
}

double cw_tessellation_cost(const CwTessellation *tessellation, int face) {
  const CwCad *cad = tessellation->cad;
  double points = 0;
  Bnd_Box box;
  for (int e : tessellation->face_edge[face]) {
    int i = tessellation->model_edges.at(cad->edge_map(e + 1).TShape().get()).front();
    const IMeshData::ICurveHandle &curve = tessellation->context->GetModel()->GetEdge(i)->GetCurve();
    points += curve->ParametersNb();
    for (int k = 0; k < curve->ParametersNb(); k++) box.Add(curve->GetPoint(k));
  }
  GeomAbs_SurfaceType type = cad->face[face].surface.GetType();
  bool ruled = type == GeomAbs_Plane || type == GeomAbs_Cylinder || type == GeomAbs_Cone; // no points inside
  double deflection = tessellation->context->GetParameters().Deflection;
  return ruled || box.IsVoid() ? points : points + POINTS_FOR_AREA * box.SquareExtent() / (deflection * deflection);
}

CwStatus cw_tessellation_face(const CwTessellation *tessellation, int face, void **bytes, int64_t *byte_count) {
  return guarded([&] { return make_face(*tessellation, face, bytes, byte_count); });
}

CwStatus cw_tessellation_weld(const CwCad *cad, void *const *bytes, CwBackground *background) {
  return guarded([&] { return weld_faces(cad, bytes, background); });
}

void cw_tessellation_free(CwTessellation **tessellation) {
  if (!*tessellation) return;
  BRepTools::Clean((*tessellation)->cad->solid);
  delete *tessellation;
  *tessellation = nullptr;
}
