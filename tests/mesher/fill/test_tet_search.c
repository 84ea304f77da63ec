// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/quality.h"
#include "mesher/common/tet.h"
#include "mesher/common/vec.h"
#include "mesher/fill/tet_judge.h"
#include "mesher/fill/tet_loop.h"
#include "mesher/fill/tet_patch.h"
#include "mesher/fill/tet_search.h"
#include "mesher/policy.h"
#include "shaken_lattice.h"
#include "tests/unit_test.h"

enum { SIZE = 6000 };

// Least dihedral angle, degrees, and the volume; all are positive.
static double least_angle(const CwTetMesh *mesh, double *volume) {
  double least = 180.0;
  *volume = 0.0;
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    const double *x[4];
    CwTetShape shape;
    if (mesh->tet[t].corner[0] < 0) continue;
    for (int i = 0; i < 4; i++) x[i] = mesh->point[mesh->tet[t].corner[i]].x;
    cw_tet_shape(x, &shape);
    assert_true(shape.volume > 0.0);
    *volume += shape.volume;
    least = fmin(least, shape.dihedral_least);
  }
  return least;
}

static void judge_all(CwTetWork *w) {
  CwTetShapes shapes = {0};
  w->next.count = 0;
  assert_int_equal(cw_tet_judge_all(w, &shapes), CW_OK);
  cw_tet_shapes_free(&shapes);
}

// `spoilt` points go nearly as far as a face opposite.
static void spoil(CwTetMesh *mesh, int spoilt) {
  int32_t apart = spoilt > 0 ? 4500 / spoilt : 0;
  for (int32_t t = 40; spoilt > 0; t += apart, spoilt--) {
    while (mesh->tet[t].corner[0] < 0 || mesh->source[mesh->tet[t].corner[0]] == 0) t++;
    const int32_t *c = mesh->tet[t].corner;
    double *p = mesh->point[c[0]].x;
    for (int i = 0; i < 3; i++) {
      double opposite = (mesh->point[c[1]].x[i] + mesh->point[c[2]].x[i] + mesh->point[c[3]].x[i]) / 3.0;
      p[i] += 0.9 * (opposite - p[i]);
    }
  }
}

// A lump out of a shaken lattice, its hull fixed, with points that are spoilt.
static CwTetWork lump(int spoilt, CwTetPatch *patch) {
  double(*x)[3];
  CwTetMesh whole;
  int32_t outside, middle = -1;
  shaken_lattice(14, 0.1, &outside, &x, &whole);
  for (int32_t t = 0; t < whole.tet_count && middle < 0; t++) {
    const double *p = whole.tet[t].corner[0] < 0 ? NULL : whole.point[whole.tet[t].corner[0]].x;
    if (p && fmax(fabs(p[0] - 7.0), fmax(fabs(p[1] - 7.0), fabs(p[2] - 7.0))) < 0.7) middle = t;
  }
  assert_int_equal(cw_tet_patch_take(&whole, middle, SIZE, outside, patch), CW_OK);
  cw_tet_mesh_free(&whole);
  free(x);
  CwTetMesh *mesh = &patch->mesh;
  CwTetWork w = {.mesh = mesh,
                 .limit = cw_policy.improve_below,
                 .insert = 0.4226,
                 .insert_round = 0.38,
                 .fixed_count = 1,
                 .source_count = 2};
  judge_all(&w);
  assert_int_equal(cw_tet_improve_list(&w, 5, 1), CW_OK);
  spoil(mesh, spoilt);
  judge_all(&w);
  return w;
}

static void finish(CwTetWork *w, CwTetPatch *patch) {
  cw_tet_work_free(w);
  cw_tet_patch_free(patch);
}

// Flat tetrahedra.
static int32_t bad_ones(const CwTetWork *w) {
  int32_t bad = 0;
  for (int32_t t = 0; t < w->mesh->tet_count; t++) {
    const double *x[4];
    CwTetShape shape;
    if (w->mesh->tet[t].corner[0] < 0) continue;
    for (int i = 0; i < 4; i++) x[i] = w->mesh->point[w->mesh->tet[t].corner[i]].x;
    cw_tet_shape(x, &shape);
    bad += shape.dihedral_least < cw_policy.flat_angle;
  }
  return bad;
}

