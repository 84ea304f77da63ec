// SPDX-License-Identifier: AGPL-3.0-or-later
// Columns along the open edge of a cylinder that is no wall.
#include <cmath>
#include <vector>

#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>

extern "C" {
#include "mesher/region/column_place.h"
}

#include "mesher/common/vec.h"
#include "domain_surfaces.h"
#include "solids.h"

namespace {

const double radius = 5e-3, thickness = 12e-3; // m
enum { NODES = 9 };

// By shape alone: of the spline's faces the curved one is told by the middle of its (u,v).
std::string by_kind(const TopoDS_Face &face) {
  double u0, u1, v0, v1;
  BRepTools::UVBounds(face, u0, u1, v0, v1);
  gp_Pnt p = BRepAdaptor_Surface(face).Value((u0 + u1) / 2, (v0 + v1) / 2);
  bool curved = std::fabs(std::hypot(p.X(), p.Y()) - 1e3 * radius) < 1e-9;
  return curved ? "cylinder,interface" : "flat,wall";
}

// The open edge on the floor as the curve network has it, with one column on each of its nodes.
struct OpenEdge {
  CwCad *cad;
  DomainSurfaces boundary;
  CwCurve curve = {};
  CwOpenEdgePlaces places = {};
  std::vector<int32_t> node;
  double parameter[NODES][2], wall[NODES][3], top[NODES][3];
  CwCurveNodes nodes = {};
  CwConstraint constraint[NODES];

  // On the first four fifths of the open edge, so that columns may lean along it by `lean`, rad.
  OpenEdge(const TopoDS_Shape &solid, double lean) : cad(open_solid(solid, by_kind)) {
    boundary.input.cad = cad;
    curve.kind = CW_CURVE_EDGE;
    curve.wall = 1;
    curve.edge = find_open_edge();
    int face[2];
    double range[2];
    cw_cad_edge_faces(cad, curve.edge, face);
    cw_cad_edge_range(cad, curve.edge, range);
    for (int k = 0; k < 2; k++) curve.face[k] = face[k];
    int open_patch = cw_cad_face_is_wall(cad, face[0]) ? face[1] : face[0];
    for (int i = 0; i < NODES; i++) {
      parameter[i][0] = range[0] + (range[1] - range[0]) * 0.8 * i / NODES;
      cw_cad_edge_point(cad, curve.edge, parameter[i][0], wall[i], nullptr);
      double angle = std::atan2(wall[i][1], wall[i][0]) + lean;
      const double end[3] = {radius * std::cos(angle), radius * std::sin(angle), 2e-3};
      cw_copy(end, top[i]);
      node.push_back(i);
      constraint[i].kind = CW_CONSTRAINT_PATCH;
      constraint[i].index = open_patch;
    }
    nodes.count = NODES;
    nodes.node = node.data();
    nodes.parameter = parameter;
    boundary.wall_curves.curve = &nodes;
    boundary.network.cad = cad;
    boundary.network.curve = &curve;
    boundary.network.curve_count = 1;
    boundary.surface.vertex_count = NODES;
    boundary.surface.x = wall;
    boundary.layers.top = top;
    boundary.surface.constraint = constraint;
    const CwRegionInput from = boundary.regions();
    assert_int_equal(cw_open_edge_places_make(&from, &places), CW_OK);
  }
  ~OpenEdge() {
    cw_open_edge_places_free(&places);
    cw_cad_close(&cad);
  }

  int find_open_edge() const {
    for (int e = 0; e < cw_cad_edge_count(cad); e++) {
      double range[2], x[3];
      cw_cad_edge_range(cad, e, range);
      cw_cad_edge_point(cad, e, (range[0] + range[1]) / 2, x, nullptr);
      if (x[2] == 0 && std::fabs(std::hypot(x[0], x[1]) - radius) < 1e-12) return e;
    }
    fail_msg("no open edge");
    return -1;
  }
};

// On the cylinder, and as far from the chord as the arc rises there.
void check_columns(const TopoDS_Shape &solid) {
  const double lean = 0.2;
  OpenEdge open_edge(solid, lean);
  assert_int_equal(open_edge.places.count, NODES);
  for (int i = 0; i < NODES; i++) {
    for (double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      double x[3], chord[3];
      const CwRegionInput from = open_edge.boundary.regions();
      cw_column_place(&from, &open_edge.places, i, share, x);
      cw_lerp(open_edge.wall[i], open_edge.top[i], share, chord);
      assert_near(std::hypot(x[0], x[1]), radius, 1e-14);
      assert_near(x[2], chord[2], 1e-9);
      assert_near(cw_distance(x, chord), radius - std::hypot(chord[0], chord[1]), 1e-9);
      assert_near(cw_cad_face_distance(open_edge.cad, open_edge.constraint[i].index, x), 0, 1e-14);
      assert_near(cw_cad_face_distance(open_edge.cad, open_edge.constraint[i].index, chord), cw_distance(x, chord),
                  1e-14);
    }
  }
}

} // namespace

static void layers_follow_the_cylinder(void **state) {
  TopoDS_Shape quarter = BRepPrimAPI_MakeCylinder(1e3 * radius, 1e3 * thickness, M_PI / 2).Shape();
  check_columns(quarter);
  check_columns(BRepBuilderAPI_NurbsConvert(quarter).Shape());
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(layers_follow_the_cylinder)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
