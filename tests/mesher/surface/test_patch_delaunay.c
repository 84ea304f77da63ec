// SPDX-License-Identifier: AGPL-3.0-or-later
#include <string.h>

#include "mesher/surface/cdt.h"
#include "mesher/surface/patch_delaunay.h"
#include "tests/unit_test.h"

static void stretched(const void *context, const double uv[2], double x[3], double xu[3], double xv[3]) {
  const double factor = *(const double *)context;
  memcpy(x, (const double[3]){uv[0], factor * uv[1], 0}, sizeof(double[3]));
  if (xu) memcpy(xu, (const double[3]){1, 0, 0}, sizeof(double[3]));
  if (xv) memcpy(xv, (const double[3]){0, factor, 0}, sizeof(double[3]));
}

static double unit(const void *context, const double x[3]) {
  return 1;
}

// A rhombus of the half diagonals 1 and 0.8 in (u,v), there divided along the shorter one, on a plane that stretches v
// by `factor`. Returns the flips; `across`: whether the diagonal along u then divides it.
static int64_t flips_of_rhombus(double factor, int on_chords, int *across) {
  static const double uv[4][2] = {{1, 0}, {0, 0.8}, {-1, 0}, {0, -0.8}}, same[2] = {1, 1};
  static const int32_t edge[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  static const uint8_t boundary[4] = {1, 1, 1, 1};
  double x[4][3];
  CwCdt cdt;
  CwPatchWork work;
  for (int p = 0; p < 4; p++) stretched(&factor, uv[p], x[p], NULL, NULL);
  const CwPatchInput input = {.surface = stretched,
                              .surface_context = &factor,
                              .size = unit,
                              .point_count = 4,
                              .uv = uv,
                              .x = (const double(*)[3])x,
                              .edge_count = 4,
                              .edge = edge,
                              .boundary = boundary,
                              .name = "rhombus"};
  assert_int_equal(cw_cdt_make(&input, same, &cdt, &(CwOutcome){0}), CW_OK);
  assert_int_equal(cw_patch_work_open(&input, &cdt, &work), CW_OK);
  const int64_t flips = cw_patch_delaunay(&work, on_chords);
  assert_int_equal(cw_patch_delaunay(&work, on_chords), 0);
  *across = 1;
  for (int t = 0; t < 2; t++) {
    const int32_t *c = work.corner[t];
    *across &= (c[0] == 0 || c[1] == 0 || c[2] == 0) && (c[0] == 2 || c[1] == 2 || c[2] == 2);
    assert_true(cw_twice_area(uv[c[0]], uv[c[1]], uv[c[2]]) > 0);
  }
  cw_patch_work_close(&work);
  cw_cdt_free(&cdt);
  return flips;
}

// The shorter diagonal is that of Delaunay: of 2 and 1.6 factor, the one along v below a factor of 1.25.
static void the_shorter_diagonal_divides_a_rhombus(void **state) {
  for (int on_chords = 0; on_chords < 2; on_chords++) {
    int across;
    assert_int_equal(flips_of_rhombus(1, on_chords, &across), 0);
    assert_false(across);
    assert_int_equal(flips_of_rhombus(1.24, on_chords, &across), 0);
    assert_false(across);
    assert_int_equal(flips_of_rhombus(1.26, on_chords, &across), 1);
    assert_true(across);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_shorter_diagonal_divides_a_rhombus)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
