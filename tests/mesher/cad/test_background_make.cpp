// SPDX-License-Identifier: AGPL-3.0-or-later
// Faces of a box joined, as they are and damaged by hand.
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>

extern "C" {
#include "mesher/cad/background_make.h"
#include "mesher/cad/background_tessellate.h"
#include "mesher/cad/rays.h"
}

#include "closed_background.h"
#include "face_block.h"
#include "polyhedron.h"

// A solid with the blocks of bytes of its faces.
struct Faces {
  CwCad *cad;
  std::vector<void *> bytes;

  explicit Faces(const TopoDS_Shape &solid) : cad(open_solid(solid)), bytes(cw_cad_face_count(cad)) {
    CwTessellation *tessellation = nullptr;
    int64_t size;
    check(cw_tessellation_start(cad, 1e-4, 0.2, &tessellation));
    for (size_t f = 0; f < bytes.size(); f++) check(cw_tessellation_face(tessellation, (int)f, &bytes[f], &size));
    cw_tessellation_free(&tessellation);
  }
  ~Faces() {
    for (void *block : bytes) free(block);
    cw_cad_close(&cad);
  }
  int32_t *triangle(int face, int t) const {
    return FaceBlock(bytes[face]).triangle[t];
  }
  const double *place(int face, int32_t node) const {
    return FaceBlock(bytes[face]).node[node].x;
  }
  // Joining fails, with these words, at a corner of a triangle; nothing is left.
  void refuse(const char *what, const double (*corner)[3], int corners) {
    CwBackground background;
    double x[3], nearest = INFINITY;
    assert_int_equal(cw_background_join(nullptr, cad, bytes.data(), &background), CW_ERR_GEOMETRY);
    const char *at = std::strstr(cw_fail_message(), what);
    if (!at) fail_msg("'%s' is not in '%s'", what, cw_fail_message());
    assert_int_equal(std::sscanf(at + std::strlen(what), "%lf, %lf, %lf) mm", &x[0], &x[1], &x[2]), 3);
    for (int i = 0; i < corners; i++)
      nearest = std::fmin(nearest,
                          std::hypot(x[0] - 1e3 * corner[i][0], x[1] - 1e3 * corner[i][1], x[2] - 1e3 * corner[i][2]));
    assert_near(nearest, 0, 1e-3);
    assert_null(background.x);
    assert_null(background.neighbour);
    assert_null(background.rays);
    assert_int_equal(background.triangle_count, 0);
  }
};

static TopoDS_Shape box() {
  return BRepPrimAPI_MakeBox(10, 20, 30).Shape();
}

// Whatever the sense of the file: neighbours and rays are those of the triangles as they are handed over, and the solid
// has its normals out of the fluid.
static void all_is_joined(void **) {
  for (bool inside_out : {false, true}) {
    for (bool round : {false, true}) {
      TopoDS_Shape solid = round ? BRepPrimAPI_MakeCylinder(5, 12, M_PI / 2).Shape() : box();
      if (inside_out) solid.Reverse();
      Faces faces(solid);
      CwBackground b;
      check(cw_background_join(nullptr, faces.cad, faces.bytes.data(), &b));
      check_closed(&b);
      check_corners(faces.cad, &b);
      check_neighbours(&b);
      assert_true(cw_background_volume(&b) > 0);
      assert_true(solid_volume(faces.cad) > 0);
      const double inside[3] = {2e-3, 2e-3, 4e-3}, up[3] = {0, 0, 1};
      for (int32_t t = 0; t < b.triangle_count; t++) {
        double n[3], of_face[3];
        cw_background_normal(&b, t, n);
        cw_cad_face_normal(faces.cad, b.face[t], b.uv[t][0], of_face);
        assert_true(n[0] * of_face[0] + n[1] * of_face[1] + n[2] * of_face[2] > 0.97);
      }
      double distance;
      const int32_t met = cw_rays_exit(b.rays, inside, up, 0, 1, &distance);
      assert_true(met >= 0);
      assert_near(distance, (round ? 12e-3 : 30e-3) - 4e-3, 1e-15);
      cw_background_free(&b);
    }
  }
}

