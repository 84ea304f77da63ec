// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/fill/tet_quality.h"
#include "mesher/layers/prism_quality.h"
#include "mesher/policy.h"
#include "mesher/region/top_moves.h"
#include "pipeline/mesh/cell.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

enum { RING = 6, LAYERS = 2, CENTRE = RING * (LAYERS + 1), TOP = CENTRE + LAYERS, APEX, POINTS };

// Six columns of two layers, 0.5 and 0.6 high, round one over the middle of a hexagon of radius 1, and six tetrahedra
// from the layer top to an apex. The outer columns are shared with other regions: the end of the middle one (TOP) and
// the apex may move.
typedef struct {
  double x[POINTS][3];
  int64_t shared_id[CENTRE];
  int32_t tet[RING][4], prism[RING * LAYERS][6], wall[RING + 1][3], quad[1][4];
  CwRegionMesh mesh;
} Hexagon;

static void set_hexagon(Hexagon *h) {
  const double level[LAYERS + 1] = {0, 0.5, 1.1};
  memset(h, 0, sizeof *h);
  for (int k = 0; k <= LAYERS; k++) {
    for (int i = 0; i < RING; i++)
      memcpy(h->x[k * RING + i], (const double[3]){cos(i * M_PI / 3), sin(i * M_PI / 3), level[k]}, sizeof *h->x);
    h->x[CENTRE + k][2] = level[k];
  }
  h->x[APEX][2] = 1.9;
  for (int i = 0; i < RING; i++) {
    const int32_t next = (i + 1) % RING;
    memcpy(h->tet[i], (const int32_t[4]){TOP, LAYERS * RING + i, LAYERS * RING + next, APEX}, sizeof *h->tet);
    memcpy(h->wall[i], (const int32_t[3]){CENTRE, next, i}, sizeof *h->wall);
    for (int k = 0; k < LAYERS; k++) {
      const int32_t at = k * RING;
      const int32_t prism[6] = {CENTRE + k, at + i, at + next, CENTRE + k + 1, at + RING + i, at + RING + next};
      memcpy(h->prism[i * LAYERS + k], prism, sizeof prism);
    }
  }
  h->mesh.cells = (CwRegionData){.point_count = POINTS,
                                 .shared_count = CENTRE,
                                 .points = h->x,
                                 .shared_id = h->shared_id,
                                 .tetrahedron_count = RING,
                                 .tetrahedra = h->tet,
                                 .prism_count = RING * LAYERS,
                                 .prisms = h->prism,
                                 .triangle_count = RING,
                                 .triangles = h->wall,
                                 .quads = h->quad};
}

// Of the tetrahedra; a determinant that checkMesh calls small counts as flat_angle.
static double least_quality(const Hexagon *h) {
  double least = INFINITY;
  for (int i = 0; i < RING; i++) {
    const int32_t *c = h->tet[i];
    const double *x[4] = {h->x[c[0]], h->x[c[1]], h->x[c[2]], h->x[c[3]]};
    double determinant = fmax(cw_cell_determinant(4, x, 0xf), 0) / CW_SMALL_DETERMINANT;
    least = fmin(least, cw_tet_quality(x[0], x[1], x[2], x[3]));
    least = fmin(least, sin(cw_policy.flat_angle * CW_DEGREE) * pow(determinant, 0.25));
  }
  return least;
}

static double least_prism(const Hexagon *h) {
  double least = INFINITY;
  for (int i = 0; i < RING; i++) {
    const int32_t *p = h->prism[i * LAYERS + 1];
    const double *base[3], *top[3];
    for (int k = 0; k < 3; k++) base[k] = h->x[p[2 - k]], top[k] = h->x[p[5 - k]];
    least = fmin(least, fmin(cw_prism_quality(base, top), cw_prism_top_quality(base, top)));
  }
  return least;
}

