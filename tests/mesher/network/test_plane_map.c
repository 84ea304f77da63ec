// SPDX-License-Identifier: AGPL-3.0-or-later
// Coordinates of partition planes: an isometry, the same way round on any plane.
#include "mesher/common/vec.h"
#include "mesher/network/plane_map.h"
#include "tests/unit_test.h"

static const double normals[][3] = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {-1, 0, 0}, {1, 2, 2}, {-2, 3, 6}, {1, 1, 1}};
enum { NORMALS = sizeof normals / sizeof *normals };

static CwPlane plane_of(int i) {
  CwPlane plane = {.offset = 0.3 * i - 0.7};
  cw_copy(normals[i], plane.normal);
  cw_unit(plane.normal);
  return plane;
}

// u x v = normal: triangles that are counter-clockwise in (u,v) look along the normal.
static void axes_are_right_handed(void **state) {
  for (int i = 0; i < NORMALS; i++) {
    const CwPlane plane = plane_of(i);
    const CwPlaneMap map = cw_plane_map_of(&plane);
    double turned[3];
    assert_near(cw_norm(map.axis[0]), 1, 1e-15);
    assert_near(cw_dot(map.axis[0], map.axis[1]), 0, 1e-15);
    cw_cross(map.axis[0], map.axis[1], turned);
    for (int k = 0; k < 3; k++) {
      assert_near(turned[k], plane.normal[k], 1e-15);
      assert_near(map.axis[2][k], plane.normal[k], 0);
    }
  }
}

static void places_go_there_and_back(void **state) {
  const double place[2][2] = {{0.2, -0.3}, {-1.1, 0.4}};
  for (int i = 0; i < NORMALS; i++) {
    const CwPlane plane = plane_of(i);
    const CwPlaneMap map = cw_plane_map_of(&plane);
    double x[2][3], uv[2];
    for (int p = 0; p < 2; p++) {
      double xu[3], xv[3], aside[3];
      cw_plane_map(&map, place[p], x[p], p ? NULL : xu, p ? NULL : xv);
      assert_near(cw_plane_distance(&plane, x[p]), 0, 1e-15);
      for (int k = 0; k < 3 && !p; k++) {
        assert_near(xu[k], map.axis[0][k], 0);
        assert_near(xv[k], map.axis[1][k], 0);
      }
      // What lies beside the plane has the coordinates of its foot.
      for (int k = 0; k < 3; k++) aside[k] = x[p][k] - 0.8 * plane.normal[k];
      cw_plane_uv(&map, aside, uv);
      for (int k = 0; k < 2; k++) assert_near(uv[k], place[p][k], 1e-15);
    }
    assert_near(cw_distance(x[0], x[1]), hypot(1.3, 0.7), 1e-15);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(axes_are_right_handed),
      cmocka_unit_test(places_go_there_and_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
