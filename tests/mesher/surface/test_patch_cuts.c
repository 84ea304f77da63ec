// SPDX-License-Identifier: AGPL-3.0-or-later

#include "mesher/surface/patch_cuts.h"
#include "tests/unit_test.h"

// Points 0 to 7 with two outline edges, a cut 0-1-2-3, one 3-4-5 and one 3-6 that meet it in 3.
static CwPatchCuts meeting_cuts(void) {
  static const int32_t edge[][2] = {{0, 7}, {7, 5}, {1, 0}, {1, 2}, {3, 2}, {3, 4}, {4, 5}, {6, 3}};
  static const uint8_t boundary[] = {1, 1, 0, 0, 0, 0, 0, 0};
  const CwPatchInput input = {.point_count = 8, .edge_count = 8, .edge = edge, .boundary = boundary};
  CwPatchCuts cuts;
  assert_int_equal(cw_patch_cuts_make(&input, &cuts), CW_OK);
  return cuts;
}

static int held(const CwPatchCuts *cuts, int32_t a, int32_t b, int32_t c) {
  return cw_patch_cuts_hold(cuts, (const int32_t[3]){a, b, c});
}

static void a_cut_holds_its_points_and_ends(void **state) {
  CwPatchCuts cuts = meeting_cuts();
  assert_int_equal(cuts.cut_count, 2); // the one of a single edge has no point inside
  assert_true(held(&cuts, 0, 1, 2));
  assert_true(held(&cuts, 3, 0, 1));
  assert_true(held(&cuts, 5, 3, 4));
  assert_false(held(&cuts, 1, 2, 4));
  assert_false(held(&cuts, 0, 3, 5));
  assert_false(held(&cuts, 0, 1, 7));
  assert_false(held(&cuts, 3, 6, 4));
  assert_false(held(&cuts, 0, 1, 8)); // no given point
  cw_patch_cuts_free(&cuts);
}

static void a_closed_cut_has_no_ends(void **state) {
  static const int32_t edge[][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}};
  static const uint8_t boundary[] = {0, 0, 0, 0, 1};
  const CwPatchInput input = {.point_count = 6, .edge_count = 5, .edge = edge, .boundary = boundary};
  CwPatchCuts cuts;
  assert_int_equal(cw_patch_cuts_make(&input, &cuts), CW_OK);
  assert_int_equal(cuts.cut_count, 1);
  assert_true(held(&cuts, 0, 2, 3));
  assert_false(held(&cuts, 0, 2, 4));
  cw_patch_cuts_free(&cuts);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_cut_holds_its_points_and_ends),
                                     cmocka_unit_test(a_closed_cut_has_no_ends)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