// The end of the column leans far to one corner, where two tetrahedra are flat: it comes back, and the apex after it.
static void flat_tetrahedra_are_opened(void **state) {
  Hexagon h, before;
  int32_t moved;
  set_hexagon(&h);
  h.x[TOP][0] = 0.75;
  before = h;
  assert_true(least_quality(&h) < 0.2);
  assert_int_equal(cw_top_moves(LAYERS, &h.mesh, &moved), CW_OK);
  assert_true(moved >= 1);
  assert_true(least_quality(&h) > 0.3);
  assert_true(h.x[TOP][0] < 0.6);
  assert_memory_equal(h.x, before.x, sizeof(double[TOP][3]));
}

static void good_tetrahedra_stay(void **state) {
  Hexagon h, before;
  int32_t moved;
  set_hexagon(&h);
  before = h;
  assert_true(least_quality(&h) > cw_policy.search_wanted);
  assert_int_equal(cw_top_moves(LAYERS, &h.mesh, &moved), CW_OK);
  assert_int_equal(moved, 0);
  assert_memory_equal(h.x, before.x, sizeof h.x);
}

// The end of a column in a triangle or a quad of a patch, and that of a single layer, whose height is asked for.
static void ends_on_patches_and_of_single_layers_stay(void **state) {
  for (int way = 0; way < 3; way++) {
    Hexagon h;
    int32_t moved;
    set_hexagon(&h);
    h.x[TOP][0] = 0.75;
    if (way == 0) {
      h.mesh.cells.triangle_count++;
      memcpy(h.wall[RING], (const int32_t[3]){TOP, LAYERS * RING, LAYERS * RING + 1}, sizeof *h.wall);
    }
    if (way == 1) {
      h.mesh.cells.quad_count = 1;
      memcpy(h.quad[0], (const int32_t[4]){CENTRE + 1, RING, LAYERS * RING, TOP}, sizeof *h.quad);
    }
    if (way == 2) { // the upper layer alone
      h.mesh.cells.prism_count = RING;
      for (int i = 0; i < RING; i++) memcpy(h.prism[i], h.prism[i * LAYERS + 1], sizeof *h.prism);
    }
    assert_int_equal(cw_top_moves(way == 2 ? 1 : LAYERS, &h.mesh, &moved), CW_OK);
    assert_true(h.x[TOP][0] == 0.75 && h.x[TOP][1] == 0 && h.x[TOP][2] == 1.1);
    assert_int_equal(moved, 0);
  }
}

// From random places of both points, over hexagons up to 16 times as long as wide: nothing gets worse, prisms stay as
// good as layers ask for, and the last layer nearly as high.
static void nothing_gets_worse(void **state) {
  uint64_t seed = 1;
  int better = 0;
  for (int i = 0; i < 300; i++) {
    Hexagon h;
    int32_t moved;
    set_hexagon(&h);
    for (int p = TOP; p <= APEX; p++)
      for (int k = 0; k < 3; k++) h.x[p][k] += draw(&seed) - 0.5;
    for (int p = 0; p < POINTS; p++) h.x[p][0] *= 1 << i % 5;
    const double first = least_quality(&h), prism = least_prism(&h);
    const double height = cw_distance(h.x[TOP], h.x[TOP - 1]);
    if (!(first > 0) || !(prism > 0)) continue;
    assert_int_equal(cw_top_moves(LAYERS, &h.mesh, &moved), CW_OK);
    better += least_quality(&h) > first;
    assert_true(least_quality(&h) >= first - 1e-12);
    assert_true(least_prism(&h) >= fmin(prism, cw_policy.prism_good));
    double change = cw_distance(h.x[TOP], h.x[TOP - 1]) / height;
    assert_true(change <= 1 + cw_policy.slope && change >= 1 / (1 + cw_policy.slope));
  }
  assert_true(better > 50);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(flat_tetrahedra_are_opened),
      cmocka_unit_test(good_tetrahedra_stay),
      cmocka_unit_test(ends_on_patches_and_of_single_layers_stay),
      cmocka_unit_test(nothing_gets_worse),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
