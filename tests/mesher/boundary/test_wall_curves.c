// SPDX-License-Identifier: AGPL-3.0-or-later
// A wall curve of two edges and a free one between the same two corners, and a corner off the walls: sound as they are;
// each way of spoiling them is told.
#include <stdlib.h>
#include <string.h>

#include "mesher/boundary/wall_curves.h"
#include "tests/unit_test.h"

enum { CORNERS = 3, CURVES = 2 };

typedef struct {
  CwCorner corner[CORNERS];
  CwCurve curve[CURVES];
  CwNetwork network;
  int32_t node[3];
  double parameter[3][2];
  CwCurveNodes nodes[CURVES];
  CwWallCurves curves;
} Made;

static void make(Made *made) {
  *made = (Made){.corner = {{.on_wall = 1}, {.x = {2, 0, 0}, .on_wall = 1}, {.x = {0, 0, 1}}},
                 .curve = {{.corner = {0, 1}, .wall = 1}, {.corner = {0, 2}}},
                 .node = {0, 2, 1}};
  const double corner[CORNERS - 1][3] = {{0, 0, 0}, {2, 0, 0}}, middle[3] = {1, 0, 0};
  const CwConstraint none = {CW_CONSTRAINT_NONE, -1};
  made->network =
      (CwNetwork){.corner_count = CORNERS, .corner = made->corner, .curve_count = CURVES, .curve = made->curve};
  made->nodes[0] = (CwCurveNodes){3, made->node, made->parameter};
  made->curves = (CwWallCurves){.curve_count = CURVES, .curve = made->nodes};
  made->curves.corner_vertex = malloc(CORNERS * sizeof(int32_t));
  made->curves.corner_vertex[2] = -1;
  int32_t vertex;
  for (int i = 0; i < 2; i++) {
    assert_int_equal(cw_wall_curves_add(&made->curves, corner[i], none, &made->curves.corner_vertex[i]), CW_OK);
  }
  assert_int_equal(cw_wall_curves_add(&made->curves, middle, none, &vertex), CW_OK);
  assert_int_equal(vertex, 2);
}

static void unmake(Made *made) {
  free(made->curves.x);
  free(made->curves.constraint);
  free(made->curves.corner_vertex);
}

static void told(Made *of, const char *message) {
  assert_int_equal(cw_wall_curves_audit(&of->curves, &of->network), CW_ERR_FAULT);
  if (!strstr(cw_fail_message(), message)) fail_msg("%s", cw_fail_message());
  unmake(of);
  make(of);
}

static void spoiled_ones_are_told(void **state) {
  Made of;
  make(&of);
  assert_int_equal(cw_wall_curves_audit(&of.curves, &of.network), CW_OK);
  of.curves.corner_vertex[2] = 2; // off the walls
  told(&of, "corner 2 at (0.000, 0.000, 1000.000) mm has vertex 2 of 3");
  of.curves.corner_vertex[1] = 0;
  told(&of, "corner 1 at (2000.000, 0.000, 0.000) mm has vertex 0");
  of.nodes[0].count = 0;
  told(&of, "curve 0 has 0 vertices");
  of.nodes[1] = of.nodes[0]; // a free one
  told(&of, "curve 1 has 3 vertices");
  of.node[2] = 2;
  told(&of, "curve 0 ends at vertex 2, its corner has 1");
  of.node[1] = 1;
  told(&of, "vertex 1 of 3 on curve 0 lies on another one too");
  of.nodes[0].count = 2;
  of.node[1] = 1;
  told(&of, "vertex 2 at (1000.000, 0.000, 0.000) mm lies on no curve");
  unmake(&of);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(spoiled_ones_are_told)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
