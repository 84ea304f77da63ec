// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/face_quality.h"

#include <math.h>
#include <string.h>

#include "tests/unit_test.h"

// A tetrahedron on the triangle 0-1-2 with its tip at `tip`, and a right prism below.
static void two_cells(const double tip[3], double height, CwFaceQuality *o) {
  double points[7][3] = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 0}, {0, 0, -height}, {3, 0, -height}, {0, 3, -height}};
  int32_t tetrahedra[][4] = {{0, 1, 2, 3}}, prisms[][6] = {{4, 5, 6, 0, 1, 2}};
  memcpy(points[3], tip, sizeof points[3]);
  CwRegionData data = {.points = points,
                       .point_count = 7,
                       .shared_count = 7,
                       .tetrahedra = tetrahedra,
                       .tetrahedron_count = 1,
                       .prisms = prisms,
                       .prism_count = 1};
  CwRegionFaces faces = {0};
  assert_int_equal(cw_region_faces("rotor", CW_ERR_INPUT, &data, &faces), CW_OK);
  cw_face_quality_start(o);
  CwMiddle middle[2];
  for (int cell = 0; cell < 2; ++cell) middle[cell] = cw_cell_middle(&data, cell);
  CwFlatPrisms flat = {0};
  assert_int_equal(cw_face_quality_region(&data, &faces, middle, o, &flat), CW_OK);
  o->slender = cw_flat_prisms_slender(&flat, &data);
  cw_flat_prisms_free(&flat);
  cw_region_faces_free(&faces);
  assert_int_equal(o->count, 1);
}

static void the_angle_is_that_of_the_centroids(void **state) {
  CwFaceQuality straight, leaning;
  // The prism's centroid is (1, 1, -1), the tetrahedron's a quarter of the way from (1, 1, 0) to the tip.
  two_cells((double[3]){1, 1, 4}, 2, &straight);
  assert_near(cw_non_orthogonality_greatest(&straight), 0, 1e-6);
  two_cells((double[3]){9, 1, 4}, 2, &leaning);
  assert_near(cw_non_orthogonality_greatest(&leaning), 45, 1e-9);
  cw_face_quality_add(&straight, &leaning);
  assert_int_equal(leaning.count, 2);
  assert_near(cw_non_orthogonality_greatest(&leaning), 45, 1e-9);
  assert_near(cw_non_orthogonality_mean(&leaning), acos((1 + sqrt(0.5)) / 2) * 180 / M_PI, 1e-9);
}

// A triangle in the plane z = 0 with its centre at (off, 0, 0), that reaches over 0.1 m towards x.
static CwFaceQuality face_at(double off, const double from[3], const double *to, CwFaceKind kind) {
  const double node[3][3] = {{off + 0.1, 0, 0}, {off - 0.05, 0.05, 0}, {off - 0.05, -0.05, 0}};
  CwFaceQuality q;
  cw_face_quality_start(&q);
  const double *const x[4] = {node[0], node[1], node[2], node[0]};
  if (to)
    cw_face_quality_face(3, x, &(CwMiddle){{from[0], from[1], from[2]}, 1}, &(CwMiddle){{to[0], to[1], to[2]}, 1}, kind,
                         &q);
  else
    cw_face_quality_patch(3, x, from, kind, &q);
  return q;
}

// The line from cell to cell meets the plane at the origin: the skewness is off over the greatest of 0.1 m and a fifth
// of the line.
static void skewness_by_hand(void **state) {
  const double low[2][3] = {{0, 0, -0.1}, {0, 0, -1}}, high[2][3] = {{0, 0, 0.1}, {0, 0, 1}}, extent[2] = {0.1, 0.4};
  for (int i = 0; i < 2; ++i) {
    for (int kind = 0; kind < CW_FACE_KINDS; ++kind) {
      assert_int_equal(face_at(4.01 * extent[i], low[i], high[i], kind).skew[kind], 1);
      assert_int_equal(face_at(4.01 * extent[i], low[i], high[i], kind).skew[!kind], 0);
      assert_int_equal(face_at(3.99 * extent[i], low[i], high[i], kind).skew[kind], 0);
    }
  }
  // On a patch the line is the normal through the centroid, and two fifths of it count.
  assert_int_equal(face_at(4.01 * 0.4, low[1], NULL, CW_FACE_OTHER).skew[CW_FACE_OTHER], 1);
  assert_int_equal(face_at(3.99 * 0.4, low[1], NULL, CW_FACE_OTHER).skew[CW_FACE_OTHER], 0);
  assert_int_equal(face_at(3, low[1], NULL, CW_FACE_OTHER).count, 0);
}

static void weights_by_hand(void **state) {
  for (int i = 0; i < 4; ++i) {
    const double below = i < 2 ? 0.049 : 0.051, low[3] = {0, 0, i % 2 ? below - 1 : -below},
                 high[3] = {0, 0, i % 2 ? below : 1 - below};
    CwFaceQuality q = face_at(0, low, high, CW_FACE_OF_PRISM);
    assert_int_equal(q.light[CW_FACE_OF_PRISM], i < 2);
    assert_int_equal(q.light[CW_FACE_OTHER], 0);
    cw_face_quality_add(&q, &q);
    assert_int_equal(q.light[CW_FACE_OF_PRISM], i < 2 ? 2 : 0);
  }
}

