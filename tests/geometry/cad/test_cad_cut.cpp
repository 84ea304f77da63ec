// SPDX-License-Identifier: AGPL-3.0-or-later
// One solid of water parted by a cylinder, a cone and a bent meridian: volumes by hand.

#include <BRepAlgoAPI_Fuse.hxx>

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

static CwStatus cut(const CwCadCut &surface, CwCadBodies &bodies, double tolerance = 0, CwLog *log = nullptr) {
  CwCaseCad cad = {};
  char name[] = "pump.step", *names[] = {name};
  cad.files = {1, names};
  cad.cut = surface;
  return cw_cad_cut(&cad, &small_frame, tolerance, log, &bodies);
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

// A disc of radius 80 between z -5 and 5 and one of radius 50 between -9 and -5, fused: an edge at (50, -5).
static CwCadBodies stepped() {
  CwCadBodies bodies = disc();
  bodies.body[0].solid = small_solid_of(BRepAlgoAPI_Fuse(bodies.body[0].solid, small_cylinder(-9, 50, 4)).Shape());
  bodies.body[0].origin.assign(cw_cad_faces(bodies.body[0].solid).Extent(), {});
  return bodies;
}

// Beside it, 0.008 mm off, the cut would leave a ring of wall as narrow: it is moved onto the edge.
static void a_surface_a_hair_beside_an_edge_is_moved_onto_it(void **) {
  CwLog *log = nullptr;
  double along[][2] = {{0.050008, -0.012}, {0.049994, 0.008}}, ends[][2] = {{0.04, 0.005}, {0.049995, -0.005006}};
  const CwCadCut cuts[] = {{0.050008, 0, nullptr}, {0.049992, 0, nullptr}, {0, 2, along}, {0, 2, ends}};
  assert_int_equal(cw_log_open("geometry", nullptr, 0, 0, &log), CW_OK);
  for (const CwCadCut &surface : cuts) {
    CwCadBodies bodies = stepped();
    const int before = cw_cad_faces(bodies.body[0].solid).Extent();
    if (cut(surface, bodies, 1e-5, log)) fail_msg("%s", cw_fail_message());
    assert_int_equal(bodies.body.size(), 2);
    int faces = 0;
    for (const CwCadBody &body : bodies.body) faces += cw_cad_faces(body.solid).Extent();
    assert_int_equal(faces, before + 3); // the cut from both sides, and the plane that it parts
  }
  CwCadBodies bodies = stepped();
  if (cut(cuts[0], bodies, 1e-6, log)) fail_msg("%s", cw_fail_message());
  assert_near(small_volume(bodies.body[1].solid), M_PI * (6400 - 50.008 * 50.008) * 10, 1e-3); // farther off: as it is
  cw_log_close(&log);
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
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_radius_parts_wheel_and_casing),
                                     cmocka_unit_test(a_meridian_parts_it_too),
                                     cmocka_unit_test(small_bodies_are_parted_alike),
                                     cmocka_unit_test(a_surface_a_hair_beside_an_edge_is_moved_onto_it),
                                     cmocka_unit_test(a_surface_beside_the_water_parts_nothing),
                                     cmocka_unit_test(without_the_key_nothing_happens)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
