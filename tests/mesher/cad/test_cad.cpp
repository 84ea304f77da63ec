// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <ShapeFix_ShapeTolerance.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BinTools.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_OffsetSurface.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include "mesher/cad/cad_shape.h"
#include "mesher/common/vec.h"
#include "solids.h"

static const double radius = 0.005, height = 0.012; // of the quarter cylinder, m

static TopoDS_Shape quarter_cylinder() {
  return BRepPrimAPI_MakeCylinder(radius * 1e3, height * 1e3, M_PI / 2).Shape();
}

static TopoDS_Shape quarter_cylinder_as_splines() {
  return BRepBuilderAPI_NurbsConvert(quarter_cylinder()).Shape();
}

// Mid of the (u,v) of a face's edges: a point inside for the convex faces here.
static void inner_uv(const CwCad *cad, int face, double uv[2]) {
  double low[2] = {1e30, 1e30}, high[2] = {-1e30, -1e30};
  for (int e = 0; e < cw_cad_edge_count(cad); e++) {
    int faces[2];
    double t[2];
    cw_cad_edge_faces(cad, e, faces);
    cw_cad_edge_range(cad, e, t);
    if (faces[0] != face && faces[1] != face) continue;
    for (int end = 0; end < 2; end++) {
      double at[2];
      cw_cad_edge_uv(cad, e, face, t[end], at);
      for (int k = 0; k < 2; k++) {
        low[k] = std::min(low[k], at[k]);
        high[k] = std::max(high[k], at[k]);
      }
    }
  }
  for (int k = 0; k < 2; k++) uv[k] = 0.5 * (low[k] + high[k]);
}

static void box_has_its_parts_and_patches(void **state) {
  CwCad *cad = open_solid(BRepPrimAPI_MakeBox(10, 20, 30).Shape(), [](const TopoDS_Face &face) {
    double normal_z = std::fabs(BRepAdaptor_Surface(face).Plane().Axis().Direction().Z());
    return normal_z > 0.5 ? std::string("ends,inlet") : std::string("sides,wall");
  });
  assert_int_equal(cw_cad_face_count(cad), 6);
  assert_int_equal(cw_cad_edge_count(cad), 12);
  assert_int_equal(cw_cad_vertex_count(cad), 8);
  assert_near(solid_volume(cad), 6e-6, 1e-15);
  assert_int_equal(cw_cad_patch_count(cad), 2);
  int sides = std::strcmp(cw_cad_patch_name(cad, 0), "sides") == 0 ? 0 : 1;
  assert_string_equal(cw_cad_patch_name(cad, !sides), "ends");
  assert_int_equal(cw_cad_patch_kind(cad, sides), CW_PATCH_WALL);
  assert_int_equal(cw_cad_patch_kind(cad, !sides), CW_PATCH_INLET);
  assert_string_equal(cw_cad_face_name(cad, 2), "face_3");
  int on_sides = 0;
  for (int f = 0; f < 6; f++) on_sides += cw_cad_face_patch(cad, f) == sides;
  assert_int_equal(on_sides, 4);

  double low[3] = {1, 1, 1}, high[3] = {-1, -1, -1};
  for (int v = 0; v < 8; v++) {
    double x[3];
    cw_cad_vertex_point(cad, v, x);
    for (int k = 0; k < 3; k++) {
      low[k] = std::min(low[k], x[k]);
      high[k] = std::max(high[k], x[k]);
    }
  }
  for (int k = 0; k < 3; k++) {
    assert_near(low[k], 0, 1e-15);
    assert_near(high[k], 0.01 * (k + 1), 1e-15);
  }
  cw_cad_close(&cad);
  assert_null(cad);
}

static void check_normals_point_out(CwCad *cad, const double inside[3]) {
  for (int f = 0; f < cw_cad_face_count(cad); f++) {
    double uv[2], x[3], xu[3], xv[3];
    inner_uv(cad, f, uv);
    cw_cad_face_point(cad, f, uv, x, xu, xv);
    double n[3], outward = 0;
    cw_cad_face_normal(cad, f, uv, n);
    assert_near(cw_dot(n, n), 1, 1e-14);
    assert_near(cw_dot(n, xu), 0, 1e-14);
    assert_near(cw_dot(n, xv), 0, 1e-14);
    for (int k = 0; k < 3; k++) outward += n[k] * (x[k] - inside[k]);
    assert_true(outward > 0);
  }
}

