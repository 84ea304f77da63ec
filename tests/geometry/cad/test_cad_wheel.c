// SPDX-License-Identifier: AGPL-3.0-or-later
// Wheels of pumps whose parts, patches, faces and interfaces are made by hand. The tips of blades lie at the radius R,
// interfaces at their outlets 1 mm further out.
#include "geometry/cad/cad_wheel.h"

#include <string.h>

#include "tests/unit_test.h"

enum { PARTS = 8, PATCHES = 32, FACES = 64 };

typedef struct {
  CwCadDomain domain[PARTS];
  CwFacePatch patch[PATCHES];
  CwSurveyFace face[FACES];
  CwSurveyEdge edge[FACES];
  int of_face[FACES];
  CwCadInterface interface[PARTS];
  CwCaseCad cad;
  CwFacePatches patches;
  CwSurvey survey;
  int interface_count;
} Pump;

static int add_part(Pump *pump, int rotating) {
  pump->domain[pump->cad.domain_count].rotating = rotating;
  return pump->cad.domain_count++;
}

static int add_patch(Pump *pump, int part, CwPatchKind kind, CwFaceRole role) {
  pump->patch[pump->patches.count] = (CwFacePatch){.part = part, .kind = kind, .role = role};
  return pump->patches.count++;
}

// From the heights z0 to z1, out to a radius, m; twist: sine of the angle by which it looks ahead.
static int add_face(Pump *pump, int patch, double radius, double z0, double z1, double area, double twist) {
  const int face = pump->survey.face_count++;
  pump->face[face] = (CwSurveyFace){.part = pump->patch[patch].part,
                                    .area = area,
                                    .radius = {radius / 2, radius},
                                    .height = {z0, z1},
                                    .twist = twist};
  pump->of_face[face] = patch;
  return face;
}

static void add_edge(Pump *pump, int a, int b) {
  pump->edge[pump->survey.edge_count++] = (CwSurveyEdge){.face = {a, b}};
}

static void add_interface(Pump *pump, int a, int b, double reach, double width, int surfaces) {
  const int of_a = add_patch(pump, a, CW_PATCH_INTERFACE, CW_ROLE_CONTACT);
  const int of_b = add_patch(pump, b, CW_PATCH_INTERFACE, CW_ROLE_CONTACT);
  pump->interface[pump->interface_count++] =
      (CwCadInterface){.patch = {of_a, of_b}, .reach = reach, .width = width, .surfaces = surfaces};
}

// Both sides of `count` blades out to a radius, joined by an edge, looking ahead and back.
static void add_blades(Pump *pump, int patch, int count, double radius, double z0, double z1) {
  for (int i = 0; i < count; i++) {
    const int ahead = add_face(pump, patch, radius, z0, z1, 1e-3, 0.5);
    const int back = add_face(pump, patch, radius, z0, z1, 1e-3, -0.5);
    add_edge(pump, ahead, back);
  }
}

static CwCadWheels wheels_of(Pump *pump, int passages) {
  CwCadWheels wheels;
  pump->cad.domain = pump->domain;
  pump->patches.patch = pump->patch;
  pump->patches.of_face = pump->of_face;
  pump->survey.face = pump->face;
  pump->survey.edge = pump->edge;
  if (cw_cad_wheels_make(&pump->cad, &pump->survey, &pump->patches, pump->interface_count, pump->interface, passages,
                         &wheels) != CW_OK)
    fail_msg("%s", cw_fail_message());
  return wheels;
}

// A part that rotates, with hub and blades but no opening: what joins it to others makes its openings.
static int add_wheel(Pump *pump, double radius) {
  const int part = add_part(pump, 1);
  add_face(pump, add_patch(pump, part, CW_PATCH_WALL, CW_ROLE_HUB), radius + 1e-3, 0, 0, 1e-2, 0);
  add_blades(pump, add_patch(pump, part, CW_PATCH_WALL, CW_ROLE_BLADE), 6, radius, 0, 0.01);
  return part;
}

// An inlet of one face.
static int add_inlet(Pump *pump, int part, double area) {
  return add_face(pump, add_patch(pump, part, CW_PATCH_INLET, CW_ROLE_INLET), 0.04, -0.1, -0.1, area, 0);
}

static void add_outlet(Pump *pump, int part) {
  add_face(pump, add_patch(pump, part, CW_PATCH_OUTLET, CW_ROLE_OUTLET), 0.3, 0, 0, 1e-3, 0);
}

// A wheel with an inlet of its own in a casing.
static Pump simple(void) {
  Pump pump = {0};
  const int wheel = add_wheel(&pump, 0.1), casing = add_part(&pump, 0);
  add_inlet(&pump, wheel, 5e-3);
  add_outlet(&pump, casing);
  add_interface(&pump, wheel, casing, 0.101, 0.012, 1);
  return pump;
}

