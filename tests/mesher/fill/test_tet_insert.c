// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_insert.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "joined_mesh.h"
#include "mesher/policy.h"
#include "shaken_lattice.h"
#include "tests/unit_test.h"

typedef struct {
  double (*x)[3];
  CwTetMesh mesh;
  CwTetWork w;
} Lattice;

static void make_lattice(Lattice *l) {
  int32_t outside;
  const int32_t points = shaken_lattice(3, 0.4, &outside, &l->x, &l->mesh);
  l->w = (CwTetWork){.mesh = &l->mesh, .fixed_count = outside, .source_count = points, .insert_round = 0.34};
  for (int32_t t = 0; t < l->mesh.tet_count; t++) {
    CwTet *tet = &l->mesh.tet[t];
    const int32_t *c = tet->corner;
    tet->star = 0;
    if (c[0] >= 0) tet->quality = cw_tet_quality_of(&l->w, c[0], c[1], c[2], c[3]);
  }
}

static void free_lattice(Lattice *l) {
  free(l->x);
  cw_tet_work_free(&l->w);
  cw_tet_mesh_free(&l->mesh);
}

// The least quality of the tetrahedra of a point, and their number.
static double least_at(const Lattice *l, int32_t point, int *count) {
  double least = INFINITY;
  *count = 0;
  for (int32_t t = 0; t < l->mesh.tet_count; t++) {
    const int32_t *c = l->mesh.tet[t].corner;
    if (c[0] < 0 || cw_tet_corner_of(&l->mesh.tet[t], point) < 0) continue;
    const double quality = cw_tet_quality_of(&l->w, c[0], c[1], c[2], c[3]);
    assert_near(l->mesh.tet[t].quality, quality, 0);
    least = fmin(least, quality);
    ++*count;
  }
  return least;
}

// Sum of the qualities of the tetrahedra there are: another one where something has changed.
static double sum_of(const CwTetMesh *mesh) {
  double sum = 0;
  for (int32_t t = 0; t < mesh->tet_count; t++) sum += mesh->tet[t].corner[0] < 0 ? 0 : (t + 1) * mesh->tet[t].quality;
  return sum;
}

// A new point leaves nothing about it that is not better than what it came for, and fills the place that is cleared;
// where there is none that gains, all stays.
static void a_new_point_gains(void **state) {
  Lattice l;
  int added = 0, kept = 0;
  make_lattice(&l);
  const int32_t first = l.w.source_count;
  const double six = joined_volume6(&l.mesh);
  for (int32_t t = 0; t < l.mesh.tet_count; t++) {
    if (l.mesh.tet[t].corner[0] < 0) continue;
    const double quality = l.mesh.tet[t].quality, before = sum_of(&l.mesh);
    const int32_t points = l.mesh.point_count;
    int done_it, count;
    assert_int_equal(cw_tet_insert(&l.w, t, &done_it), CW_OK);
    assert_int_equal(l.mesh.point_count, points + done_it);
    added += done_it;
    kept += !done_it;
    assert_int_equal(l.w.count.points_added, added);
    assert_int_equal(l.w.source_count, first + added);
    if (!done_it) {
      assert_true(sum_of(&l.mesh) == before);
      continue;
    }
    assert_true(least_at(&l, points, &count) > quality + cw_policy.least_gain);
    assert_true(count >= 4);
    assert_int_equal(l.mesh.source[points], first + added - 1);
    assert_near(joined_volume6(&l.mesh) / six, 1, 1e-9);
  }
  assert_true(added > 30 && kept > 30);
  free_lattice(&l);
}

// At a given place it is made whether it gains or not, but for what would be below the least that is asked.
static void a_given_place_needs_no_gain(void **state) {
  Lattice l;
  int made = 0, worse = 0, refused = 0;
  make_lattice(&l);
  const double six = joined_volume6(&l.mesh);
  for (int32_t t = 0; t < l.mesh.tet_count; t += 3) {
    const int32_t *c = l.mesh.tet[t].corner;
    if (c[0] < 0) continue;
    const double quality = l.mesh.tet[t].quality, before = sum_of(&l.mesh), least = t % 2 ? 0.3 : 0.05;
    const int32_t points = l.mesh.point_count;
    double middle[3] = {0};
    int count;
    for (int k = 0; k < 12; k++) middle[k % 3] += 0.25 * cw_tet_at(&l.w, c[k / 3])[k % 3];
    assert_int_equal(cw_tet_insert_at(&l.w, t, middle, 0.2, least), CW_OK);
    if (l.mesh.point_count == points) {
      assert_true(sum_of(&l.mesh) == before);
      refused++;
      continue;
    }
    const double after = least_at(&l, points, &count);
    assert_true(after > least);
    assert_near(joined_volume6(&l.mesh) / six, 1, 1e-9);
    made++;
    worse += after < quality;
  }
  assert_true(made > 10 && worse > 3 && refused > 3);
  free_lattice(&l);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_new_point_gains),
      cmocka_unit_test(a_given_place_needs_no_gain),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