static void normals_point_out_of_the_domain(void **state) {
  const double box_centre[3] = {0.005, 0.01, 0.015}, cylinder_inside[3] = {0.002, 0.002, 0.006};
  CwCad *cad = open_solid(BRepPrimAPI_MakeBox(10, 20, 30).Shape());
  check_normals_point_out(cad, box_centre);
  cw_cad_close(&cad);
  cad = open_solid(BRepPrimAPI_MakeBox(10, 20, 30).Shape().Reversed()); // inside out in the file
  assert_near(solid_volume(cad), -6e-6, 1e-15);
  cw_cad_turn(cad);
  check_normals_point_out(cad, box_centre);
  assert_near(solid_volume(cad), 6e-6, 1e-15);
  cw_cad_close(&cad);
  cad = open_solid(quarter_cylinder());
  check_normals_point_out(cad, cylinder_inside);
  cw_cad_close(&cad);
}

static void check_derivatives(const CwCad *cad) {
  for (int f = 0; f < cw_cad_face_count(cad); f++) {
    double uv[2], x[3], derivative[2][3];
    inner_uv(cad, f, uv);
    cw_cad_face_point(cad, f, uv, x, derivative[0], derivative[1]);
    for (int k = 0; k < 2; k++) {
      double step = 1e-5, ahead[2] = {uv[0], uv[1]}, behind[2] = {uv[0], uv[1]}, xa[3], xb[3];
      ahead[k] += step;
      behind[k] -= step;
      cw_cad_face_point(cad, f, ahead, xa, nullptr, nullptr);
      cw_cad_face_point(cad, f, behind, xb, nullptr, nullptr);
      for (int d = 0; d < 3; d++) assert_near(derivative[k][d], (xa[d] - xb[d]) / (2 * step), 1e-9);
    }
  }
  for (int e = 0; e < cw_cad_edge_count(cad); e++) {
    double t[2], x[3], xt[3], xa[3], xb[3], step = 1e-5;
    cw_cad_edge_range(cad, e, t);
    double mid = 0.4 * t[0] + 0.6 * t[1];
    cw_cad_edge_point(cad, e, mid, x, xt);
    cw_cad_edge_point(cad, e, mid + step, xa, nullptr);
    cw_cad_edge_point(cad, e, mid - step, xb, nullptr);
    for (int d = 0; d < 3; d++) assert_near(xt[d], (xa[d] - xb[d]) / (2 * step), 1e-9);
  }
}

static void derivatives_match_differences(void **state) {
  CwCad *cad = open_solid(quarter_cylinder());
  check_derivatives(cad);
  cw_cad_close(&cad);
  cad = open_solid(quarter_cylinder_as_splines());
  check_derivatives(cad);
  cw_cad_close(&cad);
}

static void cylinder_has_curvature_and_projection(void **state) {
  CwCad *cad = open_solid(quarter_cylinder(), by_shape);
  int face = curved_face(cad);
  double uv[2], x[3], on[3];
  inner_uv(cad, face, uv);
  assert_near(cw_cad_face_curvature(cad, face, uv, nullptr), -1 / radius, 1e-9);
  assert_near(cw_cad_face_curvature(cad, !face, uv, nullptr), 0, 1e-12);
  cw_cad_face_point(cad, face, uv, x, nullptr, nullptr);
  assert_near(std::hypot(x[0], x[1]), radius, 1e-15);

  // 1 mm outside and 2 mm inside the wall, from a guess 0.5 rad off.
  const double r[2] = {0.006, 0.003};
  for (int i = 0; i < 2; i++) {
    const double target[3] = {r[i] * std::cos(0.9), r[i] * std::sin(0.9), 0.004};
    double guess[2] = {uv[0] - 0.5, uv[1]};
    assert_near(cw_cad_face_project(cad, face, target, guess), std::fabs(r[i] - radius), 1e-13);
    cw_cad_face_point(cad, face, guess, on, nullptr, nullptr);
    const double nearest[3] = {radius * std::cos(0.9), radius * std::sin(0.9), 0.004};
    assert_true(cw_distance(on, nearest) < 1e-11);
  }
  cw_cad_close(&cad);
}

static void spline_faces_do_the_same(void **state) {
  CwCad *cad = open_solid(quarter_cylinder_as_splines(), [](const TopoDS_Face &face) {
    BRepAdaptor_Surface surface(face);
    gp_Pnt p;
    gp_Vec u, v, uu, vv, uv;
    surface.D2(0.5 * (surface.FirstUParameter() + surface.LastUParameter()),
               0.5 * (surface.FirstVParameter() + surface.LastVParameter()), p, u, v, uu, vv, uv);
    bool bent = uu.Crossed(u).Magnitude() > 1e-6 || vv.Crossed(v).Magnitude() > 1e-6;
    return std::string(bent ? "curved,wall" : "flat,wall");
  });
  int face = curved_face(cad);
  double uv[2], x[3], first[3], again[3];
  inner_uv(cad, face, uv);
  assert_near(cw_cad_face_curvature(cad, face, uv, nullptr), -1 / radius, 1e-7);
  const double target[3] = {0.004 * std::cos(0.3), 0.004 * std::sin(0.3), 0.011};
  assert_near(cw_cad_face_project(cad, face, target, uv), 0.001, 1e-13);
  cw_cad_face_point(cad, face, uv, x, nullptr, nullptr);
  const double nearest[3] = {radius * std::cos(0.3), radius * std::sin(0.3), 0.011};
  assert_true(cw_distance(x, nearest) < 1e-11);

  // The same bits whatever was evaluated before, even a rounding error off a knot.
  double t[2];
  cw_cad_edge_range(cad, 0, t);
  const double corner[2] = {0, 0}, beside[2] = {1e-15, 1e-15}, far[2] = {uv[0] * 1.01, uv[1] * 0.99};
  cw_cad_face_point(cad, face, corner, x, nullptr, nullptr);
  cw_cad_face_point(cad, face, beside, first, nullptr, nullptr);
  cw_cad_face_point(cad, face, far, x, nullptr, nullptr);
  cw_cad_face_point(cad, face, beside, again, nullptr, nullptr);
  assert_memory_equal(first, again, sizeof first);
  cw_cad_close(&cad);
}

