// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "closed_surfaces.h"
#include "mesher/common/quality.h"
#include "mesher/fill/fill_points.h"
#include "mesher/fill/lattice_core.h"
#include "tests/unit_test.h"

enum { LEVEL = 3, EDGE = 2 << LEVEL };

static int compare_sites(const void *left, const void *right) {
  const CwLatticeSite *a = left, *b = right;
  return a->key < b->key ? -1 : a->key > b->key;
}

// Sites of n x n x n cells: corners and centres.
static int32_t block(int n, CwLatticeSite **site) {
  int32_t count = 0;
  *site = malloc((size_t)((n + 1) * (n + 1) * (n + 1) + n * n * n) * sizeof **site);
  for (int half = 0; half < 2; half++) {
    for (int i = 0; i <= n - half; i++) {
      for (int j = 0; j <= n - half; j++) {
        for (int k = 0; k <= n - half; k++) {
          int32_t at[3] = {EDGE * (i + 4), EDGE * (j + 4), EDGE * (k + 4)};
          for (int a = 0; a < 3; a++) at[a] += half * EDGE / 2;
          (*site)[count++] = (CwLatticeSite){cw_lattice_key(at), LEVEL, 1};
        }
      }
    }
  }
  qsort(*site, (size_t)count, sizeof **site, compare_sites);
  return count;
}

static int32_t find_site(int32_t count, const CwLatticeSite *site, const int32_t at[3]) {
  CwLatticeSite wanted = {.key = cw_lattice_key(at)};
  const CwLatticeSite *found = bsearch(&wanted, site, (size_t)count, sizeof *site, compare_sites);
  return found ? (int32_t)(found - site) : -1;
}

static CwLatticeCore make(int32_t count, const CwLatticeSite *site) {
  CwLatticeCore core;
  if (cw_lattice_core_make(count, site, &core) != CW_OK) fail_msg("%s", cw_fail_message());
  return core;
}

static void places(int32_t count, const CwLatticeSite *site, double (*x)[3]) {
  for (int32_t s = 0; s < count; s++) {
    int32_t at[3];
    cw_lattice_at(site[s].key, at);
    for (int i = 0; i < 3; i++) x[s][i] = at[i];
  }
}

// All positive, and their volume is what the faces enclose.
static double volume_of(const CwLatticeCore *core, const double (*x)[3]) {
  static const double origin[3] = {0, 0, 0};
  double six = 0.0, enclosed = 0.0;
  for (int32_t t = 0; t < core->tet_count; t++) {
    const int32_t *c = core->tet[t];
    double here = cw_tet_volume6(x[c[0]], x[c[1]], x[c[2]], x[c[3]]);
    assert_true(here > 0.0);
    six += here;
  }
  for (int32_t f = 0; f < core->face_count; f++) {
    const int32_t *c = core->face[f];
    enclosed += cw_tet_volume6(origin, x[c[0]], x[c[1]], x[c[2]]);
  }
  assert_true(fabs(six - enclosed) <= 1e-9 * fabs(six));
  return six / 6.0;
}

// Role of a point of a block: of a corner (half 0) or a centre (half 1).
static int role_in(const CwLatticeCore *core, int32_t count, const CwLatticeSite *site, int half, const int at[3]) {
  int32_t there[3];
  for (int i = 0; i < 3; i++) there[i] = EDGE * (at[i] + 4) + half * EDGE / 2;
  return core->role[find_site(count, site, there)];
}

// Tetrahedra with a deep corner: two centres beside a face, and an edge of it.
static int32_t count_tets(const CwLatticeCore *core, int32_t sites, const CwLatticeSite *site, int n) {
  int32_t count = 0;
  for (int32_t f = 0; f < 3 * n * n * n; f++) {
    int axis = f % 3, cell[3] = {f / 3 / n / n, f / 3 / n % n, f / 3 % n}, other[3];
    memcpy(other, cell, sizeof other);
    other[axis]++;
    if (other[axis] == n) continue;
    int centres = role_in(core, sites, site, 1, cell) == CW_LATTICE_DEEP ||
                  role_in(core, sites, site, 1, other) == CW_LATTICE_DEEP;
    int deep[4];
    for (int k = 0; k < 4; k++) { // in turn round the face
      int at[3] = {cell[0], cell[1], cell[2]};
      at[axis]++;
      at[(axis + 1) % 3] += k == 1 || k == 2;
      at[(axis + 2) % 3] += k >= 2;
      deep[k] = role_in(core, sites, site, 0, at) == CW_LATTICE_DEEP;
    }
    for (int k = 0; k < 4; k++) count += centres || deep[k] || deep[(k + 1) % 4];
  }
  return count;
}

