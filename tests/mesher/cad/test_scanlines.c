// SPDX-License-Identifier: AGPL-3.0-or-later
#include <string.h>

#include <math.h>

#include "mesher/cad/scanlines.h"
#include "octahedron.h"
#include "tests/unit_test.h"

static const double low[2] = {-1, -1}, high[2] = {1, 1};

static void lines_are_cut_at_the_surface(void **state) {
  Octahedron shape;
  CwBackground background = octahedron(&shape, 1);
  CwScanlines lines;
  double volume = 0;
  assert_int_equal(cw_scanlines_make(&background, low, high, 0.02, &lines), CW_OK);
  assert_int_equal(lines.count[0], 100);
  assert_int_equal(lines.count[1], 100);
  for (int32_t k = 0; k < lines.count[1]; k++) {
    for (int32_t j = 0; j < lines.count[0]; j++) {
      double place[2];
      int64_t line = j + (int64_t)lines.count[0] * k, count = lines.start[line + 1] - lines.start[line];
      cw_scanlines_place(&lines, j, k, place);
      assert_true(place[0] >= -1 + 0.02 * j && place[0] <= -1 + 0.02 * (j + 1));
      double off = fabs(place[0]) + fabs(place[1]);
      assert_int_equal(count, off < 0.25 ? 4 : off < 1 ? 2 : 0);
      const double *cut = &lines.crossing[lines.start[line]];
      if (count > 0) assert_true(fabs(cut[0] + (1 - off)) < 1e-14 && fabs(cut[count - 1] - (1 - off)) < 1e-14);
      if (count == 4) assert_true(fabs(cut[1] + (0.25 - off)) < 1e-14 && fabs(cut[2] - (0.25 - off)) < 1e-14);
      for (int64_t c = 0; c < count; c += 2) volume += (cut[c + 1] - cut[c]) * lines.spacing * lines.spacing;
    }
  }
  assert_true(fabs(volume / (4.0 / 3 * (1 - 1.0 / 64)) - 1) < 0.002);
  cw_scanlines_free(&lines);
}

static void open_surface_is_refused(void **state) {
  Octahedron shape;
  CwBackground background = octahedron(&shape, 0);
  CwScanlines lines;
  background.triangle_count = 7;
  assert_int_equal(cw_scanlines_make(&background, low, high, 0.1, &lines), CW_ERR_GEOMETRY);
  assert_non_null(strstr(cw_fail_message(), "not closed"));
  assert_null(lines.start);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lines_are_cut_at_the_surface),
      cmocka_unit_test(open_surface_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
