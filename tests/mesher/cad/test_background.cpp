// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>
#include <cstring>
#include <vector>

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>

#include "mesher/cad/background_make.h"
#include "mesher/cad/background_tessellate.h"

#include "closed_background.h"

static const double radius = 0.005, height = 0.012;

static CwBackground make(CwCad *cad, double deflection) {
  CwBackground background;
  if (cw_background_make(cad, deflection, 0.2, &background) != CW_OK) fail_msg("%s", cw_fail_message());
  return background;
}

static void box_is_closed_and_exact(void **state) {
  CwCad *cad = open_solid(BRepPrimAPI_MakeBox(10, 20, 30).Shape());
  CwBackground b = make(cad, 1e-4);
  check_closed(&b);
  check_corners(cad, &b);
  assert_int_equal(b.triangle_count, 12);
  assert_near(cw_background_volume(&b), 6e-6, 1e-16);
  cw_background_free(&b);
  assert_null(b.x);
  cw_cad_close(&cad);
}

static void inside_out_file_still_has_normals_out(void **state) {
  CwCad *cad = open_solid(BRepPrimAPI_MakeBox(10, 20, 30).Shape().Reversed());
  CwBackground b = make(cad, 1e-4);
  assert_near(cw_background_volume(&b), 6e-6, 1e-16);
  assert_near(solid_volume(cad), 6e-6, 1e-15); // the solid has been turned with it
  check_closed(&b);
  check_corners(cad, &b);
  cw_background_free(&b);
  cw_cad_close(&cad);
}

static void cylinder_converges_from_inside(void **state) {
  CwCad *cad = open_solid(BRepPrimAPI_MakeCylinder(radius * 1e3, height * 1e3, M_PI / 2).Shape());
  const double exact = M_PI / 4 * radius * radius * height;
  double error[2];
  for (int i = 0; i < 2; i++) {
    CwBackground b = make(cad, i ? 1e-6 : 3e-5);
    check_closed(&b);
    check_corners(cad, &b);
    error[i] = exact - cw_background_volume(&b);
    cw_background_free(&b);
  }
  assert_true(error[1] > 0 && error[1] < error[0] / 5);
  assert_true(error[1] / exact < 5e-4);
  cw_cad_close(&cad);
}

static void two_runs_are_the_same(void **state) {
  CwCad *cad = open_solid(BRepPrimAPI_MakeCylinder(5, 12, M_PI / 2).Shape());
  CwBackground a = make(cad, 1e-5), b = make(cad, 1e-5);
  assert_int_equal(a.point_count, b.point_count);
  assert_int_equal(a.triangle_count, b.triangle_count);
  assert_memory_equal(a.x, b.x, a.point_count * sizeof *a.x);
  assert_memory_equal(a.triangle, b.triangle, a.triangle_count * sizeof *a.triangle);
  assert_memory_equal(a.uv, b.uv, a.triangle_count * sizeof *a.uv);
  cw_background_free(&a);
  cw_background_free(&b);
  cw_cad_close(&cad);
}

// As two ranks do: each divides the edges, and takes every other face from the other.
static void faces_of_two_ranks_are_joined(void **state) {
  CwCad *cad[2] = {open_solid(BRepPrimAPI_MakeCylinder(5, 12, M_PI / 2).Shape()),
                   open_solid(BRepPrimAPI_MakeCylinder(5, 12, M_PI / 2).Shape())};
  CwTessellation *tessellation[2];
  CwBackground a = make(cad[0], 1e-5), b;
  int faces = cw_cad_face_count(cad[0]);
  std::vector<void *> bytes(faces);
  int64_t size;
  for (int rank = 0; rank < 2; rank++)
    assert_int_equal(cw_tessellation_start(cad[rank], 1e-5, 0.2, &tessellation[rank]), CW_OK);
  for (int f = faces - 1; f >= 0; f--) {
    assert_int_equal(cw_tessellation_face(tessellation[f % 2], f, &bytes[f], &size), CW_OK);
    assert_true(cw_tessellation_cost(tessellation[0], f) >= 4);
  }
  assert_int_equal(cw_background_join(nullptr, cad[1], bytes.data(), &b), CW_OK);
  assert_int_equal(a.point_count, b.point_count);
  assert_int_equal(a.triangle_count, b.triangle_count);
  assert_memory_equal(a.x, b.x, a.point_count * sizeof *a.x);
  assert_memory_equal(a.triangle, b.triangle, a.triangle_count * sizeof *a.triangle);
  assert_memory_equal(a.face, b.face, a.triangle_count * sizeof *a.face);
  assert_memory_equal(a.uv, b.uv, a.triangle_count * sizeof *a.uv);
  check_neighbours(&b);
  cw_background_free(&a);
  cw_background_free(&b);
  for (void *block : bytes) free(block);
  for (int rank = 0; rank < 2; rank++) {
    cw_tessellation_free(&tessellation[rank]);
    cw_cad_close(&cad[rank]);
  }
}

static void senseless_deflection_is_refused(void **state) {
  CwCad *cad = open_solid(BRepPrimAPI_MakeBox(1, 1, 1).Shape());
  CwBackground b;
  assert_int_equal(cw_background_make(cad, 0, 0.2, &b), CW_ERR_USAGE);
  assert_null(b.x);
  cw_cad_close(&cad);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(box_is_closed_and_exact),        cmocka_unit_test(inside_out_file_still_has_normals_out),
      cmocka_unit_test(cylinder_converges_from_inside), cmocka_unit_test(two_runs_are_the_same),
      cmocka_unit_test(faces_of_two_ranks_are_joined),  cmocka_unit_test(senseless_deflection_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
