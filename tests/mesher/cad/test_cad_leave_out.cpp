// SPDX-License-Identifier: AGPL-3.0-or-later
// A tank with a filleted step in its floor: the fillet is the one strip that cad_strips finds, and is left out. A prism
// and a frustum with narrow faces between wide ones, all of which go alike. A box with fillets along its edges, which
// meet in its corners.
#include <cmath>
#include <cstdlib>

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <Bnd_Box.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>

#include "mesher/cad/cad_leave_out.h"
#include "mesher/common/vec.h"
#include "filleted_step.h"
#include "solids.h"
#include "tests/draw.h"

static void finds_the_fillet(void **) {
  CwCad *cad = open_solid(filleted_step(false), by_shape);
  int count, fillet = curved_face(cad);
  CwCadStrip *strip;
  assert_int_equal(cw_cad_strips_find(cad, &count, &strip), CW_OK);
  assert_int_equal(count, 1);
  assert_int_equal(strip[0].face, fillet);
  assert_int_equal(strip[0].chain, 0);
  assert_near(strip[0].length, 0.02, 1e-9);
  for (double width : strip[0].width) assert_near(width, std::sqrt(2) * step_radius, 1e-9);
  free(strip);
  cw_cad_close(&cad);
}

static void crest_is_no_strip(void **) {
  CwCad *cad = open_solid(filleted_step(true), by_shape);
  int count;
  CwCadStrip *strip;
  assert_int_equal(cw_cad_strips_find(cad, &count, &strip), CW_OK);
  assert_int_equal(count, 0);
  free(strip);
  cw_cad_close(&cad);
}

// The last face of a patch stays.
static void patch_keeps_a_face(void **) {
  CwCad *cad = open_solid(filleted_step(false), by_shape);
  const int chain = 0, edges = cw_cad_edge_count(cad);
  int faces;
  assert_int_equal(cw_cad_leave_out(cad, 1, &chain, &faces), CW_OK);
  assert_int_equal(faces, 0);
  assert_int_equal(cw_cad_edge_count(cad), edges);
  cw_cad_close(&cad);
}

// (u,v) of the ends and places of each edge on its faces are the edge's, or lie across the strip from it.
static void check_edges(const CwCad *cad, double width) {
  for (int e = 0; e < cw_cad_edge_count(cad); e++) {
    int face[2], vertex[2];
    double t[2];
    cw_cad_edge_faces(cad, e, face);
    cw_cad_edge_vertices(cad, e, vertex);
    cw_cad_edge_range(cad, e, t);
    for (int i = 0; i <= 8; i++) {
      double at = t[0] + (t[1] - t[0]) * i / 8, x[3], on[3], uv[2];
      cw_cad_edge_point(cad, e, at, x, nullptr);
      for (int side = 0; side < 2; side++) {
        double gap = cw_cad_edge_gap(cad, e, face[side]);
        if (i == 0 || i == 8) gap = std::fmax(gap, cw_cad_edge_end_gap(cad, e, i == 8));
        cw_cad_edge_uv(cad, e, face[side], at, uv);
        cw_cad_face_point(cad, face[side], uv, on, nullptr, nullptr);
        assert_true(cw_distance(x, on) <= gap + 1e-9);
        assert_true(gap <= width * 1.01);
      }
      if (i != 0 && i != 8) continue;
      cw_cad_vertex_point(cad, vertex[i == 8], on);
      assert_near(cw_distance(x, on), 0, 1e-12);
    }
  }
}

