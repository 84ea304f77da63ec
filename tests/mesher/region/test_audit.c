// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "mesher/region/audit.h"
#include "mesher/policy.h"
#include "pipeline/mesh/cell.h"
#include "tests/unit_test.h"

// A right prism on the corner triangle of a square, height 1, with a tetrahedron on its top.
static double x[8][3];
static int32_t tet[3][4], prism[1][6], triangle[8][3], triangle_patch[8], triangle_cell[8], quad[4][4], quad_patch[4],
    quad_cell[4];

static CwRegionMesh prism_and_tet(void) {
  static const double points[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                      {1, 0, 1}, {0, 1, 1}, {0, 0, 2}, {5, 5, 5}};
  static const int32_t triangles[4][3] = {{0, 2, 1}, {3, 4, 6}, {4, 5, 6}, {5, 3, 6}};
  static const int32_t cells[4] = {1, 0, 0, 0};
  static const int32_t quads[3][4] = {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
  memcpy(x, points, sizeof points);
  memcpy(tet[0], (int32_t[4]){3, 4, 5, 6}, sizeof tet[0]);
  memcpy(prism[0], (int32_t[6]){0, 1, 2, 3, 4, 5}, sizeof prism[0]);
  memcpy(triangle, triangles, sizeof triangles);
  memcpy(triangle_cell, cells, sizeof cells);
  memcpy(quad, quads, sizeof quads);
  for (int k = 0; k < 3; k++) quad_cell[k] = 1;
  CwRegionMesh r = {.domain = "rotor", .region = 3, .number = 1};
  r.cells.point_count = 7, r.cells.points = x;
  r.cells.tetrahedron_count = 1, r.cells.tetrahedra = tet;
  r.cells.prism_count = 1, r.cells.prisms = prism;
  r.cells.triangle_count = 4, r.cells.triangles = triangle, r.cells.triangle_patch = triangle_patch,
  r.cells.triangle_cell = triangle_cell;
  r.cells.quad_count = 3, r.cells.quads = quad, r.cells.quad_patch = quad_patch, r.cells.quad_cell = quad_cell;
  return r;
}

static CwOutcome outcome;

static void audit(const CwRegionMesh *r, CwQuality *q) {
  memset(&outcome, 0, sizeof outcome);
  assert_int_equal(cw_audit_region(r, q, &outcome), CW_OK);
}

static void passes(const CwRegionMesh *r, CwQuality *q) {
  audit(r, q);
  assert_int_equal(outcome.kind, CW_OUTCOME_DONE);
}

// The cell that the reason tells of has no positive volume, and lies at that place (NULL: anywhere).
static void is_thin_with(const CwRegionMesh *r, const double place[3], const char *part) {
  CwQuality q;
  audit(r, &q);
  assert_int_equal(outcome.kind, CW_OUTCOME_THIN);
  for (int k = 0; k < 3 && place; k++) assert_near(outcome.place[0][k], place[k], 1e-15);
  assert_non_null(strstr(outcome.reason, "rotor region 3"));
  assert_non_null(strstr(outcome.reason, "no positive volume"));
  if (!strstr(outcome.reason, part)) fail_msg("\"%s\" lacks \"%s\"", outcome.reason, part);
}

static void fails_with(const CwRegionMesh *r, const char *part) {
  CwQuality q;
  cw_fail_clear();
  memset(&outcome, 0, sizeof outcome);
  assert_int_equal(cw_audit_region(r, &q, &outcome), CW_ERR_FAULT);
  assert_non_null(strstr(cw_fail_message(), "rotor region 3"));
  if (!strstr(cw_fail_message(), part)) fail_msg("\"%s\" lacks \"%s\"", cw_fail_message(), part);
}

static void good_region_passes_with_its_figures(void **state) {
  CwRegionMesh r = prism_and_tet();
  CwQuality q;
  passes(&r, &q);
  assert_near(q.volume, 0.5 + 1.0 / 6.0, 1e-15);
  assert_near(q.least_volume, 1.0 / 6.0, 1e-15);
  assert_int_equal(q.cells, 2);
  assert_near(q.aspect_mean, sqrt(2.0), 1e-15);
  assert_int_equal(q.aspect_class[0], 1);
  assert_near(q.dihedral_least, 54.735610317245, 1e-9);
  assert_int_equal(q.dihedral_bin[5], 1);
  assert_int_equal(q.prism_count, 1);
  assert_near(q.prism_least_scaled_jacobian, sqrt(0.5) * 2.0 / sqrt(3.0), 1e-14); // corners of 45 degrees
  assert_int_equal(q.prism_jacobian_bin[16], 1);
}

static void single_tetrahedron(void **state) {
  CwRegionMesh r = prism_and_tet();
  static const int32_t corner[4] = {0, 1, 2, 3}, faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  memcpy(tet[0], corner, sizeof corner);
  memcpy(triangle, faces, sizeof faces);
  memset(triangle_cell, 0, sizeof triangle_cell);
  r.cells.point_count = 4, r.cells.prism_count = 0, r.cells.quad_count = 0;
  CwQuality q;
  passes(&r, &q);
  assert_near(q.volume, 1.0 / 6.0, 1e-16);
  assert_int_equal(q.prism_count, 0);
  assert_int_equal(q.flat_count, 1);
  for (int k = 0; k < 3; k++) assert_near(q.flat[0].x[k], 0.25, 1e-15);
  assert_near(q.flattest, 0, 0); // by its determinant: all its faces lie on patches
}

static void inverted_cells_are_named_with_their_place(void **state) {
  CwRegionMesh r = prism_and_tet();
  tet[0][0] = 4, tet[0][1] = 3;
  is_thin_with(&r, (const double[3]){0.25, 0.25, 1.25}, "tetrahedron of cell 0");
  r = prism_and_tet();
  memcpy(prism[0], (int32_t[6]){3, 4, 5, 0, 1, 2}, sizeof prism[0]);
  is_thin_with(&r, (const double[3]){1.0 / 3, 1.0 / 3, 0.5}, "prism of cell 1");
  r = prism_and_tet();
  x[6][2] = 1.0; // flat
  is_thin_with(&r, NULL, "tetrahedron of cell 0");
  r = prism_and_tet();
  x[6][2] = NAN;
  is_thin_with(&r, NULL, "tetrahedron of cell 0");
}

// Two cells fit on both sides of a triangle; a third and a fourth do not, whichever two of them would make a pair.
static void cells_above_and_below_one_face(void **state) {
  double points[7][3] = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}, {0, 0, -3}, {0, 0, 6}, {0, 0, -6}};
  int32_t cells[4][4] = {{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 1, 2, 5}, {0, 2, 1, 6}};
  int64_t shared_id[7] = {0, 1, 2, 3, 4, 5, 6};
  static const char *const fault[5] = {NULL, NULL, NULL,
                                       "triangle of cell 2 at (1000, 1000, 0) mm belongs to more than two cells",
                                       "triangle of cell 2 at (1000, 1000, 0) mm belongs to more than two cells"};
  for (int count = 1; count <= 4; count++) {
    CwRegionMesh r = {.domain = "rotor",
                      .region = 3,
                      .cells.points = points,
                      .cells.tetrahedra = cells,
                      .cells.shared_id = shared_id};
    CwQuality q;
    r.cells.tetrahedron_count = count;
    r.cells.point_count = r.cells.shared_count = 3 + count;
    if (fault[count])
      fails_with(&r, fault[count]);
    else
      passes(&r, &q);
    if (!fault[count]) assert_near(q.flattest, q.dihedral_least, 0);
  }
}

