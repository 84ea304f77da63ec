// SPDX-License-Identifier: AGPL-3.0-or-later
// Faces of solids about which all is known, tessellated and welded.
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRep_Tool.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <Poly_Triangulation.hxx>
#include <TopLoc_Location.hxx>

#include "mesher/cad/cad_shape.h"

extern "C" {
#include "mesher/cad/background_tessellate.h"
#include "mesher/common/vec.h"
}

#include "closed_background.h"
#include "face_block.h"

static const double radius = 5e-3, height = 12e-3; // m, of the quarter cylinder

static TopoDS_Shape quarter_cylinder() {
  return BRepPrimAPI_MakeCylinder(1e3 * radius, 1e3 * height, M_PI / 2).Shape();
}

// The faces of a solid, one after the other, and what they are welded to.
struct Faces {
  CwCad *cad;
  std::vector<void *> bytes;
  std::vector<int64_t> size;
  std::vector<double> cost;
  CwBackground welded = {};

  Faces(CwCad *solid, double deflection, double angle)
      : cad(solid), bytes(cw_cad_face_count(cad)), size(bytes.size()), cost(bytes.size()) {
    CwTessellation *tessellation = nullptr;
    check(cw_tessellation_start(cad, deflection, angle, &tessellation));
    for (int f = 0; f < count(); f++) {
      cost[f] = cw_tessellation_cost(tessellation, f);
      check(cw_tessellation_face(tessellation, f, &bytes[f], &size[f]));
    }
    cw_tessellation_free(&tessellation);
    assert_null(tessellation);
  }
  ~Faces() {
    cw_background_free(&welded);
    for (void *block : bytes) free(block);
  }
  int count() const {
    return (int)bytes.size();
  }
  // On the edges of a face, an edge after the other.
  double points(int face) const {
    double count = 0;
    const int32_t *side = FaceBlock(bytes[face]).side;
    for (; (const char *)side < (const char *)bytes[face] + size[face]; side += 2 + side[1]) count += side[1];
    return count;
  }
  void weld() {
    check(cw_tessellation_weld(cad, bytes.data(), &welded));
  }
};

// Places along each edge, from its lists of nodes on either of its faces: ends are vertices, and between lie nodes on
// the curve in the order of its parameter, those of the first of its faces at their places to the last bit.
static void check_sides(const Faces &faces) {
  std::vector<int> seen(cw_cad_edge_count(faces.cad));
  for (int f = 0; f < faces.count(); f++) {
    const FaceBlock block(faces.bytes[f]);
    const int32_t *side = block.side;
    int before = -1;
    while ((const char *)side < (const char *)faces.bytes[f] + faces.size[f]) {
      const int edge = side[0], count = side[1];
      const CwCadEdge &of = faces.cad->edge[edge];
      double at = of.range[0];
      assert_true(edge > before && count >= 2 && (of.face[0] == f || of.face[1] == f));
      for (int i = 0; i < count; i++) {
        const double *x = block.node[side[2 + i]].x;
        double on[3], vertex[3];
        while (true) { // on to the parameter of the node: arcs and lines run with an even speed
          cw_cad_edge_point(faces.cad, edge, at, on, nullptr);
          if (cw_distance(on, x) < 1e-10 || at > of.range[1] + 1e-12) break;
          double tangent[3], way[3];
          cw_cad_edge_point(faces.cad, edge, at, on, tangent);
          cw_sub(x, on, way);
          at += cw_norm(way) / cw_norm(tangent);
        }
        assert_true(at <= of.range[1] + 1e-9);
        if (i > 0 && i + 1 < count) continue;
        cw_cad_vertex_point(faces.cad, of.vertex[i > 0], vertex);
        assert_near(cw_distance(x, vertex), 0, 1e-12);
      }
      before = edge;
      seen[edge]++;
      side += 2 + count;
    }
    assert_ptr_equal(side, (char *)faces.bytes[f] + faces.size[f]);
  }
  for (int times : seen) assert_int_equal(times, 2);
}

// Vertices come first, then what lies between along each edge in turn, then the rest.
static void check_order(const Faces &faces) {
  const CwBackground &b = faces.welded;
  int32_t point = 0;
  for (int v = 0; v < cw_cad_vertex_count(faces.cad); v++, point++) {
    double x[3];
    cw_cad_vertex_point(faces.cad, v, x);
    assert_memory_equal(b.x[point], x, sizeof x);
  }
  for (int e = 0; e < cw_cad_edge_count(faces.cad); e++) {
    const int face = faces.cad->edge[e].face[0];
    const FaceBlock block(faces.bytes[face]);
    const int32_t *side = block.side;
    while (side[0] != e) side += 2 + side[1];
    for (int i = 1; i + 1 < side[1]; i++, point++) {
      assert_memory_equal(b.x[point], block.node[side[2 + i]].x, sizeof b.x[point]);
      double range[2], x[3], off = INFINITY;
      cw_cad_edge_range(faces.cad, e, range);
      for (int k = 0; k <= 1000; k++) {
        cw_cad_edge_point(faces.cad, e, range[0] + (range[1] - range[0]) * k / 1000, x, nullptr);
        off = std::fmin(off, cw_distance(x, b.x[point]));
      }
      assert_true(off < 1e-3 * radius);
    }
  }
  assert_true(point <= b.point_count);
}