// What is bad becomes good, twice the same way; hull and volume stay.
static void bad_ones_become_good(void **state) {
  CwTetPatch patch, again;
  CwTetWork w = lump(3, &patch), v = lump(3, &again);
  double volume, after, hull[SIZE][3];
  assert_true(least_angle(w.mesh, &volume) < 8.0);
  for (int32_t p = 0; p < patch.point_count; p++) memcpy(hull[p], w.mesh->point[p].x, sizeof hull[p]);
  assert_int_equal(cw_tet_search(&w), CW_OK);
  assert_int_equal(cw_tet_search(&v), CW_OK);
  assert_true(least_angle(w.mesh, &after) > 13.0);
  assert_true(fabs(after / volume - 1.0) < 1e-12);
  assert_true(w.count.patches_changed >= 1 && w.count.patches_changed <= 3);
  for (int32_t p = 0; p < patch.point_count; p++) {
    if (w.mesh->source[p] == 0) assert_memory_equal(w.mesh->point[p].x, hull[p], sizeof hull[p]);
  }
  assert_int_equal(w.mesh->tet_count, v.mesh->tet_count);
  assert_int_equal(w.mesh->point_count, v.mesh->point_count);
  for (int32_t t = 0; t < w.mesh->tet_count; t++)
    assert_memory_equal(w.mesh->tet[t].corner, v.mesh->tet[t].corner, sizeof v.mesh->tet[t].corner);
  for (int32_t p = 0; p < w.mesh->point_count; p++)
    assert_memory_equal(w.mesh->point[p].x, v.mesh->point[p].x, sizeof v.mesh->point[p].x);
  finish(&w, &patch);
  finish(&v, &again);
}

// Also where there are more of them than one for 500 tetrahedra: a small mesh has few tries, and they are worth it.
static void many_bad_ones_of_a_small_mesh(void **state) {
  CwTetPatch patch;
  CwTetWork w = lump(20, &patch);
  double volume, least = least_angle(w.mesh, &volume);
  int32_t bad = bad_ones(&w);
  assert_true(least < 8.0 && bad > w.mesh->tet_count / cw_policy.search_share && bad <= cw_policy.search_any);
  assert_int_equal(cw_tet_search(&w), CW_OK);
  assert_true(w.count.patches_changed >= 1 && least_angle(w.mesh, &volume) >= least);
  finish(&w, &patch);
}

static void good_ones_are_left_alone(void **state) {
  CwTetPatch patch;
  CwTetWork w = lump(0, &patch);
  double before, after, least = least_angle(w.mesh, &before);
  assert_true(least > 13.0);
  int32_t tets = w.mesh->tet_count, points = w.mesh->point_count;
  assert_int_equal(cw_tet_search(&w), CW_OK);
  assert_true(least_angle(w.mesh, &after) == least && after == before);
  assert_int_equal(w.mesh->tet_count, tets);
  assert_int_equal(w.mesh->point_count, points);
  assert_int_equal(w.count.patches_changed, 0);
  finish(&w, &patch);
}

// Least sine of the tetrahedra at a point.
static double least_round(const CwTetMesh *mesh, int32_t point) {
  double least = 1.0;
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    const int32_t *c = mesh->tet[t].corner;
    if (c[0] < 0 || (c[0] != point && c[1] != point && c[2] != point && c[3] != point)) continue;
    least =
        fmin(least, cw_tet_quality(mesh->point[c[0]].x, mesh->point[c[1]].x, mesh->point[c[2]].x, mesh->point[c[3]].x));
  }
  return least;
}

static void normal_of(const CwTetMesh *mesh, const CwTet *tet, int face, double normal[3]) {
  const double *x[3];
  for (int i = 0; i < 3; i++) x[i] = mesh->point[tet->corner[cw_tet_face[face][i]]].x;
  cw_normal(x[0], x[1], x[2], normal);
  cw_unit(normal);
}

// Moves a corner of the hull nearly upon a triangle of it, where the tetrahedra round the corner allow it: across an
// edge that both share (2 open faces of their tetrahedron, a wedge) or from the far side (1).
static int pinch_hull(CwTetMesh *mesh, int open_faces, double left) {
  for (int32_t k = 0; k < 4 * mesh->tet_count; k++) {
    const CwTet *tet = &mesh->tet[k / 4];
    int open = 0, other = -1;
    if (tet->corner[0] < 0 || tet->neighbour[k % 4] >= 0 || mesh->source[tet->corner[k % 4]] != 0) continue;
    for (int i = 0; i < 4; i++) {
      open += tet->neighbour[i] < 0;
      if (tet->neighbour[i] < 0 && i != k % 4) other = i;
    }
    if (open != open_faces) continue;
    double normal[2][3], u[3], *p = mesh->point[tet->corner[k % 4]].x, old[3];
    normal_of(mesh, tet, k % 4, normal[0]);
    memcpy(old, p, sizeof old);
    cw_sub(p, mesh->point[tet->corner[cw_tet_face[k % 4][0]]].x, u);
    double height = cw_dot(u, normal[0]);
    for (int i = 0; i < 3; i++) p[i] -= (1.0 - left) * height * normal[0][i];
    if (other >= 0) normal_of(mesh, tet, other, normal[1]);
    int sharp = other < 0 || cw_dot(normal[0], normal[1]) < -0.9;
    if (sharp && least_round(mesh, tet->corner[k % 4]) > 0.5 * left) return 1;
    memcpy(p, old, sizeof old);
  }
  return 0;
}