// What the determinant of a tetrahedron with no face on a patch counts as: 12 degrees where checkMesh begins to name
// it, with the fourth root, as the determinant of a flat one goes with the fourth power of its angle.
static double angle_of_determinant(const double (*points)[3], const int32_t *cell) {
  const double *corner[4] = {points[cell[0]], points[cell[1]], points[cell[2]], points[cell[3]]};
  return 12 * pow(cw_cell_determinant(4, corner, 0xf) / CW_SMALL_DETERMINANT, 0.25);
}

// A needle of the given height on a face of a tetrahedron that is 0.8 high: the face parts them as 0.8 to its height.
static void a_tetrahedron_far_larger_than_the_next_counts_as_flat(void **state) {
  int32_t cells[2][4] = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  int64_t shared_id[5] = {0, 1, 2, 3, 4};
  for (int low = 0; low < 2; low++) {
    double height = low ? 15.1 : 15.3, middle = sqrt(1.0 / 12);
    double points[5][3] = {{0, 0, 0}, {1, 0, 0}, {0.5, sqrt(0.75), 0}, {0.5, middle, height}, {0.5, middle, -0.8}};
    CwRegionMesh r = {.domain = "rotor",
                      .cells = {.points = points,
                                .tetrahedra = cells,
                                .shared_id = shared_id,
                                .point_count = 5,
                                .shared_count = 5,
                                .tetrahedron_count = 2}};
    CwQuality q;
    passes(&r, &q);
    assert_int_equal(q.flat_count, !low);
    if (low) { // steep, but so long that its determinant is worth less
      assert_true(q.dihedral_least > 20);
      assert_near(q.flattest, angle_of_determinant((const double(*)[3])points, cells[0]), 1e-9);
      assert_true(q.flattest > cw_policy.flat_angle);
    } else {
      assert_near(q.flattest, cw_policy.flat_angle * 0.8 / 16.1 / 0.05, 1e-5);
      for (int k = 0; k < 3; k++) assert_near(q.flat[0].x[k], k == 0 ? 0.5 : k == 1 ? middle : height / 4, 1e-14);
    }
  }
}