static void check_edges(const CwCad *cad) {
  for (int e = 0; e < cw_cad_edge_count(cad); e++) {
    double t[2], x[3], on[3], uv[2];
    int face[2], vertex[2];
    cw_cad_edge_range(cad, e, t);
    cw_cad_edge_faces(cad, e, face);
    cw_cad_edge_vertices(cad, e, vertex);
    assert_int_not_equal(face[0], face[1]);
    for (int i = 0; i <= 10; i++) {
      double at = t[0] + (t[1] - t[0]) * i / 10;
      cw_cad_edge_point(cad, e, at, x, nullptr);
      for (int side = 0; side < 2; side++) {
        cw_cad_edge_uv(cad, e, face[side], at, uv);
        cw_cad_face_point(cad, face[side], uv, on, nullptr, nullptr);
        assert_true(cw_distance(x, on) < 1e-7);
      }
    }
    for (int end = 0; end < 2; end++) {
      cw_cad_edge_point(cad, e, t[end], x, nullptr);
      cw_cad_vertex_point(cad, vertex[end], on);
      assert_true(cw_distance(x, on) < 1e-9);
    }
  }
}

static void edges_lie_on_both_faces(void **state) {
  CwCad *cad = open_solid(quarter_cylinder());
  check_edges(cad);
  cw_cad_close(&cad);
  cad = open_solid(quarter_cylinder_as_splines());
  check_edges(cad);
  cw_cad_close(&cad);
}

static void expect_refusal(const TemporaryFolder &folder, CwStatus code, const char *text) {
  CwCad *cad = nullptr;
  assert_int_equal(cw_cad_open(folder.path.c_str(), "part", &cad), code);
  assert_null(cad);
  if (!std::strstr(cw_fail_message(), text)) fail_msg("'%s' is not in '%s'", text, cw_fail_message());
}

static void bad_solids_are_refused(void **state) {
  TemporaryFolder folder;
  expect_refusal(folder, CW_ERR_IO, "part.brep: cannot be read");
  write_solid(folder, BRepPrimAPI_MakeCylinder(5, 12).Shape(), all_wall);
  expect_refusal(folder, CW_ERR_INPUT, "is a seam");
  write_solid(folder, BRepPrimAPI_MakeSphere(5).Shape(), all_wall);
  expect_refusal(folder, CW_ERR_INPUT, "mm is ");
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(BRepPrimAPI_MakeBox(1, 1, 1).Shape(), TopAbs_FACE, faces);
  write_solid(folder, faces(1), all_wall);
  expect_refusal(folder, CW_ERR_INPUT, "holds 0 solids");
}

// The seam begins at (5, 0, 0) of a unit of 2 mm.
static void places_are_told_in_millimetres(void **state) {
  TemporaryFolder folder;
  write_solid(folder, BRepPrimAPI_MakeCylinder(5, 12).Shape(), all_wall);
  std::ofstream(folder.path + "/model.json") << "{\"unit_m\": 0.002}";
  expect_refusal(folder, CW_ERR_INPUT, "the edge at (10.000, ");
}

static void binary_file_is_read_and_half_of_it_refused(void **state) {
  TemporaryFolder folder;
  TopoDS_Shape solid = quarter_cylinder();
  write_solid(folder, solid, all_wall);
  const std::string path = folder.path + "/part.brep";
  assert_true(BinTools::Write(solid, path.c_str()));
  CwCad *cad = nullptr;
  check(cw_cad_open(folder.path.c_str(), "part", &cad));
  assert_near(solid_volume(cad), M_PI / 4 * radius * radius * height, 1e-12);
  cw_cad_close(&cad);
  assert_int_equal(truncate(path.c_str(), std::filesystem::file_size(path) / 2), 0);
  expect_refusal(folder, CW_ERR_INPUT, "is not a B-rep file of OpenCASCADE");
}

