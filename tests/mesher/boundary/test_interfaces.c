// SPDX-License-Identifier: AGPL-3.0-or-later
// A square interface with a point in its middle, and an open patch beside it: sound as they are; each way of spoiling
// them is told.
#include <string.h>

#include "mesher/boundary/interfaces.h"
#include "tests/unit_test.h"

enum { NODES = 6, TRIANGLES = 4, REGIONS = 3 };

typedef struct {
  CwInterfaces interfaces;
  CwInterfaceOutline outline;
  double x[NODES][3];
  int32_t triangle[TRIANGLES][3], region[TRIANGLES][2], open_patch[1][3], open_patch_face[1], open_patch_region[1],
      loop[2], corner[4];
} Square;

static void make(Square *made) {
  static const Square plain = {.x = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}, {0, 0, 1}},
                               .triangle = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}},
                               .region = {{0, 2}, {0, 2}, {0, 2}, {0, 2}},
                               .open_patch = {{0, 5, 1}},
                               .open_patch_face = {7},
                               .open_patch_region = {2},
                               .loop = {0, 4},
                               .corner = {0, 1, 2, 3}};
  *made = plain;
  made->outline = (CwInterfaceOutline){.corner_count = 4,
                                       .loop_count = 1,
                                       .loop_start = made->loop,
                                       .corner = made->corner,
                                       .triangle_count = TRIANGLES};
  made->interfaces = (CwInterfaces){.nodes = {.count = NODES, .x = made->x},
                                    .open_patch = {1, made->open_patch, made->open_patch_face, made->open_patch_region},
                                    .outline_count = 1,
                                    .outline = &made->outline,
                                    .refined = {TRIANGLES, made->triangle, made->region}};
}

static void sound_ones_pass(void **state) {
  Square of;
  make(&of);
  assert_int_equal(cw_interfaces_audit(&of.interfaces, REGIONS), CW_OK);
  // The rule of region numbers leaves the square in two triangles.
  int32_t two[2][3] = {{0, 1, 2}, {0, 2, 3}}, sides[2][2] = {{0, 2}, {0, 2}};
  of.interfaces.planned = of.interfaces.refined;
  of.interfaces.refined = (CwInterfaceTriangles){2, two, sides};
  of.outline.refined_count = 2;
  assert_int_equal(cw_interfaces_audit(&of.interfaces, REGIONS), CW_OK);
}

static void told(Square *of, const char *message) {
  assert_int_equal(cw_interfaces_audit(&of->interfaces, REGIONS), CW_ERR_FAULT);
  if (!strstr(cw_fail_message(), message)) fail_msg("%s", cw_fail_message());
  make(of);
}

static void spoiled_ones_are_told(void **state) {
  Square of;
  make(&of);
  of.open_patch[0][1] = NODES;
  told(&of, "open patches: triangle 0 has the corners 0, 6, 1 of 6 nodes");
  of.open_patch_region[0] = REGIONS;
  told(&of, "open patches: triangle 0 lies in region 3 of 3");
  of.triangle[2][0] = 4;
  told(&of, "interfaces: triangle 2 has the corners 4, 3, 4");
  of.region[1][1] = 0;
  told(&of, "interfaces: triangle 1 lies between the regions 0 and 0 of 3");
  of.outline.triangle_start = 1;
  told(&of, "has the triangles 1 to 4 of 4");
  of.outline.triangle_count = 3; // a hole
  told(&of, "is used 1 times");
  of.triangle[3][0] = 1; // two on one another
  told(&of, "times by triangles and loops; 2 are allowed");
  of.corner[2] = 4; // another loop than the triangles'
  told(&of, "is used");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sound_ones_pass),
      cmocka_unit_test(spoiled_ones_are_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