static void leaves_out_the_fillet(void **) {
  CwCad *cad = open_solid(filleted_step(false));
  const int chain = 0, edges = cw_cad_edge_count(cad), vertices = cw_cad_vertex_count(cad);
  const int faces_before = cw_cad_face_count(cad);
  const double width = std::sqrt(2) * step_radius;
  int faces, left = -1, in_place = 0;
  assert_int_equal(cw_cad_leave_out(cad, 1, &chain, &faces), CW_OK);
  assert_int_equal(faces, 1);
  assert_int_equal(cw_cad_face_count(cad), faces_before);
  assert_int_equal(cw_cad_edge_count(cad), edges - 3);
  assert_int_equal(cw_cad_vertex_count(cad), vertices - 2);
  for (int f = 0; f < cw_cad_face_count(cad); f++)
    if (cw_cad_face_is_left_out(cad, f)) left = f;
  assert_near(cw_cad_face_left_out_width(cad, left), width, 1e-9);
  assert_true(cw_cad_face_is_wall(cad, left));
  for (int e = 0; e < cw_cad_edge_count(cad); e++) {
    int face[2];
    double gap;
    cw_cad_edge_faces(cad, e, face);
    assert_true(face[0] != left && face[1] != left && face[0] != face[1]);
    if (cw_cad_edge_stands_for(cad, e, &gap) != left) continue;
    in_place++;
    assert_near(gap, width, 1e-9);
  }
  assert_int_equal(in_place, 1);
  check_edges(cad, width);
  cw_cad_close(&cad);
}

// Six wide faces and six narrow ones in turn, from the floor up; the lid is so many times as wide.
static TopoDS_Shape alternating(double lid) {
  BRepOffsetAPI_ThruSections made(true, true);
  for (double z : {0.0, 30.0}) {
    BRepBuilderAPI_MakePolygon wire;
    for (int i = 0; i < 12; i++) {
      double angle = i / 2 * M_PI / 3 + (i % 2 ? 0.02 : -0.02), r = z > 0 ? 20 * lid : 20;
      wire.Add(gp_Pnt(r * std::cos(angle), r * std::sin(angle), z));
    }
    wire.Close();
    made.AddWire(wire.Wire());
  }
  made.Build();
  return made.Shape();
}

static std::string by_height(const TopoDS_Face &face) {
  Bnd_Box box;
  BRepBndLib::Add(face, box);
  return box.CornerMax().Z() < 1 ? "floor,wall" : box.CornerMin().Z() > 29 ? "lid,wall" : "sides,wall";
}

// Both sides of each narrow face are as long and border the same patch. The same one stays on all, so that the solid is
// as symmetric as before: seen from out of the fluid, on the right of the way from the shorter end to the longer one,
// or from the earlier patch to the later one.
static void images_go_alike(void **) {
  const struct {
    double lid;
    bool patches;
    int sense; // of the side that stays, about the axis of z
  } shape[] = {{0.6, false, -1}, {1.5, false, 1}, {1, true, 1}};
  for (const auto &of : shape) {
    CwCad *cad = open_solid(alternating(of.lid), of.patches ? by_height : all_wall);
    int count, faces, left = 0;
    CwCadStrip *strip;
    assert_int_equal(cw_cad_strips_find(cad, &count, &strip), CW_OK);
    assert_int_equal(count, 6);
    const int chain[] = {0, 1, 2, 3, 4, 5};
    assert_int_equal(cw_cad_leave_out(cad, 6, chain, &faces), CW_OK);
    assert_int_equal(faces, 6);
    int up = of.patches && std::string(cw_cad_patch_name(cad, cw_cad_patch_count(cad) - 1)) == "floor" ? -1 : 1;
    for (int e = 0; e < cw_cad_edge_count(cad); e++) {
      double range[2], x[3];
      if (cw_cad_edge_stands_for(cad, e, nullptr) < 0) continue;
      cw_cad_edge_range(cad, e, range);
      cw_cad_edge_point(cad, e, 0.5 * (range[0] + range[1]), x, nullptr);
      double turns = std::atan2(x[1], x[0]) / (M_PI / 3), off = turns - std::round(turns);
      assert_near(off * M_PI / 3, 0.02 * up * of.sense, 1e-9);
      left++;
    }
    assert_int_equal(left, 6);
    free(strip);
    cw_cad_close(&cad);
  }
}

