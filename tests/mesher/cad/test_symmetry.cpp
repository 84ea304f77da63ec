// SPDX-License-Identifier: AGPL-3.0-or-later
// The symmetry of a tank with n equal sides and a hub in its middle, and of a pipe with narrow faces that are left out.
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <gp_Circ.hxx>

#include "mesher/cad/cad_leave_out.h"

#include "tank.h"

static int turns_of(CwCad *cad) {
  CwBackground background;
  CwSymmetry *symmetry;
  check(cw_background_make(cad, 1e-4, 0.2, &background));
  check(cw_symmetry_find(cad, &background, &symmetry));
  const int count = symmetry ? symmetry->count : 1;
  cw_symmetry_free(&symmetry);
  cw_background_free(&background);
  cw_cad_close(&cad);
  return count;
}

static void turns_are_counted(void **) {
  assert_int_equal(turns_of(open_tank(5)), 5);
  assert_int_equal(turns_of(open_tank(6)), 6);
  assert_int_equal(turns_of(open_tank(6, true)), 1);
  assert_int_equal(turns_of(open_tank(5, false, true)), 5);
  const auto box = [](const TopoDS_Face &) -> std::string { return "side,wall"; };
  assert_int_equal(turns_of(open_solid(BRepPrimAPI_MakeBox(40, 30, 20).Shape(), box)), 1); // the axis at its edge
}

// A pipe of five equal parts, each with a wide face and a narrow one on one surface.
static TopoDS_Shape parted_pipe() {
  BRepBuilderAPI_MakeWire wire;
  const double part = 2 * M_PI / 5, narrow = 0.05;
  for (int i = 0; i < 5; i++) {
    const gp_Ax2 turned(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1), gp_Dir(std::cos(i * part), std::sin(i * part), 0));
    wire.Add(BRepBuilderAPI_MakeEdge(gp_Circ(turned, 20), 0, part - narrow));
    wire.Add(BRepBuilderAPI_MakeEdge(gp_Circ(turned, 20), part - narrow, part));
  }
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()), gp_Vec(0, 0, 30)).Shape();
}

static std::string end_or_side(const TopoDS_Face &face) {
  if (BRepAdaptor_Surface(face).GetType() != GeomAbs_Plane) return "side,wall";
  return BRepAdaptor_Surface(face).Plane().Location().Z() > 15 ? "end,wall" : "beginning,wall";
}

static void left_out_faces_have_images(void **) {
  CwCad *cad = open_solid(parted_pipe(), end_or_side);
  CwBackground background;
  CwSymmetry *symmetry;
  int count, faces;
  CwCadStrip *strip;
  check(cw_background_make(cad, 1e-4, 0.2, &background));
  check(cw_cad_strips_find(cad, &count, &strip));
  assert_int_equal(count, 5);
  const int chain[] = {0, 1, 2, 3, 4};
  check(cw_cad_leave_out(cad, 5, chain, &faces));
  assert_int_equal(faces, 5);
  check(cw_symmetry_find(cad, &background, &symmetry));
  assert_non_null(symmetry);
  assert_int_equal(symmetry->count, 5);
  for (int i = 0; i < count; i++) assert_true(cw_cad_face_is_left_out(cad, symmetry->face.next[strip[i].face]));
  free(strip);
  cw_symmetry_free(&symmetry);
  cw_background_free(&background);
  cw_cad_close(&cad);
}

// Each turning face stands for n, the two across the axis for themselves; the first ones have edges in common.
static void faces_form_images(void **) {
  Tank tank(6, 1);
  const CwImages &face = tank.symmetry->face;
  int fixed = 0, firsts = 0;
  for (int f = 0; f < cw_cad_face_count(tank.cad); f++) {
    fixed += face.next[f] == f;
    firsts += face.first[f] == f;
    assert_int_equal(cw_images_turned(&face, face.first[f], face.turns[f]), f);
    assert_int_equal(cw_images_turned(&face, f, 6), f);
    assert_int_equal(cw_images_size(&face, 6, f), face.next[f] == f ? 1 : 6);
  }
  assert_int_equal(fixed, 2);
  assert_int_equal(firsts, 5);
  int joints = 0;
  for (int e = 0; e < cw_cad_edge_count(tank.cad); e++) {
    int sides[2];
    cw_cad_edge_faces(tank.cad, e, sides);
    joints += face.first[sides[0]] == sides[0] && face.first[sides[1]] == sides[1];
  }
  assert_int_equal(joints, 4); // water - casing - floor - hub - its top
}

static void images_of_odd_lengths_are_refused(void **) {
  CwImages images;
  const auto made = [&](std::vector<int32_t> next, int count, int allow_fixed) {
    int32_t *copy = (int32_t *)malloc(next.size() * sizeof *copy);
    memcpy(copy, next.data(), next.size() * sizeof *copy);
    int whole;
    assert_int_equal(cw_images_make((int32_t)next.size(), &copy, count, allow_fixed, &images, &whole), CW_OK);
    if (whole) cw_images_free(&images);
    return whole;
  };
  assert_int_equal(made({1, 2, 0}, 3, 0), 1);
  assert_int_equal(made({1, 2, 0, 3}, 3, 1), 1);
  assert_int_equal(made({1, 2, 0, 3}, 3, 0), 0);
  assert_int_equal(made({1, 2, 0}, 6, 1), 0);
  assert_int_equal(made({1, 0}, 3, 1), 0);
  assert_int_equal(made({1, 2, 1}, 3, 1), 0); // two items come to one
  assert_int_equal(made({1, -1, 0}, 3, 1), 0);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(turns_are_counted),
      cmocka_unit_test(left_out_faces_have_images),
      cmocka_unit_test(faces_form_images),
      cmocka_unit_test(images_of_odd_lengths_are_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
