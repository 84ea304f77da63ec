// SPDX-License-Identifier: AGPL-3.0-or-later
// The network of curves of a tank that n turns bring to itself.
extern "C" {
#include "mesher/network/periodic_images.h"
}

#include "tank.h"

static void is_its_own_copy(bool tip) {
  Tank tank(5, 2, true, tip);
  DomainSurfaces &boundary = tank.boundary;
  check(cw_periodic_images_make(&boundary.network, &boundary.images, &tank.outcome));
  assert_int_equal(tank.outcome.kind, CW_OUTCOME_DONE);
  const CwImages &images = boundary.images.curve;
  for (int i = 0; i < boundary.network.curve_count; i++) {
    const CwCurve &curve = boundary.network.curve[i], &first = boundary.network.curve[images.first[i]];
    assert_int_equal(curve.fine_count, first.fine_count);
    for (int k = 0; k < curve.fine_count; k++) {
      double turned[3];
      cw_symmetry_turn(5, images.turns[i], first.fine_x[k], turned);
      assert_memory_equal(turned, curve.fine_x[k], sizeof turned);
    }
    for (int s = 0; s <= 4; s++) { // still on its edges, faces and planes
      double x[3], parameter[2];
      cw_curve_point(&boundary.network, &curve, curve.fine_length[curve.fine_count - 1] * s / 4, x, parameter);
      for (int p : curve.plane) {
        if (p >= 0) assert_near(cw_plane_distance(&tank.node[p].plane, x), 0, 1e-12);
      }
    }
  }
}

static void network_is_its_own_copy(void **) {
  is_its_own_copy(false);
}

// The faces of all passages meet in a corner on the axis, which is its own image.
static void so_is_one_with_a_corner_on_the_axis(void **) {
  is_its_own_copy(true);
}

// A plan whose half-planes do not repeat with the solid.
static void uneven_plans_are_told(void **) {
  Tank tank(6, 1);
  cw_network_free(&tank.boundary.network);
  const double angle = 0.33 * 2 * M_PI / 6;
  tank.node[1].plane = {{-std::sin(angle), std::cos(angle), 0}, 0};
  check(cw_network_make(NULL, tank.cad, &tank.background, tank.inside, &tank.plan, &tank.boundary.network,
                        &tank.outcome));
  check(cw_periodic_images_make(&tank.boundary.network, &tank.boundary.images, &tank.outcome));
  assert_int_equal(tank.outcome.kind, CW_OUTCOME_ASYMMETRIC);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(network_is_its_own_copy),
      cmocka_unit_test(so_is_one_with_a_corner_on_the_axis),
      cmocka_unit_test(uneven_plans_are_told),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
