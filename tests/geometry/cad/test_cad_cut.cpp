// SPDX-License-Identifier: AGPL-3.0-or-later
// One solid of water parted by a cylinder, a cone and a bent meridian: volumes by hand.

#include "cad/small_parts.hpp"

extern "C" {
#include "geometry/cad/cad_cut.h"
}

// A disc of radius 80 and width 10, or `size` times as large, its faces named.
static CwCadBodies disc(double size = 1) {
  CwCadBody body = {"pump.step", "water", "", small_solid_of(small_cylinder(-5 * size, 80 * size, 10 * size)), {}};
  body.origin.resize(3, {"WALL", {}, -1, 0});
  return {{body}};
}

static CwStatus cut(const CwCadCut &surface, CwCadBodies &bodies) {
  CwCaseCad cad = {};
  char name[] = "pump.step", *names[] = {name};
  cad.files = {1, names};
  cad.cut = surface;
  return cw_cad_cut(&cad, &small_frame, &bodies);
}

static void a_radius_parts_wheel_and_casing(void **) {
  CwCadBodies bodies = disc();
  if (cut({0.05, 0, nullptr}, bodies)) fail_msg("%s", cw_fail_message());
  assert_int_equal(bodies.body.size(), 2);
  assert_near(small_volume(bodies.body[0].solid), M_PI * 2500 * 10, 1e-3);
  assert_near(small_volume(bodies.body[1].solid), M_PI * (6400 - 2500) * 10, 1e-3);
  assert_string_equal(bodies.body[0].name.c_str(), "water_1");
  assert_string_equal(bodies.body[1].name.c_str(), "water_2");
  int unnamed = 0;
  for (const CwCadFaceOrigin &origin : bodies.body[0].origin) unnamed += origin.name.empty();
  assert_int_equal(unnamed, 1); // the cut
}

// What lies on the cut is a matter of the body's size: of a tiny one all faces are nearer to one another than 1e-4 mm.
static void small_bodies_are_parted_alike(void **) {
  const double size = 1.8e-5;
  CwCadBodies bodies = disc(size);
  if (cut({0.05 * size, 0, nullptr}, bodies)) fail_msg("%s", cw_fail_message());
  assert_int_equal(bodies.body.size(), 2);
  int unnamed = 0;
  for (const CwCadFaceOrigin &origin : bodies.body[0].origin) unnamed += origin.name.empty();
  assert_int_equal(unnamed, 1);
}

// From radius 40 at one side to 60 at the other: a frustum of a cone.
static void a_meridian_parts_it_too(void **) {
  CwCadBodies bodies = disc();
  double points[][2] = {{0.04, -0.005}, {0.06, 0.005}};
  if (cut({0, 2, points}, bodies)) fail_msg("%s", cw_fail_message());
  assert_int_equal(bodies.body.size(), 2);
  assert_near(small_volume(bodies.body[0].solid), M_PI * 10 / 3 * (1600 + 2400 + 3600), 1e-3);
}

static void a_surface_beside_the_water_parts_nothing(void **) {
  CwCadBodies bodies = disc();
  assert_int_equal(cut({0.09, 0, nullptr}, bodies), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "cad.cut: the surface parts no solid of pump.step"));
}

static void without_the_key_nothing_happens(void **) {
  CwCadBodies bodies = disc();
  assert_int_equal(cut({0, 0, nullptr}, bodies), CW_OK);
  assert_int_equal(bodies.body.size(), 1);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_radius_parts_wheel_and_casing), cmocka_unit_test(a_meridian_parts_it_too),
      cmocka_unit_test(small_bodies_are_parted_alike), cmocka_unit_test(a_surface_beside_the_water_parts_nothing),
      cmocka_unit_test(without_the_key_nothing_happens)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