// Outermost cells are not calm, so m = n - 2 cells a side have deep centres, and (m - 1)^3 corners among them are
// deep. Of the centres those on the edges of this smaller block have no innermost point beside them.
static void block_of_cells(void **unused) {
  for (int n = 4; n <= 9; n++) {
    CwLatticeSite *site;
    int32_t count = block(n, &site), m = n - 2;
    double(*x)[3] = malloc((size_t)count * sizeof *x), cell = (double)EDGE * EDGE * EDGE;
    CwLatticeCore core = make(count, site);
    places(count, site, x);
    int32_t deep = n == 4 ? 0 : (m - 2) * (m - 2) * (m - 2) + 6 * (m - 2) * (m - 2) + (m - 1) * (m - 1) * (m - 1);
    assert_int_equal(core.deep_count, deep);
    assert_int_equal(core.tet_count, count_tets(&core, count, site, n));
    double volume = volume_of(&core, (const double(*)[3])x); // each is a twelfth of a cell
    assert_true(fabs(volume - cell * core.tet_count / 12.0) <= 1e-12 * volume);
    cw_lattice_core_free(&core);
    free(x);
    free(site);
  }
}

// A missing point, a cell that the boundary meets, or points of smaller cells leave no core round them.
static void what_is_in_the_way(void **unused) {
  CwLatticeSite *site;
  int32_t count = block(7, &site);
  CwLatticeCore core;
  const int32_t at[3] = {EDGE * 7 + EDGE / 2, EDGE * 7 + EDGE / 2, EDGE * 7 + EDGE / 2};
  int32_t middle = find_site(count, site, at);
  core = make(count, site);
  assert_int_equal(core.role[middle], CW_LATTICE_DEEP);
  cw_lattice_core_free(&core);
  site[middle].clear = 0;
  core = make(count, site);
  assert_int_equal(core.tet_count, 0);
  cw_lattice_core_free(&core);
  site[middle] = (CwLatticeSite){site[middle].key, LEVEL - 1, 1}; // a corner of smaller cells
  core = make(count, site);
  assert_int_equal(core.tet_count, 0);
  cw_lattice_core_free(&core);
  memmove(site + middle, site + middle + 1, (size_t)(count - 1 - middle) * sizeof *site);
  core = make(count - 1, site);
  assert_int_equal(core.tet_count, 0);
  cw_lattice_core_free(&core);
  free(site);
}

// Twice as large on one side, from a step on.
static double stepped(const void *context, const double x[3]) {
  return x[0] < 0.004 ? *(const double *)context : 2.0 * *(const double *)context;
}

// Against every point, of the lattice and of the boundary: nothing is in the sphere of a tetrahedron of the core,
// nor near it, where sizes meet as well. Only deep points have all their 24 tetrahedra in the core.
static void spheres_are_empty(void **unused) {
  Surface s = {0};
  double h = 0.002, (*x)[3];
  int32_t count, both = 0;
  CwLatticeSite *site;
  surface_add_sphere(&s, (double[3]){0, 0, 0}, 0.05, 4, 1);
  CwFillInput input = {.point_count = s.point_count,
                       .x = (const double(*)[3])s.x,
                       .triangle_count = s.triangle_count,
                       .triangle = (const int32_t(*)[3])s.triangle,
                       .size = stepped,
                       .size_context = &h,
                       .name = "ball"};
  assert_int_equal(cw_fill_points(&input, 1.0, &count, &x, &site), CW_OK);
  CwLatticeCore core = make(count, site);
  assert_true(core.tet_count > 50000);
  for (int32_t t = 0; t < core.tet_count; t++) both |= 1 << site[core.tet[t][0]].level; // a centre
  assert_true((both & (both - 1)) != 0);
  volume_of(&core, (const double(*)[3])x);
  for (int32_t t = 0; t < core.tet_count; t += 50) {
    const int32_t *c = core.tet[t];
    double centre[3], square = 0.0, edge = 0.0; // of its sphere: the mean of the corners; of its longest edge
    for (int i = 0; i < 3; i++) {
      centre[i] = 0.25 * (x[c[0]][i] + x[c[1]][i] + x[c[2]][i] + x[c[3]][i]);
      edge += (x[c[0]][i] - x[c[1]][i]) * (x[c[0]][i] - x[c[1]][i]);
      square += (centre[i] - x[c[0]][i]) * (centre[i] - x[c[0]][i]);
    }
    assert_true(fabs(square / edge - 5.0 / 16.0) < 0.01);
    int on = 0;
    for (int32_t p = 0; p < count + s.point_count; p++) {
      const double *y = p < count ? x[p] : s.x[p - count];
      double away = (y[0] - centre[0]) * (y[0] - centre[0]) + (y[1] - centre[1]) * (y[1] - centre[1]) +
                    (y[2] - centre[2]) * (y[2] - centre[2]);
      on += away < 1.05 * square;
      assert_true(away < 1.02 * square || away > 1.05 * square);
    }
    assert_int_equal(on, 4);
  }
  int32_t *met = calloc((size_t)count, sizeof *met);
  for (int32_t t = 0; t < 4 * core.tet_count; t++) met[core.tet[t / 4][t % 4]]++;
  for (int32_t p = 0; p < count; p++) {
    assert_true(core.role[p] != CW_LATTICE_DEEP || met[p] == 24);
    assert_true(core.role[p] != CW_LATTICE_SHELL || met[p] == 0);
    assert_true(core.role[p] != CW_LATTICE_SKIN || (met[p] > 0 && met[p] < 24));
  }
  free(met);
  cw_lattice_core_free(&core);
  free(x);
  free(site);
  surface_free(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(block_of_cells),
      cmocka_unit_test(what_is_in_the_way),
      cmocka_unit_test(spheres_are_empty),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