// The figures of a tetrahedron with no face on a patch.
static CwQuality quality_of_one(const double (*corner)[3]) {
  double points[4][3];
  int32_t cells[1][4] = {{0, 1, 2, 3}};
  int64_t shared_id[4] = {0, 1, 2, 3};
  memcpy(points, corner, sizeof points);
  CwRegionMesh r = {.domain = "rotor",
                    .region = 3,
                    .cells = {.points = points,
                              .tetrahedra = cells,
                              .shared_id = shared_id,
                              .point_count = 4,
                              .shared_count = 4,
                              .tetrahedron_count = 1}};
  CwQuality q;
  passes(&r, &q);
  return q;
}

// A tetrahedron with its apex straight over a corner of an equilateral triangle: its slope rises at the angle from the
// opposite edge. Flat and nearly flat ones are listed: below 16 degrees, halfway from 12 to 20.
static void nearly_flat_tetrahedra_are_listed(void **state) {
  assert_near(cw_nearly_flat_angle(), 16, 1e-12);
  for (int angle = 11; angle <= 19; angle += 2) {
    double far = sqrt(0.75), up = far * tan(angle * M_PI / 180);
    const double points[4][3] = {{0, 0, 0}, {1, 0, 0}, {0.5, far, 0}, {0.5, far, up}};
    const CwQuality q = quality_of_one(points);
    assert_near(q.flattest, angle, 1e-9);
    assert_int_equal(q.flat_count, angle < 16);
    if (angle < 16) assert_near(q.flat[0].flatness, angle, 1e-9);
  }
}

// A spindle of four points about a line, the outer two so many times farther apart than the inner two: its angles stay
// steep while its determinant falls with the square of its length (checkMesh names those below 0.001).
static void spindles_count_by_their_determinant(void **state) {
  for (int length = 3; length <= 30; length *= 10) {
    const double points[4][3] = {{0, 0, 0}, {0.5, 0.5, length / 2.0}, {-0.5, 0.5, length / 2.0}, {0, 0, length}};
    const CwQuality q = quality_of_one(points);
    assert_true(q.dihedral_least > 20);
    assert_int_equal(q.flat_count, length == 30);
    const double worth = angle_of_determinant(points, (const int32_t[4]){0, 1, 2, 3});
    assert_int_equal(worth < 12, length == 30);
    assert_near(q.flattest, fmin(q.dihedral_least, worth), 1e-9);
  }
}