static void one_wheel(void **state) {
  Pump pump = simple();
  CwCadWheels wheels = wheels_of(&pump, 6);
  const CwCadWheel *wheel = wheels.wheel;
  assert_int_equal(wheels.count, 1);
  assert_int_equal(wheels.largest, 0);
  assert_int_equal(wheel->part, 0);
  assert_near(wheel->radius, 0.1, 0); // of the blades, not of the hub
  assert_near(wheel->reach, 0.101, 0);
  assert_near(wheel->width, 0.012, 0);
  assert_near(wheel->eye_area, 5e-3, 0);
  assert_int_equal(wheel->eyes, 1);
  assert_int_equal(wheel->openings, 2);
  assert_int_equal(wheel->blades, 6);
  assert_near(wheel->flow_share, 1, 0);
  assert_near(wheel->head_share, 1, 0);
  assert_int_equal(wheels.of_part[0], 0);
  assert_int_equal(wheels.of_part[1], 0);
  cw_cad_wheels_free(&wheels);
  assert_null(wheels.wheel);
  assert_null(wheels.of_part);
  assert_int_equal(wheels.count, 0);
}

// Without blades a part that rotates is a wheel as large as its faces reach, and has as many blades as passages.
static void without_blades(void **state) {
  Pump pump = simple();
  for (int i = 0; i < pump.patches.count; i++)
    if (pump.patch[i].role == CW_ROLE_BLADE) pump.patch[i].role = CW_ROLE_WALL;
  CwCadWheels wheels = wheels_of(&pump, 5);
  assert_int_equal(wheels.count, 1);
  assert_near(wheels.wheel[0].radius, 0.101, 0);
  assert_int_equal(wheels.wheel[0].blades, 5);
  cw_cad_wheels_free(&wheels);
}

// Counted are blades that reach 0.99 R, with a side that looks ahead and one that looks back by more than 0.01, joined
// by an edge.
static void blades_at_the_outlet(void **state) {
  const struct {
    double radius, ahead, back;
    int joined, blades;
  } more[] = {
      {0.0991, 0.5, -0.5, 1, 12},  // splitters
      {0.0989, 0.5, -0.5, 1, 6},   // that end before the outlet
      {0.1, 0.011, -0.011, 1, 12}, // nearly meridional
      {0.1, 0.009, -0.009, 1, 6},  // edges of nothing
      {0.1, 0.5, -0.5, 0, 6},      // single sides
      {0.1, 0.5, 0.5, 1, 6},       // pieces of a side
      {0.1, -0.5, -0.5, 1, 6},
  };
  for (size_t i = 0; i < sizeof more / sizeof *more; i++) {
    Pump pump = simple();
    const int patch = add_patch(&pump, 0, CW_PATCH_WALL, CW_ROLE_BLADE);
    for (int k = 0; k < 6; k++) {
      const int a = add_face(&pump, patch, more[i].radius, 0, 0.01, 1e-3, more[i].ahead);
      const int b = add_face(&pump, patch, more[i].radius, 0, 0.01, 1e-3, more[i].back);
      if (more[i].joined) add_edge(&pump, a, b);
    }
    CwCadWheels wheels = wheels_of(&pump, 6);
    if (wheels.wheel[0].blades != more[i].blades) fail_msg("of %d: %d blades", (int)i, wheels.wheel[0].blades);
    cw_cad_wheels_free(&wheels);
  }
}

// A blade of several faces, one of them low: it counts once, with the radius of the one that reaches farthest and the
// heights of all. The nose belongs to no side.
static void a_blade_may_have_many_faces(void **state) {
  Pump pump = {0};
  const int part = add_part(&pump, 1), patch = add_patch(&pump, part, CW_PATCH_WALL, CW_ROLE_BLADE);
  add_inlet(&pump, part, 1e-3);
  add_outlet(&pump, part);
  for (int k = 0; k < 5; k++) {
    const int nose = add_face(&pump, patch, 0.05, 0, 0.02, 1e-4, 0);
    const int ahead = add_face(&pump, patch, 0.1, 0.01, 0.02, 1e-3, 0.3);
    const int back = add_face(&pump, patch, 0.09, -0.01, 0.01, 1e-3, -0.3);
    add_edge(&pump, ahead, nose);
    add_edge(&pump, back, nose);
  }
  CwCadWheels wheels = wheels_of(&pump, 5);
  assert_int_equal(wheels.wheel[0].blades, 5);
  assert_near(wheels.wheel[0].radius, 0.1, 0);
  cw_cad_wheels_free(&wheels);
}

