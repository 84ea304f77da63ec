// SPDX-License-Identifier: AGPL-3.0-or-later
// A tank with a filleted step in its floor: the fillet is the one strip that cad_strips finds, and is left out.
#include <cmath>
#include <cstdlib>

#include "mesher/cad/cad_leave_out.h"
#include "mesher/common/vec.h"
#include "filleted_step.h"
#include "solids.h"

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

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(finds_the_fillet), cmocka_unit_test(crest_is_no_strip),
                              cmocka_unit_test(patch_keeps_a_face), cmocka_unit_test(leaves_out_the_fillet)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