static void two_cells_on_one_side(void **state) {
  CwRegionMesh r = prism_and_tet();
  memcpy(tet[1], (int32_t[4]){3, 4, 5, 7}, sizeof tet[1]);
  r.cells.tetrahedron_count = 2, r.cells.prism_count = 0, r.cells.triangle_count = 0, r.cells.quad_count = 0,
  r.cells.point_count = 5;
  // Points 3..7 alone, renumbered 0..4.
  memmove(x, x + 3, 5 * sizeof x[0]);
  for (int k = 0; k < 2; k++) {
    for (int i = 0; i < 4; i++) tet[k][i] -= 3;
  }
  fails_with(&r, "has both of its cells on one side");
}

static void open_face_is_allowed_only_on_partition_planes(void **state) {
  CwRegionMesh r = prism_and_tet();
  CwQuality q;
  r.cells.quad_count = 2; // quad 2, 0, 3, 5 is no longer listed
  fails_with(&r, "is open");
  r.cells.shared_count = 5;
  fails_with(&r, "quadrilateral of cell 1 at (0, 500, 500) mm is open");
  int64_t shared_id[7] = {10, 11, 12, 13, 14, 15, 16};
  r.cells.shared_count = 6;
  r.cells.shared_id = shared_id;
  passes(&r, &q);
  // The sum tells of the open face's numbers and coordinates, and of nothing else.
  uint64_t sum = q.open_faces;
  assert_true(sum != 0);
  shared_id[1] = 17;
  passes(&r, &q);
  assert_true(q.open_faces == sum);
  shared_id[0] = 18;
  passes(&r, &q);
  assert_true(q.open_faces != sum);
  shared_id[0] = 10;
  double x = r.cells.points[5][2];
  r.cells.points[5][2] = nextafter(x, 2 * x);
  passes(&r, &q);
  assert_true(q.open_faces != sum);
  r.cells.points[5][2] = x;
  passes(&r, &q);
  assert_true(q.open_faces == sum);
}

// The same mesh with the corners of its cells and faces named from another one on.
static void corners_may_be_turned(void **state) {
  for (int way = 0; way < 12 * 3 * 4; way++) {
    CwRegionMesh r = prism_and_tet();
    CwQuality q;
    // Even permutations of four: one of four corners first, the other three turned.
    static const int even[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}};
    int turn = way % 3, first = way / 3 % 4, prism_turn = way / 12 % 3, face_turn = way / 36;
    static const int32_t corner[4] = {3, 4, 5, 6};
    tet[0][0] = corner[even[first][0]];
    for (int k = 0; k < 3; k++) {
      tet[0][1 + k] = corner[even[first][1 + (k + turn) % 3]];
      prism[0][k] = (k + prism_turn) % 3;
      prism[0][3 + k] = 3 + (k + prism_turn) % 3;
    }
    for (int f = 0; f < r.cells.triangle_count; f++) {
      int32_t was[3];
      memcpy(was, triangle[f], sizeof was);
      for (int k = 0; k < 3; k++) triangle[f][k] = was[(k + face_turn) % 3];
    }
    for (int f = 0; f < r.cells.quad_count; f++) {
      int32_t was[4];
      memcpy(was, quad[f], sizeof was);
      for (int k = 0; k < 4; k++) quad[f][k] = was[(k + face_turn) % 4];
    }
    passes(&r, &q);
    assert_near(q.volume, 0.5 + 1.0 / 6.0, 1e-15);
  }
}