static void bad_face_tables_are_refused(void **state) {
  TemporaryFolder folder;
  write_solid(folder, BRepPrimAPI_MakeBox(1, 1, 1).Shape(), all_wall);
#define HEAD "domain,face,patch,kind,name\n"
  write_text(folder, "face,domain\n");
  expect_refusal(folder, CW_ERR_INPUT, "faces.csv:1: the header");
  write_text(folder, HEAD "part,1,hub,wall\n");
  expect_refusal(folder, CW_ERR_INPUT, "faces.csv:2: the row has fewer");
  write_text(folder, HEAD "part,7,hub,wall,hub_7\n");
  expect_refusal(folder, CW_ERR_INPUT, "faces.csv:2: face '7' is wrong; part has faces 1 to 6");
  write_text(folder, HEAD "part,1,hub,wall,hub_1\npart,2,hub,inlet,hub_2\n");
  expect_refusal(folder, CW_ERR_INPUT, "faces.csv:3: patch 'hub'");
  write_text(folder, HEAD "part,1,hub,wall,hub_1\npart,1,hub,wall,hub_1\n");
  expect_refusal(folder, CW_ERR_INPUT, "faces.csv:3: face 1 of part is named a second time");
  write_text(folder, HEAD "part,1,hub,floor,hub_1\n");
  expect_refusal(folder, CW_ERR_INPUT, "kind 'floor' is unknown");
  write_text(folder, HEAD "part,1,,wall,hub_1\n");
  expect_refusal(folder, CW_ERR_INPUT, "patch '' has 0 characters");
  write_text(folder, HEAD "part,1,hub,wall,hub_1\n");
  expect_refusal(folder, CW_ERR_INPUT, "face 2 of part has no row");
#undef HEAD
}

// In metres: a box of 10 mm is exact to 1e-7 mm, which is less than the least; healed solids are not.
static void places_are_one_within_the_tolerance(void **state) {
  for (double tolerance : {1e-7, 2e-3}) {
    TopoDS_Shape box = BRepPrimAPI_MakeBox(10, 10, 10).Shape();
    ShapeFix_ShapeTolerance().SetTolerance(box, tolerance);
    CwCad *cad = open_solid(box);
    assert_near(cw_cad_tolerance(cad), tolerance > 1e-6 ? 1e-3 * tolerance : 1e-9, 1e-15);
    cw_cad_close(&cad);
  }
}

// A box one face of which is the offset of a strip without width, which has no normal: whoever evaluates it ends with
// one line, that names the face and its place.
static void what_cannot_be_evaluated_ends_in_one_line(void **state) {
  CwCad *cad = open_solid(BRepPrimAPI_MakeBox(10, 20, 30).Shape());
  TColgp_Array2OfPnt pole(1, 2, 1, 2);
  for (int i = 1; i <= 2; i++)
    for (int k = 1; k <= 2; k++) pole(i, k) = gp_Pnt(i, 0, 0);
  cad->face[2].surface.Load(new Geom_OffsetSurface(new Geom_BezierSurface(pole), 1, Standard_True));
  int ends[2], ended;
  assert_int_equal(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    const double uv[2] = {0.5, 0.5};
    double x[3];
    dup2(ends[1], STDERR_FILENO);
    cw_cad_face_point(cad, 2, uv, x, nullptr, nullptr);
    _exit(0);
  }
  close(ends[1]);
  std::string told;
  char part[1000];
  for (ssize_t size; (size = read(ends[0], part, sizeof part)) > 0;) told.append(part, (size_t)size);
  close(ends[0]);
  assert_int_equal(waitpid(child, &ended, 0), child);
  assert_true(WIFEXITED(ended));
  assert_int_equal(WEXITSTATUS(ended), CW_ERR_GEOMETRY);
  if (told.find("face 'face_3' of wall, with a corner at (") == std::string::npos) fail_msg("%s", told.c_str());
  assert_int_equal(std::count(told.begin(), told.end(), '\n'), 1);
  cw_cad_close(&cad);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(box_has_its_parts_and_patches),
      cmocka_unit_test(normals_point_out_of_the_domain),
      cmocka_unit_test(binary_file_is_read_and_half_of_it_refused),
      cmocka_unit_test(derivatives_match_differences),
      cmocka_unit_test(cylinder_has_curvature_and_projection),
      cmocka_unit_test(spline_faces_do_the_same),
      cmocka_unit_test(edges_lie_on_both_faces),
      cmocka_unit_test(bad_solids_are_refused),
      cmocka_unit_test(places_are_told_in_millimetres),
      cmocka_unit_test(places_are_one_within_the_tolerance),
      cmocka_unit_test(bad_face_tables_are_refused),
      cmocka_unit_test(what_cannot_be_evaluated_ends_in_one_line),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
