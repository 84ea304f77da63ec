// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/background_tessellate.h"

#include <array>
#include <cstdlib>
#include <vector>

#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <Standard_Failure.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include "mesher/cad_shape.h"

namespace {

struct Weld {
  std::vector<std::array<double, 3>> x;
  std::vector<std::array<int32_t, 3>> triangle;
  std::vector<int32_t> face;
  std::vector<std::array<double, 6>> uv;
  // Point of each node of each face's triangulation; -1: not met yet.
  std::vector<std::vector<int32_t>> node;
};

Handle(Poly_Triangulation) triangulation_of(const CwCad *cad, int face, TopLoc_Location &location) {
  return BRep_Tool::Triangulation(TopoDS::Face(cad->face_map(face + 1)), location);
}

int32_t add_point(Weld &weld, const double x[3]) {
  weld.x.push_back({x[0], x[1], x[2]});
  return (int32_t)weld.x.size() - 1;
}

// Gives the nodes of edge `e` one point each, in both faces.
CwStatus weld_edge(const CwCad *cad, int e, Weld &weld) {
  const CwCadEdge &edge = cad->edge[e];
  TopoDS_Edge shape = TopoDS::Edge(cad->edge_map(e + 1));
  std::vector<int32_t> point;
  for (int side = 0; side < 2; side++) {
    int face = edge.face[side];
    TopLoc_Location location;
    Handle(Poly_Triangulation) triangulation = triangulation_of(cad, face, location);
    Handle(Poly_PolygonOnTriangulation) polygon =
        BRep_Tool::PolygonOnTriangulation(shape, triangulation, location);
    double x[3];
    cw_cad_vertex_point(cad, edge.vertex[0], x);
    if (polygon.IsNull() || !polygon->HasParameters() ||
        (side == 1 && polygon->NbNodes() != (int)point.size())) {
      return CW_FAIL(
          CW_ERR_GEOMETRY,
          "faces '%s' and '%s': the tessellations do not match along their edge at (%.3f, %.3f, %.3f) mm",
          cw_cad_face_name(cad, edge.face[0]), cw_cad_face_name(cad, edge.face[1]), x[0] * 1e3, x[1] * 1e3,
          x[2] * 1e3);
    }
    int count = polygon->NbNodes();
    if (side == 0) {
      point.push_back(edge.vertex[0]);
      for (int i = 2; i < count; i++) {
        cw_cad_edge_point(cad, e, polygon->Parameter(i), x, nullptr);
        point.push_back(add_point(weld, x));
      }
      point.push_back(edge.vertex[1]);
    }
    for (int i = 1; i <= count; i++)
      weld.node[face][polygon->Node(i) - 1] = point[i - 1];
  }
  return CW_OK;
}

void add_face(const CwCad *cad, int face, Weld &weld) {
  TopLoc_Location location;
  Handle(Poly_Triangulation) triangulation = triangulation_of(cad, face, location);
  std::vector<int32_t> &node = weld.node[face];
  for (int t = 1; t <= triangulation->NbTriangles(); t++) {
    int n[3];
    triangulation->Triangle(t).Get(n[0], n[1], n[2]);
    if (cw_cad_face_reversed(cad, face))
      std::swap(n[1], n[2]);
    std::array<int32_t, 3> corner;
    std::array<double, 6> uv;
    for (int k = 0; k < 3; k++) {
      gp_Pnt2d parameter = triangulation->UVNode(n[k]);
      uv[2 * k] = parameter.X();
      uv[2 * k + 1] = parameter.Y();
      if (node[n[k] - 1] < 0) {
        double x[3];
        cw_cad_face_point(cad, face, &uv[2 * k], x, nullptr, nullptr);
        node[n[k] - 1] = add_point(weld, x);
      }
      corner[k] = node[n[k] - 1];
    }
    // The library closes slits with triangles between two nodes of one vertex; they fold away in the weld.
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0])
      continue;
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
  for (size_t i = 0; i < points; i++) {
    for (int k = 0; k < 3; k++)
      background->x[i][k] = weld.x[i][k];
  }
  for (size_t t = 0; t < triangles; t++) {
    background->face[t] = weld.face[t];
    for (int k = 0; k < 3; k++) {
      background->triangle[t][k] = weld.triangle[t][k];
      background->uv[t][k][0] = weld.uv[t][2 * k];
      background->uv[t][k][1] = weld.uv[t][2 * k + 1];
    }
  }
done:
  return status;
}

CwStatus tessellate(CwCad *cad, double deflection, double angle, CwBackground *background) {
  BRepTools::Clean(cad->solid);
  BRepMesh_IncrementalMesh mesher(cad->solid, deflection * 1e3, Standard_False, angle, Standard_False);
  Weld weld;
  weld.node.resize(cad->face.size());
  for (int f = 0; f < cw_cad_face_count(cad); f++) {
    TopLoc_Location location;
    Handle(Poly_Triangulation) triangulation = triangulation_of(cad, f, location);
    if (triangulation.IsNull() || !triangulation->HasUVNodes() || triangulation->NbTriangles() == 0) {
      return CW_FAIL(CW_ERR_GEOMETRY, "face '%s' cannot be tessellated", cw_cad_face_name(cad, f));
    }
    weld.node[f].assign(triangulation->NbNodes(), -1);
  }
  for (int v = 0; v < cw_cad_vertex_count(cad); v++) {
    double x[3];
    cw_cad_vertex_point(cad, v, x);
    add_point(weld, x);
  }
  for (int e = 0; e < cw_cad_edge_count(cad); e++) {
    CwStatus status = weld_edge(cad, e, weld);
    if (status != CW_OK)
      return status;
  }
  for (int f = 0; f < cw_cad_face_count(cad); f++)
    add_face(cad, f, weld);
  BRepTools::Clean(cad->solid); // the weld holds all of it now
  return hand_over(weld, background);
}

} // namespace

CwStatus cw_background_tessellate(CwCad *cad, double deflection, double angle, CwBackground *background) {
  try {
    return tessellate(cad, deflection, angle, background);
  } catch (const Standard_Failure &failure) {
    const char *text = failure.GetMessageString();
    return CW_FAIL(CW_ERR_LIBRARY, "OpenCASCADE failed to tessellate: %s", text ? text : "?");
  } catch (const std::exception &failure) {
    return CW_FAIL(CW_ERR_LIBRARY, "the tessellation failed: %s", failure.what());
  }
}