// Of a box there is nothing but its corners and half faces, each with the two points of its four edges as cost.
static void a_box_has_its_corners_alone(void **) {
  CwCad *cad = open_solid(BRepPrimAPI_MakeBox(10, 20, 30).Shape());
  Faces faces(cad, 1e-4, 0.2);
  faces.weld();
  check_sides(faces);
  check_order(faces);
  check_closed(&faces.welded);
  check_corners(cad, &faces.welded);
  assert_int_equal(faces.welded.point_count, 8);
  assert_int_equal(faces.welded.triangle_count, 12);
  assert_near(cw_background_volume(&faces.welded), 6e-6, 1e-18);
  for (int f = 0; f < 6; f++) {
    assert_int_equal(FaceBlock(faces.bytes[f]).nodes, 4);
    assert_int_equal(FaceBlock(faces.bytes[f]).triangles, 2);
    assert_near(faces.cost[f], 8, 0);
  }
  cw_cad_close(&cad);
}

// Pieces of the arc over a quarter of a turn, of the edge at z.
static int pieces_of_arc(const CwBackground &b, double z) {
  int points = 0;
  for (int32_t p = 0; p < b.point_count; p++)
    points += std::fabs(b.x[p][2] - z) < 1e-9 && std::fabs(std::hypot(b.x[p][0], b.x[p][1]) - radius) < 1e-9;
  return points - 1;
}

// A chord over an angle a lies radius * (1 - cos(a / 2)) off its arc: no more than the deflection, nor a more than the
// angle; and pieces are not shorter than half of what is allowed. Whatever the unit of lengths.
static void chords_keep_to_deflection_and_angle(void **) {
  const struct { double deflection, angle; } asked[] = {{1e-3, 0.2}, {1e-3, 0.05}, {1e-5, 1}, {1e-6, 1}, {1e-6, 0.02}};
  for (double unit : {1.0, 1e-3 / 4}) {
    for (const auto &one : asked) {
      CwCad *cad = open_solid(quarter_cylinder());
      if (unit != 1) check(cw_cad_rescale(cad, unit));
      Faces faces(cad, one.deflection / unit, one.angle);
      faces.weld();
      check_closed(&faces.welded);
      for (int32_t p = 0; p < faces.welded.point_count; p++)
        for (double &x : faces.welded.x[p]) x *= unit;
      for (double z : {0.0, height}) {
        const double allowed = std::fmin(one.angle, 2 * std::acos(std::fmax(1 - one.deflection / radius, -1)));
        const int pieces = pieces_of_arc(faces.welded, z), least = (int)std::ceil(M_PI / 2 / allowed - 1e-9);
        assert_in_range(pieces, least, 2 * least);
      }
      cw_cad_close(&cad);
    }
  }
}

static void bent_solids_are_welded(void **) {
  CwCad *cad = open_solid(quarter_cylinder());
  Faces faces(cad, 1e-5, 0.2);
  faces.weld();
  check_sides(faces);
  check_order(faces);
  check_closed(&faces.welded);
  check_corners(cad, &faces.welded);
  // The sum over all wedges from the axis to a chord; between, all is flat.
  const int pieces = pieces_of_arc(faces.welded, 0);
  const double base = pieces * radius * radius / 2 * std::sin(M_PI / 2 / pieces);
  assert_near(cw_background_volume(&faces.welded), base * height, 1e-14);
  for (int f = 0; f < faces.count(); f++) assert_near(faces.cost[f], faces.points(f), 0); // a cylinder and planes
  cw_cad_close(&cad);
}

// Its two ends are one face of the library's, in two places.
static void moved_copies_of_a_face_are_welded(void **) {
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(
      GC_MakeArcOfCircle(gp_Pnt(5, 0, 0), gp_Pnt(5 * std::sqrt(0.5), 5 * std::sqrt(0.5), 0), gp_Pnt(0, 5, 0)).Value()));
  wire.Add(BRepBuilderAPI_MakeEdge(gp_Pnt(0, 5, 0), gp_Pnt(0, 0, 0)));
  wire.Add(BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(5, 0, 0)));
  CwCad *cad = open_solid(BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()), gp_Vec(0, 0, 12)).Shape());
  Faces faces(cad, 1e-5, 0.2);
  faces.weld();
  check_sides(faces);
  check_order(faces);
  check_closed(&faces.welded);
  check_corners(cad, &faces.welded);
  assert_int_equal(pieces_of_arc(faces.welded, 0), pieces_of_arc(faces.welded, height));
  cw_cad_close(&cad);
}

