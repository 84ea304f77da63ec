// SPDX-License-Identifier: AGPL-3.0-or-later
#include <stdlib.h>
#include <string.h>

#include "mesher/surface/patch_task.h"
#include "tests/unit_test.h"

// A parabolic arch over the plane z = 0, on which its feet u = 0 and u = 1 stand.
static void arch(const void *context, const double uv[2], double x[3], double xu[3], double xv[3]) {
  const double height = *(const double *)context;
  x[0] = uv[0], x[1] = uv[1], x[2] = height * uv[0] * (1 - uv[0]);
  if (xu) memcpy(xu, (double[3]){1, 0, height * (1 - 2 * uv[0])}, 3 * sizeof *xu);
  if (xv) memcpy(xv, (double[3]){0, 1, 0}, 3 * sizeof *xv);
}

static double coarse(const void *context, const double x[3]) {
  return 10;
}

// Of the plane z = level.
static int32_t side_of_plane(const void *context, const double x[3]) {
  return x[2] > *(const double *)context ? 1 : -1;
}

// Meshed by its four corners alone, its triangles lie in the plane: the label is that of the surface, above or below. A
// plane between triangles and surface leaves them on their side.
static void the_label_is_that_of_the_surface(void **state) {
  static const double corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int i = 0; i < 4; i++) {
    int below = i % 2;
    double height = below ? -0.1 : 0.1, level = i < 2 ? 0 : height / 8;
    int wanted = (i < 2) != below ? 1 : -1;
    CwPatchOutline outline;
    int32_t local[4];
    assert_int_equal(cw_outline_start(&outline, 4), CW_OK);
    for (int32_t i = 0; i < 4; i++) {
      double x[3];
      arch(&height, corner[i], x, NULL, NULL);
      assert_int_equal(cw_outline_point(&outline, i, corner[i], x, &local[i]), CW_OK);
    }
    for (int32_t i = 0; i < 4; i++) assert_int_equal(cw_outline_edge(&outline, local[i], local[(i + 1) % 4], 1), CW_OK);
    void *bytes = NULL;
    int64_t size;
    assert_int_equal(
        cw_patch_task(&outline, arch, &height, coarse, NULL, 0, 0, side_of_plane, &level, "arch", &bytes, &size),
        CW_OK);
    CwPatchBlock block;
    cw_patch_block(bytes, &block);
    assert_int_equal(block.triangle_count, 2);
    for (int32_t t = 0; t < block.triangle_count; t++) assert_int_equal(block.label[t], wanted);
    free(bytes);
    cw_outline_free(&outline);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_label_is_that_of_the_surface)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