static const double fillet_mm = 0.2, fillet_width = std::sqrt(2) * fillet_mm * 1e-3; // m

// Twelve fillets, and in each corner an eighth of a sphere.
static TopoDS_Shape filleted_box() {
  TopoDS_Shape box = BRepPrimAPI_MakeBox(40, 30, 20).Shape();
  BRepFilletAPI_MakeFillet made(box);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(box, TopAbs_EDGE, edges);
  for (int e = 1; e <= edges.Extent(); e++) made.Add(fillet_mm, TopoDS::Edge(edges(e)));
  return made.Shape();
}

static int meshed_faces(const CwCad *cad) {
  int count = 0;
  for (int f = 0; f < cw_cad_face_count(cad); f++) count += cw_cad_face_is_meshed_wall(cad, f);
  return count;
}

// The box without fillets is left, its vertices off by their radius.
static void fillets_go_with_their_corners(void **) {
  CwCad *cad = open_solid(filleted_box(), all_wall);
  int faces, chain[12], of_vertex[8] = {0};
  for (int c = 0; c < 12; c++) chain[c] = c;
  assert_int_equal(cw_cad_face_count(cad), 26);
  assert_int_equal(cw_cad_leave_out(cad, 12, chain, &faces), CW_OK);
  assert_int_equal(faces, 20);
  assert_int_equal(meshed_faces(cad), 6);
  assert_int_equal(cw_cad_edge_count(cad), 12);
  assert_int_equal(cw_cad_vertex_count(cad), 8);
  check_edges(cad, fillet_width);
  for (int e = 0; e < 12; e++) {
    int vertex[2];
    cw_cad_edge_vertices(cad, e, vertex);
    for (int v : vertex) of_vertex[v]++;
    assert_true(cw_cad_edge_stands_for(cad, e, nullptr) >= 0);
  }
  for (int edges : of_vertex) assert_int_equal(edges, 3);
  for (int f = 0; f < cw_cad_face_count(cad); f++)
    if (!cw_cad_face_is_meshed_wall(cad, f)) assert_near(cw_cad_face_left_out_width(cad, f), fillet_width, 1e-9);
  cw_cad_close(&cad);
}

// Whatever fillets are to go, a solid without holes is left (Euler: V - E + F = 2), and where a corner has lost all
// three it has gone too.
static void some_fillets_go(void **) {
  uint64_t state = 1;
  for (int k = 0; k < 30; k++) {
    CwCad *cad = open_solid(filleted_box(), all_wall);
    int faces, count = 0, chain[12];
    for (int c = 0; c < 12; c++)
      if (draw(&state) < 0.75) chain[count++] = c;
    assert_int_equal(cw_cad_leave_out(cad, count, chain, &faces), CW_OK);
    assert_true(faces > 0);
    assert_int_equal(meshed_faces(cad), 26 - faces);
    assert_int_equal(cw_cad_vertex_count(cad) - cw_cad_edge_count(cad) + meshed_faces(cad), 2);
    check_edges(cad, fillet_width);
    for (int f = 0; f < cw_cad_face_count(cad); f++) {
      int edges = 0;
      for (int e = 0; e < cw_cad_edge_count(cad); e++) {
        int face[2];
        cw_cad_edge_faces(cad, e, face);
        edges += (face[0] == f) + (face[1] == f);
      }
      assert_true(cw_cad_face_is_left_out(cad, f) ? edges == 0 : edges >= 2);
    }
    cw_cad_close(&cad);
  }
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(finds_the_fillet),   cmocka_unit_test(crest_is_no_strip),
                              cmocka_unit_test(patch_keeps_a_face), cmocka_unit_test(leaves_out_the_fillet),
                              cmocka_unit_test(images_go_alike),    cmocka_unit_test(fillets_go_with_their_corners),
                              cmocka_unit_test(some_fillets_go)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