// The largest blade stands for one half of the wheel: those whose middle height is not beside it are the other's.
static void the_other_half_is_not_counted(void **state) {
  for (int beside = 0; beside < 2; beside++) {
    Pump pump = simple();
    const int patch = add_patch(&pump, 0, CW_PATCH_WALL, CW_ROLE_BLADE);
    const double z = beside ? -0.003 : -0.02; // the middle at 2 mm, and at -15 mm, of blades from 0 to 10 mm
    add_blades(&pump, patch, 6, 0.1, z, z + 0.01);
    // The first blade is the largest: another face of it from 4 to 8 mm.
    add_edge(&pump, 1, add_face(&pump, pump.of_face[1], 0.05, 0.004, 0.008, 1e-3, 0));
    CwCadWheels wheels = wheels_of(&pump, 6);
    assert_int_equal(wheels.wheel[0].blades, beside ? 12 : 6);
    cw_cad_wheels_free(&wheels);
  }
}

// Of one wheel the blades are a multiple of its passages, or as many; of several each has what it has.
static void blades_and_passages(void **state) {
  Pump pump = simple();
  CwCadWheels wheels = wheels_of(&pump, 3);
  assert_int_equal(wheels.wheel[0].blades, 6);
  cw_cad_wheels_free(&wheels);
  wheels = wheels_of(&pump, 4);
  assert_int_equal(wheels.wheel[0].blades, 4);
  cw_cad_wheels_free(&wheels);
  add_interface(&pump, 1, add_wheel(&pump, 0.08), 0.04, 0.03, 1);
  wheels = wheels_of(&pump, 4);
  assert_int_equal(wheels.count, 2);
  for (int w = 0; w < 2; w++) assert_int_equal(wheels.wheel[w].blades, 6);
  cw_cad_wheels_free(&wheels);
}

// An eye is an inlet of what rotates, or an interface with a part that has an inlet and no outlet; its faces hang
// together by edges.
static void eyes_of_a_double_suction_wheel(void **state) {
  Pump pump = simple();
  const int second = add_inlet(&pump, 0, 3e-3), piece = add_inlet(&pump, 0, 1e-3);
  CwCadWheels wheels = wheels_of(&pump, 6);
  assert_int_equal(wheels.wheel[0].eyes, 3);
  cw_cad_wheels_free(&wheels);
  add_edge(&pump, piece, second);
  const int before = add_part(&pump, 0), mouth = add_part(&pump, 0);
  add_inlet(&pump, before, 7e-3);
  add_inlet(&pump, mouth, 7e-3);
  add_outlet(&pump, mouth); // not before the wheel
  for (int part = before; part <= mouth; part++) {
    add_interface(&pump, part, 0, 0.04, 0.04, 1);
    for (int side = 2; side > 0; side--) add_face(&pump, pump.patches.count - side, 0.04, 0, 0, 2e-3, 0);
  }
  wheels = wheels_of(&pump, 6);
  assert_int_equal(wheels.wheel[0].eyes, 3);
  assert_near(wheels.wheel[0].eye_area, 5e-3 + 3e-3 + 1e-3 + 2e-3, 1e-15);
  assert_int_equal(wheels.wheel[0].openings, 3 + 1 + 2);
  assert_int_equal(cw_cad_is_before(&pump.patches, before), 1);
  assert_int_equal(cw_cad_is_before(&pump.patches, mouth), 0);
  assert_int_equal(cw_cad_is_before(&pump.patches, 1), 0); // the casing has no inlet
  cw_cad_wheels_free(&wheels);
}

// Two stages of 100 and 80 mm: both have all the flow, the head goes as the squares, 0.01 to 0.0064.
static void stages_in_series(void **state) {
  Pump pump = {0};
  const int first = add_wheel(&pump, 0.1), between = add_part(&pump, 0), second = add_wheel(&pump, 0.08);
  const int casing = add_part(&pump, 0), far = add_part(&pump, 0);
  add_inlet(&pump, first, 5e-3);
  add_outlet(&pump, casing);
  add_interface(&pump, first, between, 0.101, 0.012, 1);
  add_interface(&pump, between, second, 0.04, 0.03, 2);
  add_interface(&pump, second, casing, 0.081, 0.01, 1);
  add_interface(&pump, far, casing, 0.5, 0.1, 1);
  CwCadWheels wheels = wheels_of(&pump, 6);
  assert_int_equal(wheels.count, 2);
  assert_int_equal(wheels.largest, 0);
  assert_int_equal(wheels.wheel[1].part, second);
  for (int w = 0; w < 2; w++) assert_near(wheels.wheel[w].flow_share, 1, 0);
  assert_near(wheels.wheel[0].head_share, 0.01 / 0.0164, 1e-15);
  assert_near(wheels.wheel[1].head_share, 0.0064 / 0.0164, 1e-15);
  assert_near(wheels.wheel[1].reach, 0.081, 0); // its outlet, not its eye
  assert_near(wheels.wheel[1].width, 0.01, 0);
  assert_int_equal(wheels.wheel[1].openings, 3);
  assert_int_equal(wheels.wheel[1].eyes, 0); // the water that enters it has been through a wheel
  const int of[] = {0, 0, 1, 1, 0};          // between: that whose interface reaches farther; far: the largest
  for (int d = 0; d < 5; d++) assert_int_equal(wheels.of_part[d], of[d]);
  cw_cad_wheels_free(&wheels);
}

