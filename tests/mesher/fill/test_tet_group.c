// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

// With what is compiled for narrow and for wide registers, of which a processor takes one only.
#include "mesher/fill/tet_group.c"

#include "pipeline/order.h"
#include "shaken_lattice.h"
#include "tests/unit_test.h"

static const int edge_of[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

// A Delaunay mesh of shaken points, their places, and its tetrahedra, but for those of which rounding decides which
// edge is the longest, or the shortest, and for one where the last group would be full; every third has twice the
// weight.
typedef struct {
  CwTetMesh mesh;
  Cw4f *place, *sum, *other;
  int32_t *list, count;
} Shaken;

static double square_of(const double a[3], const double b[3]) {
  return pow(b[0] - a[0], 2) + pow(b[1] - a[1], 2) + pow(b[2] - a[2], 2);
}

static int is_sure(const CwTetMesh *mesh, const int32_t corner[4]) {
  double square[6];
  for (int e = 0; e < 6; e++)
    square[e] = square_of(mesh->point[corner[edge_of[e][0]]].x, mesh->point[corner[edge_of[e][1]]].x);
  qsort(square, 6, sizeof *square, cw_order_doubles);
  return square[1] > (1.0 + 1e-5) * square[0] && square[5] > (1.0 + 1e-5) * square[4];
}

static void make(Shaken *s, double shake) {
  double(*x)[3];
  int32_t outside;
  memset(s, 0, sizeof *s);
  shaken_lattice(5, shake, &outside, &x, &s->mesh);
  s->place = aligned_alloc(16, (size_t)s->mesh.point_count * sizeof *s->place);
  s->sum = aligned_alloc(16, (size_t)s->mesh.point_count * sizeof *s->sum);
  s->other = aligned_alloc(16, (size_t)s->mesh.point_count * sizeof *s->other);
  s->list = malloc((size_t)(s->mesh.tet_count + GROUP) * sizeof *s->list);
  assert_true(s->place && s->sum && s->other && s->list);
  for (int32_t p = 0; p < s->mesh.point_count; p++)
    s->place[p] = cw_4f_difference((double[3]){2.5, 2.5, 2.5}, s->mesh.point[p].x);
  for (int32_t t = 0; t < s->mesh.tet_count; t++) {
    const int32_t *c = s->mesh.tet[t].corner;
    int enclosing = c[0] < CW_ENCLOSING_POINTS;
    for (int i = 1; i < 4; i++) enclosing |= c[i] < CW_ENCLOSING_POINTS;
    if (enclosing || !is_sure(&s->mesh, c)) continue;
    s->list[s->count++] = t;
  }
  s->count -= s->count % GROUP == 0 ? 1 : 0;
  for (int k = 0; k < GROUP; k++) s->list[s->count + k] = s->list[s->count - 1];
  free(x);
}

static void release(Shaken *s) {
  cw_tet_mesh_free(&s->mesh);
  free(s->place);
  free(s->sum);
  free(s->other);
  free(s->list);
}

typedef void Want(const CwTet *tet, const double x[4][3], double way[4][3], double *weight);

// A point with the same distance from all corners, by Cramer's rule.
static void want_centre(const CwTet *tet, const double x[4][3], double way[4][3], double *weight) {
  double a[3][3], b[3], squares = 0.0;
  for (int m = 0; m < 3; m++) {
    for (int i = 0; i < 3; i++) a[m][i] = x[m + 1][i] - x[0][i];
    b[m] = 0.5 * (a[m][0] * a[m][0] + a[m][1] * a[m][1] + a[m][2] * a[m][2]);
  }
  double six = 0.0, centre[3];
  for (int k = 0; k < 4; k++) { // the last is the determinant without a column of b
    double m[3][3];
    for (int r = 0; r < 3; r++) {
      for (int i = 0; i < 3; i++) m[r][i] = i == k ? b[r] : a[r][i];
    }
    double det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                 m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    if (k < 3)
      centre[k] = det;
    else
      six = det;
  }
  for (int e = 0; e < 6; e++) squares += square_of(x[edge_of[e][0]], x[edge_of[e][1]]);
  *weight = six / pow(squares, 1.5);
  for (int c = 0; c < 4; c++) {
    for (int i = 0; i < 3; i++) way[c][i] = *weight * (x[0][i] + centre[i] / six - x[c][i]);
  }
}

// Half the gradient of the ratio of the longest to the shortest edge, turned round.
static void want_even(const CwTet *tet, const double x[4][3], double way[4][3], double *weight) {
  double square[6];
  int near = 0, far = 0;
  memset(way, 0, 4 * sizeof *way);
  for (int e = 0; e < 6; e++) {
    square[e] = square_of(x[edge_of[e][0]], x[edge_of[e][1]]);
    near = square[e] < square[near] ? e : near;
    far = square[e] > square[far] ? e : far;
  }
  double in = 1 / sqrt(square[near] * square[far]), out = in * square[far] / square[near];
  for (int i = 0; i < 3; i++) {
    double longest = x[edge_of[far][1]][i] - x[edge_of[far][0]][i];
    double shortest = x[edge_of[near][1]][i] - x[edge_of[near][0]][i];
    way[edge_of[far][0]][i] += in * longest;
    way[edge_of[far][1]][i] -= in * longest;
    way[edge_of[near][0]][i] -= out * shortest;
    way[edge_of[near][1]][i] += out * shortest;
  }
  *weight = 0.5 * (in + out);
}

// Sums of ways and weights are those of double precision, but for rounding.
static void check_sums(const Shaken *s, Want *want) {
  double(*sum)[4] = calloc((size_t)s->mesh.point_count, sizeof *sum), most = 0.0;
  assert_non_null(sum);
  for (int32_t k = 0; k < s->count; k++) {
    const CwTet *tet = &s->mesh.tet[s->list[k]];
    double x[4][3], way[4][3], weight;
    for (int c = 0; c < 4; c++) memcpy(x[c], s->mesh.point[tet->corner[c]].x, sizeof x[c]);
    want(tet, (const double(*)[3])x, way, &weight);
    for (int c = 0; c < 4; c++) {
      for (int i = 0; i < 3; i++) sum[tet->corner[c]][i] += way[c][i];
      sum[tet->corner[c]][3] += weight;
      most = fmax(most, sum[tet->corner[c]][3]);
    }
  }
  assert_true(most > 0.0);
  for (int32_t p = 0; p < s->mesh.point_count; p++) {
    for (int i = 0; i < 4; i++) assert_true(fabs(s->sum[p][i] - sum[p][i]) < 1e-4 * most);
  }
  free(sum);
}

static void sums_are_those_of_double_precision(void **state) {
  Shaken s;
  make(&s, 0.12);
  size_t size = (size_t)s.mesh.point_count * sizeof *s.sum;
  memset(s.sum, 0, size);
  cw_tet_add_centres(&s.mesh, s.list, s.count, s.place, s.sum);
  check_sums(&s, want_centre);
  memset(s.sum, 0, size);
  cw_tet_add_pulls(&s.mesh, s.list, s.count, s.place, s.sum);
  check_sums(&s, want_even);
  release(&s);
}

static void qualities_are_those_of_double_precision(void **state) {
  Shaken s;
  int slender_ones = 0, short_ones = 0;
  make(&s, 0.2);
  for (int32_t from = 0; from < s.count; from += GROUP) {
    float quality[GROUP], too_short = 0.3f;
    int32_t slender[GROUP];
    cw_tet_group_qualities(&s.mesh, s.list + from, s.place, too_short, 2.5f, quality, slender);
    for (int k = 0; k < GROUP; k++) {
      const int32_t *c = s.mesh.tet[s.list[from + k]].corner;
      const double *x[4];
      double shortest, longest;
      for (int i = 0; i < 4; i++) x[i] = s.mesh.point[c[i]].x;
      CwTetMeasures m = cw_tet_measures(x[0], x[1], x[2], x[3]);
      cw_tet_edges(&m, &shortest, &longest);
      double exact = cw_tet_quality(x[0], x[1], x[2], x[3]);
      if (fabs(longest / shortest - 2.5) > 1e-4) assert_int_equal(slender[k], -(longest > 2.5 * shortest));
      slender_ones += slender[k] != 0;
      if (fabs(shortest - too_short) < 1e-4) continue;
      short_ones += shortest < too_short;
      if (shortest < too_short)
        assert_true(quality[k] == 0.0f);
      else if (exact > 0.1)
        assert_true(fabs(quality[k] - exact) < 1e-4);
    }
  }
  assert_true(slender_ones > 10 && short_ones > 10);
  release(&s);
}

static void any_processor_gives_the_same(void **state) {
  Shaken s;
  if (!CW_HAS_AVX2) skip();
  make(&s, 0.2);
  size_t size = (size_t)s.mesh.point_count * sizeof *s.sum;
  memset(s.sum, 0, size);
  memset(s.other, 0, size);
  for (int pulls = 0; pulls < 2; pulls++) {
    add_any(&s.mesh, s.list, s.count, s.place, pulls, s.sum);
    add_avx2(&s.mesh, s.list, s.count, s.place, pulls, s.other);
    assert_memory_equal(s.sum, s.other, size);
  }
  for (int32_t from = 0; from < s.count; from += GROUP) {
    float quality[2][GROUP];
    int32_t slender[2][GROUP];
    find_qualities(&s.mesh, s.list + from, s.place, 0.1f, 2.5f, quality[0], slender[0]);
    find_qualities_avx2(&s.mesh, s.list + from, s.place, 0.1f, 2.5f, quality[1], slender[1]);
    assert_memory_equal(quality[0], quality[1], sizeof quality[0]);
    assert_memory_equal(slender[0], slender[1], sizeof slender[0]);
  }
  release(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sums_are_those_of_double_precision),
      cmocka_unit_test(qualities_are_those_of_double_precision),
      cmocka_unit_test(any_processor_gives_the_same),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
