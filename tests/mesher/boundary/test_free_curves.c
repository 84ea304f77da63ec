// SPDX-License-Identifier: AGPL-3.0-or-later
// A free curve across a partition plane and a triangular outline on it: sound as they are; each way of spoiling them is
// told. Nodes are appended beyond the room that there is at first.
#include <stdlib.h>
#include <string.h>

#include "mesher/boundary/free_curves.h"
#include "tests/unit_test.h"

enum { NODES = 4 };

// Corners 0 and 1 have the nodes 0 and 2; curve 0 is a wall curve, curve 1 the free one, over node 1.
typedef struct {
  CwFreeCurves free_curves;
  CwNetwork network;
  CwCurve curve[2];
  CwCurveNodes nodes[2];
  CwInterfaceOutline outline;
  uint8_t on_plane[NODES];
  int32_t corner_node[2], node[3], loop[2], corner[3];
} Line;

static void make(Line *made) {
  static const Line plain = {.curve = {{.wall = 1, .corner = {0, 1}}, {.corner = {0, 1}}},
                             .on_plane = {1, 1, 1, 0},
                             .corner_node = {0, 2},
                             .node = {0, 1, 2},
                             .loop = {0, 3},
                             .corner = {0, 1, 2}};
  *made = plain;
  made->nodes[1] = (CwCurveNodes){.count = 3, .node = made->node};
  made->network = (CwNetwork){.curve_count = 2, .curve = made->curve};
  made->outline =
      (CwInterfaceOutline){.corner_count = 3, .loop_count = 1, .loop_start = made->loop, .corner = made->corner};
  made->free_curves = (CwFreeCurves){.nodes = {.count = NODES, .on_plane = made->on_plane},
                                     .corner_node = made->corner_node,
                                     .curve_count = 2,
                                     .curve = made->nodes,
                                     .outline_count = 1,
                                     .outline = &made->outline};
}

static void sound_ones_pass(void **state) {
  Line line;
  make(&line);
  assert_int_equal(cw_free_curves_audit(&line.free_curves, &line.network), CW_OK);
}

static void told(Line *line, const char *message) {
  assert_int_equal(cw_free_curves_audit(&line->free_curves, &line->network), CW_ERR_FAULT);
  if (!strstr(cw_fail_message(), message)) fail_msg("%s", cw_fail_message());
  make(line);
}

static void spoiled_ones_are_told(void **state) {
  Line line;
  make(&line);
  line.nodes[1].count = 1;
  told(&line, "free curve 1 has 1 nodes");
  line.corner_node[1] = 3;
  told(&line, "free curve 1 ends at node 2; its corner has node 3");
  line.node[1] = 0;
  told(&line, "free curve 1 has an edge from node 0 to 0 of 4");
  line.node[1] = NODES;
  told(&line, "free curve 1 has an edge from node 0 to 4 of 4");
  line.loop[1] = 2;
  told(&line, "outline 0: its loops hold 2 of 3 corners");
  line.loop[1] = line.outline.corner_count = 2;
  told(&line, "outline 0: loop 0 has 2 corners");
  line.corner[2] = 3; // not on a plane
  told(&line, "outline 0 has the corner 3, which is no node on a plane");
  line.corner[0] = -1;
  told(&line, "outline 0 has the corner -1");
}

static void nodes_are_appended(void **state) {
  CwFreeCurves free_curves = {0};
  for (int32_t i = 0; i < 100; i++) {
    const double x[3] = {i, 2 * i, 3 * i};
    int32_t node = -1;
    assert_int_equal(cw_node_table_add(&free_curves.nodes, x, i % 3 == 0, &node), CW_OK);
    assert_int_equal(node, i);
  }
  assert_int_equal(free_curves.nodes.count, 100);
  for (int32_t i = 0; i < 100; i++) {
    assert_true(free_curves.nodes.x[i][0] == i && free_curves.nodes.x[i][1] == 2 * i &&
                free_curves.nodes.x[i][2] == 3 * i);
    assert_int_equal(free_curves.nodes.on_plane[i], i % 3 == 0);
  }
  cw_free_curves_free(&free_curves);
  assert_null(free_curves.nodes.x);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sound_ones_pass),
      cmocka_unit_test(spoiled_ones_are_told),
      cmocka_unit_test(nodes_are_appended),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