// Parts of a half sphere, and of a cone: the side of the bent face that is a point is one vertex. A face that bends
// both ways costs more than its points on edges, as the square of what the deflection is less by.
static void a_pole_is_a_vertex(void **) {
  const struct {
    TopoDS_Shape solid;
    double tip;
    bool bends;
  } parts[] = {{BRepPrimAPI_MakeSphere(5, 0, M_PI / 2, M_PI / 2).Shape(), 5e-3, true},
               {BRepPrimAPI_MakeSphere(5, 0, M_PI / 2, 1.5 * M_PI).Shape(), 5e-3, true},
               {BRepPrimAPI_MakeCone(5, 0, 12, 1.5 * M_PI).Shape(), 12e-3, false}};
  for (const auto &part : parts) {
    CwCad *cad = open_solid(part.solid);
    double more[2] = {0, 0};
    for (int finer = 0; finer < 2; finer++) {
      Faces faces(cad, finer ? 1e-4 : 2e-4, 0.1);
      faces.weld();
      check_closed(&faces.welded);
      check_corners(cad, &faces.welded);
      int at_pole = 0;
      for (int32_t p = 0; p < faces.welded.point_count; p++) {
        const double *x = faces.welded.x[p];
        at_pole += std::hypot(x[0], x[1]) < 1e-9 && std::fabs(x[2] - part.tip) < 1e-9;
      }
      assert_int_equal(at_pole, 1);
      for (int f = 0; f < faces.count(); f++) {
        const double of_area = faces.cost[f] - faces.points(f);
        if (cad->face[f].pole.is)
          more[finer] = of_area;
        else
          assert_near(of_area, 0, 0);
      }
    }
    assert_int_equal(more[0] > 0, part.bends);
    assert_near(more[1], 4 * more[0], 1e-9 * more[1]);
    cw_cad_close(&cad);
  }
}

// Of two tessellations that divide the arcs in other pieces no face fits beside those of the other.
static void edges_must_be_divided_alike(void **) {
  CwCad *cad = open_solid(quarter_cylinder());
  Faces coarse(cad, 1e-3, 0.2), fine(cad, 1e-3, 0.1);
  int refused = 0;
  for (int f = 0; f < coarse.count(); f++) {
    const std::string name = std::string("'") + cw_cad_face_name(cad, f) + "'";
    const bool has_arc = fine.size[f] != coarse.size[f];
    std::swap(coarse.bytes[f], fine.bytes[f]);
    CwBackground made = {};
    const CwStatus status = cw_tessellation_weld(cad, coarse.bytes.data(), &made);
    assert_int_equal(status, has_arc ? CW_ERR_GEOMETRY : CW_OK);
    if (has_arc) {
      const std::string told = cw_fail_message();
      assert_true(told.find(name) != std::string::npos);
      assert_true(told.find("the tessellations do not match along their edge at (") != std::string::npos);
      refused++;
    }
    cw_background_free(&made);
    std::swap(coarse.bytes[f], fine.bytes[f]);
  }
  assert_int_equal(refused, 3); // the bent face and both ends
  cw_cad_close(&cad);
}

// The solid keeps no triangulation, and the next one is the same, byte by byte, whatever was made between.
static void nothing_stays_behind(void **) {
  CwCad *cad = open_solid(quarter_cylinder());
  Faces first(cad, 1e-5, 0.2);
  for (int f = 1; f <= cad->face_map.Extent(); f++) {
    TopLoc_Location location;
    assert_true(BRep_Tool::Triangulation(TopoDS::Face(cad->face_map(f)), location).IsNull());
  }
  Faces other(cad, 1e-3, 0.5), again(cad, 1e-5, 0.2);
  for (int f = 0; f < first.count(); f++) {
    assert_int_equal(first.size[f], again.size[f]);
    assert_memory_equal(first.bytes[f], again.bytes[f], (size_t)first.size[f]);
  }
  cw_cad_close(&cad);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_box_has_its_corners_alone), cmocka_unit_test(chords_keep_to_deflection_and_angle),
      cmocka_unit_test(bent_solids_are_welded),      cmocka_unit_test(moved_copies_of_a_face_are_welded),
      cmocka_unit_test(a_pole_is_a_vertex),          cmocka_unit_test(edges_must_be_divided_alike),
      cmocka_unit_test(nothing_stays_behind),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