// A ring of tetrahedra about one edge: every one of its faces but one for each has that edge's first point.
static void many_faces_at_one_point(void **state) {
  enum { RING = 200 };
  static double points[RING + 2][3];
  static int32_t cells[RING][4], faces[2 * RING][3], patches[2 * RING], of_cell[2 * RING];
  points[0][2] = -1.0;
  points[1][2] = 1.0;
  for (int k = 0; k < RING; k++) {
    double angle = 2.0 * 3.14159265358979323846 * k / RING;
    int32_t a = 2 + k, b = 2 + (k + 1) % RING;
    points[a][0] = cos(angle), points[a][1] = sin(angle);
    memcpy(cells[k], (int32_t[4]){0, a, b, 1}, sizeof cells[k]);
    memcpy(faces[2 * k], (int32_t[3]){0, b, a}, sizeof faces[0]);
    memcpy(faces[2 * k + 1], (int32_t[3]){a, b, 1}, sizeof faces[0]);
    of_cell[2 * k] = of_cell[2 * k + 1] = k;
  }
  CwRegionMesh r = {.domain = "rotor", .region = 3, .cells.point_count = RING + 2, .cells.points = points};
  r.cells.tetrahedron_count = RING, r.cells.tetrahedra = cells;
  r.cells.triangle_count = 2 * RING, r.cells.triangles = faces, r.cells.triangle_patch = patches,
  r.cells.triangle_cell = of_cell;
  CwQuality q;
  passes(&r, &q);
  for (int k = 0; k < 2 * RING; k++) {
    const int last = 2 * RING - 1;
    char fault[60];
    int32_t kept[3];
    snprintf(fault, sizeof fault, "triangle of cell %d at ", k / 2);
    of_cell[k] = (k / 2 + 1) % RING;
    fails_with(&r, fault);
    assert_non_null(strstr(cw_fail_message(), "with the wrong cell"));
    memcpy(kept, faces[k], sizeof kept);
    memcpy(faces[k], faces[last], sizeof kept);
    of_cell[k] = of_cell[last];
    r.cells.triangle_count = last; // all but this one
    fails_with(&r, fault);
    assert_non_null(strstr(cw_fail_message(), "is open"));
    memcpy(faces[k], kept, sizeof kept);
    of_cell[k] = k / 2;
    r.cells.triangle_count = 2 * RING;
  }
  passes(&r, &q);
  r.cells.tetrahedron_count = RING - 1; // its faces are listed, and two of its neighbours' are open
  fails_with(&r, "is listed as boundary but is no face of a cell");
}

// A copy has the sum of a whole audit, from the faces on partition planes alone, and its cells are looked at.
static void copies_are_audited_by_what_is_their_own(void **state) {
  CwRegionMesh r = prism_and_tet();
  CwQuality q;
  uint64_t sum = 0;
  int64_t shared_id[6] = {10, 11, 12, 13, 14, 15};
  r.cells.quad_count = 2, r.cells.shared_count = 6, r.cells.shared_id = shared_id; // quad 2, 0, 3, 5 lies on a plane
  passes(&r, &q);
  assert_int_equal(cw_audit_copy(&r, &sum, &outcome), CW_OK);
  assert_int_equal(outcome.kind, CW_OUTCOME_DONE);
  assert_true(sum != 0 && sum == q.open_faces);
  x[6][2] = 1.0;
  assert_int_equal(cw_audit_copy(&r, &sum, &outcome), CW_OK);
  assert_int_equal(outcome.kind, CW_OUTCOME_THIN);
  assert_non_null(strstr(outcome.reason, "tetrahedron of cell 0"));
  assert_non_null(strstr(outcome.reason, "no positive volume"));
}

static void wrong_lists_are_found(void **state) {
  CwRegionMesh r = prism_and_tet();
  memcpy(triangle[4], triangle[1], sizeof triangle[1]);
  triangle_cell[4] = triangle_cell[1];
  r.cells.triangle_count = 5;
  fails_with(&r, "more than once");
  r = prism_and_tet();
  memcpy(triangle[4], (int32_t[3]){3, 5, 4}, sizeof triangle[4]); // of the tetrahedron and the prism
  triangle_cell[4] = 0;
  r.cells.triangle_count = 5;
  fails_with(&r, "belongs to more than two cells or boundary faces");
  r = prism_and_tet();
  memcpy(triangle[0], (int32_t[3]){0, 1, 2}, sizeof triangle[0]);
  fails_with(&r, "with its normal into the domain");
  r = prism_and_tet();
  triangle_cell[0] = 0;
  fails_with(&r, "wrong cell");
  r = prism_and_tet();
  memcpy(triangle[4], (int32_t[3]){0, 1, 6}, sizeof triangle[4]);
  r.cells.triangle_count = 5;
  fails_with(&r, "no face of a cell");
  r = prism_and_tet();
  memcpy(quad[0], (int32_t[4]){0, 4, 1, 3}, sizeof quad[0]); // corners in a wrong order
  fails_with(&r, "boundary");
}

