// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/region_share.h"

#include "tests/unit_test.h"

enum { PASSAGES = 4, REGIONS = 9 };

// A wheel of four passages of one region each, not in a row, and five other regions, of which two have equal counts in
// different domains, and two the cells of a passage but other points.
static void make(CwMeshRegion *lines) {
  static const int turned[PASSAGES] = {1, 2, 4, 7};
  for (int r = 0; r < REGIONS; ++r)
    lines[r] = (CwMeshRegion){.domain = r % 2, .points = 20 + r, .own_points = 10, .tetrahedra = 30 + 10 * r};
  lines[8] = lines[3];
  lines[8].domain = 0;
  for (int i = 0; i < PASSAGES; ++i)
    lines[turned[i]] = (CwMeshRegion){.points = 50, .own_points = 40, .tetrahedra = 100};
  lines[5] = lines[1];
  lines[5].own_points = 41;
  lines[6] = lines[1];
  lines[6].points = 51;
}

static void regions_with_the_same_counts_have_one_rank(void **state) {
  CwMeshRegion lines[REGIONS];
  const CwMesh mesh = {.regions = lines, .region_count = REGIONS};
  const int alike[REGIONS] = {0, 1, 1, 3, 1, 5, 6, 1, 8};
  make(lines);
  for (int ranks = 1; ranks <= 12; ++ranks) {
    int had[REGIONS] = {0};
    for (int rank = 0; rank < ranks; ++rank) {
      CwRegionShare share = {0};
      const CwRanks of = {.rank = rank, .size = ranks};
      assert_int_equal(cw_region_share(&mesh, &of, &share), CW_OK);
      assert_memory_equal(share.alike, alike, sizeof alike);
      for (int r = 0; r < REGIONS; ++r) {
        assert_in_range(share.owner[r], 0, ranks - 1);
        assert_int_equal(share.owner[r], share.owner[alike[r]]);
      }
      for (int i = 0, left[REGIONS] = {0}; i < share.own_count; ++i) {
        const int r = share.own[i];
        assert_int_equal(share.owner[r], rank);
        ++had[r];
        if (i > 0 && alike[share.own[i - 1]] != alike[r]) ++left[alike[share.own[i - 1]]];
        assert_int_equal(left[alike[r]], 0); // none after others have come between
      }
      cw_region_share_free(&share);
    }
    for (int r = 0; r < REGIONS; ++r) assert_int_equal(had[r], 1);
  }
}

// By hand: the passages are 100 + 3 times 50 of work, the others 30, 60, 100, 100 and 60.
static void ranks_have_about_the_same_work(void **state) {
  CwMeshRegion lines[REGIONS];
  const CwMesh mesh = {.regions = lines, .region_count = REGIONS};
  CwRegionShare share = {0};
  make(lines);
  assert_int_equal(cw_region_share(&mesh, &(CwRanks){.rank = 1, .size = 2}, &share), CW_OK);
  // 250 | 100, 100, 60 | 60 -> 310, 260 | 30 -> 290
  const int owner[REGIONS] = {1, 0, 0, 1, 0, 1, 1, 0, 0};
  assert_memory_equal(share.owner, owner, sizeof owner);
  cw_region_share_free(&share);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(regions_with_the_same_counts_have_one_rank),
      cmocka_unit_test(ranks_have_about_the_same_work),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