static void places_of(const Faces &faces, int face, const int32_t *corner, double place[3][3]) {
  for (int k = 0; k < 3; k++) std::copy(faces.place(face, corner[k]), faces.place(face, corner[k]) + 3, place[k]);
}

// Two corners of a triangle fall together: it is folded away, and leaves a hole.
static void a_hole_is_open(void **) {
  for (int face = 0; face < 6; face++) {
    Faces faces(box());
    double place[3][3];
    int32_t *corner = faces.triangle(face, 1);
    places_of(faces, face, corner, place);
    corner[1] = corner[0];
    faces.refuse(": the tessellation is open at (", place, 3);
  }
}

static void a_triangle_that_is_turned_over_is_refused(void **) {
  for (int face = 0; face < 6; face++) {
    Faces faces(box());
    double place[3][3];
    int32_t *corner = faces.triangle(face, 0);
    places_of(faces, face, corner, place);
    std::swap(corner[1], corner[2]);
    faces.refuse(": the tessellation folds or turns over at (", place, 3);
  }
}

// Two squares back to back. With one diagonal, that is an edge of four triangles; with two, the triangles are those of
// a tetrahedron without volume.
static void a_flat_solid_encloses_nothing(void **) {
  const std::vector<gp_Pnt> point = {gp_Pnt(0, 0, 0), gp_Pnt(10, 0, 0), gp_Pnt(10, 10, 0), gp_Pnt(0, 10, 0)};
  for (bool two : {false, true}) {
    Faces faces(polyhedron(point, {{0, 1, 2, 3}, {3, 2, 1, 0}}));
    const double corner[4][3] = {{0, 0, 0}, {0.01, 0, 0}, {0.01, 0.01, 0}, {0, 0.01, 0}}, uv[2] = {0, 0};
    const int wanted[3][2][3] = {{{0, 1, 2}, {0, 2, 3}}, {{0, 2, 1}, {0, 3, 2}}, {{1, 0, 3}, {1, 3, 2}}};
    for (int face = 0; face < 2; face++) {
      double n[3];
      cw_cad_face_normal(faces.cad, face, uv, n);
      for (int t = 0; t < 2; t++) {
        for (int k = 0; k < 3; k++) {
          const double *at = corner[wanted[n[2] > 0 ? 0 : two ? 2 : 1][t][k]];
          int32_t node = 0;
          while (std::hypot(faces.place(face, node)[0] - at[0], faces.place(face, node)[1] - at[1]) > 1e-9) node++;
          faces.triangle(face, t)[k] = node;
        }
      }
    }
    CwBackground background;
    const double diagonal[2][3] = {{0, 0, 0}, {0.01, 0.01, 0}};
    if (!two) faces.refuse(": the tessellation folds or turns over at (", diagonal, 2);
    if (!two) continue;
    assert_int_equal(cw_background_join(nullptr, faces.cad, faces.bytes.data(), &background), CW_ERR_GEOMETRY);
    assert_string_equal(cw_fail_message(), "solid of face 'face_1': the tessellation encloses 0 mm3; allowed: above 0");
    assert_null(background.x);
  }
}

static void only_chords_that_leave_the_surface_are_allowed(void **) {
  const double senseless[][2] = {{0, 0.2}, {-1e-4, 0.2}, {NAN, 0.2}, {1e-4, 0}, {1e-4, -0.1}, {1e-4, NAN}};
  CwCad *cad = open_solid(box());
  CwBackground background;
  for (const auto &one : senseless) {
    assert_int_equal(cw_background_make(cad, one[0], one[1], &background), CW_ERR_USAGE);
    assert_null(background.x);
  }
  check(cw_background_make(cad, 1e-4, 0.2, &background));
  assert_int_equal(background.triangle_count, 12);
  cw_background_free(&background);
  cw_cad_close(&cad);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(all_is_joined),
      cmocka_unit_test(a_hole_is_open),
      cmocka_unit_test(a_triangle_that_is_turned_over_is_refused),
      cmocka_unit_test(a_flat_solid_encloses_nothing),
      cmocka_unit_test(only_chords_that_leave_the_surface_are_allowed),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