static void points_and_indices_are_checked(void **state) {
  CwRegionMesh r = prism_and_tet();
  r.cells.point_count = 8;
  fails_with(&r, "point 7 at (5000, 5000, 5000) mm belongs to no cell");
  r = prism_and_tet();
  tet[0][3] = 7;
  fails_with(&r, "names point 7; 0 to 6 are allowed");
}

static void sums_of_two_regions(void **state) {
  CwRegionMesh r = prism_and_tet();
  CwQuality q, sum;
  passes(&r, &q);
  cw_quality_start(&sum);
  cw_quality_add(&sum, &q);
  sum.flattest = 13.0; // that of the first lies on patches all over
  q.aspect_mean = 3.0, q.aspect_max = 4.0, q.dihedral_least = 12.0, q.flattest = 11.0;
  q.flat[0] = (CwFlatPlace){{0, 3, 0}, 11};
  q.flat_count = 1;
  q.aspect_class[0] = 0, q.aspect_class[2] = 3;
  q.beside = (CwTetFigures){5, 9.0, 3.0, 2.5, 0.25, 20.0};
  q.apart = (CwTetFigures){7, 8.0, 2.0, 4.5, 0.5, 30.0};
  const CwTetFigures beside = sum.beside, apart = sum.apart;
  cw_quality_add(&sum, &q);
  assert_near(sum.aspect_mean, (sqrt(2.0) + 9.0) / 4.0, 1e-14);
  assert_near(sum.aspect_max, 4.0, 0.0);
  assert_near(sum.dihedral_least, 12.0, 0.0);
  assert_near(sum.flattest, 11.0, 0.0);
  assert_int_equal(sum.flat_count, 2);
  assert_near(sum.flat[0].flatness, 0, 0);
  assert_near(sum.flat[1].x[1], 3, 0);
  assert_near(sum.volume, 2.0 * (0.5 + 1.0 / 6.0), 1e-15);
  assert_int_equal(sum.cells, 4);
  assert_int_equal(sum.beside.count, beside.count + 5);
  assert_int_equal(sum.apart.count, apart.count + 7);
  assert_near(sum.apart.aspect_sum, apart.aspect_sum + 8.0, 1e-14);
  assert_near(sum.apart.mean_ratio_sum, apart.mean_ratio_sum + 4.5, 1e-14);
  assert_near(sum.apart.mean_ratio_least, 0.5, 0.0);
  assert_near(sum.apart.dihedral_least, 30.0, 0.0);
  assert_int_equal(sum.aspect_class[2], 3);
  assert_int_equal(sum.prism_count, 2);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(good_region_passes_with_its_figures),
      cmocka_unit_test(single_tetrahedron),
      cmocka_unit_test(inverted_cells_are_named_with_their_place),
      cmocka_unit_test(cells_above_and_below_one_face),
      cmocka_unit_test(a_tetrahedron_far_larger_than_the_next_counts_as_flat),
      cmocka_unit_test(nearly_flat_tetrahedra_are_listed),
      cmocka_unit_test(spindles_count_by_their_determinant),
      cmocka_unit_test(two_cells_on_one_side),
      cmocka_unit_test(open_face_is_allowed_only_on_partition_planes),
      cmocka_unit_test(corners_may_be_turned),
      cmocka_unit_test(many_faces_at_one_point),
      cmocka_unit_test(copies_are_audited_by_what_is_their_own),
      cmocka_unit_test(wrong_lists_are_found),
      cmocka_unit_test(points_and_indices_are_checked),
      cmocka_unit_test(sums_of_two_regions),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