// Three wheels in one casing, each with an inlet of its own: all the head, a third of the flow. What a wheel reaches
// through another one is not its own.
static void wheels_in_parallel(void **state) {
  Pump pump = {0};
  const int casing = add_part(&pump, 0);
  add_outlet(&pump, casing);
  for (int w = 0; w < 3; w++) {
    const int wheel = add_wheel(&pump, 0.08 + 0.01 * w), pipe = add_part(&pump, 0);
    add_inlet(&pump, pipe, 5e-3);
    add_interface(&pump, casing, wheel, 0.1, 0.012, 1);
    add_interface(&pump, wheel, pipe, 0.04, 0.03, 1);
  }
  const int far = add_part(&pump, 0);
  CwCadWheels wheels = wheels_of(&pump, 6);
  assert_int_equal(wheels.count, 3);
  assert_int_equal(wheels.largest, 2);
  for (int w = 0; w < 3; w++) {
    assert_near(wheels.wheel[w].flow_share, 1. / 3, 1e-15);
    assert_near(wheels.wheel[w].head_share, 1, 0);
    assert_int_equal(wheels.of_part[2 + 2 * w], w);
  }
  assert_int_equal(wheels.of_part[far], 2);
  cw_cad_wheels_free(&wheels);
}

// What rotates and is joined by interfaces is one wheel, whose outlet leads to what stands still; what rotates apart
// from it and has no blades is none.
static void parts_of_a_wheel(void **state) {
  Pump pump = {0};
  const int coupling = add_part(&pump, 1), eye = add_part(&pump, 1), wheel = add_wheel(&pump, 0.1);
  const int casing = add_part(&pump, 0);
  add_inlet(&pump, eye, 5e-3);
  add_outlet(&pump, casing);
  add_face(&pump, add_patch(&pump, coupling, CW_PATCH_WALL, CW_ROLE_HUB), 0.3, 0, 0, 1e-2, 0);
  add_interface(&pump, wheel, eye, 0.2, 0.03, 1);
  add_face(&pump, pump.patches.count - 2, 0.04, 0, 0, 1e-3, 0); // the wheel's side: no eye
  add_interface(&pump, wheel, casing, 0.101, 0.012, 1);
  CwCadWheels wheels = wheels_of(&pump, 6);
  assert_int_equal(wheels.count, 1);
  assert_int_equal(wheels.wheel[0].part, eye);
  assert_near(wheels.wheel[0].radius, 0.1, 0);
  assert_near(wheels.wheel[0].reach, 0.101, 0);
  assert_int_equal(wheels.wheel[0].openings, 2); // none between its parts
  assert_int_equal(wheels.wheel[0].eyes, 1);
  assert_near(wheels.wheel[0].eye_area, 5e-3, 0);
  for (int d = 0; d < 4; d++) assert_int_equal(wheels.of_part[d], 0);
  cw_cad_wheels_free(&wheels);
}

// Faces 0-3-5 and 1-2 hang together; 4 takes no part, and does not join 1 and 5.
static void faces_that_hang_together(void **state) {
  Pump pump = {0};
  const int edge[][2] = {{5, 3}, {3, 0}, {2, 1}, {4, 1}, {5, 4}};
  int first[6] = {0, 1, 2, 3, -1, 5};
  const int wanted[6] = {0, 1, 1, 0, -1, 0};
  for (int i = 0; i < 5; i++) add_edge(&pump, edge[i][0], edge[i][1]);
  pump.survey.edge = pump.edge;
  pump.survey.face_count = 6;
  assert_int_equal(cw_cad_join_faces(&pump.survey, first), 2);
  assert_memory_equal(first, wanted, sizeof first);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_wheel),
      cmocka_unit_test(without_blades),
      cmocka_unit_test(blades_at_the_outlet),
      cmocka_unit_test(a_blade_may_have_many_faces),
      cmocka_unit_test(the_other_half_is_not_counted),
      cmocka_unit_test(blades_and_passages),
      cmocka_unit_test(eyes_of_a_double_suction_wheel),
      cmocka_unit_test(stages_in_series),
      cmocka_unit_test(wheels_in_parallel),
      cmocka_unit_test(parts_of_a_wheel),
      cmocka_unit_test(faces_that_hang_together),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
