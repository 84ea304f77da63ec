// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cstdlib>

#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <gp_Pnt.hxx>

extern "C" {
#include "mesher/boundary/pinched_vertices.h"
#include "mesher/common/vec.h"
}

#include "divided_box.h"
#include "tank_surfaces.h"

static void none_are_pinched_by_themselves(void **) {
  Box box(1);
  CwPinched pinched = {};
  uint8_t *mark;
  make_walls(box);
  check(cw_pinched_vertices(&box.boundary.input, &box.boundary.wall_curves, &box.boundary.surface, &mark));
  assert_null(mark);
  check(cw_pinched_find(box.cad, &pinched));
  box.boundary.input.pinched = &pinched;
  check(cw_pinched_vertices(&box.boundary.input, &box.boundary.wall_curves, &box.boundary.surface, &mark));
  assert_null(mark);
  cw_pinched_free(&pinched);
}

// A box with a second one across it: where the wall between them looks both ways one vertex is pinched, and about a
// place those within its radius.
static void corners_and_places_are_pinched(void **) {
  TopoDS_Shape low = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(40, 30, 10)).Shape();
  TopoDS_Shape high = BRepPrimAPI_MakeBox(gp_Pnt(25, -10, 10), gp_Pnt(35, 15, 20)).Shape();
  Box box(0, 0.009, BRepAlgoAPI_Fuse(low, high).Shape());
  DomainSurfaces &boundary = box.boundary;
  CwPinched pinched = {};
  make_walls(box);
  check(cw_pinched_find(box.cad, &pinched));
  assert_int_equal(pinched.edges, 0);
  assert_int_equal(pinched.corners, 2);
  boundary.input.pinched = &pinched;
  const CwPinchedPlace place = {{0.020, 0.010, 0}, 0.004};
  for (int with_place = 0; with_place < 2; with_place++) {
    uint8_t *mark;
    int marked = 0;
    if (with_place) check(cw_pinched_add(&place, &pinched));
    check(cw_pinched_vertices(&boundary.input, &boundary.wall_curves, &boundary.surface, &mark));
    for (int v = 0; v < boundary.surface.vertex_count; v++) {
      const double *x = boundary.surface.x[v], left[3] = {0.025, 0, 0.010}, right[3] = {0.035, 0, 0.010};
      const bool at_corner = cw_distance(x, left) < 1e-12 || cw_distance(x, right) < 1e-12;
      const bool near = with_place && cw_distance(x, place.x) <= place.radius;
      assert_int_equal(mark[v], at_corner || near);
      marked += mark[v];
    }
    if (!with_place) assert_int_equal(marked, 2);
    if (with_place) assert_true(marked > 5);
    std::free(mark);
  }
  cw_pinched_free(&pinched);
}

// Those of one passage are those of all.
static void periodic_images_are_alike(void **) {
  Tank tank(5, 2, true);
  DomainSurfaces &boundary = tank.boundary;
  CwPinched pinched = {};
  uint8_t *mark;
  make_walls(tank);
  const double *x = boundary.surface.x[boundary.surface.vertex_count / 2];
  CwPinchedPlace place = {{x[0], x[1], x[2]}, 1e-9};
  check(cw_pinched_add(&place, &pinched));
  boundary.input.pinched = &pinched;
  check(cw_pinched_vertices(&boundary.input, &boundary.wall_curves, &boundary.surface, &mark));
  int marked = 0;
  for (int v = 0; v < boundary.surface.vertex_count; v++) {
    if (!mark[v]) continue;
    marked++;
    assert_near(boundary.surface.x[v][2], place.x[2], 1e-9);
    assert_near(std::hypot(boundary.surface.x[v][0], boundary.surface.x[v][1]), std::hypot(place.x[0], place.x[1]),
                1e-9);
  }
  assert_int_equal(marked, tank.symmetry->count);
  std::free(mark);
  cw_pinched_free(&pinched);
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(none_are_pinched_by_themselves),
                                     cmocka_unit_test(corners_and_places_are_pinched),
                                     cmocka_unit_test(periodic_images_are_alike)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