// What the boundary itself forces is searched once: there is nothing to be gained from another beginning.
static void what_the_boundary_forces_is_not_pressed(void **state) {
  CwTetPatch patch;
  CwTetWork w = lump(0, &patch);
  double volume;
  assert_true(pinch_hull(w.mesh, 2, 0.1));
  judge_all(&w);
  assert_true(least_angle(w.mesh, &volume) < 10.0);
  assert_int_equal(cw_tet_search(&w), CW_OK);
  assert_true(least_angle(w.mesh, &volume) < 10.0);
  assert_in_range(w.count.search_tries, 1, 400); // none for determinants, as angles are what is bad
  finish(&w, &patch);
}

// Where the boundary's edges are no reason to end, the search begins again, so often that what is bad elsewhere has
// tries left.
static void tries_are_bounded(void **state) {
  enum { BEGINNINGS = 8, SPOILT = 3 };
  for (int spoilt = 0; spoilt <= SPOILT; spoilt += SPOILT) {
    CwTetPatch patch;
    CwTetWork w = lump(0, &patch);
    double volume;
    assert_true(pinch_hull(w.mesh, 1, 0.01));
    spoil(w.mesh, spoilt);
    judge_all(&w);
    int32_t bad = bad_ones(&w);
    assert_int_equal(cw_tet_search(&w), CW_OK);
    assert_true(least_angle(w.mesh, &volume) < 12.0);
    if (spoilt > 0) {
      assert_true(bad > SPOILT && w.count.patches_changed >= SPOILT);
      assert_in_range(bad_ones(&w), 1, 3); // those at the hull
    } else {
      const int64_t vain = BEGINNINGS * cw_policy.search_vain; // a little gained in some of them
      assert_true(2 * vain < cw_policy.search_fewest);
      assert_in_range(w.count.search_tries, vain, 2 * vain);
    }
    finish(&w, &patch);
  }
}

// In closed form as by the sum over the faces, which checkMesh takes.
static void determinant_is_that_of_the_sum(void **state) {
  const double x[4][3] = {{0.1, 0.0, 0.2}, {1.3, 0.1, 0.0}, {0.2, 0.9, -0.1}, {0.5, 0.3, 0.4}};
  CwTetMeasures m = cw_tet_measures(x[0], x[1], x[2], x[3]);
  assert_true(m.six > 0.0);
  for (int open = -1; open < 4; open++) {
    double sum[3][3] = {{0}}, mean = 0.0;
    for (int f = 0; f < 4; f++) {
      double n[3];
      if (f == open) continue;
      cw_normal(x[cw_tet_face[f][0]], x[cw_tet_face[f][1]], x[cw_tet_face[f][2]], n);
      mean += 0.5 * cw_norm(n) / (open < 0 ? 4 : 3);
      for (int i = 0; i < 9; i++) sum[i / 3][i % 3] += 0.25 * n[i / 3] * n[i % 3];
    }
    double minor[3], determinant;
    cw_cross(sum[1], sum[2], minor);
    determinant = cw_dot(sum[0], minor) / (8.0 * pow(mean, 6.0));
    assert_true(fabs(cw_tet_determinant(&m, open < 0 ? 0 : 1 << open) / determinant - 1.0) < 1e-10);
  }
  assert_true(cw_tet_determinant(&m, 3) == 0.0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bad_ones_become_good),     cmocka_unit_test(many_bad_ones_of_a_small_mesh),
      cmocka_unit_test(good_ones_are_left_alone), cmocka_unit_test(what_the_boundary_forces_is_not_pressed),
      cmocka_unit_test(tries_are_bounded),        cmocka_unit_test(determinant_is_that_of_the_sum),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
