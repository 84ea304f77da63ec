// SPDX-License-Identifier: AGPL-3.0-or-later
// Faces with a point for a side: an eighth of a sphere, a quarter of a cone, a three-sided spline. Points, normals and
// projections are those of the solids by hand.
#include <cmath>

#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>

#include "mesher/cad/cad_shape.h"
#include "mesher/common/vec.h"
#include "solids.h"

static const double radius = 0.005, height = 0.012; // m

static TopoDS_Shape eighth_of_a_sphere() {
  return BRepPrimAPI_MakeSphere(1e3 * radius, 0, M_PI / 2, M_PI / 2).Shape();
}

static TopoDS_Shape quarter_of_a_cone() {
  return BRepPrimAPI_MakeCone(1e3 * radius, 0, 1e3 * height, M_PI / 2).Shape();
}

static int face_with_pole(const CwCad *cad) {
  for (int f = 0; f < cw_cad_face_count(cad); f++)
    if (cad->face[f].pole.is) return f;
  fail_msg("no face has a pole");
  return -1;
}

// The vertex at the pole has one place in the plane, the origin, from either edge; three edges bound the face.
static void check_outline(const CwCad *cad, int face, double tip) {
  int edges = 0, at_pole = 0;
  for (int e = 0; e < cw_cad_edge_count(cad); e++) {
    int faces[2];
    double t[2];
    cw_cad_edge_faces(cad, e, faces);
    cw_cad_edge_range(cad, e, t);
    if (faces[0] != face && faces[1] != face) continue;
    edges++;
    for (int k = 0; k <= 4; k++) {
      double uv[2], x[3], on[3];
      cw_cad_edge_uv(cad, e, face, t[0] + (t[1] - t[0]) * k / 4, uv);
      cw_cad_face_point(cad, face, uv, x, nullptr, nullptr);
      cw_cad_edge_point(cad, e, t[0] + (t[1] - t[0]) * k / 4, on, nullptr);
      for (int d = 0; d < 3; d++) assert_near(x[d], on[d], 1e-12);
      if (std::fabs(x[2] - tip) > 1e-12) continue;
      at_pole++;
      assert_true(uv[0] == 0 && uv[1] == 0);
    }
  }
  assert_int_equal(edges, 3);
  assert_int_equal(at_pole, 2);
}

// Derivatives are differences, and the parameters keep their size up to the pole.
static void check_derivatives(const CwCad *cad, int face) {
  double least = INFINITY, most = 0;
  for (int i = 0; i < 40; i++) {
    double uv[] = {0.002 * std::cos(0.015 * i), 0.002 * std::sin(0.015 * i)}, x[3], d[2][3], area[3];
    for (int k = 0; k < 2; k++) uv[k] *= std::pow(0.5, i % 9);
    cw_cad_face_point(cad, face, uv, x, d[0], d[1]);
    for (int k = 0; k < 2; k++) {
      const double step = 1e-3 * std::hypot(uv[0], uv[1]);
      double ahead[] = {uv[0], uv[1]}, behind[] = {uv[0], uv[1]}, xa[3], xb[3];
      ahead[k] += step;
      behind[k] -= step;
      cw_cad_face_point(cad, face, ahead, xa, nullptr, nullptr);
      cw_cad_face_point(cad, face, behind, xb, nullptr, nullptr);
      for (int c = 0; c < 3; c++) assert_near(d[k][c], (xa[c] - xb[c]) / (2 * step), 1e-5 * cw_norm(d[k]));
    }
    cw_cross(d[0], d[1], area);
    least = std::fmin(least, cw_norm(area));
    most = std::fmax(most, cw_norm(area));
  }
  assert_true(least > 0.5 * most);
}

static void check_sphere(const TopoDS_Shape &solid, double most_off) {
  CwCad *cad = open_solid(solid);
  const int face = face_with_pole(cad);
  check_outline(cad, face, radius);
  check_derivatives(cad, face);
  assert_near(solid_volume(cad), M_PI / 6 * radius * radius * radius, 1e-6 * radius * radius * radius);
  for (int i = 1; i < 20; i++) {
    const double polar = 0.07 * i * std::pow(0.3, i % 4), around = 0.075 * i; // some very near to the pole
    const double n[] = {std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar)};
    const double target[] = {0.0053 * n[0], 0.0053 * n[1], 0.0053 * n[2]};
    double uv[] = {0.01, 0}, on[3], normal[3];
    if (i % 2) uv[0] = uv[1] = 0;
    assert_near(cw_cad_face_project(cad, face, target, uv), 0.0003, most_off);
    cw_cad_face_point(cad, face, uv, on, nullptr, nullptr);
    cw_cad_face_normal(cad, face, uv, normal);
    for (int c = 0; c < 3; c++) assert_near(on[c], radius * n[c], 1e-9);
    for (int c = 0; c < 3; c++) assert_near(normal[c], n[c], 1e-5);
    assert_near(cw_cad_face_curvature(cad, face, uv, nullptr), -1 / radius, 1e-3 / radius);
  }
  const double pole[] = {0, 0};
  double normal[3];
  cw_cad_face_normal(cad, face, pole, normal);
  assert_near(normal[2], 1, 1e-9);
  cw_cad_close(&cad);
}

static void a_sphere_is_regular_at_its_pole(void **) {
  check_sphere(eighth_of_a_sphere(), 1e-12);
}

static void so_is_a_spline_with_three_sides(void **) {
  check_sphere(BRepBuilderAPI_NurbsConvert(eighth_of_a_sphere()).Shape(), 1e-12);
}

static void the_tip_of_a_cone_is_a_vertex(void **) {
  CwCad *cad = open_solid(quarter_of_a_cone());
  const int face = face_with_pole(cad);
  check_outline(cad, face, height);
  check_derivatives(cad, face);
  // Its plane is the cone unrolled: lengths and angles of two generators are those in space.
  const CwCadPole &pole = cad->face[face].pole;
  assert_near(std::fabs(pole.rate), radius / std::hypot(radius, height), 1e-3);
  double uv[] = {0.003, 0.001}, normal[3];
  const double target[] = {0.002, 0.002, 0.009};
  const double r = std::hypot(target[0], target[1]), slant = std::hypot(radius, height);
  const double off = (r - radius * (1 - target[2] / height)) * height / slant; // from the line of its profile
  assert_near(cw_cad_face_project(cad, face, target, uv), std::fabs(off), 1e-12);
  cw_cad_face_normal(cad, face, uv, normal);
  assert_near(normal[2], radius / slant, 1e-9);
  assert_near(normal[0], normal[1], 1e-9);
  cw_cad_close(&cad);
}

static void rescaled_solids_keep_their_poles(void **) {
  CwCad *cad = open_solid(quarter_of_a_cone());
  assert_int_equal(cw_cad_rescale(cad, 8e-3), CW_OK); // of millimetres
  check_outline(cad, face_with_pole(cad), height / 8e-3);
  cw_cad_close(&cad);
}

static void two_poles_are_too_many(void **) {
  TemporaryFolder folder;
  CwCad *cad = nullptr;
  write_solid(folder, BRepPrimAPI_MakeSphere(5, M_PI / 2).Shape(), all_wall);
  assert_int_equal(cw_cad_open(folder.path.c_str(), "part", &cad), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "is degenerate (a point), and so is another"));
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_sphere_is_regular_at_its_pole), cmocka_unit_test(so_is_a_spline_with_three_sides),
      cmocka_unit_test(the_tip_of_a_cone_is_a_vertex), cmocka_unit_test(rescaled_solids_keep_their_poles),
      cmocka_unit_test(two_poles_are_too_many)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