// The prism has a volume of 9 m3, the tetrahedron of half its height.
static void volumes_by_hand(void **state) {
  for (int i = 0; i < 2; ++i) {
    CwFaceQuality q;
    two_cells((double[3]){1, 1, i ? 0.0599 : 0.0601}, 2, &q);
    assert_int_equal(q.uneven[CW_FACE_OF_PRISM], i);
    assert_int_equal(q.uneven[CW_FACE_OTHER], 0);
    assert_int_equal(q.slender, 0);
    cw_face_quality_add(&q, &q);
    assert_int_equal(q.uneven[CW_FACE_OF_PRISM], 2 * i);
  }
}

// With legs of 3 m the area vectors of the prism sum to 9 m2 upwards and 6 h to either side.
static void aspects_by_hand(void **state) {
  for (int i = 0; i < 2; ++i) {
    CwFaceQuality q;
    two_cells((double[3]){1, 1, 1.5e-3}, 1.5e-3 * (i ? 0.999 : 1.001), &q);
    assert_int_equal(q.slender, i);
    for (int kind = 0; kind < CW_FACE_KINDS; ++kind) assert_int_equal(q.open[kind], 1);
    cw_face_quality_add(&q, &q);
    assert_int_equal(q.slender, 2 * i);
    for (int kind = 0; kind < CW_FACE_KINDS; ++kind) assert_int_equal(q.open[kind], 2);
    two_cells((double[3]){1, 1, 4}, 2, &q);
    assert_int_equal(q.slender, 0);
    for (int kind = 0; kind < CW_FACE_KINDS; ++kind) assert_int_equal(q.open[kind], 0);
  }
}

// Legs of 3 m along x and y give 6 h to either side, 9 m2 over which is not above 1000; turned by 45 degrees they give
// 3 sqrt(2) h to one side, and it is.
static void an_aspect_depends_on_the_axes(void **state) {
  const double h = 1.8e-3, c = sqrt(0.5);
  double points[2][6][3] = {{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, h}, {3, 0, h}, {0, 3, h}}};
  int32_t prisms[][6] = {{0, 1, 2, 3, 4, 5}};
  for (int p = 0; p < 6; ++p) {
    const double *x = points[0][p];
    memcpy(points[1][p], (double[3]){c * (x[0] - x[1]), c * (x[0] + x[1]), x[2]}, sizeof points[1][p]);
  }
  CwRegionData data = {.points = points[0], .point_count = 6, .prisms = prisms, .prism_count = 1};
  CwRegionData turned = data;
  turned.points = points[1];
  CwRegionFaces faces = {0};
  CwFaceQuality q;
  CwFlatPrisms flat = {0};
  const CwMiddle middle = cw_cell_middle(&data, 0);
  cw_face_quality_start(&q);
  data.shared_count = 6;
  assert_int_equal(cw_region_faces("rotor", CW_ERR_INPUT, &data, &faces), CW_OK);
  assert_int_equal(cw_face_quality_region(&data, &faces, &middle, &q, &flat), CW_OK);
  assert_int_equal(flat.count, 1);
  assert_int_equal(cw_flat_prisms_slender(&flat, &data), 0);
  assert_int_equal(cw_flat_prisms_slender(&flat, &turned), 1);
  cw_flat_prisms_free(&flat);
  cw_region_faces_free(&faces);
}

// A square of 2 with corners h above and below its plane in turn. From a centroid `below` under it the triangles at the
// upper corners are seen from their right side while h < below, from one `above` it those at the lower corners while
// h < above; all others always are.
static int64_t twisted_faces(double h, double below, double above) {
  const double corner[4][3] = {{1, 1, h}, {-1, 1, -h}, {-1, -1, h}, {1, -1, -h}};
  const double *const x[4] = {corner[0], corner[1], corner[2], corner[3]};
  const CwMiddle from = {{0, 0, -below}, 1}, to = {{0, 0, above}, 1};
  CwFaceQuality q;
  cw_face_quality_start(&q);
  if (above > 0) cw_face_quality_face(4, x, &from, &to, CW_FACE_OF_PRISM, &q);
  if (above == 0) cw_face_quality_patch(4, x, from.at, CW_FACE_OF_PRISM, &q);
  return q.twisted;
}

static void twists_by_hand(void **state) {
  assert_int_equal(twisted_faces(0, 1, 1), 0);
  assert_int_equal(twisted_faces(0.99, 1, 1), 0);
  assert_int_equal(twisted_faces(1.01, 1, 1), 1);
  assert_int_equal(twisted_faces(1.5, 2, 1), 0); // the diagonal of the lower corners is left
  assert_int_equal(twisted_faces(1.5, 1, 2), 0);
  assert_int_equal(twisted_faces(2.1, 2, 1), 1);
  assert_int_equal(twisted_faces(5, 1, 0), 0); // on a patch one of the two always is
}

static void no_face_is_at_no_angle(void **state) {
  CwFaceQuality o;
  cw_face_quality_start(&o);
  assert_near(cw_non_orthogonality_greatest(&o), 0, 0);
  assert_near(cw_non_orthogonality_mean(&o), 0, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_angle_is_that_of_the_centroids),
      cmocka_unit_test(skewness_by_hand),
      cmocka_unit_test(weights_by_hand),
      cmocka_unit_test(volumes_by_hand),
      cmocka_unit_test(aspects_by_hand),
      cmocka_unit_test(an_aspect_depends_on_the_axes),
      cmocka_unit_test(twists_by_hand),
      cmocka_unit_test(no_face_is_at_no_angle),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
