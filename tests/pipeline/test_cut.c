// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/cut.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/vec.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

static const CwCutPlane plane_z = {{0, 0, 0.25}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

static double area_of(int count, double polygon[][2]) {
  double area = 0;
  for (int k = 0; k < count; k++) {
    const double *a = polygon[k], *b = polygon[(k + 1) % count];
    area += 0.5 * (a[0] * b[1] - b[0] * a[1]);
  }
  return area;
}

static int cut(const CwCutPlane *plane, int count, const double (*x)[3], double polygon[CW_CUT_CORNERS][2]) {
  const double *corner[6];
  double s[6];
  for (int k = 0; k < count; k++) {
    corner[k] = x[k];
    s[k] = cw_cut_distance(plane, x[k]);
  }
  return cw_cut_cell(plane, count, corner, s, polygon);
}

static void cuts_have_the_right_areas(void **state) {
  double polygon[CW_CUT_CORNERS][2];
  // The unit tetrahedron at z = 1/4: a triangle of legs 3/4. All corners' areas are counter-clockwise, so
  // positive.
  const double tet[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  assert_int_equal(cut(&plane_z, 4, tet, polygon), 3);
  assert_near(area_of(3, polygon), 9.0 / 32, 1e-12);
  // Through the middles of four edges of a regular tetrahedron in a cube: a square.
  const double regular[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  const CwCutPlane middle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  assert_int_equal(cut(&middle, 4, regular, polygon), 4);
  assert_near(area_of(4, polygon), 2, 1e-12);
  // A pyramid of base 1 and height 1 at z = 1/4: a square of side 3/4.
  const double pyramid[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
  assert_int_equal(cut(&plane_z, 5, pyramid, polygon), 4);
  assert_near(area_of(4, polygon), 9.0 / 16, 1e-12);
  // A prism along and across its axis.
  const double prism[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  assert_int_equal(cut(&plane_z, 6, prism, polygon), 3);
  assert_near(area_of(3, polygon), 0.5, 1e-12);
  const CwCutPlane across = {{0.25, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  assert_int_equal(cut(&across, 6, prism, polygon), 4);
  assert_near(area_of(4, polygon), 0.75, 1e-12);
  const CwCutPlane beside = {{0, 0, 2}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  assert_int_equal(cut(&beside, 6, prism, polygon), 0);
}

static void a_face_in_the_plane_is_cut_once(void **state) {
  double polygon[CW_CUT_CORNERS][2];
  const CwCutPlane floor = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double over[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double under[4][3] = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}};
  assert_int_equal(cut(&floor, 4, over, polygon), 0);
  assert_int_equal(cut(&floor, 4, under, polygon), 3);
  assert_near(area_of(3, polygon), 0.5, 1e-12);
}

// Where the plane goes through corners of a cell, no corner of the cut stands twice.
static void corners_in_the_plane_stand_once(void **state) {
  double polygon[CW_CUT_CORNERS][2];
  const CwCutPlane across = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  // One corner behind, two in the plane, one before it.
  const double tet[4][3] = {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  assert_int_equal(cut(&across, 4, tet, polygon), 3);
  assert_near(area_of(3, polygon), 0.5, 1e-12);
  // Only an edge in the plane, or only a corner: no area, no cut.
  const double edge[4][3] = {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 1, 1}};
  assert_int_equal(cut(&across, 4, edge, polygon), 0);
  const double corner[4][3] = {{-1, 0, 0}, {-1, 1, 0}, {0, 0, 1}, {-1, 1, 1}};
  assert_int_equal(cut(&across, 4, corner, polygon), 0);
}

// A pyramid on a prism, which lies on a tetrahedron: planes between them, and a point without a distance.
static void cut_cells_of_a_region_are_listed(void **state) {
  double x[][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0, 0, -1}, {0, -1, 0.5}};
  int32_t tetrahedron[][4] = {{0, 2, 1, 6}}, pyramid[][5] = {{0, 1, 4, 3, 7}}, prism[][6] = {{0, 1, 2, 3, 4, 5}};
  const CwRegionData cells = {.point_count = 8,
                              .points = x,
                              .tetrahedron_count = 1,
                              .pyramid_count = 1,
                              .prism_count = 1,
                              .tetrahedra = tetrahedron,
                              .pyramids = pyramid,
                              .prisms = prism};
  static const struct {
    double z;
    int without; // a point, or -1
    int count;
    int32_t cell[2];
    double area[2];
  } wanted[] = {{0.25, -1, 2, {1, 2}, {0.375, 0.5}}, {0.25, 7, 1, {2}, {0.5}}, {0.25, 0, 0, {0}, {0}},
                {-0.5, -1, 1, {0}, {0.125}},         {2, -1, 0, {0}, {0}},     {-2, -1, 0, {0}, {0}}};
  for (size_t k = 0; k < sizeof wanted / sizeof *wanted; k++) {
    const CwCutPlane plane = {{0, 0, wanted[k].z}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double distance[8];
    CwRegionCut cut = {0};
    for (int i = 0; i < 8; i++) distance[i] = i == wanted[k].without ? NAN : cw_cut_distance(&plane, x[i]);
    assert_int_equal(cw_cut_region(&plane, &cells, distance, &cut), CW_OK);
    assert_int_equal(cut.count, wanted[k].count);
    for (int i = 0; i < wanted[k].count; i++) {
      assert_int_equal(cut.cells[i].cell, wanted[k].cell[i]);
      assert_near(area_of(cut.cells[i].corners, cut.cells[i].polygon), wanted[k].area[i], 1e-12);
    }
    cw_region_cut_free(&cut);
  }
}

// Area in which the plane s = 0 cuts a tetrahedron, of the distances of its corners, all different: the volume on their
// positive side is V sum s_i^3 / prod (s_i - s_j) over those above 0, a spline (Curry and Schoenberg 1966), and the
// area its rate as the plane moves.
static double spline_area(const double (*x)[3], const double *s, const int corner[4]) {
  double edge[3][3], across[3], sum = 0;
  for (int k = 0; k < 3; k++) cw_sub(x[corner[k + 1]], x[corner[0]], edge[k]);
  cw_cross(edge[0], edge[1], across);
  for (int i = 0; i < 4; i++) {
    double product = 1;
    for (int j = 0; j < 4; j++)
      if (j != i) product *= s[corner[i]] - s[corner[j]];
    if (s[corner[i]] > 0) sum += s[corner[i]] * s[corner[i]] / product;
  }
  return 0.5 * fabs(cw_dot(across, edge[2])) * sum;
}

static CwCutPlane draw_plane(uint64_t *seed) {
  CwCutPlane plane;
  double other[3];
  for (int k = 0; k < 3; k++) {
    plane.origin[k] = draw(seed) - 0.5;
    plane.normal[k] = draw(seed) - 0.5;
    other[k] = draw(seed) - 0.5;
  }
  cw_unit(plane.normal);
  cw_cross(other, plane.normal, plane.u);
  cw_unit(plane.u);
  cw_cross(plane.normal, plane.u, plane.v);
  return plane;
}

// A cell of that many corners, with plane faces: a pyramid on a parallelogram, a prism that grows or shrinks upwards.
static void draw_cell(int count, double x[6][3], uint64_t *seed) {
  const double growth = 0.5 + draw(seed);
  for (int k = 0; k < count; k++)
    for (int i = 0; i < 3; i++) x[k][i] = 2 * draw(seed) - 1;
  for (int i = 0; i < 3 && count == 5; i++) x[2][i] = x[1][i] + x[3][i] - x[0][i];
  for (int k = 4; k < count && count == 6; k++)
    for (int i = 0; i < 3; i++) x[k][i] = x[3][i] + growth * (x[k - 3][i] - x[0][i]);
}

// Of random cells, divided into tetrahedra; the polygon is convex and counter-clockwise.
static void areas_are_those_of_splines(void **state) {
  static const int parts[3] = {1, 2, 3}, part[3][3][4] = {{{0, 1, 2, 3}},
                                                          {{0, 1, 2, 4}, {0, 2, 3, 4}},
                                                          {{0, 1, 2, 3}, {1, 2, 3, 4}, {2, 3, 4, 5}}};
  uint64_t seed = 9;
  int seen[3][CW_CUT_CORNERS + 1] = {{0}};
  for (int round = 0; round < 30000; round++) {
    const int kind = round % 3, count = 4 + kind;
    const CwCutPlane plane = draw_plane(&seed);
    double x[6][3], s[6], polygon[CW_CUT_CORNERS][2], wanted = 0, apart = INFINITY;
    draw_cell(count, x, &seed);
    for (int k = 0; k < count; k++) {
      s[k] = cw_cut_distance(&plane, x[k]);
      for (int j = 0; j < k; j++) apart = fmin(apart, fabs(s[k] - s[j]));
    }
    if (apart < 0.02) continue; // the spline would lose its digits
    for (int p = 0; p < parts[kind]; p++) wanted += spline_area((const double(*)[3])x, s, part[kind][p]);
    const int corners = cut(&plane, count, (const double(*)[3])x, polygon);
    assert_near(corners ? area_of(corners, polygon) : 0, wanted, 1e-9);
    for (int k = 0; k < corners; k++) {
      const double *a = polygon[k], *b = polygon[(k + 1) % corners], *c = polygon[(k + 2) % corners];
      assert_true((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]) > -1e-12);
    }
    seen[kind][corners]++;
  }
  assert_true(seen[0][0] && seen[0][3] && seen[0][4]);
  assert_true(seen[1][0] && seen[1][3] && seen[1][4] && seen[1][5]);
  assert_true(seen[2][0] && seen[2][3] && seen[2][4] && seen[2][5]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cuts_have_the_right_areas),       cmocka_unit_test(a_face_in_the_plane_is_cut_once),
      cmocka_unit_test(corners_in_the_plane_stand_once), cmocka_unit_test(cut_cells_of_a_region_are_listed),
      cmocka_unit_test(areas_are_those_of_splines),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
