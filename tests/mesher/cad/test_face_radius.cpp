// SPDX-License-Identifier: AGPL-3.0-or-later
// Radii of walls that bend away from the fluid, towards it, and not at all.
#include <memory>
#include <vector>

#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>

extern "C" {
#include "mesher/cad/background_make.h"
#include "mesher/cad/face_radius.h"
}

#include "tests/mesher/solids.h"

// Of all faces in their order, mm.
static std::vector<double> radii(const TopoDS_Shape &shape, int bend = CW_CONVEX) {
  CwCad *cad = open_solid(shape);
  CwBackground background;
  std::vector<double> radius;
  assert_int_equal(cw_background_make(cad, 1e-4, 0.2, &background), CW_OK);
  auto all = std::make_unique<double[][CW_BENDS]>(cw_cad_face_count(cad));
  assert_int_equal(cw_face_radii(cad, &background, all.get()), CW_OK);
  for (int f = 0; f < cw_cad_face_count(cad); f++) radius.push_back(1e3 * all[f][bend]);
  cw_background_free(&background);
  cw_cad_close(&cad);
  return radius;
}

static gp_Ax2 upright(double x, double y) {
  return gp_Ax2(gp_Pnt(x, y, 0), gp_Dir(0, 0, 1));
}

// Half of a rod, so that no face has a seam.
static TopoDS_Shape half_rod(double x, double radius) {
  return BRepPrimAPI_MakeCylinder(upright(x, 20), radius, 10, M_PI).Shape();
}

// A box of fluid about two half rods: each is convex, all else flat.
static void rods_have_their_radii(void **) {
  TopoDS_Shape shape = BRepPrimAPI_MakeBox(40, 40, 10).Shape();
  shape = BRepAlgoAPI_Cut(shape, half_rod(10, 3)).Shape();
  shape = BRepAlgoAPI_Cut(shape, half_rod(30, 0.25)).Shape();
  int thick = 0, thin = 0, flat = 0;
  for (double radius : radii(shape)) {
    thick += std::fabs(radius - 3) < 1e-9;
    thin += std::fabs(radius - 0.25) < 1e-9;
    flat += std::isinf(radius);
  }
  assert_int_equal(thick, 1);
  assert_int_equal(thin, 1);
  assert_int_equal(flat, 6 + 2 + 2);
}

static void bores_bend_away_alone(void **) {
  int round = 0;
  for (double radius : radii(half_rod(0, 3))) assert_true(std::isinf(radius));
  for (double radius : radii(half_rod(0, 3), CW_CONCAVE)) round += std::fabs(radius - 3) < 1e-9;
  assert_int_equal(round, 1);
}

// Where a ring of 5 mm and 1 mm is the fluid's, its face bends away from it by 1 mm, and by 4 mm towards it inside.
static void rings_bend_both_ways(void **) {
  TopoDS_Shape box = BRepPrimAPI_MakeBox(gp_Pnt(-10, -10, 0), gp_Pnt(10, 10, 10)).Shape(); // cuts at the seam
  TopoDS_Shape ring = BRepAlgoAPI_Common(BRepPrimAPI_MakeTorus(upright(0, 0), 5, 1, M_PI).Shape(), box).Shape();
  int away = 0, towards = 0;
  for (double radius : radii(ring, CW_CONCAVE)) away += std::fabs(radius - 1) < 1e-9;
  for (double radius : radii(ring)) towards += radius > 4 - 1e-9 && radius < 4.2;
  assert_int_equal(away, 1);
  assert_int_equal(towards, 1);
}

// A cone that grows from 1 to 3 mm: its radius is the least there is, but for a hundredth of it.
static void the_sharp_end_of_a_face_counts(void **) {
  TopoDS_Shape cone = BRepPrimAPI_MakeCone(upright(20, 20), 1, 3, 10, M_PI).Shape();
  int cones = 0;
  for (double radius : radii(BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(40, 40, 10).Shape(), cone).Shape())) {
    if (std::isinf(radius)) continue;
    assert_true(radius >= std::sqrt(1.04) - 1e-9 && radius < 1.1);
    cones++;
  }
  assert_int_equal(cones, 1);
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(rods_have_their_radii), cmocka_unit_test(bores_bend_away_alone),
                              cmocka_unit_test(rings_bend_both_ways), cmocka_unit_test(the_sharp_end_of_a_face_counts)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
