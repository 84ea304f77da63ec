// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/fill.h"

#include <stdlib.h>

#include "tests/unit_test.h"

// What is free has nothing, recovery included, and may be freed again. (That no memory is left, the sanitizer tells.)
static void freed_ones_are_empty(void **state) {
  const CwFill none = {0};
  CwFill fill = {.point_count = 4, .tetrahedron_count = 1, .recovery = {1, 2, 1}};
  fill.x = malloc(4 * sizeof *fill.x);
  fill.tetrahedron = malloc(sizeof *fill.tetrahedron);
  assert_true(fill.x && fill.tetrahedron);
  for (int round = 0; round < 2; round++) {
    cw_fill_free(&fill);
    assert_memory_equal(&fill, &none, sizeof none);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(freed_ones_are_empty)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
